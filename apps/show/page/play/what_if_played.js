// What if, on a page that plays: what is asked for is part of the state.
Object.assign(state, {cache: data.forecast.cache, dots: 1});
Object.assign(most, {cache: Infinity, dots: 1});
starters.push(() => {
  const box = byId("what-if");
  part(() => [state.cache, state.dots, box.clientWidth].join(), startWhatIf(box, data.forecast, state, writeAddress));
});
