// What is shown: one state, from which all that is drawn follows and which stands in the address.

/// What is chosen, or under the pointer: nothing where a number is -1. A pair is a node and a peer.
const nothing = {node: -1, peer: -1, link: -1, page: -1, x: -1, y: -1};
const state = {t: totalMs, from: 0, to: 0, heat: "", mix: 70, run: 0, why: -1, ...nothing};
let pointed = null;
const chosen = () => pointed || state;
/// Under the pointer a moment, in ms, where it is over the rows of time; else -1. All but the picture shows that moment.
const moment = () => pointed && "at" in pointed ? pointed.at : -1;
const hasChoice = ({node, link, page}) => node >= 0 || link >= 0 || page >= 0;
const choiceKey = ({run, node, peer, link, page, x, y, at = -1}) => [run, node, peer, link, page, x, y, at].join();

/// The nodes of a run that stay bright. A link and a page are of the run that is chosen.
const brightNodes = (run, {run: of, node, peer, link, page, x, y}) => {
  const [hot, busy] = of === run.index ? [run.pages[page], run.links[link]] : [];
  const all = x >= 0 ? [run.fields.node && x < run.wide && y < run.high ? run.fields.node.values[y * run.wide + x] : -1] :
    page >= 0 ? hot ? [hot[1]] : [] : link >= 0 ? busy ? busy.slice(0, 2).map((name) => nodeOf(run, name)) : [] : [node, peer];
  return new Set(all.filter((number) => number >= 0));
};
/// Those of which sums are shown: the bright ones, or all.
const summed = (run, choice) => {
  const bright = [...brightNodes(run, choice)].filter((node) => node < run.nodes);
  return bright.length ? bright : [...Array(run.nodes).keys()];
};

// The address: #t=15&from=10&to=14&heat=faults&mix=85&node=6; one without "=" leads to a section.
const usual = {}, most = {t: totalMs, from: totalMs, to: totalMs, mix: 100, run: runs.length - 1, node: mostOf(({nodes}) => nodes), peer: mostOf(({nodes}) => nodes),
  link: mostOf(({links}) => links.length) - 1, page: mostOf(({pages}) => pages.length) - 1, x: mostOf(({wide}) => wide) - 1, y: mostOf(({high}) => high) - 1, why: -1};
const heats = [...new Set(runs.flatMap(({fields}) => Object.keys(fields))), "done"];
const readAddress = () => {
  for (const [key, text] of new URLSearchParams(location.hash.includes("=") ? location.hash.slice(1) : "")) {
    const least = key in nothing || key === "why" ? -1 : 0, value = Math.max(least, Math.min(most[key], parseFloat(text)));
    if (key === "heat") state.heat = heats.includes(text) ? text : state.heat;
    else if (value >= -1) state[key] = least < 0 || key === "run" ? Math.round(value) : value;
  }
  state.to = Math.max(state.from, state.to);
};
const writeAddress = () => {
  const said = Object.entries(state).filter(([key, value]) => value !== usual[key]);
  history.replaceState(null, "", "#" + (said.map(([key, value]) => key + "=" + (Number.isInteger(value) || key === "heat" ? value : value.toPrecision(6))).join("&") || "t=" + totalMs));
  changed();
};
const change = (parts) => {
  Object.assign(state, parts);
  writeAddress();
};

