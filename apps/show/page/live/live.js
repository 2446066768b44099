"use strict";
// A render while it goes on, as its server tells it (apps/render/live_events.h): the picture tile by tile, and what each node did
// step by step.
const byId = (id) => document.getElementById(id);
const colors = {tracing: "#0072b2", shading: "#56b4e9", paging: "#009e73", packing: "#cc79a7", messages: "#e69f00", control: "#8c6d46"};
const triesMax = 3;  // of EventSource, one every few seconds
let head = null, shot = null, raster = null, shares = [], doublings = 0, tries = 0;

const make = (name, parent, text = "") => {
  const element = document.createElement(name);
  element.textContent = text;
  parent.append(element);
  return element;
};

const say = (text) => {
  if (byId("said").textContent !== text) byId("said").textContent = text;
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
const begin = (told) => {
  head = told;
  doublings = 0;
  shot = sized(byId("shot"), head.width, head.height);
  byId("nodes").hidden = !head.nodes;
  byId("unseen").hidden = head.nodes > 0;
  raster = sized(byId("raster"), head.steps, head.nodes * Math.max(1, Math.floor(256 / (head.nodes || 1))));
  clear();
  byId("shares").replaceChildren();
  shares = head.works.map((work) => {
    const item = make("li", byId("shares")), swatch = make("span", item);
    swatch.className = "swatch";
    swatch.style.background = colors[work];
    make("span", item, work);
    return make("b", item);
  });
};

const clear = () => raster.clearRect(0, 0, raster.canvas.width, raster.canvas.height);

const drawTile = ({x, y, width, height, rgb}) => {
  const letters = atob(rgb), image = new ImageData(width, height);
  for (let i = 0, from = 0; i < image.data.length; ++i) image.data[i] = i % 4 === 3 ? 255 : letters.charCodeAt(from++);
  shot.putImageData(image, x, y);
};

// A column of the raster: of each node the work that took most, the paler the less it did in all. Those of another frame, or from
// before steps became longer, come late and are passed over.
const drawStep = (told) => {
  if (told.frame !== head.frame || told.doublings < doublings) return;
  if (told.doublings > doublings) clear();
  doublings = told.doublings;
  const letters = atob(told.cells), height = raster.canvas.height / head.nodes, image = new ImageData(1, raster.canvas.height);
  for (let y = 0; y < image.height; ++y) {
    const cell = letters.charCodeAt(Math.floor(y / height)), color = parseInt(colors[head.works[cell % head.works.length]].slice(1), 16);
    const share = Math.floor(cell / head.works.length) / head.levels;
    image.data.set([color >> 16, color >> 8 & 255, color & 255, Math.round(255 * share)], 4 * y);
  }
  raster.putImageData(image, told.step, 0);
  byId("until").textContent = `${Math.round(told.ms / 1000 / (told.step + 1) * head.steps)} s`;
};

const tellState = (told) => {
  say(told.said);
  tries = 0;
  const bar = byId("done");
  [bar.max, bar.value] = [Math.max(1, told.total), told.done];
  const facts = [["Time by the wall clock", `${amount(told.ms / 1000)} s`], ["Pixels done", `${amount(told.done)} of ${amount(told.total)}`]];
  if (told.pass > 1) facts.push(["Pass", String(told.pass)]);
  if (head && head.nodes) {
    if (head.modelled) facts.push(["Virtual time", `${amount(told.ns / 1e6)} ms`]);
    facts.push(["Packets sent", amount(told.packets)], ["Bytes sent", inUnits(told.bytes, "B")]);
  }
  byId("facts").replaceChildren();
  for (const [name, value] of facts) {
    const box = make("div", byId("facts"));
    make("dt", box, name);
    make("dd", box, value);
  }
  told.shares.forEach((share, i) => { if (shares[i]) shares[i].textContent = `${(100 * share).toFixed(1)} %`; });
};

byId("stop").addEventListener("click", async () => {
  byId("stop").disabled = true;
  try {
    const answer = await fetch("stop", {method: "POST", headers: {"Content-Type": "application/json"}, body: "{}"});
    if (!answer.ok) say(await answer.text());
  } catch {
    say("dmpc does not answer.");
  }
});

const source = new EventSource("events");
const on = (name, act) => source.addEventListener(name, (event) => act(JSON.parse(event.data)));
on("head", begin);
on("state", tellState);
on("step", (step) => { if (head) drawStep(step); });
on("tile", (tile) => { if (head) drawTile(tile); });
on("end", ({said, figures, page}) => {
  source.close();
  byId("ways").hidden = true;
  byId("when").textContent = "What all of them did, in parts of their time";
  say(page ? `${said} Its page comes.` : `${said} The run has ended, and what stands here is the last of it.`);
  byId("figures").textContent = figures;
  byId("figures").hidden = !figures;
  if (page) location.reload();
});
source.onerror = () => {
  if (source.readyState === EventSource.CLOSED) {
    say("No more viewers are let in, or the run is over: reload the page to ask again.");
  } else if (++tries < triesMax) {
    say("The connection is lost, and is asked for again.");
  } else {
    source.close();
    say("dmpc answers no more: it has ended, or was killed, before it could say so. What stands here is the last that was told.");
  }
};
