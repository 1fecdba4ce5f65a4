// Plots that a page does not draw itself: pictures of the figures job, drawn on request.

import { button, outcome, progress, themeOf } from "./parts.js";
import { element } from "./player.js";

const address = svg => `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;

/** Pictures in `host`; `show(plots)` says of which plots. */
export function createPictures(host, tools) {
  const {store, say, t} = tools;
  let plots = [], bar = null, note = null, lang = "";
  function show(wanted = plots) {
    const job = store.state.jobs?.figures, drawn = new Map((job?.answer?.figures || []).map(figure => [figure.name, figure]));
    plots = wanted;
    if (!bar || lang !== store.state.lang) { lang = store.state.lang; bar = progress("figures", tools); note = outcome(t); }
    host.hidden = !plots.length;
    if (!plots.length) { host.replaceChildren(); return; }
    const old = job?.answer && job.gen !== store.state.design?.gen, running = job?.state === "running";
    const frames = plots.map(({name, title}) => {
      const figure = drawn.get(`plot-${name}`), text = t(title);
      return element("figure", {class: `bt-picture${old ? " is-old" : ""}`, "data-testid": `plot-${name}`}, element("figcaption", {}, text),
        ...(figure ? [element("img", {src: address(figure.svg), alt: text})] : [element("p", {}, t("not drawn yet"))]));
    });
    const missing = old || plots.some(({name}) => !drawn.has(`plot-${name}`));
    const draw = missing && !running ? [button(t("Draw the pictures"), () => say({what: "job", name: "figures", options: {theme: themeOf(store.state), analyses: []}}), {testid: "plot-draw"})] : [];
    bar.show(job); note.show(job);
    host.replaceChildren(element("div", {class: "pn-row"}, ...draw, bar.node, note.node), ...frames);
  }
  const stop = store.on(["jobs", "design"], () => plots.length && show());
  return {show, destroy: stop};
}
