// The figures of a design: thumbnails, one of them large, and longer analyses that are run on request.

import { createAsked, empty } from "./asked.js";
import { button, pressable, themeOf } from "./parts.js";
import { element } from "./player.js";

const picture = svg => `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;

/** Thumbnails of pictures; a click shows one large, arrow keys the next, Escape closes. */
export function gallery(pictures, t) {
  const large = element("img", {alt: ""}), title = element("b"), close = button(t("Close"), () => show(-1), {look: "quiet"});
  const before = button("‹", () => show(at - 1), {look: "quiet", title: t("Previous")});
  const after = button("›", () => show(at + 1), {look: "quiet", title: t("Next")});
  const head = element("header", {class: "pn-row"}, title, before, after, close);
  const box = element("div", {class: "vw-large", role: "dialog", tabindex: -1, hidden: ""}, head, large);
  const tiles = pictures.map((one, n) => pressable({class: "vw-tile", title: one.title}, () => show(n),
    element("img", {src: picture(one.svg), alt: "", loading: "lazy"}), element("span", {}, t(one.title))));
  let at = -1;  // number of the large one
  function show(n) {
    const left = at;
    at = Math.min(n, pictures.length - 1);
    box.hidden = at < 0;
    if (at < 0) { tiles[left]?.focus(); return; }
    large.src = picture(pictures[at].svg); large.alt = pictures[at].title; title.textContent = t(pictures[at].title);
    before.disabled = at === 0; after.disabled = at === pictures.length - 1;
    box.focus();
  }
  box.addEventListener("keydown", event => {
    const acts = {Escape: () => show(-1), ArrowRight: () => show(at + 1), ArrowLeft: () => show(Math.max(at - 1, 0))};
    if (!acts[event.key]) return;
    event.preventDefault(); event.stopPropagation();
    acts[event.key]();
  });
  large.addEventListener("click", () => show(-1));
  return [element("div", {class: "vw-tiles"}, ...tiles), box];
}

/** A request for a longer analysis: what it tells, and a button where nothing is missing for it. */
function requestRow({name, meaning, missing}, t, run) {
  const words = element("span", {}, element("b", {}, t(name)), " ", t(meaning), ...(missing ? [` · ${t(missing)}`] : []));
  return element("div", {class: "vw-request"}, words, ...(missing ? [] : [button(t("Run"), () => run(name))]));
}

/** The pane of the figures in `host`. */
export function createFigures(host, tools) {
  const {store, say, t} = tools, asked = new Set();  // analyses that were run on request
  const options = () => ({theme: themeOf(store.state), analyses: [...asked]});
  let kind = null, theme = themeOf(store.state);
  function run(name) { asked.add(name); say({what: "job", name: "figures", options: options()}); }
  function shown(body, {figures, requests}) {
    const rows = requests.map(request => requestRow(request, t, run));
    const longer = rows.length ? [element("section", {class: "vw-requests"}, element("h3", {}, t("Longer analyses, on request")), ...rows)] : [];
    const none = () => [empty(element("p", {}, t("All figures of this design are on the motion page; there are no others.")))];
    const [tiles, ...box] = figures.length ? gallery(figures, t) : none();
    body.replaceChildren(element("div", {class: "vw-scroll"}, ...longer, tiles), ...box);
  }
  const unkind = store.on(["design"], ({design}) => { if (design?.kind !== kind) { kind = design?.kind; asked.clear(); } });
  const pane = createAsked(host, "figures", tools, {wanted: t("Figures of this design"), options, shown});
  const stop = store.on(["theme"], () => { if (theme !== (theme = themeOf(store.state))) pane.again(); });  // pictures have their colours in them
  return {...pane, destroy() { stop(); unkind(); pane.destroy(); }};
}
