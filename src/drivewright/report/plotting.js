// Drawing of one panel of a plot on a canvas, or on whatever has the same methods: axes, limits, curves, points, bars.

import { fixed, floats, locate, useFont } from "./clock.js";

const MARGIN = {left: 52, right: 14, top: 6, bottom: 36};
const FONT = "11px system-ui, sans-serif", BAR = 0.72, SINGLE = 3.5;  // of the room that a bar has; px of a point that no line joins

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

const scientific = (value, digits) => value.toExponential(digits).replace("e+", "e").replace(/-/g, "−");
const tickText = (value, decimals) => Math.abs(value) >= 1e5 || (value !== 0 && decimals > 5) ? scientific(value, 1) : fixed(value, decimals);
export const unitText = unit => unit.startsWith("°") || !unit ? unit : ` ${unit}`;

/** The panel with arrays instead of text. */
export const unpacked = panel => ({...panel, u: floats(panel.u), phase: panel.phase && floats(panel.phase),
  series: panel.series.map(series => ({...series, x: series.x && floats(series.x), values: floats(series.data), ends: (series.ends || []).map(floats)}))});

/** The axis of a panel: its own, or the cycle, along which places are 0 ... 1. */
export function axisOf({axis}, cycle) {
  if (axis) return {...axis, scale: 1, start: 0, from: axis.low, to: axis.high, marks: []};
  return {label: cycle.label, unit: cycle.unit, start: cycle.start, scale: cycle.span, from: 0, to: 1, names: null, places: [], marks: cycle.marks};
}

/** Value of a line at a place of its axis; none where it does not reach. */
export function valueAt(u, values, place) {
  const air = 1e-3 * Math.abs(u[u.length - 1] - u[0]);
  if (!(place >= u[0] - air && place <= u[u.length - 1] + air)) return NaN;
  if (u.length < 2) return values[0];
  const [low, part] = locate(u, place);
  return values[low] + part * (values[low + 1] - values[low]);
}

/** Number of the point of a line nearest to a place; -1 where there is none. */
export function nearest(u, values, place) {
  let best = Infinity, at = -1;
  for (let i = 0; i < u.length; i++) {
    const away = Math.abs(u[i] - place);
    if (away < best && Number.isFinite(values[i])) { best = away; at = i; }
  }
  return at;
}

export const isRising = u => { for (let i = 1; i < u.length; i++) if (u[i] < u[i - 1]) return false; return true; };

/**
 * Where things of a panel stand on a surface: `panel` unpacked, `axis` of axisOf, `behind` [{lines: for each line {u, values, low, high} or
 * nothing, colour, dash}], `width` and `height` in px, `margin`, and `ends` [from, to] of the x axis where another stretch is shown.
 */
export function layout(panel, axis, behind, {width, height, margin = MARGIN, ends}) {
  const others = behind.flatMap(({lines}) => lines.filter(Boolean));
  const w = width - margin.left - margin.right, h = height - margin.top - margin.bottom;
  let low = Math.min(panel.low, ...others.map(one => one.low)), high = Math.max(panel.high, ...others.map(one => one.high));
  let [from, to] = ends || [Math.min(axis.from, ...others.map(one => one.from ?? axis.from)), Math.max(axis.to, ...others.map(one => one.to ?? axis.to))];
  if (panel.equal && w > 0 && h > 0) {
    const step = Math.max((to - from) / w, (high - low) / h), x = (from + to) / 2, y = (low + high) / 2;
    [from, to, low, high] = [x - step * w / 2, x + step * w / 2, y - step * h / 2, y + step * h / 2];
  }
  const tall = value => !panel.log ? value : value > 0 ? Math.log10(value) : NaN;  // where a value stands on the axis
  const top = tall(high), foot = tall(low);
  return {w, h, low, high, from, to, margin,
    toX: place => margin.left + (place - from) / (to - from) * w,
    toY: value => margin.top + (top - tall(value)) / (top - foot) * h,
    placeAt: x => from + (x - margin.left) / w * (to - from)};
}

// ---------------------------------------------------------------------------------------------------------------------- axes

function rule(context, x0, y0, x1, y1, colour) {
  context.strokeStyle = colour;
  context.beginPath(); context.moveTo(Math.round(x0) + 0.5, Math.round(y0) + 0.5); context.lineTo(Math.round(x1) + 0.5, Math.round(y1) + 0.5); context.stroke();
}

