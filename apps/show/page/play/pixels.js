// The picture as far as it is done, and a heat map over it.
const darkColor = packedColor(26, 26, 26);
const pixels = {film: null, lit: null, field: null, most: 1, tinted: ""};

const startPixels = async (box) => {
  const canvas = pixels.canvas = makeCanvas("shot", "The picture, as far as it is done at the time shown. The table of nodes below has what each did.", box,
    (x, y) => pixelAt(x * data.wide, y * data.high), (right, down) => state.x < 0 ? pixelAt(data.wide / 2, data.high / 2) : pixelAt(state.x + right, state.y + down));
  canvas.width = data.wide;
  canvas.height = data.high;
  const image = document.querySelector("img.picture");
  await image.decode();
  const pen = pixels.pen = canvas.getContext("2d", {willReadFrequently: true});
  pen.drawImage(image, 0, 0, data.wide, data.high);
  pixels.film = pen.getImageData(0, 0, data.wide, data.high).data;
  pixels.frame = pen.createImageData(data.wide, data.high);
  pixels.out = new Uint32Array(pixels.frame.data.buffer);
  pixels.lit = new Uint32Array(pixels.out.length);
};
/// A choice: the cell, and the node that it belongs to.
const pixelAt = (column, row) => {
  const x = within(column, data.wide), y = within(row, data.high);
  return {x, y, node: fields.node ? fields.node.values[y * data.wide + x] : -1};
};

/// Where a cell's number lies on the scale of colours, which is logarithmic.
const heatFieldOf = (name) => {
  const values = name === "done" ? done : fields[name].values;
  let most = 1;
  for (const value of values) if (value > most) most = value;
  return {values, colorOf: name === "node" ? (value) => nodeColors[value % 12] :
    name === "done" ? (value) => heatColors[Math.floor(value / 65535 * 255)] :
    (value) => heatColors[Math.round(Math.log1p(value) / Math.log1p(most) * 255)]};
};
/// What each cell looks like once it is done; anew only where heat, mix or choice change.
const tint = (choice) => {
  const mix = state.heat ? state.mix / 100 : 0, bright = brightNodes(choice), dims = bright.size > 0 && fields.node && data.nodes > 1;
  const heat = mix > 0 ? heatFieldOf(state.heat) : null, {film, lit} = pixels;
  for (let p = 0, at = 0; p < lit.length; ++p, at += 4) {
    const over = heat ? heat.colorOf(heat.values[p]) : 0, kept = dims && !bright.has(fields.node.values[p]) ? 0.3 : 1;
    let color = 0xff;
    for (let channel = 2; channel >= 0; --channel) {
      const value = film[at + channel] * (1 - mix) + (over >>> 8 * channel & 255) * mix;
      color = color << 8 | (value * kept + 60 * (1 - kept));
    }
    lit[p] = color;
  }
};
const drawPixels = () => {
  const choice = chosen(), key = [state.heat, state.mix, ...brightNodes(choice)].join();
  if (key !== pixels.tinted) {
    tint(choice);
    pixels.tinted = key;
  }
  const {out, lit} = pixels, now = Math.floor(state.t / totalMs * 65535 + 1e-6), fresh = state.t < totalMs ? now - 600 : now;
  for (let p = 0; p < out.length; ++p) {
    out[p] = done[p] > now ? darkColor : done[p] > fresh ? lit[p] | 0x404040 : lit[p];
  }
  pixels.pen.putImageData(pixels.frame, 0, 0);
  if (choice.x >= 0) {
    pixels.pen.strokeStyle = "#fff";
    pixels.pen.strokeRect(choice.x - 1.5, choice.y - 1.5, 4, 4);
  }
};
/// Whole multiples of its size where there is room for one.
const sizePixels = () => {
  const room = pixels.canvas.parentElement.clientWidth, times = Math.max(1, Math.floor(Math.min(room, 512) / data.wide));
  pixels.canvas.style.width = Math.min(room, times * data.wide) + "px";
};
const pixelText = ({x, y}) => {
  const p = y * data.wide + x, part = done[p];
  const facts = data.fields.filter(({name}) => name !== "node").map(({name, unit, scale}) =>
    numberText(fields[name].values[p] * scale) + " " + unit + (name === "time" ? " of computing" : ""));
  const where = data.cell > 1 ? `Pixels from ${x * data.cell}, ${y * data.cell}, ${data.cell} a side` : `Pixel ${x}, ${y}`;
  return `${where}: ${fields.node ? "node " + fields.node.values[p] + ", " : ""}` +
    `${part > 0 ? "done at " + timeText(part / 65535 * totalMs) : "nothing to do"}, ${facts.join(", ")}.`;
};
