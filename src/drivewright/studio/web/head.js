// The bar at the top: what is open, new drives and presets, undo, files, sharing, comparing, theme and language.

import { createDesigns, drawings, drawingsOf, presetTitle, spoken } from "./designs.js";
import { acceptFiles } from "./files.js";
import { icon, mark } from "./icons.js";
import { createOverflow } from "./overflow.js";
import { createPopovers, pressable, put, themeOf } from "./parts.js";
import { element } from "./player.js";

const NOTICE = 12000;  // ms that a complaint stays
const LOOPBACK = /^(localhost|127\.\d+\.\d+\.\d+|\[::1\])$/;

const alike = (one, other) => spoken(one).toLowerCase() === spoken(other).toLowerCase();

/** Whether the keys belong to a text box that holds something of its own: its undo is then the browser's. */
function typing(active) {
  if (!active?.matches?.("textarea, input:not([type=range], [type=checkbox], [type=file])")) return false;
  return active.dataset.unsent !== undefined || !active.classList.contains("st-box");
}

/** A button of the bar: a sign, a word, or both; `long` is the word beside a sign where there is room. */
function button({id, sign, title, text, long, look = "", ...more}, act) {
  const word = (name, given) => given ? [element("span", {class: name}, given)] : [];
  const inside = [...(sign ? [icon(sign)] : []), ...word("st-word", text), ...word("st-long-word", long)];
  const named = {class: `st-button${look && ` st-${look}`}`, title, "aria-label": title, "data-testid": id || false};
  return pressable({...named, ...more}, act, ...inside);
}
const hanging = role => ({"aria-haspopup": role, "aria-expanded": "false"});
const rule = () => element("i", {class: "st-rule"});
const held = (...inside) => element("div", {class: "st-hold"}, ...inside);

/** The message that asks for a report, in the language of the page. */
const reportWanted = ({state: {lang}}, options) => ({what: "job", name: "report", options: {language: lang, ...options}});

// --------------------------------------------------------------------------------------------------------------------- menus

/** What the menus of the bar hold. */
function createMenus({store, say, t}, popovers) {
  function item(text, hint, act) {
    const made = pressable({class: "st-item", role: "menuitem"}, () => { popovers.close(true); act(); }, element("span", {}, text));
    if (hint) made.append(element("small", {}, hint));
    return made;
  }
  function comparing() {
    const {reference, design} = store.state, presets = design?.presets || [], compare = message => () => say({what: "compare", ...message});
    const pin = item(t(reference ? "Pin this design instead" : "Pin this design"), t("later changes are seen against it"), compare({with: "this"}));
    const stop = reference ? [item(t("Stop comparing"), reference.title, compare({with: "none"}))] : [];
    const head = presets.length ? [element("div", {class: "st-item-head"}, t("Compare with a preset"))] : [];
    return [pin, ...stop, ...head, ...presets.map(name => item(t(presetTitle(store, name)), t(spoken(name)), compare({with: "preset", name})))];
  }
  /** The address of the design, to be copied. */
  function sharing({url}) {
    const box = element("input", {class: "st-link", type: "text", readonly: "", "aria-label": t("Address of this design"),
      "data-testid": "share-url"});
    box.value = url;
    box.addEventListener("focus", () => box.select());
    const copy = button({look: "main", title: t("Copy the address"), text: t("Copy"), id: "share-copy"}, async made => {
      box.select();
      try { await navigator.clipboard.writeText(url); } catch { document.execCommand("copy"); }
      made.firstChild.textContent = t("Copied");
    });
    const file = button({title: t("Save the design as a file"), sign: "save", text: t("Save as a file"), id: "share-file"}, () => {
      popovers.close(true);
      say({what: "save"});
    });
    const here = LOOPBACK.test(location.hostname), words = here ? t("This address works on this machine only, while the studio runs. To send the design to somebody, send the file.")
      : t("This address holds the whole design. It works where this studio can be reached; the file works everywhere.");
    return [element("p", {class: "st-item-hint", "data-testid": "share-hint"}, words), element("div", {class: "st-share"}, box, copy),
      element("div", {class: "st-share"}, file)];
  }
  /** The report in other forms than a page alone. */
  function reporting() {
    const ask = options => () => say(reportWanted(store, options));
    return [item(t("Report with solids in motion"), t("the parts in three dimensions on the page"), ask({solids: true})),
      item(t("All files of the run"), t("the report, its figures and tables, the result and the spec in one archive"), ask({whole: true}))];
  }
  return {comparing, sharing, reporting};
}

