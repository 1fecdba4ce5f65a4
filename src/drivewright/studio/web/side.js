// The right column: design checks, key numbers, findings, the panels of the jobs, and the export row.

import { createChecks } from "./checks.js";
import { createOptimise, createSensitivity, createStudy } from "./jobs.js";
import { intervalHint, withDifference, withInterval } from "./numbers.js";
import { button, put, same } from "./parts.js";
import { element } from "./player.js";
import { createReach } from "./reach.js";
import { reasonsOf, refusedText } from "./words.js";

const EXPORTS = ["dxf", "svg", "csv", "step", "stl", "gcode", "pdf"];
const LATE = 150;  // ms of work that nobody needs to be told of

// ------------------------------------------------------------------------------------------------------------- state of work

/** Verdict pill, what is under way, and the strip of what went wrong beside the design: a process that died, a connection that is lost. */
function createState({store, say, t}) {
  const title = element("h2", {class: "sd-state"}, t("Design checks"));
  const pill = element("span", {class: "sd-pill", "data-testid": "verdict", role: "status"}), before = element("span", {class: "sd-before"});
  const part = element("i", {}), bar = element("div", {class: "sd-work", "data-testid": "progress-look"}, part);
  const cancel = button(t("Cancel"), () => say({what: "cancel", name: "look"}), {testid: "cancel-look", look: "quiet"});
  const wrong = element("span"), close = button(t("Close"), () => store.set({notice: ""}), {look: "quiet"});
  const strip = element("div", {class: "sd-strip", role: "alert", hidden: ""}, wrong, close);
  const again = button(t("Analyse"), () => say({what: "analyse"}), {testid: "analyse", look: "quiet"});
  const longer = button(t("Run it longer"), () => say({what: "analyse", longer: true}), {testid: "analyse-longer", look: "quiet"});
  const words = element("span", {class: "pn-words"}), line = element("div", {class: "sd-line"}, words, cancel, again, longer);
  const node = element("div", {class: "sd-top"}, element("div", {class: "sd-title"}, title, pill, before), line, bar, strip);
  let timer = 0;
  cancel.hidden = again.hidden = longer.hidden = true;
  function working(on) {
    const {work} = store.state;
    node.classList.toggle("is-working", on);
    cancel.hidden = !on;
    put(words, !on ? settled() : work.compiling ? t(work.compiling) : work.total ? t("analysing: * * of *", t(work.text || ""), work.done, work.total) : t("analysing …"));
    part.style.transform = `scaleX(${on && work.total ? work.done / work.total : 0})`;
  }
  /** What stands there while nothing is under way. */
  function settled() {
    const {result, work} = store.state;
    if (work?.state === "over") return t("* took more than * s and was ended", t(work.text || ""), work.seconds);
    if (result?.unsolved) return [t("shown is the last design that had a solution"), ...reasonsOf(store.state).map(text => refusedText(text, t))].join(": ");
    return !result ? "" : !result.full || result.verdict.stale ? t("not all checks are up to date") : t("up to date");
  }
  function work({work}) {
    const on = work?.state === "analysing";
    again.hidden = work?.state !== "stopped";
    longer.hidden = work?.state !== "over";
    if (!on) { clearTimeout(timer); timer = 0; working(false); }
    else if (node.classList.contains("is-working")) working(true);
    else timer ||= setTimeout(() => { timer = 0; if (store.state.work?.state === "analysing") working(true); }, LATE);
  }
  function trouble({work, notice}) {
    const text = notice || (work?.state === "idle" ? work.text : "");
    strip.hidden = !text;
    close.hidden = !notice;
    put(wrong, text && t(text));
  }
  /** Whether the analyses of the newest design are still to come. */
  function computing() {
    const {result, work, refused} = store.state, over = ["stopped", "over", "lost"].includes(work?.state);
    return !over && (result ? !result.unsolved && (!result.full || Boolean(result.verdict.stale)) : !Object.keys(refused || {}).length);
  }
  /** A verdict that a change has overtaken stays beside what is said now, dim. */
  function verdict({result}) {
    const given = result?.verdict, old = given?.stale && !result.unsolved, busy = computing();
    const now = busy ? t("computing …") : old ? t("out of date") : given ? t(given.text) : t("no result yet");
    pill.className = `sd-pill is-${busy || old ? "none" : given?.state || "none"}`;
    pill.dataset.state = busy ? "computing" : old ? "stale" : given?.state || "";
    put(pill, now);
    before.className = `sd-before is-${given?.state || "none"}`;
    put(before, (busy || old) && given ? t(given.text) : "");
    node.classList.toggle("is-unsolved", Boolean(result?.unsolved));
    if (!node.classList.contains("is-working")) put(words, settled());
  }
  return {node, stops: [store.on(["work"], work), store.on(["work", "notice"], trouble), store.on(["result", "work", "refused"], verdict), () => clearTimeout(timer)]};
}

