// The dimension drawing of a design beside its form: it stands above the fields while they are typed.

import { drawingAddress, drawingsOf } from "./designs.js";
import { icon } from "./icons.js";
import { pressable, putAttribute, same } from "./parts.js";
import { element } from "./player.js";

/** {button(), node, stop()}: the button for the head of the form, and the place of the drawing, hidden until it is asked for. */
export function createDock({store, t}) {
  const node = element("div", {class: "st-dock", role: "region", hidden: ""});
  let made = null, shown = [], on = false;

  function show() {
    const drawn = drawingsOf(store), names = drawn.map(({name}) => drawingAddress(store, name));
    if (made) {
      made.hidden = !drawn.length;
      putAttribute(made, "aria-pressed", on);
    }
    node.hidden = !on || !drawn.length;
    if (node.hidden || same(names, shown)) return;
    shown = names;
    node.replaceChildren(...drawn.map(({name, title}) => pressable({title: t("Larger or smaller")}, enlarge,
      element("img", {src: drawingAddress(store, name), alt: t(title)}))));
    node.scrollTop = 0;
  }
  /** Large enough to be read, with what was in the middle still there; or all of it. */
  function enlarge() {
    const large = node.classList.toggle("is-large");
    if (large) { node.scrollLeft = (node.scrollWidth - node.clientWidth) / 2; node.scrollTop = 0; }
  }
  /** The button, in the language of the page. */
  function button() {
    const title = t("Drawing of the dimensions beside the form");
    node.setAttribute("aria-label", title);
    made = pressable({class: "st-button st-small", title, "aria-label": title, "data-testid": "dock-drawing"}, () => { on = !on; show(); }, icon("dimension"));
    show();
    return made;
  }
  return {button, node, stop: store.on(["design", "kinds"], show)};
}
