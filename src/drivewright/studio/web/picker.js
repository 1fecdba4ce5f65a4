// The choice of plots: all of the result by title, with a search, each panel of its own.

import { button, createPopovers, pressable, put } from "./parts.js";
import { icon } from "./icons.js";
import { element } from "./player.js";

/** Ids of what a plot has to show. */
const idsOf = ({name, panels, picture}) => picture ? [name] : panels.map(({id}) => id);

/** A button with the list below it; `choice` has chosen(), choose(ids, or null for the usual ones) and plots(). */
export function createPicker({t}, choice) {
  const popovers = createPopovers(), count = element("span", {class: "st-word"});
  const open = pressable({class: "st-button", "data-testid": "plot-picker", "aria-haspopup": "dialog", "aria-expanded": "false"},
    made => { fit(); popovers.toggle(made, "dialog", t("Choose plots"), list); }, icon("search"), count);
  const node = element("div", {class: "st-hold bt-hold"}, open);

  /** The list has the room above the pane, however tall that is. */
  const fit = () => node.style.setProperty("--bt-room", `${Math.max(180, Math.round(open.getBoundingClientRect().top) - 16)}px`);
  function box(ids, text, look, testid, refresh) {
    const input = element("input", {type: "checkbox", "data-testid": testid});
    input.addEventListener("change", () => {
      const others = choice.chosen().filter(id => !ids.includes(id));
      choice.choose(input.checked ? [...others, ...ids] : others);
      refresh();
    });
    const made = element("label", {class: look}, input, element("span", {}, text));
    return {made, show() {
      const chosen = choice.chosen(), on = ids.filter(id => chosen.includes(id)).length;
      input.checked = on === ids.length;
      input.indeterminate = on > 0 && on < ids.length;
    }};
  }
  function list() {
    const search = element("input", {class: "st-search", type: "search", placeholder: t("Search plots"), "aria-label": t("Search plots"), "data-testid": "plot-search"});
    const boxes = [], refresh = () => boxes.forEach(one => one.show()), none = element("p", {class: "st-item-hint", hidden: ""}, t("nothing found"));
    const groups = choice.plots().map(plot => {
      const title = t(plot.title), add = (...about) => { const one = box(...about, refresh); boxes.push(one); return one.made; };
      const own = plot.panels.length > 1 ? plot.panels.map(panel => add([panel.id], panel.series.map(one => t(one.label)).join(", "), "bt-pick bt-part", `pick-${panel.id}`)) : [];
      const whole = add(idsOf(plot), plot.picture ? `${title} (${t("picture")})` : title, "bt-pick", `pick-${plot.name}`);
      return {text: [title, plot.title, ...plot.panels.flatMap(panel => panel.series.map(one => t(one.label)))].join(" ").toLowerCase(), node: element("div", {}, whole, ...own)};
    });
    search.addEventListener("input", () => {
      const wanted = search.value.trim().toLowerCase();
      groups.forEach(group => { group.node.hidden = !group.text.includes(wanted); });
      none.hidden = groups.some(group => !group.node.hidden);
    });
    const usual = button(t("Usual choice"), () => { choice.choose(null); refresh(); }, {testid: "plot-usual", look: "quiet"});
    const clear = button(t("None"), () => { choice.choose([]); refresh(); }, {testid: "plot-none", look: "quiet"});
    refresh();
    return [element("div", {class: "bt-search"}, search, usual, clear), element("div", {class: "bt-list"}, ...groups.map(group => group.node), none)];
  }
  return {node, destroy: popovers.destroy, show() {
    const every = choice.plots().flatMap(idsOf), shown = choice.chosen().filter(id => every.includes(id)).length;
    put(count, t("* of * shown", shown, every.length));
    open.title = t("Choose plots"); open.setAttribute("aria-label", `${t("Choose plots")}: ${count.textContent}`);
  }};
}
