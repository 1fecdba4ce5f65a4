// Plots over the cycle, with one cursor on all of them.  Dragging in one moves the clock, and so the player.
//
//   createPlots(host, plots, {clock});                       // plots: the dictionary of pack_plots or pack_plot_groups

import { element, fitCanvas, fixed, floats, locate, watchTheme, watchVisible } from "./clock.js";

const MARGIN = {left: 52, right: 14, top: 6, bottom: 36};
const FONT = "11px system-ui, sans-serif";

/** Ticks at round values, about `count` of them; angles at 10, 15, 30, 45, 90 ... degrees. */
export function ticks(low, high, count, unit) {
  const width = Math.max(high - low, 1e-300), rough = width / count, power = 10 ** Math.floor(Math.log10(rough));
  const turn = unit === "°" && width >= 60;
  const step = turn ? [10, 15, 30, 45, 60, 90, 180, 360].find(s => s >= rough) || 360 * Math.ceil(rough / 360) : [1, 2, 5, 10].find(s => s * power >= rough * 0.999) * power;
  const found = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + step * 1e-9; n++) found.push(n * step);
  return {values: found, decimals: Math.min(9, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)))};
}

/** Ticks at the powers of ten. */
function powers(low, high) {
  const values = [];
  for (let n = Math.ceil(Math.log10(low)); 10 ** n <= high; n++) values.push(10 ** n);
  return {values};
}

const tickText = (value, decimals) => Math.abs(value) >= 1e5 || (value !== 0 && decimals > 5)
  ? value.toExponential(1).replace("e+", "e").replace("-", "−") : fixed(value, decimals);
const unitText = unit => unit.startsWith("°") || !unit ? unit : ` ${unit}`;

/** The panel with arrays instead of text. */
const unpacked = panel => ({...panel, u: floats(panel.u), series: panel.series.map(series => ({...series, values: floats(series.data),
  ends: (series.ends || []).map(floats)}))});

/** Value of a line at a phase; none where it does not reach. */
function valueAt(u, values, phase) {
  if (phase < u[0] - 1e-3 || phase > u[u.length - 1] + 1e-3) return NaN;
  const [low, part] = locate(u, phase);
  return values[low] + part * (values[low + 1] - values[low]);
}

