// The designs of a study as points: choose the axes, see what is feasible and what nothing beats, click to load a design.

import { figure, powered, supported, unitText } from "./numbers.js";
import { button } from "./parts.js";
import { element, fitCanvas, fixed, watchTheme } from "./player.js";
import { ticks } from "./plotting.js";
import { rangeOf, reachOf, sameRow, stretched } from "./scatter_rows.js";
import { circle, cross, rule, shade, shortened } from "./strokes.js";

const MARGIN = {left: 66, right: 18, top: 14, bottom: 46};
const NEAR = 14;     // pixels from a point that still mean it
const MANY = 3000;   // points from which they are drawn small
const SCALE = {light: ["#3b1f6b", "#2f5aa8", "#1f8f8c", "#5cb85c", "#d9c61f"], dark: ["#7a5fd0", "#4f8fe0", "#35b8b0", "#8fdc6a", "#fbe94e"]};
const SHADES = 24;

/** A value of a table, whatever it is. */
const shown = value => typeof value === "boolean" ? (value ? "✓" : "✗") : typeof value === "number" ? figure(value, 5) : value ?? "–";

const axisText = (column, t) => t(column.label) + (column.unit && column.unit !== "-" ? ` [${column.unit === "deg" ? "°" : column.unit}]` : "");

/** A study with which columns are numbers; the rows of a running one have no front yet. */
function prepare(answer) {
  const numeric = answer.columns.map((_, n) => answer.rows.some(row => Number.isFinite(row[n])));
  return {...answer, ends: answer.ends || {}, fronts: answer.fronts || [], feasible: answer.passes, numeric};
}

