// The player: its controls, what lies under the pointer in words, the view's command, and the clock.
const calm = matchMedia("(prefers-reduced-motion: reduce)");
const player = {playing: false, last: 0, waits: false, frames: [], keys: new Map()};

/// Where in an element the pointer is, 0 to 1 each way.
const placeIn = (element, event) => {
  const box = element.getBoundingClientRect();
  return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height].map((part) => Math.max(0, Math.min(1, part)));
};
/// A cleared canvas as wide as there is room, in its own pixels: pen and width. Square unless `high`.
const square = (canvas, high = 0) => {
  const wide = canvas.parentElement.clientWidth, tall = high || wide;
  const [inner, outer] = [wide, tall].map((length) => Math.round(length * devicePixelRatio));
  if (canvas.width !== inner || canvas.height !== outer) [canvas.width, canvas.height] = [inner, outer];
  canvas.style.height = tall + "px";
  const pen = canvas.getContext("2d");
  pen.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
  pen.clearRect(0, 0, wide, tall);
  return [pen, wide];
};

/// Under the pointer, until it leaves or a click settles it.
const point = (choice) => {
  pointed = hasChoice(choice) || choice.x >= 0 ? choice : null;
  changed();
};
const settle = (choice) => {
  pointed = null;
  choose(choice);
  writeAddress();
  changed();
};
const partText = () => state.to > state.from ? `from ${timeText(state.from)} to ${timeText(state.to)}` : "at " + timeText(state.t);
const wordsOf = (choice) => choice.x >= 0 ? pixelText(choice) : choice.peer >= 0 ? pairText(choice) : choice.link >= 0 ? linkText(choice.link) :
  choice.page >= 0 ? pageText(choice.page) : choice.node >= 0 ? nodeText(choice.node) :
  "Point at a pixel, a node, a link or a page, or move over them by arrow keys. A click keeps it chosen, Escape lets go.";