// ---------------------------------------------------------------------------------------------------- key numbers, findings

function createNumbers(host, tools) {
  const {store, t} = tools, reach = createReach(name => rows.get(name)?.node, tools);
  let rows = new Map();
  function arrange(values) {
    rows = new Map(values.map(({name}) => [name, {name: element("span"), other: element("em"), value: element("b")}]));
    for (const [name, row] of rows) row.node = element("div", {class: "sd-number"}, row.name, row.other, row.value, reach.offer(name));
    host.replaceChildren(...[...rows.values()].map(({node}) => node));
    reach.shown();
  }
  function update({result, reference}) {
    const values = result?.headline || [], others = new Map((reference?.result?.headline || []).map(value => [value.name, value]));
    if (!same(values.map(value => value.name), [...rows.keys()])) arrange(values);
    host.classList.toggle("is-stale", Boolean(result && !result.full));
    host.closest(".sd-section").classList.toggle("is-empty", !values.length && !result?.findings?.length);
    for (const value of values) {
      const row = rows.get(value.name), other = others.get(value.name);
      put(row.name, t(value.label)); put(row.value, withInterval(value, t));
      put(row.other, other && other.shown !== value.shown ? withDifference(withInterval(other, t), result.differences?.values[value.name]) : "");
      row.name.title = [t(value.meaning), value.convention && t(value.convention), value.name].filter(Boolean).join("\n"); row.value.title = intervalHint(value, t);
    }
  }
  return [store.on(["result", "reference"], update), ...reach.stops];
}

function createFindings(host, {store, t}) {
  const count = element("span", {class: "sd-count"}), list = element("ul", {});
  const node = element("details", {class: "sd-findings"}, element("summary", {}, t("Findings"), " ", count), list);
  let before = null;
  host.append(node);
  return [store.on(["result"], ({result}) => {
    const findings = result?.findings || [], warnings = result?.warnings || [];
    node.hidden = !findings.length;
    if (same(findings, before)) return;
    before = findings;
    put(count, String(findings.length));
    list.replaceChildren(...findings.map(text => element("li", warnings.includes(text) ? {class: "is-warn"} : {}, t(text))));
    if (warnings.length) node.open = true;
  })];
}

// -------------------------------------------------------------------------------------------------------------------- export

function createExport({store, say, t}) {
  const words = element("span", {class: "sd-export-words", role: "status"}), trouble = element("p", {}), row = element("div", {class: "sd-exports"});
  let wanted = null, before = null;
  const ask = (format, anyway) => { wanted = format; say({what: "export", format, anyway}); };
  const offer = name => ({testid: `export-${name.toLowerCase()}`, title: `${t("Export")} ${name}`});
  const buttons = new Map(EXPORTS.map(format => [format, button(format.toUpperCase(), () => ask(format, false), offer(format.toUpperCase()))]));
  const anyway = button(t("Export anyway"), () => ask(wanted, true), {testid: "export-anyway"});
  const close = button(t("Close"), () => { box.hidden = true; }, {look: "quiet"});
  const box = element("div", {class: "sd-refused", role: "alert", hidden: ""}, trouble, element("div", {class: "pn-row"}, anyway, close));
  const node = element("footer", {class: "sd-export"}, box, element("div", {class: "sd-export-head"}, element("h3", {}, t("Export")), words), row);
  row.append(...buttons.values());
  function update({jobs}) {
    const job = jobs?.export || {state: "idle", text: ""}, busy = job.state === "running", failed = job.state === "failed";
    if (job === before) return;
    before = job;
    box.dataset.gen = job.gen;
    for (const [format, made] of buttons) { made.disabled = busy; made.classList.toggle("is-busy", busy && format === wanted); }
    put(words, busy ? job.text ? t(job.text) : t("writing …") : job.state === "done" ? t("saved") : "");
    box.hidden = !failed;
    anyway.hidden = !job.overridable;
    put(trouble, failed ? job.text : "");
  }
  const outdated = ({design}) => { if (String(design?.gen) !== box.dataset.gen) box.hidden = true; };
  return {node, stops: [store.on(["jobs"], update), store.on(["design"], outdated)]};
}

