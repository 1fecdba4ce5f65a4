// The motion player: one cycle of a mechanism on a canvas.  Plain ES2020, no build step; the report inlines it, a page may import it.
//
//   const clock = createClock({duration: 4});
//   const player = createPlayer(host, scene, {clock});      // scene: the dictionary of pack_scene
//
// Lengths arrive in metres, angles in radians, y up.  Colours are the custom properties --blue, --ink ... of the host's style.

import { createClock, element, fitCanvas, fixed, locate, put, putAttribute, watchTheme, watchVisible } from "./clock.js";
import { MOST, TEXT, button, byLabel, exaggerator, icon, magnifiedBy, pace, press, scrubber, segments, sinceMark, speedBox, times } from "./controls.js";
import { createPainter, createView, steer } from "./drawing.js";
import { STILL, boxOf, poseAt, poseOf, seenFrom, unpack } from "./scene.js";

const NAMED = 16;  // px above the drawing for names that stand upon it

export { createClock, element, fitCanvas, fixed, floats, locate, nice, pressable, put, putAttribute, putClass, same, useFont, watchTheme } from "./clock.js";

/**
 * A player inside `host`.  Options: clock (shared with plots; it outlives the player), autoplay, duration [s per cycle at speed 1],
 * text (English text -> text shown), picked (called with the name of a body that is clicked), drawn (called after each drawing),
 * held (whether a hand holds something, so that the view stays), sides (px left free beside the drawing, 0 for the usual),
 * tools (gives further elements for the end of the bar, asked at each new bar).
 * Returns {clock, view, stage, scene, frame, poseOf(body number, phase, real), shows(body number), load(scene), compare(scene | null), fit(), redraw(), setFrame(name), setGhosts(on), setTraces(on),
 * setExaggeration(scale), highlight(names), destroy()}.
 * What has been drawn can be read from the host: data-phase, data-frame, and data-gen where the scene has a `gen`.
 */
