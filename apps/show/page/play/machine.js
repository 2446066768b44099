// The nodes and what passes between them: the machine, who gets what from whom, the hottest pages.
const machine = {places: new Map()};
const label = (pen, align) => {
  pen.font = "11px system-ui,sans-serif";
  pen.textAlign = align;
};
const linkNames = (link) => data.links[link].slice(0, 2);

// The machine by its topology: a grid, a hypercube by Gray code, a tree in levels, else a ring or, of many nodes, rows; links as thick
// and as red as they were held, one way and the other apart

const startMachine = (box) => {
  const beside = (number, step, count) => (Math.max(number, step > 0 ? -1 : 0) + step + count) % count;
  machine.canvas = makeCanvas("machine", "Nodes by how much they compute, and links by how long they were held. The tables of nodes and links below say the same.", box,
    partAt, (right, down) => right || !data.links.length ? {node: beside(state.node, right || down, data.nodes)} : {link: beside(state.link, down, data.links.length)});
};
/// The number whose Gray code this is.
const fromGray = (code) => {
  let number = 0;
  for (; code; code >>= 1) number ^= code;
  return number;
};
/// Middles of nodes and of places without one, 0 to 1 each way, by number.
const placer = () => {
  const {nodes} = data, {kind, columns} = data.topology || {}, half = Math.ceil(Math.ceil(Math.log2(nodes)) / 2);
  const cells = (wide, cellOf) => {
    const high = Math.ceil((kind === "hypercube" ? 2 ** Math.ceil(Math.log2(nodes)) : nodes) / wide);
    machine.cell = 1 / Math.max(wide, high);
    return (number) => {
      const [column, row] = cellOf ? cellOf(number) : [number % wide, Math.floor(number / wide)];
      return [(column + 0.5) / wide, 0.08 + 0.92 * (row + 0.5) / high];
    };
  };
  if (kind === "hypercube") return cells(2 ** half, (number) => [fromGray(number % 2 ** half), fromGray(number >> half)]);
  if (kind === "mesh" || kind === "torus") return cells(columns);
  if (kind === "fat-tree") {
    const deep = nodes <= barsMax ? 1 : 4, wide = Math.ceil(nodes / deep);
    machine.cell = 1 / wide;
    return (number) => [(Math.floor(number / deep) + 0.5) / wide, 0.96 - 0.03 * (deep - 1 - number % deep)];
  }
  if (nodes > barsMax) return cells(Math.ceil(Math.sqrt(nodes)));
  machine.cell = Math.min(0.15, 2.75 / Math.max(8, nodes));
  return (number) => [0.5 + 0.42 * Math.sin(2 * Math.PI * number / nodes), 0.52 - 0.42 * Math.cos(2 * Math.PI * number / nodes)];
};
/// Each level's switches stand in the order of the nodes below them, those with the same nodes beside each other.
const switchPlace = (number) => {
  const levels = [];
  for (let first = 0, count = data.nodes, copies = 1; count > 1; copies *= data.topology.uplinks) {
    count = Math.ceil(count / 4);
    levels.push({first, count, copies});
    first += count * copies;
  }
  const level = levels.findLastIndex(({first}) => first <= number), {first, count, copies} = levels[level], at = number - first;
  return [(Math.floor(at / copies) + (at % copies + 0.5) / copies) / count, 0.88 - 0.76 * (level + 1) / levels.length];
};
const placeMachine = () => {
  const {places} = machine, placeOf = placer();
  for (let node = 0; node < data.nodes; ++node) places.set("node " + node, placeOf(node));
  for (const link of data.links) for (const name of link.slice(0, 2)) {
    const [what, number] = name.split(" ");
    if (!places.has(name) && what !== "memory") places.set(name, what === "host" ? [0.02, 0.04] : what === "switch" ? switchPlace(+number) : placeOf(+number));
  }
};
const nodeRadius = () => 0.3 * machine.cell;
/// A link's two ends and what its curve bends to, more where it passes others.
const bowOf = (link) => {
  const [from, to] = linkNames(link).map((name) => machine.places.get(name));
  if (!from || !to) return null;
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]], bend = data.topology.kind !== "fat-tree" && Math.hypot(dx, dy) > 1.6 * machine.cell && data.nodes > 2 ? 0.2 : 0.06;
  return [from, [(from[0] + to[0]) / 2 + bend * dy, (from[1] + to[1]) / 2 - bend * dx], to];
};
/// Of more nodes than can be told apart only links that are chosen.
const linksShown = (choice, bright) => data.links.map((link, i) => i).filter((i) =>
  data.nodes <= barsMax || i === choice.link || linkNames(i).some((name) => bright.has(nodeOf(name))));
