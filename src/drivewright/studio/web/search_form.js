// The form of a search: what may change, what is wanted, which checks hold, how long.  Start writes the table and begins.

import { designsOf, durationText, generationsFor, members, secondsOf } from "./costs.js";
import { box, choice, createKeyList, part, tick } from "./key_list.js";
import { numberOf, withUnit } from "./numbers.js";
import { button, put, themeOf, tool } from "./parts.js";
import { element } from "./player.js";

const USUAL = 500, LONG = 300;  // designs; seconds that a budget proposes at most
const GOALS = ["minimise", "maximise", "at_least", "at_most"];
const CHECK = "check.";

/** Lower and upper bound of an unknown. */
function bounds({key, label, lower, upper, entry}, t) {
  const low = box(entry?.lower ?? lower, `${t(label)}: ${t("lower bound")}`, `search-lower-${key}`);
  const high = box(entry?.upper ?? upper, `${t(label)}: ${t("upper bound")}`, `search-upper-${key}`);
  return {node: element("div", {class: "sf-bounds"}, low, element("span", {}, "…"), high), value: () => ({lower: low.value, upper: high.value})};
}

/** Rows of values with what is wanted of each. */
function createGoals({store, t}, changed) {
  const list = element("div", {class: "sf-goals"}), names = {minimise: t("minimise"), maximise: t("maximise"), at_least: t("at least"), at_most: t("at most")};
  const more = button(t("Add another"), () => { add(); changed(); }, {testid: "search-add", look: "quiet"}), node = element("div", {}, list, more);
  let rows = [];

  /** Values to choose from: the key numbers first, then all others, then the margins of the checks. */
  function options(value) {
    const {result} = store.state, first = new Set((result?.headline || []).map(({name}) => name)), values = result?.values || [];
    const text = each => [each.name, `${t(each.label)} (${each.shown})`], told = [...values.map(({name}) => name), ...(result?.checks || []).map(({name}) => CHECK + name)];
    const group = (label, each) => each.length ? [element("optgroup", {label}, ...each.map(([name, words]) => element("option", {value: name}, words)))] : [];
    const other = value && !told.includes(value) ? [[value, value]] : [];
    return [element("option", {value: ""}, t("choose a value …")), ...group(t("Key numbers"), values.filter(({name}) => first.has(name)).map(text)),
      ...group(t("Values"), [...values.filter(({name}) => !first.has(name)).map(text), ...other]),
      ...group(t("Margins of checks"), (result?.checks || []).map(({name, label}) => [CHECK + name, t(label)]))];
  }
  function add({value = "", goal = "minimise", limit = ""} = {}) {
    const at = rows.length ? Math.max(...rows.map(row => row.at)) + 1 : 0;
    const select = choice([], "", t("Value"), `search-value-${at}`, changed), wish = choice(GOALS.map(name => [name, names[name]]), goal, t("Goal"), `search-goal-${at}`, kind);
    const bound = box(limit, t("Limit"), `search-limit-${at}`), away = tool("cross", t("Remove"), () => { rows = rows.filter(each => each !== row); row.node.remove(); changed(); });
    const row = {at, node: element("div", {class: "sf-goal"}, select, wish, bound, away), refresh, value: () => ({value: select.value, goal: wish.value, limit: bound.value})};
    function kind() { bound.hidden = wish.value.startsWith("m"); unit(); changed(); }
    /** The limit begins with the number that the value has now. */
    function unit() {
      const now = store.state.result?.values.find(({name}) => name === select.value);
      if (!bound.hidden && !bound.value && now) bound.value = withUnit(numberOf(now.number), now.unit === "-" ? "" : now.unit);
    }
    function refresh() { const kept = select.value || value; select.replaceChildren(...options(kept)); select.value = kept; }
    select.addEventListener("change", unit);
    bound.addEventListener("input", changed);
    refresh();
    bound.hidden = wish.value.startsWith("m");
    rows.push(row);
    list.append(row.node);
  }
  const given = () => rows.map(row => row.value()).filter(({value}) => value);
  return {
    node, refresh() { rows.forEach(row => row.refresh()); },
    load(table, checks) {
      rows = [];
      list.replaceChildren();
      for (const {value, goal} of table?.objectives || []) add({value, goal: goal || "minimise"});
      for (const need of table?.requirements || []) for (const side of ["at_least", "at_most"])
        if (need[side] !== undefined && !checks.has(need.value)) add({value: need.value, goal: side, limit: String(need[side])});
      if (!rows.length) add();
    },
    objectives: () => given().filter(({goal}) => goal.startsWith("m")).map(({value, goal}) => ({value, goal})),
    limits: () => given().filter(({goal}) => goal.startsWith("at")).map(({value, goal, limit}) => ({value, [goal]: typed(limit, store.state.result, value)})),
  };
}

/** A limit as the table takes it: a bare number has the unit that the value is shown in. */
function typed(text, result, name) {
  const unit = result?.values.find(value => value.name === name)?.unit || "", plain = text.replaceAll("−", "-").trim();
  return /^[-+]?[\d.]+(e[-+]?\d+)?$/i.test(plain) && unit !== "-" ? withUnit(plain, unit) : plain;
}

