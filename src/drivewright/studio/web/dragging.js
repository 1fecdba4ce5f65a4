// One handle under a hand: pointer, arrow keys, typed numbers; grid and other points attract it; Esc takes everything back.

import { element, nice } from "./player.js";
import { quantityOf } from "./numbers.js";
import { put } from "./parts.js";
import { createGesture } from "./slider.js";
import { onGrid, snapped } from "./snapping.js";
import { svgPart } from "./svg_parts.js";

const SHAKE = 3, FINE = 1, COARSE = 6;  // px of a hand that presses without moving; px of a step of the grid, of an arrow key, at least
const SEEN = 2500;  // ms that the numbers stay after an arrow key
const AHEAD = 4, PATIENCE = 120;  // steps of a drag that may wait for their drawing; ms after which one without a drawing counts no more
const LATE = 40;  // ms after which a number is shown without its drawing: the page is laid out and painted once for both

/**
 * The drag of a handle.  `place(handle, point)` is the pixel of a point in the frame of its body, `frame(handle)` the pose of that frame,
 * `others(handle)` the other handles with their pixels, `nearest(pixel)` {button, handleOf} of the one under a hand, `nameOf(handle)` its name, `numbers(handle)` the numbers of its keys.
 */
export function createDrag({layer, guides, bubble, place, frame, others, nearest, nameOf, numbers, view, undrawn, say, t, clock}) {
  const nudges = createGesture("nudge");
  let hold = null, pointed = null, box = null, pending = 0, fading = 0, late = 0, bubbleSize = {length: 0, wide: 0, high: 0};
  let unanswered = 0, asked = -Infinity;  // steps of which the server has said nothing yet; when the last one was sent
  let nudged = null;  // {button, handleOf, start, now, gesture, seen} of the last arrow key

  function attach(button, handleOf) {
    button.addEventListener("pointerdown", event => { if (event.button === 0) press(event, nearest(pixel(event))); });
    button.addEventListener("keydown", event => keys(event, button, handleOf));
    for (const name of ["pointerenter", "pointermove"]) button.addEventListener(name, event => { if (event.pointerType === "mouse" && !hold) point(nearest(pixel(event))); });
    button.addEventListener("pointerleave", () => point(null));
    button.addEventListener("blur", () => { if (nudged?.button === button) settle(); });
    button.addEventListener("dblclick", event => event.stopPropagation());
  }

  /** Says what the handle under the mouse is called, with its numbers. */
  function point(near) {
    if (near?.button === pointed?.button) return;
    pointed?.button.classList.remove("is-pointed");
    pointed = near;
    pointed?.button.classList.add("is-pointed");
    show();
  }

  // ---- pointer
  function press(event, {button, handleOf}) {
    event.preventDefault(); event.stopPropagation();
    if (hold || button.disabled) return;  // another finger has it, or it is locked
    if (clock.playing) { clock.set(0); clock.pause(); }
    const handle = handleOf(), start = numbers(handle);
    if (!start) return;
    button.focus({preventScroll: true});
    button.setPointerCapture(event.pointerId);
    const area = layer.getBoundingClientRect(), at = pixel(event, area), own = place(handle, handle.point);
    settle();
    hold = {button, handleOf, start, area, pointer: event.pointerId, grip: [at[0] - own[0], at[1] - own[1]], at, travelled: 0, gesture: createGesture(handle.key).current(), now: start.map(n => n.value)};
    button.classList.add("is-held");
    for (const [name, act] of Object.entries(WHILE_HELD)) button.addEventListener(name, act);
    addEventListener("pointerdown", pinch, {capture: true});
    show();
  }
  /** A second finger means the view and not the handle: what was dragged goes back, and both fingers go to the canvas. */
  function pinch(event) {
    if (!hold || event.pointerId === hold.pointer) return;
    const canvas = layer.parentElement.querySelector(".dw-canvas"), {left, top} = layer.getBoundingClientRect(), {pointer, last, at, travelled} = hold, [x, y] = last || at;
    event.preventDefault(); event.stopPropagation();
    if (travelled < SHAKE) end(); else takeBack();
    for (const [pointerId, clientX, clientY] of [[pointer, left + x, top + y], [event.pointerId, event.clientX, event.clientY]])
      canvas.dispatchEvent(new PointerEvent("pointerdown", {pointerId, clientX, clientY, pointerType: event.pointerType, bubbles: true}));
  }
  function move(event) {
    if (!hold) return;
    const at = pixel(event, hold.area);
    hold.travelled = Math.max(hold.travelled, Math.hypot(at[0] - hold.at[0], at[1] - hold.at[1]));
    if (hold.travelled < SHAKE) return;
    Object.assign(hold, {last: at, free: event.altKey});
    if (!pending) pending = requestAnimationFrame(follow);  // once a frame, however many moves the mouse tells
  }
  /** The newest place of the hand, as soon as its drawing would not have to wait: what is drawn late is not worth computing. */
  function follow() {
    pending = 0;
    if (!hold?.last) return;
    if (behind() >= AHEAD && performance.now() - asked < PATIENCE) { pending = requestAnimationFrame(follow); return; }
    const wanted = [hold.last[0] - hold.grip[0], hold.last[1] - hold.grip[1]], handle = hold.handleOf();
    const values = handle.direction ? along(handle, wanted) : freely(handle, wanted);
    send(values);
  }
  /** Steps on their way to a drawing: to the server, and from there to the page. */
  const behind = () => unanswered + undrawn();
  /** The server has taken a step. */
  function answered() { unanswered = Math.max(0, unanswered - 1); }
  /** A drawing has come.  Steps that the server took together have one answer: those that it has not told of are few by now. */
  function drawn() { if (!undrawn()) unanswered = Math.min(1, unanswered); }
  function release() {
    if (!hold) return;
    if (pending) { cancelAnimationFrame(pending); asked = -Infinity; follow(); }
    const {button, handleOf, travelled} = hold;
    end();
    if (travelled < SHAKE) type(button, handleOf);
  }
  function end() {
    if (!hold) return;
    const {button} = hold;
    hold = null;
    cancelAnimationFrame(pending); clearTimeout(late); pending = late = 0;
    for (const [name, act] of Object.entries(WHILE_HELD)) button.removeEventListener(name, act);
    removeEventListener("pointerdown", pinch, {capture: true});
    button.classList.remove("is-held");
    guides.replaceChildren();
    bubble.hidden = true;
  }
  const WHILE_HELD = {pointermove: move, pointerup: release, pointercancel: release, lostpointercapture: release};
  const pixel = (event, {left, top} = layer.getBoundingClientRect()) => [event.clientX - left, event.clientY - top];

  /** A point in the frame of the handle's body [m] that is seen at a pixel. */
  function inFrame(handle, [x, y]) {
    const seen = view(), [px, py, angle] = frame(handle), c = Math.cos(angle), s = Math.sin(angle);
    const [mx, my] = seen.middle(), dx = (x - seen.width / 2) / seen.scale + mx - px, dy = (seen.height / 2 - y) / seen.scale + my - py;
    return [c * dx + s * dy, c * dy - s * dx];
  }
  function gridOf({factor, whole}, fine = FINE) {
    const step = hold?.free ? 0 : nice(fine * 2.5 / view().scale / factor) / 2;
    return whole ? 1 : step;
  }

  /** Both components of a point. */
  function freely(handle, wanted) {
    const near = others(handle), partners = near.filter(({body}) => body === handle.body).map(({at}) => at);
    const fixed = near.filter(({body, at, direction}) => !direction && body !== handle.body && !coincides(at, handle)).map(({at}) => at);
    const found = hold.free ? {at: wanted, guides: [], words: ""} : snapped(wanted, {fixed, partners, lengths: lengthsOf(near)});
    mark(found);
    const exact = inFrame(handle, found.at), snaps = found.words !== "" || found.guides.length > 0;
    return hold.start.map((number, n) => {
      const value = exact[n] / number.factor, step = gridOf(number);
      return kept(snaps ? tidy(value, step) : onGrid(value, step), number);
    });
  }
  const coincides = (at, handle) => { const own = place(handle, handle.point); return Math.hypot(at[0] - own[0], at[1] - own[1]) < 1; };

  /** One number: how far the hand went along the handle's direction. */
  function along(handle, wanted) {
    const [number] = hold.start, to = inFrame(handle, wanted), [dx, dy] = handle.direction, size = dx * dx + dy * dy;
    const ahead = ((to[0] - handle.point[0]) * dx + (to[1] - handle.point[1]) * dy) / size;
    mark({guides: [], words: ""});
    return [kept(onGrid((handle.value + ahead) / number.factor, gridOf(number)), number)];  // the drawing and its own number belong together
  }

  // ---- what is told
  function send(values) {
    if (values.every((value, n) => value === hold.now[n]) || !values.every(Number.isFinite)) { show(); return; }
    hold.now = values;
    unanswered = performance.now() - asked < PATIENCE ? unanswered + 1 : 1;
    asked = performance.now();
    say({what: "drag", changes: texts(hold.start, values), gesture: hold.gesture});
    late ||= setTimeout(show, LATE);
  }
  const texts = (start, values) => Object.fromEntries(start.map(({key, unit}, n) => [key, unit ? `${values[n]} ${unit}` : String(values[n])]));
  function show() {
    clearTimeout(late); late = 0;
    const shown = hold || (nudged?.seen ? nudged : pointed), handle = shown?.handleOf(), start = handle && (shown.start || numbers(handle));
    if (!start || shown.button.hidden) { bubble.hidden = true; return; }
    const [x, y] = place(handle, handle.point), names = handle.direction ? [""] : ["x ", "y "], now = shown.now || start.map(({value}) => value);
    const words = hold?.words ? ` · ${t(hold.words)}` : "";
    tell(`${nameOf(handle)}  ${now.map((value, n) => `${names[n]}${value} ${start[n].unit}`.trim()).join("  ")}${words}`);
    const {wide, high} = bubbleSize, {width, height} = view(), left = x + 16 + wide > width ? x - 16 - wide : x + 16;
    bubble.style.transform = `translate(${within(left, width - wide)}px, ${within(y - 34, height - high)}px)`;
  }
  /** The text of the bubble, which a screen reader says; it is measured when it gets longer only, for that has the whole page laid out. */
  function tell(text) {
    const anew = bubble.hidden || text.length > bubbleSize.length;
    bubble.hidden = false;
    put(bubble, text);
    if (anew) bubbleSize = {length: text.length, wide: bubble.offsetWidth, high: bubble.offsetHeight};
  }
  function mark({guides: lines, words}) {
    hold.words = words;
    guides.replaceChildren(...lines.map(([[x1, y1], [x2, y2]]) => svgPart("line", {x1, y1, x2, y2})));
  }
  function takeBack() { const {gesture} = hold; end(); say({what: "revert", gesture}); }

  // ---- keys and typing
  function keys(event, button, handleOf) {
    const step = {ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
    if (event.key === "Escape" && (hold || nudged?.button === button)) { event.preventDefault(); event.stopPropagation(); if (hold) takeBack(); else unnudge(); return; }
    if (event.key === "Enter" || /^[-\d.]$/.test(event.key) && !event.ctrlKey && !event.metaKey) {
      event.preventDefault(); event.stopPropagation();
      const drag = hold;
      end();
      type(button, handleOf, event.key === "Enter" ? null : event.key, drag?.gesture);
    } else if (step) {
      event.preventDefault(); event.stopPropagation();
      nudge(button, handleOf, step, event.shiftKey ? 10 : 1);
    }
  }
  /** An arrow key: the numbers go a step on, from where the key before it sent them.  As long as they are shown it is one gesture. */
  function nudge(button, handleOf, [x, y], times) {
    const handle = handleOf(), start = numbers(handle);
    if (!start) return;
    if (clock.playing) { clock.set(0); clock.pause(); }
    if (nudged?.button !== button) { settle(); nudges.end(); }
    const gesture = nudges.current(), from = nudged?.gesture === gesture ? nudged.now : start.map(({value}) => value);
    const moves = handle.direction ? [x + y] : [x, y], now = start.map((number, n) => {
      const step = gridOf(number, COARSE);
      return moves[n] ? kept(onGrid(from[n] + moves[n] * times * step, step), number) : from[n];
    });
    nudged = {button, handleOf, start, now, gesture, seen: true};
    say({what: "drag", changes: texts(start, now), gesture});
    show();
    clearTimeout(fading);
    fading = setTimeout(() => { nudges.end(); nudged.seen = false; show(); }, SEEN);
  }
  /** Esc behind arrow keys: their steps are taken back. */
  function unnudge() { say({what: "revert", gesture: nudged.gesture}); settle(); nudges.end(); }
  function settle() { clearTimeout(fading); nudged = null; show(); }
  /** A box beside the handle for its numbers: "40 mm" or "40, 12 mm". */
  function type(button, handleOf, first = null, gesture = "") {
    const handle = handleOf(), start = numbers(handle);
    if (!start) return;
    box?.remove();
    const own = element("input", {type: "text", class: "hd-box", "data-testid": `handle-box-${handle.key}`, autocomplete: "off",
      "aria-label": nameOf(handle)});
    box = own;
    own.value = first ?? `${start.map(({value}) => value).join(", ")} ${start[0].unit}`;
    const [x, y] = place(handle, handle.point);
    own.style.transform = `translate(${within(x + 14, layer.clientWidth - 146)}px, ${within(y - 38, layer.clientHeight - 30)}px)`;
    layer.append(own);
    own.focus();
    if (first === null) own.select();
    let done = false;
    const finish = take => {
      if (done) return;
      done = true;
      const parts = own.value.split(",").map(part => quantityOf(part)), unit = parts.at(-1)?.[1];
      if (take && parts.length === start.length && parts.every(Boolean)) {
        const changes = Object.fromEntries(start.map(({key, unit: usual}, n) => [key, `${parts[n][0]} ${parts[n][1] || unit || usual}`.trim()]));
        say({what: "drag", changes, gesture: gesture || createGesture(handle.key).current()});
      }
      own.remove();
      if (box === own) box = null;
      button.focus({preventScroll: true});
    };
    own.addEventListener("keydown", event => {
      event.stopPropagation();
      if (event.key === "Enter" || event.key === "Escape") { event.preventDefault(); finish(event.key === "Enter"); }
    });
    own.addEventListener("blur", () => finish(true));
  }

  /** Whether a hand holds a handle, or that of a button. */
  const held = button => hold !== null && (!button || hold.button === button);
  return {attach, held, end, answered, drawn, draw: show, destroy() { end(); settle(); box?.remove(); }};
}

/** Lengths in pixels between neighbouring handles of every body. */
function lengthsOf(handles) {
  const bodies = new Map();
  for (const {body, at} of handles) bodies.set(body, [...bodies.get(body) || [], at]);
  return [...bodies.values()].flatMap(points => points.slice(1).map(([x, y], n) => Math.hypot(x - points[n][0], y - points[n][1])));
}

/** A place [px] that keeps 4 px from both ends. */
const within = (place, most) => Math.max(4, Math.min(place, most - 4));

/** A number within the limits of its field. */
const kept = (value, {low, high}) => Math.min(Math.max(value, low ?? -Infinity), high ?? Infinity);

/** A number without rounding, as short as the grid's hundredth allows. */
const tidy = (value, step) => onGrid(value, step ? step / 100 : 0);
