// The panels of the jobs: sensitivity as bars, the search for the best design, the study; each with its run button and progress.

import { drawing, icon } from "./icons.js";
import { figure, unitText } from "./numbers.js";
import { button, outcome, pressable, progress, themeOf } from "./parts.js";
import { element } from "./player.js";

const BARS = 10;  // that are shown at once

const about = text => element("p", {class: "pn-about"}, text);
const line = (label, value, title) => element("div", {class: "sd-number"}, element("span", {title: title || false}, label), element("em"),
  element("b", {}, value));
const folded = (title, count, ...inside) => element("details", {class: "sd-findings"},
  element("summary", {}, title, element("span", {class: "sd-count"}, String(count))), ...inside);

/** Frame of a job's panel: run button, progress, words of the outcome; `shown(answer, job)` fills the rest. */
function createJob(host, name, title, meaning, {store, say, t}, shown, options = () => ({})) {
  const run = button(title, () => say({what: "job", name, options: options()}), {testid: `job-${name}`, look: "main"});
  const bar = progress(name, {say, t}), note = outcome(t), words = about(meaning), answer = element("div", {class: "pn-answer"});
  let before = null;
  host.append(words, run, bar.node, note.node, answer);
  return [store.on(["jobs"], ({jobs}) => {
    const job = jobs?.[name] || {state: "idle"};
    if (job === before) return;
    before = job;
    bar.show(job); note.show(job);
    run.hidden = job.state === "running";
    words.hidden = Boolean(job.answer) || job.state === "running";
    answer.replaceChildren(...(job.answer ? shown(job.answer, job) : []));
  })];
}

// --------------------------------------------------------------------------------------------------------------- sensitivity

const signed = value => value === null ? "–" : (value > 0 ? "+" : "") + figure(value, 3);

/** Bars of one target, the strongest first: to the right where it rises with the key. */
function bars(target, {store, t}) {
  const size = Math.max(...target.bars.map(bar => Math.abs(bar.effect)), 1e-300), unit = unitText(target.relative ? "%" : target.unit);
  return target.bars.map(bar => {
    const title = `${bar.key} ± ${bar.step ?? ""}: ${signed(bar.low)} … ${signed(bar.high)} ${target.unit}`;
    const track = element("i", {class: bar.effect < 0 ? "is-minus" : "is-plus", style: `--part: ${Math.abs(bar.effect) / size}`});
    const focus = () => { store.set({focus: null}); store.set({focus: bar.key}); };  // the same key twice focuses twice
    return pressable({class: "sd-bar", title}, focus, element("span", {class: "sd-bar-label"}, t(bar.label)),
      element("span", {class: "sd-bar-value"}, `${signed(bar.effect)}${unit}`), element("span", {class: "sd-bar-track"}, track));
  });
}

/** What is shown of one target, null where there is none. */
function effects(target, tools) {
  const {t} = tools, {still, unclear, failed} = target || {}, strong = target ? bars(target, tools) : [], weak = strong.splice(BARS);
  return [...strong, ...(weak.length ? [folded(t("weaker ones"), weak.length, ...weak)] : []),
    ...(still?.length ? [about(t("* dimensions have no effect.", still.length))] : []),
    ...(unclear?.length ? [about(t("The effect of * dimensions is no larger than chance.", unclear.length))] : []),
    ...(failed?.length ? [about(t("* could not be computed.", failed.length))] : [])];
}

export function createSensitivity(host, tools) {
  const {t} = tools;
  let chosen = null;  // name of the target that is looked at
  function shown({targets = []}) {
    const list = element("div", {class: "sd-bars"}), option = target => element("option", {value: target.name}, t(target.label));
    const group = (kind, text) => element("optgroup", {label: text}, ...targets.filter(target => target.kind === kind).map(option));
    const select = element("select", {class: "pn-select", "aria-label": t("Number that is looked at")},
      group("check", t("Margins of checks")), group("value", t("Values")));
    function show() {
      const target = targets.find(target => target.name === select.value);
      chosen = target?.name;
      list.replaceChildren(...effects(target, tools));
    }
    if (targets.some(target => target.name === chosen)) select.value = chosen;
    select.addEventListener("change", show);
    show();
    return [select, about(t("Change for 1 % more of each dimension:")), list];
  }
  return createJob(host, "sensitivity", t("Run sensitivity"), t("How far each number moves when each dimension changes a little."), tools, shown);
}

// ------------------------------------------------------------------------------------------------------------------ optimise

