// The keys of a design that a search or a study may vary: a list with a box to find them and a tick for each; what is ticked opens its boxes.

import { shortened } from "./numbers.js";
import { element } from "./player.js";

const SHOWN = 60;  // keys that are listed at once; a word in the box finds the others
const LONG = 16;  // letters of a value that stand beside its name

/** The value of a key as it stands in the list. */
function textOf({kind, text}, t) {
  return kind === "flag" ? t(text === "true" ? "yes" : "no") : kind === "choice" ? t(text) : shortened(text, LONG);
}

/** A small box for text. */
export function box(value, name, testid, more = {}) {
  const made = element("input", {type: "text", class: "st-box sf-box", "aria-label": name, spellcheck: "false", autocomplete: "off", "data-testid": testid, ...more});
  made.value = value ?? "";
  return made;
}

/** A choice of [value, text] pairs. */
export function choice(options, value, name, testid, act = () => {}) {
  const made = element("select", {class: "pn-select sf-select", "aria-label": name, "data-testid": testid},
    ...options.map(([key, text]) => element("option", {value: key}, text)));
  made.value = value;
  made.addEventListener("change", () => act(made.value));
  return made;
}

/** A tick with its words. */
export function tick(on, words, testid, act, more = {}) {
  const made = element("input", {type: "checkbox", class: "sf-tick", "data-testid": testid, ...more});
  made.checked = on;
  made.addEventListener("change", () => act(made.checked));
  return element("label", {class: "sf-line"}, made, ...words);
}

/** A part of a form with its heading. */
export const part = (title, ...inside) => element("section", {class: "sf-part"}, element("h4", {}, title), ...inside);

/**
 * The list.  `editor(key)` gives {node, value()} for a key that is ticked, `changed()` is called when the choice or what is typed differs.
 * Returns {node, load(keys, chosen), chosen() -> [{key, ...value}]}; `name` begins the test ids.
 */
export function createKeyList(name, {t}, editor, changed) {
  const find = element("input", {type: "search", class: "st-search sf-find", placeholder: t("Find a dimension"), "aria-label": t("Find a dimension"),
    spellcheck: "false", autocomplete: "off", "data-testid": `${name}-find`});
  const list = element("div", {class: "sf-keys", role: "group", "aria-label": t("Dimensions that may change")});
  const none = element("p", {class: "pn-about"}), node = element("div", {class: "sf-list"}, find, list, none);
  let keys = [], editors = new Map();

  function set(key, on) {
    if (on) editors.set(key.key, editor(key)); else editors.delete(key.key);
    draw();
    changed();
  }
  function row(key) {
    const words = [element("span", {class: "sf-name", title: key.key}, t(key.label)), element("b", {}, textOf(key, t))];
    const made = element("div", {class: "sf-key"},
      tick(editors.has(key.key), words, `${name}-key-${key.key}`, on => set(key, on), key.locked ? {disabled: "", title: t("Locked; unlock it to let it change")} : {}));
    if (editors.has(key.key)) made.append(editors.get(key.key).node);
    return made;
  }
  function draw() {
    const focused = document.activeElement?.dataset?.testid, words = find.value.toLowerCase().split(/\s+/).filter(Boolean);
    const hit = key => words.every(word => `${key.key} ${key.label} ${t(key.label)}`.toLowerCase().includes(word));
    const ticked = keys.filter(key => editors.has(key.key)), others = keys.filter(key => !editors.has(key.key) && hit(key));
    list.replaceChildren(...[...ticked, ...others.slice(0, SHOWN)].map(row));
    none.textContent = !keys.length ? t("loading …") : others.length > SHOWN ? t("* more; type a word to find one", others.length - SHOWN) : others.length || ticked.length ? "" : t("none");
    none.hidden = !none.textContent;
    if (focused && list.contains(document.activeElement) === false) [...list.querySelectorAll("input")].find(made => made.dataset.testid === focused)?.focus({preventScroll: true});
  }
  find.addEventListener("input", draw);
  node.addEventListener("input", event => { if (event.target !== find) changed(); });
  draw();
  return {
    node,
    /** The keys of a design; `chosen` are those that its table has, {key: entry}. */
    load(found, chosen) {
      keys = found;
      list.scrollTop = 0;
      editors = new Map(found.filter(({key}) => key in chosen).map(key => [key.key, editor({...key, entry: chosen[key.key]})]));
      draw();
    },
    chosen: () => keys.filter(({key, locked}) => editors.has(key) && !locked).map(({key}) => ({key, ...editors.get(key).value()})),
  };
}
