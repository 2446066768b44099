// What goes on, as its server tells it (apps/render/live_events.h): of a run the picture tile by tile, and what each node did step by
// step; where one looks round, whole pictures, and where the camera is to be, which the server is told.
const byId = (id) => document.getElementById(id);
const looksRound = document.querySelector("main").className === "view";
const triesMax = 3;  // of EventSource, one every few seconds
let head = null, shot = null, raster = null, shares = [], doublings = 0, tries = 0, hasEnded = false;

const make = (name, parent, text = "") => {
  const element = document.createElement(name);
  element.textContent = text;
  parent.append(element);
  return element;
};

const say = (text) => {
  if (byId("said").textContent !== text) byId("said").textContent = text;
};

const facts = (rows) => {
  byId("facts").replaceChildren();
  for (const [name, value] of rows) {
    const box = make("div", byId("facts"));
    make("dt", box, name);
    make("dd", box, value);
  }
};

const copyable = (text) => {
  byId("figures").textContent = text;
  byId("figures").hidden = !text;
};

const amount = (value) => value.toLocaleString("en", {maximumFractionDigits: 1});
const inUnits = (value, unit) => {
  const power = value < 1000 ? 0 : Math.min(4, Math.floor(Math.log10(value) / 3));
  return `${amount(value / 1000 ** power)} ${["", "k", "M", "G", "T"][power]}${unit}`;
};

const sized = (canvas, width, height) => {
  if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
  return canvas.getContext("2d");
};

// Another picture, or the same again, for who was away.
const begin = (reported) => {
  head = reported;
  doublings = 0;
  shot = sized(byId("shot"), head.width, head.height);
  if (looksRound) camera = cameraOf(head.home);
  byId("nodes").hidden = !head.nodes;
  byId("unseen").hidden = head.nodes > 0;
  raster = sized(byId("raster"), head.steps || 1, head.nodes * Math.max(1, Math.floor(256 / (head.nodes || 1))) || 1);
  clear();
  byId("shares").replaceChildren();
  shares = head.works.map((work) => {
    const item = make("li", byId("shares")), swatch = make("span", item);
    swatch.className = "swatch";
    swatch.style.background = colorOf(work);
    make("span", item, work);
    return make("b", item);
  });
};

const clear = () => raster.clearRect(0, 0, raster.canvas.width, raster.canvas.height);

const imageOf = ({width, height, rgb}) => {
  const letters = atob(rgb), image = new ImageData(width, height);
  for (let i = 0, from = 0; i < image.data.length; ++i) image.data[i] = i % 4 === 3 ? 255 : letters.charCodeAt(from++);
  return image;
};
const drawTile = (reported) => shot.putImageData(imageOf(reported), reported.x, reported.y);

// A whole picture, perhaps of fewer pixels.
const drawShot = (reported) => {
  const part = new OffscreenCanvas(reported.width, reported.height);
  part.getContext("2d").putImageData(imageOf(reported), 0, 0);
  shot.drawImage(part, 0, 0, head.width, head.height);
  facts([["Picture", `${reported.width}x${reported.height}`], ["Time", `${Math.round(reported.ms)} ms`], ["Camera", reported.camera],
    ["Film", reported.film || "the camera moves"]]);
  if (!reported.moving) copyable(reported.command);
  if (!drag && !next && !isSending && !rests) camera = cameraOf(reported.camera);  // somebody else may have moved it
};

// A column of the raster: of each node the work that took most, the paler the less it did in all. Those of another frame, or from
// before steps became longer, come late and are passed over.
const drawStep = (reported) => {
  if (reported.frame !== head.frame || reported.doublings < doublings) return;
  if (reported.doublings > doublings) clear();
  doublings = reported.doublings;
  const letters = atob(reported.cells), height = raster.canvas.height / head.nodes, image = new ImageData(1, raster.canvas.height);
  for (let y = 0; y < image.height; ++y) {
    const cell = letters.charCodeAt(Math.floor(y / height)), color = parseInt(colorOf(head.works[cell % head.works.length]).slice(1, 7), 16);
    const share = Math.floor(cell / head.works.length) / head.levels;
    image.data.set([color >> 16, color >> 8 & 255, color & 255, Math.round(255 * share)], 4 * y);
  }
  raster.putImageData(image, reported.step, 0);
  byId("until").textContent = `${Math.round(reported.ms / 1000 / (reported.step + 1) * head.steps)} s`;
};

