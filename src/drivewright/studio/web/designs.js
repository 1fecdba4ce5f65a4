// What a new design can start from: presets and worked examples as cards with pictures; and the drawings of what the keys measure.

import { pressable } from "./parts.js";
import { element } from "./player.js";

/** Kind or preset as words. */
export const spoken = name => name.replace(/[-_]/g, " ");

/**
 * The cards of all kinds; `fresh(kind, preset)` and `example(name)` begin another design, `close()` puts the menu away.
 * A picture moves while the pointer is on its card, unless the reader wants no motion.
 */
export function createDesigns({store, t}, {fresh, example, close}) {
  const calm = matchMedia("(prefers-reduced-motion: reduce)");

  function picture(still, moving) {
    const made = element("img", {class: "st-thumb", src: `/web/${still}`, alt: "", loading: "lazy", width: 160, height: 100});
    const show = on => () => { if (moving && !(on && calm.matches)) made.src = `/web/${on ? moving : still}`; };
    return {made, start: show(true), stop: show(false)};
  }
  function card(text, hint, name, shown, act) {
    const made = pressable({class: "st-item st-card", role: "menuitem", "data-testid": name}, () => { close(); act(); });
    if (shown) {
      made.append(shown.made);
      for (const event of ["pointerenter", "focus"]) made.addEventListener(event, shown.start);
      for (const event of ["pointerleave", "blur"]) made.addEventListener(event, shown.stop);
    }
    made.append(element("span", {}, text), element("small", {}, hint));
    return made;
  }
  const preset = ({kind, pictures = [], films = [], titles = {}, start}) => name => card(t(titles[name] || spoken(name)), name === start ? t("Build the mechanism by clicking") : `${t("preset")} · ${t(spoken(name))}`,
    `preset-${kind}-${name}`, pictures.includes(name) && picture(`preset.${kind}.${name}.webp`, films.includes(name) && `preset.${kind}.${name}.moving.webp`),
    () => fresh(kind, name));
  const worked = ({name, title, moving}) => card(t(title), t("worked example"), `example-${name}`,
    picture(`example.${name}.webp`, moving && `example.${name}.moving.webp`), () => example(name));

  const group = ({kind, summary, presets, examples = [], ...more}) =>
    element("div", {class: "st-kind", role: "group", "aria-label": t(spoken(kind))},
      element("div", {class: "st-item-head"}, t(spoken(kind))), element("div", {class: "st-item-hint"}, t(summary || "")),
      element("div", {class: "st-cards"}, ...presets.map(preset({kind, ...more})), ...examples.map(worked)));
  /** A box that leaves only the cards whose words hold all that is typed; a kind without any goes too. */
  function finder(groups) {
    const box = element("input", {class: "st-find-design", type: "search", placeholder: t("Find a design"), "aria-label": t("Find a design"),
      spellcheck: "false", autocomplete: "off", "data-testid": "find-design"});
    const none = element("p", {class: "st-item-hint", role: "status", hidden: ""}, t("none"));
    const cards = groups.map(made => [made, [...made.querySelectorAll(".st-card")].map(card => [card, `${made.firstChild.textContent} ${card.textContent}`.toLowerCase()])]);
    box.addEventListener("input", () => {
      const words = box.value.toLowerCase().split(/\s+/).filter(Boolean);
      for (const [made, own] of cards) {
        for (const [card, text] of own) card.hidden = !words.every(word => text.includes(word));
        made.hidden = own.every(([card]) => card.hidden);
      }
      none.hidden = cards.some(([made]) => !made.hidden);
    });
    return [element("div", {class: "st-find-row"}, box), none];
  }
  return () => { const groups = (store.state.kinds || []).map(group); return [...finder(groups), ...groups]; };
}

/** Title of a preset of the design's kind, in English. */
export const presetTitle = ({state: {kinds = [], design}}, name) => kinds.find(({kind}) => kind === design?.kind)?.titles?.[name] || spoken(name);

/** The drawings that show the variant of the design: [{name, title}], [] where its kind has none. */
export const drawingsOf = ({state: {kinds = [], design}}) =>
  (kinds.find(({kind}) => kind === design?.kind)?.drawings || []).filter(({name}) => design.drawings?.includes(name) ?? true);

/** The address of a drawing, with its words in the language of the page. */
export const drawingAddress = ({state: {lang}}, name) => `/web/drawing.${name}${lang === "zh" ? ".zh" : ""}.svg`;

/** What the menu of drawings holds; `t` translates a title. */
export const drawings = (store, t) => drawingsOf(store).map(({name, title}) =>
  element("figure", {class: "st-drawing"}, element("img", {src: drawingAddress(store, name), alt: t(title), loading: "lazy"})));
