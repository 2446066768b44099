// Links that save what a figure shows, which is in the page once. A plot is saved as on white paper.
(() => {
  const urlOf = (figure) => {
    const image = figure.querySelector("img");
    if (image) return image.src;
    const copy = figure.querySelector("svg").cloneNode(true), ground = document.createElementNS(copy.namespaceURI, "rect");
    for (const [key, value] of Object.entries({width: "100%", height: "100%", fill: "#fff"})) ground.setAttribute(key, value);
    copy.prepend(ground);
    return "data:image/svg+xml," + encodeURIComponent(new XMLSerializer().serializeToString(copy));
  };
  for (const link of document.querySelectorAll("figure a.save[hidden]")) {
    const figure = link.closest("figure");
    link.href = urlOf(figure);
    link.download = link.dataset.name;
    link.addEventListener("click", () => { link.href = urlOf(figure); });
    link.hidden = false;
  }
})();
