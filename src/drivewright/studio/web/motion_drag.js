// Borders, lifts and points of a motion programme under a hand.

import { DEGREE, createMotionMoves } from "./motion_moves.js";
import { liftAt, placeOf, pointMoves, seenPoints } from "./motion_points.js";
import { borderMoves, partnerOf } from "./motion_segments.js";
import { put } from "./parts.js";
import { element } from "./player.js";
import { createGesture } from "./slider.js";

const BORDER = 18, POINTS = {apart: 15, most: 7, reach: 70};  // px between borders; between points that are seen, how many, how far from the hand
const TAP = {time: 350, far: 24}, ON_CURVE = 20;  // ms and px of a double tap; px
const GRIP = 5, LETTER = 6.2, SIGN = 12;  // px that the handle of a border takes of a segment's name; of a letter; of a Chinese sign
const tidy = value => Number(value.toPrecision(12));

/**
 * The buttons upon the diagram.  `drawn()` is the programme as drawn, `isCurrent()` whether the design has the same segments, `number(n, name)` a key of a segment, `numberAt(key)` any other,
 * `hold(numbers, texts)` draws what a hand holds, `select(n)` chooses a segment, `choose(n, k)` a point of it, `chosen()` is that point.
 */
export function createMotionDrag(parts) {
  const {layer, stage, plot, drawn, isCurrent, number, hold, select, choose = () => {}, chosen = () => null, tools} = parts;
  const {say, t, clock} = tools, bubble = element("output", {class: "hd-bubble", hidden: ""}), nudges = createGesture("programme"), moves = createMotionMoves(parts);
  let buttons = new Map(), grip = null, pending = 0, swept = false, nudged = null, hover = null, last = null, tapped = null, touched = -Infinity;  // nudged: {id, gesture} of the last arrow key; last: argument of `place`
  layer.append(bubble);

  // ---- what each button moves: {kind, n, k}
  function things() {
    const {segments} = drawn();
    return [
      ...segments.map((_, n) => ({kind: "segment", n})),
      ...segments.flatMap((_, n) => borderMoves(segments, n) ? [{kind: "border", n}] : []),
      ...segments.flatMap((_, n) => partnerOf(segments, n) >= 0 ? [{kind: "lift", n}] : []),
      ...segments.flatMap((segment, n) => points(segment, n).map(k => ({kind: "point", n, k}))),
    ];
  }
  /** The points of a segment that have a handle. */
  function points(segment, n) {
    if (!segment.nodes) return [];
    const xs = segment.nodes.at.map((_, k) => plot.toX(placeOf(segment, k)[0])), own = chosen();
    const held = grip?.thing.kind === "point" && grip.thing.n === n ? grip.thing.k : null;
    return held !== null && xs.length > 2 * POINTS.most ? [held] : seenPoints(xs, k => pointMoves(segment, k), {...POINTS, x: hover, chosen: own?.n === n ? own.k : -1});
  }
  const idOf = ({kind, n, k}) => `programme-${kind}-${n}${k === undefined ? "" : `-${k}`}`;
  const numbersOf = ({kind, n}) => kind === "border" ? moves.movers(n).map(([own]) => own) : kind === "lift" ? [number(n, "rise"), number(partnerOf(drawn().segments, n), "rise")] : [];
  const isFree = thing => isCurrent() && (thing.kind === "point" || numbersOf(thing).every(Boolean));

  function place(selected = last) {
    last = selected;
    const programme = drawn(), wanted = things(), seen = new Set(wanted.map(idOf)), asides = aside(wanted, programme);
    for (const [id, made] of buttons) if (!seen.has(id)) { const had = document.activeElement === made; made.remove(); buttons.delete(id); if (had) buttons.get(idOf({kind: "segment", n: selected}))?.focus({preventScroll: true}); }
    for (const thing of wanted) {
      const id = idOf(thing), made = buttons.get(id) || create(thing, id), segment = programme.segments[thing.n];
      if (thing.kind === "segment") { strip(made, segment, thing.n, selected); continue; }
      const [x, y] = at(thing, segment), own = chosen();
      made.style.transform = `translate(${(x + (asides.get(id) || 0)).toFixed(1)}px, ${y.toFixed(1)}px)`;
      made.disabled = !isFree(thing);
      if (thing.kind === "point") made.classList.toggle("is-chosen", own?.n === thing.n && own.k === thing.k);
      describe(made, thing, programme);
    }
  }
  /** Px that borders stand aside of where they are, so that a hand can tell them apart. */
  function aside(wanted, {segments}) {
    const found = wanted.filter(({kind}) => kind === "border").map(thing => ({id: idOf(thing), x: at(thing, segments[thing.n])[0]})).sort((a, b) => a.x - b.x), map = new Map();
    for (let n = 1; n < found.length; n++) {
      const short = BORDER - (found[n].x - found[n - 1].x);
      if (short > 0) { map.set(found[n - 1].id, (map.get(found[n - 1].id) || 0) - short / 2); map.set(found[n].id, short / 2); }
    }
    return map;
  }
  function at({kind, k}, segment) {
    if (kind === "border") return [plot.toX(segment.start), 12];
    if (kind === "lift") return [plot.toX(segment.end), plot.toY(segment.to)];
    const [angle, lift] = placeOf(segment, k);
    return [plot.toX(angle), plot.toY(lift)];
  }
  function create(thing, id) {
    const look = {segment: "mf-segment", border: "mf-border", lift: "mf-lift", point: "mf-point"}[thing.kind], role = thing.kind === "segment" ? {} : {role: "slider"};
    const made = element("button", {type: "button", class: look, "data-testid": id, ...role});
    if (thing.kind === "segment") made.addEventListener("click", () => select(thing.n));
    else {
      made.addEventListener("pointerdown", event => { if (event.button === 0) press(event, made, thing); });
      made.addEventListener("keydown", event => keys(event, thing));
      if (thing.kind === "point") made.addEventListener("focus", () => choose(thing.n, thing.k));
    }
    layer.append(made);
    buttons.set(id, made);
    return made;
  }
  function strip(made, segment, n, selected) {
    const [from, to] = plot.parts ? plot.parts(segment.start, segment.end).sort((a, b) => b[1] - b[0] - a[1] + a[0])[0] || [0, 0] : [plot.toX(segment.start), plot.toX(segment.end)], wide = to - from;
    made.style.transform = `translate(${from.toFixed(1)}px, 2px)`; made.style.width = `${wide.toFixed(1)}px`;
    made.setAttribute("aria-pressed", String(n === selected));
    const law = t(segment.law);
    put(made, wideOf(law) < wide - 2 * GRIP ? law : "");  // a name that is cut says nothing
    made.title = `${t("Segment *", n + 1)}: ${t(segment.law)}`;
    made.setAttribute("aria-label", made.title);
  }
  const rounded = value => tidy(Math.round(value * 1e4) / 1e4);
  const angleText = (value, {cycle}) => `${rounded(value * cycle.factor)}${cycle.unit}`;
  const liftText = (value, {lift}) => `${rounded(value * lift.factor)}${lift.unit.startsWith("°") ? "" : " "}${lift.unit}`;
  /** The angle of the cycle where a border is. */
  const cycleAngle = (angle, {origin, cycle}) => origin == null ? angle : angle + origin - Math.floor((angle + origin) / cycle.span + 1e-9) * cycle.span;
  function describe(made, thing, programme) {
    const {kind, n, k} = thing, segment = programme.segments[n], [x, y] = kind === "point" ? segment.nodes.at[k] : [], count = programme.segments.length;
    const value = kind === "border" ? cycleAngle(segment.start, programme) : kind === "lift" ? segment.to : y;
    const name = kind === "border" ? t("Border between segments * and *", n || count, n + 1) : kind === "lift" ? t("Lift at the end of segment *", n + 1) : t("Point * of segment *", k + 1, n + 1);
    const text = kind === "border" ? angleText(value, programme) : kind === "lift" ? liftText(value, programme) : segment.nodes.kind === "spline" ? `${x}, ${y}` : `${angleText(x, programme)}, ${liftText(y, programme)}`;
    for (const [what, said] of Object.entries({"aria-label": name, "aria-valuenow": value, "aria-valuetext": text})) made.setAttribute(what, said);
    made.title = `${name}: ${text}`;
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
    const {thing: {kind, n, k}, last: [x, y], free, gesture} = grip, angle = plot.fromX(x);
    if (kind === "border") grip.words = moves.border(n, angle, !free, gesture);
    else if (kind === "lift") grip.words = moves.lift(n, plot.fromY(y), !free, gesture);
    else grip.words = moves.point(n, k, [angle, plot.fromY(y)], !free, gesture);
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

  // ---- keys
  function keys(event, {kind, n, k}) {
    const step = {ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key], times = event.shiftKey ? 10 : 1, segment = drawn().segments[n];
    const taken = () => { event.preventDefault(); event.stopPropagation(); };
    if (event.key === "Escape" && grip) { const {gesture} = grip; taken(); end(); hold(null); say({what: "revert", gesture}); return; }
    if (event.key === "Escape" && nudged?.id === idOf({kind, n, k})) {  // the steps of the arrow keys before it
      taken();
      say({what: "revert", gesture: nudged.gesture});
      nudged = null; nudges.end();
      return;
    }
    if (kind === "point" && (event.key === "Delete" || event.key === "Backspace")) { taken(); if (!grip) removeHere(n, k); return; }
    if (!step || !isFree({kind, n, k})) return;
    taken();
    const [dx, dy] = step, id = idOf({kind, n, k});
    if (nudged?.id !== id) nudges.end();
    nudged = {id, gesture: nudges.next()};
    if (kind === "border") moves.border(n, segment.start + (dx + dy) * times * DEGREE, false, nudged.gesture);
    else if (kind === "lift") { const [own] = numbersOf({kind, n}); moves.lift(n, segment.to + (dx + dy) * times * moves.stepOf(own) * own.factor, false, nudged.gesture); }
    else nudge(segment, n, k, dx * times, dy * times);
    hold(null);
  }
  /** Takes a point away; the next one has the keys then, or the one before it. */
  function removeHere(n, k) {
    const next = Math.min(k, drawn().segments[n].nodes.at.length - 3);
    if (!moves.remove(n, k)) return;
    choose(n, next);
    buttons.get(idOf({kind: "point", n, k: next}))?.focus({preventScroll: true});
  }
  function nudge(segment, n, k, dx, dy) {
    const [angle, lift] = placeOf(segment, k), table = segment.nodes.kind === "table", up = table ? Math.abs(plot.fromY(0) - plot.fromY(2)) : 0.01 * segment.rise;
    moves.point(n, k, [angle + dx * (table ? 0.1 * DEGREE : 0.01 * segment.angle), lift + dy * up], false, nudged.gesture);
  }

  // ---- where nothing else is under the hand: the clock, points that come near, and another point by a double click or tap on the curve
  function sweep(event) { clock.pause(); clock.set(turns(plot.fromX(pixel(event)[0]))); }
  const turns = angle => { const {cycle: {span}, origin} = drawn(); return (angle + (origin || 0)) / span; };
  function lookAt(x) {
    hover = x;
    if (drawn().segments.some(({nodes}) => nodes && !nodes.still && nodes.at.length > POINTS.most)) place();
  }
  function another(event) {
    const [x, y] = pixel(event), {segments} = drawn(), angle = plot.fromX(x), n = segments.findIndex(({start, end}) => angle >= start && angle < end);
    if (n < 0 || Math.abs(plot.toY(liftAt(segments[n], angle)) - y) > ON_CURVE) return;
    const k = moves.add(n, angle);
    if (k !== null) choose(n, k);
  }
  function tap(event) {
    const at = pixel(event), now = event.timeStamp, again = tapped && now - tapped.now < TAP.time && Math.hypot(at[0] - tapped.at[0], at[1] - tapped.at[1]) < TAP.far;
    tapped = again ? null : {at, now}; touched = now;
    if (again) another(event);
  }
  stage.addEventListener("pointerdown", event => {
    if (event.target.tagName !== "CANVAS" || !drawn()) return;
    swept = true; event.target.setPointerCapture(event.pointerId); sweep(event); lookAt(pixel(event)[0]);
  });
  stage.addEventListener("pointermove", event => { if (swept) sweep(event); if (!grip && drawn()) lookAt(pixel(event)[0]); });
  stage.addEventListener("pointerup", event => { if (swept && event.pointerType === "touch" && drawn()) tap(event); });
  stage.addEventListener("dblclick", event => { if (event.target.tagName === "CANVAS" && event.timeStamp - touched > 2 * TAP.time && drawn()) another(event); });
  for (const name of ["pointerup", "pointercancel"]) stage.addEventListener(name, () => { swept = false; });
  return {
    place, ...moves, held: () => grip !== null,
    reword() { buttons.forEach(made => made.remove()); buttons = new Map(); }, destroy() { if (grip) end(); },
  };
}

/** About how wide a text is [px]. */
const wideOf = text => [...text].reduce((sum, letter) => sum + (letter >= "\u2e80" ? SIGN : LETTER), 0);
