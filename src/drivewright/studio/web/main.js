// The page: what comes from the server goes into the store, every part of the page hears what concerns it.

import { createBottom } from "./bottom.js";
import { createForm } from "./form.js";
import { createPace } from "./frames.js";
import { createHead } from "./head.js";
import { createPanes } from "./panes.js";
import { createClock, createPlayer, element, putClass } from "./player.js";
import { createSide } from "./side.js";
import { createStore } from "./store.js";
import { createViews } from "./views.js";
import { createWords } from "./words.js";

const IDLE = {state: "idle", text: "", done: 0, total: 0}, AWAY = "the connection to the server is lost; trying again";
const KEPT = "drivewright-design", TASTE = "drivewright-taste";

const PLACES = [["header", "head", createHead], ["aside", "form", createForm], ["main", "centre", createViews], ["aside", "side", createSide],
  ["section", "plots", createBottom]];

/** Fill `host`; `page` is {say(message), connection()}.  Returns a function that takes everything away again. */
export function start(host, page) {
  const store = createStore({lang: "en", theme: "", kinds: [], words: {}, design: null, refused: {}, scene: null, result: null, reference: null,
    work: {state: "drawing", text: "", done: 0, total: 0}, jobs: {}, lit: [], view: "motion", pane: "mechanism", shared: null, kept: [], focus: null, notice: "", proposals: null, building: false, parts: {}, setup: null, hints: null, ...taste()});
  const t = createWords(store), clock = createClock({duration: 4});
  const parts = [];
  window.drivewright = store;  // for whoever drives the page from outside
  const say = message => ACTS[message.what] ? ACTS[message.what](store, message, page.say) : page.say(message);
  const tools = {store, say, t, clock, createPlayer};

  const places = PLACES.map(([tag, name]) => element(tag, {class: `st-${name}`}));
  const row = element("div", {class: "st-panes"}), frame = element("div", {class: "st"}, ...places, row);
  host.replaceChildren(frame);
  function begin() {
    PLACES.forEach(([, , create], n) => parts.push(create(places[n], tools)));
    parts.push(createPanes(row, tools, frame, Object.fromEntries(PLACES.map(([, name], n) => [name, places[n]]))));
  }
  const socket = joined(page, createEar(store, () => parts.length || begin()), store);

  const root = document.documentElement;
  store.on(["result"], ({result}) => {
    putClass(frame, "st-unsolved", Boolean(result?.unsolved));
    putClass(frame, "st-plotless", !result?.plots);
    putClass(frame, "st-along", Boolean(result?.plots?.diagrams?.length));  // diagrams stand under the drawing
  });
  store.on(["theme"], ({theme}) => theme ? root.setAttribute("data-theme", theme) : root.removeAttribute("data-theme"));
  store.on(["lang"], ({lang}) => root.setAttribute("lang", lang === "zh" ? "zh-CN" : "en"));
  store.on(["lang", "theme"], ({lang, theme}) => remember(localStorage, TASTE, {lang, theme}));
  let kept = {};  // while a hand moves the design its text is not written
  store.on(["design"], ({design}) => {
    if (!design || design.toml === kept.toml && design.files === kept.files) return;
    kept = {toml: design.toml, files: design.files};
    remember(sessionStorage, KEPT, kept);
  });
  let hinted = "";  // kind of drive whose hints are here, or on their way
  store.on(["lang", "design"], ({lang, design}) => {
    if (lang !== "zh" || !design || design.kind === hinted) return;
    hinted = design.kind;
    page.say({what: "hints"});
  });
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) clock.play();
  return () => { socket.leave(); parts.forEach(part => part.destroy()); };
}

// ------------------------------------------------------------------------------------------------------- from the server

