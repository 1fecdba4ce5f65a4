// The fields of the form: drawn anew when the design has other groups or fields, else only their values are set.

import { createPair, createRow } from "./field.js";
import { createGroups, sameBoxes, sameShape } from "./groups.js";

const BOXES = "input, select";

/** Messages on their way: at once; what follows within the same frame waits for its end, and a newer value of a key replaces an older one. */
function createQueue(say) {
  const queue = new Map();
  let frame = 0;
  function flush() {
    cancelAnimationFrame(frame);
    const messages = [...queue.values()];
    queue.clear();
    frame = messages.length ? requestAnimationFrame(flush) : 0;
    messages.forEach(say);
  }
  function send(message, now) {
    queue.set(message.key, message);
    if (now || !frame) flush();
  }
  return {send, flush, stop() { cancelAnimationFrame(frame); }};
}

/**
 * The fields in the element `body`; `rebuilt()` is called after they were drawn anew.
 * Returns {show(), restart(), search(words) -> number found, focus(key), known(key), destroy()}.
 */
export function createFields(body, {store, say, t}, rebuilt) {
  const bounds = new Map(), {send, flush, stop} = createQueue(say);
  let rows = new Map(), kept = rows, shape = null, kind = "", drive = null, late = false, locks = new Set();
  const context = {
    say: message => { flush(); say(message); }, send, flush, t, bounds, moving: false, released,
    chinese: () => store.state.lang === "zh", refusal: key => store.state.refused?.[key] || null, locked: key => locks.has(key),
    parts: name => store.state.parts[name] || [], learn(name) { if (!store.state.parts[name]) say({what: "names", list: name}); }, replaced,
    reveal(row) { row.root.classList.remove("st-unset"); groups.reveal(row.root); },
  };
  const groups = createGroups(body, context, rowOf);

  function rowOf(field) {
    const old = kept.get(field.key), fits = old && sameBoxes(old.field, field);
    const row = fits ? old : field.parts?.length ? createPair(field, context) : createRow(field, context);
    rows.set(field.key, row);
    return row;
  }
  /** Tells which values a new part puts out of force: they stood in place of what the one before has of its own. */
  function replaced({key, overrides}) {
    const above = key.slice(0, key.lastIndexOf(".") + 1), out = overrides.map(name => rows.get(above + name)?.field).filter(field => field?.given);
    if (out.length) store.set({notice: t("Left out, because they were of the part before: *", out.map(field => context.chinese() && field.zh || field.label).join(", "))});
  }
  const anyHeld = test => [...rows.values()].some(row => row.held() && test(row));
  function released() { if (late && !anyHeld(() => true)) { late = false; show(); } }

  /** What puts the focus back where it was, or, where an element was renamed, into the field at the same place. */
  function remembered(form) {
    const focused = document.activeElement, old = shape;
    if (!body.contains(focused) || !focused.matches(BOXES)) return () => {};
    const key = focused.closest(".st-field")?.dataset.key, range = focused.type === "text" ? [focused.selectionStart, focused.selectionEnd] : null;
    return () => {
      const there = focused.isConnected ? focused : samePlace(old, form, key);
      there?.focus({preventScroll: true});
      if (there && range && there.type === "text") there.setSelectionRange(...range);
    };
  }
  function samePlace(old, form, key) {
    const at = old?.groups.findIndex(group => group.fields.some(field => field.key === key)) ?? -1;
    if (at < 0 || old.groups.length !== form.groups.length) return null;
    const place = old.groups[at].fields.findIndex(field => field.key === key);
    return rows.get(form.groups[at].fields[place]?.key)?.root.querySelector(BOXES);
  }

  function rebuild(form) {
    const back = remembered(form), top = body.scrollTop;
    kept = rows;
    rows = new Map();
    context.moving = true;  // a box that is moved loses the focus, and gets it back: neither is the user's doing
    groups.draw(form);
    body.scrollTop = top;
    back();
    context.moving = false;
    groups.showNew(form);
  }
  function values(form) {
    for (const group of form.groups) for (const field of group.fields)
      rows.get(field.key)?.update(field, context.refusal(field.key), locks.has(field.key));
  }
  function forget() { rows = new Map(); shape = null; late = false; }
  function show() {
    const design = store.state.design;
    if (!design?.form) return;
    if (design.kind !== kind) { forget(); bounds.clear(); }
    kind = design.kind;
    locks = new Set(design.locks || []);
    groups.name(design.form, kind);
    const same = sameShape(shape, design.form);
    late = !same && anyHeld(row => row.root.querySelector("[type=range]:active"));  // a slider that is dragged stays where it is
    if (!same && !late) rebuild(design.form);
    values(design.form);
    if (late) return;
    shape = design.form;
    groups.retitle();
    if (!same) rebuilt();
    if (design.opened !== drive) { drive = design.opened; body.scrollTop = 0; }
  }

  /** Shows only what matches all the words. */
  function search(query) {
    const words = query.toLowerCase().split(/\s+/).filter(Boolean), hit = text => words.every(word => text.toLowerCase().includes(word));
    const titles = groups.shown(), miss = (root, missed) => { root.classList.toggle("st-miss", missed); return !missed; };
    let found = 0;
    if (words.length) body.scrollTop = 0;
    body.classList.toggle("st-searching", words.length > 0);
    for (const {field, root} of rows.values()) {
      const title = titles.get(root.closest(".st-group")?.dataset.key ?? "") || "";
      found += miss(root, !hit(`${field.key} ${field.label} ${field.zh || ""} ${field.hint || ""} ${t(field.hint || "")} ${title}`));
    }
    const bare = made => words.length > 0 && !made.querySelector(".st-fields > [data-key]:not(.st-miss)");
    for (const made of body.querySelectorAll(".st-group")) miss(made, bare(made));
    for (const chip of body.querySelectorAll(".st-chip")) miss(chip, !hit(`${chip.textContent} ${chip.title}`));
    return found;
  }
  /** Brings a field into view, unfolded and with the focus. */
  function focus(key) {
    const row = rows.get(key) ?? rows.get(key.replace(/\.\d+$/, ""))?.rows?.find(part => part.key === key);
    if (!row) return;
    context.reveal(row);
    row.root.scrollIntoView({block: "center", behavior: "smooth"});
    row.root.querySelector(BOXES)?.focus({preventScroll: true});
  }
  const unlisted = store.on(["parts"], () => rows.forEach(row => row.relist?.()));
  const known = key => rows.has(key) || Boolean(rows.get(key.replace(/\.\d+$/, ""))?.rows);
  return {show, restart() { forget(); show(); }, search, focus, known, destroy() { stop(); unlisted(); }};
}
