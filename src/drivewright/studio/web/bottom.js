// The plots pane below: which panels are shown, the runs drawn behind them, its height.

import { overlays, translated } from "./overlays.js";
import { createPictures } from "./pictures.js";
import { createPicker } from "./picker.js";
import { csvText, saveText, svgText } from "./plotfiles.js";
import { pressable, same } from "./parts.js";
import { element } from "./player.js";
import { createPlots } from "./plots.js";
import { createRuns } from "./runs.js";
import { createSplitter } from "./splitter.js";

const KEPT = "drivewright-plots";

/** Plots of a result in the language of the page: the panels that `chosen` names, in the order of the names. */
function chosenPlots({cycle, plots, first}, chosen, t) {
  const rank = id => (first.indexOf(id) + 1 || first.length + 1), wanted = new Set(chosen);
  const own = plots.map(plot => ({...plot, panels: plot.panels.filter(({id}) => wanted.has(id))})).filter(({panels}) => panels.length);
  const best = ({panels}) => Math.min(...panels.map(({id}) => rank(id)));
  return {cycle: cycle && {...cycle, label: t(cycle.label), marks: cycle.marks.map(([u, label]) => [u, t(label)])},
    plots: own.sort((a, b) => best(a) - best(b)).map(plot => ({...plot, title: t(plot.title), panels: plot.panels.map(panel => translated(panel, t))}))};
}

const recalled = () => { try { return JSON.parse(localStorage.getItem(KEPT)) || {}; } catch { return {}; } };

/** The pane in `host`, hidden where the result has no plots. */
export function createBottom(host, tools) {
  const {store, t, clock} = tools, memory = {height: 0, chosen: {}, ...recalled()};
  const bar = element("div", {class: "bt-bar"}), scroll = element("div", {class: "bt-scroll", "data-testid": "plots"});
  const plotted = element("div"), pictured = element("div", {class: "bt-pictures"}), none = element("p", {class: "bt-none", hidden: ""});
  const keep = () => { try { localStorage.setItem(KEPT, JSON.stringify(memory)); } catch { /* a full or forbidden storage */ } };
  let plots = null, first = [], drive = null, lang = "", seen = null, picker = null, runs = null, drawn = null;

  const kind = () => store.state.design?.kind ?? "";
  /** Ids of what is shown: as chosen for this kind of drive, else what a full result begins with. */
  function chosen() {
    const result = store.state.result;
    if (result?.plots && (result.full || !first.length)) first = result.plots.first;
    return memory.chosen[kind()] || first;
  }
  function choose(ids) {
    if (ids) memory.chosen[kind()] = ids; else delete memory.chosen[kind()];
    keep();
    seen = null;
    update(store.state);
  }

  const splitter = createSplitter(host, memory, keep, t);
  const pictures = createPictures(pictured, tools);
  scroll.append(none, plotted, pictured);
  host.append(splitter.node, bar, scroll);

  function build() {
    picker?.destroy(); runs?.destroy(); plots?.destroy();
    plots = null;
    picker = createPicker(tools, {chosen, choose, plots: () => store.state.result?.plots?.plots || []});
    runs = createRuns(tools, compare);
    splitter.reword();
    none.textContent = t("No plot is chosen.");
    bar.replaceChildren(element("h2", {}, t("Plots")), picker.node, runs.node);
  }
  function compare() {
    if (!plots) return;
    const ids = chosen();
    plots.compare(overlays(store.state, t).map(({plots: theirs, ...run}) => ({...run, packed: chosenPlots(theirs, ids, t)})));
  }
  const exported = (state, {series}) => {
    const save = (ending, type, text) => {
      const title = t("Download this plot as *", ending.toUpperCase()), stem = store.state.design.name || kind();
      return pressable({class: "bt-export", "data-testid": `plot-${ending}`, title, "aria-label": `${series.map(({label}) => label).join(", ")}: ${title}`}, () => saveText(`${stem}-${state().panel.id.replace("/", "-")}.${ending}`, type, text(state())), ending.toUpperCase());
    };
    return [element("span", {class: "bt-exports"}, save("svg", "image/svg+xml", one => svgText(one, store.state.design.title)), save("csv", "text/csv", csvText))];
  };
  function update({result, lang: now, design}) {
    if (design?.opened !== drive) { drive = design?.opened; first = []; plots?.destroy(); plots = null; seen = null; }
    if (now !== lang) { lang = now; build(); seen = null; }
    if (result && result === seen) return;  // a step of a drag, of which no analysis has an answer
    seen = result;
    const has = Boolean(result?.plots);
    host.classList.toggle("st-none", !has);
    if (!has) return;
    const ids = chosen(), look = [ids.join(), JSON.stringify(result.plots.cycle), lang, ...result.plots.plots.flatMap(({panels, stale}) => [panels, Boolean(stale)])];
    if (plots && same(look, drawn)) return;  // what the analyses beside a drag leave as it was
    drawn = look;
    const packed = chosenPlots(result.plots, ids, t), images = result.plots.plots.filter(({name, picture}) => picture && ids.includes(name));
    none.hidden = packed.plots.length + images.length > 0;
    pictures.show(images);
    picker.show();
    if (plots) plots.update(packed); else { plots = createPlots(plotted, packed, {clock, extra: exported}); compare(); }
  }
  const stops = [store.on(["result", "lang", "design"], update), store.on(["reference", "kept"], compare)];
  return {destroy() { stops.forEach(stop => stop()); picker?.destroy(); runs?.destroy(); pictures.destroy(); splitter.destroy(); plots?.destroy(); }};
}
