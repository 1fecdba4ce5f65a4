// Handles on the drawing: whatever the scene says that a hand can move.  A drag changes keys of the spec; the mechanism follows.

import { createDrag } from "./dragging.js";
import { createNames } from "./handle_names.js";
import { icon } from "./icons.js";
import { putAttribute, putClass } from "./parts.js";
import { element } from "./player.js";
import { svgPart } from "./svg_parts.js";

const APART = 15, SAME = 6;  // px: handles that coincide are drawn so far from each other
const NEAREST = 10, MOST = 60, OUTSIDE = 24;  // px between two that are shown; of them; px beyond the edge of the drawing
const KEPT = "drivewright-handles";
export const FACTORS = {m: 1, mm: 1e-3, cm: 1e-2, um: 1e-6, "µm": 1e-6, in: 0.0254, inch: 0.0254, rad: 1, deg: Math.PI / 180, "°": Math.PI / 180, "": 1};

/** The keys that a handle moves: the two components of a point, or one number. */
const keysOf = ({key, direction}) => direction ? [key] : [`${key}.0`, `${key}.1`];

/** The numbers of a handle's keys: [{key, unit, factor, value, whole, low, high}] as the form shows them; null where it has no such fields. */
export function numbersOf(handle, fields) {
  const found = keysOf(handle).map(key => {
    const {unit, value, kind, low, high} = fields.get(key) || {}, factor = FACTORS[unit];
    return factor && typeof value === "number" ? {key, unit, factor, value, whole: kind === "integer", low, high} : null;
  });
  return found.every(Boolean) ? found : null;
}

/**
 * The handles of a player's scene, as buttons upon its drawing.  `draw()` puts them where they belong after each drawing; while the
 * motion plays they stay where they are at its beginning.  `held()` says whether one is being dragged.  `bar()` are the buttons for the player's
 * bar: the switch that shows and hides them, which is remembered.
 */
