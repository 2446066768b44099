// The nodes and what passes between them: the machine, who gets what from whom, the hottest pages.
const machine = {places: new Map()};
const label = (pen, align) => {
  pen.font = "11px system-ui,sans-serif";
  pen.textAlign = align;
};
const linkNames = (link) => data.links[link].slice(0, 2);

// The machine: nodes in a ring or, if there are many, in rows; links as thick and as red as they were held

const startMachine = (box) => {
  const beside = (number, step, count) => (Math.max(number, step > 0 ? -1 : 0) + step + count) % count;
  machine.canvas = makeCanvas("machine", "Nodes by how much they compute, and links by how long they were held. The tables of nodes and links below say the same.", box,
    partAt, (right, down) => right || !data.links.length ? {node: beside(state.node, right || down, data.nodes)} : {link: beside(state.link, down, data.links.length)});
};
/// Middles of nodes and switches, 0 to 1 each way.
const placeMachine = () => {
  const {places} = machine, inner = new Set();
  for (const link of data.links) for (const name of link.slice(0, 2)) if (!/^(node|memory)/.test(name)) inner.add(name);
  const rings = data.nodes <= barsMax, columns = Math.ceil(Math.sqrt(data.nodes));
  for (let node = 0; node < data.nodes; ++node) {
    const turn = 2 * Math.PI * node / data.nodes - Math.PI / 2;
    places.set("node " + node, rings ? [0.5 + 0.44 * Math.cos(turn), 0.5 + 0.44 * Math.sin(turn)] :
      [(node % columns + 0.5) / columns, 0.12 + 0.88 * (Math.floor(node / columns) + 0.5) / columns]);
  }
  [...inner].sort((a, b) => a.localeCompare(b, "en", {numeric: true})).forEach((name, i) => {
    const turn = 2 * Math.PI * (i + 0.5) / inner.size - Math.PI / 2;
    places.set(name, rings ? [0.5 + 0.24 * Math.cos(turn), 0.5 + 0.24 * Math.sin(turn)] : [(i + 0.5) / inner.size, 0.08]);
  });
};
const nodeRadius = () => data.nodes <= barsMax ? Math.min(0.045, 1.1 / Math.max(8, data.nodes)) : 0.4 / Math.ceil(Math.sqrt(data.nodes));
/// Of more nodes than can be told apart only links that are chosen.
const linksShown = (choice, bright) => data.links.map((link, i) => i).filter((i) =>
  data.nodes <= barsMax || i === choice.link || linkNames(i).some((name) => bright.has(nodeOf(name))));
const partAt = (x, y) => {
  let best = {}, nearest = nodeRadius() * 1.3;
  for (let node = 0; node < data.nodes; ++node) {
    const [a, b] = machine.places.get("node " + node), far = Math.hypot(a - x, b - y);
    if (far < nearest) [best, nearest] = [{node}, far];
  }
  if ("node" in best) return best;
  nearest = 0.015;
  for (const link of linksShown(state, brightNodes(state))) {
    const [from, to] = linkNames(link).map((name) => machine.places.get(name));
    if (!from || !to) continue;
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]], length = dx * dx + dy * dy || 1;
    const along = Math.max(0, Math.min(1, ((x - from[0]) * dx + (y - from[1]) * dy) / length));
    const far = Math.hypot(from[0] + along * dx - x, from[1] + along * dy - y);
    if (far < nearest) [best, nearest] = [{link}, far];
  }
  return best;
};
const drawMachine = () => {
  const choice = chosen(), bright = brightNodes(choice), [first, last] = stepsShown(), [pen, size] = square(machine.canvas);
  const dims = hasChoice(choice), radius = nodeRadius() * size;
  for (const i of linksShown(choice, bright)) {
    const [from, to] = linkNames(i).map((name) => machine.places.get(name)), held = Math.min(1, data.links[i][4] / data.total_ns);
    if (!from || !to) continue;
    pen.globalAlpha = !dims || i === choice.link || (choice.link < 0 && linkNames(i).some((name) => bright.has(nodeOf(name)))) ? 1 : 0.12;
    pen.strokeStyle = `hsl(${Math.round(210 - 210 * Math.min(1, 2 * held))} 75% 50%)`;
    pen.lineWidth = 1 + 8 * held + (i === choice.link ? 2 : 0);
    pen.beginPath();
    pen.moveTo(from[0] * size, from[1] * size);
    pen.lineTo(to[0] * size, to[1] * size);
    pen.stroke();
  }
  label(pen, "center");
  for (const [name, [x, y]] of machine.places) {
    const node = nodeOf(name), isNode = node >= 0 && node < data.nodes;
    pen.globalAlpha = !dims || bright.has(node) ? 1 : 0.25;
    pen.fillStyle = css("card");
    pen.beginPath();
    if (isNode) pen.arc(x * size, y * size, radius, 0, 7);
    else pen.rect(x * size - 5, y * size - 5, 10, 10);
    pen.fill();
    if (isNode) {
      let computing = 0;
      works.forEach((work, k) => { if (work.name === "tracing" || work.name === "shading") computing += shareOf(k, node, first, last); });
      pen.fillStyle = workColors.tracing;
      const solid = pen.globalAlpha;
      pen.globalAlpha = solid * Math.min(1, 0.08 + 0.92 * computing);
      pen.fill();
      pen.globalAlpha = solid;
    }
    if (radius > 3 || bright.has(node)) {
      pen.lineWidth = bright.has(node) ? 2.5 : 1;
      pen.strokeStyle = bright.has(node) ? "#e03030" : css("ink");
      pen.stroke();
    }
    if (isNode && radius >= 8) {
      pen.fillStyle = css("ink");
      pen.fillText(node, x * size, y * size + 4);
    }
  }
  pen.globalAlpha = 1;
};
const nodeText = (node) => {
  if (node >= data.nodes) return "The host.";
  const [first, last] = stepsShown(), said = works.map((work, k) => [work.name, shareOf(k, node, first, last)]).filter(([, share]) => share >= 0.0005);
  const waits = Math.max(0, 1 - said.reduce((sum, [, share]) => sum + share, 0));
  return `Node ${node}, ${partText()}: ` + [...said, ["waiting", waits]].map(([name, share]) => `${name} ${percentText(share)}`).join(", ") + ".";
};
const linkText = (link) => {
  const [from, to, messages, bytes, held, waited] = data.links[link];
  return `Link from ${from} to ${to}, of the whole run: ${numberText(messages)} messages, ${numberText(bytes)} bytes, held for ` +
    `${percentText(held / data.total_ns)} of it, waited for ${timeText(waited / 1e6)}.`;
};

