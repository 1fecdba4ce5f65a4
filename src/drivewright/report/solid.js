// A small viewer of solids: triangles with normals, feature edges, orbit, pan and zoom.  Nothing is drawn while nothing changes.

import { matrixAt, pullsOf, reachOf, unpackMotion, unpackParts } from "./assembly.js";
import { createCube } from "./cube.js";
import { element, fixed, nice, pressable, same, watchTheme } from "./clock.js";
import { createPacing } from "./pacing.js";
import { firstHit, takenBack } from "./picking.js";
import { AT_START, createRenderer } from "./triangles.js";

const VIEWS = {iso: [0.62, 0.5], front: [0, 0], top: [0, Math.PI / 2], side: [Math.PI / 2, 0], back: [Math.PI, 0], bottom: [0, -Math.PI / 2],
  left: [-Math.PI / 2, 0]};
const SHOWN = ["iso", "front", "top", "side", "fit"];  // views with a button of their own; the others by the cube
const CLEAR = 1e-5;  // of the size: a section lies so far beyond a face in its plane, or rounding would cut that into stripes
const DEPTH = 0.6;  // half the depth that is seen, in sizes of the whole

const plain = name => name.replace(/[._\s]+/g, "_");  // checks say cam.main, solids cam_main

/** Rotation of the view as rows: right, up, towards the eye; turned about y first, then tilted. */
function axesOf(turn, tilt) {
  const c = Math.cos(turn), s = Math.sin(turn), ct = Math.cos(tilt), st = Math.sin(tilt);
  return [[c, 0, -s], [-s * st, ct, -c * st], [s * ct, st, c * ct]];
}

/** Middle and size (diagonal) of everything. */
function extent(parts) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const {points} of parts) for (let i = 0; i < points.length; i++) {
    if (points[i] < low[i % 3]) low[i % 3] = points[i];
    if (points[i] > high[i % 3]) high[i % 3] = points[i];
  }
  return {low, high, centre: low.map((l, k) => (l + high[k]) / 2), size: Math.hypot(...low.map((l, k) => high[k] - l)) || 1};
}

/**
 * The viewer inside `host`; load({parts}) of packed parts, show(parts) of {name, label, colour, points, normals, edges, levels} as arrays,
 * setRamp(stops, bare) for parts with levels, hide(names) before they are shown, cut([axis, part of the way along it] | null), highlight(names),
 * at(phase) of the cycle, explode(part of the way), moving (whether anything moves), drawn (how often it was drawn), destroy().  aside: px at the right that something else covers; toggled(hidden) is called when a part was hidden or shown.
 */
