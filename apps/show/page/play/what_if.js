// What if caches had another size: the band of predicted run times, or of faults where times say nothing, paler where it is vague, and
// runs as dots.
/// Fills `box`. What is asked for is in `state`: cache (pages) and dots (1 or 0); `settle` is told when it changed. Gives what draws it anew.
const startWhatIf = (box, {unit = "ns", cache: own, widest, why, points, runs}, state, settle) => {
  const isOfTime = unit === "ns", spread = ([, , least, most]) => most / Math.max(1, least) - 1, isNarrow = (point) => spread(point) <= widest, pagesText = (count) => count === 1 ? "1 page" : numberText(count) + " pages";
  const ms = (ns) => (isOfTime ? ns / 1e6 : ns).toLocaleString("en", {maximumSignificantDigits: 4}), unitText = isOfTime ? " ms" : " faults", number = () => Math.max(0, points.findLastIndex(([pages]) => pages <= state.cache));
  const bar = make("div", {class: "asks"}, box);
  const slider = control(bar, "What if a cache had", "input", {id: "cache", type: "range", min: 0, max: points.length - 1}), said = make("output", {for: "cache"}, bar);
  const dots = control(bar, "Show runs", "input", {id: "dots", type: "checkbox"});
  const picture = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const add = (name, attributes, text = "") => {
    const element = document.createElementNS(picture.namespaceURI, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.textContent = text;
    picture.append(element);
  };
  box.append(picture);
  make("p", {class: "note"}, box, "Band: predicted from the run with " + pagesText(own) + " alone, pale where it is wider than " + percentText(widest) + ". Dots: runs that were made. " + why);

  const words = ([pages, faults, least, most]) => {
    const run = state.dots && runs.find(([size]) => size === pages);
    const [low, high] = [ms(least), ms(most)], made = run && pages !== own ? `; a run ${isOfTime ? "took" : "had"} ${ms(run[1])}${unitText}.` : ".";
    return pagesText(pages) + ": " + (pages === own ? "the run from which all else is predicted, " + low + unitText :
      `predicted ${low === high ? low : low + " to " + high}${unitText}` + (isOfTime ? `, with ${numberText(faults)} faults` : "") +
      (isNarrow([pages, faults, least, most]) ? "" : `, which is vague: the ends lie ${percentText(spread([pages, faults, least, most]))} apart`)) + made;
  };
  const show = () => {
    const wide = Math.max(260, box.clientWidth - 20), high = 240, left = 64, right = wide - 14, top = 14, bottom = high - 38, at = points[number()];
    const times = [...points.flatMap((point) => point.slice(2)), ...runs.map(([, ns]) => ns)].map((time) => Math.max(1, time)), sizes = [...points, ...runs].map(([pages]) => pages);
    const scale = (values, from, to) => {
      const low = Math.log(Math.min(...values)), span = Math.log(Math.max(...values)) - low || 1;
      return (value) => from + (to - from) * (Math.log(value) - low) / span;
    };
    const x = scale(sizes, left, right), y = scale(times.flatMap((ns) => [ns * .9, ns * 1.1]), bottom, top);
    said.textContent = words(at);
    slider.value = number();
    slider.setAttribute("aria-valuetext", said.textContent);
    dots.checked = !!state.dots;
    picture.replaceChildren();
    for (const [key, value] of Object.entries({width: wide, height: high, role: "img", "aria-label": isOfTime ? "Run time by the size of the caches: the table below says the same" : "Faults by the size of the caches: the table above says nearly the same"})) picture.setAttribute(key, value);
    for (let power = Math.floor(Math.log10(Math.min(...times))); power <= Math.log10(Math.max(...times)); ++power) for (const digit of [1, 2, 5]) {
      const ns = digit * 10 ** power, place = y(ns);
      if (place < top || place > bottom) continue;
      add("line", {class: "grid", x1: left, x2: right, y1: place, y2: place});
      add("text", {x: left - 6, y: place + 4, "text-anchor": "end"}, ms(ns) + unitText);
    }
    for (let size = 1; size <= Math.max(...sizes); size *= 4) if (x(size) >= left) add("text", {x: x(size), y: bottom + 16, "text-anchor": "middle"}, numberText(size));
    add("text", {x: (left + right) / 2, y: high - 4, "text-anchor": "middle"}, "cache of a node (pages)");
    // From one size to the next, so that each part is as pale as it is vague.
    points.slice(1).forEach((point, i) => {
      const part = [points[i], point], edge = (k) => part.map((end) => x(end[0]) + "," + y(Math.max(1, end[k])));
      add("polygon", {class: part.every(isNarrow) ? "band" : "band vague", points: [...edge(2), ...edge(3).reverse()].join(" ")});
      for (const k of [2, 3]) add("polyline", {class: "edge", points: edge(k).join(" ")});
    });
    if (state.dots) for (const [pages, ns] of runs) add("circle", {class: "dot", cx: x(pages), cy: y(ns), r: 5});
    add("line", {class: "edge", x1: x(at[0]), x2: x(at[0]), y1: top, y2: bottom});
    add("circle", {class: "asked", cx: x(at[0]), cy: y(Math.sqrt(Math.max(1, at[2]) * Math.max(1, at[3]))), r: 8});
  };
  slider.addEventListener("input", () => {
    state.cache = points[slider.value][0];
    show();
  });
  slider.addEventListener("change", settle);
  dots.addEventListener("change", () => {
    state.dots = +dots.checked;
    show();
    settle();
  });
  return show;
};
