// What a measurement is: its parts, its value at a phase, and its course over the cycle.

import { carried } from "./features.js";
import { fixed } from "./player.js";

const NOISE = 3e-7;  // of the largest coordinate: poses come as single precision
const LEVEL = {horizontal: 0, vertical: 1};

/** Kinds of measurement: features that each wants, by what has been picked first. */
const WANTED = {distance: ["point", "point"], horizontal: ["point", "point"], vertical: ["point", "point"], angle: ["point", "point", "point"], radius: ["circle"]};

/** What the next pick may be: [kinds of features]. */
export function nextWanted(kind, picked) {
  if (kind !== "angle") return [WANTED[kind][picked.length]];
  return picked.length ? [picked[0].kind] : ["point", "line"];
}

/** Whether the picked features make a measurement. */
export const isComplete = (kind, picked) => picked.length === (picked[0]?.kind === "line" ? 2 : WANTED[kind].length);

/** The value [m or rad] of a kind of measurement of `parts`, `poseOf(body)` being where each body stands. */
export function valueOf(kind, parts, poseOf) {
  const at = parts.map(({body, point}) => carried(point, poseOf(body)));
  if (kind === "radius") return parts[0].radius;
  if (kind === "distance") return Math.hypot(at[1][0] - at[0][0], at[1][1] - at[0][1]);
  if (kind in LEVEL) return at[1][LEVEL[kind]] - at[0][LEVEL[kind]];
  const [one, other] = armsOf(parts, at, poseOf);
  return Math.abs(Math.atan2(one[0] * other[1] - one[1] * other[0], one[0] * other[0] + one[1] * other[1]));
}

/** The two directions that an angle lies between: arms of its middle point, or two lines. */
function armsOf(parts, at, poseOf) {
  if (parts[0].kind === "point") return [0, 2].map(n => [at[n][0] - at[1][0], at[n][1] - at[1][1]]);
  return parts.map(({body, to}, n) => { const [x, y] = carried(to, poseOf(body)); return [x - at[n][0], y - at[n][1]]; });
}

/** Its course over the cycle of a player: {u, values, low, high, lowAt, highAt, constant}; the ends with their phases. */
export function courseOf(kind, parts, player) {
  const u = player.scene.u, values = Float64Array.from(u, phase => valueOf(kind, parts, body => player.poseOf(body, phase, true)));
  let low = 0, high = 0, reach = 0;
  values.forEach((value, n) => { if (value < values[low]) low = n; if (value > values[high]) high = n; });
  for (const {point} of parts) reach = Math.max(reach, Math.hypot(...point));
  for (const phase of [0, 0.5]) for (const {body} of parts) { const [x, y] = player.poseOf(body, phase, true); reach = Math.max(reach, Math.hypot(x, y)); }
  const noise = kind === "angle" ? 20 * NOISE : NOISE * reach;
  return {u, values, low: values[low], high: values[high], lowAt: u[low], highAt: u[high], constant: values[high] - values[low] <= noise};
}

/** The course as a panel of a plot over the cycle, for files of it. */
export function panelOf(title, kind, {u, values, low, high}, role) {
  const [factor, unit] = kind === "angle" ? [180 / Math.PI, "°"] : [1e3, "mm"], air = (high - low || Math.abs(high) || 1) * 0.06;
  return {title, u, style: "line", shade: [], limits: [], low: (low - air) * factor, high: (high + air) * factor,
    series: [{label: title, unit, role, ends: [], values: values.map(value => value * factor)}]};
}

/** A value as text: millimetres, degrees. */
export const textOf = (kind, value) => kind === "angle" ? `${fixed(value * 180 / Math.PI, 2)}°` : `${fixed(value * 1e3, 3)}\u00a0mm`;

/** The driving quantity at a phase, as text. */
export function cycleText({start, span, unit}, phase) {
  const digits = Math.abs(span) >= 50 ? 1 : Math.max(0, 3 - Math.floor(Math.log10(Math.abs(span) || 1)));
  return fixed(start + phase * span, digits) + (unit.startsWith("°") || !unit ? unit : ` ${unit}`);
}
