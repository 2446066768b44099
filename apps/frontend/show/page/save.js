"use strict";
// Links that save what a figure shows, which stands in the page once. A plot is saved as it is on white paper, without its style for
// the dark, which stands in front of what gnuplot drew.
(() => {
  const svg = "data:image/svg+xml;base64,";
  const onWhite = (url) =>
    url.startsWith(svg) ? svg + btoa(atob(url.slice(svg.length)).replace(/[<]style>rect\[fill[^]*?[<]\/style>\n/, "")) : url;
  for (const link of document.querySelectorAll("figure a.save[hidden]")) {
    const image = link.closest("figure").querySelector("img");
    link.href = image.src;
    link.download = link.dataset.name;
    link.addEventListener("click", () => { link.href = onWhite(image.src); });
    link.hidden = false;
  }
})();
