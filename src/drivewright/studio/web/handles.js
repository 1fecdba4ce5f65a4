// Handles on the drawing: whatever the scene says that a hand can move.  A drag changes keys of the spec; the mechanism follows.

import { createDrag } from "./dragging.js";
import { element } from "./player.js";

const APART = 15, SAME = 6;  // px: handles that coincide are drawn so far from each other
export const FACTORS = {m: 1, mm: 1e-3, cm: 1e-2, um: 1e-6, "µm": 1e-6, in: 0.0254, inch: 0.0254, rad: 1, deg: Math.PI / 180, "°": Math.PI / 180, "": 1};

/** The keys that a handle moves: the two components of a point, or one number. */
export const keysOf = ({key, direction}) => direction ? [key] : [`${key}.0`, `${key}.1`];

/** The numbers of a handle's keys: [{key, unit, factor, value, low, high}] as the form shows them; null where it has no such fields. */
export function numbersOf(handle, fields) {
  const found = keysOf(handle).map(key => {
    const {unit, value, low, high} = fields.get(key) || {}, factor = FACTORS[unit];
    return factor && typeof value === "number" ? {key, unit, factor, value, low, high} : null;
  });
  return found.every(Boolean) ? found : null;
}

/**
 * The handles of a player's scene, as buttons upon its drawing.  `draw()` puts them where they belong after each drawing; while the
 * motion plays they stay where they are at its beginning.  `held()` says whether one is being dragged.
 */
export function createHandles(getPlayer, tools) {
  const {store, t, clock} = tools;
  const layer = element("div", {class: "hd-layer", role: "group"}), guides = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const bubble = element("output", {class: "hd-bubble", hidden: ""});
  let packed = [], buttons = [], fields = new Map();
  guides.setAttribute("class", "hd-guides");
  layer.append(guides, bubble);

  const drag = createDrag({layer, guides, bubble, place, others, numbers: handle => numbersOf(handle, fields), view: () => getPlayer().view,
    frame: handle => getPlayer().poseOf(handle.body, phase()), ...tools});
  const phase = () => clock.playing ? 0 : clock.phase;

  /** Pixel of a point in the frame of a handle's body. */
  function place({body}, [x, y]) {
    const {view, poseOf} = getPlayer(), [px, py, angle] = poseOf(body, phase()), c = Math.cos(angle), s = Math.sin(angle);
    return [view.toX(px + c * x - s * y), view.toY(py + s * x + c * y)];
  }
  /** The other handles that are points, each with its pixel. */
  function others(handle) { return packed.filter(other => other !== handle).map(other => ({...other, at: place(other, other.point)})); }

  function load(scene) {
    const next = scene?.handles || [], same = next.length === packed.length && next.every(({key}, n) => key === packed[n].key);
    packed = next;
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
    layer.setAttribute("aria-label", t("Handles of the drawing"));
    packed.forEach((handle, n) => {
      const numbers = numbersOf(handle, fields), button = buttons[n];
      const locked = numbers && numbers.every(({key}) => store.state.design.locks.includes(key));
      button.disabled = !numbers || locked;
      button.setAttribute("aria-label", `${t(handle.label || handle.key)}: ${(numbers || []).map(({value, unit}) => `${value} ${unit}`).join(", ")}`);
      button.title = `${t(handle.label || handle.key)}${locked ? ` (${t("locked")})` : ""}`;
    });
  }
  /** Puts every button where its point is; those that coincide stand beside each other, each towards the middle of its own body. */
  function draw() {
    if (!packed.length) return;
    const at = packed.map(handle => place(handle, handle.point)), middles = middlesOf(at);
    layer.classList.toggle("is-playing", clock.playing);
    packed.forEach((handle, n) => {
      const before = at.slice(0, n).some(([x, y]) => Math.hypot(x - at[n][0], y - at[n][1]) < SAME);
      const [x, y] = before ? towards(at[n], middles.get(handle.body)) : at[n];
      buttons[n].style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      if (handle.direction) buttons[n].style.setProperty("--turn", `${angleOf(handle).toFixed(3)}rad`);
    });
    drag.draw();
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

  const stop = store.on(["design", "lang"], ({design}) => {
    fields = new Map((design?.form?.groups || []).flatMap(group => group.fields.flatMap(withParts).map(field => [field.key, field])));
    if (design) name();
  });
  return {layer, load, draw, held: drag.held, destroy() { stop(); drag.destroy(); layer.remove(); }};
}

const withParts = field => [field, ...(field.parts || []).flatMap(withParts)];

function towards([x, y], [mx, my]) {
  const size = Math.hypot(mx - x, my - y);
  return size > 1 ? [x + (mx - x) / size * APART, y + (my - y) / size * APART] : [x + APART, y];
}
