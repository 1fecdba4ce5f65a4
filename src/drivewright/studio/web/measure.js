// Measuring on the drawing: points, lines and circles are picked, their distance, angle or radius is told now and over the cycle.

import { distanceTo, featuresOf } from "./features.js";
import { createNames } from "./handle_names.js";
import { icon } from "./icons.js";
import { dimension } from "./measure_lines.js";
import { createMeasureList } from "./measure_list.js";
import { courseOf, isComplete, nextWanted, textOf, valueOf } from "./measures.js";
import { pressable, put, putAttribute } from "./parts.js";
import { element } from "./player.js";
import { svgPart } from "./svg_parts.js";

const NEAR = 8, SHAKE = 4, MOST = 12;  // px of a pick; px of a hand that clicks; measurements in the list
const ROLES = ["violet", "green", "orange", "blue", "steel"];

/**
 * Measurements upon the drawing of `getPlayer()`: {button for the player's bar, attach(player), active(), expect(afresh), load(scene),
 * draw(), reword(), destroy()}.  They outlive every change of the design, and end with another drive.
 */
export function createMeasure(getPlayer, tools) {
  const {store, t, clock} = tools, names = createNames(tools);
  const layer = svgPart("svg"), lines = svgPart("g"), mark = svgPart("g");
  const bubble = element("output", {class: "hd-bubble", hidden: ""}), cover = element("div", {class: "ms-layer"});
  const button = pressable({class: "dw-button ms-toggle", "data-testid": "measure", "aria-pressed": "false"}, () => toggle(!on), icon("ruler"));
  const list = createMeasureList(tools, {choose, pick, remove, close: () => toggle(false)}, names.of);
  let on = false, kind = "distance", picked = [], features = [], measures = [], cycle = null, count = 0, stage = null, pressed = null;
  layer.append(lines, mark);
  layer.setAttribute("class", "ms-svg"); layer.setAttribute("aria-hidden", "true");
  cover.append(layer, bubble);

  // ---- picking
  const phase = () => clock.phase;
  /** Pixel of a point of a body as it is drawn. */
  function seen(body, [x, y]) {
    const {view, poseOf} = getPlayer(), [px, py, angle] = poseOf(body, phase()), c = Math.cos(angle), s = Math.sin(angle);
    return [view.toX(px + c * x - s * y), view.toY(py + s * x + c * y)];
  }
  function candidate(at) {
    const wanted = nextWanted(kind, picked), {scale} = getPlayer().view;
    let best = null, least = NEAR;
    for (const feature of features) {
      if (!wanted.includes(feature.kind)) continue;
      const away = distanceTo(feature, at, seen, scale) + (feature.kind === "line" ? 3 : 0);  // a corner is meant rather than its edge
      if (away < least - 0.01) { least = away; best = feature; }
    }
    return best;
  }
  const pixel = event => { const area = stage.getBoundingClientRect(); return [event.clientX - area.left, event.clientY - area.top]; };
  const onCanvas = event => on && event.target.classList?.contains("dw-canvas");
  function hover(event) {
    if (!onCanvas(event)) { show(null); return; }
    show(candidate(pixel(event)));
  }
  function press(event) {
    if (!onCanvas(event) || event.button !== 0) return;
    if (clock.playing) clock.pause();
    pressed = pixel(event);
  }
  function release(event) {
    const from = pressed;
    pressed = null;
    if (!from || !on) return;
    const at = pixel(event), feature = Math.hypot(at[0] - from[0], at[1] - from[1]) < SHAKE && candidate(at);
    if (feature) pick(feature);
  }
  /** A feature is picked: the measurement is made when it is the last one that it wants. */
  function pick(feature) {
    picked = [...picked, feature];
    if (isComplete(kind, picked)) { add(kind, picked); picked = []; }
    tell();
  }
  function keys(event) {
    if (event.key !== "Escape" || !on) return;
    event.preventDefault();
    if (picked.length) { picked = []; tell(); } else toggle(false);
  }
  function choose(next) { kind = next; picked = []; tell(); }
  function toggle(next) {
    on = next;
    picked = [];
    tell();
    show(null);
    if (!on) button.focus({preventScroll: true});
  }

  // ---- the list
  function add(what, parts) {
    const used = new Set(measures.map(({role}) => role)), role = ROLES.find(each => !used.has(each)) || ROLES[count % ROLES.length];
    measures = [...measures, {id: ++count, kind: what, refs: parts.map(({ref}) => ref), parts, role}].slice(-MOST);
    evaluate(); tell();
  }
  function remove(id) { measures = measures.filter(measure => measure.id !== id); tell(); }
  /** What each is in the scene that is shown now. */
  function evaluate() {
    const known = new Map(features.map(feature => [feature.ref, feature])), player = getPlayer();
    for (const measure of measures) {
      measure.now = measure.refs.map(ref => known.get(ref));
      measure.course = player && measure.now.every(Boolean) ? courseOf(measure.kind, measure.now, player) : null;
    }
  }
  function tell() {
    putAttribute(button, "aria-pressed", on);
    stage?.classList.toggle("is-measuring", on);
    list.show({on, kind, picked, wanted: nextWanted(kind, picked), features, measures, cycle});
    draw();
  }

  // ---- drawing
  function draw() {
    const player = getPlayer();
    if (!player?.scene || !measures.length && !picked.length) { lines.replaceChildren(); return; }
    const how = {scale: player.view.scale, seen};
    lines.replaceChildren(...measures.filter(measure => measure.course).map(measure => {
      const group = svgPart("g", {class: "ms-one"}), text = textOf(measure.kind, now(measure));
      group.style.setProperty("--chip", `var(--${measure.role})`);
      group.append(...dimension(measure.kind, measure.now, measure.now.map(({body, point}) => seen(body, point)), text, how));
      return group;
    }), ...picked.map(({body, point}) => ring(seen(body, point), "ms-picked")));
    list.follow(measures.filter(({course}) => course).map(measure => [measure.id, textOf(measure.kind, now(measure))]), phase());
  }
  const now = ({kind: what, now: parts}) => valueOf(what, parts, body => getPlayer().poseOf(body, phase(), true));
  const ring = ([cx, cy], look, r = 7) => svgPart("circle", {cx, cy, r, class: look});
  /** Marks the feature under the pointer, and says what it is. */
  function show(feature) {
    bubble.hidden = !feature;
    if (!feature) { mark.replaceChildren(); return; }
    const [x, y] = seen(feature.body, feature.point), {scale} = getPlayer().view, parts = [];
    if (feature.kind === "line") parts.push(edge([x, y], seen(feature.body, feature.to)));
    else parts.push(ring([x, y], "ms-mark", feature.kind === "circle" ? feature.radius * scale : 7));
    mark.replaceChildren(...parts);
    put(bubble, list.nameOf(feature));
    const wide = bubble.offsetWidth, left = x + 14 + wide > cover.clientWidth ? x - 14 - wide : x + 14;
    bubble.style.transform = `translate(${Math.max(4, left)}px, ${Math.max(4, y - 34)}px)`;
  }
  const edge = ([x1, y1], [x2, y2]) => svgPart("line", {x1, y1, x2, y2, class: "ms-mark"});

  /** Puts layer and panel above the stage of a player. */
  function attach(player) {
    stage = player.stage;
    stage.append(cover, list.node);
    for (const [name, act] of Object.entries(EVENTS)) stage.addEventListener(name, act);
  }
  const EVENTS = {pointermove: hover, pointerleave: () => show(null), pointerdown: press, pointerup: release, pointercancel: () => { pressed = null; }, keydown: keys};
  function load(scene) {
    cycle = scene?.cycle || null;
    features = scene ? featuresOf(scene) : [];
    picked = picked.map(({ref}) => features.find(feature => feature.ref === ref)).filter(Boolean);
    if (mark.firstChild) show(null);
    evaluate(); tell();
  }
  function reword() {
    button.title = t("Measure on the drawing");
    button.setAttribute("aria-label", button.title);
    list.reword();
    tell();
  }
  reword();
  const stop = store.on(["design"], ({design}) => { names.learn(design?.form?.groups || []); tell(); });
  return {
    button, attach, load, draw, reword, active: () => on,
    /** Another scene comes: nothing is drawn until it is there; another drive begins with no measurements. */
    expect(afresh) { if (afresh) { measures = []; picked = []; } picked = picked.map(({ref}) => ({ref, body: -1, point: [0, 0]})); for (const measure of measures) measure.course = null; },
    destroy() { stop(); for (const [name, act] of Object.entries(EVENTS)) stage?.removeEventListener(name, act); cover.remove(); list.destroy(); },
  };
}
