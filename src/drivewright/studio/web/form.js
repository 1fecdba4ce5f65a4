// The left column: the design as a form or as text, a search box, and what was refused without a field.

import { createDock } from "./dock.js";
import { createFields } from "./fields.js";
import { icon } from "./icons.js";
import { button, pressable } from "./parts.js";
import { element } from "./player.js";
import { createText } from "./text.js";
import { refusedText } from "./words.js";

/** The column in `host`. */
export function createForm(host, {store, say, t}) {
  const panes = {
    form: element("div", {class: "st-scroll", role: "tabpanel", "data-testid": "form"}),
    text: element("div", {class: "st-text-pane", role: "tabpanel", hidden: ""}),
  };
  const head = element("div", {class: "st-form-head"});
  const strip = element("div", {class: "st-strip", role: "alert", "data-testid": "message-", hidden: ""});
  const fields = createFields(panes.form, {store, say, t}, () => { if (box?.value) fields.search(box.value); });
  const dock = createDock({store, t});
  let text = null, tab = "form", tabs = {}, box = null, find = () => {}, drive = null;

  // ---- the head
  function choose(name) {
    tab = name;
    for (const [key, made] of Object.entries(tabs)) {
      panes[key].setAttribute("aria-label", made.textContent);
      made.setAttribute("aria-selected", String(key === tab));
      made.tabIndex = key === tab ? 0 : -1;
      panes[key].hidden = key !== tab;
    }
    box.parentElement.hidden = tab !== "form";
    showText();
  }
  function tabButton(name, word) {
    const made = tabs[name] = pressable({role: "tab", class: "st-tab", "data-testid": `tab-${name}`}, () => choose(name), word);
    made.addEventListener("keydown", event => {
      if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
      const other = name === "form" ? "text" : "form";
      choose(other); tabs[other].focus();
    });
    return made;
  }
  function searchBox() {
    const none = element("span", {class: "st-nothing", hidden: ""}, t("none"));
    find = () => { none.hidden = fields.search(box.value) > 0 || !box.value; };
    box = element("input", {type: "search", class: "st-search", placeholder: t("Find a field"), "aria-label": t("Find a field"),
      spellcheck: "false", autocomplete: "off", "data-testid": "search"});
    box.addEventListener("input", find);
    box.addEventListener("keydown", event => {
      if (event.key !== "Escape" || !box.value) return;
      event.preventDefault();
      empty();
    });
    return element("div", {class: "st-search-hold"}, icon("search"), box, none);
  }
  function empty() {
    if (!box?.value) return;
    box.value = "";
    find();
  }
  function buildHead() {
    const row = element("div", {class: "st-tabs", role: "tablist", "aria-label": t("The design as a form or as text")}, tabButton("form", t("Form")), tabButton("text", t("Text")));
    head.replaceChildren(row, searchBox(), dock.button());
  }

  // ---- what stands below it
  function showText() {
    if (!text) return;
    if (tab === "text" || text.edited()) text.show();
    tabs.text.classList.toggle("st-edited-tab", text.edited());
  }
  function showStrip() {
    const lines = Object.entries(store.state.refused || {}).filter(([key]) => !fields.known(key)).map(([, {message}]) => message);
    if (strip.dataset.lines === lines.join("\n")) return;
    strip.dataset.lines = lines.join("\n");
    strip.hidden = !lines.length;
    const stands = Object.values(store.state.refused).some(({text}) => text === null) && store.state.design?.undo;  // the design as it is has no solution
    const back = stands ? [button(t("Undo"), () => say({what: "undo"}), {testid: "strip-undo"})] : [];
    strip.replaceChildren(...lines.map(line => element("p", {}, refusedText(line, t))), ...back);
  }
  /** All words anew; what was typed into the text stays. */
  function restart() {
    const unsaved = text?.edited() ? text.area.value : null;
    buildHead();
    text = createText(panes.text, {store, say, t});
    if (unsaved !== null) { text.area.value = unsaved; text.area.dispatchEvent(new Event("input")); }
    choose(tab);
    fields.restart();
  }
  host.append(element("div", {class: "st-form-pane"}, head, dock.node, strip, panes.form, panes.text));
  const stops = [store.on(["lang"], restart), store.on(["focus"], ({focus}) => { if (focus) { choose("form"); fields.focus(focus); } }),
    store.on(["hints"], fields.restart),
    store.on(["design"], ({design}) => { if (design?.opened !== drive) { drive = design?.opened; empty(); } }),  // what was looked for belongs to another drive
    store.on(["design", "refused"], () => { fields.show(); showStrip(); showText(); })];
  return {destroy() { for (const stop of stops) stop(); fields.destroy(); dock.stop(); host.replaceChildren(); }};
}
