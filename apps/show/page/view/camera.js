"use strict";
// A camera as --camera has it, "FROM/AT/UP/DEGREES", and its ways round what it looks at.
const add = (a, b, k = 1) => a.map((x, i) => x + k * b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));
// About an axis of unit length (O. Rodrigues, 1840).
const turned = (v, axis, angle) =>
  add(add(v.map((x) => x * Math.cos(angle)), cross(axis, v), Math.sin(angle)), axis, dot(axis, v) * (1 - Math.cos(angle)));

const cameraOf = (text) => {
  const [from, at, up, degrees] = text.split("/").map((part) => part.split(",").map(Number));
  return {from, at, up, degrees: degrees[0]};
};
// Seven digits are finer than a pixel, and leave a command that one can read.
const textOf = ({from, at, up, degrees}) => {
  const far = Math.max(...from.map(Math.abs), ...at.map(Math.abs)), step = 10 ** (Math.ceil(Math.log10(far || 1)) - 7);
  const point = (p) => p.map((x) => String(Number((Math.round(x / step) * step).toPrecision(9)))).join(",");
  return `${point(from)}/${point(at)}/${up.join(",")}/${degrees}`;
};

const axesOf = ({from, at, up}) => {
  const forward = unit(add(at, from, -1)), right = unit(cross(forward, up));
  return {forward, right, above: cross(right, forward)};
};

const nearPole = 0.05;  // radians from up or down that the camera keeps, as there is no right then

// Round what it looks at, by angles: to the right, and upwards.
const orbit = (camera, angle, rise) => {
  const {right} = axesOf(camera), up = unit(camera.up);
  const offset = add(camera.from, camera.at, -1), height = Math.asin(Math.max(-1, Math.min(1, dot(unit(offset), up))));
  const most = Math.max(Math.abs(height), Math.PI / 2 - nearPole);
  const to = Math.max(-most, Math.min(most, height + rise));
  return {...camera, from: add(camera.at, turned(turned(offset, right, height - to), up, angle))};
};
// By parts of the distance at which it looks, as seen in the picture.
const shift = (camera, x, y) => {
  const {right, above} = axesOf(camera), distance = Math.hypot(...add(camera.at, camera.from, -1));
  const way = add(right.map((v) => v * x * distance), above, y * distance);
  return {...camera, from: add(camera.from, way), at: add(camera.at, way)};
};
const dolly = (camera, factor) => ({...camera, from: add(camera.at, add(camera.from, camera.at, -1), factor)});
