// Diagrams under the drawing, on its own axis to the right: what the loads do along a shaft.

import { overlays, panelsOf, translated } from "./overlays.js";
import { element, fitCanvas, fixed, watchTheme } from "./player.js";
import { axisOf, layout, paintPanel, runOf, unitText, unpacked, valueAt } from "./plotting.js";

const LEFT = 62, RIGHT = 16, FOOT = 38, GAP = 19, ROW = 66, WORDY = 620;  // px; from WORDY on there is room for words beside the numbers

/** Room that the drawing leaves on its left and right, so that the numbers of the diagrams stand beside what is drawn. */
export const SIDES = LEFT + 6;

/** The diagrams in `host` below a player; `getPlayer()` may be null.  `draw()` after each drawing of it; `shown()` is called as they come or go. */
export function createDiagrams(host, getPlayer, {store, t}, shown) {
  const canvas = element("canvas", {class: "dg-canvas", role: "img"}), line = element("div", {class: "dg-line"}), heads = element("div", {class: "dg-heads"});
  const node = element("div", {class: "dg", "data-testid": "diagrams", hidden: ""}, canvas, heads, line);
  const surface = fitCanvas(canvas, () => draw(true)), theme = watchTheme(host, () => draw(true));
  let rows = [], places = [], key = "", pointer = null;
  host.append(node);

  function load() {
    const {result} = store.state, plots = result?.plots, ids = plots?.diagrams || [], behind = overlays(store.state, t).filter(run => run.plots?.plots);
    rows = panelsOf(plots?.plots || [], ids).map(packed => {
      const panel = unpacked(translated(packed, t)), axis = axisOf(panel, null);
      const others = behind.map(({plots: {plots: theirs}, ...run}) => ({...run, lines: linesOf(panel, panelsOf(theirs, [packed.id])[0], t)}));
      return {panel, axis, behind: others};
    });
    const was = node.hidden;
    node.hidden = !rows.length;
    node.style.setProperty("--dg-height", `${rows.length * ROW + FOOT}px`);
    if (was !== node.hidden) shown(!node.hidden);
    canvas.setAttribute("aria-label", `${t("Diagrams along the drawing")}: ${rows.map(({panel}) => panel.title).join(", ")}`);
    title();
    draw(true);
  }
  function linesOf(panel, theirs, t) {
    if (!theirs) return panel.series.map(() => null);
    const other = unpacked(translated(theirs, t));
    return panel.series.map(({label, unit}) => {
      const found = other.series.find(one => one.label === label && one.unit === unit);
      return found && {u: runOf(other, found), values: found.values, low: other.low, high: other.high};
    });
  }
  /** A word and the numbers of each row. */
  function title() {
    const made = rows.map(({panel}) => element("div", {class: "dg-head", "data-testid": `diagram-${panel.id}`}, element("b", {}, panel.label || panel.title),
      ...panel.series.map(one => element("span", {class: "dg-now", title: one.label, style: `--chip: var(--${one.role})`}, ...(panel.series.length > 1 ? [element("i", {}), element("em", {}, one.label)] : []),
        element("output", {}), unitText(one.unit)))));
    if (heads.dataset.shape !== (heads.dataset.shape = JSON.stringify(rows.map(({panel}) => [panel.label, panel.title, panel.series.map(({label, unit}) => [label, unit])])))) heads.replaceChildren(...made);
  }

  function draw(always = false) {
    const player = getPlayer(), {width, height, ratio, context} = surface;
    if (node.hidden || !player || width < 2) return;
    const {view} = player, now = [view.scale, view.centre, view.width, width, height].join(" ");
    if (!always && now === key) return;
    key = now;
    const tall = (height - FOOT) / rows.length, xAt = px => (px - view.width / 2) / view.scale + view.centre[0] + view.follow[0];
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    places = rows.map(({panel, axis, behind}, n) => {
      const last = n === rows.length - 1, ends = [xAt(LEFT), xAt(width - RIGHT)].map(x => x * axis.factor);
      const margin = {left: LEFT, right: RIGHT, top: n * tall + GAP, bottom: height - (n + 1) * tall};
      const at = layout(panel, axis, behind, {width, height, margin, ends});
      paintPanel(context, panel, axis, behind, at, theme.colours, {foot: last, named: false});
      if (heads.children[n]) heads.children[n].style.transform = `translateY(${Math.round(n * tall + 2)}px)`;
      return at;
    });
    show();
  }
  /** The values under the pointer, else the largest of each line. */
  function show() {
    line.hidden = pointer === null;
    if (pointer !== null) line.style.transform = `translateX(${pointer}px)`;
    rows.forEach(({panel}, n) => panel.series.forEach((one, k) => {
      const out = heads.children[n]?.querySelectorAll("output")[k], values = one.values;
      if (!out || !places[n]) return;
      const value = pointer === null ? largest(values) : valueAt(runOf(panel, one), values, places[n].placeAt(pointer));
      out.textContent = `${pointer === null && surface.width > WORDY ? `${t("largest")} ` : ""}${fixed(value, panel.decimals)}`;
    }));
  }
  node.addEventListener("pointermove", event => { pointer = event.clientX - canvas.getBoundingClientRect().left; show(); });
  node.addEventListener("pointerleave", () => { pointer = null; show(); });
  const stop = store.on(["result", "reference", "kept", "lang"], load);
  return {draw, active: () => !node.hidden, destroy() { stop(); theme.stop(); surface.stop(); node.remove(); }};
}

const largest = values => values.reduce((most, value) => Number.isFinite(value) && Math.abs(value) > Math.abs(most) ? value : most, 0);
