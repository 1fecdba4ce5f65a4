// The centre: the moving mechanism, its solids, its figures, and the designs of a study, one at a time.

import { createBuilder } from "./builder.js";
import { SIDES, createDiagrams } from "./diagrams.js";
import { createFigures } from "./figures.js";
import { createHandles } from "./handles.js";
import { createMeasure } from "./measure.js";
import { createMotionForm } from "./motion_form.js";
import { button, pressable, putAttribute } from "./parts.js";
import { element } from "./player.js";
import { createSolids } from "./solids.js";
import { createStudies } from "./studies.js";
import { reasonsOf, refusedText } from "./words.js";

// -------------------------------------------------------------------------------------------------------------------- motion

const LATE = 4000;  // ms
const ROOM = 0.35;  // of its size: a drawing to build on has room around it
const FIRST = "the first drawing after installation compiles for up to a minute";

/** The player, and what there is to say where nothing can be drawn.  `reword()` writes its words anew, and leaves the view as it is. */
function createMotion(host, tools) {
  const {store, say, t, clock, createPlayer} = tools;
  const stage = element("div", {class: "vw-player"}), note = element("div", {class: "vw-note", role: "status", hidden: ""});
  let player = null, shown = null, compared = null, late = false, timer = 0, drive = null;
  const handles = createHandles(() => player, tools), measure = createMeasure(() => player, tools);
  host.append(stage, note);
  const builder = createBuilder(() => player, tools), diagrams = createDiagrams(host, () => player, tools, () => player?.fit());
  const picked = name => measure.active() || builder.active() || store.set({lit: store.state.lit.length === 1 && store.state.lit[0] === name ? [] : [name]});
  function load(scene) {
    const labels = scene.scene.labels?.map(label => ({...label, text: t(label.text)})), packed = {...scene.scene, ...(labels ? {labels} : {}), gen: scene.gen}, afresh = drive !== store.state.design?.opened;
    drive = store.state.design?.opened;
    shown = scene;
    measure.expect(afresh);
    handles.load(scene.scene); builder.load(scene.scene);  // before the player draws: what lies upon the drawing is that of its bodies
    if (player) {
      player.load(packed);
      if (afresh) player.fit();
      if (afresh && builder.active()) { const {view} = player; view.zoom(ROOM, view.width / 2, view.height / 2); player.redraw(); }
    }
    if (!player) {
      player = createPlayer(stage, packed, {clock, text: t, picked, sides: () => diagrams.active() ? SIDES : 0, tools: () => [...handles.bar(), measure.button, builder.button],
        drawn: () => { if (player) { handles.draw(); measure.draw(); builder.draw(); diagrams.draw(); } }, held: () => handles.held() || builder.active()});
      player.stage.append(handles.layer, builder.layer);
      measure.attach(player);
      player.highlight(store.state.lit);
    }
    measure.load(scene.scene);
    if (compared) player.compare(compared);
  }
  function remark(scene) {
    const reasons = reasonsOf(store.state), still = Boolean(scene?.scene && reasons.length), missing = still || scene && !scene.scene;
    const words = !scene ? [t("drawing …"), ...(late ? [t(FIRST)] : [])] : missing ? reasons : [];
    const head = missing ? [element("b", {}, t("There is no motion to show"))] : [];
    const back = missing && store.state.design?.undo ? [button(t("Undo"), () => store.state.design.undo && say({what: "undo"}), {testid: "note-undo"})] : [];
    stage.hidden = !player;
    stage.classList.toggle("is-old", Boolean(player) && !scene?.scene);
    stage.classList.toggle("is-still", still);
    note.hidden = Boolean(scene?.scene) && (!still || builder.active());  // whoever builds reads it beside the tools
    note.classList.toggle("is-beside", still);
    note.replaceChildren(...head, ...words.map(text => element("p", {}, refusedText(text, t))), ...back);
  }
  function update({scene}) {
    if (scene?.scene && scene !== shown) load(scene);
    if (!scene && !timer) timer = setTimeout(() => { late = true; remark(store.state.scene); }, LATE);
    if (scene) { clearTimeout(timer); timer = 0; late = false; }
    remark(scene);
  }
  function reference({reference}) {
    const next = reference?.scene || null;
    if (next === compared) return;
    compared = next;
    player?.compare(next);
  }
  const stops = [store.on(["scene"], update), store.on(["refused"], () => remark(store.state.scene)), store.on(["reference"], reference), store.on(["lit"], ({lit}) => player?.highlight(lit))];
  return {
    open() {}, close() {},
    reword() { if (player) { measure.reword(); load(shown); } remark(store.state.scene); },
    destroy() { clearTimeout(timer); stops.forEach(stop => stop()); for (const one of [handles, measure, builder, diagrams]) one.destroy(); player?.destroy(); },
  };
}

// ---------------------------------------------------------------------------------------------------------------- the centre

const PANES = {motion: createMotion, programme: createMotionForm, solid: createSolids, figures: createFigures, study: createStudies};

/** The centre inside `host`: tabs, and what each shows; `createPlayer` of report/player.js, `clock` shared with the plots. */
export function createViews(host, tools) {
  const {store, t} = tools, names = Object.keys(PANES), tabs = {}, places = {}, views = {};
  const row = element("div", {class: "vw-tabs", role: "tablist"}), frame = element("div", {class: "vw-frame"});

  function add(name) {
    tabs[name] = pressable({role: "tab", id: `view-tab-${name}`, "data-testid": `view-${name}`}, () => store.set({view: name}));
    places[name] = element("div", {class: `vw-pane vw-${name}`, role: "tabpanel", "aria-labelledby": `view-tab-${name}`, hidden: ""});
  }
  function keys(event) {
    const step = {ArrowRight: 1, ArrowLeft: -1}[event.key], offered = names.filter(name => !tabs[name].hidden);
    if (!step) return;
    const next = offered[(offered.indexOf(store.state.view) + step + offered.length) % offered.length];
    event.preventDefault();
    store.set({view: next});
    tabs[next].focus();
  }
  /** All words in the language of the page: a view that cannot change its words is made anew. */
  function reword() {
    const words = {motion: t("Motion"), programme: t("Programme"), solid: t("Solid"), figures: t("Figures"), study: t("Study")};
    row.setAttribute("aria-label", t("Views"));
    for (const name of names) {
      tabs[name].textContent = words[name];
      if (views[name]?.reword) { views[name].reword(); continue; }
      views[name]?.destroy();
      places[name].replaceChildren();
      views[name] = PANES[name](places[name], tools);
    }
    show(store.state);
  }
  /** A kind of drive that states no motion by segments has no programme to edit. */
  function offer({design, kinds, view}) {
    if (!design) return;
    tabs.programme.hidden = !kinds.find(({kind}) => kind === design.kind)?.programme;
    if (tabs.programme.hidden && view === "programme") store.set({view: "motion"});
  }
  function show({view}) {
    for (const name of names) {
      const on = name === view;
      places[name].hidden = !on;
      putAttribute(tabs[name], "aria-selected", on); tabs[name].tabIndex = on ? 0 : -1;
      if (on) views[name].open(); else views[name].close();
    }
  }
  names.forEach(add);
  row.append(...Object.values(tabs));
  frame.append(...Object.values(places));
  row.addEventListener("keydown", keys);
  host.classList.add("vw");
  host.replaceChildren(row, frame);
  const stops = [store.on(["lang"], reword), store.on(["view"], show), store.on(["design", "kinds"], offer)];
  return {destroy() { stops.forEach(stop => stop()); for (const view of Object.values(views)) view.destroy(); host.replaceChildren(); }};
}
