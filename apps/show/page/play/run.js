// A run: what its data say, its arrays unpacked.

/// Whole numbers as the page has them: little-endian, as are all computers that browsers run on.
const unpacked = ({type, data: text}) => {
  const letters = atob(text), bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
  return new {u1: Uint8Array, u2: Uint16Array, u4: Uint32Array, f8: Float64Array}[type](bytes.buffer);
};
const largestOf = (values) => values.reduce((most, value) => value > most ? value : most, 1);
/// What a row did in steps from the first to the last.
const sumOf = ({values, steps}, row, [first, last]) => {
  let sum = 0;
  for (let at = row * steps + first; at <= row * steps + last; ++at) sum += values[at];
  return sum;
};
/// Of the rows of what passed over time; `peak`: the most in a nanosecond.
const overTime = (rows) => {
  const values = unpacked(rows.values), largest = largestOf(values);
  return {...rows, values, largest, peak: largest * rows.most / 255 / rows.step_ns};
};
const openRun = (data, index) => {
  const {levels = [], ...over} = data.over || {}, rest = data.clock === "virtual time" ? "idle at the end" : "between calls";
  const values = (field) => ({...field, values: unpacked(field.values)});
  return {...data, index, rest, done: unpacked(data.done), fields: Object.fromEntries(data.fields.map((field) => [field.name, values(field)])),
    // What nodes did, then what they waited for; what is left of a step is the rest.
    works: [...data.works, ...data.waits.filter(({name}) => name !== rest)].map((work) => ({...work, steps: data.steps, step_ns: data.step_ns, total_ns: data.total_ns, values: unpacked(work.shares)})),
    over: Object.fromEntries(Object.entries(over).map(([name, rows]) => [name, overTime({...rows, total_ns: data.total_ns})])),
    levels: levels.map(overTime).filter(({values: all}) => all.some((value) => value > 0))};
};
const runs = (data.runs || [data]).map(openRun);
const mostOf = (of) => Math.max(...runs.map(of));
/// "A" where there are several.
const letterOf = ({index}) => runs.length > 1 ? "AB"[index] : "";
const totalMs = mostOf(({total_ns}) => total_ns) / 1e6;

const nodeName = (run, node) => node >= run.nodes ? "the host" : "node " + node;
/// "node 3" and "host" as numbers; -1: a switch, or a place without a node.
const nodeOf = (run, name) => name === "host" ? run.nodes : name.startsWith("node ") ? Number(name.slice(5)) : -1;