/** The checks that a design must pass. */
function createNeeds({store, t}, changed) {
  const node = element("div", {class: "sf-keys", role: "group", "aria-label": t("Checks to respect")}), left = new Set();
  function draw() {
    const checks = store.state.result?.checks || [], set = (name, on) => { if (on) left.delete(name); else left.add(name); changed(); };
    node.replaceChildren(...checks.map(({name, label}) => tick(!left.has(name), [element("span", {class: "sf-name", title: name}, t(label))], `search-check-${name}`, on => set(name, on))));
    if (!checks.length) node.append(element("p", {class: "pn-about"}, t("The checks appear when the design has been analysed.")));
  }
  return {
    node, draw,
    /** All of them, or those that a table names. */
    load(table) {
      const named = new Set((table?.requirements || []).map(({value}) => value));
      left.clear();
      if (table) for (const {name} of store.state.result?.checks || []) if (!named.has(CHECK + name)) left.add(name);
      draw();
    },
    chosen: () => (store.state.result?.checks || []).filter(({name}) => !left.has(name)).map(({name}) => ({value: CHECK + name})),
  };
}

/** The form in a node of its own: {node, load(), refused(text)}; `closed()` is called when it is put away. */
export function createSearchForm(tools, closed) {
  const {store, say, t} = tools, goals = createGoals(tools, changed), needs = createNeeds(tools, changed);
  const keys = createKeyList("search", tools, key => bounds(key, t), changed);
  const method = choice([["auto", t("automatic")], ["differential-evolution", t("differential evolution")], ["nsga2", "NSGA-II"]], "auto", t("Method"), "search-method", changed);
  const budget = box("", t("Designs to try at most"), "search-budget", {inputmode: "numeric"}), estimate = element("p", {class: "pn-about", "data-testid": "search-estimate", role: "status"});
  const wrong = element("p", {class: "pn-note pn-bad", role: "alert", "data-testid": "search-refused", hidden: ""});
  const start = button(t("Start"), begin, {testid: "search-start", look: "main"}), away = button(t("Close"), closed, {testid: "search-close", look: "quiet"});
  const node = element("div", {class: "sf", role: "group", "aria-label": t("Set up the search"), "data-testid": "search-form"},
    part(t("What may change"), keys.node), part(t("What is wanted"), goals.node), part(t("Checks to respect"), needs.node),
    part(t("How it searches"), element("label", {class: "sf-pair"}, t("Method"), method), element("label", {class: "sf-pair"}, t("Designs to try at most"), budget)),
    element("div", {class: "sf-foot"}, wrong, estimate, element("div", {class: "pn-row"}, start, away)));
  let table = null, ready = false, among = [];

  function size(several) { return members(keys.chosen().length, several, table?.population); }
  function content() {
    const unknowns = keys.chosen(), objectives = goals.objectives(), several = method.value === "nsga2" || objectives.length > 1;
    const limited = (table?.requirements || []).filter(({value, at_least, at_most}) => value.startsWith(CHECK) && (at_least ?? at_most) !== undefined);
    const named = needs.chosen(), kept = named.map(need => limited.find(({value}) => value === need.value) || need);
    return {unknowns, objectives, requirements: [...kept, ...goals.limits()], method: method.value, generations: generationsFor(Number(budget.value) || USUAL, size(several), several)};
  }
  function changed() {
    if (!ready) return;
    const {unknowns, objectives, requirements, generations} = content(), several = method.value === "nsga2" || objectives.length > 1;
    const each = secondsOf(store, [...objectives, ...requirements].map(({value}) => value)), designs = designsOf(generations, size(several), several);
    const missing = !unknowns.length ? t("Tick at least one dimension that may change.") : !objectives.length ? t("Choose a value to minimise or maximise.")
      : !(Number(budget.value) > 0) ? t("Give a number of designs.") : "";
    start.disabled = Boolean(missing);
    put(estimate, missing || (each === null ? t("* designs", designs) : designs * each < 1 ? t("* designs, less than 1 s", designs) : t("* designs, at most about * by one process", designs, durationText(designs * each, t))));
  }
  /** A budget that takes some minutes at most. */
  function usual() {
    const each = secondsOf(store) || 0;
    return each > 0 ? Math.min(USUAL, Math.max(64, Math.round(LONG / each / 10) * 10)) : USUAL;
  }
  function load({keys: found, optimise}) {
    among = found;
    table = optimise;
    ready = false;
    keys.load(found.filter(({kind}) => kind !== "choice" && kind !== "flag"), Object.fromEntries((optimise?.unknowns || []).map(one => [one.key, one])));
    goals.load(optimise, new Set((store.state.result?.checks || []).map(({name}) => CHECK + name)));
    needs.load(optimise);
    method.value = optimise?.method || "auto";
    const several = method.value === "nsga2" || (optimise?.objectives || []).length > 1;
    budget.value = optimise?.budget ?? String(optimise?.generations ? designsOf(optimise.generations, size(several), several) : usual());
    ready = true;
    changed();
  }
  function begin() { say({what: "begin", name: "optimise", table: content(), options: {theme: themeOf(store.state)}}); }
  budget.addEventListener("input", changed);
  return {
    node, load,
    /** What load() takes to come back to what is in the form now. */
    draft: () => ({keys: among, optimise: {...table, ...content(), budget: budget.value}}),
    result() { if (ready) { goals.refresh(); needs.draw(); changed(); } },
    refused(text) { wrong.hidden = !text; put(wrong, text); },
  };
}
