// The motion programme, drawn: borders and lifts are dragged, laws are chosen, segments are added and removed.

import { FACTORS } from "./handles.js";
import { createMotionDrag } from "./motion_drag.js";
import { createMotionPlot } from "./motion_plot.js";
import { jumpsOf, peaksOf, stretched, unpacked, withDwell, withLaw, without } from "./motion_segments.js";
import { figure } from "./numbers.js";
import { button, put } from "./parts.js";
import { element, watchTheme } from "./player.js";

const WAIT = 1500;  // ms that what a hand has left stays drawn without an answer

/** The pane of the motion programme in `host`. */
export function createMotionForm(host, tools) {
  const {store, say, t, clock} = tools;
  const canvas = element("canvas", {class: "mf-canvas"}), cursor = element("div", {class: "dw-cursor mf-cursor"}), layer = element("div", {class: "mf-layer"});
  const stage = element("div", {class: "mf-stage", "data-testid": "programme"}, canvas, cursor, layer), bar = element("div", {class: "mf-bar"}), status = element("p", {class: "mf-status", role: "status", "data-testid": "programme-continuity"});
  let programme = null, packed = null, fields = new Map(), selected = 0, held = null, opened = false, timer = 0;
  let drive = null, shown = null, design = null, current = true;  // the drive that all of it belongs to; as drawn; as the form has it; whether the segments of both are the same
  host.classList.add("mf");
  host.append(bar, stage, status);
  const theme = watchTheme(host, () => render()), plot = createMotionPlot(canvas, () => place());
  const drag = createMotionDrag({layer, stage, plot, drawn: () => shown, isCurrent: () => current, number, hold, select, tools});

  // ---- numbers of the form
  const keyOf = (n, name) => `${programme.list}.${n}.${programme.keys[name]}`;
  /** {key, unit, factor, value} of a key of segment `n`; null where the form has no number there, or it is locked. */
  function number(n, name) {
    const key = keyOf(n, name), {unit, value, low, high} = fields.get(key) || {}, factor = FACTORS[unit];
    return factor && typeof value === "number" && !store.state.design.locks.includes(key) ? {key, unit, factor, value, low, high} : null;
  }
  const tidy = value => Number(value.toPrecision(12));
  const texts = {
    rise(value, n) {
      const {unit} = fields.get(keyOf(n, "rise")) || {}, own = Math.abs(design.segments[n].rise) > 0 && FACTORS[unit] ? unit : programme.lift.angular ? "deg" : "mm";
      return `${tidy(Math.round(value / FACTORS[own] * 1e9) / 1e9)} ${own}`;
    },
    half(n) { const {unit, value} = fields.get(keyOf(n, "angle")), first = tidy(value / 2); return [`${first} ${unit}`, `${tidy(value - first)} ${unit}`]; },
    sum(one, other) {
      const [a, b] = [one, other].map(n => fields.get(keyOf(n, "angle")));
      return `${tidy(a.value + b.value * FACTORS[b.unit] / FACTORS[a.unit])} ${a.unit}`;
    },
  };

  // ---- what is drawn: the courses of the scene, stretched to the numbers of the design or of the hand
  /** Angle or rise of each segment as the design has it, as the scene has it where the form has no such number. */
  const designed = name => programme.segments.map((segment, n) => {
    const {unit, value} = fields.get(keyOf(n, name)) || {}, factor = FACTORS[unit];
    return held?.[`${n} ${name}`] ?? (factor && typeof value === "number" ? factor * value : segment[name]);
  });
  /** The segments as the form has them: what is edited, for a scene may be late, or never come where the design has no solution. */
  function readDesign() {
    const {list, keys, segments, dwell} = programme, made = [];
    const si = key => { const {unit, value} = fields.get(key) || {}; return typeof value === "number" ? value * (FACTORS[unit] || 1) : 0; };
    for (let n = 0, level = segments[0]?.course[1][0] || 0; fields.has(`${list}.${n}.${keys.angle}`); n++) {
      const law = fields.get(keyOf(n, "law"))?.text, absolute = segments.some(segment => segment.absolute && segment.law === law), rise = absolute || law === dwell ? 0 : si(keyOf(n, "rise"));
      const drawn = absolute && segments[n]?.law === law ? segments[n].course[1] : [level, level + rise];
      made.push({law, absolute, rise, angle: si(keyOf(n, "angle")), from: drawn[0], to: drawn.at(-1)});
      level = drawn.at(-1);
    }
    return {...programme, segments: made};
  }
  /** The segment that states no angle has the rest of the turn: its field gets that number. */
  function complete() {
    const {list, keys, cycle} = programme, angles = [];
    for (let n = 0; fields.has(`${list}.${n}.${keys.angle}`); n++) angles.push([`${list}.${n}.${keys.angle}`, fields.get(`${list}.${n}.${keys.angle}`)]);
    const open = angles.filter(([, {value}]) => typeof value !== "number"), given = angles.reduce((sum, [, {value, unit}]) => sum + (typeof value === "number" ? value * (FACTORS[unit] || 1) : 0), 0);
    if (open.length === 1) fields.set(open[0][0], {...open[0][1], value: tidy((cycle.span - given) / FACTORS.deg), unit: "deg"});
  }
  function render() {
    if (!programme || !opened) return;
    complete();
    design = readDesign();
    current = design.segments.length === programme.segments.length && design.segments.every(({law}, n) => law === programme.segments[n].law);
    const own = name => current ? designed(name) : programme.segments.map(segment => segment[name]);
    shown = stretched(programme, own("angle"), own("rise"));
    selected = Math.max(0, Math.min(selected, design.segments.length - 1));
    stage.classList.toggle("is-old", !current);
    const jumps = jumpsOf(shown), peaks = peaksOf(shown, jumps), {factors, titles} = words(peaks);
    plot.show({programme: shown, jumps, selected, factors, titles, held: drag.held(), axis: `${t(shown.cycle.label)} [${shown.cycle.unit}]`}, theme.colours);
    place(); tell(jumps, titles);
    fill();
  }
  /** Factor and title with the peak of every row. */
  function words(peaks) {
    const {lift, speed} = shown, names = speed ? [t("Velocity"), t("Acceleration"), t("Jerk")] : [t("First derivative"), t("Second derivative"), t("Third derivative")];
    const base = lift.angular ? "rad" : speed ? "m" : lift.unit, per = speed ? "s" : "rad", factors = [lift.factor, ...[1, 2, 3].map(order => speed ? speed ** order : lift.angular ? 1 : lift.factor)];
    const units = [lift.unit, ...["", "²", "³"].map(power => `${base}/${per}${power}`)], gap = unit => unit.startsWith("°") ? unit : `\u00a0${unit}`;
    const shownPeak = n => Number.isFinite(peaks[n]) ? `${figure(peaks[n] * factors[n])}${gap(units[n])}` : "∞";
    return {factors, titles: [[t("Lift"), shownPeak(0)], ...names.map((name, n) => [`${name} [${units[n + 1]}]`, t("peak *", shownPeak(n + 1))])]};
  }
  function tell(jumps, titles) {
    const at = order => jumps.filter(jump => jump.order === order).map(jump => `${figure(jump.at * shown.cycle.factor, 4)}${shown.cycle.unit}`).join(", ");
    const lines = [["mf-bad", at(1) && t("velocity jumps at *", at(1))], ["mf-warn", at(2) && t("acceleration jumps at *", at(2))]].filter(([, text]) => text);
    const smooth = lines.length ? [] : [element("span", {class: "mf-good"}, t("velocity and acceleration are continuous"))];
    status.replaceChildren(element("b", {}, `${titles[0][0]} ${titles[0][1]}`), ...smooth, ...lines.map(([look, text]) => element("span", {class: look}, text)));
  }
  function place() {
    if (!shown || !opened) return;
    drag.place(selected);
    follow();
  }
  function follow() {
    if (!shown) return;
    cursor.style.transform = `translateX(${Math.round(plot.toX(clock.phase * shown.cycle.span))}px)`;
    cursor.style.height = `${plot.bottom() - 24}px`;
  }

  // ---- the bar of the chosen segment
  let parts = null;
  function build() {
    const law = element("select", {class: "pn-select mf-law", "data-testid": "programme-law", "aria-label": t("Motion law")});
    const box = (name, label) => element("input", {type: "text", class: "st-box mf-box", "data-testid": `programme-${name}`, "aria-label": label, autocomplete: "off"});
    const angle = box("angle", t("Angle of the segment")), rise = box("rise", t("Rise of the segment"));
    law.addEventListener("change", () => { const next = withLaw(design, selected, law.value, texts); next ? arrange(next) : fill(); });
    for (const [input, name] of [[angle, "angle"], [rise, "rise"]]) {
      input.addEventListener("keydown", event => { if (event.key === "Enter") { input.dataset.unsent = ""; drag.typed(selected, name, input.value); delete input.dataset.unsent; } });
      input.addEventListener("blur", () => fill());
    }
    const add = button(t("Add a dwell"), () => { const next = withDwell(design, selected, texts); if (next) { arrange(next); selected += 1; } }, {testid: "programme-add", title: t("The chosen segment is halved, and a dwell follows it")});
    const drop = button(t("Remove"), () => { const next = without(design, selected, texts); if (next) arrange(next); }, {testid: "programme-drop", title: t("Its angle goes to a neighbour, its rise to another segment")});
    const name = element("b", {class: "mf-name"});
    const label = (text, input) => element("label", {class: "so-control"}, element("span", {}, text), input);
    parts = {law, angle, rise, add, drop, name};
    bar.replaceChildren(name, label(t("Motion law"), law), label(t("Angle"), angle), label(t("Rise"), rise), add, drop);
    canvas.setAttribute("role", "img"); canvas.setAttribute("aria-label", t("Lift, velocity, acceleration and jerk over the cycle"));
  }
  let waiting = false;  // for the answer to another list
  function arrange(elements) { waiting = true; say({what: "arrange", list: programme.list, elements}); fill(); }
  function fill() {
    const segment = design?.segments[selected];
    if (!segment || !parts || !opened) return;  // a pane that is not seen knows an older design
    const fixed = segment.absolute, choices = design.laws.map(({name}) => name), all = choices.includes(segment.law) ? choices : [segment.law, ...choices];
    put(parts.name, t("Segment * of *", selected + 1, design.segments.length));
    if (parts.law.dataset.all !== all.join()) { parts.law.dataset.all = all.join(); parts.law.replaceChildren(...all.map(name => element("option", {value: name}, t(name)))); }
    for (const option of parts.law.options) option.disabled = option.value !== segment.law && !withLaw(design, selected, option.value, texts);
    parts.law.value = segment.law; parts.law.disabled = fixed || waiting;
    for (const name of ["angle", "rise"]) {
      const own = number(selected, name), box = parts[name], value = own && (held?.[`${selected} ${name}`] ?? own.value * own.factor) / own.factor;
      box.disabled = !own || fixed || current && !drag.can(selected, name);
      if (document.activeElement !== box) box.value = own ? `${tidy(Math.round(value * 1e6) / 1e6)} ${own.unit}` : "";
    }
    parts.add.disabled = waiting || !withDwell(design, selected, texts); parts.drop.disabled = waiting || !without(design, selected, texts);
  }
  function select(n) { selected = n; render(); }

  // ---- a hand
  /** Numbers in the hand, {"segment name": SI}, drawn at once; null lets go as soon as the design has them. */
  function hold(numbers) {
    clearTimeout(timer);
    if (numbers) held = {...held, ...numbers}; else timer = setTimeout(() => { held = null; render(); }, WAIT);
    render();
  }
  function designChanged({design: next}) {
    waiting = false;
    if (next?.opened !== drive) { drive = next?.opened; programme = packed = shown = design = held = null; selected = 0; }
    fields = new Map((next?.form?.groups || []).flatMap(group => group.fields.map(field => [field.key, field])));
    if (held && !drag.held() && programme && Object.entries(held).every(([name, value]) => {
      const own = number(...[0, 1].map(k => k ? name.split(" ")[1] : Number(name.split(" ")[0])));
      return !own || Math.abs(own.value * own.factor - value) < 1e-9;
    })) held = null;
    render();
  }
  function sceneChanged({scene}) {
    if (!scene?.programme || scene.programme === packed) return;
    packed = scene.programme;
    programme = unpacked(packed);
    render();
  }
  build();
  const stops = [store.on(["design"], designChanged), store.on(["scene"], sceneChanged), store.on(["refused"], () => { waiting = false; fill(); }), clock.subscribe(follow)];
  return {
    open() { opened = true; render(); },
    close() { opened = false; },
    reword() { build(); drag.reword(); render(); },
    destroy() { clearTimeout(timer); stops.forEach(stop => stop()); theme.stop(); plot.stop(); drag.destroy(); host.replaceChildren(); },
  };
}
