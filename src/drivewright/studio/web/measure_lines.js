// Dimension lines upon the drawing, in pixels.

import { svgPart } from "./svg_parts.js";

const ARC = 34, BEYOND = 5;  // px: radius of the arc of an angle; how far a help line goes beyond

/** An element with its numbers to a tenth of a pixel. */
const make = (tag, attributes, text) =>
  svgPart(tag, Object.fromEntries(Object.entries(attributes).map(([name, value]) => [name, typeof value === "number" ? value.toFixed(1) : value])), text);
const line = ([x1, y1], [x2, y2], look = "ms-line") => make("line", {x1, y1, x2, y2, class: look});
const dot = ([cx, cy]) => make("circle", {cx, cy, r: 3.5, class: "ms-dot"});

/** Two arrow heads that point at the ends of a line; inside it where there is room. */
function heads(from, to) {
  const dx = to[0] - from[0], dy = to[1] - from[1], length = Math.hypot(dx, dy);
  if (length < 1) return [];
  const ux = dx / length, uy = dy / length, size = length > 30 ? 8 : -8;
  return [[from, 1], [to, -1]].map(([[x, y], way]) => {
    const bx = x + way * size * ux, by = y + way * size * uy, points = [[x, y], [bx - 3 * uy, by + 3 * ux], [bx + 3 * uy, by - 3 * ux]];
    return make("polygon", {points: points.map(point => point.map(part => part.toFixed(1)).join(",")).join(" "), class: "ms-head"});
  });
}
const label = ([x, y], text) => make("text", {x, y: y - 6, class: "ms-text", "text-anchor": "middle"}, text);
const middle = ([x0, y0], [x1, y1]) => [(x0 + x1) / 2, (y0 + y1) / 2];

/** The elements of one measurement: `at` are the pixels of its parts, `seen(body, point)` the pixel of any other point, `scale` px per metre. */
export function dimension(kind, parts, at, text, {scale, seen}) {
  if (kind === "radius") return radius(parts[0], at[0], text, scale);
  if (kind === "angle") return angle(parts, at, text, seen);
  if (kind === "distance") return [line(at[0], at[1]), ...heads(at[0], at[1]), ...at.map(dot), label(middle(at[0], at[1]), text)];
  const [a, b] = at, corner = kind === "horizontal" ? [b[0], a[1]] : [a[0], b[1]], way = Math.sign(kind === "horizontal" ? a[1] - b[1] : a[0] - b[0]);
  const over = kind === "horizontal" ? [corner[0], corner[1] + BEYOND * way] : [corner[0] + BEYOND * way, corner[1]];
  return [line(a, corner), line(b, over, "ms-help"), ...heads(a, corner), ...at.map(dot), label(middle(a, corner), text)];
}

function radius({radius: size}, centre, text, scale) {
  const reach = size * scale / Math.SQRT2, rim = [centre[0] + reach, centre[1] - reach];
  return [line(centre, rim), ...heads(centre, rim).slice(1), dot(centre), label(middle(centre, rim), text)];
}

function angle(parts, at, text, seen) {
  const points = parts[0].kind === "point", corner = points ? at[1] : at[0];
  const ends = points ? [at[0], at[2]] : parts.map(({body, to}, n) => { const [x, y] = seen(body, to); return [corner[0] + x - at[n][0], corner[1] + y - at[n][1]]; });
  const [one, other] = ends.map(([x, y]) => Math.atan2(corner[1] - y, x - corner[0])), turn = Math.atan2(Math.sin(other - one), Math.cos(other - one));
  const on = (to, size = ARC) => [corner[0] + size * Math.cos(to), corner[1] - size * Math.sin(to)];
  const [x0, y0] = on(one), [x1, y1] = on(other), path = `M${x0.toFixed(1)} ${y0.toFixed(1)}A${ARC} ${ARC} 0 0 ${turn > 0 ? 0 : 1} ${x1.toFixed(1)} ${y1.toFixed(1)}`;
  const arms = points ? ends.map(end => line(end, corner, "ms-help")) : [one, other].map(to => line(on(to, ARC + 12), corner, "ms-help"));
  return [...arms, make("path", {d: path, class: "ms-line"}), ...at.map(dot), label(on(one + turn / 2, ARC + 16), text)];
}
