// What each node did when, on one axis with the shares of all: by pointer a time or a brush, by keys steps and nodes.
const time = {raster: null, shares: null, bakedKey: "", start: null};
const barsMax = 64;  // nodes that one can tell apart
const rowHeight = data.nodes <= 16 ? 18 : 12, rasterHeight = data.nodes <= barsMax ? data.nodes * rowHeight : 512, sharesHeight = 96;

const startTime = (box) => {
  time.raster = makeCanvas("raster", "What each node does over time, a row for each. The table below has the shares of all of them.", box);
  time.shares = makeCanvas("shares", "What all nodes together do over time, and the axis of time", box);
  for (const canvas of [time.raster, time.shares]) {
    canvas.addEventListener("pointerdown", (event) => {
      time.start = timeAt(event);
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => drag(canvas, event));
    canvas.addEventListener("pointerup", (event) => {
      if (time.start !== null && Math.abs(timeAt(event) - time.start) < totalMs / 200) {
        Object.assign(state, {t: time.start, from: 0, to: 0});
        if (causes && canvas === time.raster) state.why = waitAt(within(placeIn(canvas, event)[1] * data.nodes, data.nodes), state.t * 1e6);
        writeAddress();
      }
      time.start = null;
      changed();
    });
    canvas.addEventListener("keydown", (event) => moveByKey(canvas, event));
  }
  bakeRaster();
};
const timeAt = (event) => Math.max(0, Math.min(1, placeIn(time.raster, event)[0])) * totalMs;
const drag = (canvas, event) => {
  if (time.start === null) {
    if (canvas === time.raster) point({...nothing, node: within(placeIn(canvas, event)[1] * data.nodes, data.nodes)});
    return;
  }
  const now = timeAt(event);
  Object.assign(state, {from: Math.min(now, time.start), to: Math.max(now, time.start)});
  writeAddress();
  changed();
};
const moveByKey = (canvas, event) => {
  if (event.key === "w" && causes && state.node >= 0) showWhy(waitAt(state.node, state.t * 1e6));
  const steps = {ArrowLeft: -1, ArrowRight: 1, PageUp: -10, PageDown: 10, Home: -stepCount, End: stepCount}[event.key];
  const rows = {ArrowUp: -1, ArrowDown: 1}[event.key];
  if (steps === undefined && (rows === undefined || canvas !== time.raster)) return;
  event.preventDefault();
  if (rows !== undefined) {
    settle({...nothing, node: within(state.node + rows, data.nodes)});
    return;
  }
  const before = state.t;
  state.t = Math.max(0, Math.min(totalMs, (Math.round(state.t / stepMs) + steps) * stepMs));
  if (event.shiftKey) {  // the brush's other end stays
    const other = state.to > state.from ? (before === state.to ? state.from : state.to) : before;
    Object.assign(state, {from: Math.min(other, state.t), to: Math.max(other, state.t)});
  }
  writeAddress();
  changed();
};

/// Once: each step of each node as a column of what it did; where a row is lower than a column, what is left of it mixes.
const bakeRaster = () => {
  const size = data.nodes <= barsMax ? 16 : 4, canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [data.steps, data.nodes * size];
  const pen = canvas.getContext("2d"), image = pen.createImageData(canvas.width, canvas.height), out = new Uint32Array(image.data.buffer);
  const colors = works.map((work) => packedHex(workColors[work.name]));
  for (let at = 0; at < data.nodes * data.steps; ++at) {
    const node = Math.floor(at / data.steps), foot = ((node + 1) * size - 1) * data.steps + at % data.steps;
    for (let k = 0, sum = 0, y = 0; k < works.length; ++k) {
      sum += works[k].shares[at];
      for (const to = Math.min(size, Math.round(sum / 255 * size)); y < to; ++y) out[foot - y * data.steps] = colors[k];
    }
  }
  pen.putImageData(image, 0, 0);
  time.baked = document.createElement("canvas");
  [time.baked.width, time.baked.height] = [data.steps, data.nodes <= barsMax ? canvas.height : rasterHeight];
  const small = time.baked.getContext("2d");
  small.imageSmoothingQuality = "high";
  small.drawImage(canvas, 0, 0, data.steps, time.baked.height);
};
/// Of all nodes, or of the chosen: anew where these change.
const bakeShares = (choice) => {
  const nodes = summed(choice), canvas = time.bakedShares ||= document.createElement("canvas");
  canvas.width = data.steps;
  canvas.height = 200;
  const pen = canvas.getContext("2d");
  for (let step = 0; step < data.steps; ++step) {
    let y = 200;
    for (const work of works) {
      let sum = 0;
      for (const node of nodes) sum += work.shares[node * data.steps + step];
      const height = sum / 255 / nodes.length * 200;
      pen.fillStyle = workColors[work.name];
      pen.fillRect(step, y - height, 1, height);
      y -= height;
    }
  }
};
// Levels, of all nodes together: the most in each step, each on a scale of its own
const levelColors = ["#0072b2", "#d55e00", "#009e73", "#cc79a7"], levelsHeight = 60;
const startLevels = (box) => {
  const shown = time.levels = levels.map((level) => ({name: level.name, ...overTime(level)})).filter(({most}) => most > 1);
  if (!shown.length) return;
  time.levelsCanvas = makeCanvas("levels", "How full all nodes together were over time: " + shown.map(({name, most}) => `${name} at most ${numberText(most)}`).join(", "), box);
  const legend = make("p", {class: "note"}, box, "Most at a time, of all nodes together: ");
  shown.forEach(({name, most}, i) => {
    make("span", {class: "swatch"}, legend).style.background = levelColors[i];
    legend.append(` ${name} ${numberText(most)} `);
  });
  part(() => state.t, drawLevels);
};
const drawLevels = () => {
  const [pen, wide] = square(time.levelsCanvas, levelsHeight);
  time.levels.forEach(({at, steps, step_ns}, i) => {
    pen.strokeStyle = levelColors[i];
    pen.lineWidth = 1.5;
    pen.beginPath();
    for (let step = 0; step < steps; ++step) for (const end of [step, step + 1]) pen.lineTo(end * step_ns / data.total_ns * wide, levelsHeight - 2 - (levelsHeight - 4) * at(step));
    pen.stroke();
  });
  pen.fillStyle = "#e03030";
  pen.fillRect(state.t / totalMs * wide - 1, 0, 2, levelsHeight);
};
const sizeTime = () => {
  for (const [canvas, height] of [[time.raster, rasterHeight], [time.shares, sharesHeight + 18]]) {
    canvas.style.height = height + "px";
    canvas.width = Math.round(canvas.clientWidth * devicePixelRatio);
    canvas.height = Math.round(height * devicePixelRatio);
  }
};
const drawTime = () => {
  const choice = chosen(), key = [...brightNodes(choice)].join();
  if (key !== time.bakedKey || !time.bakedShares) {
    bakeShares(choice);
    time.bakedKey = key;
  }
  const over = stepMs * data.steps / totalMs;  // the last step goes beyond the end
  for (const [canvas, baked, height] of [[time.raster, time.baked, rasterHeight], [time.shares, time.bakedShares, sharesHeight]]) {
    const pen = canvas.getContext("2d"), wide = canvas.width / devicePixelRatio;
    pen.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    pen.clearRect(0, 0, wide, height + 20);
    pen.imageSmoothingEnabled = false;
    pen.drawImage(baked, 0, 0, wide * over, height);
    if (canvas === time.raster) {
      drawRows(pen, wide, brightNodes(choice));
      drawWhy(pen, wide, height);
    }
    else drawAxis(pen, wide);
    if (state.to > state.from) {
      const left = state.from / totalMs * wide, right = state.to / totalMs * wide;
      pen.fillStyle = css("shade");
      pen.fillRect(0, 0, left, height);
      pen.fillRect(right, 0, wide - right, height);
      pen.strokeStyle = css("ink");
      pen.strokeRect(left, 0.5, right - left, height - 1);
    }
    pen.fillStyle = "#e03030";
    pen.fillRect(state.t / totalMs * wide - 1, 0, 2, height);
  }
};
const drawRows = (pen, wide, bright) => {
  const height = rasterHeight / data.nodes, every = Math.ceil(14 / height);
  if (bright.size > 0) {
    pen.fillStyle = css("card");
    pen.globalAlpha = 0.75;
    for (let node = 0; node < data.nodes; ++node) if (!bright.has(node)) pen.fillRect(0, node * height, wide, height);
    pen.globalAlpha = 1;
    pen.strokeStyle = "#e03030";
    for (const node of bright) if (node < data.nodes) pen.strokeRect(0.5, node * height, wide - 1, Math.max(1, height));
  }
  label(pen, "left");
  for (let node = 0; node < data.nodes; node += every > 1 ? every * 2 : 1) {
    const text = String(node);
    pen.fillStyle = css("paper");
    pen.fillRect(0, node * height + 1, 7 * text.length + 4, Math.max(11, Math.min(height - 2, 13)));
    pen.fillStyle = css("ink");
    pen.fillText(text, 2, node * height + Math.max(10, Math.min(height - 2, 13)));
  }
};
const drawAxis = (pen, wide) => {
  const room = totalMs / Math.max(2, wide / 110), power = 10 ** Math.floor(Math.log10(room));
  const step = [1, 2, 5, 10].map((digit) => digit * power).find((size) => size >= room);
  pen.fillStyle = css("faint");
  label(pen, "left");
  for (let ms = 0; ms <= totalMs; ms += step) {
    pen.fillRect(ms / totalMs * wide, sharesHeight, 1, 4);
    if (ms < totalMs * (1 - 50 / wide)) pen.fillText(numberText(ms) + " ms", ms / totalMs * wide + 3, sharesHeight + 13);
  }
};
