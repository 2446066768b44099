// Pictures as the server of `dmpc view` tells them (apps/view/messages.h), and where the camera is to be, which it is told.
const byId = (id) => document.getElementById(id);
const restMs = 200;  // without a wish to move for so long the camera rests
const turnStep = Math.PI / 36, shiftStep = 0.05, nearStep = 0.9;
const triesMax = 3;  // of EventSource, one every few seconds
let head = null, camera = null, context = null, isSending = false, next = null, rests = 0, tries = 0, drag = null, hasEnded = false;

const say = (text) => {
  if (byId("said").textContent !== text) byId("said").textContent = text;
};

const begin = (told) => {
  head = told;
  camera = cameraOf(head.home);
  const canvas = byId("shot");
  if (canvas.width !== head.width || canvas.height !== head.height) [canvas.width, canvas.height] = [head.width, head.height];
  context = canvas.getContext("2d");
};

const draw = ({width, height, rgb}) => {
  const letters = atob(rgb), image = new ImageData(width, height);
  for (let i = 0, from = 0; i < image.data.length; ++i) image.data[i] = i % 4 === 3 ? 255 : letters.charCodeAt(from++);
  const part = new OffscreenCanvas(width, height);
  part.getContext("2d").putImageData(image, 0, 0);
  context.drawImage(part, 0, 0, head.width, head.height);
};

const facts = (rows) => {
  byId("facts").replaceChildren(...rows.map(([name, value]) => {
    const box = document.createElement("div"), dt = document.createElement("dt"), dd = document.createElement("dd");
    [dt.textContent, dd.textContent] = [name, value];
    box.append(dt, dd);
    return box;
  }));
};

const show = (told) => {
  if (!head) return;
  draw(told);
  facts([["Picture", `${told.width}x${told.height}`], ["Time", `${Math.round(told.ms)} ms`], ["Camera", told.camera],
    ["Film", told.film || "the camera moves"]]);
  if (!told.moving) byId("command").textContent = told.command;
  if (!drag && !next && !isSending && !rests) camera = cameraOf(told.camera);  // somebody else may have moved it
};

// One wish is on its way at a time, and then the newest.
const send = async () => {
  if (isSending || !next || hasEnded) return;
  const wish = next;
  [next, isSending] = [null, true];
  try {
    const answer = await fetch("camera", {method: "POST", headers: {"Content-Type": "application/json"}, body: JSON.stringify(wish)});
    if (!answer.ok) say(await answer.text());
  } catch {
    if (!hasEnded) say("dmpc does not answer.");
  }
  isSending = false;
  send();
};
const wish = (moving) => {
  next = {camera: textOf(camera), moving};
  send();
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
for (const [id, way] of Object.entries(ways)) byId(id).addEventListener("click", () => go(way));

const shot = byId("shot");
shot.addEventListener("keydown", (event) => {
  const way = (event.shiftKey && shiftedKeys[event.key]) || keys[event.key];
  if (!way || event.ctrlKey || event.altKey || event.metaKey) return;
  event.preventDefault();
  go(way);
});
shot.addEventListener("pointerdown", (event) => {
  drag = {x: event.clientX, y: event.clientY, shifts: event.shiftKey || event.button !== 0};
  shot.setPointerCapture(event.pointerId);
});
shot.addEventListener("pointermove", (event) => {
  if (!drag) return;
  const size = Math.min(shot.clientWidth, shot.clientHeight), x = (event.clientX - drag.x) / size, y = (event.clientY - drag.y) / size;
  [drag.x, drag.y] = [event.clientX, event.clientY];
  const wide = 2 * Math.tan(camera.degrees * Math.PI / 360);
  go((c) => drag.shifts ? shift(c, -x * wide, y * wide) : orbit(c, -Math.PI * x, Math.PI * y));
});
for (const name of ["pointerup", "pointercancel"]) shot.addEventListener(name, () => { drag = null; });
shot.addEventListener("contextmenu", (event) => event.preventDefault());
shot.addEventListener("wheel", (event) => {
  event.preventDefault();
  go((c) => dolly(c, Math.exp(Math.max(-100, Math.min(100, event.deltaY)) / 500)));
}, {passive: false});

const source = new EventSource("events");
const on = (name, act) => source.addEventListener(name, (event) => act(JSON.parse(event.data)));
on("head", begin);
on("picture", show);
on("state", ({said, done, total}) => {
  say(said);
  tries = 0;
  [byId("done").max, byId("done").value] = [Math.max(1, total), done];
});
on("end", ({said}) => {
  hasEnded = true;
  source.close();
  say(said);
});
source.onerror = () => {
  if (source.readyState === EventSource.CLOSED) {
    say("No more viewers are let in, or dmpc has ended: reload the page to ask again.");
  } else if (++tries < triesMax) {
    say("The connection is lost, and is asked for again.");
  } else {
    source.close();
    say("dmpc answers no more: it has ended, or was killed, before it could say so. What stands here is the last picture.");
  }
};
