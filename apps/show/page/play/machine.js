// The machine by its topology: a grid, a hypercube by Gray code, a tree in levels, else a ring or, of many nodes, rows; links as thick
// and as red as they were held, one way and the other apart.
cards.push({id: "machine", headingOf: () => "The machine", start: (run, box) => {
  const {nodes, links, over} = run, beside = (number, step, count) => (Math.max(number, step > 0 ? -1 : 0) + step + count) % count;
  const machine = run.machine = {places: new Map()};
  machine.canvas = makeCanvas(run, "machine", "Nodes by how much they compute, and links by how long they were held. The tables of nodes and links below say the same.", box,
    (x, y) => partAt(run, x, y), (right, down) => right || !links.length ? {node: beside(state.node, right || down, nodes)} : {link: beside(state.link, down, links.length)});
  make("p", {class: "note"}, box, "Discs: computing at that time. " + (over.links ? "Links: bytes at that time." : links.length ? "Links: held over the whole run." : "Links are known of modelled machines."));
  placeMachine(run);
  part(() => stepKey() + choiceKey(chosen()), () => drawMachine(run));
}});
sayings.push((run, {node, peer, link, page}) => run.links[link] ? linkText(run, run.links[link], link) :
  node >= 0 && peer < 0 && page < 0 ? nodeText(run, node) : "");

/// The number whose Gray code this is.
const fromGray = (code) => {
  let number = 0;
  for (; code; code >>= 1) number ^= code;
  return number;
};
/// Middles of nodes and of places without one, 0 to 1 each way, by number.
const placer = ({nodes, topology, machine}) => {
  const {kind, columns} = topology || {}, half = Math.ceil(Math.ceil(Math.log2(nodes)) / 2);
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
const switchPlace = ({nodes, topology: {uplinks}}, number) => {
  const levels = [];
  for (let first = 0, count = nodes, copies = 1; count > 1; copies *= uplinks) {
    count = Math.ceil(count / 4);
    levels.push({first, count, copies});
    first += count * copies;
  }
  const level = levels.findLastIndex(({first}) => first <= number), {first, count, copies} = levels[level], at = number - first;
  return [(Math.floor(at / copies) + (at % copies + 0.5) / copies) / count, 0.88 - 0.76 * (level + 1) / levels.length];
};
const placeMachine = (run) => {
  const {machine: {places}} = run, placeOf = placer(run);
  for (let node = 0; node < run.nodes; ++node) places.set("node " + node, placeOf(node));
  for (const link of run.links) for (const name of link.slice(0, 2)) {
    const [what, number] = name.split(" ");
    if (!places.has(name) && what !== "memory") places.set(name, what === "host" ? [0.02, 0.04] : what === "switch" ? switchPlace(run, +number) : placeOf(+number));
  }
};
/// A link's two ends and what its curve bends to, more where it passes others.
const bowOf = ({nodes, topology, machine: {places, cell}}, [fromName, toName]) => {
  const from = places.get(fromName), to = places.get(toName);
  if (!from || !to) return null;
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]], bend = topology.kind !== "fat-tree" && Math.hypot(dx, dy) > 1.6 * cell && nodes > 2 ? 0.2 : 0.06;
  return [from, [(from[0] + to[0]) / 2 + bend * dy, (from[1] + to[1]) / 2 - bend * dx], to];
};
/// Those that can be drawn, by number and bow: of more nodes than can be told apart only links that are chosen.
const bowsShown = (run, choice, bright) => run.links.map((link, i) => [i, bowOf(run, link)]).filter(([i, bow]) => bow &&
  (run.nodes <= barsMax || isChosenLink(run, choice, i) || touches(run, i, bright)));
const isChosenLink = ({index}, {run, link}, i) => run === index && link === i;
const touches = (run, i, bright) => run.links[i].slice(0, 2).some((name) => bright.has(nodeOf(run, name)));
const partAt = (run, x, y) => {
  const {nodes, machine: {places, cell}} = run;
  let best = {}, nearest = Math.max(0.39 * cell, 0.006);
  for (let node = 0; node < nodes; ++node) {
    const [a, b] = places.get("node " + node), far = Math.hypot(a - x, b - y);
    if (far < nearest) [best, nearest] = [{node}, far];
  }
  if ("node" in best) return best;
  nearest = 0.015;
  for (const [link, bow] of bowsShown(run, state, brightNodes(run, state))) {
    for (let i = 0; i <= 16; ++i) {
      const t = i / 16, [px, py] = [0, 1].map((k) => (1 - t) ** 2 * bow[0][k] + 2 * t * (1 - t) * bow[1][k] + t * t * bow[2][k]), far = Math.hypot(px - x, py - y);
      if (far < nearest) [best, nearest] = [{link}, far];
    }
  }
  return best;
};
const drawMachine = (run) => {
  const {nodes, works, over, machine: {places, cell, canvas}} = run, choice = chosen(), bright = brightNodes(run, choice), [pen, size] = square(canvas);
  const dims = hasChoice(choice), radius = 0.3 * cell * size, shown = stepsShown(run);
  for (const [i, bow] of bowsShown(run, choice, bright)) {
    const held = over.links ? heatOf("links", over, i) : run.links[i][4] / run.total_ns, isChosen = isChosenLink(run, choice, i);
    pen.globalAlpha = !dims || isChosen || (choice.link < 0 && touches(run, i, bright)) ? 1 : 0.12;
    pen.strokeStyle = `hsl(${Math.round(210 - 210 * Math.min(1, 2 * held))} 75% 50%)`;
    pen.lineWidth = 1 + Math.min(8, 0.2 * cell * size) * held + (isChosen ? 2 : 0);
    pen.beginPath();
    const [from, bend, to] = bow.map(([x, y]) => [x * size, y * size]);
    pen.moveTo(...from);
    pen.quadraticCurveTo(...bend, ...to);
    pen.stroke();
  }
  label(pen, "center");
  for (const [name, [x, y]] of places) {
    const node = nodeOf(run, name), isNode = node >= 0 && node < nodes;
    pen.globalAlpha = !dims || bright.has(node) ? 1 : 0.25;
    pen.fillStyle = css("card");
    pen.beginPath();
    if (isNode) pen.arc(x * size, y * size, radius, 0, 7);
    else pen.rect(x * size - 4, y * size - 4, 8, 8);
    pen.fill();
    if (isNode) {
      const computing = works.reduce((sum, work) => sum + (work.name === "tracing" || work.name === "shading" ? shareOf(work, node, shown) : 0), 0);
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
const nodeText = (run, node) => node > run.nodes ? "No such node." : node === run.nodes ? "The host." :
  `Node ${node}, ${partText()}: ` + sharesOf(run, [node]).filter(([name, share]) => share >= 0.0005 || name === run.rest).map(([name, share]) => `${name} ${percentText(share)}`).join(", ") + ".";
const linkText = ({over, total_ns}, [from, to, messages, bytes, held, waited], link) =>
  `Link from ${from} to ${to}, of the whole run: ${numberText(messages)} messages, ${numberText(bytes)} bytes, held for ` +
    `${percentText(held / total_ns)} of it, waited for ${timeText(waited / 1e6)}.` + (over.links ? ` ${partText()}: about ${numberText(countOf(over.links, link))} bytes.` : "");
