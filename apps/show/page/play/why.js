// Why: the chain of causes that led to the end of a wait, or of the run, message by message back to the start.
const causes = data.causes && Object.fromEntries(Object.entries(data.causes).map(([key, value]) => [key, value.data === undefined ? value : unpacked(value)]));
const why = {chains: new Map(), key: null, chain: []};
const stepsListed = 200;
most.why = causes ? causes.node.length : -1;

/// A node's waits are numbered from one number up to another.
const waitsOf = (node) => {
  if (!why.first) {
    why.first = new Uint32Array(data.nodes + 2);
    for (const of of causes.node) ++why.first[of + 1];
    for (let i = 1; i < why.first.length; ++i) why.first[i] += why.first[i - 1];
  }
  return [why.first[node], why.first[node + 1]];
};
const endOf = (wait) => causes.begin[wait] + causes.length[wait];
/// The last wait of a node that was over at a time; -1: none.
const lastWait = (node, ns) => {
  const [first, end] = waitsOf(node);
  let [low, high] = [first, end];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (endOf(middle) <= ns) low = middle + 1;
    else high = middle;
  }
  return low - 1 >= first ? low - 1 : -1;
};
const waitAt = (node, ns) => {
  const next = lastWait(node, ns) + 1 || waitsOf(node)[0];
  return next < waitsOf(node)[1] && causes.begin[next] <= ns ? next : -1;
};
/// Steps back to the start: a wait, and the busy time of a node after it, until `to` it sent what ended the next wait.
const chainOf = (node, ns) => {
  const chain = [], seen = new Set();
  for (let at = [node, ns];;) {
    let wait = lastWait(...at);
    while (seen.has(wait)) wait = wait > waitsOf(at[0])[0] ? wait - 1 : -1;  // where nothing takes any time
    chain.push({node: at[0], wait, to: at[1], from: wait < 0 ? 0 : endOf(wait)});
    if (wait < 0) return chain;
    seen.add(wait);
    at = [causes.from[wait], endOf(wait) - causes.at[wait]];
  }
};
/// Of the state: a wait by its number, or beyond those the end of the run.
const chainShown = () => {
  if (!causes || state.why < 0) return [];
  if (why.key !== state.why) {
    const {node, from_ns} = data.path, wait = state.why;
    why.chain = wait < causes.node.length ? [{node: causes.node[wait], wait, to: endOf(wait), from: endOf(wait)}, ...chainOf(causes.from[wait], endOf(wait) - causes.at[wait])] :
      chainOf(node, from_ns);
    why.key = state.why;
  }
  return why.chain;
};
const msText = (ns) => (ns / 1e6).toFixed(totalMs < 1 ? 6 : totalMs < 1000 ? 4 : 1) + " ms";
const stepText = ({node, wait, to, from}) => {
  const busy = to > from ? `, then was at work for ${msText(to - from)}, until ${msText(to)}` : "";
  if (wait < 0) return `From the start ${hostOr(node)} was at work until ${msText(to)}.`;
  const request = causes.kinds[causes.request[wait]], left = msText(endOf(wait) - causes.left[wait]), peer = hostOr(causes.peer[wait]);
  const asker = causes.from[wait], at = msText(endOf(wait) - causes.at[wait]);
  const asked = !request ? "" : asker === node ? `, which answered a ${request} that it had sent at ${at}` : `, which had been serving others since a ${request} that ${hostOr(asker)} had sent at ${at}`;
  return `${hostOr(node)} waited for ${msText(causes.length[wait])} until ${msText(endOf(wait))}, for a ${causes.kinds[causes.kind[wait]]} that ${peer} sent at ${left}${asked}${busy}.`;
};

const startWhy = (box) => {
  const pathEnd = causes.node.length, button = make("button", {type: "button", id: "path"}, box, "Show the critical path");
  button.addEventListener("click", () => showWhy(state.why === pathEnd ? -1 : pathEnd));
  const sum = make("p", {id: "why-sum"}, box), list = make("ol", {id: "why", tabindex: 0, role: "region", "aria-label": "The chain of causes"}, box);
  make("p", {class: "note"}, box, "Exact, of the whole run: " + [...data.path.parts, ...data.path.kinds.map(({name, ns}) => ({name: "for " + name, ns}))]
    .map(({name, ns}) => `${name} ${percentText(ns / data.total_ns)}`).join(", ") + `; ${numberText(data.path.messages)} messages.` +
    (causes.left_out_ns > 0 ? ` Chains leave out waits up to ${msText(causes.left_out_ns)}: ${numberText(causes.node.length)} of ${numberText(causes.count)} are kept.` : ""));
  part(() => state.why, () => {
    const chain = chainShown();
    button.textContent = state.why === pathEnd ? "Hide the critical path" : "Show the critical path";
    sum.textContent = !chain.length ? "A click on a wait in the rows of time, or W there, shows what led to its end, message by message back to the start." :
      `${state.why === pathEnd ? "The run ended when it did" : "The wait ended when it did"} after ${numberText(chain.length - 1)} waits of ${numberText(new Set(chain.map(({node}) => node)).size)} nodes; last first:`;
    list.replaceChildren(...chain.slice(0, stepsListed).map((step) => make("li", {}, null, stepText(step))));
    if (chain.length > stepsListed) make("li", {}, list, `And ${numberText(chain.length - stepsListed)} more, back to the start.`);
  });
};
const showWhy = (wait) => {
  state.why = wait;
  writeAddress();
  changed();
};
/// Over the rows: along a node while it was at work, across where messages went.
const drawWhy = (pen, wide, height) => {
  const chain = chainShown(), row = height / data.nodes, place = (node, ns) => [ns / data.total_ns * wide, Math.min(node + 0.5, data.nodes) * row];
  if (!chain.length) return;
  pen.beginPath();
  pen.moveTo(...place(chain[0].node, chain[0].to));
  for (const {node, wait, from} of chain) {
    pen.lineTo(...place(node, from));
    if (wait < 0) break;
    if (causes.request[wait] < causes.kinds.length) pen.lineTo(...place(causes.peer[wait], endOf(wait) - causes.left[wait]));
    pen.lineTo(...place(causes.from[wait], endOf(wait) - causes.at[wait]));
  }
  for (const [width, color] of chain.length > stepsListed ? [[0.6, css("ink")]] : [[4, css("paper")], [1.5, css("ink")]]) {
    [pen.lineWidth, pen.strokeStyle] = [width, color];
    pen.stroke();
  }
  pen.lineWidth = 1;
};
