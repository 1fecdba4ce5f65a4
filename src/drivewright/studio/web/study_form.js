// The form of a study: what varies and how, how many samples, what is kept.  Start writes the table and begins.

import { durationText, secondsOf } from "./costs.js";
import { box, choice, createKeyList, part, tick } from "./key_list.js";
import { quantityOf, withUnit } from "./numbers.js";
import { button, put, themeOf } from "./parts.js";
import { element } from "./player.js";

const SAMPLES = 200, LEVELS = 5, AROUND = 0.2;  // of a value: how far levels reach to either side
const RANDOM = ["normal", "uniform"];  // ways to vary that are sampled
const METHODS = ["latin-hypercube", "sobol", "random", "corners", "one-at-a-time", "tolerance", "sobol-indices"];
const FIXED = ["corners", "one-at-a-time"];  // whose number of cases follows from the keys

/** How an entry of the table varies, as the form shows it; "as_written" where the form has no boxes for it. */
function wayOf(entry, kind) {
  const shown = ["key", "values", "lower", "upper", "steps", "distribution", "tolerance"];
  if (!entry) return kind === "choice" || kind === "flag" ? "values" : "levels";
  if (Object.keys(entry).some(name => !shown.includes(name))) return "as_written";
  if (entry.values) return "values";
  if (entry.steps !== undefined) return "levels";
  if (entry.tolerance !== undefined) return entry.distribution && entry.distribution !== "normal" ? "as_written" : "normal";
  return (entry.distribution || "uniform") === "uniform" && entry.lower !== undefined ? "uniform" : "as_written";
}

/** The ends of the levels that are proposed: a fifth to either side, within the slider; of a number at 0 and a whole one those of the slider. */
function near({text, kind, lower, upper}) {
  const [value, unit] = quantityOf(text) || [], ends = [lower, upper].map(end => quantityOf(end)?.[0]);
  if (!value || kind === "integer" || !ends.every(Number.isFinite)) return [lower, upper];
  return [1 - AROUND, 1 + AROUND].map(part => part * value).sort((a, b) => a - b)
    .map(end => withUnit(Number(Math.min(Math.max(end, ends[0]), ends[1]).toPrecision(6)), unit));
}

/** The boxes of one key: how it varies, and the numbers for that. */
function createEditor({key, label, kind, text, lower, upper, choices, entry}, {t}, changed) {
  const [begins, ends] = near({text, kind, lower, upper});
  const counted = kind !== "choice" && kind !== "flag", name = words => `${t(label)}: ${t(words)}`, first = wayOf(entry, kind);
  const ways = [...(counted ? [["levels", t("levels from … to")]] : []), ["values", t("listed values")],
    ...(counted && kind !== "integer" ? [["normal", t("tolerance, normal")], ["uniform", t("range, uniform")]] : []),
    ...(first === "as_written" ? [["as_written", t("as written in the text")]] : [])];
  const way = choice(ways, first, name("how it varies"), `study-way-${key}`, show), low = box(entry?.lower ?? begins, name("from"), `study-from-${key}`);
  const high = box(entry?.upper ?? ends, name("to"), `study-to-${key}`), steps = box(String(entry?.steps ?? LEVELS), name("number of levels"), `study-steps-${key}`, {inputmode: "numeric"});
  const listed = box(entry?.values?.join(", ") ?? (counted ? text : choices.join(", ")), name("values, with commas between them"), `study-values-${key}`);
  const spread = box(entry?.tolerance ?? "5 %", name("tolerance"), `study-tolerance-${key}`), sign = element("span", {}, "±"), dots = element("span", {}, "…");
  const row = element("div", {class: "sf-bounds"}), node = element("div", {class: "sf-ways"}, way, row);
  const inside = {levels: [low, dots, high, steps], uniform: [low, dots, high], normal: [sign, spread], values: [listed], as_written: []};
  const split = () => listed.value.split(",").map(each => each.trim()).filter(Boolean);
  function show() { row.replaceChildren(...inside[way.value]); changed(); }
  row.replaceChildren(...inside[first]);
  return {
    node,
    value: () => ({
      levels: {lower: low.value, upper: high.value, steps: steps.value}, uniform: {lower: low.value, upper: high.value, distribution: "uniform"},
      normal: {tolerance: spread.value, distribution: "normal"}, values: {values: split()}, as_written: {as_written: true},
    })[way.value],
    levels: () => ({levels: Number(steps.value) || 0, values: split().length})[way.value] ?? null,
  };
}

