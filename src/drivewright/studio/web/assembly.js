// An assembly in motion: where each part stands at a phase of the cycle, and how far it is pulled out of the whole.

import { floats, locate } from "./clock.js";

const SPREAD = 0.9;  // of its distance from the middle that a part is pulled out at most
const TALL = 0.5;  // of the assembly's size: parts that lie close above each other are pulled apart at least so far

/** Displacements of an answer of the job "solid": {u, motions} as arrays, null where nothing moves. */
export function unpackMotion({motions, u}) {
  return motions?.length ? {u: floats(u), motions: motions.map(floats)} : null;
}

/** [x, y, angle] of a motion (frames x 3) at a phase. */
export function displacementAt({u}, motion, phase) {
  const [low, part] = locate(u, phase);
  return [0, 1, 2].map(k => motion[3 * low + k] + part * (motion[3 * low + 3 + k] - motion[3 * low + k]));
}

/** Middle of the points of a part. */
function middleOf(points) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i++) { const k = i % 3; low[k] = Math.min(low[k], points[i]); high[k] = Math.max(high[k], points[i]); }
  return low.map((end, k) => (end + high[k]) / 2);
}

/** How far [x, y, z] each part is pulled out at most: away from the middle, along the axis by more where the parts lie close together. */
export function pullsOf(parts, {low, high, centre, size}) {
  const middles = parts.map(({points}) => middleOf(points)), deep = high[2] - low[2], stretch = Math.max(1, TALL * size / (deep || 1e-9));
  return middles.map(at => at.map((x, k) => SPREAD * (x - centre[k]) * (k === 2 ? stretch : 1)));
}

/** The matrix (16, column by column) of a displacement and a pull. */
export function matrixOf([x, y, angle], [px, py, pz]) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return new Float32Array([c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, x + px, y + py, pz, 1]);
}

/** Corners of everything over the cycle, so that the view holds all of it: {low, high, centre, size} around the boxes of the parts. */
export function reachOf(parts, moving, whole) {
  if (!moving) return whole;
  const low = [...whole.low], high = [...whole.high];
  for (const {points, motion} of parts) {
    if (!(motion >= 0)) continue;
    const [x0, y0, x1, y1] = flatBox(points), corners = [[x0, y0], [x1, y0], [x0, y1], [x1, y1]];
    for (let n = 0; n < 24; n++) {
      const [x, y, angle] = displacementAt(moving, moving.motions[motion], n / 24), c = Math.cos(angle), s = Math.sin(angle);
      for (const [a, b] of corners) [c * a - s * b + x, s * a + c * b + y].forEach((at, k) => { low[k] = Math.min(low[k], at); high[k] = Math.max(high[k], at); });
    }
  }
  return {low, high, centre: low.map((end, k) => (end + high[k]) / 2), size: Math.hypot(...low.map((end, k) => high[k] - end)) || 1};
}

function flatBox(points) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i += 3) {
    box[0] = Math.min(box[0], points[i]); box[1] = Math.min(box[1], points[i + 1]);
    box[2] = Math.max(box[2], points[i]); box[3] = Math.max(box[3], points[i + 1]);
  }
  return box;
}
