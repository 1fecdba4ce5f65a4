// The solids of a design: its parts, asked for when the pane opens, and the fields that analyses compute on them, on request.

import { createAsked } from "./asked.js";
import { createAssembly } from "./assembly_bar.js";
import { createFields, titleOf } from "./deformed.js";
import { pressable } from "./parts.js";
import { element } from "./player.js";

const PARTS = "";  // what is shown unless an analysis is chosen

/** The pane of the solids in `host`. */
export function createSolids(host, tools) {
  const {store, t, clock} = tools;
  const row = element("div", {class: "so-modes", role: "group", "aria-label": t("What is shown"), hidden: ""});
  const geometry = element("div", {class: "so-pane"}), place = element("div", {class: "so-pane", hidden: ""});
  let assembly = null, fields = null, chosen = PARTS, opened = false;
  host.append(row, geometry, place);

  function shown(body, answer) {
    body.classList.add("vw-solid");
    assembly ||= createAssembly(body, {t, clock});
    assembly.load(answer);
    assembly.highlight(store.state.lit);
    offer(answer.analyses || []);
  }
  /** A button for the parts and one for each analysis with fields. */
  function offer(analyses) {
    const choices = [[PARTS, t("Parts"), null], ...analyses.map(one => [one.name, titleOf(one.name, t), one])];
    row.hidden = !analyses.length;
    host.classList.toggle("has-modes", !row.hidden);
    row.replaceChildren(...choices.map(([name, text, one]) => pressable({"data-mode": name, "data-testid": `solid-${name || "parts"}`,
      title: one ? t(one.meaning) : false}, () => choose(name, one), text)));
    const kept = choices.find(([name]) => name === chosen) || choices[0];
    choose(kept[0], kept[2]);
  }
  function choose(name, analysis) {
    if (fields && name !== PARTS && fields.name !== name) { fields.destroy(); fields = null; place.replaceChildren(); }
    chosen = name;
    geometry.hidden = name !== PARTS; place.hidden = name === PARTS;
    for (const made of row.children) made.setAttribute("aria-pressed", String(made.dataset.mode === name));
    if (name === PARTS) return;
    fields ||= createFields(place, analysis, tools);
    if (opened) fields.open();
  }
  const pane = createAsked(geometry, "solid", tools, {wanted: t("Solid parts of this design"), shown});
  const stops = [
    store.on(["lit"], ({lit}) => assembly?.highlight(lit)),
    store.on(["design"], (() => {
      let drive = store.state.design?.opened;
      return ({design}) => { if (design && design.opened !== drive) { drive = design.opened; offer([]); } };  // another drive has other analyses
    })()),
  ];
  return {
    ...pane,
    open() { opened = true; pane.open(); fields?.open(); },
    close() { opened = false; pane.close(); },
    destroy() { stops.forEach(stop => stop()); pane.destroy(); fields?.destroy(); assembly?.destroy(); },
  };
}
