// What the bar has no room for on a small screen: behind one button, as a list.

import { icon } from "./icons.js";
import { pressable } from "./parts.js";
import { element } from "./player.js";

/** {button, list}: `inside` stands in the bar where there is room, else in the list that the button opens. */
export function createOverflow(t, inside) {
  const list = element("div", {class: "st-extra", id: "bar-extra", role: "group", "aria-label": t("More")}, ...inside);
  const button = pressable({class: "st-button st-more-button", title: t("More"), "aria-label": t("More"), "aria-expanded": "false",
    "aria-controls": "bar-extra", "data-testid": "more"}, () => show(!list.classList.contains("st-shown")), icon("more"));

  function show(on) {
    list.classList.toggle("st-shown", on);
    button.setAttribute("aria-expanded", String(on));
    if (on) list.querySelector("select:not([hidden]), button")?.focus({preventScroll: true});
  }
  function keys(event) {
    if (event.key !== "Escape" || event.defaultPrevented || !list.classList.contains("st-shown")) return;
    event.preventDefault();
    show(false);
    button.focus();
  }
  function outside(event) { if (!list.contains(event.target) && !button.contains(event.target)) show(false); }
  /** A button that does its work closes the list; one that opens something hangs that below itself. */
  function acted(event) { if (event.target.closest("button:not([aria-haspopup])") && !event.target.closest(".st-popover")) show(false); }

  list.addEventListener("click", acted);
  list.addEventListener("change", () => show(false));
  document.addEventListener("keydown", keys);
  document.addEventListener("pointerdown", outside);
  return {
    button, list,
    stop() { document.removeEventListener("keydown", keys); document.removeEventListener("pointerdown", outside); },
  };
}