export function createSolid(host, {t, aside = 0, toggled = () => {}}) {
  const canvas = element("canvas", {class: "so-canvas", tabindex: 0, role: "img",
    "aria-label": t("Solid parts: drag turns, right drag moves, wheel zooms, arrow keys turn, f fits")});
  const overlay = element("canvas", {class: "so-overlay", "aria-hidden": "true"});
  const legend = element("div", {class: "dw-legend so-legend"}), tools = element("div", {class: "dw-segments so-tools"});
  const view = {turn: VIEWS.iso[0], tilt: VIEWS.iso[1], scale: 1, fitted: true, shift: [-aside / 2, 0], width: 0, height: 0, ratio: 1};
  const look = {hidden: new Set(), lit: new Set(), section: null};  // names of parts; section: [axis, part of the way along it]
  const state = {parts: [], whole: {low: [0, 0, 0], high: [1, 1, 1], centre: [0, 0, 0], size: 1}, frame: 0, moving: null, phase: 0, pulls: [], apart: 0, drawn: 0};
  const tip = element("div", {class: "so-tip", hidden: "", "data-testid": "solid-name"}), named = ({name, label}) => t(label || name.replaceAll("_", " "));
  const renderer = createRenderer(canvas), theme = watchTheme(host, () => redraw()), pacing = createPacing(() => redraw());
  host.classList.add("so");
  if (!renderer) {
    const words = t("This browser has no WebGL, so solids cannot be shown. STEP and STL can still be exported.");
    host.replaceChildren(element("p", {class: "vw-empty"}, words));
    return {load() {}, show() {}, at() {}, explode() {}, moving: false, drawn: 0, hide: names => new Set(names), cut() {}, setRamp() {}, highlight() {}, destroy() { theme.stop(); host.replaceChildren(); }};
  }
  const cube = createCube(name => from(name), t);
  host.replaceChildren(canvas, overlay, legend, tools, cube.node, tip);

  const observer = new ResizeObserver(() => {
    Object.assign(view, {width: host.clientWidth, height: host.clientHeight, ratio: window.devicePixelRatio || 1});
    for (const one of [canvas, overlay]) { one.width = Math.round(view.width * view.ratio); one.height = Math.round(view.height * view.ratio); }
    draw();
  });
  observer.observe(host);

  function redraw() { state.frame ||= requestAnimationFrame(draw); }
  /** Scale at which the whole fills the window from this side. */
  function fitting() {
    const {low, high, centre} = state.whole, axes = axesOf(view.turn, view.tilt), reach = [0, 0];
    for (let corner = 0; corner < 8; corner++) [0, 1].forEach(k => {
      const at = axes[k].reduce((sum, a, i) => sum + a * ((corner >> i & 1 ? high[i] : low[i]) - centre[i]), 0);
      reach[k] = Math.max(reach[k], Math.abs(at));
    });
    return Math.min(0.84 * Math.max(view.width - aside, 100) / 2 / (reach[0] || 1e-9), 0.74 * view.height / 2 / (reach[1] || 1e-9));
  }
  function draw() {
    cancelAnimationFrame(state.frame);
    state.frame = 0;
    if (view.width < 2) return;
    if (view.fitted) view.scale = fitting();
    const axes = axesOf(view.turn, view.tilt);
    renderer.move(places());
    state.drawn++;
    host.dataset.drawn = state.drawn;
    const smooth = pacing.smooth(performance.now());
    host.dataset.smooth = smooth;
    renderer.paint(placing(axes), theme.colours, {hidden: look.hidden, faint: faintness(), cut: cutPlane(), smooth});
    annotate(axes, view.scale);
  }
  /** Where each part stands at the phase, pulled out as far as wanted. */
  function places() {
    if (!state.moving && !state.apart) return [];
    return state.parts.map((part, n) => matrixAt(state.moving, part, state.phase, (state.pulls[n] || [0, 0, 0]).map(pull => state.apart * pull)));
  }
  /** Matrices from the parts' space to the window's, column by column. */
  function placing(axes) {
    const {centre, size} = state.whole, px = view.scale;
    const [sx, sy, sz] = [2 * px / view.width, 2 * px / view.height, -1 / (DEPTH * size)];
    const at = axes.map(row => -row.reduce((sum, a, k) => sum + a * centre[k], 0));
    const matrix = [];
    for (let k = 0; k < 3; k++) matrix.push(sx * axes[0][k], sy * axes[1][k], sz * axes[2][k], 0);
    matrix.push(sx * at[0] + 2 * view.shift[0] / view.width, sy * at[1] + 2 * view.shift[1] / view.height, sz * at[2], 1);
    return {matrix: new Float32Array(matrix), turn: new Float32Array([0, 1, 2].flatMap(k => axes.map(row => row[k])))};
  }
  /** The plane of the section [normal, distance], beyond which nothing is drawn; null without one. */
  function cutPlane() {
    if (!look.section) return null;
    const [axis, part] = look.section, {low, high, size} = state.whole;
    return [...[0, 1, 2].map(k => Number(k === axis)), low[axis] + part * (high[axis] - low[axis]) + CLEAR * size];
  }
  /** Whether a part is faint, because others are lit. */
  function faintness() {
    const isLit = ({name}) => look.lit.has(plain(name)), some = state.parts.some(part => !look.hidden.has(part.name) && isLit(part));
    return part => some && !isLit(part);
  }

  /** The name of the part under the pointer, beside it. */
  function hover(x, y) {
    const part = partAt(x, y);
    tip.hidden = !part;
    if (!part) return;
    tip.textContent = named(part);
    tip.style.transform = `translate(${Math.min(x + 14, view.width - tip.offsetWidth - 4)}px, ${Math.max(y - 10 - tip.offsetHeight, 4)}px)`;
  }
  /** The part that is seen at a place of the window, null where there is none; what a section has taken away is not seen. */
  function partAt(x, y) {
    const axes = axesOf(view.turn, view.tilt), {centre, size} = state.whole, cut = cutPlane(), places_ = places();
    const across = [(x - view.width / 2 - view.shift[0]) / view.scale, (view.height / 2 - y - view.shift[1]) / view.scale];
    const eye = centre.map((at, k) => at + across[0] * axes[0][k] + across[1] * axes[1][k] + size * axes[2][k]), ray = axes[2].map(part => -part);
    let found = null, nearest = Infinity;
    state.parts.forEach((part, n) => {
      if (look.hidden.has(part.name)) return;
      const m = places_[n] || AT_START, begin = cut ? beyond(cut, eye, ray) : 0;
      const from = eye.map((at, k) => at + begin * ray[k]), far = begin + firstHit(part, takenBack(m, from), takenBack(m, ray, true));
      if (far < nearest && !(cut && isCutAway(cut, eye, ray, far))) { nearest = far; found = part; }
    });
    return found;
  }
  /** How far along a ray the half-space beyond a plane of section ends; 0 where it begins outside. */
  function beyond([a, b, c, d], eye, ray) {
    const slope = a * ray[0] + b * ray[1] + c * ray[2], above = a * eye[0] + b * eye[1] + c * eye[2] - d;
    return above > 0 && slope < 0 ? above / -slope : 0;
  }
  function isCutAway([a, b, c, d], eye, ray, far) {
    return a * (eye[0] + far * ray[0]) + b * (eye[1] + far * ray[1]) + c * (eye[2] + far * ray[2]) > d + 1e-9;
  }

  /** Triad and scale bar. */
  function annotate(axes, px) {
    const context = overlay.getContext("2d");
    context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    context.clearRect(0, 0, view.width, view.height);
    triad(context, axes, view.width - 52, view.height - 50);
    cube.turn(axes);
    scaleBar(context, px, 16, view.height - 16);
  }
  function triad(context, axes, x0, y0) {
    const colours = ["orange", "green", "blue"].map(role => theme.colours[role]);
    const arms = [0, 1, 2].map(k => ({name: "xyz"[k], colour: colours[k], x: axes[0][k], y: axes[1][k], z: axes[2][k]})).sort((a, b) => a.z - b.z);
    context.font = "600 11px system-ui, sans-serif"; context.textAlign = "center"; context.textBaseline = "middle";
    context.lineWidth = 2; context.lineCap = "round";
    for (const arm of arms) {
      context.strokeStyle = context.fillStyle = arm.colour; context.globalAlpha = arm.z < -0.1 ? 0.55 : 1;
      context.beginPath(); context.moveTo(x0, y0); context.lineTo(x0 + 26 * arm.x, y0 - 26 * arm.y); context.stroke();
      if (Math.hypot(arm.x, arm.y) > 0.2) context.fillText(arm.name, x0 + 36 * arm.x, y0 - 36 * arm.y);
    }
    context.globalAlpha = 1;
  }
  function scaleBar(context, px, x, y) {
    const length = nice(150 / px), wide = length * px, mm = length * 1e3;
    context.strokeStyle = context.fillStyle = theme.colours.muted; context.lineWidth = 1.5;
    context.textAlign = "left"; context.font = "11px system-ui, sans-serif";
    context.beginPath();
    context.moveTo(x, y - 6); context.lineTo(x, y); context.lineTo(x + wide, y); context.lineTo(x + wide, y - 6);
    context.stroke();
    context.fillText(mm >= 1000 ? `${fixed(mm / 1000, 0)} m` : `${fixed(mm, mm < 1 ? 2 : 0)} mm`, x, y - 14);
  }

  /** Turning keeps the scale; only fitting changes it. */
  function turn(across, up) {
    view.fitted = false;
    view.turn -= across; view.tilt = Math.min(Math.max(view.tilt + up, -Math.PI / 2), Math.PI / 2);
    mark(); redraw();
  }
  function zoom(factor, x = view.width / 2, y = view.height / 2) {
    const least = 0.2 * fitting(), to = Math.min(Math.max(view.scale * factor, least), 1000 * least), change = to / view.scale;
    const dx = x - view.width / 2, dy = view.height / 2 - y;
    view.shift = [dx + (view.shift[0] - dx) * change, dy + (view.shift[1] - dy) * change];
    view.scale = to; view.fitted = false;
    redraw();
  }
  function move(x, y) { view.fitted = false; view.shift = [view.shift[0] + x, view.shift[1] - y]; redraw(); }
  function fit() { Object.assign(view, {fitted: true, shift: [-aside / 2, 0]}); redraw(); }
  function from(name) { [view.turn, view.tilt] = VIEWS[name]; fit(); mark(name); }
  function mark(name) { for (const [key, made] of buttons) made.setAttribute("aria-pressed", String(key === name)); }

  const names = {iso: t("Oblique"), front: t("Front"), top: t("Top"), side: t("Side"), fit: t("Fit")};
  const buttons = new Map(SHOWN.map(key => [key, pressable({"aria-pressed": "false"}, () => key === "fit" ? fit() : from(key), names[key])]));
  tools.append(...buttons.values());
  mark("iso");

  function keys(event) {
    const step = event.shiftKey ? 24 : 0.12, go = (x, y) => event.shiftKey ? move(step * x, -step * y) : turn(step * x, step * y);
    const acts = {ArrowLeft: () => go(-1, 0), ArrowRight: () => go(1, 0), ArrowUp: () => go(0, 1), ArrowDown: () => go(0, -1),
      "+": () => zoom(1.25), "=": () => zoom(1.25), "-": () => zoom(0.8), f: fit};
    if (!acts[event.key] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    acts[event.key]();
  }
  let held = null;
  canvas.addEventListener("pointerdown", event => {
    held = [event.clientX, event.clientY, event.button || event.shiftKey];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", event => {
    if (!held) return;
    const [x, y, pans] = held, dx = event.clientX - x, dy = event.clientY - y;
    held = [event.clientX, event.clientY, pans];
    pans ? move(dx, dy) : turn(dx * 0.008, dy * 0.008);
  });
  canvas.addEventListener("pointermove", event => { if (!held && event.pointerType !== "touch") hover(event.offsetX, event.offsetY); });
  for (const name of ["pointerleave", "pointerdown"]) canvas.addEventListener(name, () => { tip.hidden = true; });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => { held = null; });
  canvas.addEventListener("contextmenu", event => event.preventDefault());
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    zoom(Math.exp(-event.deltaY * 0.0015), event.offsetX, event.offsetY);
  }, {passive: false});
  canvas.addEventListener("keydown", keys);
  canvas.addEventListener("dblclick", fit);
  canvas.addEventListener("webglcontextlost", event => event.preventDefault());
  canvas.addEventListener("webglcontextrestored", () => { renderer.ready(); redraw(); });

  function chips() {
    legend.replaceChildren(...state.parts.filter(({again}) => !again).map(({name, label, colour}) => {
      const looks = {class: "dw-chip", "aria-pressed": String(!look.hidden.has(name)), style: `--chip: var(--${colour}, var(--steel))`};
      return pressable(looks, chip => {
        if (!look.hidden.delete(name)) look.hidden.add(name);
        chip.setAttribute("aria-pressed", String(!look.hidden.has(name)));
        redraw();
        toggled(look.hidden);
      }, named({name, label}));
    }));
  }

  function show(parts) {
    const had = state.whole.size, before = state.parts.map(part => part.name);
    const seen = parts.filter(part => !look.hidden.has(part.name));
    state.parts = parts;
    state.whole = reachOf(parts, state.moving, extent(seen.length ? seen : parts));
    state.pulls = pullsOf(parts, state.moving, state.whole);
    if (Math.abs(state.whole.size / had - 1) > 0.5) fit();
    renderer.load(state.parts);
    if (!same(before, parts.map(part => part.name))) chips();
    redraw();
  }

  return {
    load(answer) {
      state.moving = unpackMotion(answer);
      show(unpackParts(answer));
    },
    show,
    get moving() { return Boolean(state.moving); },
    get drawn() { return state.drawn; },
    at(phase) { if (state.moving && phase !== state.phase) { state.phase = phase; tip.hidden = true; redraw(); } },
    explode(part) { state.apart = part; redraw(); },
    hide(names) { look.hidden = new Set(names); return look.hidden; },
    cut(section) { look.section = section; redraw(); },
    setRamp(stops, bare) { renderer.setRamp(stops, bare); redraw(); },
    highlight(list) { look.lit = new Set(list.map(plain)); redraw(); },
    destroy() { observer.disconnect(); theme.stop(); pacing.stop(); cancelAnimationFrame(state.frame); renderer.close(); host.replaceChildren(); },
  };
}
