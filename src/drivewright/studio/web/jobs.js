// The panels of the jobs: sensitivity as bars, the search for the best design, the study; each with its run button and progress.

import { durationText } from "./costs.js";
import { historyPlot } from "./history_plot.js";
import { icon } from "./icons.js";
import { figure, unitText } from "./numbers.js";
import { button, outcome, pressable, progress, themeOf } from "./parts.js";
import { element } from "./player.js";
import { createSearchForm } from "./search_form.js";
import { createSetup } from "./setup.js";
import { createStudyForm } from "./study_form.js";

const BARS = 10;  // that are shown at once

const about = text => element("p", {class: "pn-about"}, text);
const line = (label, value, title) => element("div", {class: "sd-number"}, element("span", {title: title || false}, label), element("em"),
  element("b", {}, value));
const folded = (title, count, ...inside) => element("details", {class: "sd-findings"},
  element("summary", {}, title, element("span", {class: "sd-count"}, String(count))), ...inside);

/** How long a running job still takes, from what is done; "" before that can be told. */
function createClock(t) {
  let began = 0, gen = null;
  return job => {
    if (job.state !== "running" || !job.total || job.gen !== gen) { gen = job.gen; began = performance.now(); return ""; }
    const part = job.done / job.total, passed = (performance.now() - began) / 1000;
    return part > 0.02 && part < 1 && passed > 2 ? t("about * left at most", durationText(passed * (1 / part - 1), t)) : "";
  };
}

/**
 * Frame of a job's panel: run button, progress, words of the outcome; `shown(answer, job)` fills the rest.  `setup` is the form of its
 * table, where it has one: it opens where the design has no table yet.
 */