// ----------------------------------------------------------------------------------------------------------------------- bar

/** The bar in `host`. */
export function createHead(host, {store, say, t}) {
  const popovers = createPopovers(), menus = createMenus({store, say, t}, popovers), stops = [];
  const designs = createDesigns({store, t}, {fresh, example, close: () => popovers.close(true)});
  const bar = element("div", {class: "st-bar"}), notice = element("div", {class: "st-notice", role: "alert", hidden: ""});
  const files = acceptFiles({say, t, tell});
  let parts = {}, overflow = null, chosen = "", asked = false, failed = "", hide = 0;

  /** Shows a complaint below the bar for a while. */
  function tell(message) {
    const shut = button({look: "small", sign: "cross", title: t("Close")}, () => { notice.hidden = true; });
    clearTimeout(hide);
    notice.replaceChildren(element("span", {}, message), shut);
    notice.hidden = false;
    hide = setTimeout(() => { notice.hidden = true; }, NOTICE);
  }
  function fresh(kind, preset) {
    chosen = preset || "";
    store.set({building: Boolean(preset) && store.state.kinds.find(each => each.kind === kind)?.start === preset});  // such a design opens ready to be built on
    say({what: "fresh", kind, preset});
  }
  function example(name) { chosen = ""; say({what: "example", name}); }

  // ---- its parts
  function presetChoice() {
    const choice = element("select", {class: "st-select", "data-testid": "preset", title: t("Start from a preset of this drive"),
      "aria-label": t("Preset")});
    choice.addEventListener("change", () => { chosen = choice.value; say({what: "preset", name: choice.value}); });
    return choice;
  }
  function languageButton() {
    const chinese = store.state.lang === "zh", word = (text, on) => element("span", {class: on ? "st-on" : ""}, text);
    const made = button({id: "language", look: "language", title: chinese ? "English" : "中文"}, () => store.set({lang: chinese ? "en" : "zh"}));
    made.append(word("EN", !chinese), "/", word("中文", chinese));
    return made;
  }
  const design = () => ({
    title: element("strong", {class: "st-title"}), kind: element("span", {class: "st-kind-name"}),
    dot: element("span", {class: "st-dot", title: t("not saved yet")}), preset: presetChoice(),
    fresh: button({id: "new", sign: "plus", title: t("New design"), text: t("New"), ...hanging("menu")},
      made => popovers.toggle(made, "menu", t("New design"), designs)),
    keys: button({id: "keys", sign: "dimension", title: t("What the keys measure"), long: t("What the keys measure"), ...hanging("dialog")},
      made => popovers.toggle(made, "dialog", t("What the keys measure"), () => drawings(store, t))),
    undo: button({id: "undo", sign: "undo", title: `${t("Undo")} (Ctrl+Z)`}, () => say({what: "undo"})),
    redo: button({id: "redo", sign: "redo", title: `${t("Redo")} (Ctrl+Y)`}, () => say({what: "redo"})),
  });
  const comparison = () => ({
    compare: button({id: "compare", sign: "compare", title: t("Compare later changes with this design"), text: t("Compare"), "aria-pressed": "false"},
      () => say({what: "compare", with: store.state.reference ? "none" : "this"})),
    more: button({id: "compare-menu", look: "caret", sign: "down", title: t("What to compare with"), ...hanging("menu")},
      made => popovers.toggle(made, "menu", t("Compare"), menus.comparing)),
  });
  const exchange = () => ({
    open: button({id: "open", sign: "open", title: `${t("Open a design and its data files")} (Ctrl+O)`, long: t("Open a file")}, files.pick),
    save: button({id: "save", sign: "save", title: `${t("Save the design as a file")} (Ctrl+S)`}, () => say({what: "save"})),
    share: button({id: "share", sign: "share", title: t("Share as an address"), long: t("Share"), ...hanging("dialog")},
      () => { asked = true; say({what: "share"}); }),
    report: button({id: "report", sign: "report", title: t("Download the report"), text: t("Report")},
      () => say(reportWanted(store))),
    reports: button({id: "report-menu", look: "caret", sign: "down", title: t("Other forms of the report"), ...hanging("menu")},
      made => popovers.toggle(made, "menu", t("Report"), menus.reporting)),
  });
  const taste = () => ({
    theme: button({id: "theme", sign: "moon", title: t("Light or dark"), long: t("Light or dark")},
      () => store.set({theme: themeOf(store.state) === "dark" ? "light" : "dark"})),
    language: languageButton(),
  });

  function build() {
    const p = parts = {...design(), ...comparison(), ...exchange(), ...taste()}, focused = bar.contains(document.activeElement) ? document.activeElement.dataset.testid : "";
    popovers.close(false);
    overflow?.stop();
    overflow = createOverflow(t, [rule(), p.preset, held(p.keys), element("i", {class: "st-space"}),
      held(element("div", {class: "st-split"}, p.compare, p.more)), rule(), p.open, held(p.share), held(element("div", {class: "st-split"}, p.report, p.reports)), rule(), p.theme, p.language]);
    bar.replaceChildren(
      element("div", {class: "st-brand"}, mark(), element("b", {}, "Drivewright")), rule(),
      element("div", {class: "st-name-plate"}, p.title, p.kind, p.dot), held(p.fresh), p.undo, p.redo, p.save, overflow.button, overflow.list);
    files.reword();
    showDesign(); showReference(); showJobs(); showTheme();
    if (focused) bar.querySelector(`[data-testid="${focused}"]`)?.focus();
  }

  // ---- what they show
  function showPresets(design) {
    const names = design.presets || [], key = names.join("\n"), option = name => element("option", {value: name}, t(presetTitle(store, name)));
    if (parts.preset.dataset.names !== key) {
      parts.preset.dataset.names = key;
      parts.preset.replaceChildren(element("option", {value: "", disabled: "", hidden: ""}, t("Preset")), ...names.map(option));
    }
    parts.preset.hidden = !names.length;
    const shown = design.changed || !names.includes(chosen) ? "" : chosen;
    if (parts.preset.value !== shown) parts.preset.value = shown;
  }
  function showDesign() {
    const design = store.state.design;
    parts.undo.disabled = !design?.undo; parts.redo.disabled = !design?.redo; parts.preset.hidden = parts.keys.hidden = !design;
    if (!design) return;
    put(parts.title, t(design.title || spoken(design.kind))); parts.title.title = design.name || "";
    put(parts.kind, alike(design.title || "", design.kind) ? "" : t(spoken(design.kind)));
    parts.dot.classList.toggle("st-shown", Boolean(design.changed));
    parts.keys.hidden = !drawingsOf(store).length;
    showPresets(design);
  }
  function showReference() {
    const reference = store.state.reference, word = parts.compare.querySelector(".st-word");
    parts.compare.setAttribute("aria-pressed", String(Boolean(reference)));
    word.textContent = reference ? `${t("against")} ${reference.title}` : t("Compare");
    parts.compare.title = t(reference ? "Stop comparing" : "Compare later changes with this design");
  }
  function showJobs() {
    const job = store.state.jobs?.report, running = job?.state === "running", text = job?.state === "failed" ? job.text : "";
    parts.report.classList.toggle("st-busy", running); parts.report.disabled = parts.reports.disabled = running;
    parts.report.style.setProperty("--part", running && job.total ? job.done / job.total : 0);
    if (text && text !== failed) tell(text);
    failed = text;
  }
  function showTheme() { parts.theme.firstChild.replaceWith(icon(themeOf(store.state) === "dark" ? "sun" : "moon")); }
  function showShared() {
    if (!asked || !store.state.shared) return;
    asked = false;
    popovers.show(parts.share, "dialog", t("Share"), menus.sharing(store.state.shared));
  }

  // ---- the page's keys
  function keys(event) {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    const key = event.key.toLowerCase(), act = {s: () => say({what: "save"}), o: files.pick, z: undo, y: undo}[key];
    if (!act || act === undo && typing(document.activeElement)) return;
    event.preventDefault();
    act(key === "y" || event.shiftKey);
  }
  function undo(again) { if (again ? store.state.design?.redo : store.state.design?.undo) say({what: again ? "redo" : "undo"}); }

  const scheme = matchMedia("(prefers-color-scheme: dark)");
  const listen = (target, name, fn) => { target.addEventListener(name, fn); stops.push(() => target.removeEventListener(name, fn)); };
  listen(document, "keydown", keys); listen(scheme, "change", showTheme);
  host.append(bar, files.picker, notice, files.drop);
  stops.push(store.on(["lang"], build), store.on(["design"], showDesign), store.on(["reference"], showReference), store.on(["jobs"], showJobs),
    store.on(["theme"], showTheme), store.on(["shared"], showShared));
  return {destroy() { clearTimeout(hide); popovers.destroy(); overflow?.stop(); files.stop(); for (const stop of stops) stop(); host.replaceChildren(); }};
}