/// The run's own command, with what writes this view down.
const commandText = () => {
  const own = data.words.filter((word) => !/^'?--(trace|trace-window|trace-nodes)=/.test(word));
  const added = state.heat && !own.some((word) => word.startsWith(`--heatmap=${state.heat}:`)) ? [`--heatmap=${state.heat}:${state.heat}.png`] : [];
  if (state.to > state.from) {
    added.push("--trace=part.json", `--trace-window=${state.from.toFixed(6)},${state.to.toFixed(6)}`);
    const nodes = summed(state);
    if (nodes.length < data.nodes) added.push("--trace-nodes=" + nodes.join(","));
  }
  return [...own, ...added].join(" ");
};

// What is drawn, each part anew only where something changed that it shows

const parts = [];
const part = (keyOf, draw) => parts.push({keyOf, draw, key: null});
const draw = () => {
  for (const each of parts) {
    const key = each.keyOf();
    if (key !== each.key) {
      each.key = key;
      each.draw();
    }
  }
};
const drawAll = () => {
  sizePixels();
  sizeTime();
  for (const each of parts) each.key = null;
  draw();
};
/// Draws before the next frame, however often it is called till then.
const changed = () => {
  if (player.waits || player.playing) return;
  player.waits = true;
  requestAnimationFrame(() => {
    player.waits = false;
    draw();
  });
};
const stepKey = () => stepsShown().join();

const startNames = (box) => {
  const table = make("table", {id: "names"}, box), head = make("tr", {}, make("thead", {}, table)), body = make("tbody", {}, table);
  for (const [text, type] of [["what", "text"], ["share", ""], ["", "bar"]]) make(text ? "th" : "td", text ? {scope: "col", class: type} : {}, head, text);
  const rows = [...works.map((work) => work.name), restName].map((name) => {
    const row = make("tr", {}, body);
    make("th", {scope: "row", class: "text"}, row, name);
    const share = make("td", {}, row), bar = make("div", {class: "bar"}, make("td", {class: "bars"}, row));
    bar.style.background = workColors[name] || "var(--line)";
    return {share, bar};
  });
  const whose = make("p", {class: "note"}, box);
  part(() => stepKey() + choiceKey(chosen()), () => {
    const nodes = summed(chosen()), [first, last] = stepsShown(), shares = works.map((work, k) => nodes.reduce((sum, node) => sum + shareOf(k, node, first, last), 0) / nodes.length);
    [...shares, Math.max(0, 1 - shares.reduce((a, b) => a + b, 0))].forEach((share, i) => {
      rows[i].share.textContent = percentText(share);
      rows[i].bar.style.width = 100 * share + "%";
    });
    whose.textContent = (nodes.length < data.nodes ? "Of node " + nodes.join(" and ") : "Of all nodes") + ", " + partText() + ".";
  });
};

// Controls

const startBar = (bar) => {
  const button = make("button", {type: "button", id: "play"}, bar, "Play");
  button.addEventListener("click", () => play(!player.playing));
  const slider = control(bar, "Time", "input", {id: "time", type: "range", min: 0, max: 1000, step: "any"});
  slider.addEventListener("input", () => {
    state.t = slider.value / 1000 * totalMs;
    changed();
  });
  slider.addEventListener("change", writeAddress);
  const now = make("output", {id: "now", for: "time"}, bar);
  const speed = player.speed = control(bar, "Whole run in", "select", {id: "speed"});
  for (const [seconds, text] of [[60, "60 s"], [20, "20 s"], [8, "8 s"]]) make("option", {value: seconds}, speed, text);
  speed.value = "20";
  const heat = control(bar, "Over the picture", "select", {id: "heat"});
  for (const name of ["", ...Object.keys(fields), "done"]) make("option", {value: name}, heat, name || "nothing");
  heat.addEventListener("change", () => {
    state.heat = heat.value;
    writeAddress();
    changed();
  });
  const mix = control(bar, "Mix", "input", {id: "mix", type: "range", min: 0, max: 100});
  mix.addEventListener("input", () => {
    state.mix = +mix.value;
    changed();
  });
  mix.addEventListener("change", writeAddress);
  part(() => state.t, () => {
    now.textContent = `${timeText(state.t)} of ${timeText(totalMs)}`;
    slider.value = state.t / totalMs * 1000;
    slider.setAttribute("aria-valuetext", timeText(state.t));
  });
  part(() => state.heat + state.mix, () => {
    heat.value = state.heat;
    mix.value = state.mix;
    mix.setAttribute("aria-valuetext", state.mix + " %");
    mix.disabled = !state.heat;
  });
};

// The clock

const play = (on) => {
  player.playing = on;
  byId("play").textContent = on ? "Pause" : "Play";
  byId("said").setAttribute("aria-live", on ? "off" : "polite");
  if (on) {
    if (state.t >= totalMs) state.t = 0;
    player.last = performance.now();
    requestAnimationFrame(tick);
  } else {
    writeAddress();
    changed();
  }
};
const tick = (now) => {
  if (!player.playing) return;
  const begin = performance.now();
  state.t = Math.min(totalMs, state.t + Math.max(0, now - player.last) / 1000 / +player.speed.value * totalMs);
  player.last = now;
  draw();
  player.frames.push(performance.now() - begin);  // how long a script held the frame, for a benchmark
  if (player.frames.length > 300) player.frames.shift();
  if (state.t >= totalMs) play(false);
  else if (calm.matches) setTimeout(() => requestAnimationFrame(tick), 1000);
  else requestAnimationFrame(tick);
};

const startKeys = (section) => {
  document.addEventListener("keydown", (event) => {
    const isFree = event.target === document.body || event.target.tagName === "CANVAS";
    if (event.key === " " && isFree) {
      event.preventDefault();
      play(!player.playing);
    } else if (event.key === "Escape") {
      Object.assign(state, {from: 0, to: 0, why: -1});
      settle(nothing);
    }
  });
  for (const canvas of section.querySelectorAll("canvas")) {
    canvas.addEventListener("pointerleave", () => point(nothing));
    canvas.addEventListener("click", () => { if (pointed) settle(pointed); });
  }
};

const card = (parent, heading, id) => {
  const box = make("section", {"aria-labelledby": id}, parent);
  make("h3", {id}, box, heading);
  return make("div", {}, box);
};
const start = async () => {
  const begin = performance.now(), section = make("section", {id: "player", "aria-labelledby": "player-head"});
  (document.querySelector("nav") || document.querySelector("h1")).after(section);
  make("h2", {id: "player-head"}, section, "The run, as it went");
  startBar(make("div", {id: "bar", role: "group", "aria-label": "Playing"}, section));
  const said = make("p", {id: "said", role: "status"}, section);
  const run = make("div", {class: "run"}, section), left = make("div", {}, run), right = make("div", {}, run);
  await startPixels(left);
  startTime(right);
  const legend = make("p", {class: "note"}, right, data.clock === "virtual time" ? "Virtual time. " : "By the wall clock, which compares schedules. ");
  for (const work of works) {
    make("span", {class: "swatch"}, legend).style.background = workColors[work.name];
    legend.append(` ${work.name} `);
  }
  startLevels(right);
  const cards = make("div", {class: "cards"}, section);
  startNames(card(cards, "What the time goes to", "names-head"));
  const place = card(cards, "The machine", "machine-head");
  startMachine(place);
  make("p", {class: "note"}, place, "Discs: computing at that time. " + (over.links ? "Links: bytes at that time." : data.links.length ? "Links: held over the whole run." : "Links are known of modelled machines."));
  placeMachine();
  if (data.pairs && data.pairs.side > 1) {
    const box = card(cards, data.pairs.what === "pages" ? "Who fetches from whom" : "Who sends rays to whom", "pairs-head");
    startPairs(box);
    make("p", {class: "note"}, box, `Rows: ${data.pairs.row}. Columns: ${data.pairs.column}. ${over.pairs ? `At that time, at most ${numberText(over.pairs.most)} ${data.over.pairs.what} in ${timeText(over.pairs.step_ns / 1e6)}` :
      `The whole run, at most ${numberText(machine.mostPairs)} ${data.pairs.what}`}.`);
    part(() => (over.pairs ? stepKey() : "") + choiceKey(chosen()), drawPairs);
  }
  if (data.pages.length) {
    startPages(card(cards, "The hottest pages", "pages-head"));
    part(() => (over.pages ? stepKey() : "") + choiceKey(chosen()), drawPages);
  }
  if (causes) {
    const box = card(cards, "Why it took so long", "why-head");
    box.parentElement.className = "wide";
    startWhy(box);
  }
  const view = card(section, "This view", "view-head"), command = make("pre", {class: "copy", id: "command", tabindex: 0, role: "region", "aria-label": "The command of this view"}, view);
  readAddress();
  const whatIfBox = byId("what-if");
  if (whatIfBox) part(() => [state.cache, state.dots, whatIfBox.clientWidth].join(), startWhatIf(whatIfBox, data.forecast, state, writeAddress));
  part(() => [state.t, state.heat, state.mix, choiceKey(chosen())].join(), drawPixels);
  part(() => [state.t, state.from, state.to, state.why, choiceKey(chosen())].join(), drawTime);
  part(() => stepKey() + choiceKey(chosen()), drawMachine);
  part(() => choiceKey(chosen()) + (hasChoice(chosen()) && chosen().x < 0 ? stepKey() : ""), () => { said.textContent = wordsOf(chosen()); });
  part(() => [state.from, state.to, state.heat, choiceKey(state)].join(), () => { command.textContent = commandText(); });
  startKeys(section);
  drawAll();
  new ResizeObserver(drawAll).observe(section);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawAll);
  addEventListener("hashchange", () => {
    if (!location.hash.includes("=")) return;
    readAddress();
    changed();
  });
  document.documentElement.dataset.loaded = Math.round(performance.now() - begin);
};
start();