// ---------------------------------------------------------------------------------------------------------------- the column

/** A section of the column, with a title that a row of jumps leads to. */
function section(name, title) {
  const body = element("div", {class: "sd-body"}), head = element("header", {class: "sd-head"}, element("h3", {}, title));
  return {name, body, node: element("section", {class: "sd-section", "data-name": name}, head, body)};
}

/** A row of words that lead to the sections; the one in view is marked. */
function createJumps(scroll, sections, t) {
  const words = {checks: t("Checks"), numbers: t("Numbers"), sensitivity: t("Sensitivity"), optimise: t("Optimise"), study: t("Study")};
  const placeOf = part => part.node.offsetTop - scroll.offsetTop, there = part => !part.node.classList.contains("is-empty");
  const most = () => scroll.scrollHeight - scroll.clientHeight;
  let chosen = -1, stand = 0;  // the section that was asked for, and where that put the column
  const links = sections.map((part, n) => button(words[part.name], () => {
    scroll.scrollTop = placeOf(part);
    chosen = n; stand = scroll.scrollTop;
    observe();
  }, {look: "jump"}));
  /** The section that is read: the line that counts goes from the top of the column to its end as one scrolls. */
  function current() {
    if (chosen >= 0 && Math.abs(scroll.scrollTop - stand) < 2) return chosen;
    chosen = -1;
    const line = scroll.scrollTop + 8 + (most() > 0 ? scroll.scrollTop / most() : 0) * (scroll.clientHeight - 16);
    return sections.findLastIndex(part => there(part) && placeOf(part) <= line);
  }
  function observe() {
    const at = Math.max(current(), 0);
    links.forEach((link, n) => { link.setAttribute("aria-current", String(n === at)); link.hidden = !there(sections[n]); });
  }
  const sized = new ResizeObserver(observe);
  scroll.addEventListener("scroll", observe, {passive: true});
  for (const node of [scroll, ...sections.map(part => part.node)]) sized.observe(node);
  return {node: element("nav", {class: "sd-jumps", "aria-label": t("Sections")}, ...links), stops: [() => sized.disconnect()]};
}

/** The right column inside `host`; `say(message)` to the server, `t(text)` into the store's language. */
export function createSide(host, tools) {
  const {store, t} = tools;
  let stops = [], lang = null;

  function build() {
    stops.forEach(stop => stop());
    const checks = section("checks", t("Design checks")), numbers = section("numbers", t("Key numbers"));
    const sensitivity = section("sensitivity", t("Sensitivity")), optimise = section("optimise", t("Optimise")), study = section("study", t("Study"));
    const sections = [checks, numbers, sensitivity, optimise, study], values = element("div", {class: "sd-numbers"});
    const scroll = element("div", {class: "sd-scroll", tabindex: -1}, ...sections.map(part => part.node));
    const state = createState(tools), jumps = createJumps(scroll, sections, t), exports = createExport(tools);
    checks.node.firstChild.remove();  // its title stands above, beside the verdict
    checks.body.classList.add("sd-cards");
    numbers.body.append(values);
    host.classList.add("sd");
    host.replaceChildren(state.node, jumps.node, scroll, exports.node);
    stops = [...state.stops, ...jumps.stops, ...exports.stops, ...createChecks(checks.body, tools), ...createNumbers(values, tools),
      ...createFindings(numbers.body, tools), ...createSensitivity(sensitivity.body, tools), ...createOptimise(optimise.body, tools),
      ...createStudy(study.body, tools)];
  }
  const unlang = store.on(["lang"], state => { if (state.lang !== lang) { lang = state.lang; build(); } });
  return {destroy() { unlang(); stops.forEach(stop => stop()); host.replaceChildren(); }};
}