const reportState = (reported) => {
  say(reported.said);
  tries = 0;
  [byId("done").max, byId("done").value] = [Math.max(1, reported.total), reported.done];
  if (looksRound) return;
  const rows = [["Time by the wall clock", `${amount(reported.ms / 1000)} s`], ["Pixels done", `${amount(reported.done)} of ${amount(reported.total)}`]];
  if (reported.pass > 1) rows.push(["Pass", String(reported.pass)]);
  if (head && head.nodes) {
    if (head.modelled) rows.push(["Virtual time", `${amount(reported.ns / 1e6)} ms`]);
    rows.push(["Packets sent", amount(reported.packets)], ["Bytes sent", inUnits(reported.bytes, "B")]);
  }
  facts(rows);
  reported.shares.forEach((share, i) => { if (shares[i]) shares[i].textContent = `${(100 * share).toFixed(1)} %`; });
};

const post = async (place, what) => {
  try {
    const answer = await fetch(place, {method: "POST", headers: {"Content-Type": "application/json"}, body: JSON.stringify(what)});
    if (!answer.ok) say(await answer.text());
  } catch {
    if (!hasEnded) say("dmpc does not answer.");
  }
};

byId("stop").addEventListener("click", () => {
  byId("stop").disabled = true;
  post("stop", {});
});

// A camera as --camera has it, "FROM/AT/UP/DEGREES", and its ways round what it looks at.
const add = (a, b, k = 1) => a.map((x, i) => x + k * b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));
// About an axis of unit length (O. Rodrigues, 1840).
const turned = (v, axis, angle) =>
  add(add(v.map((x) => x * Math.cos(angle)), cross(axis, v), Math.sin(angle)), axis, dot(axis, v) * (1 - Math.cos(angle)));

const cameraOf = (text) => {
  const [from, at, up, degrees] = text.split("/").map((part) => part.split(",").map(Number));
  return {from, at, up, degrees: degrees[0]};
};
// Seven digits are finer than a pixel, and leave a command that one can read.
const textOf = ({from, at, up, degrees}) => {
  const far = Math.max(...from.map(Math.abs), ...at.map(Math.abs)), step = 10 ** (Math.ceil(Math.log10(far || 1)) - 7);
  const point = (p) => p.map((x) => String(Number((Math.round(x / step) * step).toPrecision(9)))).join(",");
  return `${point(from)}/${point(at)}/${up.join(",")}/${degrees}`;
};

const axesOf = ({from, at, up}) => {
  const forward = unit(add(at, from, -1)), right = unit(cross(forward, up));
  return {right, above: cross(right, forward)};
};

const nearPole = 0.05;  // radians from up or down that the camera keeps, as there is no right then

// Round what it looks at, by angles: to the right, and upwards.
const orbit = (c, angle, rise) => {
  const {right} = axesOf(c), up = unit(c.up);
  const offset = add(c.from, c.at, -1), height = Math.asin(Math.max(-1, Math.min(1, dot(unit(offset), up))));
  const most = Math.max(Math.abs(height), Math.PI / 2 - nearPole);
  const to = Math.max(-most, Math.min(most, height + rise));
  return {...c, from: add(c.at, turned(turned(offset, right, height - to), up, angle))};
};
// By parts of the distance at which it looks, as seen in the picture.
const shift = (c, x, y) => {
  const {right, above} = axesOf(c), distance = Math.hypot(...add(c.at, c.from, -1));
  const way = add(right.map((v) => v * x * distance), above, y * distance);
  return {...c, from: add(c.from, way), at: add(c.at, way)};
};
const dolly = (c, factor) => ({...c, from: add(c.at, add(c.from, c.at, -1), factor)});

const restMs = 200;  // without a wish to move for so long the camera rests
const turnStep = Math.PI / 36, shiftStep = 0.05, nearStep = 0.9;
let camera = null, isSending = false, next = null, rests = 0, drag = null;

