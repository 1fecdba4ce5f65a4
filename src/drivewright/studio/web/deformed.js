// Fields of an analysis on the deformed solids: which field, at which instant, deformed how many times as much; colours with their scale.

import { empty } from "./asked.js";
import { figure, quantityOf, unitText } from "./numbers.js";
import { button, outcome, progress, put } from "./parts.js";
import { element, floats } from "./player.js";
import { createSolid } from "./solid.js";

const TICKS = 5;  // marks on the scale of colours
const NONE = -1;  // level of a corner without value
const WIDEST = 10;  // times the usual exaggeration at most
const ASIDE = 184;  // px at the right that the scale takes
const DECADES = 1e6;  // how many times longer than the least lives colours tell apart

// ------------------------------------------------------------------------------------------------------------------- numbers

/** A number on a scale of 0 ... 1 for a field {log}; NONE where there is no number. */
function levelOf(value, {log}, [low, high]) {
  if (!Number.isFinite(value)) return NONE;
  const part = log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
  return Number.isFinite(part) ? Math.min(Math.max(part, 0), 1) : 0;
}

/** Levels of all corners; a triangle with a corner that has none has none at all. */
function levelsOf(values, field, range) {
  const levels = Float32Array.from(values, value => levelOf(value, field, range));
  for (let i = 0; i < levels.length; i += 3) {
    if (Math.min(levels[i], levels[i + 1], levels[i + 2]) < 0) levels.fill(NONE, i, i + 3);
  }
  return levels;
}

/** Values at the marks of a scale, from its lower to its upper end. */
function marksOf({log}, [low, high]) {
  return Array.from({length: TICKS}, (_, n) => n / (TICKS - 1)).map(part => log ? low * (high / low) ** part : low + part * (high - low));
}

/** Points of a body at a step as x, y, z in a row, displacements drawn `scale` times as large. */
function deformedPoints(body, step, scale) {
  const {points, displacements} = body, moved = displacements[Math.min(step, displacements.length - 1)];
  return Float32Array.from(points, (x, i) => x + scale * moved[i]);
}

/** Entries of `size` numbers a corner once more behind those that are there, each triangle turned round, as a mirror does. */
function doubled(entries, size) {
  const both = new Float32Array(2 * entries.length), count = entries.length, corner = 3 * size;
  both.set(entries);
  for (let i = 0; i < count; i += corner) [0, 2, 1].forEach((from, to) =>
    both.set(entries.subarray(i + from * size, i + (from + 1) * size), count + i + to * size));
  return both;
}

/** Vectors with their images in the plane z = 0; `triangles` false for those that belong to lines. */
function withImages(vectors, triangles = true) {
  const both = triangles ? doubled(vectors, 3) : new Float32Array([...vectors, ...vectors]);
  for (let i = vectors.length + 2; i < both.length; i += 3) both[i] = -both[i];
  return both;
}

/** Vectors (x, y, z in a row) turned about z and moved, in place. */
function placed(vectors, [x, y, z, turn], moves = 1) {
  const c = Math.cos(turn), s = Math.sin(turn);
  for (let i = 0; i < vectors.length; i += 3) {
    const a = vectors[i], b = vectors[i + 1];
    vectors[i] = c * a - s * b + moves * x; vectors[i + 1] = s * a + c * b + moves * y; vectors[i + 2] += moves * z;
  }
  return vectors;
}

const counts = text => { const bytes = floats(text).buffer; return new Uint32Array(bytes); };

function unpacked(body) {
  const values = Object.fromEntries(Object.entries(body.values).map(([name, steps]) => [name, steps.map(floats)]));
  return {...body, points: floats(body.positions), normals: floats(body.normals), edges: counts(body.edges),
    displacements: body.displacements.map(floats), values};
}

/** What the viewer draws of a body: deformed points, normals as at rest, edges, levels. */
function drawn(body, field, {step, scale}, range) {
  const steps = body.values[field.name], half = deformedPoints(body, step, scale), place = body.places?.[step];
  const lines = new Float32Array(3 * body.edges.length);
  body.edges.forEach((corner, n) => lines.set(half.subarray(3 * corner, 3 * corner + 3), 3 * n));
  const own = levelsOf(steps[Math.min(step, steps.length - 1)], field, range), levels = body.mirrored ? doubled(own, 1) : own;
  const both = (vectors, triangles) => body.mirrored ? withImages(vectors, triangles) : vectors.slice();
  const whole = (vectors, moves, triangles) => place ? placed(both(vectors, triangles), place, moves) : both(vectors, triangles);
  return {name: body.name, label: body.label, colour: "steel", points: whole(half, 1), normals: whole(body.normals, 0),
    edges: whole(lines, 1, false), levels};
}

// --------------------------------------------------------------------------------------------------------------------- scale

