// Borders, lifts and spline points of a motion programme under a hand.

import { quantityOf } from "./numbers.js";
import { LEAST, borderMoves, partnerOf } from "./motion_segments.js";
import { put } from "./parts.js";
import { element, nice } from "./player.js";
import { createGesture } from "./slider.js";
import { onGrid } from "./snapping.js";

const NEAR = 6, FINE = 5;  // px of a snap; px of a step of the grid, at least
const FREE = 0.01;  // of a degree, where a hand does not want whole ones
const DEGREE = Math.PI / 180;
const tidy = value => Number(value.toPrecision(12));

/**
 * The buttons upon the diagram.  `drawn()` is the programme as drawn, `isCurrent()` whether the design has the same segments, `number(n, name)` a key of a segment, `hold(numbers)` draws what a
 * hand holds, `select(n)` chooses a segment.
 */
export function createMotionDrag({layer, stage, plot, drawn, isCurrent, number, hold, select, tools}) {
  const {say, t, clock} = tools, bubble = element("output", {class: "hd-bubble", hidden: ""}), nudges = createGesture("programme");
  let buttons = new Map(), grip = null, pending = 0, swept = false, nudged = null;  // nudged: {id, gesture} of the last arrow key
  layer.append(bubble);

  // ---- what each button moves: {kind, n, k}
  const things = ({segments}) => [
    ...segments.map((_, n) => ({kind: "segment", n})),
    ...segments.flatMap((_, n) => borderMoves(segments, n) ? [{kind: "border", n}] : []),
    ...segments.flatMap((_, n) => partnerOf(segments, n) >= 0 ? [{kind: "lift", n}] : []),
    ...segments.flatMap(({points}, n) => points.slice(1, -1).map((_, k) => ({kind: "point", n, k: k + 1}))),
  ];
  const idOf = ({kind, n, k}) => `programme-${kind}-${n}${k === undefined ? "" : `-${k}`}`;
  const numbersOf = ({kind, n}) => kind === "border" ? [number(n - 1, "angle"), number(n, "angle")] : kind === "lift" ? [number(n, "rise"), number(partnerOf(drawn().segments, n), "rise")] : [];
  const can = (n, name) => { const {segments} = drawn(); return name === "angle" ? borderMoves(segments, n + 1) || borderMoves(segments, n) : partnerOf(segments, n) >= 0 || giverOf(segments, n) >= 0; };
  /** The segment whose lift ends where the rise of `n` begins to count: the one that has `n` as its partner. */
  const giverOf = (segments, n) => segments.findIndex((_, k) => partnerOf(segments, k) === n);

  function place(selected) {
    const programme = drawn(), wanted = things(programme), seen = new Set(wanted.map(idOf));
    for (const [id, made] of buttons) if (!seen.has(id)) { made.remove(); buttons.delete(id); }
    for (const thing of wanted) {
      const id = idOf(thing), made = buttons.get(id) || create(thing, id), segment = programme.segments[thing.n];
      if (thing.kind === "segment") strip(made, segment, thing.n, selected);
      else {
        const [x, y] = at(thing, segment), free = isCurrent() && (thing.kind === "point" || numbersOf(thing).every(Boolean));
        made.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
        made.disabled = !free;
        describe(made, thing, programme);
      }
    }
  }
  function at({kind, k}, segment) {
    if (kind === "border") return [plot.toX(segment.start), 12];
    if (kind === "lift") return [plot.toX(segment.end), plot.toY(segment.to)];
    const [u, s] = segment.points[k];
    return [plot.toX(segment.start + u * segment.angle), plot.toY(segment.from + s * segment.rise)];
  }
  function create(thing, id) {
    const look = {segment: "mf-segment", border: "mf-border", lift: "mf-lift", point: "mf-point"}[thing.kind], role = thing.kind === "segment" ? {} : {role: "slider"};
    const made = element("button", {type: "button", class: look, "data-testid": id, ...role});
    if (thing.kind === "segment") made.addEventListener("click", () => select(thing.n));
    else {
      made.addEventListener("pointerdown", event => { if (event.button === 0) press(event, made, thing); });
      made.addEventListener("keydown", event => keys(event, thing));
    }
    layer.append(made);
    buttons.set(id, made);
    return made;
  }
  function strip(made, segment, n, selected) {
    const from = plot.toX(segment.start), wide = plot.toX(segment.end) - from;
    made.style.transform = `translate(${from.toFixed(1)}px, 2px)`; made.style.width = `${wide.toFixed(1)}px`;
    made.setAttribute("aria-pressed", String(n === selected));
    put(made, wide > 26 ? t(segment.law) : "");
    made.title = `${t("Segment *", n + 1)}: ${t(segment.law)}`;
    made.setAttribute("aria-label", made.title);
  }
  const angleText = (value, {cycle}) => `${tidy(Math.round(value * cycle.factor * 1e4) / 1e4)}${cycle.unit}`;
  const liftText = (value, {lift}) => `${tidy(Math.round(value * lift.factor * 1e4) / 1e4)}${lift.unit.startsWith("°") ? "" : " "}${lift.unit}`;
  function describe(made, thing, programme) {
    const {kind, n, k} = thing, segment = programme.segments[n];
    const value = kind === "border" ? segment.start : kind === "lift" ? segment.to : segment.points[k][1];
    const name = kind === "border" ? t("Border between segments * and *", n, n + 1) : kind === "lift" ? t("Lift at the end of segment *", n + 1) : t("Point * of segment *", k, n + 1);
    const text = kind === "border" ? angleText(value, programme) : kind === "lift" ? liftText(value, programme) : segment.points[k].join(", ");
    for (const [what, said] of Object.entries({"aria-label": name, "aria-valuenow": value, "aria-valuetext": text})) made.setAttribute(what, said);
    made.title = `${name}: ${text}`;
  }

  // ---- a step of the hand
  /** Moves border `n` to an angle [rad]; `snap` to whole degrees, and where both segments are equally long; null for exactly there.  Answers the words of the snap. */
  function moveBorder(n, to, snap, gesture) {
    const {segments} = drawn(), [before, after] = numbersOf({kind: "border", n}), from = segments[n - 1].start, end = segments[n].end;
    const equal = (from + end) / 2, same = snap && Math.abs(plot.toX(to) - plot.toX(equal)) < NEAR, step = (snap ? 1 : snap === null ? 0 : FREE) * DEGREE;
    const kept = Math.min(Math.max(same ? equal : onGrid(to, step), from + LEAST), end - LEAST);
    const first = tidy(Math.round((kept - from) / before.factor * 1e9) / 1e9), change = first - before.value;
    const second = tidy(Math.round((after.value - change * before.factor / after.factor) * 1e9) / 1e9);
    send({[before.key]: `${first} ${before.unit}`, [after.key]: `${second} ${after.unit}`}, gesture,
      {[`${n - 1} angle`]: first * before.factor, [`${n} angle`]: second * after.factor});
    return same ? t("equally long") : "";
  }
  /** Moves the lift at the end of segment `n`; the next segment that moves takes up the difference. */
  function moveLift(n, to, snap, gesture) {
    const {segments} = drawn(), other = partnerOf(segments, n), [own, next] = numbersOf({kind: "lift", n}), step = stepOf(own);
    const levels = segments.filter((_, k) => k < n || k > other).map(segment => segment.from);  // the others move along
    const upon = snap && levels.find(level => Math.abs(plot.toY(level) - plot.toY(to)) < NEAR);
    const onLevel = typeof upon === "number" && Math.abs(upon - segments[n].from) > 1e-9 ? upon : null;
    const wanted = (onLevel ?? to) - segments[n].from, exact = wanted / own.factor;
    const rise = tidy(Math.round((onLevel === null ? onGrid(exact, snap ? step : step / 10) : exact) * 1e5) / 1e5);  // courses are single precision
    const rest = tidy(Math.round((next.value - (rise - own.value) * own.factor / next.factor) * 1e9) / 1e9);
    if (!rise || !rest) return "";
    send({[own.key]: `${rise} ${own.unit}`, [next.key]: `${rest} ${next.unit}`}, gesture, {[`${n} rise`]: rise * own.factor, [`${other} rise`]: rest * next.factor});
    return onLevel === null ? "" : t("level with another");
  }
  /** Size of a step of the lift, in the unit of its key. */
  const stepOf = ({factor}) => nice(Math.max(Math.abs(plot.fromY(0) - plot.fromY(FINE)) / factor, 1e-9) * 1.999);
  /** Moves point `k` of the spline of segment `n` to (u, s). */
  function movePoint(n, k, [u, s], gesture) {
    const {segments, list, keys: names} = drawn(), {points} = segments[n], round = value => tidy(Math.round(value * 1e3) / 1e3);
    const at = [round(Math.min(Math.max(u, points[k - 1][0] + 0.01), points[k + 1][0] - 0.01)), round(s)];
    const next = points.map((point, each) => each === k ? at : point);
    send({[`${list}.${n}.${names.points}`]: JSON.stringify(next)}, gesture, {});
  }
  function send(changes, gesture, numbers) {
    hold(numbers);
    say({what: "drag", changes, gesture});
  }

  // ---- pointer
  const pixel = event => { const area = stage.getBoundingClientRect(); return [event.clientX - area.left, event.clientY - area.top]; };
  function press(event, made, thing) {
    event.preventDefault(); event.stopPropagation();
    if (grip) return;  // another finger has one
    const [x, y] = pixel(event), [ox, oy] = at(thing, drawn().segments[thing.n]);
    made.focus({preventScroll: true});
    made.setPointerCapture(event.pointerId);
    grip = {made, thing, off: [x - ox, y - oy], last: null, gesture: createGesture(idOf(thing)).current(), words: ""};
    made.classList.add("is-held");
    for (const [name, act] of Object.entries(WHILE_HELD)) made.addEventListener(name, act);
    showBubble();
  }
  function move(event) {
    if (!grip) return;
    const [x, y] = pixel(event);
    Object.assign(grip, {last: [x - grip.off[0], y - grip.off[1]], free: event.altKey});
    if (!pending) pending = requestAnimationFrame(follow);  // once a frame
  }
  function follow() {
    pending = 0;
    if (!grip?.last) return;
    const {thing: {kind, n, k}, last: [x, y], free, gesture} = grip, segment = drawn().segments[n];
    if (kind === "border") grip.words = moveBorder(n, plot.fromX(x), !free, gesture);
    else if (kind === "lift") grip.words = moveLift(n, plot.fromY(y), !free, gesture);
    else movePoint(n, k, [(plot.fromX(x) - segment.start) / segment.angle, (plot.fromY(y) - segment.from) / segment.rise], gesture);
    showBubble();
  }
  function showBubble() {
    const {made, thing, words} = grip, [x, y] = at(thing, drawn().segments[thing.n]);
    bubble.hidden = false;
    put(bubble, `${made.getAttribute("aria-valuetext")}${words ? ` · ${words}` : ""}`);
    const wide = bubble.offsetWidth, left = x + 14 + wide > layer.clientWidth ? x - 14 - wide : x + 14;
    bubble.style.transform = `translate(${left}px, ${Math.max(26, y - 30)}px)`;
  }
  function release() {
    if (!grip) return;
    if (pending) { cancelAnimationFrame(pending); follow(); }
    end();
    hold(null);
  }
  function end() {
    cancelAnimationFrame(pending); pending = 0;
    const {made} = grip;
    grip = null;
    for (const [name, act] of Object.entries(WHILE_HELD)) made.removeEventListener(name, act);
    made.classList.remove("is-held");
    bubble.hidden = true;
  }
  const WHILE_HELD = {pointermove: move, pointerup: release, pointercancel: release, lostpointercapture: release};

  // ---- keys and typing
  function keys(event, {kind, n, k}) {
    const step = {ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key], times = event.shiftKey ? 10 : 1, segment = drawn().segments[n];
    if (event.key === "Escape" && grip) { const {gesture} = grip; event.preventDefault(); event.stopPropagation(); end(); hold(null); say({what: "revert", gesture}); return; }
    if (event.key === "Escape" && nudged?.id === idOf({kind, n, k})) {  // the steps of the arrow keys before it
      event.preventDefault(); event.stopPropagation();
      say({what: "revert", gesture: nudged.gesture});
      nudged = null; nudges.end();
      return;
    }
    if (!step || !(kind === "point" || numbersOf({kind, n}).every(Boolean))) return;
    event.preventDefault(); event.stopPropagation();
    const [dx, dy] = step, id = idOf({kind, n, k});
    if (nudged?.id !== id) nudges.end();
    nudged = {id, gesture: nudges.next()};
    if (kind === "border") moveBorder(n, segment.start + (dx + dy) * times * DEGREE, false, nudged.gesture);
    else if (kind === "lift") { const [own] = numbersOf({kind, n}); moveLift(n, segment.to + (dx + dy) * times * stepOf(own) * own.factor, false, nudged.gesture); }
    else movePoint(n, k, [segment.points[k][0] + dx * times * 0.01, segment.points[k][1] + dy * times * 0.01], nudged.gesture);
    hold(null);
  }
  /** A typed angle or rise of segment `n`: the border behind it moves, or the one before the last; the lift at its end, or at its start. */
  function typed(n, name, text) {
    const [value, unit] = quantityOf(text) || [], own = number(n, name), {segments} = drawn();
    if (!Number.isFinite(value) || !own) return;
    if (!isCurrent() || unit && unit !== own.unit && !(unit === "°" && own.unit === "deg")) { say({what: "set", key: own.key, text: unit ? text : `${value} ${own.unit}`}); return; }
    const wanted = value * own.factor, gesture = createGesture(own.key).current();
    if (name === "angle") borderMoves(segments, n + 1) ? moveBorder(n + 1, segments[n].start + wanted, null, gesture) : moveBorder(n, segments[n].end - wanted, null, gesture);
    else if (partnerOf(segments, n) >= 0) exactLift(n, wanted, gesture);
    else { const giver = giverOf(segments, n); exactLift(giver, segments[giver].rise + segments[n].rise - wanted, gesture); }
    hold(null);
  }
  function exactLift(n, rise, gesture) {
    const other = partnerOf(drawn().segments, n), [own, next] = numbersOf({kind: "lift", n}), first = tidy(rise / own.factor);
    const rest = tidy(next.value - (first - own.value) * own.factor / next.factor);
    if (first && rest) send({[own.key]: `${first} ${own.unit}`, [next.key]: `${rest} ${next.unit}`}, gesture, {[`${n} rise`]: first * own.factor, [`${other} rise`]: rest * next.factor});
  }

  // ---- the clock, where nothing else is under the hand
  function sweep(event) { clock.pause(); clock.set(plot.fromX(pixel(event)[0]) / drawn().cycle.span); }
  stage.addEventListener("pointerdown", event => { if (event.target.tagName === "CANVAS" && drawn()) { swept = true; event.target.setPointerCapture(event.pointerId); sweep(event); } });
  stage.addEventListener("pointermove", event => { if (swept) sweep(event); });
  for (const name of ["pointerup", "pointercancel"]) stage.addEventListener(name, () => { swept = false; });
  return {place, can, typed, held: () => grip !== null, reword() { buttons.forEach(made => made.remove()); buttons = new Map(); }, destroy() { if (grip) end(); }};
}
