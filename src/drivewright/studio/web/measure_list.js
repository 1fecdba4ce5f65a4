// The panel of the measurements: what kind to make, what to pick next, and the list of those that there are, each with its course.

import { icon } from "./icons.js";
import { cycleText, panelOf, textOf } from "./measures.js";
import { button, pressable, put, same } from "./parts.js";
import { element, fixed } from "./player.js";
import { csvText, saveText, svgText } from "./plotfiles.js";
import { axisOf } from "./plotting.js";
import { createScaling } from "./scaling.js";

const SVG = "http://www.w3.org/2000/svg", WIDE = 200, TALL = 30, EDGE = 3;  // of the small plot

/** The panel; `acts` are {choose(kind), pick(feature), remove(id), close()}, `nameOfHandle(handle)` the name of a point that a hand can move. */
export function createMeasureList(tools, acts, nameOfHandle) {
  const {store, t, clock} = tools;
  const node = element("section", {class: "ms", "data-testid": "measure-panel", hidden: ""});
  node.addEventListener("keydown", event => { if (event.key !== "Escape") event.stopPropagation(); });  // the player has keys of its own
  let rows = new Map(), parts = null, state = null, told = [], phase = 0;

  const words = () => ({distance: t("Distance"), horizontal: t("Horizontal"), vertical: t("Vertical"), angle: t("Angle"), radius: t("Radius")});
  const hints = () => ({point: t("Pick a point on the drawing"), line: t("Pick the other edge"), circle: t("Pick a circle or an arc"), both: t("Pick three points, or two edges")});
  /** What a feature is called: its own name, or what it is a part of. */
  const nameOf = ({label, of, handle}) => handle ? nameOfHandle(handle) : label.includes("*") ? t(label, t(of)) : t(label) || t(of);

  function reword() {
    const kinds = words(), made = Object.entries(kinds).map(([kind, text]) => pressable({"data-kind": kind, "data-testid": `measure-${kind}`}, () => acts.choose(kind), text));
    const close = pressable({class: "ms-close", title: t("Stop measuring"), "aria-label": t("Stop measuring")}, acts.close, icon("cross"));
    const choice = element("select", {class: "pn-select", "data-testid": "measure-point", "aria-label": t("What to pick")});
    const take = button(t("Pick"), () => { const feature = state.features.find(({ref}) => ref === choice.value); if (feature) acts.pick(feature); }, {testid: "measure-pick"});
    parts = {
      kinds: element("div", {class: "ms-kinds", role: "group", "aria-label": t("What to measure")}, ...made), close, choice, take,
      hint: element("p", {class: "ms-hint", role: "status"}), list: element("ul", {class: "ms-list", "data-testid": "measure-list", "aria-label": t("Measurements")}),
    };
    parts.tool = element("div", {class: "ms-tool"}, element("div", {class: "ms-top"}, parts.kinds, close), parts.hint, element("div", {class: "ms-pick"}, choice, take));
    movable(parts.tool.firstChild, node);
    node.setAttribute("aria-label", t("Measurements"));
    node.replaceChildren(parts.tool, parts.list);
    rows = new Map();
    if (state) show(state);
  }

  /** All of it as it is now. */
  function show(next) {
    state = next;
    const {on, kind, picked, measures} = state;
    if (!on && !measures.length && node.hidden) return;
    node.hidden = !on && !measures.length;
    parts.tool.hidden = !on;
    for (const made of parts.kinds.children) made.setAttribute("aria-pressed", String(made.dataset.kind === kind));
    put(parts.hint, kind === "angle" && !picked.length ? hints().both : `${picked.length ? `${nameOf(picked.at(-1))} · ` : ""}${hints()[state.wanted[0]]}`);
    if (on) offer();
    if (!same([...rows.keys()], measures.map(({id}) => id))) arrange(measures);
    for (const measure of measures) fill(rows.get(measure.id), measure);
    parts.list.hidden = !measures.length;
  }
  /** What may be picked next, by name, for those who use no pointer. */
  function offer() {
    const {features, wanted} = state, fitting = features.filter(feature => wanted.includes(feature.kind)), names = new Map();
    const numbered = feature => {
      const name = `${nameOf(feature)}${feature.kind === "circle" ? ` R ${fixed(feature.radius * 1e3, 2)}` : ""}`, times = (names.get(name) || 0) + 1;
      names.set(name, times);
      return times > 1 ? `${name} (${times})` : name;
    };
    const mark = fitting.map(({ref}) => ref).join("\n");
    if (parts.choice.dataset.mark === mark) return;
    const before = parts.choice.value;
    parts.choice.dataset.mark = mark;
    parts.choice.replaceChildren(...fitting.map(feature => element("option", {value: feature.ref}, numbered(feature))));
    if (fitting.some(({ref}) => ref === before)) parts.choice.value = before;
  }

  // ---- rows
  function arrange(measures) {
    rows = new Map(measures.map(measure => [measure.id, rows.get(measure.id) || createRow(measure)]));
    parts.list.replaceChildren(...[...rows.values()].map(row => row.node));
  }
  function createRow({id, kind, role}) {
    const name = element("span", {class: "ms-name"}), value = element("b", {"data-testid": "measure-value"}), ends = element("small", {"data-testid": "measure-ends"});
    const range = element("span", {class: "ms-range", "data-testid": "measure-range"}), files = element("span", {class: "ms-files"});
    const plot = document.createElementNS(SVG, "svg"), path = document.createElementNS(SVG, "path"), cursor = document.createElementNS(SVG, "line");
    const drop = pressable({class: "ms-drop", "data-testid": "measure-drop"}, () => acts.remove(id), icon("cross"));
    plot.setAttribute("viewBox", `0 0 ${WIDE} ${TALL}`); plot.setAttribute("preserveAspectRatio", "none"); plot.setAttribute("class", "ms-plot"); plot.setAttribute("aria-hidden", "true");
    cursor.setAttribute("y1", 0); cursor.setAttribute("y2", TALL); cursor.setAttribute("class", "ms-cursor");
    plot.append(path, cursor);
    const follow = event => { const box = plot.getBoundingClientRect(); clock.pause(); clock.set((event.clientX - box.left) / box.width); };
    plot.addEventListener("pointerdown", event => { plot.setPointerCapture(event.pointerId); follow(event); });
    plot.addEventListener("pointermove", event => { if (plot.hasPointerCapture(event.pointerId)) follow(event); });
    const made = element("li", {class: "ms-row", "data-kind": kind, style: `--chip: var(--${role})`}, element("i", {}), name, value, drop, range, files, ends, plot);
    const row = {node: made, name, value, range, files, saves: [], ends, drop, path, plot, cursor};
    row.scale = createScaling(range, tools, () => lengthOf(state.measures.find(measure => measure.id === id)));
    row.saves = [["svg", "image/svg+xml", state => svgText(state, store.state.design.title)], ["csv", "text/csv", csvText]].map(([ending, type, text]) =>
      pressable({class: "bt-export", "data-testid": `measure-${ending}`}, () => saveText(`${store.state.design.name || store.state.design.kind}-${kind}.${ending}`, type, text(plotOf(id, role))), ending.toUpperCase()));
    files.append(row.scale.node, ...row.saves);
    return row;
  }
  /** What of a measured length has a size of its own: its range where it moves. */
  const lengthOf = ({course}) => course.constant ? Math.abs(course.high) : course.high - course.low;
  /** The course of a measurement as the plot that files show. */
  function plotOf(id, role) {
    const {kind, now, course} = state.measures.find(measure => measure.id === id);
    const axis = axisOf({}, {marks: [], ...state.cycle});
    return {panel: panelOf(titleOf(kind, now), kind, course, role), axis: {...axis, label: t(axis.label)}, behind: []};
  }
  const titleOf = (kind, features) => `${words()[kind]}: ${features.map(nameOf).join(" – ")}`;
  function fill(row, {kind, parts: first, now, course}) {
    const features = now?.every(Boolean) ? now : first, title = titleOf(kind, features), moves = Boolean(course) && !course.constant;
    put(row.name, title);
    row.name.title = title;
    row.drop.title = t("Remove this measurement");
    row.drop.setAttribute("aria-label", `${row.drop.title}: ${title}`);
    row.plot.style.display = moves ? "" : "none";
    row.range.hidden = !moves;
    row.scale.show(Boolean(course) && ["distance", "horizontal", "vertical"].includes(kind) && lengthOf({course}) > 0);
    if (moves) put(row.range, t("range *", textOf(kind, course.high - course.low)));
    for (const made of row.saves) {
      made.hidden = !moves;
      made.title = t("Download this plot as *", made.textContent);
      made.setAttribute("aria-label", `${title}: ${made.title}`);
    }
    if (!course) { put(row.value, "–"); put(row.ends, t("not in this design")); return; }
    put(row.ends, course.constant ? t("constant over the cycle") : t("min * at * · max * at *", textOf(kind, course.low), cycleText(state.cycle, course.lowAt),
      textOf(kind, course.high), cycleText(state.cycle, course.highAt)));
    if (moves) row.path.setAttribute("d", pathOf(course));
  }
  function pathOf({u, values, low, high}) {
    const step = Math.max(1, Math.floor(u.length / 240)), points = [];
    for (let n = 0; n < u.length; n += step) points.push(`${(u[n] * WIDE).toFixed(1)} ${(EDGE + (high - values[n]) / (high - low) * (TALL - 2 * EDGE)).toFixed(1)}`);
    return `M${points.join("L")}`;
  }
  /** The values of the moment, [[id, text]], and the cursor of the clock. */
  function follow(values, at) {
    told = values; phase = at;
    for (const [id, text] of told) {
      const row = rows.get(id);
      if (!row) continue;
      put(row.value, text);
      row.cursor.setAttribute("x1", phase * WIDE); row.cursor.setAttribute("x2", phase * WIDE);
    }
  }
  return {node, show, reword, follow, nameOf, destroy() { node.remove(); }};
}

/** Drags `node` by its `grip`, within what it lies upon: a panel that covers what is to be picked is put aside. */
function movable(grip, node) {
  let from = null, [x, y] = (node.dataset.place || "0 0").split(" ").map(Number);
  grip.addEventListener("pointerdown", event => {
    if (event.button !== 0 || event.target.closest("button")) return;
    event.preventDefault(); event.stopPropagation();
    grip.setPointerCapture(event.pointerId);
    from = [event.clientX - x, event.clientY - y];
  });
  grip.addEventListener("pointermove", event => {
    if (!from) return;
    const room = node.parentElement.getBoundingClientRect(), box = node.getBoundingClientRect(), home = [box.left - x, box.top - y];
    x = Math.min(Math.max(event.clientX - from[0], room.left - home[0]), room.right - home[0] - box.width);
    y = Math.min(Math.max(event.clientY - from[1], room.top - home[1]), room.bottom - home[1] - box.height);
    node.dataset.place = `${x} ${y}`;
    node.style.transform = `translate(${x}px, ${y}px)`;
  });
  for (const name of ["pointerup", "pointercancel"]) grip.addEventListener(name, () => { from = null; });
}
