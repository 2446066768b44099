"use strict";
// One palette for all that a page draws.

/// M. Okabe and K. Ito, "Color Universal Design", 2008, with a brown in place of their yellow; then the first of them again, hatched or
/// dashed.
const seriesColors = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#606060", "#8c6d46"];
/// What nodes do, strong, and what they wait for, pale.
const partColors = {computing: "#0072b2", tracing: "#0072b2", shading: "#56b4e9", installing: "#8c6d46", packing: "#cc79a7", overhead: "#606060",
  "service while busy": "#009e73", "service while idle": "#009e7390", paging: "#009e73", pages: "#009e73", messages: "#e69f00", "page wait": "#d55e0080",
  "answer wait": "#d55e0080", "ray wait": "#cc79a780", "starvation": "#e6c30080", "token wait": "#6a4fb080", "credit wait": "#a0303080", "film wait": "#56b4e980",
  "other waits": "#80808070", asleep: "#e6c30080", "waiting for a core": "#80808040", "between calls": "#80808040", "idle at the end": "#80808040"};
const colorOf = (name) => partColors[name] || "#80808060";
const isPale = (color) => color.length > 7;

const channels = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
/// The map inferno of the page's heat maps, straight between ten of its colours, at 0 to 1.
const heatStops = ["#000004", "#1b0c41", "#4a0c6b", "#781c6d", "#a52c60", "#cf4446", "#ed6925", "#fb9b06", "#f7d13d", "#fcffa4"].map(channels);
const heatAt = (share) => {
  const place = Math.max(0, Math.min(1, share)) * 9, at = Math.min(8, Math.floor(place));
  return heatStops[at].map((low, k) => Math.round(low + (heatStops[at + 1][k] - low) * (place - at)));
};
