// The bars above the diagram: law, angle and rise of the chosen segment, and its points.

import { partText, pointMoves, rowsText } from "./motion_points.js";
import { withDwell, withLaw, without } from "./motion_segments.js";
import { button, put } from "./parts.js";
import { element } from "./player.js";

const tidy = value => Number(value.toPrecision(12));

/**
 * The bars in `host`.  `state()` is {design, shown, selected, point, current, waiting}; `numbers` of motion_design.js; `drag` of motion_drag.js.  `arrange(elements)` asks for another list,
 * `select(n)` and `choose(n, k)` choose a segment and a point.
 */
export function createMotionBar(host, {state, numbers, drag, arrange, select, choose, tools: {say, t}}) {
  let parts = null;
  const label = (text, input) => element("label", {class: "so-control"}, element("span", {}, text), input);
  const box = (name, words) => element("input", {type: "text", class: "st-box mf-box", "data-testid": `programme-${name}`, "aria-label": words, autocomplete: "off"});

  function build() {
    const law = element("select", {class: "pn-select mf-law", "data-testid": "programme-law", "aria-label": t("Motion law")});
    const angle = box("angle", t("Angle of the segment")), rise = box("rise", t("Rise of the segment"));
    law.addEventListener("change", () => chooseLaw(law.value));
    for (const [input, name] of [[angle, "angle"], [rise, "rise"]]) {
      input.addEventListener("keydown", event => { if (event.key === "Enter") drag.typed(state().selected, name, input.value); });
      input.addEventListener("blur", () => fill());
    }
    const add = button(t("Add a dwell"), addDwell, {testid: "programme-add", title: t("The chosen segment is halved, and a dwell follows it")});
    const drop = button(t("Remove"), () => arranged(without), {testid: "programme-drop", title: t("Its angle goes to a neighbour, its rise to another segment")});
    const name = element("select", {class: "pn-select mf-name", "data-testid": "programme-segment", "aria-label": t("Chosen segment")}), list = element("span", {class: "mf-list"}, add, drop);
    name.addEventListener("change", () => select(Number(name.value)));
    parts = {law, angle, rise, add, drop, name, list, ...pointParts()};
    host.replaceChildren(element("div", {class: "mf-bar"}, name, label(t("Motion law"), law), label(t("Angle"), angle), label(t("Rise"), rise), list), parts.row);
  }
  function pointParts() {
    const which = element("input", {type: "number", class: "st-box mf-which", min: 1, "data-testid": "programme-point", "aria-label": t("Number of the point")}), of = element("span", {class: "mf-of"});
    which.addEventListener("input", () => { const k = Number(which.value) - 1; if (Number.isInteger(k) && k >= 0 && k < state().shown.segments[state().selected].nodes.at.length) choose(state().selected, k); });
    const place = [box("point-x", t("Place of the point along the angle")), box("point-y", t("Lift of the point"))];
    place.forEach((input, part) => input.addEventListener("keydown", event => { const {selected, point} = state(); if (event.key === "Enter" && point) drag.typedPoint(selected, point.k, part, input.value); }));
    for (const input of [which, ...place]) input.addEventListener("blur", () => fill());
    const more = button(t("Add a point"), addPoint, {testid: "programme-point-add", title: t("Half-way to the next point; a double click on the curve adds one there")});
    const less = button(t("Remove the point"), removePoint, {testid: "programme-point-drop", title: t("The Delete key does it on a point")});
    const take = button(t("Edit the points here"), takeRows, {testid: "programme-rows", title: t("The rows of the file go into the spec; the file stays as it is")});
    const words = element("span", {class: "mf-words", "data-testid": "programme-points"}), names = place.map(() => element("span", {}));
    const edit = element("span", {class: "mf-list"}, label(t("Point"), which), of, ...place.map((input, part) => element("label", {class: "so-control"}, names[part], input)), more, less);
    return {which, of, place, names, more, less, take, words, edit, row: element("div", {class: "mf-bar mf-points", hidden: ""}, edit, words, take)};
  }

  // ---- what the buttons do
  function chooseLaw(name) {
    const {design, selected} = state(), {fixed} = design.segments[selected];
    if (fixed) say({what: "set", key: fixed.law, text: name});
    else arranged(programme => withLaw(programme, selected, name, numbers.written)) || fill();
  }
  const arranged = (make) => { const {design, selected} = state(), next = make(design, selected, numbers.written); if (next) arrange(next); return Boolean(next); };
  function addDwell() { if (arranged(withDwell)) select(state().selected + 1); }
  function addPoint() {
    const {shown, selected, point} = state(), segment = shown.segments[selected], {nodes} = segment, k = Math.min(point?.k ?? 0, nodes.at.length - 2), middle = (nodes.at[k][0] + nodes.at[k + 1][0]) / 2;
    const added = drag.add(selected, segment.start + (nodes.kind === "table" ? middle : middle * segment.angle));
    if (added !== null) choose(selected, added);
  }
  function removePoint() {
    const {selected, point, shown} = state(), most = shown.segments[selected].nodes.at.length - 3;
    if (point && drag.remove(selected, point.k)) choose(selected, Math.max(1, Math.min(point.k, most)));
  }
  function takeRows() {
    const {design, shown, selected} = state(), {keys, lift} = design, text = rowsText(shown.segments[selected].rows, lift.angular);
    arrange(design.segments.map((_, k) => ({of: k, changes: k === selected ? {[keys.rows]: text, [keys.file]: ""} : {}})));
  }

  // ---- what they show
  function fill() {
    const {design, selected, waiting} = state(), segment = design?.segments[selected];
    if (!segment || !parts) return;
    fillName(design.segments.length);
    fillLaw(segment);
    for (const name of ["angle", "rise"]) fillBox(name, segment);
    parts.list.hidden = Boolean(segment.fixed);
    if (!segment.fixed) { parts.add.disabled = waiting || !withDwell(design, selected, numbers.written); parts.drop.disabled = waiting || !without(design, selected, numbers.written); }
    fillPoints();
  }
  function fillName(count) {
    if (parts.name.options.length !== count) parts.name.replaceChildren(...Array.from({length: count}, (_, n) => element("option", {value: n}, t("Segment * of *", n + 1, count))));
    parts.name.value = state().selected;
  }
  function fillLaw(segment) {
    const {design, selected, waiting} = state(), names = design.laws.map(({name}) => name), all = names.includes(segment.law) ? names : [segment.law, ...names], still = segment.fixed && !segment.fixed.law;
    if (parts.law.dataset.all !== all.join()) { parts.law.dataset.all = all.join(); parts.law.replaceChildren(...all.map(name => element("option", {value: name}, t(name)))); }
    for (const option of parts.law.options) option.disabled = option.value !== segment.law && !segment.fixed && !withLaw(design, selected, option.value, numbers.written);
    parts.law.value = segment.law; parts.law.disabled = segment.absolute || still || waiting;
  }
  function fillBox(name, segment) {
    const {selected, current} = state(), own = numbers.number(selected, name), field = parts[name], value = own && segment[name] / Math.abs(own.factor);
    field.disabled = !own || segment.absolute || current && !drag.can(selected, name);
    const rest = !own && segment.fixed && name === "angle" ? `${tidy(Math.round(segment.angle * 180 / Math.PI * 1e6) / 1e6)} deg` : "";
    if (document.activeElement !== field) field.value = own ? `${tidy(Math.round(value * 1e6) / 1e6)} ${own.unit}` : rest;
  }
  function fillPoints() {
    const {shown, selected, point, current, waiting} = state(), segment = shown?.segments[selected], nodes = segment?.nodes, count = segment?.rowCount || 0;
    parts.row.hidden = !nodes && !count;
    if (parts.row.hidden) return;
    const k = point?.n === selected ? Math.min(point.k, (nodes?.at.length || 1) - 1) : null, editable = Boolean(nodes) && !segment.file;
    parts.edit.hidden = !editable; parts.take.hidden = !segment.file || !nodes; parts.words.hidden = editable && !nodes.still;
    parts.take.disabled = waiting || !current;
    if (editable) {
      const still = nodes.still || !current, inside = k !== null && k > 0 && k < nodes.at.length - 1;
      parts.which.max = nodes.at.length; parts.which.disabled = nodes.still;
      if (document.activeElement !== parts.which) parts.which.value = k === null ? "" : k + 1;
      put(parts.of, t("of *", nodes.at.length));
      parts.place.forEach((input, part) => {
        put(parts.names[part], nodes.kind === "spline" ? ["u", "s"][part] : [t("Angle"), t("Lift")][part]);
        input.disabled = still || k === null || !pointMoves(segment, k) || part === 0 && !inside;
        if (document.activeElement !== input) input.value = k === null ? "" : partText(segment, k, part);
      });
      parts.more.disabled = still || drag.isFull(segment); parts.less.disabled = still || !inside || drag.isFew(segment);
    }
    put(parts.words, wordsOf(segment, nodes, count, current));
  }
  /** Why the points stand still. */
  function wordsOf(segment, nodes, count, current) {
    if (!nodes) return t("This table has * rows; one of more than 1000 is edited in its file.", count);
    if (segment.file) return t("The points are the * rows of the file *, which is not changed from here.", count, segment.file);
    return nodes.still && current ? t("The points are locked, or the spec has them in another form.") : "";
  }
  build();
  return {fill, reword: build};
}
