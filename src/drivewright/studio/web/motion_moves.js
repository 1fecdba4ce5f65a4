// Steps of a motion programme: what a border, a lift, a point or a typed number changes in the spec.

import { quantityOf } from "./numbers.js";
import { FEWEST, MOST, addedPoint, liftAt, movedPoint, pointAt, pointMoves, typedPart, withoutPoint } from "./motion_points.js";
import { LEAST, borderMoves, partnerOf } from "./motion_segments.js";
import { nice } from "./player.js";
import { createGesture } from "./slider.js";
import { onGrid } from "./snapping.js";

const NEAR = 6, FINE = 5;  // px of a snap; px of a step of the grid, at least
const FREE = 0.01;  // of a degree, where a hand does not want whole ones
export const DEGREE = Math.PI / 180;
const tidy = value => Number(value.toPrecision(12)), short = value => tidy(Math.round(value * 1e9) / 1e9);

/** The steps; parameters as of `createMotionDrag`. */
export function createMotionMoves({plot, drawn, isCurrent, number, numberAt, hold, tools: {say, t}}) {
  const send = (changes, gesture, numbers, texts = {}) => { hold(numbers, texts); say({what: "drag", changes, gesture}); };
  const textsOf = (pairs) => Object.fromEntries(pairs.map(([{key, unit}, value]) => [key, `${value} ${unit}`]));
  const heldOf = (pairs) => Object.fromEntries(pairs.map(([{key, factor}, value]) => [key, value * Math.abs(factor)]));  // of the key itself, whatever its sense

  // ---- borders
  /** What moves with border `n`: [number, its change per change of the angle]. */
  function movers(n) {
    const {segments} = drawn(), {fixed} = segments[n];
    return fixed ? Object.entries(fixed.border).map(([key, by]) => [numberAt(key), by]) : [[number(n - 1, "angle"), 1], [number(n, "angle"), -1]];
  }
  /** What is left of a segment at least; of a dwell between two motions nothing. */
  const least = ({fixed, law, angle}) => Math.min(angle, fixed?.angle && law === drawn().dwell ? 0 : LEAST);
  /** An angle of the cycle is less than a turn. */
  function wrapped({low, high, factor}, value) {
    const turn = tidy(drawn().cycle.span / Math.abs(factor));
    return low === 0 && high === turn ? short(value - Math.floor(value / turn) * turn) : value;
  }
  /** Moves border `n` to an angle [rad]; `snap` to whole degrees, and where both segments are equally long; null for exactly there.  Answers the words of the snap. */
  function border(n, to, snap, gesture) {
    const {segments, origin = 0, cycle} = drawn(), moved = movers(n), turned = origin || 0, before = segments.at(n - 1), after = segments[n], now = after.start;
    const target = after.fixed ? to - Math.round((to - now) / cycle.span) * cycle.span : to;  // where the turn begins elsewhere, the nearest such angle
    const equal = (before.start + after.end) / 2, same = snap && n > 0 && moved.length === 2 && Math.abs(plot.toX(target) - plot.toX(equal)) < NEAR, step = (snap ? 1 : snap === null ? 0 : FREE) * DEGREE;
    const place = same ? equal : onGrid(target + turned, step) - turned, kept = Math.min(Math.max(place, now - before.angle + least(before)), now + after.angle - least(after));
    const [[lead, by], ...others] = moved, first = short(lead.value + by * (kept - now) / lead.factor), change = (first - lead.value) * lead.factor / by;
    const pairs = [[lead, wrapped(lead, first)], ...others.map(([own, factor]) => [own, short(own.value + factor * change / own.factor)])];
    send(textsOf(pairs), gesture, heldOf(pairs));
    return same ? t("equally long") : "";
  }

  // ---- lifts
  /** Size of a step of the lift, in the unit of its key. */
  const stepOf = ({factor}) => nice(Math.max(Math.abs((plot.fromY(0) - plot.fromY(FINE)) / factor), 1e-9) * 1.999);
  function raised(n, rise, gesture) {
    const other = partnerOf(drawn().segments, n), [own, next] = [number(n, "rise"), number(other, "rise")], rest = short(next.value - (rise - own.value) * own.factor / next.factor);
    if (!rise || !rest || own.low >= 0 && rise < 0) return false;
    send(textsOf([[own, rise], [next, rest]]), gesture, heldOf([[own, rise], [next, rest]]));
    return true;
  }
  /** Moves the lift at the end of segment `n`; the next segment that moves takes up the difference. */
  function lift(n, to, snap, gesture) {
    const {segments} = drawn(), other = partnerOf(segments, n), own = number(n, "rise"), step = stepOf(own);
    const levels = segments.filter((_, k) => k < n || k > other).map(segment => segment.from);  // the others move along
    const upon = snap && levels.find(level => Math.abs(plot.toY(level) - plot.toY(to)) < NEAR);
    const onLevel = typeof upon === "number" && Math.abs(upon - segments[n].from) > 1e-9 ? upon : null;
    const exact = ((onLevel ?? to) - segments[n].from) / own.factor;
    const rise = tidy(Math.round((onLevel === null ? onGrid(exact, snap ? step : step / 10) : exact) * 1e5) / 1e5);  // courses are single precision
    return raised(n, rise, gesture) && onLevel !== null ? t("level with another") : "";
  }

  // ---- points
  const keepPoint = (segment, text, gesture) => send({[segment.nodes.key]: text}, gesture, {}, {[segment.nodes.key]: text});
  /** Moves point `k` of segment `n` to [angle, lift]; a row of a table by steps that people read, and straight up or down unless it is taken aside. */
  function point(n, k, [angle, lift_], snap, gesture) {
    const {segments, lift: shown, cycle} = drawn(), segment = segments[n], [x, y] = pointAt(segment, angle, lift_), [own] = segment.nodes.at[k];
    if (segment.nodes.kind === "spline") { keepPoint(segment, movedPoint(segment, k, [onGrid(x, 1e-3), onGrid(y, 1e-3)]), gesture); return ""; }
    const straight = snap && Math.abs(x - own) * Math.abs(plot.toX(segment.end) - plot.toX(segment.start)) / segment.angle < NEAR, step = nice(Math.abs(plot.fromY(0) - plot.fromY(1)) * shown.factor) / (snap ? 1 : 10);
    const at = [straight ? own : onGrid(x * cycle.factor, snap ? 0.1 : 0.01) / cycle.factor, onGrid(y * shown.factor, step) / shown.factor];
    keepPoint(segment, movedPoint(segment, k, at), gesture);
    return straight ? t("at its angle") : "";
  }
  /** A typed part of a point, 0 or 1; whether it is one. */
  function typedPoint(n, k, part, text) {
    const segment = drawn().segments[n], value = typedPart(segment, k, part, text);
    if (!Number.isFinite(value) || !isCurrent() || !pointMoves(segment, k)) return false;
    keepPoint(segment, movedPoint(segment, k, segment.nodes.at[k].map((own, each) => each === part ? value : own)), createGesture(segment.nodes.key).current());
    hold(null);
    return true;
  }
  /** Another point of segment `n` on its curve, at an angle of the programme; its number, null where there is no room. */
  function add(n, angle) {
    const {segments, lift: shown} = drawn(), segment = segments[n];
    if (!isCurrent() || !segment?.nodes || segment.nodes.still) return null;
    const [x, y] = pointAt(segment, angle, liftAt(segment, angle)), table = segment.nodes.kind === "table";
    const added = addedPoint(segment, table ? [onGrid(x / DEGREE, 0.01) * DEGREE, Number((y * shown.factor).toPrecision(6)) / shown.factor] : [onGrid(x, 1e-3), onGrid(y, 1e-4)]);
    if (!added) return null;
    hold({}, {[segment.nodes.key]: added.text}); hold(null);
    say({what: "set", key: segment.nodes.key, text: added.text});
    return added.k;
  }
  /** Takes point `k` of segment `n` away; whether that could be done. */
  function remove(n, k) {
    const segment = drawn().segments[n], text = isCurrent() && segment?.nodes && withoutPoint(segment, k);
    if (!text) return false;
    hold({}, {[segment.nodes.key]: text}); hold(null);
    say({what: "set", key: segment.nodes.key, text});
    return true;
  }

  // ---- typing
  /** The segment whose lift ends where the rise of `n` begins to count: the one that has `n` as its partner. */
  const giverOf = (segments, n) => segments.findIndex((_, k) => partnerOf(segments, k) === n);
  function can(n, name) {
    const {segments} = drawn();
    if (segments[n].fixed) return Boolean(segments[n].fixed[name]);
    return name === "angle" ? borderMoves(segments, n + 1) || borderMoves(segments, n) : partnerOf(segments, n) >= 0 || giverOf(segments, n) >= 0;
  }
  /** A typed angle or rise of segment `n`: the border behind it moves, or the one before the last; the lift at its end, or at its start. */
  function typed(n, name, text) {
    const [value, unit] = quantityOf(text) || [], own = number(n, name), {segments} = drawn();
    if (!Number.isFinite(value) || !own) return;
    const sense = Math.sign(own.factor), known = !unit || unit === own.unit || unit === "°" && own.unit === "deg";
    if (!isCurrent() || segments[n].fixed || !known) { say({what: "set", key: own.key, text: known ? `${sense * value} ${own.unit}` : `${sense * value} ${unit}`}); return; }
    const wanted = value * own.factor, gesture = createGesture(own.key).current();
    if (name === "angle") borderMoves(segments, n + 1) ? border(n + 1, segments[n].start + wanted, null, gesture) : border(n, segments[n].end - wanted, null, gesture);
    else if (partnerOf(segments, n) >= 0) raised(n, tidy(wanted / own.factor), gesture);
    else { const giver = giverOf(segments, n); raised(giver, tidy((segments[giver].rise + segments[n].rise - wanted) / number(giver, "rise").factor), gesture); }
    hold(null);
  }

  return {movers, border, lift, point, add, remove, can, typed, typedPoint, stepOf, isFull: segment => segment.nodes.at.length >= MOST, isFew: segment => segment.nodes.at.length <= FEWEST};
}
