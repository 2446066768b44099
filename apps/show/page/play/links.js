// The machine by its topology: a grid, a hypercube by Gray code, a tree in levels, else as other machines; links as thick and as red as
// they were held, one way and the other apart.

/// The number whose Gray code this is.
const fromGray = (code) => {
  let number = 0;
  for (; code; code >>= 1) number ^= code;
  return number;
};
placerOf = (run) => {
  const {nodes, machine} = run, {kind, columns} = run.topology || {}, half = Math.ceil(Math.ceil(Math.log2(nodes)) / 2), side = 2 ** half;
  if (kind === "hypercube") return rowsOf(machine, 2 ** Math.ceil(Math.log2(nodes)), side, (number) => [fromGray(number % side), fromGray(number >> half)]);
  if (kind === "mesh" || kind === "torus") return rowsOf(machine, nodes, columns);
  if (kind !== "fat-tree") return ringOrRows(run);
  const deep = nodes <= barsMax ? 1 : 4, wide = Math.ceil(nodes / deep);
  machine.cell = 1 / wide;
  return (number) => [(Math.floor(number / deep) + 0.5) / wide, 0.96 - 0.03 * (deep - 1 - number % deep)];
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
placeOthers = (run, placeOf) => {
  const {places} = run.machine;
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
linkAt = (run, x, y) => {
  let best = {}, nearest = 0.015;
  for (const [link, bow] of bowsShown(run, state, brightNodes(run, state))) {
    for (let i = 0; i <= 16; ++i) {
      const t = i / 16, [px, py] = [0, 1].map((k) => (1 - t) ** 2 * bow[0][k] + 2 * t * (1 - t) * bow[1][k] + t * t * bow[2][k]), far = Math.hypot(px - x, py - y);
      if (far < nearest) [best, nearest] = [{link}, far];
    }
  }
  return best;
};
drawLinks = (run, pen, size, choice, bright) => {
  for (const [i, bow] of bowsShown(run, choice, bright)) {
    const held = run.over.links ? heatOf("links", run.over, i) : run.links[i][4] / run.total_ns, isChosen = isChosenLink(run, choice, i);
    pen.globalAlpha = !hasChoice(choice) || isChosen || (choice.link < 0 && touches(run, i, bright)) ? 1 : 0.12;
    pen.strokeStyle = `hsl(${Math.round(210 - 210 * Math.min(1, 2 * held))} 75% 50%)`;
    pen.lineWidth = 1 + Math.min(8, 0.2 * run.machine.cell * size) * held + (isChosen ? 2 : 0);
    pen.beginPath();
    const [from, bend, to] = bow.map(([x, y]) => [x * size, y * size]);
    pen.moveTo(...from);
    pen.quadraticCurveTo(...bend, ...to);
    pen.stroke();
  }
};
sayings.unshift((run, {link}) => run.links[link] ? linkText(run, run.links[link], link) : "");
const linkText = ({over, total_ns}, [from, to, messages, bytes, held, waited], link) =>
  `Link from ${from} to ${to}, of the whole run: ${numberText(messages)} messages, ${numberText(bytes)} bytes, held for ` +
    `${percentText(held / total_ns)} of it, waited for ${timeText(waited / 1e6)}.` + (over.links ? ` ${partText()}: about ${numberText(countOf(over.links, link))} bytes.` : "");