/** One panel: title, running values, curves with limit lines, cursor.  It costs nothing while it is out of sight. */
function createPanel(packed, cycle, clock, theme) {
  let panel, behind = [], visible = true;  // behind: for each line the one it is compared with, {u, values}, or nothing
  const {title, series} = packed;
  const numbers = series.map(() => element("b", {}, "–")), others = series.map(() => element("small", {}));
  const readouts = series.map((one, n) => element("span", {class: "dw-now", title: one.label, style: `--chip: var(--${one.role})`},
    ...(series.length > 1 ? [element("i", {}), element("em", {}, one.label)] : []), numbers[n], unitText(one.unit), others[n]));
  const canvas = element("canvas", {class: "dw-plot-canvas"}), cursor = element("div", {class: "dw-cursor"}), cover = element("div", {class: "dw-cover"}, cursor);
  const dots = series.map(one => element("div", {class: "dw-dot", style: `--chip: var(--${one.role})`}));
  cover.append(...dots);
  const number = packed.figure ? [element("span", {class: "dw-plot-figure"}, packed.figure)] : [];
  const meaning = packed.meaning ? [element("span", {class: "dw-plot-meaning"}, packed.meaning)] : [];
  const node = element("div", {class: "dw-plot"}, element("div", {class: "dw-plot-head"}, element("span", {class: "dw-plot-title", title}, ...number, title),
    element("span", {class: "dw-plot-values"}, ...readouts), ...meaning), element("div", {class: "dw-plot-area"}, canvas, cover));
  const surface = fitCanvas(canvas, () => { draw(); show(); });
  const unwatch = watchVisible(node, now => { visible = now; draw(); show(); });
  const inner = () => ({w: surface.width - MARGIN.left - MARGIN.right, h: surface.height - MARGIN.top - MARGIN.bottom});
  const toX = part => MARGIN.left + part * inner().w;
  const height = value => !panel.log ? value : value > 0 ? Math.log10(value) : NaN;  // where a value stands on the axis
  const toY = value => MARGIN.top + (height(range()[1]) - height(value)) / (height(range()[1]) - height(range()[0])) * inner().h;

  /** [low, high] of the axis: the panel's own, and room for what it is compared with. */
  function range() {
    const found = behind.filter(Boolean);
    return [Math.min(panel.low, ...found.map(one => one.low)), Math.max(panel.high, ...found.map(one => one.high))];
  }

  /** Other values of the same lines; `wholeCycle` may have changed with them. */
  function update(next, wholeCycle) { panel = unpacked(next); cycle = wholeCycle; draw(); show(); }

  /** Panels of the other design's plot of the same name: its lines of the same label are drawn behind. */
  function compare(theirs) {
    behind = panel.series.map(({label, unit}) => theirs.flatMap(({u, low, high, series: lines}) =>
      lines.filter(line => line.label === label && line.unit === unit).map(line => ({u, low, high, values: line.values})))[0]);
    draw(); show();
  }

  function axes(context, colours) {
    const {w, h} = inner(), end = cycle.start + cycle.span;
    const across = ticks(Math.min(cycle.start, end), Math.max(cycle.start, end), Math.max(2, Math.min(8, w / 62)), cycle.unit);
    const up = panel.log ? powers(...range()) : ticks(...range(), Math.max(2, h / 23), panel.series[0].unit);
    context.font = FONT; context.lineWidth = 1;
    phases(context, colours);
    stretches(context, colours);
    context.strokeStyle = colours.line; context.fillStyle = colours.muted;
    context.textAlign = "right"; context.textBaseline = "middle";
    for (const value of up.values) {
      rule(context, MARGIN.left, toY(value), MARGIN.left + w, toY(value), value === 0 ? colours["grid-strong"] : colours.grid);
      context.fillText(panel.log ? value.toExponential(0).replace("e+", "e").replace("-", "−") : tickText(value, up.decimals), MARGIN.left - 7, toY(value));
    }
    context.textBaseline = "top";
    for (const value of across.values) {
      const x = toX((value - cycle.start) / cycle.span), text = tickText(value, across.decimals) + (cycle.unit === "°" ? "°" : "");
      rule(context, x, MARGIN.top, x, MARGIN.top + h, colours.grid);
      context.textAlign = x > MARGIN.left + w - 12 ? "right" : "center";
      context.fillText(text, x > MARGIN.left + w - 12 ? MARGIN.left + w + 12 : x, MARGIN.top + h + 5);
    }
    context.textAlign = "center";
    context.fillText(cycle.label + (cycle.unit && cycle.unit !== "°" ? ` [${cycle.unit}]` : ""), MARGIN.left + w / 2, MARGIN.top + h + 20);
  }

  function phases(context, colours) {
    const {h} = inner();
    context.fillStyle = colours.raised; context.globalAlpha = 0.6;
    if (cycle.marks.length > 1) cycle.marks.forEach(([start], n) => {
      const stop = n + 1 < cycle.marks.length ? cycle.marks[n + 1][0] : 1;
      if (n % 2 === 0) context.fillRect(toX(start), MARGIN.top, toX(stop) - toX(start), h);
    });
    context.globalAlpha = 1;
  }

  function stretches(context, colours) {
    context.fillStyle = colours.line;
    for (const [start, stop] of panel.shade) context.fillRect(toX(start), MARGIN.top, Math.max(toX(stop) - toX(start), 0.5), inner().h);
  }

  function rule(context, x0, y0, x1, y1, colour) {
    context.strokeStyle = colour;
    context.beginPath(); context.moveTo(Math.round(x0) + 0.5, Math.round(y0) + 0.5); context.lineTo(Math.round(x1) + 0.5, Math.round(y1) + 0.5); context.stroke();
  }

  function limits(context, colours) {
    const {w} = inner();
    context.font = FONT; context.textAlign = "right";
    for (const [value, text] of panel.limits) {
      const y = toY(value), above = y > MARGIN.top + 18;
      context.setLineDash([6, 4]); context.lineWidth = 1.2;
      rule(context, MARGIN.left, y, MARGIN.left + w, y, colours.bad);
      context.setLineDash([]);
      const wide = context.measureText(text).width;
      context.fillStyle = colours.surface; context.globalAlpha = 0.75;
      context.fillRect(MARGIN.left + w - wide - 6, y + (above ? -16 : 3), wide + 6, 13);
      context.fillStyle = colours.bad; context.globalAlpha = 1; context.textBaseline = above ? "bottom" : "top";
      context.fillText(text, MARGIN.left + w - 3, y + (above ? -3 : 4));
    }
  }

  const place = (u, values, i) => [toX(u[i]), Math.max(-1e4, Math.min(1e4, toY(values[i])))];

  function curve(context, u, values) {
    context.beginPath();
    let pen = false;
    for (let i = 0; i < u.length; i++) {
      const [x, y] = place(u, values, i);
      if (!Number.isFinite(y)) { pen = false; continue; }
      pen ? context.lineTo(x, y) : context.moveTo(x, y);
      pen = true;
    }
    context.stroke();
  }

  /** The 95 % intervals of a line as a band; of single points as error bars. */
  function intervals(context, u, [low, high], isolated) {
    context.globalAlpha = isolated ? 0.8 : 0.2; context.setLineDash([]); context.lineWidth = 1;
    const known = i => Number.isFinite(low[i]) && Number.isFinite(high[i]);
    if (isolated) for (let i = 0; i < u.length; i++) {
      if (!known(i)) continue;
      const [x, y0] = place(u, low, i), [, y1] = place(u, high, i);
      context.beginPath(); context.moveTo(x, y0); context.lineTo(x, y1);
      for (const y of [y0, y1]) { context.moveTo(x - 3, y); context.lineTo(x + 3, y); }
      context.stroke();
    } else for (let i = 0; i < u.length;) {
      let stop = i;
      while (stop < u.length && known(stop)) stop++;
      context.beginPath();
      for (let k = i; k < stop; k++) context.lineTo(...place(u, high, k));
      for (let k = stop - 1; k >= i; k--) context.lineTo(...place(u, low, k));
      context.fill();
      i = stop + 1;
    }
    context.globalAlpha = 1;
  }

  /** Points, and below them the stems that they stand on. */
  function marks(context, u, values) {
    const foot = toY(panel.log ? range()[0] : 0);
    for (let i = 0; i < u.length; i++) {
      const [x, y] = place(u, values, i);
      if (!Number.isFinite(y)) continue;
      context.beginPath(); context.arc(x, y, 1.8, 0, 2 * Math.PI); context.fill();
      if (panel.style === "stems") { context.beginPath(); context.moveTo(x, foot); context.lineTo(x, y); context.stroke(); }
    }
  }

  function curves(context, colours) {
    const {w, h} = inner();
    context.save();
    context.beginPath(); context.rect(MARGIN.left, MARGIN.top, w, h); context.clip();
    context.lineJoin = "round";
    context.strokeStyle = colours.muted; context.lineWidth = 1.1; context.setLineDash([4, 3]);
    for (const one of behind.filter(Boolean)) curve(context, one.u, one.values);
    for (const {values, role, dashed, ends} of panel.series) {
      context.strokeStyle = context.fillStyle = colours[role];
      if (ends.length) intervals(context, panel.u, ends, panel.style !== "line");
      context.setLineDash(dashed ? [5, 3] : []); context.lineWidth = dashed ? 1.2 : 1.8;
      (panel.style === "line" || dashed ? curve : marks)(context, panel.u, values);
    }
    context.setLineDash([]);
    context.restore();
  }

  function draw() {
    const {context, ratio, width, height: tall} = surface;
    if (width < 2 || !visible) return;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, tall);
    axes(context, theme.colours);
    curves(context, theme.colours);
    limits(context, theme.colours);
  }

  function show() {
    if (!visible) return;
    const x = Math.round(toX(clock.phase)), [low, high] = range();
    cursor.style.transform = `translateX(${x}px)`;
    panel.series.forEach(({values}, n) => {
      const value = valueAt(panel.u, values, clock.phase), y = toY(value), inside = value >= low && value <= high, other = behind[n];
      numbers[n].textContent = fixed(value, panel.decimals);
      others[n].textContent = other ? ` (${fixed(valueAt(other.u, other.values, clock.phase), panel.decimals)})` : "";
      dots[n].style.transform = `translate(${x}px, ${inside ? y : -99}px)`;
    });
  }

  function drag(event) {
    const box = cover.getBoundingClientRect();
    clock.pause();
    clock.set((event.clientX - box.left - MARGIN.left) / inner().w);
  }
  cover.addEventListener("pointerdown", event => { cover.setPointerCapture(event.pointerId); drag(event); });
  cover.addEventListener("pointermove", event => { if (cover.hasPointerCapture(event.pointerId)) drag(event); });
  update(packed, cycle);
  return {node, draw, show, update, compare, stop() { surface.stop(); unwatch(); }};
}

