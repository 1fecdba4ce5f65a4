// Plots with one cursor on all of them that run over the cycle.  Dragging in one moves the clock, and so the player.
//
//   createPlots(host, plots, {clock});                       // plots: the dictionary of pack_plots, pack_plot_groups or pack_every_plot

import { element, watchTheme, watchVisible } from "./clock.js";
import { createPanel } from "./panel.js";
import { unpacked } from "./plotting.js";

const BEHIND = {colour: "muted", dash: [4, 3]};

/** Plots as groups of panels: those of `plots` by name, or bare `panels`, each standing for itself. */
const grouped = ({plots, panels}) => plots || panels.map(panel => ({name: panel.title, panels: [panel]}));

/** What the page shows beside the numbers: where it is the same, plots stay as they are and only draw other numbers. */
const structure = packed => JSON.stringify([!packed.plots, grouped(packed).map(({name, title, panels}) => [name, title, panels.map(panel =>
  [panel.title, !panel.axis, panel.series.map(({label, unit, role}) => [label, unit, role])])])]);

/**
 * Plots inside `host` that follow `options.clock`; `extra(state, panel)` gives what stands beside the title of each panel.
 * Returns {update(packed), compare(other), destroy()}: the next values of the same plots or others; what is drawn behind those of the same
 * name: the plots of another design, null, or runs [{name, colour, dash, packed}].
 */
export function createPlots(host, packed, {clock, extra}) {
  const theme = watchTheme(host, () => panels.forEach(panel => panel.draw())), places = new Map();
  let panels = [], shape = "", names = [], runs = [];
  const shared = {clock, theme, pointed: key => places.get(key),
    point(key, place) { if (places.get(key) !== place) { places.set(key, place); panels.forEach(panel => panel.show()); } }};

  function build(next) {
    panels.forEach(panel => panel.stop());
    panels = []; names = [];
    const boxes = grouped(next).map(plot => {
      const {name, title, panels: own} = plot, made = own.map(panel => createPanel(panel, next.cycle, shared, extra && (state => extra(state, panel))));
      panels.push(...made); names.push(...made.map(() => name));
      return next.plots ? element("section", {class: "dw-group", "data-testid": `plot-${name}`, "aria-label": title, style: `--count: ${own.length}`},
        ...made.map(panel => panel.node)) : made[0].node;
    });
    host.classList.toggle("dw-grouped", !!next.plots);
    host.replaceChildren(...boxes);
  }

  function update(next) {
    const wanted = structure(next);
    if (wanted === shape) grouped(next).flatMap(group => group.panels).forEach((panel, n) => panels[n].update(panel, next.cycle));
    else { build(next); shape = wanted; behind(); }
    if (next.plots) next.plots.forEach(({stale}, n) => host.children[n].classList.toggle("dw-stale", Boolean(stale)));
  }

  function compare(other) {
    runs = !other ? [] : Array.isArray(other) ? other : [{...BEHIND, name: "", packed: other}];
    runs = runs.map(run => ({...run, plots: new Map(grouped(run.packed).map(({name, panels: own}) => [name, own.map(unpacked)]))}));
    behind();
  }
  function behind() { panels.forEach((panel, n) => panel.compare(runs.map(run => ({...run, panels: run.plots.get(names[n]) || []})))); }

  host.classList.add("dw-plots");
  update(packed);
  const plots = {update, compare,
    destroy() { stop(); unwatch(); theme.stop(); clock.see(plots, false); panels.forEach(panel => panel.stop()); host.replaceChildren(); }};
  const unwatch = watchVisible(host, visible => clock.see(plots, visible));
  const stop = clock.subscribe(() => panels.forEach(panel => panel.show()));
  return plots;
}