const partAt = (x, y) => {
  let best = {}, nearest = Math.max(nodeRadius() * 1.3, 0.006);
  for (let node = 0; node < data.nodes; ++node) {
    const [a, b] = machine.places.get("node " + node), far = Math.hypot(a - x, b - y);
    if (far < nearest) [best, nearest] = [{node}, far];
  }
  if ("node" in best) return best;
  nearest = 0.015;
  for (const link of linksShown(state, brightNodes(state))) {
    const bow = bowOf(link);
    if (!bow) continue;
    let far = 1;
    for (let i = 0; i <= 16; ++i) {
      const t = i / 16, [px, py] = [0, 1].map((k) => (1 - t) ** 2 * bow[0][k] + 2 * t * (1 - t) * bow[1][k] + t * t * bow[2][k]);
      far = Math.min(far, Math.hypot(px - x, py - y));
    }
    if (far < nearest) [best, nearest] = [{link}, far];
  }
  return best;
};
const drawMachine = () => {
  const choice = chosen(), bright = brightNodes(choice), [first, last] = stepsShown(), [pen, size] = square(machine.canvas);
  const dims = hasChoice(choice), radius = nodeRadius() * size;
  for (const i of linksShown(choice, bright)) {
    const bow = bowOf(i), held = over.links ? over.links.share(i) : data.links[i][4] / data.total_ns;
    if (!bow) continue;
    pen.globalAlpha = !dims || i === choice.link || (choice.link < 0 && linkNames(i).some((name) => bright.has(nodeOf(name)))) ? 1 : 0.12;
    pen.strokeStyle = `hsl(${Math.round(210 - 210 * Math.min(1, 2 * held))} 75% 50%)`;
    pen.lineWidth = 1 + Math.min(8, 0.2 * machine.cell * size) * held + (i === choice.link ? 2 : 0);
    pen.beginPath();
    const [from, bend, to] = bow.map(([x, y]) => [x * size, y * size]);
    pen.moveTo(...from);
    pen.quadraticCurveTo(...bend, ...to);
    pen.stroke();
  }
  label(pen, "center");
  for (const [name, [x, y]] of machine.places) {
    const node = nodeOf(name), isNode = node >= 0 && node < data.nodes;
    pen.globalAlpha = !dims || bright.has(node) ? 1 : 0.25;
    pen.fillStyle = css("card");
    pen.beginPath();
    if (isNode) pen.arc(x * size, y * size, radius, 0, 7);
    else pen.rect(x * size - 4, y * size - 4, 8, 8);
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
  const rest = Math.max(0, 1 - said.reduce((sum, [, share]) => sum + share, 0));
  return `Node ${node}, ${partText()}: ` + [...said, [restName, rest]].map(([name, share]) => `${name} ${percentText(share)}`).join(", ") + ".";
};
const linkText = (link) => {
  const [from, to, messages, bytes, held, waited] = data.links[link];
  return `Link from ${from} to ${to}, of the whole run: ${numberText(messages)} messages, ${numberText(bytes)} bytes, held for ` +
    `${percentText(held / data.total_ns)} of it, waited for ${timeText(waited / 1e6)}.` + (over.links ? ` ${partText()}: about ${numberText(over.links.count(link))} bytes.` : "");
};

// Who gets what from whom

const startPairs = (box) => {
  const {what, row, column, side} = data.pairs, pair = (from, to) => ({node: within(from, side), peer: within(to, side)});
  machine.pairs = makeCanvas("pairs", `How many ${what}: rows are the ${row}, columns the ${column}`, box,
    (x, y) => pair(y * side, x * side), (right, down) => state.peer < 0 ? pair(0, 1) : pair(state.node + down, state.peer + right));
  const counts = unpacked(data.pairs.counts), full = machine.counts = data.pairs.places ? new Float64Array(side * side) : counts;
  if (data.pairs.places) unpacked(data.pairs.places).forEach((place, i) => { full[place] = counts[i]; });
  machine.mostPairs = 1;
  for (const count of full) if (count > machine.mostPairs) machine.mostPairs = count;
  machine.bakedPairs = document.createElement("canvas");
  machine.bakedPairs.width = machine.bakedPairs.height = side;
  bakePairs();
};
const bakePairs = () => {
  const {bakedPairs: {width: side}, counts, mostPairs} = machine, pen = machine.bakedPairs.getContext("2d");
  const image = pen.createImageData(side, side), out = new Uint32Array(image.data.buffer);
  for (let i = 0; i < out.length; ++i) out[i] = heatColors[Math.round(Math.sqrt(over.pairs ? over.pairs.share(i) : counts[i] / mostPairs) * 255)];
  pen.putImageData(image, 0, 0);
};
const drawPairs = () => {
  const [pen, size] = square(machine.pairs), {side} = data.pairs, cell = size / side, choice = chosen(), bright = brightNodes(choice);
  if (over.pairs) bakePairs();
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
  const at = node * data.pairs.side + peer, [who, whom] = [node, peer].map(hostOr), now = over.pairs ? `${partText()}: ${numberText(over.pairs.count(at))} ${data.over.pairs.what}. ` : "";
  return `${now}Of the whole run: ${numberText(machine.counts[at])} ` + (data.pairs.what === "pages" ? `pages fetched by ${who} from ${whom}.` : `rays sent by ${who} to ${whom}.`);
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
    pen.globalAlpha *= over.pages ? 0.35 : 1;
    pen.fillRect(i * width, 90 - height, Math.max(1, width - 0.5), height);
    if (!over.pages) return;
    pen.globalAlpha /= 0.35;
    pen.fillRect(i * width, 90 - 86 * over.pages.share(i), Math.max(1, width - 0.5), 86 * over.pages.share(i));
  });
  pen.globalAlpha = 1;
};
const pageText = (page) => {
  const [number, home, fetched] = data.pages[page];
  return `Page ${number}, the ${page + 1}. of the hottest: at home on ${hostOr(home)}, fetched ` +
    `${numberText(fetched)} times, ${percentText(fetched / data.fetched)} of all fetches.` +
    (over.pages ? ` ${partText()}: ${numberText(over.pages.count(page))}.` : "");
};