/** {what: act(message)}: how each message changes the store; `begin()` is called when the page knows its words. */
function createEar(store, begin) {
  const {state} = store;
  let since = 0;  // generation of the first design of this kind: what is older belongs to another drive
  let impossible = null;  // key of the complaint that the design as it stands has no solution
  const without = keys => Object.fromEntries(Object.entries(state.refused).filter(([key]) => !keys.includes(key) && !keys.includes("*")));
  return {
    start: ({kinds, words}) => {
      if (location.hash.startsWith("#d=")) history.replaceState(null, "", location.pathname + location.search);
      store.set({kinds, words});
      begin();
    },
    design: message => {
      if (message.opened) since = message.gen;
      const afresh = message.opened ? {proposals: null, scene: null, result: null, reference: null, jobs: {}, lit: [], notice: "", ...(state.view === "study" ? {view: "motion"} : {})} : {};
      store.set({design: {toml: state.design?.toml ?? "", ...message, opened: since}, refused: without(message.settled), ...afresh});
    },
    values: ({fields, settled, ...rest}) => {
      const form = {groups: state.design.form.groups.map(group => ({...group, fields: group.fields.map(field => fields[field.key] || field)}))};
      store.set({design: {...state.design, ...rest, form}, ...(settled.length ? {refused: without(settled)} : {})});
    },
    refused: ({key, text, message}) => store.set({refused: {...state.refused, [key]: {text, message}}}),
    scene: createPace(({gen, json}) => gen >= since && store.set({scene: {gen, ...JSON.parse(json)}})),
    possible: () => {
      if (impossible === null) return;
      store.set({refused: without([impossible])});
      impossible = null;
    },
    impossible: ({key, message}) => {
      const before = impossible === null ? state.refused : without([impossible]);
      impossible = key;
      store.set({refused: {...before, [key]: {text: null, message}}, work: IDLE, result: unsolved(state.result)});
    },
    outdated: () => state.result && store.set({result: stale(state.result)}),
    result: ({gen, full, result: told}) => {
      if (gen < since) return;
      const result = {...told, plots: withPanels(told.plots, state.result?.plots)};
      store.set({result: isBare(result) && state.result ? {...unsolved(state.result), gen, verdict: result.verdict, findings: result.findings} : {...result, gen, full}});
    },
    differences: ({differences}) => state.result && store.set({result: {...state.result, differences}}),
    reference: ({title, json, result}) => store.set({reference: {title, ...JSON.parse(json), result}}),
    work: message => store.set({work: message.state === "lost" ? {...IDLE, state: "lost"} : message, ...(message.state === "lost" ? {notice: message.text} : {})}),
    job: ({name, ...news}) => {
      store.set({jobs: {...state.jobs, [name]: {...state.jobs[name], ...news}}});
      if (news.state === "done") news.answer?.files?.forEach(fetched);
      if (name === "save" && news.state === "failed") store.set({notice: news.text});
    },
    proposals: message => store.set({proposals: message}),
    hints: ({words}) => store.set({hints: words}),
    names: ({list, entries}) => store.set({parts: {...store.state.parts, [list]: entries}}),
    shared: ({fragment}) => store.set({shared: {url: `${location.origin}${location.pathname}#${fragment}`}}),
  };
}

/** What was shown last, where the design as it stands has no solution. */
function unsolved(result) {
  return result && {...stale(result), unsolved: true, verdict: {state: "bad", text: "no solution", stale: true}};
}

/** Plots of a result that left out the panels that the page has from the one before. */
function withPanels(plots, before) {
  const known = new Map((before?.plots || []).map(({name, panels}) => [name, panels]));
  return plots && {...plots, plots: plots.plots.map(plot => plot.panels ? plot : {...plot, panels: known.get(plot.name) || []})};
}

/** A run that ended before it had anything to show: what was shown last stays, so that nothing jumps under a hand. */
const isBare = ({plots, checks, values}) => !plots && !checks.length && !values.length;

/** A result that a change has overtaken. */
const stale = result => ({...result, full: false, verdict: {...result.verdict, stale: true}, checks: result.checks.map(check => ({...check, stale: true}))});

function fetched({name, url}) {
  const link = element("a", {href: url, download: name});
  document.body.append(link);
  link.click();
  link.remove();
}

/** The connection: hello until the server answers, "again" when the connection comes back. */
function joined(page, hears, store) {
  let socket = null, left = false, begun = false;
  const hear = text => { const message = JSON.parse(text); begun ||= message.what === "start"; hears[message.what]?.(message); };
  const lost = () => store.set({notice: AWAY});
  const greet = () => {
    if (left) return;
    if (store.state.notice === AWAY) store.set({notice: ""});
    if (begun) { page.say({what: "again"}); return; }
    const kept = recalled(sessionStorage, KEPT), shared = location.hash.startsWith("#d=") ? location.hash.slice(1) : "";
    page.say({what: "hello", saved: kept.toml || "", files: kept.files || "", shared});
    setTimeout(() => begun || greet(), 2000);  // the server hears nothing before the framework's own handshake
  };
  const join = () => {
    if (left) return;
    socket = page.connection();
    if (!socket) { setTimeout(join, 20); return; }
    socket.on("studio", hear);
    socket.on("disconnect", lost);
    socket.on("connect", () => setTimeout(greet, begun ? 300 : 0));
    if (socket.connected) greet();
  };
  join();
  return {leave() { left = true; socket?.off("studio", hear); socket?.off("disconnect", lost); }};
}

// ---------------------------------------------------------------------------------------------------- what the page does itself

const ACTS = {
  compare(store, message, say) {
    const {design, scene, result} = store.state;
    if (message.with === "preset") say({what: "reference", preset: message.name});
    else if (message.with !== "this") { say({what: "pin", gen: null}); store.set({reference: null}); }
    else if (result?.full && scene?.gen === result.gen) {
      say({what: "pin", gen: result.gen});
      store.set({reference: {title: design.title, ...scene, result}});
    }
    else store.set({notice: "the design is still being analysed; pin it in a moment"});
  },
};

function taste() {
  const {lang, theme} = recalled(localStorage, TASTE);
  return {lang: lang === "zh" || (!lang && navigator.language.startsWith("zh")) ? "zh" : "en", theme: ["light", "dark"].includes(theme) ? theme : ""};
}

function recalled(storage, key) {
  try { return JSON.parse(storage.getItem(key)) || {}; } catch { return {}; }
}

function remember(storage, key, value) {
  try { storage.setItem(key, JSON.stringify(value)); } catch { /* a full or forbidden storage: a reload begins afresh */ }
}