/** Ticks across: values of the axis, or texts that stand for places. */
function across(axis, {from, to, w}) {
  if (axis.names) {
    const every = Math.ceil((to - from) * 46 / Math.max(w, 1));
    return axis.names.map((text, n) => [n, text]).filter(([n]) => n % every === 0);
  }
  const [a, b] = [axis.start + from * axis.scale, axis.start + to * axis.scale];
  const found = ticks(Math.min(a, b), Math.max(a, b), Math.max(2, Math.min(8, w / 62)), axis.unit);
  return found.values.map(value => [(value - axis.start) / axis.scale, tickText(value, found.decimals) + (axis.unit === "°" ? "°" : "")]);
}

function axes(context, panel, axis, at, colours, foot) {
  const {w, h, margin, low, high, toX, toY} = at;
  const up = panel.log ? powers(low, high) : ticks(low, high, Math.max(h < 60 ? 3 : 2, h / 23), panel.series[0].unit);
  useFont(context, FONT); context.lineWidth = 1;
  phases(context, axis, at, colours);
  context.fillStyle = colours.line;
  for (const [start, stop] of panel.shade) context.fillRect(toX(start), margin.top, Math.max(toX(stop) - toX(start), 0.5), h);
  context.fillStyle = colours.muted;
  context.textAlign = "right"; context.textBaseline = "middle";
  for (const value of up.values) {
    rule(context, margin.left, toY(value), margin.left + w, toY(value), value === 0 ? colours["grid-strong"] : colours.grid);
    context.fillText(panel.log ? scientific(value, 0) : tickText(value, up.decimals), margin.left - 7, toY(value), margin.left - 8);  // a long one narrower
  }
  context.textBaseline = "top";
  for (const [place, text] of across(axis, at)) {
    const x = toX(place);
    rule(context, x, margin.top, x, margin.top + h, colours.grid);
    if (!foot) continue;
    context.textAlign = x > margin.left + w - 12 ? "right" : "center";
    context.fillText(text, x > margin.left + w - 12 ? margin.left + w + 12 : x, margin.top + h + 5);
  }
  if (!foot) return;
  context.textAlign = "center";
  context.fillText(axis.label + (axis.unit && axis.unit !== "°" ? ` [${axis.unit}]` : ""), margin.left + w / 2, margin.top + h + 20);
}

function phases(context, {marks}, {margin, h, toX}, colours) {
  context.fillStyle = colours.raised; context.globalAlpha = 0.6;
  if (marks.length > 1) marks.forEach(([start], n) => {
    const stop = n + 1 < marks.length ? marks[n + 1][0] : 1;
    if (n % 2 === 0) context.fillRect(toX(start), margin.top, toX(stop) - toX(start), h);
  });
  context.globalAlpha = 1;
}

/** Names of what stands along the axis, each beside its line, the last one before it where it would end outside; one that has no room is left out. */
function places(context, axis, {margin, w, h, toX}, colours, named) {
  let free = -Infinity;
  useFont(context, FONT); context.textAlign = "left"; context.textBaseline = "top"; context.lineWidth = 1;
  for (const [at, name] of axis.places) {
    const x = toX(at);
    context.setLineDash([2, 3]);
    rule(context, x, margin.top, x, margin.top + h, colours.muted);
    context.setLineDash([]);
    const wide = named ? context.measureText(name).width : 0, from = x + 3 + wide > margin.left + w + margin.right ? x - 3 - wide : x + 3;
    if (!named || from < free) continue;
    context.fillStyle = colours.muted;
    context.fillText(name, from, margin.top + 1);
    free = from + 6 + wide;
  }
}

function limits(context, panel, {w, margin, toY}, colours) {
  useFont(context, FONT); context.textAlign = "right";
  for (const [value, text] of panel.limits) {
    const y = toY(value), above = y > margin.top + 18;
    context.setLineDash([6, 4]); context.lineWidth = 1.2;
    rule(context, margin.left, y, margin.left + w, y, colours.bad);
    context.setLineDash([]);
    const wide = context.measureText(text).width;
    context.fillStyle = colours.surface; context.globalAlpha = 0.75;
    context.fillRect(margin.left + w - wide - 6, y + (above ? -16 : 3), wide + 6, 13);
    context.fillStyle = colours.bad; context.globalAlpha = 1; context.textBaseline = above ? "bottom" : "top";
    context.fillText(text, margin.left + w - 3, y + (above ? -3 : 4));
  }
}

// --------------------------------------------------------------------------------------------------------------------- lines

const point = (at, u, values, i) => [at.toX(u[i]), Math.max(-1e4, Math.min(1e4, at.toY(values[i])))];

/** A line with its gaps; a point between two gaps is a dot. */
function curve(context, at, u, values) {
  const single = [];
  let length = 0, last = null;  // of the stretch that has begun
  const end = () => { if (length === 1) single.push(last); length = 0; };
  context.beginPath();
  for (let i = 0; i < u.length; i++) {
    const [x, y] = point(at, u, values, i);
    if (!Number.isFinite(y) || !Number.isFinite(x)) { end(); continue; }
    length ? context.lineTo(x, y) : context.moveTo(x, y);
    length += 1; last = [x, y];
  }
  end();
  context.stroke();
  for (const place of single) dot(context, place, SINGLE);
}

