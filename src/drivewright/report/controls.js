// The player's controls: buttons, sliders, choices, and what is read off beside them.

import { element, fixed, put, putAttribute } from "./clock.js";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];
export const MOST = 3;  // largest exaggeration over the drawn one
export const TEXT = {play: "Play (space)", pause: "Pause (space)", ghosts: "Ghost poses (g)", traces: "Paths of points (t)", fit: "Fit (f)", speed: "Speed",
  real: "real time", slower: "slow motion", faster: "fast motion", scrub: "Position in the cycle", frame: "Seen from",
  exaggeration: "Exaggeration", shown: "Bodies that are shown", drawn: "Play and deflection, enlarged; double click: as designed for the drawing",
  canvas: "Moving mechanism: space plays, arrow keys step, drag moves, wheel zooms"};
const ICONS = {play: "M7 4.5v15l12-7.5z", pause: "M6 5h4v14H6zM14 5h4v14h-4z", traces: "M4 17c2-14 7-14 8-5s6 7 8-6M4 17h.01",
  fit: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5", ghosts: "M5 20V10a7 7 0 0 1 14 0v10l-3-2.5-2 2.5-2-2.5-2 2.5-2-2.5z"};

export function icon(name) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg"), path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  svg.setAttribute("viewBox", "0 0 24 24"); svg.setAttribute("aria-hidden", "true");
  svg.classList.add(name === "play" || name === "pause" ? "dw-solid" : "dw-stroke");
  path.setAttribute("d", ICONS[name]); svg.append(path);
  return svg;
}

export function button(text, act, name) {
  const made = element("button", {type: "button", title: text, "aria-label": text, class: "dw-button"}, icon(name));
  made.addEventListener("click", act);
  return made;
}

export const press = (made, on) => putAttribute(made, "aria-pressed", on);

/** Row of choices, one pressed: [[key, label], ...] -> {node, choose(key)}. */
export function segments(title, choices, picked) {
  const node = element("div", {class: "dw-segments", role: "group", "aria-label": title});
  const buttons = choices.map(([key, label]) => {
    const made = element("button", {type: "button", "data-key": key, "aria-pressed": "false"}, label);
    made.addEventListener("click", () => picked(key));
    node.append(made);
    return made;
  });
  return {node, choose(key) { for (const b of buttons) press(b, b.dataset.key === String(key)); }};
}

/** The marks of a cycle, [[u, label], ...], by their label: one may overtake another while a design changes. */
export const byLabel = ({marks}) => [...marks].sort(([u, one], [v, other]) => one === other ? u - v : one < other ? -1 : 1);

/** Slider over the cycle with a tick for every mark; `follow(cycle)` puts the same marks where they are in another cycle. */
export function scrubber(clock, cycle, text) {
  const input = element("input", {type: "range", min: 0, max: 1, step: 0.0001, value: 0, "aria-label": text(TEXT.scrub), class: "dw-range"});
  let marks = byLabel(cycle);
  const ticks = marks.map(([, label], n) => {
    const tick = element("button", {type: "button", class: "dw-mark", title: text(label), "aria-label": text(label), tabindex: -1});
    tick.addEventListener("click", () => clock.set(marks[n][0]));
    return tick;
  });
  const node = element("div", {class: "dw-scrub"}, input, ...ticks);
  input.addEventListener("input", () => {
    const wanted = +input.value;  // pausing shows the old phase in the slider
    clock.pause();
    clock.set(wanted);
  });
  let shown = null;
  function show(phase) {
    if (phase === shown) return;
    shown = input.value = phase;
    input.style.setProperty("--part", phase);
  }
  function follow(next) {
    marks = byLabel(next);
    ticks.forEach((tick, n) => tick.style.setProperty("--u", marks[n][0]));
  }
  follow(cycle);
  return {node, show, follow};
}

/** Choice of speed; "real time" stays chosen when a change of the design changes the period. */
export function speedBox(clock, text) {
  const node = element("select", {class: "dw-speed", "aria-label": text(TEXT.speed), title: text(TEXT.speed)}), real = element("option", {}, text(TEXT.real));
  for (const speed of SPEEDS) node.append(element("option", {value: speed}, `${speed}×`));
  node.addEventListener("change", () => clock.setSpeed(+node.value));
  return {node, follow(period) {
    const chosen = real.isConnected && real.selected;
    if (!period) real.remove(); else if (!real.parentNode) node.append(real);
    putAttribute(real, "value", period ? clock.duration / period : "");
    if (chosen || !SPEEDS.includes(clock.speed)) clock.speed = period ? clock.duration / period : 1;
    if (chosen && period) real.selected = true; else node.value = String(clock.speed);
  }};
}

/** Slider for how far bodies stand from their rest: 0 not at all, 1 as drawn, `most` at most. */
export function exaggerator(most, text, changed) {
  const input = element("input", {type: "range", min: 0, max: most, step: 0.05, class: "dw-range", "aria-label": text(TEXT.exaggeration)});
  const factor = element("span", {class: "dw-factor"});
  const node = element("label", {class: "dw-exaggeration", title: text(TEXT.drawn)}, element("span", {}, text(TEXT.exaggeration), " ", factor), input);
  input.addEventListener("input", () => changed(+input.value));
  input.addEventListener("dblclick", () => changed(1));
  return {node, show(scale, magnified) {
    input.value = scale; input.style.setProperty("--part", scale / most);
    put(factor, times(magnified));
  }};
}

export const times = factor => `× ${+factor.toPrecision(3)}`;

/** How many times larger than real a body's play or deflection is drawn. */
export const magnifiedBy = (body, scale) => Math.min(scale, body.most) * body.magnified;

/** How much slower or faster than the machine itself: "13× slow motion". */
export function pace(clock, period, text) {
  if (!period) return "";
  const factor = period * clock.speed / clock.duration, ratio = factor < 1 ? 1 / factor : factor, shown = ratio < 10 ? +ratio.toFixed(1) : Math.round(ratio);
  return shown === 1 ? text(TEXT.real) : `${shown}× ${text(factor < 1 ? TEXT.slower : TEXT.faster)}`;
}

/** The last mark and how far behind it the cycle is: "lowest + 12.5°". */
export function sinceMark({marks, span, unit}, phase, digits, text) {
  if (!marks.length) return "";
  const [u, label] = marks.filter(([at]) => at <= phase + 1e-9).pop() || marks[marks.length - 1], gone = Math.abs((phase - u + 1 + 1e-9) % 1 * span);
  return `${text(label)} + ${fixed(gone, digits)}${unit.startsWith("°") ? unit : ` ${unit}`}`;
}