/** The scatter inside `host`; load(answer), destroy().  `now()` gives {name of a column: its number} of the current design. */
export function createScatter(host, {say, t, now = () => ({})}) {
  const canvas = element("canvas", {class: "sc-canvas", tabindex: 0, role: "img",
    "aria-label": t("Designs of the study: point at one to see it, click to load it, arrow keys walk along the front")});
  const over = element("canvas", {class: "sc-over", "aria-hidden": "true"}), area = element("div", {class: "sc-area"}, canvas, over);
  const legend = element("div", {class: "sc-legend"}), counts = element("span", {class: "pn-about"}), side = element("aside", {class: "sc-side"});
  const names = [t("Across"), t("Up"), t("Colour")], selects = names.map(() => element("select", {class: "pn-select"}));
  const bar = element("div", {class: "sc-bar"}, ...names.map((text, n) => element("label", {}, element("span", {}, text), selects[n])), counts);
  const state = {study: null, x: 0, y: 1, colour: -1, hover: -1, chosen: -1, ranges: null};
  host.classList.add("sc");
  host.replaceChildren(bar, element("div", {class: "sc-main"}, element("div", {class: "sc-plot"}, area, legend), side));
  const surface = fitCanvas(canvas, () => draw()), upper = fitCanvas(over, () => mark()), theme = watchTheme(host, () => { draw(); mark(); });
  const scaleNow = () => SCALE[parseInt(theme.colours.surface.slice(1, 3), 16) < 128 ? "dark" : "light"];

  // -- places ----------------------------------------------------------------------------------------------------------------
  const inner = () => ({w: surface.width - MARGIN.left - MARGIN.right, h: surface.height - MARGIN.top - MARGIN.bottom});
  const toX = value => MARGIN.left + (value - state.ranges.x[0]) / (state.ranges.x[1] - state.ranges.x[0]) * inner().w;
  const toY = value => MARGIN.top + (state.ranges.y[1] - value) / (state.ranges.y[1] - state.ranges.y[0]) * inner().h;
  const place = row => [toX(row[state.x]), toY(row[state.y])];
  const within = (value, [low, high]) => value >= low && value <= high;
  /** Whether a row has both numbers, and whether these lie within the axes. */
  const placed = row => Number.isFinite(row[state.x]) && Number.isFinite(row[state.y]);
  const inView = row => within(row[state.x], state.ranges.x) && within(row[state.y], state.ranges.y);
  const front = () => {
    const {fronts, columns} = state.study, pair = [columns[state.x].name, columns[state.y].name];
    return fronts.find(front => pair.every(name => front.objectives.some(goal => goal.name === name))) || fronts[0];
  };

  // -- drawing ---------------------------------------------------------------------------------------------------------------
  function draw() {
    const {context, ratio, width, height} = surface;
    if (!state.study || width < 2) return;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    axes(context, theme.colours);
    points(context, theme.colours);
    best(context, theme.colours);
  }

  function axes(context, colours) {
    const {w, h} = inner(), {columns} = state.study, column = {x: columns[state.x], y: columns[state.y]};
    const across = ticks(...state.ranges.x, Math.max(2, w / 90), unitText(column.x.unit));
    const up = ticks(...state.ranges.y, Math.max(2, h / 52), unitText(column.y.unit));
    const text = (value, decimals) => Math.abs(value) >= 1e5 || decimals > 5 ? powered(value, 1) : fixed(value, decimals);
    context.font = "11px system-ui, sans-serif"; context.lineWidth = 1; context.strokeStyle = colours.grid; context.fillStyle = colours.muted;
    context.textAlign = "center"; context.textBaseline = "top";
    for (const value of across.values) {
      rule(context, toX(value), MARGIN.top, toX(value), MARGIN.top + h);
      context.fillText(text(value, across.decimals), toX(value), MARGIN.top + h + 7);
    }
    context.textAlign = "right"; context.textBaseline = "middle";
    for (const value of up.values) {
      rule(context, MARGIN.left, toY(value), MARGIN.left + w, toY(value));
      context.fillText(text(value, up.decimals), MARGIN.left - 8, toY(value));
    }
    context.strokeStyle = colours["grid-strong"];
    context.strokeRect(MARGIN.left + 0.5, MARGIN.top + 0.5, Math.round(w), Math.round(h));
    labels(context, colours, axisText(column.x, t), axisText(column.y, t));
  }

  /** What the axes are: below, and on the left, turned. */
  function labels(context, colours, below, left) {
    const {w, h} = inner();
    context.fillStyle = colours.ink; context.font = "600 12px system-ui, sans-serif"; context.textAlign = "center"; context.textBaseline = "bottom";
    context.fillText(shortened(context, below, w + 40), MARGIN.left + w / 2, surface.height - 6);
    context.save();
    context.translate(15, MARGIN.top + h / 2); context.rotate(-Math.PI / 2); context.textBaseline = "middle";
    context.fillText(shortened(context, left, h + 10), 0, 0);
    context.restore();
  }

  /** What colour each row has: by the column in as many shades, or by whether it is feasible. */
  function groups(colours) {
    const {rows, feasible} = state.study, found = new Map(), scale = scaleNow(), [low, high] = state.ranges.colour;
    const good = getComputedStyle(host).getPropertyValue("--good").trim(), plain = n => feasible[n] ? good : colours.bad;
    rows.forEach((row, n) => {
      const value = row[state.colour], known = state.colour >= 0 && Number.isFinite(value);
      const level = known ? Math.round((SHADES - 1) * (high > low ? (value - low) / (high - low) : 0.5)) : -1;
      const colour = level >= 0 ? shade(scale, level / (SHADES - 1)) : state.colour >= 0 ? colours.muted : plain(n), name = `${colour}${feasible[n]}`;
      if (!found.has(name)) found.set(name, {colour, feasible: feasible[n], rows: []});
      found.get(name).rows.push(row);
    });
    return [...found.values()].sort((a, b) => a.feasible - b.feasible);
  }

  function points(context, colours) {
    const many = state.study.rows.length > MANY, radius = many ? 1.8 : 3, arm = many ? 1.7 : 2.6;
    for (const {colour, feasible, rows} of groups(colours)) {
      context.beginPath();
      for (const row of rows) {
        if (!inView(row)) continue;
        const [x, y] = place(row);
        if (feasible) { context.moveTo(x + radius, y); context.arc(x, y, radius, 0, 2 * Math.PI); }
        else for (const way of [1, -1]) { context.moveTo(x - arm, y - way * arm); context.lineTo(x + arm, y + way * arm); }
      }
      context.fillStyle = context.strokeStyle = colour; context.lineWidth = 1;
      context.globalAlpha = feasible ? 0.85 : many ? 0.3 : 0.45;
      feasible ? context.fill() : context.stroke();
    }
    context.globalAlpha = 1;
  }

  /** The front: joined where it is one of these two axes, its points ringed. */
  function best(context, colours) {
    const found = front();
    if (!found) return;
    const list = found.rows.map(n => place(state.study.rows[n])).filter(([x, y]) => Number.isFinite(x + y)).sort((a, b) => a[0] - b[0]);
    const isGoal = n => found.objectives.some(goal => goal.name === state.study.columns[n].name);
    context.strokeStyle = colours.ink; context.lineWidth = 1.6;
    if (found.objectives.length === 2 && isGoal(state.x) && isGoal(state.y)) {
      context.beginPath();
      for (const [x, y] of list) context.lineTo(x, y);
      context.stroke();
    }
    for (const [x, y] of list) {
      circle(context, x, y, 4.6); context.fillStyle = colours.canvas; context.fill(); context.stroke();
      circle(context, x, y, 2.2); context.fillStyle = colours.ink; context.fill();
    }
  }

  /** The 95 % intervals of a row along both axes. */
  function bars(context, n, colour) {
    const {ends, columns, rows} = state.study, [x, y] = place(rows[n]), [across, up] = [state.x, state.y].map(k => ends[columns[k].name]?.[n]);
    context.strokeStyle = colour; context.lineWidth = 1.4;
    if (across) rule(context, toX(across[0]), y, toX(across[1]), y);
    if (up) rule(context, x, toY(up[0]), x, toY(up[1]));
  }

  /** Over the points: the current design, the chosen row, the row under the mouse. */
  function mark() {
    const {context, ratio, width, height} = upper;
    if (!state.study || width < 2) return;
    const {colours} = theme, {rows, columns} = state.study, current = now();
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    const x = toX(current[columns[state.x].name]), y = toY(current[columns[state.y].name]);
    const inside = (at, low, high) => Math.min(Math.max(at, low), high);
    if (Number.isFinite(x + y))
      cross(context, inside(x, MARGIN.left, width - MARGIN.right), inside(y, MARGIN.top, height - MARGIN.bottom), colours.cursor);
    for (const [n, colour] of [[state.chosen, colours.accent], [state.hover, colours.ink]]) if (n >= 0 && rows[n]) {
      bars(context, n, colour);
      circle(context, ...place(rows[n]), 8);
      context.strokeStyle = colour; context.lineWidth = 2.2; context.stroke();
    }
  }

  // -- around it -------------------------------------------------------------------------------------------------------------
  function keyOf() {
    const {study} = state, column = study.columns[state.colour], parts = [];
    const entry = (kind, text) => element("span", {class: `sc-key is-${kind}`}, element("i"), text);
    parts.push(entry("good", t("meets all checks")), entry("bad", t("fails a check")));
    if (front()) parts.push(entry("front", t("Pareto front")));
    const current = now();
    if ([state.x, state.y].every(n => Number.isFinite(current[study.columns[n].name]))) parts.push(entry("now", t("this design")));
    const beyond = study.rows.filter(row => placed(row) && !inView(row)).length;
    if (beyond) parts.push(element("span", {class: "sc-beyond"}, t("* lie beyond the axes", beyond)));
    if (column) {
      const [low, high] = state.ranges.colour, band = element("i", {style: `background: linear-gradient(90deg, ${scaleNow().join(", ")})`});
      parts.push(element("span", {class: "sc-key is-scale"}, `${shown(low)} `, band, ` ${shown(high)}${unitText(column.unit)}`));
    }
    legend.classList.toggle("by-column", Boolean(column));
    legend.replaceChildren(...parts);
  }

  function line([column, value, ends]) {
    const bad = column.role === "check" && (value === false || value < 0), unit = typeof value === "number" ? unitText(column.unit) : "";
    return element("div", {class: `sd-number${bad ? " is-bad" : ""}`}, element("span", {title: column.name}, t(column.label)), element("em"),
      element("b", {}, `${ends ? t("* (* to *)", ...[value, ...ends].map(each => supported(each, ends))) : shown(value)}${unit}`));
  }
  /** Table of a row; what it is told for stays until another is chosen. */
  function table() {
    const {study, hover, chosen} = state, n = hover >= 0 ? hover : chosen;
    if (n < 0 || !study.rows[n]) return side.replaceChildren(element("p", {class: "pn-about"}, t("Point at a design to see it; click to load it.")));
    const known = study.columns.map((column, k) => [column, study.rows[n][k] ?? "", study.ends[column.name]?.[n]]).filter(([, value]) => value !== "");
    const list = [["key", t("Dimensions")], ["value", t("Values")], ["check", t("Margins of checks")]].flatMap(([role, title]) => {
      const some = known.filter(([column]) => column.role === role);
      return some.length ? [element("h4", {}, title), ...some.map(line)] : [];
    });
    const load = button(n === chosen ? t("Load again") : t("Load this design"), () => take(n), {look: "main"});
    side.replaceChildren(element("p", {class: `sc-row is-${study.feasible[n] ? "good" : "bad"}`}, `${t("Design")} ${n + 1}`), load, ...list);
  }

  function nearest(x, y) {
    let found = -1, least = NEAR * NEAR;
    const preferred = new Set(front()?.rows || []);
    state.study.rows.forEach((row, n) => {
      if (!inView(row)) return;
      const [px, py] = place(row), d = (px - x) ** 2 + (py - y) ** 2 - (preferred.has(n) ? 16 : 0);
      if (d < least) { least = d; found = n; }
    });
    return found;
  }
  function hover(n) {
    if (n === state.hover) return;
    state.hover = n;
    over.parentNode.style.cursor = n >= 0 ? "pointer" : "";
    mark(); table();
  }
  function take(n) {
    if (n < 0 || !state.study.load?.[n]) return;
    state.chosen = n;
    say({what: "load", changes: state.study.load[n]});
    mark(); table();
  }
  canvas.addEventListener("pointermove", event => { if (state.study) hover(nearest(event.offsetX, event.offsetY)); });
  canvas.addEventListener("pointerleave", () => hover(-1));
  canvas.addEventListener("click", event => { if (state.study) take(nearest(event.offsetX, event.offsetY)); });
  /** To the next design along the front, or of all where there is none. */
  function walk(step) {
    const {rows} = state.study, list = front()?.rows.length ? front().rows : rows.map((_, n) => n);
    const order = [...list].sort((a, b) => rows[a][state.x] - rows[b][state.x]), at = order.indexOf(state.hover);
    hover(order[Math.min(Math.max(at < 0 ? 0 : at + step, 0), order.length - 1)]);
  }
  canvas.addEventListener("keydown", event => {
    const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key];
    if (state.study && step) walk(step);
    else if (event.key === "Enter" && state.hover >= 0) take(state.hover);
    else return;
    event.preventDefault();
  });

  function choose() {
    [state.x, state.y, state.colour] = selects.map(select => +select.value);
    measure();
    keyOf(); draw(); mark();
  }
  /** The axes reach over the points and the current design; whether that is another stretch than before. */
  function measure() {
    const {rows, columns, feasible} = state.study, current = now(), before = state.ranges;
    const reach = n => stretched(columns[n].role === "key" ? rangeOf(rows, n) : reachOf(rows, feasible, n), current[columns[n].name]);
    state.ranges = {x: reach(state.x), y: reach(state.y), colour: state.colour >= 0 ? rangeOf(rows, state.colour, 0) : [0, 1]};
    return JSON.stringify(before) !== JSON.stringify(state.ranges);
  }
  selects.forEach(select => select.addEventListener("change", choose));

  /** Axes to begin with: the objectives of the front, else what varies against the first value. */
  function begin(names) {
    const {columns, numeric, fronts} = state.study, at = name => columns.findIndex(column => column.name === name);
    const first = role => columns.findIndex((column, n) => column.role === role && numeric[n]);
    const options = columns.flatMap((column, n) => numeric[n] ? [[n, axisText(column, t)]] : []), any = options[0]?.[0] ?? 0;
    const fill = (select, more) => select.replaceChildren(...[...more, ...options].map(([n, text]) => element("option", {value: n}, text)));
    const [a, b] = fronts[0]?.objectives.length >= 2 ? fronts[0].objectives.map(goal => at(goal.name)) : [first("key"), first("value")];
    const usual = [a >= 0 ? a : any, b >= 0 ? b : options[1]?.[0] ?? any, -1];
    fill(selects[0], []); fill(selects[1], []); fill(selects[2], [[-1, t("feasible or not")]]);
    selects.forEach((select, k) => { select.value = String(numeric[at(names[k])] ? at(names[k]) : usual[k]); });
  }

  return {
    load(answer) {
      // The axes of a running study make place for the objectives, and those that knew no values yet for the first value.
      const before = state.study, valued = before?.columns.some(({role}) => role === "value");
      const first = !before?.fronts.length && answer.fronts?.length || !valued;
      const names = [state.x, state.y, state.colour].map(n => before && !first ? before.columns[n]?.name : undefined);
      state.study = prepare(answer);
      state.hover = sameRow(before, state.hover, answer); state.chosen = sameRow(before, state.chosen, answer);
      begin(names);
      const met = state.study.feasible.filter(Boolean).length;
      const failed = answer.failed ? [t("* failed", answer.failed)] : [];
      counts.textContent = [t("* of * designs", answer.rows.length, answer.total), t("* feasible", met), ...failed].join(" · ");
      choose(); table();
    },
    mark() { if (state.study) { if (measure()) draw(); keyOf(); mark(); } },
    destroy() { surface.stop(); upper.stop(); theme.stop(); host.replaceChildren(); },
  };
}