// One wish is on its way at a time, and then the newest.
const send = async () => {
  if (isSending || !next || hasEnded) return;
  const wish = next;
  [next, isSending] = [null, true];
  await post("camera", wish);
  isSending = false;
  send();
};
const wish = (moving, more = {}) => {
  next = {camera: textOf(camera), moving, ...more};
  send();
};
const render = () => {
  if (!camera) return;
  clearTimeout(rests);
  wish(false, {render: true});
};
const go = (to) => {
  if (!camera) return;
  camera = to(turning(camera));
  wish(true);
  clearTimeout(rests);
  rests = setTimeout(() => {
    rests = 0;
    wish(false);
  }, restMs);
};

// A scene's own camera may look at any point on its line of sight: it turns about the one in the scene's middle.
const turning = (c) => (textOf(c) === textOf(cameraOf(head.home)) ? {...c, at: head.pivot.split(",").map(Number)} : c);
const ways = {
  left: (c) => orbit(c, -turnStep, 0), right: (c) => orbit(c, turnStep, 0), up: (c) => orbit(c, 0, turnStep),
  down: (c) => orbit(c, 0, -turnStep),
  nearer: (c) => dolly(c, nearStep), farther: (c) => dolly(c, 1 / nearStep), home: () => cameraOf(head.home),
};
const keys = {ArrowLeft: ways.left, ArrowRight: ways.right, ArrowUp: ways.up, ArrowDown: ways.down, "+": ways.nearer, "=": ways.nearer,
  "-": ways.farther, Home: ways.home};
const shiftedKeys = {ArrowLeft: (c) => shift(c, -shiftStep, 0), ArrowRight: (c) => shift(c, shiftStep, 0),
  ArrowUp: (c) => shift(c, 0, shiftStep), ArrowDown: (c) => shift(c, 0, -shiftStep)};

const lookRound = (canvas) => {
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "application");
  canvas.setAttribute("aria-label",
    "The picture. Arrow keys go round it, with Shift they shift it, plus and minus go nearer and farther, Home goes back, R renders it.");
  byId("render").addEventListener("click", render);
  for (const [id, way] of Object.entries(ways)) byId(id).addEventListener("click", () => go(way));
  canvas.addEventListener("keydown", (event) => {
    const way = (event.shiftKey && shiftedKeys[event.key]) || keys[event.key], isRender = event.key.toLowerCase() === "r";
    if (!way && !isRender || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    if (isRender) render(); else go(way);
  });
  canvas.addEventListener("pointerdown", (event) => {
    drag = {x: event.clientX, y: event.clientY, shifts: event.shiftKey || event.button !== 0};
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!drag || !camera) return;
    const size = Math.min(canvas.clientWidth, canvas.clientHeight), x = (event.clientX - drag.x) / size, y = (event.clientY - drag.y) / size;
    [drag.x, drag.y] = [event.clientX, event.clientY];
    const wide = 2 * Math.tan(camera.degrees * Math.PI / 360);
    go((c) => drag.shifts ? shift(c, -x * wide, y * wide) : orbit(c, -Math.PI * x, Math.PI * y));
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => { drag = null; });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    go((c) => dolly(c, Math.exp(Math.max(-100, Math.min(100, event.deltaY)) / 500)));
  }, {passive: false});
};
if (looksRound) lookRound(byId("shot"));

const source = new EventSource("events");
const on = (name, act) => source.addEventListener(name, (event) => act(JSON.parse(event.data)));
const finish = ({said, figures, page}) => {
  hasEnded = true;
  source.close();
  byId("ways").hidden = true;
  byId("when").textContent = "What all of them did, in parts of their time";
  say(page ? `${said} Its page is loading.` : `${said} This is the final state.`);
  if (figures) copyable(figures);
  if (page) location.reload();
};
on("head", begin);
on("state", reportState);
for (const [name, draw] of [["step", drawStep], ["tile", drawTile], ["picture", drawShot]]) on(name, (reported) => { if (head) draw(reported); });
on("end", finish);
source.onerror = () => {
  if (source.readyState === EventSource.CLOSED) {
    say("No more viewers are accepted, or the run is over: reload the page to try again.");
  } else if (++tries < triesMax) {
    say("The connection is lost; trying again.");
  } else {
    source.close();
    say("dmpc no longer answers: it has ended or was killed without notice. This is the last state that it sent.");
  }
};