/** What is kept of each case: everything, or what is ticked. */
function createKept({store, t}) {
  const list = element("div", {class: "sf-keys"}), count = element("span", {class: "sd-count"});
  const node = element("details", {class: "sd-findings"}, element("summary", {}, t("Values to keep"), count), list);
  let kept = new Set();  // empty: everything
  function draw() {
    const {result} = store.state, all = [...(result?.values || []).map(({name, label}) => [name, label]), ...(result?.checks || []).map(({name, label}) => [`check.${name}`, label])];
    const set = (name, on) => {
      if (!kept.size) kept = new Set(all.map(([each]) => each));
      if (on) kept.add(name); else kept.delete(name);
      if (kept.size === all.length) kept = new Set();
      say();
    };
    const say = () => put(count, kept.size ? String(kept.size) : t("all"));
    list.replaceChildren(...all.map(([name, label]) => tick(!kept.size || kept.has(name), [element("span", {class: "sf-name", title: name}, t(label))], `study-keep-${name}`, on => set(name, on))));
    say();
  }
  return {node, draw, load(names) { kept = new Set(names || []); draw(); }, chosen: () => [...kept]};
}

/** The form in a node of its own: {node, load(), refused(text)}; `closed()` is called when it is put away. */
export function createStudyForm(tools, closed) {
  const {store, say, t} = tools, editors = new Map(), kept = createKept(tools);
  const keys = createKeyList("study", tools, key => { const made = createEditor(key, tools, changed); editors.set(key.key, made); return made; }, changed);
  const words = {"latin-hypercube": t("Latin hypercube"), sobol: t("Sobol sequence"), random: t("random"), corners: t("corners"), "one-at-a-time": t("one at a time"),
    tolerance: t("tolerance study"), "sobol-indices": t("Sobol indices")};
  const method = choice(METHODS.map(name => [name, words[name]]), METHODS[0], t("Method"), "study-method", changed);
  const samples = box(String(SAMPLES), t("Sample size"), "study-samples", {inputmode: "numeric"}), estimate = element("p", {class: "pn-about", "data-testid": "study-estimate", role: "status"});
  const sampling = element("div", {class: "sf-part"}, element("h4", {}, t("Cases")), element("label", {class: "sf-pair"}, t("Method"), method), element("label", {class: "sf-pair"}, t("Sample size"), samples));
  const wrong = element("p", {class: "pn-note pn-bad", role: "alert", "data-testid": "study-refused", hidden: ""});
  const start = button(t("Start"), begin, {testid: "study-start", look: "main"}), away = button(t("Close"), closed, {testid: "study-close", look: "quiet"});
  const node = element("div", {class: "sf", role: "group", "aria-label": t("Set up the study"), "data-testid": "study-form"},
    part(t("What varies"), keys.node), sampling, kept.node,
    element("div", {class: "sf-foot"}, wrong, estimate, element("div", {class: "pn-row"}, start, away)));
  let ready = false, among = [];

  const isRandom = entry => RANDOM.includes(entry.distribution) || entry.as_written;
  function content() {
    const vary = keys.chosen(), more = vary.some(isRandom) ? {method: method.value, samples: samples.value} : {};
    return {vary, values: kept.chosen(), ...more};
  }
  /** How many cases, as far as the form can tell: null where the method or the text of the design says it. */
  function cases(vary) {
    const crossed = vary.map(({key}) => editors.get(key).levels()).filter(each => each !== null).reduce((product, each) => product * each, 1);
    if (!vary.some(isRandom)) return crossed;
    if (vary.some(({as_written}) => as_written) || [...FIXED, "tolerance", "sobol-indices"].includes(method.value)) return null;
    return crossed * (Number(samples.value) || 0);
  }
  function changed() {
    if (!ready) return;
    const {vary, values} = content(), count = cases(vary), each = secondsOf(store, values), random = vary.some(isRandom);
    const missing = !vary.length ? t("Tick at least one dimension that varies.") : count === 0 ? t("Give a number of levels or samples.") : "";
    sampling.hidden = !random;
    samples.parentElement.hidden = FIXED.includes(method.value);
    start.disabled = Boolean(missing);
    put(estimate, missing || (count === null ? t("The number of cases follows from the method.")
      : each === null ? t("* cases", count) : count * each < 1 ? t("* cases, less than 1 s", count) : t("* cases, at most about * by one process", count, durationText(count * each, t))));
  }
  function load({keys: found, study}) {
    ready = false;
    among = found;
    keys.load(found, Object.fromEntries((study?.vary || []).map(one => [one.key, one])));
    method.value = study?.method || METHODS[0];
    samples.value = String(study?.samples ?? SAMPLES);
    kept.load(study?.values);
    ready = true;
    changed();
  }
  function begin() { say({what: "begin", name: "study", table: content(), options: {theme: themeOf(store.state)}}); }
  node.addEventListener("input", changed);
  return {
    node, load,
    /** What load() takes to come back to what is in the form now. */
    draft: () => ({keys: among, study: {...content(), method: method.value, samples: samples.value}}),
    result() { if (ready) { kept.draw(); changed(); } },
    refused(text) { wrong.hidden = !text; put(wrong, text); },
  };
}