function dot(context, [x, y], size) { context.beginPath(); context.arc(x, y, size, 0, 2 * Math.PI); context.fill(); }

/** The 95 % intervals of a line as a band; of single points as error bars. */
function intervals(context, at, u, [low, high], isolated) {
  context.globalAlpha = isolated ? 0.8 : 0.2; context.setLineDash([]); context.lineWidth = 1;
  const known = i => Number.isFinite(low[i]) && Number.isFinite(high[i]);
  if (isolated) for (let i = 0; i < u.length; i++) {
    if (!known(i)) continue;
    const [x, y0] = point(at, u, low, i), [, y1] = point(at, u, high, i);
    context.beginPath(); context.moveTo(x, y0); context.lineTo(x, y1);
    for (const y of [y0, y1]) { context.moveTo(x - 3, y); context.lineTo(x + 3, y); }
    context.stroke();
  } else for (let i = 0; i < u.length;) {
    let stop = i;
    while (stop < u.length && known(stop)) stop++;
    context.beginPath();
    for (let k = i; k < stop; k++) context.lineTo(...point(at, u, high, k));
    for (let k = stop - 1; k >= i; k--) context.lineTo(...point(at, u, low, k));
    context.fill();
    i = stop + 1;
  }
  context.globalAlpha = 1;
}

/** Points, and below them the stems that they stand on. */
function marks(context, panel, at, u, values, size = 1.8) {
  const foot = at.toY(panel.log ? at.low : 0);
  for (let i = 0; i < u.length; i++) {
    const [x, y] = point(at, u, values, i);
    if (!Number.isFinite(y)) continue;
    dot(context, [x, y], size);
    if (panel.style === "stems") { context.beginPath(); context.moveTo(x, foot); context.lineTo(x, y); context.stroke(); }
  }
}

/** Bars of all lines, one upon the other, those below zero downwards. */
function bars(context, panel, at, colours) {
  const {u} = panel, wide = Math.max(1, BAR * (u.length > 1 ? Math.abs(at.toX(u[1]) - at.toX(u[0])) : at.w / 3));
  const up = new Float64Array(u.length), down = new Float64Array(u.length);
  for (const {values, role} of panel.series) {
    context.fillStyle = colours[role];
    for (let i = 0; i < u.length; i++) {
      if (!Number.isFinite(values[i])) continue;
      const stack = values[i] < 0 ? down : up, y0 = at.toY(stack[i]), y1 = at.toY(stack[i] += values[i]);
      context.fillRect(at.toX(u[i]) - wide / 2, Math.min(y0, y1), wide, Math.abs(y1 - y0));
    }
  }
}

/** What a line of the panel runs over. */
export const runOf = (panel, {x}) => x || panel.u;

function curves(context, panel, behind, at, colours) {
  const {w, h, margin} = at, joined = panel.style === "line";
  context.save();
  context.beginPath(); context.rect(margin.left, margin.top, w, h); context.clip();
  context.lineJoin = "round";
  if (panel.style === "bars") bars(context, panel, at, colours);
  for (const {lines, colour, dash} of behind) {
    context.strokeStyle = context.fillStyle = colours[colour]; context.lineWidth = 1.2; context.setLineDash(dash);
    for (const one of lines.filter(Boolean)) joined || panel.style === "bars" ? curve(context, at, one.u, one.values) : marks(context, panel, at, one.u, one.values);
  }
  for (const line of panel.style === "bars" ? [] : panel.series) {
    const {values, role, dashed, ends} = line, u = runOf(panel, line);
    context.strokeStyle = context.fillStyle = colours[role];
    if (ends.length) intervals(context, at, u, ends, !joined);
    context.setLineDash(dashed ? [5, 3] : []); context.lineWidth = dashed ? 1.2 : 1.8;
    joined || dashed ? curve(context, at, u, values) : marks(context, panel, at, u, values);
    context.setLineDash([]);
    if (joined && line.marked) marks(context, panel, at, u, values, 3);
  }
  context.restore();
}

/** Draws a panel; `at` is its layout.  `foot`: with what is said below the axis, `named`: with the names of what stands along it. */
export function paintPanel(context, panel, axis, behind, at, colours, {foot = true, named = true} = {}) {
  axes(context, panel, axis, at, colours, foot);
  places(context, axis, at, colours, named);
  curves(context, panel, behind, at, colours);
  limits(context, panel, at, colours);
}
