// The upper edge of the plots pane: dragged, or moved by arrow keys; a double click gives the height back to what is in it.

import { element } from "./player.js";

const LEAST = 36, STEP = 24, BIG = 96, ABOVE = 220;  // px; ABOVE: what stays for the drawing

/** The separator for `host`; `memory.height` is its height in px, 0 for that of its content; `keep()` remembers it. */
export function createSplitter(host, memory, keep, t) {
  const node = element("div", {class: "bt-edge", role: "separator", tabindex: 0, "aria-orientation": "horizontal", "data-testid": "plots-edge"});
  let from = null;  // [y of the pointer, height] where a drag began

  const most = () => Math.max(LEAST, innerHeight - ABOVE);
  const height = () => Math.round(host.getBoundingClientRect().height);
  function apply() {
    const root = host.parentElement;
    if (memory.height) root?.style.setProperty("--st-plots", `${Math.min(memory.height, most())}px`); else root?.style.removeProperty("--st-plots");
    node.setAttribute("aria-valuemin", LEAST);
    node.setAttribute("aria-valuemax", most());
    requestAnimationFrame(() => node.setAttribute("aria-valuenow", height()));
  }
  function set(px) { memory.height = px && Math.round(Math.min(Math.max(px, LEAST), most())); apply(); }

  node.addEventListener("pointerdown", event => {
    node.setPointerCapture(event.pointerId);
    from = [event.clientY, height()];
    event.preventDefault();
    node.focus();
  });
  node.addEventListener("pointermove", event => { if (from) set(from[1] + from[0] - event.clientY); });
  node.addEventListener("pointerup", () => { if (from) keep(); from = null; });
  node.addEventListener("pointercancel", () => { from = null; });
  node.addEventListener("dblclick", () => { set(0); keep(); });
  node.addEventListener("keydown", event => {
    const step = event.shiftKey ? BIG : STEP, to = {ArrowUp: height() + step, ArrowDown: height() - step, Home: most(), End: LEAST, Enter: 0}[event.key];
    if (to === undefined) return;
    event.preventDefault();
    set(to);
    keep();
  });
  addEventListener("resize", apply);
  apply();
  return {node, reword() { node.setAttribute("aria-label", t("Height of the plots")); node.title = t("Drag, or use the arrow keys; a double click fits the content"); },
    destroy() { removeEventListener("resize", apply); }};
}
