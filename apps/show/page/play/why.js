// Why: the chain of causes that led to the end of a wait, or of the run, message by message back to the start.
const stepsListed = 200;
for (const run of runs) {
  if (run.causes) run.causes = Object.fromEntries(Object.entries(run.causes).map(([key, value]) => [key, value.data === undefined ? value : unpacked(value)]));
}
const pathEndOf = ({causes}) => causes ? causes.node.length : -1;
most.why = mostOf(pathEndOf);

/// A node's waits are numbered from one number up to another.
const waitsOf = ({causes, nodes}, node) => {
  if (!causes.first) {
    causes.first = new Uint32Array(nodes + 2);
    for (const of of causes.node) ++causes.first[of + 1];
    for (let i = 1; i < causes.first.length; ++i) causes.first[i] += causes.first[i - 1];
  }
  return [causes.first[node], causes.first[node + 1]];
};
const endOf = ({causes}, wait) => causes.begin[wait] + causes.length[wait];
/// The last wait of a node that was over at a time; -1: none.
const lastWait = (run, node, ns) => {
  const [first, end] = waitsOf(run, node);
  let [low, high] = [first, end];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (endOf(run, middle) <= ns) low = middle + 1;
    else high = middle;
  }
  return low - 1 >= first ? low - 1 : -1;
};
const waitAt = (run, node, ns) => {
  const [first, end] = waitsOf(run, node), next = lastWait(run, node, ns) + 1 || first;
  return next < end && run.causes.begin[next] <= ns ? next : -1;
};
/// Steps back to the start: a wait, and the busy time of a node after it, until `to` it sent what ended the next wait.
const chainOf = (run, node, ns) => {
  const {causes} = run, chain = [], seen = new Set();
  for (let to = ns;;) {
    let wait = lastWait(run, node, to);
    while (seen.has(wait)) wait = wait > waitsOf(run, node)[0] ? wait - 1 : -1;  // where nothing takes any time
    chain.push({node, wait, to, from: wait < 0 ? 0 : endOf(run, wait)});
    if (wait < 0) return chain;
    seen.add(wait);
    [node, to] = [causes.from[wait], endOf(run, wait) - causes.at[wait]];
  }
};
/// Of the state: a wait of the chosen run by its number, or beyond those the end of the run.
const chainShown = (run) => {
  const {causes, path: {node, from_ns}} = run, wait = state.why;
  if (state.run !== run.index || wait < 0) return [];
  if (causes.shown !== wait) causes.chain = wait >= pathEndOf(run) ? chainOf(run, node, from_ns) :
    [{node: causes.node[wait], wait, to: endOf(run, wait), from: endOf(run, wait)}, ...chainOf(run, causes.from[wait], endOf(run, wait) - causes.at[wait])];
  causes.shown = wait;
  return causes.chain;
};
const msText = (ns) => (ns / 1e6).toFixed(totalMs < 1 ? 6 : totalMs < 1000 ? 4 : 1) + " ms";
const stepText = (run, {node, wait, to, from}) => {
  const {causes} = run, name = (number) => nodeName(run, number), busy = to > from ? `, then was at work for ${msText(to - from)}, until ${msText(to)}` : "";
  if (wait < 0) return `From the start ${name(node)} was at work until ${msText(to)}.`;
  const end = endOf(run, wait), request = causes.kinds[causes.request[wait]], requester = causes.from[wait], at = msText(end - causes.at[wait]);
  const asked = !request ? "" : requester === node ? `, which answered a ${request} that it had sent at ${at}` : `, which had been serving others since a ${request} that ${name(requester)} had sent at ${at}`;
  return `${name(node)} waited for ${msText(causes.length[wait])} until ${msText(end)}, for a ${causes.kinds[causes.kind[wait]]} that ${name(causes.peer[wait])} sent at ${msText(end - causes.left[wait])}${asked}${busy}.`;
};

cards.push({id: "why", isWide: true, headingOf: ({causes, path}) => causes && path ? "Why it took so long" : "", start: (run, box) => {
  const {causes, path, total_ns, index} = run, isPath = () => state.why >= pathEndOf(run), id = (name) => name + (index || "");
  const button = make("button", {type: "button", id: id("path")}, box, "Show the critical path");
  button.addEventListener("click", () => change({run: index, why: isPath() ? -1 : pathEndOf(run)}));
  run.time.clicked.push((node) => change({run: index, why: waitAt(run, node, state.t * 1e6)}));
  const sum = make("p", {id: id("why-sum")}, box), place = make("div", {class: "why", tabindex: 0, role: "region", "aria-label": "The chain of causes" + letterOf(run)}, box), list = make("ol", {id: id("why")}, place);
  make("p", {class: "note"}, box, "Exact, of the whole run: " + [...path.parts, ...path.kinds.map(({name, ns}) => ({name: "for " + name, ns}))]
    .map(({name, ns}) => `${name} ${percentText(ns / total_ns)}`).join(", ") + `; ${numberText(path.messages)} messages.` +
    (causes.left_out_ns > 0 ? ` Chains leave out waits up to ${msText(causes.left_out_ns)}: ${numberText(causes.node.length)} of ${numberText(causes.count)} are kept.` : ""));
  part(() => [state.why, state.run].join(), () => {
    const chain = chainShown(run);
    button.textContent = chain.length && isPath() ? "Hide the critical path" : "Show the critical path";
    sum.textContent = !chain.length ? "A click on a wait in the rows of time, or W there, shows what led to its end, message by message back to the start." :
      `The ${isPath() ? "run" : "wait"} ended when it did after ${numberText(chain.length - 1)} waits of ${numberText(new Set(chain.map(({node}) => node)).size)} nodes; last first:`;
    list.replaceChildren(...chain.slice(0, stepsListed).map((step) => make("li", {}, null, stepText(run, step))));
    if (chain.length > stepsListed) make("li", {}, list, `And ${numberText(chain.length - stepsListed)} more, back to the start.`);
  });
}});
/// Over the rows: along a node while it was at work, across where messages went.
overRows.push((run, pen, wide, height) => {
  if (!run.causes || !run.path) return;
  const {causes, nodes} = run, chain = chainShown(run), row = height / nodes, goTo = (node, ns) => pen.lineTo(ns / 1e6 / totalMs * wide, Math.min(node + 0.5, nodes) * row);
  if (!chain.length) return;
  pen.beginPath();
  goTo(chain[0].node, chain[0].to);
  for (const {node, wait, from} of chain) {
    goTo(node, from);
    if (wait < 0) break;
    if (causes.request[wait] < causes.kinds.length) goTo(causes.peer[wait], endOf(run, wait) - causes.left[wait]);
    goTo(causes.from[wait], endOf(run, wait) - causes.at[wait]);
  }
  for (const [width, color] of chain.length > stepsListed ? [[0.6, css("ink")]] : [[4, css("paper")], [1.5, css("ink")]]) {
    [pen.lineWidth, pen.strokeStyle] = [width, color];
    pen.stroke();
  }
  pen.lineWidth = 1;
});