/** Plots as groups of panels: those of `plots` by name, or bare `panels`, each standing for itself. */
const grouped = ({plots, panels}) => plots || panels.map(panel => ({name: panel.title, panels: [panel]}));

/** What the page shows beside the numbers: where it is the same, plots stay as they are and only draw other numbers. */
const structure = packed => JSON.stringify([!packed.plots, grouped(packed).map(({name, title, panels}) => [name, title, panels.map(panel =>
  [panel.title, panel.series.map(({label, unit, role}) => [label, unit, role])])])]);

/**
 * Plots inside `host` that follow `options.clock`.  Returns {update(packed), compare(packed | null), destroy()}: the next values of the
 * same plots or others; plots of another design, drawn behind those of the same name.
 */
export function createPlots(host, packed, {clock}) {
  const theme = watchTheme(host, () => panels.forEach(panel => panel.draw()));
  let panels = [], shape = "", names = [], reference = null;

  function build(next) {
    panels.forEach(panel => panel.stop());
    panels = []; names = [];
    const boxes = grouped(next).map(({name, title, panels: own}) => {
      const made = own.map(panel => createPanel(panel, next.cycle, clock, theme));
      panels.push(...made); names.push(...made.map(() => name));
      return next.plots ? element("section", {class: "dw-group", "data-testid": `plot-${name}`, "aria-label": title, style: `--count: ${own.length}`},
        ...made.map(panel => panel.node)) : made[0].node;
    });
    host.classList.toggle("dw-grouped", !!next.plots);
    host.replaceChildren(...boxes);
  }

  function update(next) {
    const wanted = structure(next);
    if (wanted === shape) grouped(next).flatMap(group => group.panels).forEach((panel, n) => panels[n].update(panel, next.cycle));
    else { build(next); shape = wanted; compare(reference); }
  }

  function compare(other) {
    reference = other;
    const theirs = new Map(other ? grouped(other).map(({name, panels: own}) => [name, own.map(unpacked)]) : []);
    panels.forEach((panel, n) => panel.compare(theirs.get(names[n]) || []));
  }

  host.classList.add("dw-plots");
  update(packed);
  const plots = {update, compare,
    destroy() { stop(); unwatch(); theme.stop(); clock.see(plots, false); panels.forEach(panel => panel.stop()); host.replaceChildren(); }};
  const unwatch = watchVisible(host, visible => clock.see(plots, visible));
  const stop = clock.subscribe(() => panels.forEach(panel => panel.show()));
  return plots;
}
