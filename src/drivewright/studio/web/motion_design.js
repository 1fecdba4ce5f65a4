// The numbers behind a motion programme as the form has them, and the programme with these numbers: what a hand holds goes before.

import { FACTORS } from "./handles.js";
import { readPoints } from "./motion_points.js";
import { stretched } from "./motion_segments.js";

const tidy = value => Number(value.toPrecision(12));

/** `locked()` is the list of locked keys.  `load(programme)` takes the unpacked programme of a scene, `fill(fields)` the fields of the form by key. */
export function createMotionDesign(locked) {
  let fields = new Map(), programme = null, held = null, texts = null;  // held: {key: SI}, texts: {key: text} of a hand

  // ---- keys and numbers
  const keyOf = (n, name) => programme.list ? `${programme.list}.${n}.${programme.keys[name]}` : programme.segments[n]?.fixed?.[name] || "";
  const senseOf = (n, name) => name === "rise" && programme.segments[n]?.fixed?.sense || 1;
  /** {key, unit, factor, value, low, high} of a key, with the value that is drawn: that in the hand, for the form may be late; null where the form has no number there, or it is locked. */
  function numberAt(key, sense = 1) {
    const {unit, value, low, high} = fields.get(key) || {}, size = FACTORS[unit];
    if (!size || typeof value !== "number" || locked().includes(key)) return null;
    return {key, unit, factor: size * sense, value: held && key in held ? tidy(Math.round(held[key] / size * 1e9) / 1e9) : value, low, high};
  }
  const number = (n, name) => numberAt(keyOf(n, name), senseOf(n, name));
  const si = key => { const {unit, value} = fields.get(key) || {}; return held?.[key] ?? (typeof value === "number" ? value * (FACTORS[unit] || 1) : null); };
  const written = {
    rise(value, n) {
      const {unit} = fields.get(keyOf(n, "rise")) || {}, own = Math.abs(read().segments[n].rise) > 0 && FACTORS[unit] ? unit : programme.lift.angular ? "deg" : "mm";
      return `${tidy(Math.round(value / FACTORS[own] * 1e9) / 1e9)} ${own}`;
    },
    half(n) { const {unit, value} = fields.get(keyOf(n, "angle")), first = tidy(value / 2); return [`${first} ${unit}`, `${tidy(value - first)} ${unit}`]; },
    sum(one, other) {
      const [a, b] = [one, other].map(n => fields.get(keyOf(n, "angle")));
      return `${tidy(a.value + b.value * FACTORS[b.unit] / FACTORS[a.unit])} ${a.unit}`;
    },
  };

  // ---- the design: what is edited, for a scene may be late, or never come where the design has no solution
  function read() { return {...programme, segments: programme.list ? listed() : programme.segments.map((segment, n) => own(segment, n))}; }
  function listed() {
    const {list, keys, segments, dwell} = programme, made = [];
    for (let n = 0, level = segments[0]?.course[1][0] || 0; fields.has(`${list}.${n}.${keys.angle}`); n++) {
      const law = fields.get(keyOf(n, "law"))?.text, absolute = segments.some(segment => segment.absolute && segment.law === law), rise = absolute || law === dwell ? 0 : si(keyOf(n, "rise")) ?? 0;
      const drawn = absolute && segments[n]?.law === law ? segments[n].course[1] : [level, level + rise];
      made.push({law, absolute, rise, angle: si(keyOf(n, "angle")) ?? 0, from: drawn[0], to: drawn.at(-1)});
      level = drawn.at(-1);
    }
    return made;
  }
  const own = (segment, n) => ({...segment, law: segment.fixed.law ? fields.get(segment.fixed.law)?.text ?? segment.law : segment.law, rise: riseOf(segment, n), angle: angleOf(segment, n)});
  const riseOf = (segment, n) => { const value = si(keyOf(n, "rise")); return value === null ? segment.rise : value * senseOf(n, "rise"); };
  /** Of a segment without such a key: what the others leave of the turn. */
  function angleOf(segment, n) {
    if (programme.list || segment.fixed.angle) return si(keyOf(n, "angle")) ?? segment.angle;
    return programme.cycle.span - programme.segments.reduce((sum, other, k) => sum + (k === n ? 0 : si(keyOf(k, "angle")) ?? other.angle), 0);
  }
  /** The segment of a list that states no angle has the rest of the turn: its field gets that number. */
  function complete() {
    const {list, keys, cycle} = programme, angles = [];
    if (!list) return;
    for (let n = 0; fields.has(`${list}.${n}.${keys.angle}`); n++) angles.push([`${list}.${n}.${keys.angle}`, fields.get(`${list}.${n}.${keys.angle}`)]);
    const open = angles.filter(([, {value}]) => typeof value !== "number"), given = angles.reduce((sum, [, {value, unit}]) => sum + (typeof value === "number" ? value * (FACTORS[unit] || 1) : 0), 0);
    if (open.length === 1) fields.set(open[0][0], {...open[0][1], value: tidy((cycle.span - given) / FACTORS.deg), unit: "deg"});
  }

  // ---- what is drawn: the courses of the scene, stretched to the numbers of the design or of the hand
  function drawn(current) {
    const {segments} = programme, angles = segments.map((segment, n) => current ? angleOf(segment, n) : segment.angle), rises = segments.map((segment, n) => current ? riseOf(segment, n) : segment.rise);
    const made = stretched(programme, angles, rises);
    return {...made, origin: originOf(), segments: made.segments.map((segment, n) => ({...segment, nodes: nodesOf(segment, n, current)}))};
  }
  /** Cycle angle at which the first segment begins; null where that is 0 for good. */
  function originOf() {
    const {origin} = programme;
    return origin && Object.entries(origin.factors).reduce((sum, [key, factor]) => sum + factor * (si(key) ?? 0), origin.constant);
  }
  /** The points of a segment, `still` where a hand cannot move them: those of a file, of a locked key, or of a design that is not drawn yet. */
  function nodesOf(segment, n, current) {
    const kind = segment.points.length ? "spline" : segment.rows?.length ? "table" : "", key = kind && keyOf(n, kind === "spline" ? "points" : "rows");
    if (!kind) return null;
    const text = texts?.[key] ?? fields.get(key)?.text, given = current && !segment.file ? readPoints(text || "", kind) : null;
    const closed = kind === "table" && Math.abs(segment.angle - programme.cycle.span) < 1e-6;
    return given && !locked().includes(key) ? {...given, key, closed} : {kind, key, closed, at: kind === "spline" ? segment.points : segment.rows, still: true};
  }

  return {
    keyOf, number, numberAt, written, read, drawn, complete,
    load(next) { programme = next; },
    fill(next) { fields = next; },
    hold(numbers, text) { held = numbers && {...held, ...numbers}; texts = numbers && {...texts, ...text}; },
    holds: () => held !== null,
    /** Whether the form has what the hand held. */
    arrived: () => Object.entries(held || {}).every(([key, held]) => { const {unit, value} = fields.get(key) || {}; return typeof value !== "number" || Math.abs(value * FACTORS[unit] - held) < 1e-9; })
      && Object.entries(texts || {}).every(([key, text]) => sameText(fields.get(key)?.text, text)),
  };
}

const sameText = (one, other) => one === undefined || one.replace(/\s/g, "") === other.replace(/\s/g, "");
