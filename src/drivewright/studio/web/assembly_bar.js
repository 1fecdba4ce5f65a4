// The controls of an assembly: play and scrub its motion, pull it apart, cut it.

import { icon } from "./controls.js";
import { pressable } from "./parts.js";
import { element } from "./player.js";

const labelled = (text, ...inside) => element("label", {class: "so-control"}, text, ...inside);

/** A slider 0 ... 1 that shows how far it stands. */
function slider(testid, label, moved, value = 0) {
  const made = element("input", {type: "range", class: "st-range", min: 0, max: 1, step: 0.001, value, "data-testid": testid, "aria-label": label});
  const paint = () => made.style.setProperty("--part", made.value);
  made.addEventListener("input", () => { paint(); moved(Number(made.value)); });
  paint();
  return {made, show(part) { made.value = part; paint(); }};
}

/** {node, show(moving), destroy()}: the bar of a viewer; `clock` is that of the page, so that the drawing and the solids are at one phase. */
export function createAssemblyBar(getViewer, {t, clock}) {
  const play = pressable({class: "st-tool", "data-testid": "solid-play"}, () => clock.toggle());
  const scrub = slider("solid-scrub", t("Position in the cycle"), part => { clock.pause(); clock.set(part); });
  const apart = slider("solid-explode", t("Exploded view"), part => getViewer()?.explode(part));
  const depth = slider("solid-cut-depth", t("Place of the section"), cut, 0.5);
  const section = element("select", {class: "pn-select", "data-testid": "solid-cut", "aria-label": t("Section")},
    ...[["", t("none")], ["0", "x"], ["1", "y"], ["2", "z"]].map(([value, text]) => element("option", {value}, text)));
  const motion = element("div", {class: "so-control so-motion"}, play, scrub.made);
  const node = element("div", {class: "so-bar"}, motion, labelled(t("Exploded view"), apart.made), labelled(t("Section"), section, depth.made));
  let sign = null;

  function cut() {
    depth.made.hidden = section.value === "";
    getViewer()?.cut(section.value === "" ? null : [Number(section.value), Number(depth.made.value)]);
  }
  section.addEventListener("change", cut);
  depth.made.hidden = true;
  const stop = clock.subscribe(({playing, phase}) => {
    if (sign !== playing) {
      sign = playing;
      play.replaceChildren(icon(playing ? "pause" : "play"));
      play.title = t(playing ? "Pause (space)" : "Play (space)");
      play.setAttribute("aria-label", play.title);
    }
    scrub.show(phase);
    getViewer()?.at(phase);
  });
  return {
    node,
    show(moving) { motion.hidden = !moving; getViewer()?.at(clock.phase); cut(); getViewer()?.explode(Number(apart.made.value)); },
    destroy: stop,
  };
}
