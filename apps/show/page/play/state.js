// What is shown: one state, from which all that is drawn follows and which stands in the address.

/// Whole numbers as the page has them: little-endian, as are all computers that browsers run on.
const unpacked = ({type, data: text}) => {
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
  return new {u1: Uint8Array, u2: Uint16Array, u4: Uint32Array, f8: Float64Array}[type](bytes.buffer);
};
const done = unpacked(data.done);
const fields = Object.fromEntries(data.fields.map((field) => [field.name, {...field, values: unpacked(field.values)}]));
const restName = data.clock === "virtual time" ? "idle at the end" : "waiting for a core";
/// What nodes did, then what they waited for; what is left of a step is the rest.
const works = [...data.works, ...data.waits.filter(({name}) => name !== restName)].map((work) => ({...work, shares: unpacked(work.shares)}));
const totalMs = data.total_ns / 1e6, stepMs = data.step_ns / 1e6;
const stepCount = Math.min(data.steps, Math.ceil(data.total_ns / data.step_ns));

/// What is chosen, or under the pointer: nothing where a number is -1. A pair is a node and a peer.
const nothing = {node: -1, peer: -1, link: -1, page: -1, x: -1, y: -1};
const state = {t: totalMs, from: 0, to: 0, heat: "", mix: 70, why: -1, ...asked, ...nothing};
let pointed = null;
const chosen = () => pointed || state;
const choose = (choice) => Object.assign(state, nothing, choice);
const hasChoice = ({node, link, page}) => node >= 0 || link >= 0 || page >= 0;

const hostOr = (node) => node >= data.nodes ? "the host" : "node " + node;
/// "node 3" and "host" as numbers; -1: a switch, or a place without a node.
const nodeOf = (name) => name === "host" ? data.nodes : name.startsWith("node ") ? Number(name.slice(5)) : -1;
/// The nodes that stay bright.
const brightNodes = ({node, peer, link, page}) => {
  const all = page >= 0 ? [data.pages[page][1]] : link >= 0 ? data.links[link].slice(0, 2).map(nodeOf) : [node, peer];
  return new Set(all.filter((number) => number >= 0));
};
/// Those of which sums are shown: the bright ones, or all.
const summed = (choice) => {
  const bright = [...brightNodes(choice)].filter((node) => node < data.nodes);
  return bright.length ? bright : [...Array(data.nodes).keys()];
};
const choiceKey = (choice) => [choice.node, choice.peer, choice.link, choice.page, choice.x, choice.y].join();

// The address: #t=15&from=10&to=14&heat=faults&mix=85&node=6; one without "=" leads to a section.
const usual = {...state}, most = {t: totalMs, from: totalMs, to: totalMs, mix: 100, cache: Infinity, dots: 1, node: data.nodes, peer: data.nodes,
  link: data.links.length - 1, page: data.pages.length - 1, x: data.wide - 1, y: data.high - 1};
const isNumber = (key) => key in nothing || key === "why";
const readAddress = () => {
  for (const [key, text] of new URLSearchParams(location.hash.includes("=") ? location.hash.slice(1) : "")) {
    const value = Math.max(isNumber(key) ? -1 : 0, Math.min(most[key], parseFloat(text)));
    if (key === "heat" ? text === "done" || Object.hasOwn(fields, text) : value >= -1) state[key] = key === "heat" ? text : isNumber(key) ? Math.round(value) : value;
  }
  state.to = Math.max(state.from, state.to);
};
const writeAddress = () => {
  const said = Object.entries(state).filter(([key, value]) => value !== usual[key]);
  history.replaceState(null, "", "#" + (said.map(([key, value]) => key + "=" + (Number.isInteger(value) || key === "heat" ? value : value.toPrecision(6))).join("&") || "t=" + totalMs));
};