// Who gets what from whom

const startPairs = (box) => {
  const {what, row, column, side} = data.pairs, pair = (from, to) => ({node: within(from, side), peer: within(to, side)});
  machine.pairs = makeCanvas("pairs", `How many ${what}: rows are the ${row}, columns the ${column}`, box,
    (x, y) => pair(y * side, x * side), (right, down) => state.peer < 0 ? pair(0, 1) : pair(state.node + down, state.peer + right));
  const counts = unpacked(data.pairs.counts), full = machine.counts = data.pairs.places ? new Float64Array(side * side) : counts;
  if (data.pairs.places) unpacked(data.pairs.places).forEach((place, i) => { full[place] = counts[i]; });
  let most = 1;
  for (const count of full) if (count > most) most = count;
  machine.mostPairs = most;
  const baked = machine.bakedPairs = document.createElement("canvas");
  baked.width = baked.height = side;
  const pen = baked.getContext("2d"), image = pen.createImageData(side, side), out = new Uint32Array(image.data.buffer);
  for (let i = 0; i < out.length; ++i) out[i] = heatColors[Math.round(Math.sqrt(full[i] / most) * 255)];
  pen.putImageData(image, 0, 0);
};
const drawPairs = () => {
  const [pen, size] = square(machine.pairs), {side} = data.pairs, cell = size / side, choice = chosen(), bright = brightNodes(choice);
  pen.imageSmoothingEnabled = side > size;
  pen.globalAlpha = bright.size ? 0.3 : 1;
  pen.drawImage(machine.bakedPairs, 0, 0, size, size);
  pen.globalAlpha = 1;
  pen.strokeStyle = "#e03030";
  const least = Math.max(cell, 2), show = (x, y, wide, high) => {
    pen.drawImage(machine.bakedPairs, x, y, wide, high, x * cell, y * cell, wide * cell, high * cell);
    pen.strokeRect(x * cell, y * cell, Math.max(least, wide * cell), Math.max(least, high * cell));
  };
  if (choice.peer >= 0) show(choice.peer, choice.node, 1, 1);
  else for (const node of bright) if (node < side) {
    show(0, node, side, 1);
    show(node, 0, 1, side);
  }
};
const pairText = ({node, peer}) => {
  const count = numberText(machine.counts[node * data.pairs.side + peer]), name = (number) => number >= data.nodes ? "the host" : "node " + number;
  return data.pairs.what === "pages" ? `Of the whole run: ${count} pages fetched by ${name(node)} from ${name(peer)}.` :
    `Of the whole run: ${count} rays sent by ${name(node)} to ${name(peer)}.`;
};

// The hottest pages, each a bar

const startPages = (box) => {
  const count = data.pages.length;
  machine.pages = makeCanvas("pages", "The hottest pages, by how often they were fetched. The table of pages below has the first of them.", box,
    (x) => ({page: within(x * count, count)}), (right, down) => ({page: within(state.page + right + down, count)}));
};
const drawPages = () => {
  const [pen, wide] = square(machine.pages, 90), choice = chosen(), bright = brightNodes(choice), width = wide / data.pages.length, most = data.pages[0][2];
  data.pages.forEach(([, home, fetched], i) => {
    const height = 86 * fetched / most, isBright = choice.page >= 0 ? i === choice.page : bright.size === 0 || bright.has(home);
    pen.globalAlpha = isBright ? 1 : 0.2;
    pen.fillStyle = i === choice.page ? "#e03030" : workColors.paging;
    pen.fillRect(i * width, 90 - height, Math.max(1, width - 0.5), height);
  });
  pen.globalAlpha = 1;
};
const pageText = (page) => {
  const [number, home, fetched] = data.pages[page];
  return `Page ${number}, the ${page + 1}. of the hottest: at home on ${home >= data.nodes ? "the host" : "node " + home}, fetched ` +
    `${numberText(fetched)} times, ${percentText(fetched / data.fetched)} of all fetches.`;
};
