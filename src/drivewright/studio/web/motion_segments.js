// The segments of a motion programme as the page moves them: plain functions over angles, rises and courses.

import { floats } from "./player.js";

export const LEAST = Math.PI / 180;  // rad that a segment keeps
const JUMP = 1e-4;  // of its peak: less is rounding of the samples
const STILL = 1e-9;  // m or rad of a rise that is none

/** The packed programme with arrays instead of text. */
export const unpacked = packed => ({...packed, segments: packed.segments.map(segment => ({...segment, course: segment.course.map(floats)}))});

/** The programme with other angles and rises: courses are stretched, which is exact for all but a spline's points. */
export function stretched(programme, angles, rises) {
  let start = 0, level = programme.segments[0]?.course[1][0] || 0;
  const segments = programme.segments.map((segment, n) => {
    const [theta, s, ...rates] = segment.course, wide = segment.angle ? angles[n] / segment.angle : 1, tall = segment.absolute || !segment.rise ? 1 : rises[n] / segment.rise;
    const base = segment.absolute ? s[0] : level, own = s[0];
    const course = [theta.map(part => part * wide + start), s.map(part => base + (part - own) * tall), ...rates.map((rate, order) => rate.map(part => part * tall / wide ** (order + 1)))];
    const made = {...segment, angle: angles[n], rise: rises[n], start, end: start + angles[n], from: course[1][0], to: course[1].at(-1), course};
    start += angles[n];
    level = made.to;
    return made;
  });
  return {...programme, segments};
}

/** Largest magnitude of lift (over its lowest) and of each derivative: [s, v, a, j]; Infinity where a lower derivative jumps. */
export function peaksOf(programme, jumps) {
  const most = order => Math.max(...programme.segments.map(({course}) => course[order + 1].reduce((peak, value) => Math.max(peak, Math.abs(value)), 0)));
  const lifts = programme.segments.map(({course}) => course[1]), high = Math.max(...lifts.map(s => Math.max(...s))), low = Math.min(...lifts.map(s => Math.min(...s)));
  const [worst] = jumps.map(({order}) => order).sort();
  return [high - low, ...[1, 2, 3].map(order => order > worst ? Infinity : most(order))];
}

/** Where velocity (order 1) or acceleration (2) jumps: [{at, order}], the lowest order only. */
export function jumpsOf(programme) {
  const segments = programme.segments.filter(({start, end}) => end > start), found = [];
  const peaks = [1, 2].map(order => Math.max(...segments.map(({course}) => course[order + 1].reduce((peak, value) => Math.max(peak, Math.abs(value)), 0))));
  const look = (at, before, after) => {
    const order = [1, 2].find(n => Math.abs(after[n] - before[n]) > JUMP * peaks[n - 1]);
    if (order) found.push({at, order});
  };
  const valuesAt = ({course}, n) => [1, 2, 3].map(row => course[row].at(n));
  segments.forEach((segment, n) => {
    const before = segments.at(n - 1), [theta] = segment.course;
    look(segment.start, valuesAt(before, -1), valuesAt(segment, 0));
    for (let i = 1; i < theta.length; i++) if (theta[i] - theta[i - 1] < 1e-7) look(theta[i], valuesAt(segment, i - 1), valuesAt(segment, i));
  });
  return found.filter(({at, order}, n) => !found.slice(0, n).some(other => Math.abs(other.at - at) < 1e-6 && other.order <= order));
}

// ---------------------------------------------------------------------------------------------------------------- what can move

/** Whether the border before segment `n` can move: its keys say so, or it is one of a list and no table stands beside it. */
export const borderMoves = (segments, n) => segments[n]?.fixed ? Object.keys(segments[n].fixed.border).length > 0 : n > 0 && n < segments.length && !segments[n - 1].absolute && !segments[n].absolute;

const moves = ({absolute, rise}) => !absolute && Math.abs(rise) > STILL;

/** The segment that takes up what the end of segment `n` is raised by: the next that moves, with nothing but dwells between; -1 for none. */
export function partnerOf(segments, n) {
  if (!moves(segments[n])) return -1;
  for (let k = n + 1; k < segments.length; k++) {
    if (segments[k].absolute) return -1;
    if (moves(segments[k])) return k;
  }
  return -1;
}

/** A segment other than `n` that can take `rise` besides its own and still moves; -1 for none. */
export function taker(segments, n, rise) {
  const order = [...segments.keys()].map(k => (n + 1 + k) % segments.length).filter(k => k !== n);
  return order.find(k => moves(segments[k]) && Math.abs(segments[k].rise + rise) > STILL) ?? -1;
}

// ------------------------------------------------------------------------------------------------------------------ other lists
// Each answers the rises that the segments of before have then, and the elements for the message "arrange"; null where it cannot be done.

/** Another law for segment `n`; `texts.rise(number)` writes a rise, with the unit that segments have. */
export function withLaw({segments, keys, lawKeys, laws, dwell}, n, law, texts) {
  const segment = segments[n], chosen = laws.find(({name}) => name === law), still = !moves(segment);
  const own = law === dwell ? 0 : still ? Number((strokeOf(segments) / 4).toPrecision(3)) : segment.rise, change = segment.rise - own, other = change ? taker(segments, n, change) : n;
  if (!chosen || segment.absolute || other < 0) return null;
  const changes = {...Object.fromEntries(lawKeys.map(key => [key, ""])), ...chosen.parameters, [keys.law]: law, [keys.rise]: own ? texts.rise(own, n) : ""};
  return segments.map((each, k) => ({of: k, changes: k === n ? changes : k === other ? {[keys.rise]: texts.rise(each.rise + change, k)} : {}}));
}

/** Segment `n` half as long, and a dwell behind it. */
export function withDwell({segments, keys, lawKeys, dwell}, n, texts) {
  if (segments[n].absolute || segments[n].angle < 2 * LEAST) return null;
  const half = texts.half(n), none = Object.fromEntries(lawKeys.map(key => [key, ""]));
  const split = [{of: n, changes: {[keys.angle]: half[0]}}, {of: n, changes: {...none, [keys.angle]: half[1], [keys.law]: dwell, [keys.rise]: ""}}];
  return segments.flatMap((_, k) => k === n ? split : [{of: k, changes: {}}]);
}

/** Without segment `n`: a neighbour takes its angle, another one its rise. */
export function without({segments, keys}, n, texts) {
  const {rise, absolute} = segments[n], heir = n > 0 ? n - 1 : 1, other = moves(segments[n]) ? taker(segments, n, rise) : n;
  if (absolute || segments.length < 2 || segments[heir].absolute || other < 0) return null;
  const changes = k => ({...(k === heir ? {[keys.angle]: texts.sum(heir, n)} : {}), ...(k === other ? {[keys.rise]: texts.rise(segments[k].rise + rise, k)} : {})});
  return segments.flatMap((_, k) => k === n ? [] : [{of: k, changes: changes(k)}]);
}

function strokeOf(segments) {
  const levels = segments.flatMap(({from, to}) => [from, to]);
  return Math.max(...levels) - Math.min(...levels) || 0.01;
}
