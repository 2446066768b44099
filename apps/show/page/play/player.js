// The player: its controls, what lies under the pointer in words, the view's command, and the clock.
const calm = matchMedia("(prefers-reduced-motion: reduce)");
const player = {playing: false, last: 0, waits: false, frames: []};

/// Where in an element the pointer is, 0 to 1 each way.
const placeIn = (element, event) => {
  const box = element.getBoundingClientRect();
  return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height].map((share) => Math.max(0, Math.min(1, share)));
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
  pointed = hasChoice(choice) || choice.x >= 0 || "at" in choice ? choice : null;
  changed();
};
const settle = (choice) => {
  pointed = null;
  change({...nothing, ...choice});
};
const partText = () => moment() >= 0 ? "at " + timeText(moment()) : isWhole() ? "in the whole run" : state.to > state.from ? `from ${timeText(state.from)} to ${timeText(state.to)}` : "at " + timeText(state.t);
/// Of all runs, but what one alone has.
const wordsOf = (choice) => {
  const isOfAll = choice.x >= 0 || "at" in choice || (choice.node >= 0 && choice.peer < 0);
  const said = runs.filter(({index}) => isOfAll || index === choice.run).map((run) => {
    const text = choice.x >= 0 ? pixelText(run, choice) : sayings.map((say) => say(run, choice)).find((words) => words) || ("at" in choice ? momentText(run) : "");
    return text && letterOf(run) ? letterOf(run) + ": " + text : text;
  });
  return said.filter((text) => text).join(" ") || "Point at a pixel, a moment of a node, a link or a page, or move over them by arrow keys. A click keeps it chosen, Escape lets go.";
};

/// Of all nodes together.
const momentText = (run) => `All nodes, ${partText()}: ${sharesText(sharesOf(run, [...Array(run.nodes).keys()]), run)}.`;

