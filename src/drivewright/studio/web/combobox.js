// A text box with a list of what may stand in it: typing searches the list, arrow keys walk through it, Enter takes one.

import { element } from "./player.js";

const HIGH = 260;  // px that the list takes at most
const MOST = 500;  // options that are shown at once

let lists = 0;

/**
 * Makes `input` a combobox over `options()`, [{value, text, note}]; what is picked is typed into it and committed with Enter.  `none` is
 * what the list says where nothing matches, `opened()` is called whenever it opens.  Returns {show again, for other options: relist(),
 * whether a text that is typed is still a search: searching()}.
 */
export function createCombobox(input, options, name, none, opened = () => {}) {
  const id = `st-list-${++lists}`;
  const list = element("ul", {class: "st-list", role: "listbox", id, "aria-label": name});
  let open = false, shown = [], active = -1, asked = "";

  for (const [key, value] of Object.entries({role: "combobox", "aria-autocomplete": "list", "aria-expanded": "false", "aria-controls": id}))
    input.setAttribute(key, value);
  input.classList.add("st-combo");

  // ---- the list
  function place() {
    const box = input.getBoundingClientRect(), below = innerHeight - box.bottom - 8, over = below < 140 && box.top > below;
    const high = Math.min(HIGH, over ? box.top - 8 : below), wide = Math.max(box.width, shown.some(({note}) => note) ? 320 : 170);
    Object.assign(list.style, {left: `${Math.max(4, box.right - wide)}px`, width: `${wide}px`, maxHeight: `${high}px`,
      top: over ? "" : `${box.bottom + 2}px`, bottom: over ? `${innerHeight - box.top + 2}px` : ""});
  }
  function mark(at) {
    active = at;
    [...list.children].forEach((made, n) => made.setAttribute("aria-selected", String(n === at)));
    const made = list.children[at];
    if (made) { input.setAttribute("aria-activedescendant", made.id); made.scrollIntoView({block: "nearest"}); }
    else input.removeAttribute("aria-activedescendant");
  }
  function show(query) {
    if (input.readOnly || input.disabled) return;
    const words = query.toLowerCase().split(/\s+/).filter(Boolean);
    asked = query;
    const hits = options().filter(({value, text, note = ""}) => words.every(word => `${value} ${text} ${note}`.toLowerCase().includes(word)));
    const first = ({text}) => Number(text.toLowerCase().startsWith(words[0] ?? ""));
    shown = hits.sort((a, b) => first(b) - first(a)).slice(0, MOST);
    const blank = shown.length ? [] : [element("li", {class: "st-option is-none", "aria-disabled": "true"}, none)];
    list.replaceChildren(...blank, ...shown.map(({text, note}, n) => {
      const made = element("li", {role: "option", id: `${id}-${n}`, class: "st-option"}, text, ...(note ? [" ", element("small", {}, note)] : []));
      made.addEventListener("pointerdown", event => event.preventDefault());  // the box keeps the focus
      made.addEventListener("click", () => pick(n));
      return made;
    }));
    if (!open) { input.closest(".st").append(list); opened(); }
    open = true;
    input.setAttribute("aria-expanded", "true");
    place();
    list.scrollTop = 0;
    mark(query ? -1 : shown.findIndex(({text, value}) => text === input.value || value === input.value));
    if (!query && active < 0) scrollTo(closest(input.value.trim()));
  }
  /** The option that begins most like a text that is none of them: NU206E of NU206. */
  function closest(text) {
    const alike = other => [...text].findIndex((letter, n) => letter !== other[n]), size = ({value}) => { const n = alike(value); return n < 0 ? text.length : n; };
    return shown.reduce((best, one, n) => size(one) > (best < 0 ? 0 : size(shown[best])) ? n : best, -1);
  }
  function scrollTo(n) { list.children[n]?.scrollIntoView({block: "center"}); }
  function close() {
    if (!open) return;
    open = false;
    list.remove();
    active = -1;
    input.setAttribute("aria-expanded", "false");
    input.removeAttribute("aria-activedescendant");
  }
  function pick(n) {
    input.value = shown[n].text;
    close();
    input.dispatchEvent(new Event("input"));
    close();
    input.dispatchEvent(new KeyboardEvent("keydown", {key: "Enter"}));
  }

  // ---- from the user
  function keys(event) {
    const step = {ArrowDown: 1, ArrowUp: -1}[event.key], taken = () => { event.preventDefault(); event.stopImmediatePropagation(); };
    if (step) {
      taken();
      if (!open) show(""); else if (shown.length) mark((active + step + shown.length) % shown.length);
    } else if (open && event.key === "Enter" && active >= 0) { taken(); pick(active); }
    else if (open && event.key === "Escape") { taken(); close(); }
    else if (event.key === "Enter" || event.key === "Tab") close();
  }
  input.addEventListener("keydown", keys, {capture: true});
  input.addEventListener("input", event => { if (event.isTrusted) show(input.value.trim()); });
  input.addEventListener("click", () => { if (!open) { show(""); input.select(); } });  // what is typed next replaces it
  input.addEventListener("blur", close);
  input.addEventListener("focus", () => addEventListener("scroll", scrolled, {capture: true, passive: true}));
  function scrolled(event) {
    if (document.activeElement !== input) removeEventListener("scroll", scrolled, {capture: true});
    else if (event.target !== list && event.target.contains(input)) close();  // not the text of another box, which moves as it is left
  }
  return {relist() { if (open) show(asked); }, searching: () => open && !options().some(({value, text}) => [value, text].includes(input.value.trim()))};
}