/** Best value so far over the cases, as a stair; before there is one that meets the requirements, how far the best is from them. */
function sparkline(history, t) {
  const met = history.filter(([, value]) => value !== null).length > 1, last = history[history.length - 1][0];
  const points = history.map(([n, value, violation]) => [n, met ? value : violation]).filter(([, value]) => value !== null);
  const values = points.map(([, value]) => value), low = Math.min(...values), high = Math.max(...values);
  const x = n => (4 + n / Math.max(last, 1) * 248).toFixed(1), y = value => (high > low ? 37 - 32 * (value - low) / (high - low) : 21).toFixed(1);
  const stair = points.map(([n, value], i) => i ? `H${x(n)}V${y(value)}` : `M${x(n)} ${y(value)}`).join("");
  const looks = {viewBox: "0 0 256 42", preserveAspectRatio: "none", class: "sd-spark"};
  return drawing({...looks, role: "img", "aria-label": t("Best value over the cases")}, `${stair}H${x(last)}`);
}

/** A dotted name as words. */
function spoken(name) {
  const text = name.replace(/^check\./, "").replaceAll("_", " ").replaceAll(".", " · ");
  return text.slice(0, 1).toUpperCase() + text.slice(1);
}

/** What the search has found so far. */
function soFar({cases, history, objective}, t) {
  const value = history[history.length - 1]?.[1], met = value !== null;
  const found = met ? line(t(objective.label), `${figure(value)}${unitText(objective.unit)}`) : about(t("none meets the requirements yet"));
  return [sparkline(history, t), about(t("* designs tried", cases)), found];
}

/** Objectives and requirements of the best design, and what became of the search. */
function best(answer, {say, t, store}) {
  const sign = ok => icon(ok ? "ok" : "bad", "sd-sign"), words = answer.feasible ? t("all requirements met") : t("no design meets all requirements");
  const head = element("p", {class: `sd-outcome is-${answer.feasible ? "ok" : "bad"}`}, sign(answer.feasible), words);
  const goals = answer.objectives.map(goal => line(t(goal.label), goal.text, goal.name));
  const needs = answer.requirements.map(need => element("div", {class: `sd-need is-${need.ok ? "ok" : "bad"}`}, sign(need.ok),
    element("span", {title: need.name}, t(spoken(need.name))), element("b", {}, need.value), element("em", {}, need.limit)));
  const unknowns = answer.unknowns.map(one => line(t(one.label), one.best, `${one.key}: ${one.lower} … ${one.upper}`));
  const found = folded(t("Unknowns"), answer.unknowns.length, ...unknowns, ...answer.findings.map(text => element("p", {class: "pn-note"}, t(text))));
  const load = button(t("Load best"), () => say({what: "load", changes: answer.changes}), {testid: "load-best", look: "main"});
  const front = answer.front.rows.length > 1 ? [button(t("Show the trade-off"), () => store.set({view: "study"}))] : [];
  return [head, element("div", {class: "pn-row"}, load, ...front), element("p", {class: "pn-note"}, t(answer.message)), ...goals, ...needs, found];
}

export function createOptimise(host, tools) {
  const {t, store} = tools, meaning = t("Searches the unlocked dimensions for the best design that meets its requirements.");
  const done = answer => {
    requestAnimationFrame(() => host.scrollIntoView({block: "nearest"}));  // what was found, and the button that takes it
    return [...(answer.history.length > 1 ? [sparkline(answer.history, t)] : []), ...best(answer, tools)];
  };
  return createJob(host, "optimise", t("Optimise"), meaning, tools, answer => answer.changes ? done(answer) : soFar(answer, t),
    () => ({theme: themeOf(store.state)}));
}

// --------------------------------------------------------------------------------------------------------------------- study

export function createStudy(host, tools) {
  const {store, t} = tools, open = () => store.set({view: "study"});
  let before = null;
  const opening = store.on(["jobs"], ({jobs}) => {  // an answer that comes while one waits for it is shown
    const job = jobs?.study, came = before === "running" && job?.state === "done";
    before = job?.state;
    if (came) open();
  });
  const shown = (answer, job) => job.state === "running" ? [] :
    [about(t("* designs computed, * failed", answer.total, answer.failed)), button(t("Show the study"), open)];
  const meaning = t("Computes the cases that the design's study names: sweeps, tolerances, samples.");
  return [...createJob(host, "study", t("Run study"), meaning, tools, shown, () => ({theme: themeOf(store.state)})), opening];
}