export function createPlayer(host, packed, options = {}) {
  const clock = options.clock || createClock({duration: options.duration || 4}), text = options.text || (english => english);
  const canvas = element("canvas", {class: "dw-canvas", tabindex: 0, role: "img"});
  const legend = element("div", {class: "dw-legend", role: "group"}), top = element("div", {class: "dw-top"}), bar = element("div", {class: "dw-bar"});
  const stage = element("div", {class: "dw-stage", "data-testid": "player"}, canvas, top);
  const view = createView(), switches = {ghosts: false, traces: true, hidden: new Set(), lit: new Set(), scale: 1};
  const state = {scene: null, painter: null, observer: null, reference: null, fitted: true, pending: 0, visible: true, controls: {}};
  host.classList.add("dw-player");
  host.replaceChildren(stage, bar);

  const surface = fitCanvas(canvas, () => {
    Object.assign(view, {width: surface.width, height: surface.height, ratio: surface.ratio});
    if (state.fitted && !options.held?.()) fit(); else draw();
  });
  const theme = watchTheme(host, () => redraw());
  const unwatch = watchVisible(canvas, visible => { state.visible = visible; clock.see(player, visible); redraw(); });
  steer(canvas, view, () => redraw(), () => { state.fitted = false; }, (x, y) => {
    const name = options.picked && state.painter.pick(surface.context, view, state.observer, clock, switches, x, y);
    if (name) options.picked(name);
  });

  function draw() {
    cancelAnimationFrame(state.pending);
    state.pending = 0;
    if (!state.scene || view.width < 2) return;
    state.painter.paint(surface.context, view, state.observer, clock, theme.colours, switches, state.reference);
    options.drawn?.();
    putAttribute(host, "data-phase", clock.phase.toFixed(4));
    if (state.scene.gen !== undefined) putAttribute(host, "data-gen", state.scene.gen);
  }
  function redraw() {
    if (!state.pending && state.visible) state.pending = requestAnimationFrame(draw);
  }

  /** Box around the scene and the one it is compared with, and the margins that the labels leave. */
  function sight() {
    const boxes = [state, state.reference].filter(Boolean).map(({painter, observer}) => painter.extent(observer, switches.scale));
    const ends = boxes.flatMap(([x0, y0, x1, y1]) => [x0, y0, x1, y1]), across = options.sides?.() || Math.min(34, view.width / 8);
    const named = state.scene.labels?.some(({above}) => above) ? NAMED : 0;
    return [boxOf(ends), {top: 26 + named + top.offsetHeight, right: across, bottom: 44, left: across}];
  }
  function fit() {
    state.fitted = true;
    if (!state.scene || view.width < 2) return;
    Object.assign(view, view.fitting(...sight()));
    redraw();
  }
  /** Fits anew where that is needed and the view is not the reader's own. */
  function keepInSight() { if (state.fitted && view.width > 1 && view.loses(...sight())) fit(); }

  const among = (observers, name) => observers.find(o => o.name === name) || observers[0];
  function setFrame(name) { observe(name); fit(); }
  function observe(name) {
    state.observer = among(state.scene.observers, name);
    if (state.reference) state.reference.observer = among(state.reference.scene.observers, state.observer.name);
    state.controls.frames.choose(state.observer.name);
    putAttribute(host, "data-frame", state.observer.name);
  }
  function setGhosts(on) { switches.ghosts = on; pressed(); }
  function setTraces(on) { switches.traces = on; pressed(); }
  function setExaggeration(scale) { switches.scale = scale; magnify(); redraw(); }
  function pressed() {
    press(state.controls.ghosts, switches.ghosts);
    press(state.controls.traces, switches.traces);
    redraw();
  }

  /** Shows the next state of a design, or another one: view, observer, hidden bodies and exaggeration stay as far as they can. */
  function load(next) {
    const first = !state.scene, before = state.observer && state.observer.name;
    state.scene = unpack(next, state.scene);
    state.painter = createPainter(state.scene);
    const wanted = wording();
    if (state.controls.wording !== wanted) state.controls = {...build(), wording: wanted};
    observe(before);
    state.controls.scrub.follow(state.scene.cycle);
    state.controls.speed.follow(state.scene.period);
    magnify();
    if (first || state.observer.name !== (before ?? state.observer.name)) fit(); else if (!options.held?.()) keepInSight();
    show();
  }

  /** Another scene, drawn grey behind this one; null for none. */
  function compare(other) {
    const scene = other && unpack(other, state.scene);
    state.reference = scene && {scene, painter: createPainter(scene), observer: among(scene.observers, state.observer.name)};
    keepInSight();
    redraw();
  }

  const moved = () => state.scene.bodies.filter(body => body.rest);
  const furthest = () => Math.min(MOST, Math.max(0, ...moved().map(body => body.most)));  // 0: nothing to exaggerate

  /** Everything that the controls say; where it is the same they stay. */
  function wording() {
    const {bodies, observers, cycle, traces} = state.scene;
    return JSON.stringify([bodies.map(b => [text(b.title), b.colour]), observers.map(o => [o.name, text(o.label)]), cycle.label, cycle.unit, byLabel(cycle).map(([, label]) => label),
      traces.length > 0, furthest(), text(TEXT.play)]);
  }

  function build() {
    const {cycle, observers, traces: paths} = state.scene, most = furthest();
    const play = button(text(TEXT.play), () => clock.toggle(), "play"), ghosts = button(text(TEXT.ghosts), () => setGhosts(!switches.ghosts), "ghosts");
    const traces = button(text(TEXT.traces), () => setTraces(!switches.traces), "traces");
    const scrub = scrubber(clock, cycle, text), speed = speedBox(clock, text), exaggeration = exaggerator(most, text, setExaggeration);
    const frames = segments(text(TEXT.frame), observers.map(o => [o.name, text(o.label)]), setFrame), chips = names();
    const value = element("span", {class: "dw-value", title: text(cycle.label)}), phase = element("span", {class: "dw-phase"}), rate = element("span", {class: "dw-rate"});
    canvas.setAttribute("aria-label", text(TEXT.canvas)); legend.setAttribute("aria-label", text(TEXT.shown));
    press(ghosts, switches.ghosts); press(traces, switches.traces);
    legend.replaceChildren(...chips.values());
    top.replaceChildren(legend, ...(observers.length > 1 ? [frames.node] : []));
    const focused = bar.contains(document.activeElement) ? document.activeElement : null;
    bar.replaceChildren(play, scrub.node, element("div", {class: "dw-readout"}, value, phase), element("div", {class: "dw-pace"}, speed.node, rate),
      ...(most ? [exaggeration.node] : []), ghosts, ...(paths.length ? [traces] : []), button(text(TEXT.fit), fit, "fit"), ...(options.tools?.() || []));
    if (focused?.isConnected) focused.focus();
    return {play, ghosts, traces, scrub, speed, exaggeration, frames, chips, value, phase, rate};
  }

  /** A switch for every title among the bodies, in the body's colour. */
  function names() {
    const seen = new Map(state.scene.bodies.map(body => [body.title, body.colour]));
    return new Map([...seen].map(([title, colour]) => {
      const chip = element("button", {type: "button", class: "dw-chip", style: `--chip: var(--${colour}, var(--steel))`}, text(title));
      press(chip, !switches.hidden.has(title));
      chip.addEventListener("click", () => {
        const gone = switches.hidden.delete(title) ? false : (switches.hidden.add(title), true);
        press(chip, !gone);
        redraw();
      });
      return [title, chip];
    }));
  }

  /** Tells how far bodies are exaggerated: on the slider the most, on a chip whose label has a factor its own. */
  function magnify() {
    const most = furthest(), scale = Math.min(switches.scale, most), found = new Map();
    for (const body of moved()) if (body.title !== body.label) found.set(body.title, [...found.get(body.title) || [], magnifiedBy(body, scale)]);
    for (const [title, factors] of found) {
      const [low, high] = [Math.min(...factors), Math.max(...factors)];
      state.controls.chips.get(title).textContent = `${text(title)} ${low < high ? `${times(low)} … ` : ""}${times(high)}`;
    }
    if (most) state.controls.exaggeration.show(scale, Math.max(...moved().map(body => magnifiedBy(body, scale))));
  }

  function show() {
    if (!state.scene) return;
    const {cycle, period} = state.scene, {play, scrub, value, phase, rate} = state.controls;
    if (play.dataset.on !== String(clock.playing)) {
      play.dataset.on = String(clock.playing);
      play.replaceChildren(icon(clock.playing ? "pause" : "play"));
      play.title = text(clock.playing ? TEXT.pause : TEXT.play);
      play.setAttribute("aria-label", play.title);
    }
    scrub.show(clock.phase);
    const at = cycle.start + clock.phase * cycle.span, digits = Math.abs(cycle.span) >= 50 ? 1 : Math.max(0, 3 - Math.floor(Math.log10(Math.abs(cycle.span) || 1)));
    put(value, fixed(at, digits) + (cycle.unit.startsWith("°") ? cycle.unit : " " + cycle.unit));
    put(phase, sinceMark(cycle, clock.phase, digits, text));
    put(rate, pace(clock, period, text));
    redraw();
  }

  function keys(event) {
    if (["INPUT", "SELECT", "TEXTAREA"].includes(event.target.tagName) && event.key !== " ") return;
    const frame = 1 / Math.max(1, state.scene.frames - 1);
    const acts = {" ": () => clock.toggle(), ArrowRight: () => clock.step(event.shiftKey ? 10 * frame : frame), f: fit, g: () => setGhosts(!switches.ghosts),
      t: () => setTraces(!switches.traces), ArrowLeft: () => clock.step(event.shiftKey ? -10 * frame : -frame), Home: () => clock.set(0),
      "+": () => zoom(1.25), "-": () => zoom(0.8)};
    if (!acts[event.key] || event.ctrlKey || event.metaKey || (event.key === " " && event.target.tagName === "BUTTON")) return;
    event.preventDefault();
    if (event.key.startsWith("Arrow")) clock.pause();
    acts[event.key]();
  }
  function zoom(factor) { state.fitted = false; view.zoom(factor, view.width / 2, view.height / 2); redraw(); }

  host.addEventListener("keydown", keys);
  canvas.addEventListener("dblclick", fit);
  /** Pose [x, y, angle] of a body by its number at a phase, -1 for the machine frame, as the observer sees it; `real` with its play in true size. */
  function bodyPose(number, phase, real = false) {
    const [low, part] = locate(state.scene.u, phase), eye = poseAt(state.observer.motion, low, part), body = state.scene.bodies[number];
    return seenFrom(number < 0 ? STILL : poseOf(body, low, part, real ? 1 / (body.magnified || 1) : switches.scale), eye);
  }

  /** Whether a body by its number is switched on in the legend; the machine frame, -1, always is. */
  const shows = number => number < 0 || !switches.hidden.has(state.scene.bodies[number].title);

  const player = {
    clock, view, stage, poseOf: bodyPose, shows, load, compare, fit, redraw, setFrame, setGhosts, setTraces, setExaggeration,
    highlight(list) { switches.lit = new Set(list); redraw(); },
    get frame() { return state.observer.name; },
    get scene() { return state.scene; },
    destroy() { unsubscribe(); unwatch(); theme.stop(); surface.stop(); clock.see(player, false); host.removeEventListener("keydown", keys); host.replaceChildren(); },
  };
  load(packed);
  const unsubscribe = clock.subscribe(show);
  if (options.autoplay && !matchMedia("(prefers-reduced-motion: reduce)").matches) clock.play();
  return player;
}