/** The scale of colours with its marks; `picked(limit)` is called with another upper end [SI], null for its own. */
function createScale({t, picked}) {
  const bar = element("i", {}), marks = element("div", {class: "so-marks"}), title = element("b"), bare = element("p", {class: "so-bare"});
  const most = element("input", {class: "st-box", inputmode: "decimal", "data-testid": "solid-limit", "aria-label": t("Upper end of the colours")});
  const found = element("p", {"data-testid": "solid-extreme"});
  const node = element("div", {class: "so-scale", "data-testid": "solid-scale"}, title, found, element("label", {}, t("Colours up to"), most),
    element("div", {class: "so-ramp"}, bar, marks), bare);
  let factor = 1;
  most.addEventListener("change", () => {
    const typed = quantityOf(most.value)?.[0];
    picked(typed > 0 ? typed / factor : null);
  });
  return {node, show(field, range, colours, bareColour, extreme) {
    const unit = unitText(field.unit), text = value => figure(field.factor * value, 3);
    factor = field.factor;
    put(title, `${t(field.label)}${unit ? ` [${unit.trim()}]` : ""}`);
    put(found, field.log ? t("Least: *", text(extreme)) : t("Greatest in this step: *", text(extreme)));
    bar.style.background = `linear-gradient(to top, ${colours.join(", ")})`;
    marks.replaceChildren(...marksOf(field, range).reverse().map(value => element("span", {}, text(value))));
    if (document.activeElement !== most) most.value = text(range[1]);
    bare.hidden = !field.missing;
    bare.style.setProperty("--bare", bareColour);
    put(bare, t(field.missing));
  }};
}

// ---------------------------------------------------------------------------------------------------------------------- pane

/** A labelled control of the bar. */
const labelled = (text, ...inside) => element("label", {class: "so-control"}, text, ...inside);

/** The viewer with its bar and its scale in `host`; show(answer). */
function createDeformed(host, {t}) {
  const stage = element("div", {class: "so-stage"}), bar = element("div", {class: "so-bar"});
  const select = element("select", {class: "pn-select", "data-testid": "solid-field", "aria-label": t("Field")});
  const instant = element("select", {class: "pn-select", "data-testid": "solid-instant", "aria-label": t("Load step")});
  const range = element("input", {type: "range", class: "st-range", min: 0, max: 1, step: 0.005, "data-testid": "solid-slider",
    "aria-label": t("Exaggeration of the deformation")});
  const box = element("input", {class: "st-box", inputmode: "decimal", "data-testid": "solid-exaggeration", "aria-label": t("Exaggeration of the deformation")});
  const section = element("select", {class: "pn-select", "data-testid": "solid-section", "aria-label": t("Section")},
    ...[["", t("none")], ["0", "x"], ["1", "y"], ["2", "z"]].map(([value, text]) => element("option", {value}, text)));
  const depth = element("input", {type: "range", class: "st-range", min: 0, max: 1, step: 0.005, value: 0.5, hidden: "", "data-testid": "solid-depth",
    "aria-label": t("Place of the section")});
  const notes = element("details", {class: "so-notes"}), state = {step: 0, scale: 1, limit: null, hidden: new Set()};
  const scale = createScale({t, picked: limit => { state.limit = limit; draw(); }});
  let answer = null, bodies = [], field = null;
  bar.append(labelled(t("Field"), select), labelled(t("Load step"), instant), labelled(t("Deformation ×"), range, box), labelled(t("Section"), section, depth));
  host.replaceChildren(bar, stage);
  const viewer = createSolid(stage, {t, aside: ASIDE, toggled: hidden => { state.hidden = hidden; if (answer) draw(); }});
  stage.append(scale.node, notes);

  const seen = () => bodies.filter(body => body.ranges[field.name] && !state.hidden.has(body.name));
  /** Ends of the colours: what the bodies that are seen have at all steps, from 0 or from the least on. */
  function ends() {
    const ranges = seen().map(body => body.ranges[field.name]), least = Math.min(...ranges.map(range => range[0]));
    const most = Math.max(...ranges.map(range => range[1])), low = field.log || least < 0 ? least : 0;
    const high = state.limit > low ? state.limit : field.log ? Math.min(most, low * DECADES) : most;
    return Number.isFinite(high) ? [low, high > low ? high : low + 1] : [0, 1];
  }
  /** The least of a field in powers of ten, else the greatest, of all bodies that are seen at the step. */
  function extreme() {
    let found = NaN;
    for (const {values} of seen()) for (const value of values[field.name]?.[Math.min(state.step, values[field.name].length - 1)] || []) {
      if (Number.isFinite(value) && !(field.log ? value >= found : value <= found)) found = value;
    }
    return found;
  }
  function draw() {
    const between = ends();
    viewer.show(bodies.filter(body => body.ranges[field.name]).map(body => drawn(body, field, state, between)));
    scale.show(field, between, answer.colours, answer.bare, extreme());
    host.dataset.step = state.step; host.dataset.field = field.name; host.dataset.scale = state.scale;
  }
  function exaggerate(value) {
    state.scale = value;
    const part = Math.sqrt(value / (WIDEST * answer.scale));  // half the way is a quarter of the largest
    range.value = Math.min(part, 1);
    range.style.setProperty("--part", Math.min(part, 1));
    if (document.activeElement !== box) box.value = figure(value, 3);
    draw();
  }
  function cut() {
    depth.hidden = section.value === "";
    depth.style.setProperty("--part", depth.value);
    viewer.cut(section.value === "" ? null : [Number(section.value), Number(depth.value)]);
  }
  section.addEventListener("change", cut);
  depth.addEventListener("input", cut);
  select.addEventListener("change", () => { field = answer.fields[select.value]; state.limit = null; draw(); });
  instant.addEventListener("change", () => { state.step = Number(instant.value); draw(); });
  range.addEventListener("input", () => exaggerate(Number((WIDEST * answer.scale * range.value ** 2).toPrecision(2))));
  box.addEventListener("change", () => { const typed = quantityOf(box.value)?.[0]; exaggerate(typed >= 0 ? typed : answer.scale); box.blur(); });
  return {
    show(next) {
      answer = next;
      bodies = answer.bodies.map(unpacked);
      field = answer.fields.find(one => one.name === field?.name) || answer.fields[0];
      state.step = answer.worst; state.limit = null;
      select.replaceChildren(...answer.fields.map((one, n) => element("option", {value: n}, t(one.label))));
      select.value = answer.fields.indexOf(field);
      const worst = n => n === answer.worst ? ` · ${t("worst")}` : "";
      instant.replaceChildren(...answer.steps.map((text, n) => element("option", {value: n}, `${t(text)}${worst(n)}`)));
      instant.value = state.step;
      notes.hidden = !answer.notes.length;
      notes.replaceChildren(element("summary", {}, t("About these fields")), ...answer.notes.map(text => element("p", {}, t(text))));
      state.hidden = viewer.hide(bodies.filter(body => body.hidden).map(body => body.name));
      viewer.setRamp(answer.colours, answer.bare);
      exaggerate(answer.scale);
    },
    highlight: viewer.highlight,
    destroy() { viewer.destroy(); },
  };
}

