// What each node did when, on one axis with the shares of all: by pointer a time or a brush, by keys steps and nodes.
const barsMax = 64;  // nodes that one can tell apart
const sharesHigh = 96, levelsHigh = 60;

const startTime = (run, box) => {
  const {nodes} = run, high = nodes <= barsMax ? nodes * (nodes <= 16 ? 18 : 12) : 512;
  const raster = makeCanvas(run, "raster", "What each node does over time, a row for each. The table below has the shares of all of them.", box);
  const shares = makeCanvas(run, "shares", "What all nodes together do over time, and the axis of time", box);
  const time = run.time = {raster, shares, high, baked: bakedRaster(run, high), bakedShares: document.createElement("canvas"), key: null, clicked: []};
  for (const canvas of [raster, shares]) {
    const nodeAt = (event) => canvas === raster ? within(placeIn(canvas, event)[1] * nodes, nodes) : -1, timeAt = (event) => placeIn(canvas, event)[0] * totalMs;
    let start = null;
    canvas.className = "time";
    canvas.addEventListener("pointerdown", (event) => {
      start = timeAt(event);
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      const now = timeAt(event);
      if (start !== null) change({from: Math.min(now, start), to: Math.max(now, start)});
      else point({...nothing, run: run.index, node: nodeAt(event), at: Math.min(now, run.total_ns / 1e6 * (1 - 1e-9))});
    });
    canvas.addEventListener("pointerup", (event) => {
      if (start !== null && Math.abs(timeAt(event) - start) < totalMs / 200) {
        change({run: run.index, t: start, from: 0, to: 0});
        for (const act of time.clicked) if (canvas === raster) act(nodeAt(event));
      }
      start = null;
    });
    canvas.addEventListener("keydown", (event) => moveByKey(run, canvas === raster, event));
  }
  legend(box, run.clock === "virtual time" ? "Virtual time. " : "By the wall clock, which compares schedules. ", run.works.map(({name}) => [name, colorOf(name)]));
  for (const add of underRows) add(run, box);
  part(() => [state.t, state.from, state.to, state.why, choiceKey(chosen())].join(), () => drawTime(run));
};
const moveByKey = ({index, nodes, time, step_ns}, isRaster, event) => {
  if (event.key === "w" && state.node >= 0) for (const act of time.clicked) act(state.node);
  const steps = {ArrowLeft: -1, ArrowRight: 1, PageUp: -10, PageDown: 10, Home: -Infinity, End: Infinity}[event.key];
  const rows = isRaster && {ArrowUp: -1, ArrowDown: 1}[event.key];
  if (!steps && !rows) return;
  event.preventDefault();
  if (rows) {
    settle({...nothing, run: index, node: within(state.node + rows, nodes)});
    return;
  }
  const stepMs = step_ns / 1e6, before = state.t, t = Math.max(0, Math.min(totalMs, (Math.round(before / stepMs) + steps) * stepMs));
  const other = state.to > state.from ? (before === state.to ? state.from : state.to) : before;  // the brush's other end stays
  change(event.shiftKey ? {t, from: Math.min(other, t), to: Math.max(other, t)} : {t});
};