/// A run's own command, with what writes this view down.
const commandText = (run) => {
  const own = run.words.filter((word) => !/^'?--(trace|trace-window)=/.test(word));
  const added = state.heat && !own.some((word) => word.startsWith(`--heatmap=${state.heat}:`)) ? [`--heatmap=${state.heat}:${state.heat}.png`] : [];
  if (state.to > state.from) {
    added.push("--trace=part.pftrace", `--trace-window=${state.from.toFixed(6)},${state.to.toFixed(6)}`);
  }
  return [...own, ...added].join(" ");
};

// What is drawn, each part anew only where something changed that it shows

const parts = [];
const part = (keyOf, draw) => parts.push({keyOf, draw, key: null});
const draw = () => {
  for (const each of parts) {
    const key = each.keyOf();
    if (key === each.key) continue;
    each.key = key;
    each.draw();
  }
};
const drawAll = () => {
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
const stepKey = () => runs.map((run) => stepsShown(run).join()).join();

/// Of each run a share and a bar; above the parts of computing their sum, which is in the closing lines.
const startNames = (box) => {
  const table = make("table", {id: "names"}, box), head = make("tr", {}, make("thead", {}, table)), body = make("tbody", {}, table);
  make("th", {scope: "col", class: "text"}, head, "what");
  for (const run of runs) {
    make("th", {scope: "col"}, head, letterOf(run) || "share");
    make("td", {}, head);
  }
  const own = [...new Set(runs.flatMap(({works}) => works.map(({name}) => name)))], waits = runs.flatMap((run) => run.waits.map(({name}) => name)), isPart = (name) => isSummed && computes(name);
  const isSummed = own.some(computes) && runs[0].clock === "virtual time", rests = [...new Set(runs.map(({rest}) => rest))], inOrder = (of) => own.filter(of);
  const names = [...(isSummed ? ["computing"] : []), ...inOrder(computes), ...inOrder((name) => waits.includes(name)), ...inOrder((name) => !computes(name) && !waits.includes(name)), ...rests].map((name) => {
    const row = make("tr", {}, body);
    make("th", {scope: "row", class: isPart(name) ? "text part" : "text"}, row, name);
    return {name, cells: runs.map(() => {
      const text = make("td", {}, row), bar = make("div", {class: "bar"}, make("td", {class: "bars"}, row));
      bar.style.background = colorOf(name);
      return {text, bar};
    })};
  });
  const whose = make("p", {class: "note"}, box);
  part(() => stepKey() + choiceKey(chosen()), () => {
    const nodes = summed(runs[0], chosen());
    runs.forEach((run, i) => {
      const all = sharesOf(run, summed(run, chosen())), shares = Object.fromEntries(all);
      shares.computing = all.reduce((sum, [name, share]) => sum + (computes(name) ? share : 0), 0);
      // Each is the distance of two rounded ends, as in closing lines, so that all add up to 100 %.
      const ends = [{exact: 0, shown: 0}, {exact: 0, shown: 0}], percentOf = (name) => {
        const end = ends[+isPart(name)], before = end.shown;
        end.exact += shares[name];
        end.shown = Math.floor(1000 * end.exact + .5);
        return percentText((end.shown - before) / 1000);
      };
      for (const {name, cells} of names) {
        cells[i].text.textContent = name in shares ? percentOf(name) : "";
        cells[i].bar.style.width = 100 * (shares[name] || 0) + "%";
      }
    });
    whose.textContent = (nodes.length < runs[0].nodes ? "Of node " + nodes.join(" and ") : "Of all nodes") + ", " + partText() + ".";
  });
};

// Controls

/// One that follows the state at `key`.
const chooser = (bar, text, key, options) => {
  const select = control(bar, text, "select", {id: key});
  for (const [value, name] of options) make("option", {value}, select, name);
  select.addEventListener("change", () => change({[key]: key === "run" ? +select.value : select.value}));
  part(() => state[key], () => { select.value = state[key]; });
};
/// A slider that follows the state at `key`, said as text.
const slider = (bar, text, key, id, whole, textOf) => {
  const range = control(bar, text, "input", {id, type: "range", min: 0, max: whole, step: "any"});
  range.addEventListener("input", () => {
    state[key] = +range.value;
    changed();
  });
  range.addEventListener("change", writeAddress);
  part(() => state[key], () => {
    range.value = state[key];
    range.setAttribute("aria-valuetext", textOf(state[key]));
  });
  return range;
};
const startBar = (bar) => {
  const button = make("button", {type: "button", id: "play"}, bar, "Play");
  button.addEventListener("click", () => play(!player.playing));
  slider(bar, "Time", "t", "time", totalMs, timeText);
  const now = make("output", {id: "now", for: "time"}, bar);
  part(() => state.t, () => { now.textContent = `${timeText(state.t)} of ${timeText(totalMs)}`; });
  const speed = player.speed = control(bar, "Whole run in", "select", {id: "speed"});
  for (const seconds of [60, 20, 8]) make("option", {value: seconds}, speed, seconds + " s");
  speed.value = "20";
  chooser(bar, "Over the picture", "heat", ["", ...heats].map((name) => [name, name || "nothing"]));
  const mix = slider(bar, "Mix", "mix", "mix", 100, (value) => value.toFixed() + " %");
  part(() => state.heat, () => { mix.disabled = !state.heat; });
  if (runs.length > 1) chooser(bar, "Cards of", "run", runs.map((run) => [run.index, letterOf(run)]));
};

// The clock

const play = (on) => {
  player.playing = on;
  byId("play").textContent = on ? "Pause" : "Play";
  byId("said").setAttribute("aria-live", on ? "off" : "polite");
  if (!on) {
    writeAddress();
    return;
  }
  if (state.t >= totalMs) state.t = 0;
  player.last = performance.now();
  requestAnimationFrame(tick);
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

const startKeys = () => document.addEventListener("keydown", (event) => {
  if (event.key === "Escape") settle({from: 0, to: 0, why: -1});
  if (event.key !== " " || (event.target !== document.body && event.target.tagName !== "CANVAS")) return;
  event.preventDefault();
  play(!player.playing);
});

const card = (parent, heading, id) => {
  const box = make("section", {"aria-labelledby": id}, parent);
  make("h3", {id}, box, heading);
  return make("div", {}, box);
};
/// What only one run has: of several those of the chosen one are shown.
const startCards = (run, grid) => {
  for (const {id, headingOf, isWide, start} of cards) {
    const heading = headingOf(run);
    if (!heading) continue;
    const box = card(grid, (letterOf(run) && letterOf(run) + ": ") + heading, id + "-head" + (run.index || "")), section = box.parentElement;
    section.className = isWide ? "wide" : "";
    if (runs.length > 1) part(() => state.run, () => { section.hidden = state.run !== run.index; });
    start(run, box);
  }
};
const start = async () => {
  const begin = performance.now(), section = make("section", {id: "player", "aria-labelledby": "player-head"});
  document.documentElement.dataset.plays = "";  // the picture of the page's opening gives way to the one that plays
  (document.querySelector("nav") || document.querySelector("h1")).after(section);
  make("h2", {id: "player-head"}, section, runs.length > 1 ? "The runs, on one clock" : "The run, as it went");
  startBar(make("div", {id: "bar", role: "group", "aria-label": "Playing"}, section));
  const said = make("p", {id: "said", role: "status"}, section), grid = make("div", {class: runs.length > 1 ? "run two" : "run"}, section);
  const boxOf = (run, name) => make("div", {class: name}, grid, letterOf(run) && `${letterOf(run)}: ${run.name}, ${timeText(run.total_ns / 1e6)}`);
  for (const run of runs) await startPixels(run, boxOf(run, "picture"));
  for (const run of runs) startTime(run, boxOf(run, "rows"));
  const places = make("div", {class: "cards"}, section);
  startNames(card(places, "What the time goes to", "names-head"));
  for (const run of runs) startCards(run, places);
  const view = card(section, "This view", "view-head"), command = make("pre", {class: "copy", id: "command", tabindex: 0, role: "region", "aria-label": "The command of this view"}, view);
  Object.assign(usual, state);
  readAddress();
  for (const act of starters) act();
  part(() => choiceKey(chosen()) + (hasChoice(chosen()) ? stepKey() : ""), () => { said.textContent = wordsOf(chosen()); });
  part(() => [state.from, state.to, state.heat, choiceKey(state)].join(), () => { command.textContent = commandText(runs[state.run]); });
  startKeys();
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
