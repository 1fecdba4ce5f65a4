// One panel of a plot on the page: title, running values, curves, the cursor, and the values under the pointer.

import { element, fitCanvas, fixed, locate, watchVisible } from "./clock.js";
import { axisOf, isRising, layout, nearest, paintPanel, runOf, unitText, unpacked, valueAt } from "./plotting.js";

const TIP = 12;  // px from the pointer

/** Axis of a panel in words: panels of the same one share the place under the pointer. */
const keyOf = ({axis}) => axis ? `${axis.label} ${axis.unit}` : "";

/**
 * A panel: {node, panel(), update(packed, cycle), compare(runs), draw(), show(), stop()}.  It costs nothing while it is out of sight.
 * `shared` has the clock, the theme, and point(key, place) with pointed(key) for axes that are not the cycle; `extra(state)` gives
 * nodes beside the title, where state() is {panel, axis, behind} as drawn.
 */
export function createPanel(packed, cycle, shared, extra) {
  const {clock, theme} = shared;
  let panel, axis, behind = [], at = null, visible = true;  // behind: [{name, colour, dash, lines: for each line the other one or nothing}]
  const {title, series} = packed;
  const unit = packed.axis && series.length > 1 ? series[0].unit : "";  // that of all its lines: a panel has one; said once where no numbers stand
  const numbers = series.map(() => element("b", {}, "–")), others = series.map(() => element("small", {}));
  const readouts = series.map((one, n) => element("span", {class: "dw-now", title: one.label, style: `--chip: var(--${one.role})`},
    ...(series.length > 1 ? [element("i", {}), element("em", {}, one.label)] : []), numbers[n], unit ? "" : unitText(one.unit), others[n]));
  const canvas = element("canvas", {class: "dw-plot-canvas"}), cursor = element("div", {class: "dw-cursor"});
  const tip = element("div", {class: "dw-tip", hidden: ""}), cover = element("div", {class: `dw-cover${packed.axis ? " dw-apart" : ""}`}, cursor);
  const dots = series.map(one => element("div", {class: "dw-dot", style: `--chip: var(--${one.role})`}));
  cover.append(...dots);
  const number = packed.figure ? [element("span", {class: "dw-plot-figure"}, packed.figure)] : [];
  const meaning = packed.meaning ? [element("span", {class: "dw-plot-meaning"}, packed.meaning)] : [];
  const state = () => ({panel, axis, behind});
  const node = element("div", {class: "dw-plot"}, element("div", {class: "dw-plot-head"}, element("span", {class: "dw-plot-title", title}, ...number, title, ...(unit ? [element("small", {}, unit)] : [])),
    element("span", {class: "dw-plot-values"}, ...readouts), ...(extra ? extra(state) : []), ...meaning), element("div", {class: "dw-plot-area"}, canvas, cover, tip));
  const surface = fitCanvas(canvas, () => { draw(); show(); });
  const unwatch = watchVisible(node, now => { visible = now; draw(); show(); });

  /** Other values of the same lines; `wholeCycle` may have changed with them. */
  function update(next, wholeCycle) { panel = unpacked(next); axis = axisOf(panel, wholeCycle); panel.path = panel.axis && !panel.axis.names && !isRising(panel.u); draw(); show(); }

  /** Runs [{name, colour, dash, panels: those of the plot of the same name}]: their lines of the same label are drawn behind. */
  function compare(runs) {
    const fitting = (panels, {label, unit}) => panels.flatMap(theirs => theirs.series.filter(line => line.label === label && line.unit === unit)
      .map(line => ({u: runOf(theirs, line), values: line.values, low: theirs.low, high: theirs.high, from: theirs.axis?.low, to: theirs.axis?.high})))[0];
    behind = runs.map(({name, colour, dash, panels}) => ({name, colour, dash, lines: panel.series.map(line => fitting(panels, line))}));
    draw(); show();
  }

  function draw() {
    const {context, ratio, width, height} = surface;
    if (width < 2 || !visible) return;
    at = layout(panel, axis, behind, {width, height});
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    paintPanel(context, panel, axis, behind, at, theme.colours);
  }

  /** Value of a line at a place: between its points where it is a curve that runs one way, else that of the nearest point. */
  function read(u, values, place) {
    if (panel.style === "line" && isRising(u)) return valueAt(u, values, place);
    if (!panel.axis) return valueAt(u, values, place);
    const i = nearest(u, values, place);
    return i < 0 ? NaN : values[i];
  }

  /** {place, values} of the cursor: at the clock's phase, or under the pointer of a panel with the same axis; null where there is none. */
  function current() {
    if (!panel.axis) return {place: clock.phase, values: panel.series.map(({values}) => valueAt(panel.u, values, clock.phase))};
    if (panel.phase && isRising(panel.phase)) {
      const [low, part] = locate(panel.phase, clock.phase), between = list => list[low] + part * (list[low + 1] - list[low]);
      return {place: between(panel.u), values: panel.series.map(({values}) => between(values))};
    }
    const place = shared.pointed(keyOf(panel));
    return place === undefined ? null : {place, values: panel.series.map(line => read(runOf(panel, line), line.values, place))};
  }

  function show() {
    if (!visible || !at) return;
    const now = current(), x = now ? Math.round(at.toX(now.place)) : -99;
    cursor.style.transform = `translateX(${panel.path ? -99 : x}px)`;
    node.classList.toggle("dw-idle", !now);
    panel.series.forEach((_, n) => {
      const value = now ? now.values[n] : NaN, y = at.toY(value), inside = value >= at.low && value <= at.high, other = behind.map(run => run.lines[n]).find(Boolean);
      numbers[n].textContent = fixed(value, panel.decimals);
      others[n].textContent = other && now ? ` (${fixed(read(other.u, other.values, now.place), panel.decimals)})` : "";
      dots[n].style.transform = `translate(${x}px, ${inside ? y : -99}px)`;
    });
  }

  // ---- the pointer
  /** The values of every line and of every other run at a place. */
  function told(place) {
    const named = axis.names ? axis.names[Math.round(place)] ?? "" : fixed(axis.start + place * axis.scale, 2) + unitText(axis.unit);
    const value = (u, values, unit) => fixed(read(u, values, place), panel.decimals) + unitText(unit);
    const rows = panel.series.flatMap((line, n) => [[line.role, line.label, value(runOf(panel, line), line.values, line.unit)],
      ...behind.filter(run => run.lines[n]).map(run => [run.colour, `${run.name || "–"}`, value(run.lines[n].u, run.lines[n].values, line.unit)])]);
    return [element("b", {}, named), ...rows.map(([role, label, text]) => element("span", {style: `--chip: var(--${role})`}, element("i", {}), element("em", {}, label), element("b", {}, text)))];
  }
  const xOf = event => event.clientX - cover.getBoundingClientRect().left;
  function hover(event) {
    const x = xOf(event), {margin, w} = at || {}, place = at && at.placeAt(Math.min(Math.max(x, margin.left), margin.left + w));
    if (!at || event.pointerType === "touch") return;
    tip.replaceChildren(...told(place));
    tip.hidden = false;
    const left = x + TIP + tip.offsetWidth > surface.width ? x - TIP - tip.offsetWidth : x + TIP;
    tip.style.transform = `translate(${Math.max(0, left)}px, 4px)`;
    if (panel.axis) shared.point(keyOf(panel), place);
  }
  function leave() { tip.hidden = true; if (panel.axis) shared.point(keyOf(panel), undefined); }
  function drag(event) {
    if (!at) return;
    if (panel.axis) { shared.point(keyOf(panel), at.placeAt(xOf(event))); return; }
    clock.pause();
    clock.set(at.placeAt(xOf(event)));
  }
  cover.addEventListener("pointerdown", event => { cover.setPointerCapture(event.pointerId); tip.hidden = true; drag(event); });
  cover.addEventListener("pointermove", event => { if (cover.hasPointerCapture(event.pointerId)) drag(event); else hover(event); });
  cover.addEventListener("pointerleave", leave);
  update(packed, cycle);
  return {node, update, compare, draw, show, stop() { surface.stop(); unwatch(); }};
}
