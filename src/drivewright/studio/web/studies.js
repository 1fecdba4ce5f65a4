// The designs of a study, or of a search for the best one: as points that can be loaded, with the figures of the study below.

import { empty } from "./asked.js";
import { gallery } from "./figures.js";
import { numberOf, unitText } from "./numbers.js";
import { button, pressable } from "./parts.js";
import { element } from "./player.js";
import { createScatter } from "./scatter.js";

/** The design as it stands, as a row of a study: its dimensions by key where they speak the unit of their column, values, margins of checks. */
function standing({design, result}, columns) {
  const found = {}, units = new Map(columns.map(({name, unit}) => [name, unit]));
  for (const {name, number} of result?.values || []) found[name] = numberOf(number);
  for (const {name, margin} of result?.checks || []) found[`check.${name}`] = numberOf(margin);
  for (const group of design?.form.groups || []) for (const field of group.fields) for (const part of field.parts || [field])
    if (typeof part.value === "number" && unitText(part.unit) === unitText(units.get(part.key))) found[part.key] = part.value;
  return found;
}

const offs = new WeakMap();

/** The designs that a search with several objectives has tried, as a study has them; null with a single objective. */
function tradeOff(answer) {
  if (!answer?.tried) return null;
  if (!offs.has(answer)) offs.set(answer, {...answer.tried, figures: answer.figures, failed: 0});
  return offs.get(answer);
}

/** The pane of the study in `host`. */
export function createStudies(host, {store, say, t}) {
  const choice = element("div", {class: "dw-segments vw-sources"}), plot = element("div", {class: "vw-scatter"});
  const figures = element("div", {class: "vw-study-figures"}), page = element("div", {class: "vw-scroll vw-study"}, choice, plot, figures);
  const begin = (name, text) => button(text, () => store.set({setup: name, pane: "checks"}), {testid: `begin-${name}`});
  const none = empty(element("b", {}, t("No study has been run yet")), element("p", {},
    t("Run a study or an optimisation with several objectives on the right; its designs appear here as points, and a click loads one.")),
    element("div", {class: "pn-row"}, begin("study", t("Set up the study")), begin("optimise", t("Set up the search"))));
  const sources = [["study", t("Study")], ["optimise", t("Optimisation")]];
  let scatter = null, shown = null, chosen = null, before = {};
  host.append(page, none);

  function sourceButton([name, text]) {
    return pressable({"aria-pressed": String(name === chosen)}, () => { chosen = name; update(store.state); }, text);
  }
  function update({jobs = {}}) {
    const tables = {study: jobs.study?.answer, optimise: tradeOff(jobs.optimise?.answer)};
    const ready = sources.filter(([name]) => tables[name]?.rows?.length);
    for (const [name] of ready) if (tables[name] !== before[name]) chosen = name;
    before = Object.fromEntries(ready.map(([name]) => [name, tables[name]]));
    if (!(chosen in before)) chosen = ready[0]?.[0];
    none.hidden = ready.length > 0; page.hidden = !ready.length;
    choice.hidden = ready.length < 2;
    choice.replaceChildren(...ready.map(sourceButton));
    show();
  }
  function show() {
    const answer = chosen && before[chosen];
    if (!answer || answer === shown) return;
    shown = answer;
    scatter ||= createScatter(plot, {say, t, now: () => standing(store.state, shown.columns)});
    scatter.load(answer);
    figures.replaceChildren(...(answer.figures?.length ? gallery(answer.figures, t) : []));
  }
  const stops = [store.on(["jobs"], update), store.on(["design", "result"], () => { if (!host.hidden) scatter?.mark(); })];
  return {open() { scatter?.mark(); }, close() {}, destroy() { stops.forEach(stop => stop()); scatter?.destroy(); }};
}
