// The points of a segment as plain data: (u, s) of a spline, (angle, lift) of a table.  Each change answers the text of the key that has them.

import { FACTORS } from "./handles.js";
import { quantityOf } from "./numbers.js";

/** Points of a segment that is edited: at least, at most. */
export const FEWEST = 3;
export const MOST = 1000;
const NARROW = {spline: 0.01, table: 0.05 * Math.PI / 180};  // u, or rad, that two points are apart at least
const tidy = value => Number(value.toPrecision(12));

/** {kind, at: numbers [x, y] of each point, raw: as the spec has them} of the text of a key; null where it is no list of points. */
export function readPoints(text, kind) {
  let raw = null;
  try { raw = JSON.parse(text); } catch { return null; }
  if (!Array.isArray(raw) || raw.some(point => !Array.isArray(point) || point.length !== 2)) return null;
  const at = raw.map(point => point.map(part => kind === "table" ? quantity(part) : part));
  return at.flat().every(Number.isFinite) ? {kind, at, raw} : null;
}

function quantity(text) {
  const [value, unit] = typeof text === "string" && quantityOf(text) || [];
  return unit && FACTORS[unit] ? value * FACTORS[unit] : NaN;
}

/** A number as the spec has it: with the unit of another text. */
function written(value, like) {
  const [, unit] = typeof like === "string" && quantityOf(like) || [];
  return unit ? `${tidy(Math.round(value / FACTORS[unit] * 1e9) / 1e9)} ${unit}` : tidy(Math.round(value * 1e6) / 1e6);
}

/** The text of rows [angle [rad], lift [m or rad]] as a spec has them. */
export const rowsText = (rows, angular) => JSON.stringify(rows.map(([angle, lift]) => [written(angle, "0 deg"), written(lift, angular ? "0 deg" : "0 mm")]));

/** A part of point `k` as a person reads it, "114 deg" or 0.25; and the number of a typed text, in the unit of that part unless it has its own: NaN where it is none. */
export const partText = ({nodes: {raw, at}}, k, part) => String(raw ? raw[k][part] : tidy(at[k][part]));
export function typedPart(segment, k, part, text) {
  const [value, unit] = quantityOf(text) || [NaN], [, own] = segment.nodes.kind === "table" && quantityOf(partText(segment, k, part)) || [];
  if (segment.nodes.kind === "spline") return unit ? NaN : value;
  return value * (FACTORS[unit || own] ?? NaN);
}

/** Where point `k` is: [angle of the programme, lift]. */
export function placeOf(segment, k) {
  const {kind, at} = segment.nodes, [x, y] = at[k];
  return kind === "table" ? [segment.start + x, y] : [segment.start + x * segment.angle, segment.from + y * segment.rise];
}

/** (x, y) of a point at an angle and a lift: the reverse of `placeOf`. */
export const pointAt = (segment, angle, lift) => segment.nodes.kind === "table" ? [angle - segment.start, lift] : [(angle - segment.start) / segment.angle, (lift - segment.from) / segment.rise];

/** Whether point `k` moves: one inside does; the ends of a table over the whole turn move together. */
export const pointMoves = ({nodes: {at, still, closed}}, k) => !still && (k > 0 && k < at.length - 1 || Boolean(closed));

/** The text with point `k` at [x, y], which stays between its neighbours. */
export function movedPoint({nodes}, k, [x, y]) {
  const {kind, at, raw, closed} = nodes, last = at.length - 1, end = k === 0 || k === last, ends = closed && end ? [0, last] : [k];
  const room = NARROW[kind], kept = end ? at[k][0] : Math.min(Math.max(x, at[k - 1][0] + Math.min(room, at[k][0] - at[k - 1][0])), at[k + 1][0] - Math.min(room, at[k + 1][0] - at[k][0]));
  return JSON.stringify(raw.map((point, n) => ends.includes(n) ? [n === k && !end ? written(kept, point[0]) : point[0], written(y, point[1])] : point));
}

/** The text with another point at [x, y], and its number; null where it would stand upon one, or outside. */
export function addedPoint({nodes: {kind, at, raw, still}}, [x, y]) {
  const k = at.findIndex(([own]) => own > x);
  if (still || k < 1 || at.length >= MOST || x - at[k - 1][0] < NARROW[kind] || at[k][0] - x < NARROW[kind]) return null;
  return {k, text: JSON.stringify([...raw.slice(0, k), [written(x, raw[k][0]), written(y, raw[k][1])], ...raw.slice(k)])};
}

/** The text without point `k`; null for an end, and where too few would be left. */
export const withoutPoint = ({nodes: {at, raw, still}}, k) => still || !(k > 0 && k < at.length - 1) || at.length <= FEWEST ? null : JSON.stringify(raw.filter((_, n) => n !== k));

/** Lift of a segment at an angle of the programme, on its course. */
export function liftAt({course: [theta, s]}, angle) {
  const n = Math.max(1, theta.findIndex(each => each >= angle)), wide = theta[n] - theta[n - 1];
  return wide > 0 ? s[n - 1] + (s[n] - s[n - 1]) * Math.min(Math.max((angle - theta[n - 1]) / wide, 0), 1) : s[n];
}

/** Numbers of the points that get a handle: all where they are `apart` px from each other; else the chosen one, and some near `x`. */
export function seenPoints(xs, moves, {apart, most, reach, x, chosen}) {
  const all = [...xs.keys()].filter(moves);
  if (all.every((k, n) => !n || xs[k] - xs[all[n - 1]] >= apart)) return all;
  const near = x === null ? [] : all.filter(k => Math.abs(xs[k] - x) <= reach).sort((a, b) => Math.abs(xs[a] - x) - Math.abs(xs[b] - x)), found = all.includes(chosen) ? [chosen] : [];
  for (const k of near) if (found.length < most && found.every(other => Math.abs(xs[other] - xs[k]) >= apart)) found.push(k);
  return found.sort((a, b) => a - b);
}
