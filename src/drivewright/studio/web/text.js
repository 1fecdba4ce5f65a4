// The Text tab: the design as TOML; what is typed stays until it is applied or thrown away.

import { pressable } from "./parts.js";
import { element } from "./player.js";

/** The text in `body`: `show()` for what the store has, `edited()`, and the `area` itself. */
export function createText(body, {store, say, t}) {
  const area = element("textarea", {class: "st-toml", spellcheck: "false", autocomplete: "off", wrap: "off", "data-testid": "toml",
    "aria-label": t("The design as text")});
  const apply = pressable({class: "st-button st-main", "data-testid": "apply", title: "Ctrl+Enter"}, send, t("Apply"));
  const discard = pressable({class: "st-button", "data-testid": "discard"}, () => { settle(); show(); area.focus(); }, t("Discard"));
  const state = element("span", {class: "st-edited"});
  let drive = null;  // generation of the first design of this drive: a draft of another one is thrown away
  let edited = false, sent = null;  // the text before what was sent, until the answer

  function settle() { edited = false; sent = null; }
  function show() {
    const text = store.state.design?.toml ?? "", refused = store.state.refused?.[""];
    if (store.state.design?.opened && store.state.design.opened !== drive) { drive = store.state.design.opened; settle(); }
    if (sent !== null && !refused && text !== sent) settle();
    if (!edited && area.value !== text) area.value = text;
    apply.disabled = discard.disabled = !edited;
    state.textContent = edited ? t("edited, not applied") : "";
    body.classList.toggle("st-is-edited", edited);
  }
  function send() {
    const before = store.state.design?.toml ?? "";
    if (area.value === before) { edited = false; show(); return; }
    sent = before;
    say({what: "text", toml: area.value});
  }
  function keys(event) {
    if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey)) return;
    event.preventDefault();
    if (edited) send();
  }
  area.addEventListener("input", () => { edited = true; sent = null; show(); });
  area.addEventListener("keydown", keys);
  body.replaceChildren(area, element("div", {class: "st-text-bar"}, state, discard, apply));
  return {show, edited: () => edited, area};
}