function createJob(host, name, title, meaning, {store, say, t}, shown, options = () => ({}), setup = null) {
  const ask = () => setup?.wanted() ? setup.open() : say({what: "job", name, options: options()});
  const run = button(title, ask, {testid: `job-${name}`, look: "main"}), row = element("div", {class: "pn-row"}, run, ...(setup ? [setup.opener] : []));
  const bar = progress(name, {say, t}), left = element("p", {class: "pn-about"}), note = outcome(t), words = about(meaning), answer = element("div", {class: "pn-answer"});
  const remaining = createClock(t);
  let before = null;
  host.append(words, row, ...(setup ? [setup.node] : []), bar.node, left, note.node, answer);
  return [...(setup?.stops || []), store.on(["jobs"], ({jobs}) => {
    const job = jobs?.[name] || {state: "idle"};
    if (job === before) return;
    if (job.state !== before?.state) setup?.follow(job);
    const begun = job.state === "running" && before && before.state !== "running";
    before = job;
    bar.show(job); note.show(job);
    left.textContent = remaining(job);
    left.hidden = !left.textContent;
    row.hidden = job.state === "running";
    words.hidden = Boolean(job.answer) || job.state === "running";
    answer.replaceChildren(...(job.answer ? shown(job.answer, job) : []));
    if (begun) host.closest(".sd-section").scrollIntoView({block: "start"});  // its form, which was taller, is out of the way
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

/** The target to begin with: the worst of the checks that fail, else the tightest one. */
function tightest(result) {
  const share = ({name}) => result.fractions?.[name] ?? Infinity, checks = [...result?.checks || []];
  const [worst] = checks.sort((a, b) => a.ok - b.ok || share(a) - share(b));
  return worst && `check.${worst.name}`;
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
  const {store, t} = tools;
  let chosen = null;  // name of the target that was picked by hand
  function shown({targets = []}) {
    const list = element("div", {class: "sd-bars"}), option = target => element("option", {value: target.name}, t(target.label));
    const group = (kind, text) => element("optgroup", {label: text}, ...targets.filter(target => target.kind === kind).map(option));
    const select = element("select", {class: "pn-select", "aria-label": t("Number that is looked at")},
      group("check", t("Margins of checks")), group("value", t("Values")));
    function show() {
      const target = targets.find(target => target.name === select.value);
      list.replaceChildren(...effects(target, tools));
    }
    const first = targets.some(target => target.name === chosen) ? chosen : tightest(store.state.result);
    if (targets.some(target => target.name === first)) select.value = first;
    select.addEventListener("change", () => { chosen = select.value; show(); });
    show();
    return [select, about(t("Change for 1 % more of each dimension:")), list];
  }
  return createJob(host, "sensitivity", t("Run sensitivity"), t("How far each number moves when each dimension changes a little."), tools, shown);
}

// ------------------------------------------------------------------------------------------------------------------ optimise

/** A dotted name as words. */
function spoken(name) {
  const text = name.replace(/^check\./, "").replaceAll("_", " ").replaceAll(".", " · ");
  return text.slice(0, 1).toUpperCase() + text.slice(1);
}

/** What the search has found so far; after it was cancelled too, with a way to keep it. */
function soFar({cases, history, objective, best}, job, {say, t}) {
  const value = history[history.length - 1]?.[1], met = value !== null;
  const found = met ? line(t(objective.label), `${figure(value)}${unitText(objective.unit)}`) : about(t("none meets the requirements yet"));
  const keep = button(t("Load best so far"), () => say({what: "load", changes: best}), {testid: "load-so-far", look: "main"});
  return [historyPlot(history, objective, t, job.state === "running" ? job.total : 0), about(t("* designs tried", cases)), found, element("div", {class: "pn-row"}, keep)];
}

/** Objectives and requirements of the best design, and what became of the search. */
function best(answer, {say, t, store}) {
  const sign = ok => icon(ok ? "ok" : "bad", "sd-sign"), words = answer.feasible ? t("all requirements met") : t("no design meets all requirements");
  const head = element("p", {class: `sd-outcome is-${answer.feasible ? "ok" : "bad"}`}, sign(answer.feasible), words);
  const goals = answer.objectives.map(goal => line(t(goal.label), goal.text, goal.name));
  const unmet = answer.requirements.filter(need => !need.ok), met = answer.requirements.filter(need => need.ok);
  const needs = list => list.map(need => element("div", {class: `sd-need is-${need.ok ? "ok" : "bad"}`}, sign(need.ok),
    element("span", {title: need.name}, t(spoken(need.name))), element("b", {}, need.value), element("em", {}, need.limit)));
  const unknowns = answer.unknowns.map(one => line(t(one.label), one.best, `${one.key}: ${one.lower} … ${one.upper}`));
  const found = folded(t("Unknowns"), answer.unknowns.length, ...unknowns, ...answer.findings.map(text => element("p", {class: "pn-note"}, t(text))));
  const load = button(t("Load best"), () => say({what: "load", changes: answer.changes}), {testid: "load-best", look: "main"});
  const front = answer.tried ? [button(t("Show the trade-off"), () => store.set({view: "study"}))] : [];
  const kept = met.length ? [folded(t("Requirements met"), met.length, ...needs(met))] : [];
  return [head, element("p", {class: "pn-note"}, t(answer.message)), element("div", {class: "pn-row"}, load, ...front), ...goals, ...needs(unmet), ...kept, found];
}

export function createOptimise(host, tools) {
  const {t, store} = tools, meaning = t("Searches the unlocked dimensions for the best design that meets its requirements.");
  const setup = createSetup("optimise", t("Set up"), tools, createSearchForm);
  const done = answer => [...best(answer, tools), ...(answer.history.length > 1 ? [historyPlot(answer.history, answer.objective, t)] : [])];
  return [...createJob(host, "optimise", t("Optimise"), meaning, tools, (answer, job) => answer.changes ? done(answer) : soFar(answer, job, tools),
    () => ({theme: themeOf(store.state)}), setup), opening("optimise", tools, answer => answer.tried?.rows.length > 1)];
}

// --------------------------------------------------------------------------------------------------------------------- study

/** What comes while one waits for it is shown in the centre, once a run and as soon as there is something to see. */
function opening(name, {store}, worth) {
  let before = null, opened = false;
  return store.on(["jobs"], ({jobs}) => {
    const job = jobs?.[name], running = job?.state === "running";
    if (running && before !== "running") opened = false;
    const came = !opened && (running || before === "running" && job?.state === "done") && job.answer && worth(job.answer);
    before = job?.state;
    if (came) { opened = true; store.set({view: "study"}); }
  });
}

export function createStudy(host, tools) {
  const {store, t} = tools, setup = createSetup("study", t("Set up"), tools, createStudyForm);
  const words = answer => answer.failed === undefined ? t("* of * designs", answer.rows.length, answer.total) : t("* designs computed, * failed", answer.total, answer.failed);
  const shown = (answer, job) => job.state === "running" ? [] :
    [about(words(answer)), ...(answer.failed ? answer.statements?.reasons || [] : []).map(({count, text}) => element("p", {class: "pn-note"}, `${count} × ${t(text)}`)), button(t("Show the study"), () => store.set({view: "study"}))];
  const meaning = t("Computes many cases of the design: sweeps over levels, tolerances, samples.");
  return [...createJob(host, "study", t("Run study"), meaning, tools, shown, () => ({theme: themeOf(store.state)}), setup), opening("study", tools, answer => answer.rows.length > 1)];
}
