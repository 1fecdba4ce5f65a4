// Runs that are kept to be drawn behind the plots: a colour, a name, a switch for each.

import { icon } from "./icons.js";
import { pressable } from "./parts.js";
import { element } from "./player.js";

const MOST = 4, DASHES = [[7, 3], [2, 3], [7, 3, 2, 3], [11, 4]], LONGEST = 24;  // characters of a name

/** A row of the kept runs; `changed()` is called when one is switched. */
export function createRuns({store, t}, changed) {
  const keep = pressable({class: "st-button", "data-testid": "run-keep", title: t("Keep this run: its curves stay behind those that follow")}, add,
    icon("plus"), element("span", {class: "st-word"}, t("Keep this run")));
  const list = element("div", {class: "bt-runs", role: "group", "aria-label": t("Kept runs")}), node = element("div", {class: "bt-kept"}, keep, list);
  let shape = "", drive = store.state.design?.opened;

  const runs = () => store.state.kept || [];
  const edit = (id, patch) => store.set({kept: runs().map(run => run.id === id ? {...run, ...patch} : run)});
  function add() {
    const {result} = store.state, taken = runs().map(({place}) => place), place = [0, 1, 2, 3].find(n => !taken.includes(n));
    if (place === undefined || !result?.plots) return;
    const id = 1 + Math.max(0, ...runs().map(run => run.id));
    store.set({kept: [...runs(), {id, place, name: `${t("Run")} ${id}`, colour: `run-${place + 1}`, dash: DASHES[place], on: true, plots: result.plots}]});
  }
  function chip({id, name, colour, on}) {
    const toggle = pressable({class: "bt-toggle", "data-testid": `run-${id}`, "aria-pressed": String(on), title: t("Show or hide this run"),
      "aria-label": `${name}: ${t("Show or hide this run")}`, style: `--chip: var(--${colour})`}, () => edit(id, {on: !runs().find(run => run.id === id).on}), element("i"));
    const box = element("input", {class: "bt-name", maxlength: LONGEST, size: Math.max(4, name.length), "aria-label": t("Name of the run"), "data-testid": `run-name-${id}`});
    box.value = name;
    box.addEventListener("change", () => edit(id, {name: box.value.trim() || name}));
    const drop = pressable({class: "bt-drop", title: t("Remove this run"), "aria-label": `${name}: ${t("Remove this run")}`, "data-testid": `run-drop-${id}`},
      () => store.set({kept: runs().filter(run => run.id !== id)}), icon("cross"));
    return element("span", {class: `bt-run${on ? "" : " is-off"}`}, toggle, box, drop);
  }
  function show() {
    const wanted = JSON.stringify(runs().map(({id, name, on}) => [id, name, on]));
    if (wanted === shape) return;
    shape = wanted;
    const focus = document.activeElement?.dataset?.testid;
    list.replaceChildren(...runs().map(chip));
    if (focus) list.querySelector(`[data-testid="${CSS.escape(focus)}"]`)?.focus();
    changed();
  }
  const stops = [store.on(["kept"], show), store.on(["result", "kept"], ({result}) => { keep.disabled = runs().length >= MOST || !result?.full; }),
    store.on(["design"], ({design}) => { if (design?.opened !== drive) { drive = design?.opened; store.set({kept: []}); } })];
  return {node, destroy() { stops.forEach(stop => stop()); }};
}
