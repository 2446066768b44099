// Levels, of all nodes together: the most in each step, each name on a scale of its own, which is that of all runs.
const levelColors = ["#0072b2", "#d55e00", "#009e73", "#cc79a7"];
underRows.push((run, box) => {
  if (!run.levels.length) return;
  const texts = run.levels.map(({name, largest, most}) => `${name} ${numberText(largest * most / 255)}`);
  const canvas = makeCanvas(run, "levels", "How full all nodes together were over time, at most: " + texts.join(", "), box);
  canvas.className = "time";
  legend(box, "Most at a time, of all nodes together: ", texts.map((text, i) => [text, levelColors[i]]));
  part(() => [state.t, moment()].join(), () => {
    const [pen, wide] = square(canvas, levelsHigh);
    run.levels.forEach(({name, values, most, steps, step_ns}, i) => {
      const peak = mostOf(({levels}) => Math.max(0, ...levels.filter((level) => level.name === name).map((level) => level.largest * level.most)));
      pen.strokeStyle = levelColors[i];
      pen.lineWidth = 1.5;
      pen.beginPath();
      for (let step = 0; step < steps; ++step) for (const end of [step, step + 1])
        pen.lineTo(end * step_ns / 1e6 / totalMs * wide, levelsHigh - 2 - (levelsHigh - 4) * values[step] * most / peak);
      pen.stroke();
    });
    drawNow(pen, wide, levelsHigh);
  });
});
