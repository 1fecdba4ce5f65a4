// The solid parts of a design: asked for when the pane opens, shown by the viewer of solid.js.

import { createAsked } from "./asked.js";
import { createSolid } from "./solid.js";

/** The pane of the solids in `host`. */
export function createSolids(host, tools) {
  const {store, t} = tools;
  let viewer = null;
  function shown(body, answer) {
    body.classList.add("vw-solid");
    viewer ||= createSolid(body, {t});
    viewer.load(answer);
    viewer.highlight(store.state.lit);
  }
  const pane = createAsked(host, "solid", tools, {wanted: t("Solid parts of this design"), shown});
  const stop = store.on(["lit"], ({lit}) => viewer?.highlight(lit));
  return {...pane, destroy() { stop(); pane.destroy(); viewer?.destroy(); }};
}
