// The hottest pages, each a bar.
cards.push({id: "pages", headingOf: ({pages}) => pages.length ? "The hottest pages" : "", start: (run, box) => {
  const count = run.pages.length, canvas = makeCanvas(run, "pages", "The hottest pages, by how often they were fetched. The table of pages below has the first of them.", box,
    (x) => ({page: within(x * count, count)}), (right, down) => ({page: within(state.page + right + down, count)}));
  part(() => (run.over.pages ? stepKey() : "") + choiceKey(chosen()), () => drawPages(run, canvas));
}});
sayings.push((run, {page}) => run.pages[page] ? pageText(run, run.pages[page], page) : "");

const drawPages = (run, canvas) => {
  const high = 90, [pen, wide] = square(canvas, high), {pages, over} = run, choice = chosen(), bright = brightNodes(run, choice);
  const width = wide / pages.length, most = mostOf(({pages: all}) => all.length ? all[0][2] : 0);
  pages.forEach(([, home, fetched], i) => {
    const isChosen = i === choice.page && choice.run === run.index;
    const bar = (share, alpha) => {
      pen.globalAlpha = alpha * (isChosen || (choice.page < 0 && (bright.size === 0 || bright.has(home))) ? 1 : 0.2);
      pen.fillRect(i * width, high - 86 * share, Math.max(1, width - 0.5), 86 * share);
    };
    pen.fillStyle = isChosen ? "#e03030" : partColors.pages;
    bar(fetched / most, over.pages ? 0.35 : 1);
    if (over.pages) bar(heatOf("pages", over, i), 1);
  });
  pen.globalAlpha = 1;
};
const pageText = (run, [number, home, fetched], page) => `Page ${number}, the ${page + 1}. of the hottest: at home on ${nodeName(run, home)}, fetched ` +
  `${numberText(fetched)} times, ${percentText(fetched / run.fetched)} of all fetches.` + (run.over.pages ? ` ${partText()}: ${numberText(countOf(run.over.pages, page))}.` : "");
