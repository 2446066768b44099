// Plots of the page's tables, as apps/frontend/table/plot_data.h describes them: bars, curves and bands; and maps of
// numbers. What is at the pointer, or reached by arrow keys, is told below.
(() => {
  const titleHigh = 26, fieldHigh = 220, lineHigh = 17, letterWide = 6.6, widest = 570, slantedMost = 130;
  const svg = (name, attributes, parent, text = "") => {
    const element = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.textContent = text;
    parent.append(element);
    return element;
  };
  const rounded = (value) => Math.round(value * 100) / 100;
  const colorFor = ({name, color}) => partColors[name] || seriesColors[color % seriesColors.length];
  const isAgain = (series) => !partColors[series.name] && series.color >= seriesColors.length;
  const inkOf = (color) => ({color: color.slice(0, 7), opacity: isPale(color) ? parseInt(color.slice(7), 16) / 255 : 1});
  const scaleOf = ({least, most, log}, from, to) => {
    const of = log ? Math.log : (value) => value, low = of(least), span = of(most) - low || 1;
    return (value) => from + (to - from) * (of(value) - low) / span;
  };
  /// Fill of bars: waits are hatched, too, so that they differ without colours.
  const fillOf = (root, id, series) => {
    const whole = colorFor(series), {color, opacity} = inkOf(whole);
    if (!isPale(whole) && !isAgain(series)) return {fill: color};
    const tile = svg("pattern", {id, width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: `rotate(${45 + 35 * (series.color % 4)})`}, svg("defs", {}, root));
    svg("rect", {width: 6, height: 6, fill: color, "fill-opacity": opacity}, tile);
    svg("path", {d: "M0 0V6", stroke: color, "stroke-width": 2, "stroke-opacity": Math.max(.6, opacity)}, tile);
    return {fill: `url(#${id})`};
  };
  const dashOf = (i) => ["", "7 3", "2 3", "9 3 2 3"][i % 4];

  /// In reading order of a curve: one row for each x, the mean of several.
  const unique = (rows) => {
    const byX = new Map();
    for (const row of rows) byX.set(row[0], [...(byX.get(row[0]) || []), row]);
    return [...byX].sort(([a], [b]) => a - b).map(([x, all]) => [x, all.reduce((sum, row) => sum + row[1], 0) / all.length]);
  };
  const amountOf = ({digits, unit}, value) => value.toLocaleString("en", {maximumFractionDigits: Math.max(digits, value && Math.abs(value) < 1 ? 3 : 0)}) + (unit && " " + unit);
  /// All series at an x.
  const wordsAt = (plot, x) => {
    const at = plot.places ? (plot.x.label && plot.x.label + " ") + plot.places[x] : `${plot.x.label} ${amountOf(plot.x, x)}`;
    const said = plot.series.flatMap((series) => series.rows.filter((row) => row[0] === x && (row[1] !== 0 || plot.series.length < 3)).map(([, y, low, high]) =>
      `${plot.series.length > 1 || series.name !== plot.title ? series.name + " " : ""}${amountOf(series, y)}${low === undefined ? "" : ` (${amountOf(series, low)} to ${amountOf(series, high)})`}`));
    return `${at}: ${said.join(", ") || "nothing"}.`;
  };

  const drawAxes = (root, plot, field, x, y) => {
    const {left, right, top, bottom} = field, text = (attributes, words) => svg("text", {fill: "currentColor", ...attributes}, root, words);
    for (const [at, words] of plot.y.ticks) {
      svg("path", {d: `M${left} ${rounded(y(at))}H${right}`, stroke: "currentColor", "stroke-opacity": .18}, root);
      text({x: left - 6, y: rounded(y(at)) + 4, "text-anchor": "end"}, words);
    }
    svg("path", {d: `M${left} ${top}V${bottom}H${right}`, fill: "none", stroke: "currentColor", "stroke-opacity": .5}, root);
    for (const [at, words] of field.ticks) {
      const place = rounded(x(at));
      svg("path", {d: `M${place} ${bottom}v4`, stroke: "currentColor", "stroke-opacity": .5}, root);
      if (field.slants) text({"text-anchor": "end", transform: `translate(${place + 4} ${bottom + 14}) rotate(-50)`}, words.length * letterWide > slantedMost ? words.slice(0, Math.floor(slantedMost / letterWide) - 1) + "\u2026" : words);
      else text({x: place, y: bottom + 17, "text-anchor": "middle"}, words);
    }
    text({x: (left + right) / 2, y: field.labelY, "text-anchor": "middle"}, plot.x.label);
    text({"text-anchor": "middle", transform: `translate(12 ${(top + bottom) / 2}) rotate(-90)`}, plot.y.label);
    text({x: left, y: 15, "font-weight": 600}, plot.title);
  };
  const drawBars = (root, plot, fills, x, y, each) => {
    const sums = new Map(), count = plot.series.length, wide = plot.places ? each * .8 / (plot.stacked ? 1 : count) : 0;
    plot.series.forEach((series, i) => {
      for (const [at, value] of series.rows) {
        const from = plot.stacked ? sums.get(at) || 0 : plot.y.log ? plot.y.least : Math.max(0, plot.y.least), to = plot.stacked ? from + value : value;
        sums.set(at, to);
        const begin = plot.places ? x(at) - each * .4 + (plot.stacked ? 0 : i * wide) : x(at), width = plot.places ? wide : x(at + plot.width) - begin;
        if (to > from) svg("rect", {x: rounded(begin), y: rounded(y(to)), width: rounded(width), height: rounded(y(from) - y(to)), ...fills[i],
          stroke: "var(--card)", "stroke-width": plot.places && each > 8 ? .8 : 0}, root);
      }
    });
  };
  const drawBands = (root, {series}, fills, x, y, each) => {
    for (const {rows} of series) for (const [at, value, low, high, boxLow, boxHigh] of rows) {
      const wide = Math.min(40, each * .5), left = rounded(x(at) - wide / 2), right = rounded(x(at) + wide / 2), [low_, high_, value_, top, foot] = [low, high, value, boxHigh, boxLow].map((of) => rounded(y(of)));
      svg("path", {d: `M${x(at)} ${low_}V${high_}M${left} ${low_}H${right}M${left} ${high_}H${right}`, stroke: "currentColor"}, root);
      svg("rect", {x: left, y: top, width: right - left, height: Math.max(1, foot - top), ...fills[0], "fill-opacity": .55}, root);
      svg("path", {d: `M${left} ${value_}H${right}`, stroke: "currentColor", "stroke-width": 2.5}, root);
    }
  };
  const drawCurves = (root, {series}, x, y) => {
    series.forEach((one, i) => {
      const {color} = inkOf(colorFor(one)), rows = one.mark === "points" ? one.rows : unique(one.rows), places = rows.map((row) => [rounded(x(row[0])), rounded(y(row[1]))]);
      if (one.mark !== "points") svg("polyline", {points: places.join(" "), fill: "none", stroke: color, "stroke-width": 2, "stroke-dasharray": dashOf(i)}, root);
      for (const [px, py] of places) {
        const size = one.mark === "points" ? 4.5 : 2.5;
        if (i % 2) svg("rect", {x: px - size, y: py - size, width: 2 * size, height: 2 * size, fill: color}, root);
        else svg("circle", {cx: px, cy: py, r: size, fill: color}, root);
      }
    });
  };
  /// In as many columns as there is room for; stacked bars as they stand, the topmost first.
  const drawLegend = (root, plot, fills, wide, top) => {
    const all = plot.series.map((series, i) => ({series, i}));
    if (plot.stacked) all.reverse();
    const room = 26 + letterWide * Math.max(...plot.series.map(({name}) => name.length)), columns = Math.max(1, Math.floor((wide - 10) / room)), lines = Math.ceil(all.length / columns);
    all.forEach(({series, i}, k) => {
      const left = 10 + Math.floor(k / lines) * room, y = top + (k % lines) * lineHigh;
      if (plot.bars) svg("rect", {x: left, y: y + 2, width: 12, height: 12, ...fills[i]}, root);
      else svg("path", {d: `M${left} ${y + 8}h16`, stroke: inkOf(colorFor(series)).color, "stroke-width": series.mark === "points" ? 7 : 3, "stroke-dasharray": series.mark === "points" ? "7 9" : dashOf(i)}, root);
      svg("text", {x: left + 20, y: y + 12, fill: "currentColor"}, root, series.name);
    });
    return lines * lineHigh;
  };
  /// Names at places of bars, every so many where there is no room for all.
  const namesOf = ({places}, each) => {
    const longest = Math.max(...places.map((name) => name.length)), slants = longest > 3 && longest * letterWide > each, least = slants ? 14 : longest * letterWide + 6;
    let every = 1;
    for (let power = 1; every * each < least; power *= 10) every = [1, 2, 5, 10].map((digit) => digit * power).find((count) => count * each >= least) || 10 * power;
    return {slants, longest, ticks: places.map((name, i) => [i, name]).filter(([i]) => i % every === 0)};
  };
  const draw = (figure, plot, number) => {
    const old = figure.querySelector("svg"), wide = Math.max(260, Math.min(widest, figure.parentElement.clientWidth));
    if (old && +old.getAttribute("width") === wide) return;
    const root = svg("svg", {width: wide, role: "img", tabindex: 0, "font-family": "system-ui,sans-serif", "font-size": 12, xmlns: "http://www.w3.org/2000/svg"}, figure);
    const ticksWide = 26 + letterWide * Math.max(...plot.y.ticks.map(([, text]) => text.length), 1), right = wide - 22, top = titleHigh, bottom = top + fieldHigh;
    const slants = plot.places && namesOf(plot, (right - ticksWide) / plot.places.length).slants, left = slants ? Math.max(ticksWide, slantedMost * .65) : ticksWide;
    const each = plot.places ? (right - left) / plot.places.length : 0, names = plot.places ? namesOf(plot, each) : {slants: false, ticks: plot.x.ticks.filter((tick, i, all) => all.length < (right - left) / 52 || i % 2 === 0)};
    const low = bottom + (names.slants ? 18 + Math.min(slantedMost, names.longest * letterWide) * .77 : 18), field = {...names, left, right, top, bottom, labelY: low + 14};
    const x = plot.places ? (at) => left + (at + .5) * each : scaleOf(plot.x, left, right), y = scaleOf(plot.y, bottom, top);
    const fills = plot.series.map((series, i) => fillOf(root, `fill-${number}-${i}`, series)), place = svg("rect", {y: top, height: fieldHigh, width: 0, fill: "currentColor", "fill-opacity": .12}, root);
    drawAxes(root, plot, field, x, y);
    if (plot.series[0].mark === "bands") drawBands(root, plot, fills, x, y, each);
    else if (plot.bars) drawBars(root, plot, fills, x, y, each);
    else drawCurves(root, plot, x, y);
    const legendTop = plot.x.label ? low + 20 : low + 4, high = legendTop + (plot.series.length > 1 ? drawLegend(root, plot, fills, wide, legendTop) : 0) + 6;
    root.setAttribute("height", high);
    root.setAttribute("viewBox", `0 0 ${wide} ${high}`);
    root.setAttribute("aria-label", `Plot: ${plot.title}. Arrow keys go through it; the table has the same.`);
    if (old) old.replaceWith(root);
    else figure.prepend(root);
    listen(figure, root, plot, place, x, each);
  };
  const listen = (figure, root, plot, place, x, each) => {
    const all = [...new Set(plot.series.flatMap(({rows}) => rows.map(([at]) => at)))].sort((a, b) => a - b), said = figure.querySelector("output");
    const middle = (at) => plot.width ? (x(at) + x(at + plot.width)) / 2 : x(at);
    let now = -1;
    const show = (i) => {
      now = i;
      const wide = i < 0 ? 0 : plot.width ? x(all[i] + plot.width) - x(all[i]) : each || 3;
      place.setAttribute("x", i < 0 ? 0 : middle(all[i]) - wide / 2);
      place.setAttribute("width", wide);
      said.textContent = i < 0 ? "" : wordsAt(plot, all[i]);
    };
    root.addEventListener("pointermove", (event) => {
      const at = (event.clientX - root.getBoundingClientRect().left) * root.viewBox.baseVal.width / root.clientWidth;
      show(all.reduce((best, value, i) => Math.abs(middle(value) - at) < Math.abs(middle(all[best]) - at) ? i : best, 0));
    });
    root.addEventListener("pointerleave", () => show(-1));
    root.addEventListener("blur", () => show(-1));
    root.addEventListener("keydown", (event) => {
      const step = {ArrowLeft: -1, ArrowRight: 1, Home: -Infinity, End: Infinity}[event.key];
      if (!step) return;
      event.preventDefault();
      show(Math.max(0, Math.min(all.length - 1, now < 0 && step === -1 ? all.length - 1 : now + step)));
    });
  };
  // Maps of numbers.

  const levelsOf = ({levels}) => Uint8Array.from(atob(levels), (letter) => letter.charCodeAt(0));
  const valuesOf = (map) => map.values || [...levelsOf(map)].map((level) => level / 255 * map.most);
  /// Colours of shares, row by row, as an image of a dot each.
  const pictureOf = (shares, columns) => {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [columns, shares.length / columns];
    const pen = canvas.getContext("2d"), image = pen.createImageData(canvas.width, canvas.height);
    shares.forEach((share, i) => image.data.set([...heatAt(share), 255], 4 * i));
    pen.putImageData(image, 0, 0);
    return canvas.toDataURL();
  };
  const every = (count) => [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000].find((step) => count <= 8 * step) || count;
  const counted = (count) => [...Array(count).keys()].filter((i) => i % every(count) === 0).map((i) => [i + .5, String(i)]);
  const drawMap = (figure, map) => {
    const old = figure.querySelector("svg"), wide = Math.max(260, Math.min(widest, figure.parentElement.clientWidth));
    if (old && +old.getAttribute("width") === wide) return;
    const {rows, columns, most} = map, left = 58, right = wide - 96, top = titleHigh + 8, across = right - left, deep = Math.max(140, Math.min(330, across, rows * across / 8)), bottom = top + deep;
    const cellWide = across / columns, cellHigh = deep / rows, values = valuesOf(map), share = (value) => most > 0 ? value / most : 0, scaleLeft = right + 16;
    const root = svg("svg", {width: wide, height: bottom + 48, viewBox: `0 0 ${wide} ${bottom + 48}`, role: "img", tabindex: 0, "font-family": "system-ui,sans-serif", "font-size": 12, xmlns: "http://www.w3.org/2000/svg",
      "aria-label": `${map.title}: ${map.value_label} by ${map.row_label} and ${map.column_label}. Arrow keys go through it.`}, figure);
    const text = (attributes, words, parent = root) => svg("text", {fill: "currentColor", ...attributes}, parent, words), tick = (d) => svg("path", {d, stroke: "currentColor", "stroke-opacity": .5}, root);
    const squares = (shares, count, x, width) => {
      svg("image", {x, y: top, width, height: deep, preserveAspectRatio: "none", "image-rendering": "pixelated", href: pictureOf(shares, count)}, root);
      svg("rect", {x, y: top, width, height: deep, fill: "none", stroke: "currentColor", "stroke-opacity": .5}, root);
    };
    squares(values.map(share), columns, left, across);
    squares([...Array(64).keys()].map((i) => 1 - i / 63), 1, scaleLeft, 14);
    for (const [at, words] of counted(rows)) {
      const y = top + at * cellHigh;
      tick(`M${left - 4} ${y}h4`);
      text({x: left - 7, y: y + 4, "text-anchor": "end"}, words);
    }
    for (const [at, words] of map.column_ticks || counted(columns)) {
      tick(`M${left + at * cellWide} ${bottom}v4`);
      text({x: left + at * cellWide, y: bottom + 17, "text-anchor": "middle"}, words);
    }
    for (const [at, words] of map.ticks) {
      const y = bottom - share(at) * deep;
      tick(`M${scaleLeft + 14} ${y}h4`);
      text({x: scaleLeft + 21, y: y + 4}, words);
    }
    if (cellWide >= 36 && cellHigh >= 16) values.forEach((value, i) => text({x: left + (i % columns + .5) * cellWide, y: top + (Math.floor(i / columns) + .5) * cellHigh + 4, "text-anchor": "middle", fill: share(value) > .55 ? "#111" : "#fff", "font-size": 11},
      value >= 1e6 ? (value / 1e6).toPrecision(3) + "M" : value >= 1e5 ? Math.round(value / 1e3) + "K" : Math.round(value).toLocaleString("en")));
    text({x: left, y: 15, "font-weight": 600}, map.title);
    text({x: wide - 4, y: 15, "text-anchor": "end"}, map.value_label);
    text({x: (left + right) / 2, y: bottom + 36, "text-anchor": "middle"}, map.column_label);
    text({"text-anchor": "middle", transform: `translate(14 ${(top + bottom) / 2}) rotate(-90)`}, map.row_label);
    const frame = svg("rect", {width: Math.max(3, cellWide), height: Math.max(3, cellHigh), fill: "none", stroke: "#e03030", "stroke-width": 2, visibility: "hidden"}, root), said = figure.querySelector("output");
    const columnWords = (column) => map.column_label + " " + (map.column_ms ? (column * map.column_ms).toLocaleString("en", {maximumSignificantDigits: 4}) + " ms" : column);
    let now = [-1, -1];
    const show = (row, column) => {
      now = [row, column];
      frame.setAttribute("visibility", row < 0 ? "hidden" : "visible");
      frame.setAttribute("x", left + column * cellWide);
      frame.setAttribute("y", top + row * cellHigh);
      said.textContent = row < 0 ? "" : `${map.row_label} ${row}, ${columnWords(column)}: ${map.values ? "" : "about "}${values[row * columns + column].toLocaleString("en", {maximumFractionDigits: 1})} ${map.value_label}.`;
    };
    const within = (value, count) => Math.max(0, Math.min(count - 1, Math.floor(value)));
    root.addEventListener("pointermove", (event) => {
      const box = root.getBoundingClientRect(), times = wide / box.width;
      show(within(((event.clientY - box.top) * times - top) / cellHigh, rows), within(((event.clientX - box.left) * times - left) / cellWide, columns));
    });
    for (const name of ["pointerleave", "blur"]) root.addEventListener(name, () => show(-1, -1));
    root.addEventListener("keydown", (event) => {
      const step = {ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0]}[event.key];
      if (!step) return;
      event.preventDefault();
      show(within(Math.max(0, now[0]) + (now[0] < 0 ? 0 : step[0]), rows), within(Math.max(0, now[1]) + (now[0] < 0 ? 0 : step[1]), columns));
    });
    if (old) old.replaceWith(root);
    else figure.prepend(root);
  };
  const plots = [...document.querySelectorAll("figure.plot")].map((figure, number) => {
    const data = JSON.parse(figure.querySelector("script").textContent), said = document.createElement("output");
    figure.querySelector("p").replaceWith(said);
    return () => data.series ? draw(figure, data, number) : drawMap(figure, data);
  });
  const drawAll = () => { for (const each of plots) each(); };
  drawAll();
  if (plots.length) new ResizeObserver(drawAll).observe(document.querySelector("main"));
})();
