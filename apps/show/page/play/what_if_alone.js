// A page without a run to play: its address has what is asked for alone, #cache=64&dots=0.
const asked = {cache: data.forecast.cache, dots: 1}, whatIfBox = byId("what-if");
const readAsked = () => {
  for (const [key, text] of new URLSearchParams(location.hash.slice(1))) if (Object.hasOwn(asked, key) && text >= 0) asked[key] = +text;
};
readAsked();
const show = startWhatIf(whatIfBox, data.forecast, asked, () => history.replaceState(null, "", `#cache=${asked.cache}&dots=${asked.dots}`));
show();
new ResizeObserver(show).observe(whatIfBox);
addEventListener("hashchange", () => {
  readAsked();
  show();
});
