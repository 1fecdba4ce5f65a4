// An assembly in motion: where each part stands at a phase of the cycle, and how far it is pulled out of the whole.

import { bytesOf, floats, locate } from "./clock.js";

const SPREAD = 0.9;  // of its distance from the middle that a part is pulled out at most
const TALL = 0.5;  // of the assembly's size: parts that lie close above each other are pulled apart at least so far

/** Whole numbers of base64 text: two bytes each where all of `count` points have one so, else four. */
function integers(text, count) {
  return count > 65536 ? new Uint32Array(bytesOf(text)) : new Uint16Array(bytesOf(text));
}

/** Parts of an answer of the job "solid" as the renderer takes them; those that are there once more share everything but their motion. */
export function unpackParts({parts, repeats = []}) {
  const made = parts.map(({name, label, colour, positions, normals, corners, edges, motion, turn}) => {
    const points = floats(positions), count = points.length / 3;
    return {name, label, colour, motion, turn, points, normals: floats(normals), corners: integers(corners, count), edges: integers(edges, count)};
  });
  return [...made, ...repeats.map(({part, motion}) => ({...made[part], motion, again: true}))];
}

/** How the parts of an answer of the job "solid" move: {u, motions, turns} as arrays, null where nothing moves. */
export function unpackMotion({motions = [], turns = [], u}) {
  return motions.length || turns.length
    ? {u: floats(u), motions: motions.map(floats), turns: turns.map(turn => ({...turn, angles: floats(turn.angles)}))} : null;
}

/** [x, y, angle] of a motion (frames x 3) at a phase. */
export function displacementAt({u}, motion, phase) {
  const [low, part] = locate(u, phase);
  return [0, 1, 2].map(k => motion[3 * low + k] + part * (motion[3 * low + 3 + k] - motion[3 * low + k]));
}

/** Middle of the points of a part. */
function middleOf(points) {
  const {low, high} = boxAround(points);
  return low.map((end, k) => (end + high[k]) / 2);
}

/** How far [x, y, z] each part is pulled out at most: away from the middle, along the axis by more where the parts lie close together. */
export function pullsOf(parts, moving, {low, high, centre, size}) {
  const middles = parts.map(part => part.again ? carried(matrixAt(moving, part, 0), middleOf(part.points)) : middleOf(part.points)), deep = high[2] - low[2], stretch = Math.max(1, TALL * size / (deep || 1e-9));
  return middles.map(at => at.map((x, k) => SPREAD * (x - centre[k]) * (k === 2 ? stretch : 1)));
}

/** The matrix (16, column by column) of a displacement and a pull. */
export function matrixOf([x, y, angle], [px, py, pz]) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return new Float32Array([c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, x + px, y + py, pz, 1]);
}

/** The same of a turn by an angle about `direction` through `point`. */
function turnMatrix({point, direction}, angle, pull) {
  const size = Math.hypot(...direction), [x, y, z] = direction.map(part => part / size), c = Math.cos(angle), s = Math.sin(angle), d = 1 - c;
  const columns = [[c + x * x * d, y * x * d + z * s, z * x * d - y * s], [x * y * d - z * s, c + y * y * d, z * y * d + x * s],
    [x * z * d + y * s, y * z * d - x * s, c + z * z * d]];
  const rest = point.map((at, k) => at - columns.reduce((sum, column, n) => sum + column[k] * point[n], 0) + pull[k]);
  return new Float32Array([...columns.flatMap(column => [...column, 0]), ...rest, 1]);
}

/** The matrix of a part at a phase, pulled out by `pull`; `moving` may be null. */
export function matrixAt(moving, {motion, turn}, phase, pull = [0, 0, 0]) {
  if (moving && turn >= 0) {
    const {angles} = moving.turns[turn], [low, part] = locate(moving.u, phase);
    return turnMatrix(moving.turns[turn], angles[low] + part * (angles[low + 1] - angles[low]), pull);
  }
  return matrixOf(moving && motion >= 0 ? displacementAt(moving, moving.motions[motion], phase) : [0, 0, 0], pull);
}

/** Corners of everything over the cycle, so that the view holds all of it: {low, high, centre, size} around the boxes of the parts. */
export function reachOf(parts, moving, whole) {
  if (!moving) return whole;
  const low = [...whole.low], high = [...whole.high];
  for (const part of parts) {
    if (!(part.motion >= 0 || part.turn >= 0)) continue;
    const corners = cornersOf(part.points);
    for (let n = 0; n < 24; n++) {
      const m = matrixAt(moving, part, n / 24);
      for (const corner of corners) carried(m, corner).forEach((at, k) => { low[k] = Math.min(low[k], at); high[k] = Math.max(high[k], at); });
    }
  }
  return {low, high, centre: low.map((end, k) => (end + high[k]) / 2), size: Math.hypot(...low.map((end, k) => high[k] - end)) || 1};
}

/** A point where a matrix takes it. */
function carried(m, [x, y, z]) { return [0, 1, 2].map(k => m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k]); }

/** The eight corners of the box around points. */
function cornersOf(points) {
  const {low, high} = boxAround(points);
  return Array.from({length: 8}, (_, n) => [0, 1, 2].map(k => n >> k & 1 ? high[k] : low[k]));
}

function boxAround(points) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i++) { const k = i % 3; low[k] = Math.min(low[k], points[i]); high[k] = Math.max(high[k], points[i]); }
  return {low, high};
}