/// Once: each step of each node as a column of what it did; where a row is lower than a column, what is left of it mixes.
const bakedRaster = ({nodes, steps, works}, high) => {
  const size = nodes <= barsMax ? 16 : 4, canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [steps, nodes * size];
  const pen = canvas.getContext("2d"), image = pen.createImageData(steps, nodes * size), out = new Uint32Array(image.data.buffer);
  const colors = works.map(({name}) => packedHex(colorOf(name)));
  for (let at = 0; at < nodes * steps; ++at) {
    const foot = ((Math.floor(at / steps) + 1) * size - 1) * steps + at % steps;
    let sum = 0, y = 0;
    works.forEach(({values}, k) => {
      sum += values[at];
      for (const to = Math.min(size, Math.round(sum / 255 * size)); y < to; ++y) out[foot - y * steps] = colors[k];
    });
  }
  pen.putImageData(image, 0, 0);
  if (nodes <= barsMax) return canvas;
  const small = document.createElement("canvas"), smaller = small.getContext("2d");
  [small.width, small.height] = [steps, high];
  smaller.imageSmoothingQuality = "high";
  smaller.drawImage(canvas, 0, 0, steps, high);
  return small;
};
/// Of all nodes, or of the chosen: anew where these change.
const bakeShares = ({steps, works, time: {bakedShares: canvas}}, nodes) => {
  [canvas.width, canvas.height] = [steps, 200];
  const pen = canvas.getContext("2d");
  for (let step = 0; step < steps; ++step) {
    let y = 200;
    for (const {name, values} of works) {
      const height = nodes.reduce((sum, node) => sum + values[node * steps + step], 0) / 255 / nodes.length * 200;
      pen.fillStyle = colorOf(name);
      pen.fillRect(step, y -= height, 1, height);
    }
  }
};
const drawTime = (run) => {
  const {time, steps, step_ns} = run, choice = chosen(), bright = brightNodes(run, choice), key = [...bright].join();
  if (key !== time.key) bakeShares(run, summed(run, choice));
  time.key = key;
  const over = step_ns * steps / 1e6 / totalMs;  // the last step goes beyond the end
  for (const [canvas, baked, height] of [[time.raster, time.baked, time.high], [time.shares, time.bakedShares, sharesHigh]]) {
    const isRaster = canvas === time.raster, [pen, wide] = square(canvas, isRaster ? height : height + 18), at = (ms) => ms / totalMs * wide;
    pen.imageSmoothingEnabled = false;
    pen.drawImage(baked, 0, 0, wide * over, height);
    if (isRaster) {
      drawRows(run, pen, wide, bright);
      for (const draw of overRows) draw(run, pen, wide, height);
    } else drawAxis(pen, wide);
    if (state.to > state.from) {
      pen.fillStyle = css("shade");
      pen.fillRect(0, 0, at(state.from), height);
      pen.fillRect(at(state.to), 0, wide, height);
      pen.strokeStyle = css("ink");
      pen.strokeRect(at(state.from), 0.5, at(state.to - state.from), height - 1);
    }
    drawNow(pen, wide, height);
  }
};
/// What further scripts draw over the rows of time, told run, pen, width and height, and put below them.
const overRows = [], underRows = [];
const drawNow = (pen, wide, height) => {
  pen.fillStyle = css("ink");
  if (moment() >= 0) pen.fillRect(moment() / totalMs * wide - 0.5, 0, 1, height);
  pen.fillStyle = "#e03030";
  pen.fillRect(state.t / totalMs * wide - 1, 0, 2, height);
};
const drawRows = ({nodes, time}, pen, wide, bright) => {
  const height = time.high / nodes, every = Math.ceil(14 / height), low = Math.min(height - 2, 13);
  if (bright.size > 0) {
    pen.fillStyle = css("card");
    pen.globalAlpha = 0.75;
    for (let node = 0; node < nodes; ++node) if (!bright.has(node)) pen.fillRect(0, node * height, wide, height);
    pen.globalAlpha = 1;
    pen.strokeStyle = "#e03030";
    for (const node of bright) if (node < nodes) pen.strokeRect(0.5, node * height, wide - 1, Math.max(1, height));
  }
  label(pen, "left");
  for (let node = 0; node < nodes; node += every > 1 ? every * 2 : 1) {
    const text = String(node);
    pen.fillStyle = css("paper");
    pen.fillRect(0, node * height + 1, 7 * text.length + 4, Math.max(11, low));
    pen.fillStyle = css("ink");
    pen.fillText(text, 2, node * height + Math.max(10, low));
  }
};
const drawAxis = (pen, wide) => {
  const room = totalMs / Math.max(2, wide / 110), power = 10 ** Math.floor(Math.log10(room));
  const step = [1, 2, 5, 10].map((digit) => digit * power).find((size) => size >= room);
  pen.fillStyle = css("faint");
  label(pen, "left");
  for (let ms = 0; ms <= totalMs; ms += step) {
    pen.fillRect(ms / totalMs * wide, sharesHigh, 1, 4);
    if (ms < totalMs * (1 - 50 / wide)) pen.fillText(numberText(ms) + " ms", ms / totalMs * wide + 3, sharesHigh + 13);
  }
};
const label = (pen, align) => {
  pen.font = "11px system-ui,sans-serif";
  pen.textAlign = align;
};
/// Names beside their colours.
const legend = (box, text, entries) => {
  const line = make("p", {class: "note"}, box, text);
  for (const [name, color] of entries) {
    make("span", {class: "swatch"}, line).style.background = color;
    line.append(` ${name} `);
  }
};
