// The solids of an assembly with their controls: play and scrub the motion, pull the parts away from each other, cut them.

import { element, pressable, watchVisible } from "./clock.js";
import { icon } from "./controls.js";
import { createSolid } from "./solid.js";

const labelled = (text, ...inside) => element("label", {class: "so-control"}, text, ...inside);

/** A slider 0 ... 1 that shows how far it stands. */
function partSlider(testid, label, moved, value = 0) {
  const made = element("input", {type: "range", class: "dw-range", min: 0, max: 1, step: 0.001, value, "data-testid": testid, "aria-label": label});
  const paint = () => made.style.setProperty("--part", made.value);
  made.addEventListener("input", () => { paint(); moved(Number(made.value)); });
  paint();
  return {made, show(part) { made.value = part; paint(); }};
}

/** {node, show(moving), destroy()}: the bar of a viewer; `clock` is that of the page, so that the drawing and the solids are at one phase. */
function createAssemblyBar(getViewer, {t, clock}) {
  const play = pressable({class: "dw-button", "data-testid": "solid-play"}, () => clock.toggle());
  const scrub = partSlider("solid-scrub", t("Position in the cycle"), part => { clock.pause(); clock.set(part); });
  const apart = partSlider("solid-explode", t("Exploded view"), part => getViewer()?.explode(part));
  const depth = partSlider("solid-cut-depth", t("Place of the section"), cut, 0.5);
  const section = element("select", {class: "dw-speed", "data-testid": "solid-cut", "aria-label": t("Section")},
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

/**
 * The assembly inside `host`: {load(answer), highlight(names), viewer, destroy()}, where an answer is that of the job "solid".
 * Options: t (English text -> text shown), clock (of the page).  The clock runs while solids that move are in sight.
 */
export function createAssembly(host, {t, clock}) {
  let viewer = null, visible = false;
  const bar = createAssemblyBar(() => viewer, {t, clock}), stage = element("div", {class: "so-stage"});
  host.classList.add("so-assembly");
  host.replaceChildren(bar.node, stage);
  viewer = createSolid(stage, {t});
  const see = () => clock.see(stage, visible && viewer.moving);
  const unwatch = watchVisible(stage, now => { visible = now; see(); });
  return {
    viewer,
    load(answer) { viewer.load(answer); bar.show(viewer.moving); see(); },
    highlight(names) { viewer.highlight(names); },
    destroy() { unwatch(); bar.destroy(); clock.see(stage, false); viewer.destroy(); },
  };
}
