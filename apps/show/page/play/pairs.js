// Who gets what from whom.
cards.push({id: "pairs", headingOf: ({pairs}) => !pairs || pairs.side < 2 ? "" : pairs.what === "pages" ? "Who fetches from whom" : "Who sends rays to whom", start: (run, box) => {
  const {pairs, over} = run, {what, row, column, side, places} = pairs, pair = (from, to) => ({node: within(from, side), peer: within(to, side)});
  const canvas = makeCanvas(run, "pairs", `How many ${what}: rows are the ${row}, columns the ${column}`, box,
    (x, y) => pair(y * side, x * side), (right, down) => state.peer < 0 ? pair(0, 1) : pair(state.node + down, state.peer + right));
  const counts = unpacked(pairs.counts), baked = document.createElement("canvas");
  pairs.all = places ? new Float64Array(side * side) : counts;
  if (places) unpacked(places).forEach((place, i) => { pairs.all[place] = counts[i]; });
  pairs.most = largestOf(counts);
  baked.width = baked.height = side;
  make("p", {class: "note"}, box, `Rows: ${row}. Columns: ${column}. ${over.pairs ? `In the time shown at most ${numberText(over.pairs.largest * over.pairs.most / 255)} ${over.pairs.what} in ${timeText(over.pairs.step_ns / 1e6)}` :
    `The whole run, at most ${numberText(pairs.most)} ${what}`}.`);
  part(() => (over.pairs ? stepKey() : "") + choiceKey(chosen()), () => drawPairs(run, canvas, baked));
}});
sayings.push((run, {node, peer}) => run.pairs && peer >= 0 && Math.max(node, peer) < run.pairs.side ? pairText(run, node, peer) : "");

const bakePairs = ({pairs: {side, all}, over}, baked) => {
  const pen = baked.getContext("2d"), image = pen.createImageData(side, side), most = mostOf(({pairs}) => pairs ? pairs.most : 0);
  const shareAt = (i) => over.pairs ? heatOf("pairs", over, i) : all[i] / most;
  new Uint32Array(image.data.buffer).forEach((unused, i, out) => { out[i] = heatColors[Math.round(Math.sqrt(shareAt(i)) * 255)]; });
  pen.putImageData(image, 0, 0);
};
const drawPairs = (run, canvas, baked) => {
  const [pen, size] = square(canvas), {side} = run.pairs, cell = size / side, choice = chosen(), bright = brightNodes(run, choice);
  if (run.over.pairs || !run.pairs.isBaked) bakePairs(run, baked);
  run.pairs.isBaked = true;
  pen.imageSmoothingEnabled = side > size;
  pen.globalAlpha = bright.size ? 0.3 : 1;
  pen.drawImage(baked, 0, 0, size, size);
  pen.globalAlpha = 1;
  pen.strokeStyle = "#e03030";
  const least = Math.max(cell, 2), show = (x, y, wide, high) => {
    pen.drawImage(baked, x, y, wide, high, x * cell, y * cell, wide * cell, high * cell);
    pen.strokeRect(x * cell, y * cell, Math.max(least, wide * cell), Math.max(least, high * cell));
  };
  if (choice.peer >= 0) show(choice.peer, choice.node, 1, 1);
  else for (const node of bright) if (node < side) {
    show(0, node, side, 1);
    show(node, 0, 1, side);
  }
};
const pairText = (run, node, peer) => {
  const {pairs: {what, all, side}, over} = run, at = node * side + peer, [who, whom] = [node, peer].map((number) => nodeName(run, number));
  const now = over.pairs ? `${partText()}: ${numberText(countOf(over.pairs, at))} ${over.pairs.what}. ` : "";
  return `${now}Of the whole run: ${numberText(all[at])} ` + (what === "pages" ? `pages fetched by ${who} from ${whom}.` : `rays sent by ${who} to ${whom}.`);
};