/// At the end, where a page opens, all of the run is shown, not its last moment.
const isWhole = () => state.to <= state.from && state.t >= totalMs;
/// Steps of the pointer's moment, of the brush, or else all, or the one of now: first and last. Beyond the end of a run there is none.
const stepsShown = ({step_ns, steps, total_ns}) => {
  const [from, to] = moment() >= 0 ? [moment(), moment()] : isWhole() ? [0, totalMs] : state.to > state.from ? [state.from, state.to * (1 - 1e-9)] : [state.t, state.t];
  const stepOf = (ms) => Math.max(0, Math.min(steps - 1, Math.ceil(total_ns / step_ns) - 1, Math.floor(ms * 1e6 / step_ns)));
  return from > total_ns / 1e6 ? [0, -1] : [stepOf(from), stepOf(to)];
};
/// How many steps that is; the last of a run ends with it.
const lengthOf = ({step_ns, total_ns}, [first, last]) => (Math.min(total_ns, (last + 1) * step_ns) - first * step_ns) / step_ns;
/// In the steps shown how many of a row, and how that is to the most of any row of any run.
const countOf = (rows, row) => Math.round(sumOf(rows, row, stepsShown(rows)) * rows.most / 255);
const heatOf = (name, {[name]: rows}, row) => {
  const shown = stepsShown(rows), peak = mostOf(({over}) => over[name] ? over[name].peak : 0);
  return sumOf(rows, row, shown) / rows.largest / Math.max(1, shown[1] - shown[0] + 1) * rows.peak / peak;
};
/// The share of a node's time in steps that it did a work, 0 to 1.
const shareOf = (work, node, shown) => Math.min(1, sumOf(work, node, shown) / 255 / (lengthOf(work, shown) || 1));
/// Of all works of some nodes, in the steps shown, and what is left; of all nodes in the whole run exactly.
const sharesOf = (run, nodes) => {
  const shown = stepsShown(run), isAll = nodes.length === run.nodes && lengthOf(run, shown) * run.step_ns >= run.total_ns;
  const shares = run.works.map((work) => [work.name, isAll ? work.ns / run.total_ns / run.nodes : nodes.reduce((sum, node) => sum + shareOf(work, node, shown), 0) / nodes.length]);
  return [...shares, [run.rest, Math.max(0, 1 - shares.reduce((sum, [, share]) => sum + share, 0))]];
};

/// Further parts of a run that scripts bring: {id, headingOf(run), which is nothing where a run has none, start(run, box), isWide}.
const cards = [];
/// What they do when all else is there.
const starters = [];
/// What they say of what is chosen: nothing where they do not know it.
const sayings = [];

const timeText = (ms) => ms.toFixed(totalMs < 1 ? 4 : totalMs < 1000 ? 2 : 0) + " ms";

/// A canvas for those who see it, with words for those who do not. What is at a place, 0 to 1 each way, is chosen by the pointer,
/// what lies so many steps to the right and down from what was chosen before by arrow keys.
const makeCanvas = (run, id, label, parent, at, beside) => {
  const letter = letterOf(run), canvas = make("canvas", {id: id + (run.index || ""), role: "img", tabindex: 0, "aria-label": (letter && letter + ": ") + label}, parent);
  const chosenBy = (choice) => ({...nothing, run: run.index, ...choice});
  if (at) canvas.addEventListener("pointermove", (event) => point(chosenBy(at(...placeIn(canvas, event)))));
  canvas.addEventListener("pointerleave", () => point(nothing));
  canvas.addEventListener("click", () => { if (pointed) settle(pointed); });
  if (beside) canvas.addEventListener("keydown", (event) => {
    const move = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
    if (!move) return;
    event.preventDefault();
    settle(chosenBy(beside(...move)));
  });
  return canvas;
};
const within = (number, count) => Math.max(0, Math.min(count - 1, Math.floor(number)));

/// Colours as 0xAABBGGRR, as they lie in an image's memory.
const packedColor = (red, green, blue) => (255 << 24 | blue << 16 | green << 8 | red) >>> 0;
const packedHex = (hex) => (packedColor(...channels(hex)) & 0xffffff | parseInt(hex.slice(7) || "ff", 16) << 24) >>> 0;
const heatColors = Uint32Array.from({length: 256}, (unused, i) => packedColor(...heatAt(i / 255)));
/// Nodes have twelve hues, neighbours apart.
const nodeColors = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#a03030", "#8c6d46", "#6a4fb0", "#86b300", "#2f7f8f", "#d98f8f"].map(packedHex);