/// Steps of the brush, or else the one of now: first and last.
const stepsShown = () => {
  const step = (ms) => Math.max(0, Math.min(stepCount - 1, Math.floor(ms / stepMs)));
  return state.to > state.from ? [step(state.from), step(state.to * (1 - 1e-9))] : [step(state.t), step(state.t)];
};
/// What passed over time, by row and step: in the steps shown how many of a row, and how that is to the most of any row.
const overTime = ({step_ns, steps, most, values: packed}) => {
  const values = unpacked(packed), stepOf = (ms) => Math.max(0, Math.min(steps - 1, Math.floor(ms * 1e6 / step_ns)));
  const shown = () => state.to > state.from ? [stepOf(state.from), stepOf(state.to * (1 - 1e-9))] : [stepOf(state.t), stepOf(state.t)];
  let largest = 1;
  for (const value of values) if (value > largest) largest = value;
  const sum = (row) => {
    let all = 0;
    for (let [step, last] = shown(); step <= last; ++step) all += values[row * steps + step];
    return all;
  };
  return {count: (row) => Math.round(sum(row) * most / 255), share: (row) => sum(row) / largest / (shown()[1] - shown()[0] + 1),
    at: (step) => values[step] / largest, most: largest * most / 255, step_ns, steps};
};
const {levels = [], ...overs} = data.over || {};
const over = Object.fromEntries(Object.entries(overs).map(([name, rows]) => [name, overTime(rows)]));
/// The share of a node's time in steps that it did a work, 0 to 1.
const shareOf = (work, node, first, last) => {
  let sum = 0;
  for (let step = first, at = node * data.steps; step <= last; ++step) sum += works[work].shares[at + step];
  return sum / 255 / (last - first + 1);
};

const timeText = (ms) => ms.toFixed(totalMs < 1 ? 4 : totalMs < 1000 ? 2 : 0) + " ms";

/// A canvas for those who see it, with words for those who do not. What is at a place, 0 to 1 each way, is chosen by the pointer,
/// what lies so many steps to the right and down from what was chosen before by arrow keys.
const makeCanvas = (id, label, parent, at, beside) => {
  const canvas = make("canvas", {id, role: "img", tabindex: 0, "aria-label": label}, parent);
  if (at) canvas.addEventListener("pointermove", (event) => point({...nothing, ...at(...placeIn(canvas, event))}));
  if (beside) canvas.addEventListener("keydown", (event) => {
    const move = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
    if (!move) return;
    event.preventDefault();
    settle({...nothing, ...beside(...move)});
  });
  return canvas;
};
const within = (number, count) => Math.max(0, Math.min(count - 1, Math.floor(number)));

/// Colours as 0xAABBGGRR, as they lie in an image's memory.
const packedColor = (red, green, blue) => (255 << 24 | blue << 16 | green << 8 | red) >>> 0;
const channels = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
const packedHex = (hex) => (packedColor(...channels(hex)) & 0xffffff | parseInt(hex.slice(7) || "ff", 16) << 24) >>> 0;
/// The map inferno of the page's other pictures, straight between ten of its colours.
const heatStops = ["#000004", "#1b0c41", "#4a0c6b", "#781c6d", "#a52c60", "#cf4446", "#ed6925", "#fb9b06", "#f7d13d", "#fcffa4"].map(channels);
const heatColors = Uint32Array.from({length: 256}, (unused, i) => {
  const at = Math.min(8, Math.floor(i / 255 * 9)), part = i / 255 * 9 - at;
  return packedColor(...heatStops[at].map((low, k) => Math.round(low + (heatStops[at + 1][k] - low) * part)));
});
/// Nodes have twelve hues, neighbours apart.
const nodeColors = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#a03030", "#8c6d46", "#6a4fb0", "#86b300", "#2f7f8f", "#d98f8f"].map(packedHex);
/// Work strong, waits pale.
const workColors = {tracing: "#0072b2", shading: "#56b4e9", paging: "#009e73", packing: "#cc79a7", messages: "#e69f00", control: "#8c6d46", "page wait": "#009e7370", "answer wait": "#009e7370",
  "ray wait": "#cc79a780", "work wait": "#e6c30070", "token wait": "#6a4fb080", "credit wait": "#d55e0080", "film wait": "#56b4e980", "other waits": "#80808080", "idle at the end": "#80808040"};
