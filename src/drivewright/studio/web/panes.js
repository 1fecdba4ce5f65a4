// Small screens: form, mechanism, checks and plots as tabs; on a tablet the mechanism stays beside what is chosen.

import { pressable, put } from "./parts.js";

const NARROW = "(max-width: 899px)";
const PANES = {form: "form", mechanism: "centre", checks: "side", plots: "plots"};  // tab -> place

/**
 * The row of tabs in `host`; `frame` is the grid, `places` {head, form, centre, side, plots} are its parts.
 * Where the screen is wide every place is in view, and the row is hidden.
 */
export function createPanes(host, {store, t}, frame, places) {
  const narrow = matchMedia(NARROW), names = Object.keys(PANES), tabs = {};
  const bare = () => places.plots.classList.contains("st-none");

  function add(name) {
    const act = () => store.set({pane: name});
    tabs[name] = pressable({role: "tab", id: `pane-tab-${name}`, class: "st-pane-tab", "data-testid": `pane-${name}`}, act);
    places[PANES[name]].id = `pane-${name}`;
    tabs[name].setAttribute("aria-controls", `pane-${name}`);
  }
  function keys(event) {
    const step = {ArrowRight: 1, ArrowLeft: -1, ArrowDown: 1, ArrowUp: -1}[event.key], open = names.filter(name => !tabs[name].disabled);
    if (!step) return;
    const next = open[(open.indexOf(store.state.pane) + step + open.length) % open.length];
    event.preventDefault();
    store.set({pane: next});
    tabs[next].focus();
  }
  /** What is chosen, and the roles of places: they are panels of tabs only where there are tabs. */
  function show() {
    const {pane} = store.state;
    frame.dataset.pane = pane;
    for (const name of names) {
      const place = places[PANES[name]];
      tabs[name].setAttribute("aria-selected", String(name === pane)); tabs[name].tabIndex = name === pane ? 0 : -1;
      if (narrow.matches) { place.setAttribute("role", "tabpanel"); place.setAttribute("aria-labelledby", `pane-tab-${name}`); }
      else { place.removeAttribute("role"); place.removeAttribute("aria-labelledby"); }
    }
  }
  /** A drive without plots has no tab for them. */
  function plots() {
    tabs.plots.disabled = bare();
    if (bare() && store.state.pane === "plots") store.set({pane: "mechanism"});
  }
  function reword() {
    host.setAttribute("aria-label", t("Parts of the page"));
    const words = {form: t("Form"), mechanism: t("Mechanism"), checks: t("Checks"), plots: t("Plots")};
    for (const name of names) put(tabs[name], words[name]);
  }
  names.forEach(add);
  host.setAttribute("role", "tablist");
  host.append(...Object.values(tabs));
  host.addEventListener("keydown", keys);
  narrow.addEventListener("change", show);
  const watching = new MutationObserver(plots);
  watching.observe(places.plots, {attributeFilter: ["class"]});
  plots();
  // What asks to be seen comes into view: a field, a view of the mechanism.
  const stops = [store.on(["lang"], reword), store.on(["pane"], show), store.on(["focus"], ({focus}) => { if (focus) store.set({pane: "form"}); }),
    store.on(["view"], ({view}) => { if (view !== "motion") store.set({pane: "mechanism"}); })];
  return {destroy() { stops.forEach(stop => stop()); watching.disconnect(); narrow.removeEventListener("change", show); }};
}
