// The lift diagram with velocity, acceleration and jerk below it, on one axis.

import { placeOf } from "./motion_points.js";
import { fitCanvas, fixed, useFont } from "./player.js";
import { ticks } from "./plotting.js";

const MARGIN = {left: 58, right: 16, top: 30, bottom: 34}, GAP = 22;
const SHARE = [0.4, 0.2, 0.2, 0.2], ROLES = ["blue", "orange", "green", "violet"], FONT = "11px system-ui, sans-serif";

/**
 * The drawing on a canvas; `changed()` after each change of its size.  `toX(angle)`, `toY(lift)` and back give pixels of the lift diagram, of angles
 * from the start of the first segment: a programme with an `origin` begins there on the axis, and what reaches over its end goes on at its beginning.
 */
export function createMotionPlot(canvas, changed) {
  const surface = fitCanvas(canvas, () => { draw(); changed(); });
  let shown = null, colours = null;  // {programme, jumps, peaks, selected, titles, units: factor of each row, axis}

  const inner = () => ({w: Math.max(surface.width - MARGIN.left - MARGIN.right, 10), h: Math.max(surface.height - MARGIN.top - MARGIN.bottom - 3 * GAP, 40)});
  /** Top and height of a row. */
  function rowAt(row) {
    const {h} = inner(), above = SHARE.slice(0, row).reduce((sum, part) => sum + part, 0);
    return [MARGIN.top + above * h + row * GAP, SHARE[row] * h];
  }
  const span = () => shown.programme.cycle.span;
  const origin = () => shown.programme.origin ?? null, turned = angle => angle - Math.floor(angle / span() + 1e-9) * span();
  const scaled = angle => MARGIN.left + angle / span() * inner().w;
  const toX = angle => scaled(origin() === null ? angle : turned(angle + origin())), fromX = x => (x - MARGIN.left) / inner().w * span() - (origin() ?? 0);
  /** Pixels by which the courses are drawn aside of where they would begin at the left edge: twice where they reach over the right one. */
  const shifts = () => origin() === null ? [0] : [0, -1].map(turn => (turned(origin()) / span() + turn) * inner().w);
  /** [from, to] pixels of the visible parts of an interval of angles. */
  function parts(start, end) {
    const {w} = inner(), found = shifts().map(shift => [start, end].map(angle => Math.min(Math.max(scaled(angle) + shift, MARGIN.left), MARGIN.left + w)));
    return found.filter(([from, to]) => to - from > 0.5);
  }
  function range(row) {
    let low = Infinity, high = -Infinity;
    for (const {course} of shown.programme.segments) for (const value of course[row + 1]) { if (value < low) low = value; if (value > high) high = value; }
    if (row > 0) { low = Math.min(low, 0); high = Math.max(high, 0); }
    const room = 0.08 * (high - low) || 1e-3;
    return [low - room, high + room];
  }
  let ranges = [];
  const toYof = (row, value) => { const [top, tall] = rowAt(row), [low, high] = ranges[row]; return top + (high - value) / (high - low) * tall; };
  const toY = lift => toYof(0, lift), fromY = y => { const [top, tall] = rowAt(0), [low, high] = ranges[0]; return high - (y - top) / tall * (high - low); };

  function show(next, theme) { shown = next; colours = theme; if (!shown.held || !ranges.length) ranges = [0, 1, 2, 3].map(range); else ranges = ranges.map((old, row) => row ? range(row) : old); draw(); }

  function rule(context, x0, y0, x1, y1, colour, width = 1) {
    context.strokeStyle = colour; context.lineWidth = width;
    context.beginPath(); context.moveTo(Math.round(x0) + 0.5, Math.round(y0) + 0.5); context.lineTo(Math.round(x1) + 0.5, Math.round(y1) + 0.5); context.stroke();
  }
  function grid(context, row) {
    const [top, tall] = rowAt(row), {w} = inner(), factor = shown.factors[row], [low, high] = ranges[row], {cycle} = shown.programme;
    const up = ticks(low * factor, high * factor, Math.max(2, tall / 26), ""), across = ticks(0, span() * cycle.factor, Math.max(2, Math.min(8, w / 62)), cycle.unit);
    useFont(context, FONT); context.textBaseline = "middle"; context.textAlign = "right";
    for (const value of up.values) {
      const y = toYof(row, value / factor);
      rule(context, MARGIN.left, y, MARGIN.left + w, y, value === 0 ? colours["grid-strong"] : colours.grid);
      context.fillStyle = colours.muted;
      context.fillText(Math.abs(value) >= 1e5 ? value.toExponential(0).replace("e+", "e").replace("-", "−") : fixed(value, up.decimals), MARGIN.left - 7, y);
    }
    for (const value of across.values) {
      const x = scaled(value / cycle.factor);
      rule(context, x, top, x, top + tall, colours.grid);
      if (row < 3) continue;
      context.textAlign = x > MARGIN.left + w - 12 ? "right" : "center"; context.textBaseline = "top"; context.fillStyle = colours.muted;
      context.fillText(fixed(value, across.decimals) + (cycle.unit === "°" ? "°" : ""), x > MARGIN.left + w - 12 ? MARGIN.left + w + 12 : x, top + tall + 5);
    }
    if (row === 3) { context.textAlign = "center"; context.fillText(shown.axis, MARGIN.left + w / 2, top + tall + 19); }
  }
  function title(context, row) {
    const [top] = rowAt(row), {w} = inner(), [name, peak] = shown.titles[row];
    context.textBaseline = "alphabetic"; useFont(context, `600 ${FONT}`); context.fillStyle = colours.ink; context.textAlign = "left";
    if (row) context.fillText(name, MARGIN.left, top - 6);
    context.textAlign = "right"; useFont(context, FONT); context.fillStyle = peak.includes("∞") ? colours.bad : colours.muted;
    if (row) context.fillText(peak, MARGIN.left + w, top - 6);
  }
  function curve(context, row) {
    const {w} = inner(), [top, tall] = rowAt(row);
    context.strokeStyle = colours[ROLES[row]]; context.lineWidth = 1.8; context.lineJoin = "round";
    context.save();
    context.beginPath(); context.rect(MARGIN.left, top - GAP, w, tall + 2 * GAP); context.clip();
    for (const shift of shifts()) {
      context.beginPath();
      for (const {course} of shown.programme.segments) {
        const [theta] = course, values = course[row + 1];
        for (let i = 0; i < theta.length; i++) context.lineTo(scaled(theta[i]) + shift, toYof(row, values[i]));
      }
      context.stroke();
    }
    context.restore();
  }
  /** The points of splines and tables, as dots upon the lift. */
  function dots(context) {
    context.fillStyle = colours.ink;
    for (const segment of shown.programme.segments) for (let k = 0; k < (segment.nodes?.at.length || 0); k++) {
      const [angle, lift] = placeOf(segment, k);
      context.beginPath(); context.arc(toX(angle), toYof(0, lift), 1.7, 0, 2 * Math.PI); context.fill();
    }
  }
  /** A stripe where a derivative jumps: red for the velocity, amber for the acceleration. */
  function jumps(context) {
    for (const {at, order} of shown.jumps) {
      const [top] = rowAt(order), [last, tall] = rowAt(3), x = toX(at);
      context.globalAlpha = 0.8; context.setLineDash([3, 3]);
      rule(context, x, top, x, last + tall, order === 1 ? colours.bad : colours.warn, 1.6);
      context.setLineDash([]); context.globalAlpha = 1;
    }
  }
  function draw() {
    const {context, ratio, width, height} = surface;
    if (!shown || !colours || width < 2) return;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    const [last, tall] = rowAt(3), chosen = shown.programme.segments[shown.selected];
    context.fillStyle = colours.raised;
    for (const [from, to] of chosen ? parts(chosen.start, chosen.end) : []) context.fillRect(from, MARGIN.top, to - from, last + tall - MARGIN.top);
    for (const row of [0, 1, 2, 3]) grid(context, row);
    for (const {start} of shown.programme.segments.slice(origin() === null ? 1 : 0)) rule(context, toX(start), MARGIN.top - 6, toX(start), last + tall, colours.muted);
    jumps(context);
    for (const row of [0, 1, 2, 3]) { curve(context, row); title(context, row); }
    dots(context);
  }
  return {show, draw, parts, toX, fromX, toY, fromY, rowAt, width: () => surface.width, bottom: () => { const [top, tall] = rowAt(3); return top + tall; }, stop() { surface.stop(); }};
}
