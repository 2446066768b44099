// The data that came with the page, and what all parts of it are built of.
const byId = (id) => document.getElementById(id);
const data = JSON.parse(byId("data").textContent);

const numberText = (value) => value.toLocaleString("en", {maximumFractionDigits: 2});
const percentText = (share) => (100 * share).toFixed(1) + " %";
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();

/// An element with text, never markup.
const make = (name, attributes = {}, parent = null, text = "") => {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.textContent = text;
  if (parent) parent.append(element);
  return element;
};
const control = (bar, text, name, attributes) => {
  const label = make("label", {}, bar, text + " ");
  return make(name, attributes, label);
};