/** An analysis' name as a title. */
export function titleOf(name, t) {
  const text = t(name).replaceAll("_", " ");
  return text.slice(0, 1).toUpperCase() + text.slice(1);
}

/** The pane of an analysis {name, meaning, missing} in `host`: its fields where it has run, else the offer to run it. */
export function createFields(host, {name, meaning, missing}, {store, say, t}) {
  const body = element("div", {class: "vw-body so-fields"}), bar = progress("fields", {say, t}), note = outcome(t);
  const begin = button(t("Run"), () => ask(true), {look: "main", testid: "job-fields"});
  const offer = element("p", {}, element("b", {}, titleOf(name, t)), " · ", t(meaning)), why = element("p", {}, missing ? t(missing) : "");
  const wait = empty(offer, why, bar.node, note.node, begin);
  const old = element("div", {class: "vw-old", hidden: ""}, t("The design has changed since."), button(t("Show the new one"), () => ask(false)));
  let viewer = null, before = null, answer = null, got = null, asked = null;
  host.replaceChildren(body, wait, old);

  const gen = () => store.state.design?.gen;
  /** What earlier runs have left, or a run. */
  function ask(run) { asked = gen(); say({what: "job", name: "fields", options: {analysis: name, run}}); }
  function take(job) {
    if (job === before) return;
    before = job;
    bar.show(job); note.show(job);
    if (job.state !== "done" || !job.answer || job.answer === answer || job.answer.analysis !== name) return;
    if (job.answer.absent) { answer = null; return; }
    answer = job.answer;
    got = job.gen;
    viewer ||= createDeformed(body, {t});
    viewer.show(answer);
    viewer.highlight(store.state.lit);
  }
  function update({jobs}) {
    const job = jobs?.fields || {state: "idle"}, running = job.state === "running";
    take(job);
    body.hidden = !answer;
    wait.hidden = Boolean(answer) && !running && job.state !== "failed";
    wait.classList.toggle("is-over", Boolean(answer));
    begin.hidden = running || Boolean(missing);
    offer.hidden = Boolean(answer); why.hidden = !missing || running;
    old.hidden = !answer || running || got === gen();
  }
  const stops = [store.on(["jobs", "design"], update), store.on(["lit"], ({lit}) => viewer?.highlight(lit))];
  return {
    name,
    open() { if (gen() !== undefined && asked !== gen() && store.state.jobs?.fields?.state !== "running" && !missing) ask(false); },
    destroy() { stops.forEach(stop => stop()); viewer?.destroy(); },
  };
}