export function createHandles(getPlayer, tools) {
  const {store, t, clock} = tools;
  const layer = element("div", {class: "hd-layer", role: "group"}), guides = svgPart("svg", {class: "hd-guides", "aria-hidden": "true"});
  const bubble = element("output", {class: "hd-bubble", hidden: ""});
  const names = createNames(tools);
  const placed = new WeakMap();  // of each button, where it stands
  let packed = [], bodies = [], buttons = [], spots = [], fields = new Map(), on = recall(), toggle = null;  // spots: pixel of each handle as drawn
  layer.append(guides, bubble);

  const drag = createDrag({layer, guides, bubble, place, others, nearest, nameOf: names.of, numbers: handle => numbersOf(handle, fields), view: () => getPlayer().view,
    frame: handle => getPlayer().poseOf(handle.body, phase()), undrawn: () => Math.max(0, store.state.design.gen - (store.state.scene?.gen ?? 0)), ...tools});
  const phase = () => clock.playing ? 0 : clock.phase;

  /** Pixel of a point in the frame of a handle's body. */
  function place({body}, [x, y]) {
    const {view, poseOf} = getPlayer(), [px, py, angle] = poseOf(body, phase()), c = Math.cos(angle), s = Math.sin(angle);
    return [view.toX(px + c * x - s * y), view.toY(py + s * x + c * y)];
  }
  /** The other handles that are points, each with its pixel. */
  function others(handle) { return packed.filter((other, n) => other !== handle && !buttons[n].hidden).map(other => ({...other, at: place(other, other.point)})); }

  /** The handle that is drawn nearest to a pixel: the areas of two beside each other overlap. */
  function nearest([x, y]) {
    const far = n => buttons[n].hidden ? Infinity : distance(spots[n], [x, y]), n = packed.reduce((best, _, m) => far(m) < far(best) ? m : best, 0);
    return {button: buttons[n], handleOf: () => packed[n]};
  }

  function load(scene) {
    const next = scene?.handles || [], same = next.length === packed.length && next.every(({key}, n) => key === packed[n].key);
    packed = next;
    bodies = scene?.bodies || [];
    if (!same) {
      buttons.forEach(button => button.remove());
      buttons = packed.map((handle, n) => createButton(handle, n));
      layer.append(...buttons);
    }
    name();
  }
  function createButton({key, direction}, n) {
    const button = element("button", {type: "button", class: `hd${direction ? " hd-size" : ""}`, "data-testid": `handle-${key}`});
    drag.attach(button, () => packed[n]);
    return button;
  }
  /** What each is called, with its numbers. */
  function name() {
    putAttribute(layer, "aria-label", t("Handles of the drawing: arrow keys move, with Shift further, Enter types numbers, Esc takes back"));
    packed.forEach((handle, n) => {
      const numbers = numbersOf(handle, fields), button = buttons[n], called = names.of(handle);
      const locked = Boolean(numbers?.some(({key}) => isLocked(key)));
      button.disabled = !numbers || locked;
      putAttribute(button, "aria-label", `${called}: ${(numbers || []).map(({value, unit}) => `${value} ${unit}`.trim()).join(", ")}`);
      putAttribute(button, "title", locked ? `${called} (${t("locked")})` : "");  // what can be moved says its name beside it
      colour(button, colourOf(handle));
    });
  }
  function colour(button, value) { if (button.style.getPropertyValue("--of") !== value) button.style.setProperty("--of", value); }
  /** The colour of the body that a handle belongs to, so that two on one joint can be told apart. */
  function colourOf({body}) {
    const role = bodies[body]?.colour;
    return role && role !== "ground" ? `var(--${role})` : "";
  }
  /** Whether a key, or the point that it is a part of, is locked. */
  const isLocked = key => store.state.design.locks.some(lock => lock === key || key.startsWith(`${lock}.`));

  /** Puts every button where its point is; those that coincide stand beside each other, each towards the middle of its own body. */
  function draw() {
    layer.hidden = !on || !packed.length;
    if (layer.hidden) return;
    const at = packed.map(handle => place(handle, handle.point)), middles = middlesOf(at), shown = [];
    putClass(layer, "is-playing", clock.playing);
    packed.forEach((handle, n) => {
      const same = packed.some((other, m) => m < n && !buttons[m].hidden && distance(at[m], at[n]) < SAME);
      const spot = same ? towards(at[n], middles.get(handle.body)) : at[n], kept = drag.held(buttons[n]) || document.activeElement === buttons[n];
      const room = shown.length < MOST && isInside(spot) && shown.every(other => distance(other, spot) >= NEAREST);
      buttons[n].hidden = !kept && !(room && getPlayer().shows(handle.body));
      if (buttons[n].hidden) return;
      shown.push(spot);
      spots[n] = spot;
      stand(buttons[n], `${spot[0].toFixed(1)}px, ${spot[1].toFixed(1)}px`, handle.direction ? `${angleOf(handle).toFixed(3)}rad` : "");
    });
    drag.draw();
  }
  function stand(button, place, turn) {
    const {style} = button, now = `${place} ${turn}`;
    if (placed.get(button) === now) return;
    placed.set(button, now);
    style.transform = `translate(${place})`;
    if (turn) style.setProperty("--turn", turn);
  }
  function isInside([x, y]) {
    const {width, height} = getPlayer().view;
    return x > -OUTSIDE && y > -OUTSIDE && x < width + OUTSIDE && y < height + OUTSIDE;
  }

  // ---- the switch
  function switchOver() {
    on = !on;
    remember(on);
    if (!on) drag.end();
    toggle.setAttribute("aria-pressed", String(on));
    draw();
  }
  function bar() {
    toggle = element("button", {type: "button", class: "dw-button hd-switch", "data-testid": "handles-switch", title: t("Handles"),
      "aria-label": t("Handles"), "aria-pressed": String(on)}, icon("handles"));
    toggle.addEventListener("click", switchOver);
    return [toggle];
  }

  function angleOf(handle) {
    const [x, y] = place(handle, handle.point), [dx, dy] = handle.direction, size = Math.hypot(dx, dy) || 1, step = 1 / getPlayer().view.scale;
    const [x1, y1] = place(handle, [handle.point[0] + dx / size * step * 10, handle.point[1] + dy / size * step * 10]);
    return Math.atan2(y1 - y, x1 - x);
  }
  function middlesOf(at) {
    const sums = new Map();
    packed.forEach(({body}, n) => { const [x, y, count] = sums.get(body) || [0, 0, 0]; sums.set(body, [x + at[n][0], y + at[n][1], count + 1]); });
    return new Map([...sums].map(([body, [x, y, count]]) => [body, [x / count, y / count]]));
  }

  const undrawn = store.on(["scene"], ({design}) => design && drag.drawn());
  const stop = store.on(["design", "lang"], ({design}) => {
    fields = new Map((design?.form?.groups || []).flatMap(group => group.fields.flatMap(withParts).map(field => [field.key, field])));
    names.learn(design?.form?.groups || []);
    if (!design) return;
    drag.answered();
    name();
  });
  return {layer, load, draw, bar, held: () => drag.held(), destroy() { stop(); undrawn(); drag.destroy(); layer.remove(); }};
}

const withParts = field => [field, ...(field.parts || []).flatMap(withParts)];

function towards([x, y], [mx, my]) {
  const size = Math.hypot(mx - x, my - y);
  return size > 1 ? [x + (mx - x) / size * APART, y + (my - y) / size * APART] : [x + APART, y];
}

const distance = ([x1, y1], [x2, y2]) => Math.hypot(x1 - x2, y1 - y2);

/** Whether the handles were shown when they were last switched; they are at first, and where nothing can be remembered. */
function recall() {
  try { return localStorage.getItem(KEPT) !== "off"; } catch { return true; }
}
function remember(on) {
  try { localStorage.setItem(KEPT, on ? "on" : "off"); } catch { /* a private window forgets */ }
}
