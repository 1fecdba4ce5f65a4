// The list of design checks: a card for each, failing ones first; a card lights the parts that it concerns.

import { createFix } from "./fix.js";
import { icon, setIcon } from "./icons.js";
import { withDifference } from "./numbers.js";
import { pressable, put, same } from "./parts.js";
import { element, fixed } from "./player.js";

/** Whether a check can only be met or not: one of a pure number 0 or 1 against 1. */
const isYesNo = check => /^[01]$/.test(check.value) && /^[≥≤]\s*1$/.test(check.limit);

/** The interval of a check's value, "" where it has none. */
const intervalOf = ({low, high}, t) => low ? `${t("* to *", low, high)} · ` : "";

/** [value, line under it] of a check as people read it; `share` is its margin as a part of the limit, null where there is none. */
function told(check, share, t) {
  if (isYesNo(check)) return [check.value === "1" ? t("yes") : t("no"), check.ok ? "" : t("has to be met")];
  const rounding = /^[+−]0(?![.\d])/.test(check.margin) || Math.abs(share ?? 1) < 1e-9;
  const interval = intervalOf(check, t);
  if (!check.margin || rounding) return [check.value, `${interval}${check.limit}`];
  const shown = check.ok && typeof share === "number" && Math.abs(share) < 10;
  const part = shown ? ` (${fixed(100 * share, Math.abs(share) < 0.0995 ? 1 : 0)}\u00a0%)` : "";
  return [check.value, `${interval}${check.limit} · ${t("margin")} ${check.margin}${part}`];
}

/** One card with a button below it while the check fails; `show` writes only what differs. */
function createCard(name, t, clicked, fix) {
  const mark = icon("ok", "sd-sign"), label = element("span", {class: "sd-label"}), value = element("b", {class: "sd-value"});
  const reference = element("span", {class: "sd-reference", title: t("value of the design compared with")});
  const state = element("span", {class: "sd-state"}), line = element("span", {class: "sd-limits"}), message = element("span", {class: "sd-message"});
  const card = pressable({class: "sd-card", "data-testid": `check-${name}`, "aria-pressed": "false"}, () => clicked(name), mark,
    element("span", {class: "sd-first"}, label, reference, value), element("span", {class: "sd-second"}, state, line), message);
  const mend = fix.offer(name), node = element("div", {class: "sd-check"}, card, mend);
  let before = "";
  function look({ok, stale, undecided}) {
    const verdict = !ok ? "bad" : undecided ? "warn" : "ok", seen = stale ? "stale" : verdict, now = `${verdict} ${seen}`;
    if (now === before) return;
    before = now;
    for (const word of ["ok", "bad", "warn", "stale"]) card.classList.toggle(`is-${word}`, word === verdict || word === seen);
    card.dataset.state = seen;
    mend.hidden = ok;
    setIcon(mark, seen);
    put(state, {ok: t("passes"), bad: t("fails"), warn: t("undecided")}[verdict]);
    card.title = stale ? t("not up to date") : "";
  }
  function show(check, share, other, difference) {
    const [number, limits] = told(check, share, t);
    look(check);
    put(label, t(check.label)); put(value, number); put(line, limits); put(message, [check.message, check.undecided].filter(Boolean).map(text => t(text)).join(" · "));
    put(reference, other && other.value !== check.value ? withDifference(told(other, null, t)[0], isYesNo(check) ? "" : difference) : "");
  }
  function press(on, near) {
    card.setAttribute("aria-pressed", String(on));
    card.classList.toggle("is-near", near);
  }
  return {node, show, press};
}

/** The list in `host`, changed in place; what stops it, as a list. */
export function createChecks(host, tools) {
  const {store, t} = tools, fix = createFix(name => cards.get(name)?.node, tools);
  const cards = new Map(), empty = element("p", {class: "pn-note"});
  let active = null, own = null, shown = [];  // name of the card that is pressed, the parts that it has lighted, names in their order

  const concerns = (check, lit) => check.parts.some(part => lit.includes(part));
  function clicked(name) {
    const check = store.state.result.checks.find(check => check.name === name);
    active = active === name ? null : name;
    own = active ? check.parts : [];
    store.set({lit: own});
    if (same(store.state.lit, own)) press();
  }
  function press() {
    const {lit, result} = store.state;
    for (const check of result?.checks || []) cards.get(check.name)?.press(check.name === active, lit.length > 0 && concerns(check, lit));
  }
  function update({result, reference}) {
    const ordered = [...result?.checks || []].sort((a, b) => a.ok - b.ok), names = ordered.map(check => check.name);
    const others = new Map((reference?.result?.checks || []).map(check => [check.name, check]));
    for (const check of ordered) {
      if (!cards.has(check.name)) cards.set(check.name, createCard(check.name, t, clicked, fix));
      cards.get(check.name).show(check, result.fractions?.[check.name], others.get(check.name), result.differences?.checks[check.name]);
    }
    if (!same(names, shown)) arrange(names);
    if (active && !names.includes(active)) active = null;
    const partial = result?.full && (result.verdict.state === "bad" || result.outcome !== "complete");
    put(empty, partial ? t("No check could be computed; the findings say why.") : result ? t("This drive has no design checks.") : t("The checks appear when the design has been analysed."));
    empty.hidden = names.length > 0;
  }
  function arrange(names) {
    for (const name of [...cards.keys()]) if (!names.includes(name)) { cards.get(name).node.remove(); cards.delete(name); }
    names.forEach((name, n) => { const {node} = cards.get(name); if (host.children[n] !== node) host.insertBefore(node, host.children[n] || null); });
    shown = names;
    names.forEach(fix.shown);
    press();
  }
  /** Parts lighted from elsewhere, e.g. the drawing: nothing is pressed, the first check that concerns them comes into view. */
  function lighted({lit, result}) {
    if (lit !== own) {
      active = null; own = null;
      const first = lit.length && shown.find(name => concerns(result.checks.find(check => check.name === name), lit));
      if (first) cards.get(first).node.scrollIntoView({block: "nearest", behavior: "smooth"});
    }
    press();
  }
  host.append(empty);
  return [store.on(["result", "reference"], update), store.on(["lit"], lighted), ...fix.stops];
}
