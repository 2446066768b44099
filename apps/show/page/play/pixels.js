// The picture as far as it is done, and a heat map over it.
const darkColor = packedColor(26, 26, 26);

const startPixels = async (run, box) => {
  const {wide, high, index} = run, pixelAt = (x, y) => ({x: within(x, wide), y: within(y, high)});
  const canvas = makeCanvas(run, "shot", "The picture, as far as it is done at the time shown. The table of nodes below has what each did.", box,
    (x, y) => pixelAt(x * wide, y * high), (right, down) => state.x < 0 ? pixelAt(wide / 2, high / 2) : pixelAt(state.x + right, state.y + down));
  canvas.className = "shot";
  [canvas.width, canvas.height] = [wide, high];
  const image = document.querySelectorAll("img.picture")[index], pen = canvas.getContext("2d", {willReadFrequently: true});
  await image.decode();
  pen.drawImage(image, 0, 0, wide, high);
  const caption = image.closest(".opening") && image.closest("figure").querySelector("figcaption");
  if (caption) box.append(caption.cloneNode(true));
  const film = pen.getImageData(0, 0, wide, high).data, frame = pen.createImageData(wide, high), out = new Uint32Array(frame.data.buffer);
  run.pixels = {canvas, pen, film, frame, out, lit: new Uint32Array(out.length), tinted: ""};
  part(() => [state.t, state.heat, state.mix, choiceKey(chosen())].join(), () => drawPixels(run));
};

/// What a cell's number looks like: on a scale of all runs, which is logarithmic.
const heatFieldOf = ({fields, done, total_ns}) => {
  if (state.heat === "done") return {values: done, colorOf: (value) => heatColors[Math.floor(value / 65535 * total_ns / 1e6 / totalMs * 255)]};
  const {values} = fields[state.heat], most = mostOf(({fields: {[state.heat]: field}}) => field ? field.most ||= largestOf(field.values) : 1);
  return {values, colorOf: state.heat === "node" ? (value) => nodeColors[value % 12] : (value) => heatColors[Math.round(Math.log1p(value) / Math.log1p(most) * 255)]};
};
/// What each cell looks like once it is done; anew only where heat, mix or choice change.
const tint = (run, bright) => {
  const {fields: {node}, pixels: {film, lit}} = run, heat = state.heat === "done" || run.fields[state.heat] ? heatFieldOf(run) : null;
  const mix = heat ? state.mix / 100 : 0, dims = bright.size > 0 && node && run.nodes > 1;
  for (let p = 0, at = 0; p < lit.length; ++p, at += 4) {
    const over = mix > 0 ? heat.colorOf(heat.values[p]) : 0, kept = dims && !bright.has(node.values[p]) ? 0.3 : 1;
    let color = 0xff;
    for (let channel = 2; channel >= 0; --channel) {
      const value = film[at + channel] * (1 - mix) + (over >>> 8 * channel & 255) * mix;
      color = color << 8 | (value * kept + 60 * (1 - kept));
    }
    lit[p] = color;
  }
};
const drawPixels = (run) => {
  const {pixels, done} = run, {canvas, pen, out, lit} = pixels, choice = chosen(), bright = brightNodes(run, choice), key = [state.heat, state.mix, ...bright].join();
  if (key !== pixels.tinted) tint(run, bright);
  pixels.tinted = key;
  const now = Math.min(65535, Math.floor(state.t * 1e6 / run.total_ns * 65535 + 1e-6)), fresh = now < 65535 ? now - 600 : now;
  for (let p = 0; p < out.length; ++p) out[p] = done[p] > now ? darkColor : done[p] > fresh ? lit[p] | 0x404040 : lit[p];
  pen.putImageData(pixels.frame, 0, 0);
  if (choice.x >= 0) {
    pen.strokeStyle = "#fff";
    pen.strokeRect(choice.x - 1.5, choice.y - 1.5, 4, 4);
  }
  // Whole multiples of its size where there is room for one
  const room = canvas.parentElement.clientWidth, times = Math.max(1, Math.floor(Math.min(room, 512) / run.wide));
  canvas.style.width = Math.min(room, times * run.wide) + "px";
};
const pixelText = (run, {x, y}) => {
  if (x >= run.wide || y >= run.high) return "No such pixel.";
  const p = y * run.wide + x, done = run.done[p], {node, ...fields} = run.fields;
  const facts = Object.values(fields).map(({name, unit, scale, values}) => numberText(values[p] * scale) + " " + unit + (name === "time" ? " of computing" : ""));
  const where = run.cell > 1 ? `Pixels from ${x * run.cell}, ${y * run.cell}, ${run.cell} a side` : `Pixel ${x}, ${y}`;
  return `${where}: ${node ? "node " + node.values[p] + ", " : ""}` +
    `${done > 0 ? "done at " + timeText(done / 65535 * run.total_ns / 1e6) : "nothing to do"}, ${facts.join(", ")}.`;
};
