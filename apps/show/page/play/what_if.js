// What if caches had another size: the band of predicted run time, drawn where it is narrow enough, and runs as dots.
/// Fills `box`. What is asked for is in `state`: cache (pages) and dots (1 or 0); `settle` is told when it changed. Gives what draws it anew.
const startWhatIf = (box, {cache: own, widest, why, points, runs}, state, settle) => {
  const isNarrow = ([, , least, most]) => most / least - 1 <= widest, pagesText = (count) => count === 1 ? "1 page" : numberText(count) + " pages";
  const ms = (ns) => (ns / 1e6).toLocaleString("en", {maximumSignificantDigits: 4}), number = () => Math.max(0, points.findLastIndex(([pages]) => pages <= state.cache));
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
  make("p", {class: "note"}, box, "Band: predicted from the run with " + pagesText(own) + " alone, and not where it would be wider than " + percentText(widest) + ". Dots: runs that were made. " + why);

  const words = ([pages, faults, least, most]) => {
    const run = state.dots && runs.find(([size]) => size === pages);
    return pagesText(pages) + ": " + (pages === own ? "the run from which all else is predicted, " + ms(least) + " ms" : isNarrow([pages, faults, least, most]) ?
      `predicted ${ms(least)} to ${ms(most)} ms, with ${numberText(faults)} faults` : `not predicted, as the two readings lie ${percentText(most / least - 1)} apart, more than ${percentText(widest)}`) +
      (run && pages !== own ? `; a run took ${ms(run[1])} ms.` : ".");
  };
  const show = () => {
    const wide = Math.max(260, box.clientWidth - 20), high = 240, left = 64, right = wide - 14, top = 14, bottom = high - 38, at = points[number()];
    const times = [...points.filter(isNarrow).flatMap((point) => point.slice(2)), ...runs.map(([, ns]) => ns)], sizes = [...points, ...runs].map(([pages]) => pages);
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
    for (const [key, value] of Object.entries({width: wide, height: high, role: "img", "aria-label": "Run time by the size of the caches: the table below says the same"})) picture.setAttribute(key, value);
    for (let power = Math.floor(Math.log10(Math.min(...times))); power <= Math.log10(Math.max(...times)); ++power) for (const digit of [1, 2, 5]) {
      const ns = digit * 10 ** power, place = y(ns);
      if (place < top || place > bottom) continue;
      add("line", {class: "grid", x1: left, x2: right, y1: place, y2: place});
      add("text", {x: left - 6, y: place + 4, "text-anchor": "end"}, ms(ns) + " ms");
    }
    for (let size = 1; size <= Math.max(...sizes); size *= 4) if (x(size) >= left) add("text", {x: x(size), y: bottom + 16, "text-anchor": "middle"}, numberText(size));
    add("text", {x: (left + right) / 2, y: high - 4, "text-anchor": "middle"}, "cache of a node (pages)");
    for (let first = 0, last; first < points.length; first = last + 1) {
      for (last = first; last < points.length && isNarrow(points[last]); ++last);
      const part = points.slice(first, last), edge = (k) => part.map((point) => x(point[0]) + "," + y(point[k]));
      if (part.length) for (const k of [2, 3]) add("polyline", {class: "edge", points: edge(k).join(" ")});
      if (part.length) add("polygon", {class: "band", points: [...edge(2), ...edge(3).reverse()].join(" ")});
    }
    if (state.dots) for (const [pages, ns] of runs) add("circle", {class: "dot", cx: x(pages), cy: y(ns), r: 5});
    add("line", {class: "edge", x1: x(at[0]), x2: x(at[0]), y1: top, y2: bottom});
    if (isNarrow(at)) add("circle", {class: "asked", cx: x(at[0]), cy: y(Math.sqrt(at[2] * at[3])), r: 8});
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
