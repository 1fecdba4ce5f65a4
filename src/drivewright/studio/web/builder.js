// Building a mechanism on its drawing: tools that the kind of drive offers, each used by clicking places.  What it makes of them the server says.

import { pressable, put, putAttribute } from "./parts.js";
import { element, nice } from "./player.js";
import { onGrid } from "./snapping.js";
import { svgPart } from "./svg_parts.js";
import { reasonsOf, refusedText } from "./words.js";

const NEAR = 9, FINE = 10, STEP = 12, DRAWN = 12;  // px: what a click falls upon, a step of the grid at least, a step of an arrow key, a press that is a stroke
const MOVED = "Points are moved when Build is off; here a click sets a place";

/**
 * The builder over a player's drawing: `layer` belongs upon the drawing, `button` into the bar.  `load(scene)` after each scene, `draw()` after
 * each drawing, `active()` whether clicks belong to it.
 */
export function createBuilder(getPlayer, {store, say, t, clock}) {
  const marks = svgPart("svg"), words = element("p", {class: "bd-words", role: "status", "data-testid": "build-words"});
  const sheet = element("div", {class: "bd-sheet", tabindex: 0, role: "application", "data-testid": "build-sheet"});
  const row = element("div", {class: "bd-tools", role: "toolbar"}), missing = element("ul", {class: "bd-missing", "data-testid": "build-missing"});
  const panel = element("div", {class: "bd-panel"}, row, words, missing);
  const layer = element("div", {class: "bd-layer", hidden: ""}, sheet, marks, panel);
  const button = pressable({class: "dw-button bd-button", "data-testid": "build"}, () => turn(!on));
  let on = false, drive = null, tool = null, heard = null, places = [], cursor = null, pressed = null, handles = [], buttons = new Map();
  marks.setAttribute("class", "bd-marks"); marks.setAttribute("aria-hidden", "true");

  const refusal = () => store.state.refused?.[""] || null;
  const offered = () => (store.state.kinds || []).find(({kind}) => kind === store.state.design?.kind)?.tools || [];
  const chosen = () => offered().find(({name}) => name === tool);

  // ---- on and off
  function turn(next) {
    if (next === on) return;
    on = next && offered().length > 0;
    if (on) { clock.set(0); clock.pause(); tool ||= offered()[0].name; }
    places = []; cursor = null;
    layer.hidden = !on;
    layer.parentElement?.classList.toggle("is-building", on);
    say({what: "sketch", on});
    show();
    if (on) sheet.focus({preventScroll: true});
  }
  function choose(name) { tool = name; places = []; heard = refusal(); show(); sheet.focus({preventScroll: true}); }

  // ---- where a hand is: pixels of the drawing, metres of the machine at its start
  const frame = () => getPlayer().poseOf(-1, 0);
  function toPixel([x, y]) {
    const {view} = getPlayer(), [px, py, angle] = frame(), c = Math.cos(angle), s = Math.sin(angle);
    return [view.toX(px + c * x - s * y), view.toY(py + s * x + c * y)];
  }
  function toMachine([x, y]) {
    const {view} = getPlayer(), [px, py, angle] = frame(), [mx, my] = view.middle(), c = Math.cos(angle), s = Math.sin(angle);
    const dx = (x - view.width / 2) / view.scale + mx - px, dy = (view.height / 2 - y) / view.scale + my - py;
    return [c * dx + s * dy, c * dy - s * dx];
  }
  /** A point of the mechanism near a pixel, else the nearest place of a round grid; Alt, and a tool for what is there, take the pixel itself. */
  function meant(pixel, free) {
    const points = [...handles.map(seen), ...places.map(toPixel)].map(at => [Math.hypot(at[0] - pixel[0], at[1] - pixel[1]), at]);
    const [distance, at] = points.sort(([a], [b]) => a - b)[0] || [Infinity];
    if (distance < NEAR) return toMachine(at);
    const step = free || chosen()?.picks ? 0 : nice(FINE * 2.5 / getPlayer().view.scale) / 2;
    return toMachine(pixel).map(part => onGrid(part, step));
  }
  function seen({body, point: [x, y]}) {
    const {view, poseOf} = getPlayer(), [px, py, angle] = poseOf(body, 0), c = Math.cos(angle), s = Math.sin(angle);
    return [view.toX(px + c * x - s * y), view.toY(py + s * x + c * y)];
  }
  const pixelOf = event => { const area = sheet.getBoundingClientRect(); return [event.clientX - area.left, event.clientY - area.top]; };

  // ---- clicks and keys
  function place(at) {
    const {most} = chosen(), last = places.at(-1);
    if (last && Math.hypot(at[0] - last[0], at[1] - last[1]) * getPlayer().view.scale < 3) return;  // the second click of a double one
    places.push(at);
    if (places.length >= most) finish(); else show();
  }
  function finish() {
    const {fewest, name} = chosen();
    if (places.length < fewest) return;
    say({what: "construct", tool: name, places, near: NEAR / getPlayer().view.scale});
    places = [];
    show();
  }
  function keys(event) {
    const move = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key], size = event.shiftKey ? 1 : STEP;
    const {width, height} = getPlayer().view, at = cursor || [width / 2, height / 2];
    const acts = {Enter: finish, " ": () => place(meant(at, true)), Escape: () => places.length ? cancel() : leave()};
    const act = move ? () => { cursor = [at[0] + move[0] * size, at[1] + move[1] * size]; draw(); } : acts[event.key];
    if (!act || event.ctrlKey || event.metaKey) return;
    event.preventDefault(); event.stopPropagation();
    act();
  }
  function cancel() { places = []; show(); }
  function leave() { turn(false); button.focus(); }
  /** A press sets a place; a stroke is a body from its beginning to its end. */
  function press(event) {
    if (event.button !== 0) return;
    event.stopPropagation();
    cursor = pixelOf(event);
    pressed = {place: meant(cursor, event.altKey), client: [event.clientX, event.clientY]};  // the drawing may move before the release
    sheet.setPointerCapture(event.pointerId);
  }
  function release(event) {
    if (!pressed) return;
    const from = pressed, stroke = Math.hypot(event.clientX - from.client[0], event.clientY - from.client[1]) > DRAWN, several = chosen().most > 1;
    pressed = null;
    if (stroke && !several) { words.textContent = t(MOVED); return; }
    place(from.place);
    if (stroke && places.length) { place(meant(pixelOf(event), event.altKey)); finish(); }
  }
  sheet.addEventListener("pointerdown", press);
  sheet.addEventListener("pointerup", release);
  sheet.addEventListener("pointercancel", () => { pressed = null; });
  sheet.addEventListener("pointermove", event => { cursor = pixelOf(event); draw(); });
  sheet.addEventListener("pointerleave", () => { cursor = null; draw(); });
  sheet.addEventListener("dblclick", event => { event.stopPropagation(); finish(); });
  sheet.addEventListener("wheel", event => { event.preventDefault(); getPlayer().view.zoom(Math.exp(-event.deltaY / 500), ...pixelOf(event)); getPlayer().redraw(); }, {passive: false});
  sheet.addEventListener("keydown", keys);
  layer.addEventListener("keydown", event => { if (event.key === "Escape" && event.target !== sheet) { event.stopPropagation(); leave(); } });

  // ---- what is seen
  function draw() {
    if (!on) return;
    const clicked = places.map(toPixel), next = cursor && toPixel(meant(cursor)), from = pressed && chosen()?.most > 1 ? [toPixel(pressed.place)] : [];
    const all = next && chosen()?.most > 1 ? [...clicked, ...from, next] : clicked;
    const line = svgPart("polyline", {points: all.map(at => at.map(part => part.toFixed(1)).join(",")).join(" ")});
    const dots = [...clicked, ...(next ? [next] : [])].map(([x, y], n) => svgPart("circle", {cx: x.toFixed(1), cy: y.toFixed(1), r: 5, class: n < clicked.length ? "is-set" : ""}));
    marks.replaceChildren(line, ...dots);
  }
  function show() {
    const tools = offered(), current = chosen(), refused = refusal() === heard ? "" : refusal()?.message;  // what another tool was told is over
    button.hidden = !tools.length;
    put(button, t("Build"));
    putAttribute(button, "title", t("Build the mechanism by clicking"));
    putAttribute(button, "aria-pressed", on);
    if (!on) return;
    if (![...buttons.keys()].every((name, n) => tools[n]?.name === name) || buttons.size !== tools.length) {
      buttons = new Map(tools.map(({name}) => [name, pressable({class: "bd-tool", "data-testid": `tool-${name}`}, () => choose(name))]));
      row.replaceChildren(...buttons.values());
    }
    for (const {name, label} of tools) { buttons.get(name).textContent = t(label); buttons.get(name).setAttribute("aria-pressed", String(name === tool)); }
    row.setAttribute("aria-label", t("Tools"));
    sheet.setAttribute("aria-label", t("Drawing to build on: arrow keys move, the space bar sets a place, Enter ends"));
    words.textContent = refused ? refusedText(refused, t) : current ? t(current.hint) : "";
    words.classList.toggle("is-refused", Boolean(refused));
    const texts = [...(store.state.scene?.missing || []), ...reasonsOf(store.state)].filter(text => text !== refused);
    missing.replaceChildren(...texts.map(text => element("li", {}, t(text))));
    missing.hidden = !texts.length;
    draw();
  }

  show();
  const stops = [store.on(["lang", "kinds", "scene", "refused"], show),
    store.on(["design"], ({design, building}) => {
      const begins = building && design?.opened !== drive;
      drive = design?.opened;
      if (on && !offered().length) turn(false); else show();
      if (begins) { store.set({building: false, view: "motion"}); turn(true); }
    })];
  return {layer, button, draw, active: () => on, load(scene) { handles = scene.handles || []; },
    destroy() { stops.forEach(stop => stop()); layer.remove(); button.remove(); }};
}
