// A packed scene made ready for drawing: poses of its bodies, outlines as paths.

import { floats } from "./clock.js";

// ---------------------------------------------------------------------------------------------------------------- motion

/** Pose [x, y, angle] of a motion at frame `low` + `part`. */
export function poseAt(motion, low, part) {
  if (motion.length === 3) return motion;
  const i = 3 * low;
  return [0, 1, 2].map(k => motion[i + k] + part * (motion[i + 3 + k] - motion[i + k]));
}

/** Pose of a body {motion, rest, most} at frame `low` + `part`: where it has a rest, `scale` times as far from it as drawn, `most` at most. */
export function poseOf({motion, rest, most}, low, part, scale = 1) {
  const drawn = poseAt(motion, low, part);
  if (!rest || scale === 1) return drawn;
  return poseAt(rest, low, part).map((from, n) => from + Math.min(scale, most) * (drawn[n] - from));
}

/** Whether a body {shown} is drawn at frame `low` + `part`: shown are the first and last frames of the stretches where it is, else always. */
export function isDrawn({shown}, low, part) {
  const frame = Math.round(low + part);
  return !shown || shown.some(([first, last]) => frame >= first && frame <= last);
}

/** Pose of a body in the frame of an observer. */
export function seenFrom(pose, eye) {
  const dx = pose[0] - eye[0], dy = pose[1] - eye[1], c = Math.cos(eye[2]), s = Math.sin(eye[2]);
  return [c * dx + s * dy, c * dy - s * dx, pose[2] - eye[2]];
}

export function carry([x, y], pose) {
  const c = Math.cos(pose[2]), s = Math.sin(pose[2]);
  return [pose[0] + c * x - s * y, pose[1] + s * x + c * y];
}

// -------------------------------------------------------------------------------------------------------------- outlines
// Points are flat: x, y, x, y ...

export const STILL = [0, 0, 0];
const COMPASS = Array.from({length: 16}, (_, n) => [Math.cos(n * Math.PI / 8), Math.sin(n * Math.PI / 8)]);
const SEEN = 0.3;  // px: what a path may leave out

/** Box [x0, y0, x1, y1] around a box and points carried by a pose. */
export function boxOf(points, [x, y, angle] = STILL, box = [Infinity, Infinity, -Infinity, -Infinity]) {
  const c = Math.cos(angle), s = Math.sin(angle);
  for (let i = 0; i < points.length; i += 2) {
    const px = x + c * points[i] - s * points[i + 1], py = y + s * points[i] + c * points[i + 1];
    if (px < box[0]) box[0] = px;
    if (py < box[1]) box[1] = py;
    if (px > box[2]) box[2] = px;
    if (py > box[3]) box[3] = py;
  }
  return box;
}

/** The points that lie farthest in 16 directions: how far a shape reaches, whichever way it is turned. */
function farthest(points) {
  const found = new Set();
  if (points.length) for (const [c, s] of COMPASS) {
    let best = -Infinity, at = 0;
    for (let i = 0; i < points.length; i += 2) {
      const reach = c * points[i] + s * points[i + 1];
      if (reach > best) { best = reach; at = i; }
    }
    found.add(at);
  }
  return [...found].flatMap(i => [points[i], points[i + 1]]);
}

/** Those of the points whose polyline stays within `tolerance` of all of them (Ramer, Douglas and Peucker). */
function thinned(points, tolerance) {
  const last = points.length / 2 - 1, kept = new Uint8Array(last + 1), open = [[0, last]];
  kept[0] = kept[last] = 1;
  while (open.length) {
    const [a, b] = open.pop(), ax = points[2 * a], ay = points[2 * a + 1], dx = points[2 * b] - ax, dy = points[2 * b + 1] - ay, length = Math.hypot(dx, dy);
    let most = tolerance, at = 0;
    for (let i = a + 1; i < b; i++) {
      const px = points[2 * i] - ax, py = points[2 * i + 1] - ay, away = length > 1e-12 ? Math.abs(px * dy - py * dx) / length : Math.hypot(px, py);
      if (away > most) { most = away; at = i; }
    }
    if (at) { kept[at] = 1; open.push([a, at], [at, b]); }
  }
  return points.filter((_, i) => kept[i >> 1]);
}

/** The outline as a path, as fine as can be seen: thinned anew whenever the view has become half as large again. */
export function pathOf(outline, level) {
  if (outline.level === level) return outline.path;
  const points = thinned(outline.points, SEEN / 2 ** level), path = new Path2D();
  for (let i = 0; i < points.length; i += 2) path.lineTo(points[i], points[i + 1]);
  if (outline.closed) path.closePath();
  Object.assign(outline, {level, path});
  return path;
}

/** The packed scene with arrays instead of text; what has the same text as in the scene `before` is taken over from there. */
export function unpack(packed, before) {
  const known = new Map();
  const once = (text, make) => {
    if (!known.has(text)) known.set(text, before && before.known.get(text) || make());
    return known.get(text);
  };
  const motions = packed.motions.map(text => once(text, () => floats(text)));
  const shapes = packed.shapes.map(({layer, closed, points}) => ({layer, outline: once(`${closed} ${points}`, () => {
    const flat = floats(points);
    return {points: flat, closed, far: farthest(flat)};
  })}));
  const ready = thing => {
    const own = thing.shapes.map(n => shapes[n]), far = farthest(own.flatMap(shape => shape.outline.far));
    let reach = 0;
    for (let i = 0; i < far.length; i += 2) reach = Math.max(reach, Math.hypot(far[i], far[i + 1]));
    return {...thing, motion: motions[thing.motion], rest: motions[thing.rest], most: thing.most ?? Infinity, shapes: own, far, reach};
  };
  // "deflection × 2000" is called "deflection": how much it is at the moment, the player adds itself.
  const bodies = packed.bodies.map(ready).map(body => ({...body, title: body.magnified ? body.label.replace(/\s*×\s*[\d.e+]+$/, "") : body.label}));
  return {...packed, known, u: floats(packed.u), bodies, observers: packed.observers.map(ready)};
}
