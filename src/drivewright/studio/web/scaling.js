// All lengths of a mechanism of points times a factor, so that a measured length becomes a wanted one.

import { FACTORS } from "./handles.js";
import { quantityOf } from "./numbers.js";
import { pressable } from "./parts.js";
import { element } from "./player.js";

const LENGTHS = /^(ground\.points|bodies\.[^.]+\.points)\.[^.]+\.\d+$|^bodies\.[^.]+\.centroid\.\d+$/;
const DIGITS = 8;

const withParts = field => [field, ...(field.parts || []).flatMap(withParts)];

/** {key: text} of every place of a design times a factor; {} for a kind whose spec has no points. */
export function scaledPlaces(design, factor) {
  const fields = (design?.form?.groups || []).flatMap(group => group.fields.flatMap(withParts));
  const places = fields.filter(({key, unit, value}) => LENGTHS.test(key) && typeof value === "number" && value && FACTORS[unit]);
  return Object.fromEntries(places.map(({key, unit, value}) => [key, `${Number((value * factor).toPrecision(DIGITS))} ${unit}`]));
}

/**
 * A button that asks for another length in the place of `shown`, and scales the design; `lengthNow()` is the length [m] as it is.
 * Returns {node, show(on)}.
 */
export function createScaling(shown, {store, say, t}, lengthNow) {
  const node = pressable({class: "bt-export", "data-testid": "measure-scale", "aria-haspopup": "true"}, ask);
  function ask() {
    const box = element("input", {type: "text", class: "ms-box", "data-testid": "measure-wanted", "aria-label": t("Wanted length"), autocomplete: "off"});
    let over = false;
    const end = take => {
      if (over) return;
      over = true;
      const [number, unit] = quantityOf(box.value) || [], wanted = number * FACTORS[unit || "mm"], changes = take && wanted > 0 ? scaledPlaces(store.state.design, wanted / lengthNow()) : {};
      box.replaceWith(shown);
      node.focus({preventScroll: true});
      if (Object.keys(changes).length) say({what: "load", changes});
    };
    box.value = `${Number((lengthNow() * 1e3).toPrecision(6))} mm`;
    box.addEventListener("keydown", event => {
      event.stopPropagation();
      if (event.key !== "Enter" && event.key !== "Escape") return;
      event.preventDefault();  // the button takes the focus, and must not be pressed by the same key
      end(event.key === "Enter");
    });
    box.addEventListener("blur", () => end(false));
    shown.replaceWith(box);
    box.focus(); box.select();
  }
  return {node, show(on) {
    node.hidden = !on || !Object.keys(scaledPlaces(store.state.design, 1)).length;
    node.textContent = t("Scale");
    node.title = t("Scale all lengths of the mechanism so that this one becomes a wanted one; masses stay");
    node.setAttribute("aria-label", node.title);
  }};
}
