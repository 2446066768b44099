// The machine: nodes as a ring or, if there are many, in rows; by its topology, with links, where links.js is there.

/// Of nodes, by number, and of other places, by name: the middle, 0 to 1 each way.
let placerOf = (run) => ringOrRows(run), placeOthers = () => {};
/// Between them, below the nodes; which one is at a place: {} if none is.
let drawLinks = () => {}, linkAt = () => ({});
cards.push({id: "machine", headingOf: () => "The machine", start: (run, box) => {
  const {nodes, links, over} = run, beside = (number, step, count) => (Math.max(number, step > 0 ? -1 : 0) + step + count) % count;
  const machine = run.machine = {places: new Map()};
  machine.canvas = makeCanvas(run, "machine", "Nodes by how much they compute, and links by how long they were held. The tables of nodes and links below say the same.", box,
    (x, y) => partAt(run, x, y), (right, down) => right || !links.length ? {node: beside(state.node, right || down, nodes)} : {link: beside(state.link, down, links.length)});
  make("p", {class: "note"}, box, "Discs: computing in the time shown. " + (over.links ? "Links: bytes in the time shown." : links.length ? "Links: held over the whole run." : ""));
  const placeOf = placerOf(run);
  for (let node = 0; node < nodes; ++node) machine.places.set("node " + node, placeOf(node));
  placeOthers(run, placeOf);
  part(() => stepKey() + choiceKey(chosen()), () => drawMachine(run));
}});
sayings.push((run, {node, peer}) => node >= 0 && peer < 0 ? nodeText(run, node) : "");

/// Middles in rows of so many cells, by what gives a number's column and row.
const rowsOf = (machine, count, wide, cellOf = (number) => [number % wide, Math.floor(number / wide)]) => {
  const high = Math.ceil(count / wide);
  machine.cell = 1 / Math.max(wide, high);
  return (number) => {
    const [column, row] = cellOf(number);
    return [(column + 0.5) / wide, 0.08 + 0.92 * (row + 0.5) / high];
  };
};
const ringOrRows = ({nodes, machine}) => {
  if (nodes > barsMax) return rowsOf(machine, nodes, Math.ceil(Math.sqrt(nodes)));
  machine.cell = Math.min(0.15, 2.75 / Math.max(8, nodes));
  return (number) => [0.5 + 0.42 * Math.sin(2 * Math.PI * number / nodes), 0.52 - 0.42 * Math.cos(2 * Math.PI * number / nodes)];
};
const partAt = (run, x, y) => {
  const {nodes, machine: {places, cell}} = run;
  let best = {}, nearest = Math.max(0.39 * cell, 0.006);
  for (let node = 0; node < nodes; ++node) {
    const [a, b] = places.get("node " + node), far = Math.hypot(a - x, b - y);
    if (far < nearest) [best, nearest] = [{node}, far];
  }
  return "node" in best ? best : linkAt(run, x, y);
};
/// Of the nodes' time by name what closing lines sum up as computing.
const computes = (name) => ["tracing", "shading", "installing", "packing", "overhead"].includes(name);
const drawMachine = (run) => {
  const {nodes, works, machine: {places, cell, canvas}} = run, choice = chosen(), bright = brightNodes(run, choice), [pen, size] = square(canvas);
  const dims = hasChoice(choice), radius = 0.3 * cell * size, shown = stepsShown(run);
  drawLinks(run, pen, size, choice, bright);
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
      const computing = works.reduce((sum, work) => sum + (computes(work.name) ? shareOf(work, node, shown) : 0), 0);
      pen.fillStyle = partColors.tracing;
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
const sharesText = (shares, {rest}) => shares.filter(([name, share]) => share >= 0.0005 || name === rest).map(([name, share]) => `${name} ${percentText(share)}`).join(", ");
const nodeText = (run, node) => node > run.nodes ? "No such node." : node === run.nodes ? "The host." : `Node ${node}, ${partText()}: ${sharesText(sharesOf(run, [node]), run)}.`;
