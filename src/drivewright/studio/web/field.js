// One field of the form: its box, slider, choice or flag; what is typed goes to the server, what the server says comes back into it.

import { createCombobox } from "./combobox.js";
import { icon } from "./icons.js";
import { decimals, quantityOf, shortened, unitsRead, unitsTyped, withUnit } from "./numbers.js";
import { tool } from "./parts.js";
import { element } from "./player.js";
import { createGesture, createSlider } from "./slider.js";
import { refusedText } from "./words.js";

const PAUSE = 700;                       // ms after the last key until a text is sent
const PATIENCE = 2500;                   // ms that a sent value stays on screen without an answer
const LONG = 12;                         // letters that do not fit into the usual box
const MANY = 8;                          // choices from which they are searched in a list
const COUNTED = ["quantity", "number", "integer"];

/** Whether a sent text says what the field now holds. */
function agrees(field, text) {
  if (field.text === text) return true;
  const found = quantityOf(text);
  return Boolean(found) && typeof field.value === "number" && (!found[1] || found[1] === field.unit)
    && Math.abs(found[0] - field.value) <= 1e-9 * Math.abs(field.value);
}

// --------------------------------------------------------------------------------------------------------------------- looks

const messageOf = key => element("div", {class: "st-message", role: "alert", "data-testid": `message-${key}`, hidden: ""});
const nameOf = (field, name, t) => element("span", {class: "st-name", title: `${field.key}${field.hint ? `\n${t(field.hint)}` : ""}`}, name);

function tell(message, root, refused, t) {
  root.classList.toggle("st-refused", Boolean(refused));
  message.textContent = refusedText(refused?.message || "", t);
  message.hidden = !refused;
}

/** The button that takes a value back to the usual one is there where that is another. */
function offerReset(reset, {given, default: usual, optional}, t) {
  reset.hidden = !given || usual == null && !optional;
  const name = usual == null ? t("Leave it out") : `${t("Back to the usual value")}: ${usual}`;
  reset.title = `${name} (Alt+R)`;
  reset.setAttribute("aria-label", name);
}

/** What stands for a value: {input, show(field), text(), whole}; one that is not `whole` is typed in letter by letter. */
function createControl(field, name, {t, parts, learn}) {
  const common = {"aria-label": name, class: "st-box"};
  if (field.kind === "choice" && field.choices.length <= MANY) {
    const choice = element("select", {...common, class: "st-select st-box"});
    const none = field.optional && field.default == null ? [element("option", {value: ""}, t("not set"))] : [];
    choice.append(...none, ...field.choices.map(name => element("option", {value: name}, t(String(name)))));
    return {input: choice, show: now => { choice.value = now.value ?? ""; }, text: () => choice.value, whole: true};
  }
  if (field.kind === "flag") {
    const flag = element("input", {...common, type: "checkbox", class: "st-flag"});
    return {input: flag, show: now => { flag.checked = now.value === true; }, text: () => String(flag.checked), whole: true};
  }
  const named = field.key === "title", many = field.kind === "choice" ? field.choices : field.suggestions || [];
  const own = many.map(value => ({value: String(value), text: t(String(value))}));
  const options = () => field.list ? parts(field.list).map(([value, note]) => ({value, text: value, note})) : own;
  const box = element("input", {...common, type: "text", spellcheck: "false", autocomplete: "off", autocapitalize: "off"});
  if (field.optional || field.value === null) box.placeholder = t(String(field.default ?? "not set"));
  const counted = COUNTED.includes(field.kind), told = own.length > 0 || Boolean(field.list);
  const read = text => counted ? shortened(unitsRead(text), LONG) : named || told ? t(text) : text, value = text => options().find(one => one.text === text)?.value ?? text;
  /** The text of the spec: what is shown shorter, or a title in the language of the page, is still what the spec says. */
  const text = () => (counted || named) && box.value === read(spec) ? spec : counted ? unitsTyped(box.value) : value(box.value);
  let spec = "";
  function show(now) {
    spec = now.text ?? "";
    if (box.value !== read(spec)) box.value = read(spec);
    box.title = counted && read(spec) !== unitsRead(spec) ? unitsRead(spec) : "";
  }
  const combo = told && createCombobox(box, options, name, t("none"), () => field.list && learn(field.list));
  return {input: box, show, text, whole: false, searching: () => Boolean(combo && combo.searching()), relist: () => combo && combo.relist()};
}

/** The elements of a row, and how they look when it is locked, refused or given; `back()` takes it to its usual value. */
function createLook(row, context, back) {
  const {say, t} = context, {field} = row, control = createControl(field, row.name, context), {input} = control, message = messageOf(row.key);
  const toggle = () => say({what: "lock", key: row.key, on: !row.locked}), lock = tool("unlock", t("Lock: keep this value"), toggle);
  const reset = tool("reset", "", back);
  reset.classList.add("st-reset");
  for (const made of [lock, reset]) made.tabIndex = -1;  // a field is one stop; its keys do the same
  input.setAttribute("aria-keyshortcuts", "Alt+L Alt+R");
  const root = element("label", {class: `st-field st-is-${field.kind}`, "data-testid": `field-${field.key}`, "data-key": field.key},
    input, nameOf(field, row.name, t), element("span", {class: "st-tools"}, reset, lock), message);
  return {
    root, input, control,
    /** The keys of the two buttons: Alt with L and R.  Whether the event was one of them. */
    shortcut(event) {
      const act = {KeyL: toggle, KeyR: () => reset.hidden || back()}[event.code];
      if (!act || !event.altKey || event.ctrlKey) return false;
      act();
      return true;
    },
    slide(slider) { message.before(slider.root); root.classList.add("st-slid"); },
    refuse(refusal) {
      tell(message, root, refusal, t);
      if (refusal) input.setAttribute("aria-invalid", "true"); else input.removeAttribute("aria-invalid");
    },
    lock(locked) {
      root.classList.toggle("st-locked", locked);
      if (control.whole) input.disabled = locked; else input.readOnly = locked;
      lock.replaceChildren(icon(locked ? "lock" : "unlock"));
      const name = t(locked ? "Locked; click to free it" : "Lock: keep this value");
      lock.title = `${name} (Alt+L)`;
      lock.setAttribute("aria-label", `${name}: ${row.name}`); lock.setAttribute("aria-pressed", String(locked));
    },
    give(field) {
      root.classList.toggle("st-given", field.given);
      if (field.value !== null) root.classList.remove("st-unset");
      offerReset(reset, field, t);
    },
  };
}

// ----------------------------------------------------------------------------------------------------------------------- row

/**
 * One field: `root` to place, `update(field, refusal, locked)` for what the server says, `held()` while the user has it in hand.
 *
 * `sent` is the text that waits for an answer: until then what the server says is older, and is not shown.
 */
export function createRow(field, context) {
  const {send, say, t} = context, counted = COUNTED.includes(field.kind), gesture = createGesture(field.key);
  const row = {key: field.key, field, name: context.chinese() && field.zh || field.label, refusal: null, locked: false, update, held};
  const look = createLook(row, context, () => { settle(); say({what: "unset", key: row.key}); }), {root, input, control} = look;
  let slider = null, typed = false, sent = null, before = "", original = "", waiting = 0, patience = 0, last = null;  // text of this edit that was sent last
  row.root = root;
  row.relist = () => control.relist?.();

  // ---- from the server
  function held() { return typed || Boolean(slider?.dragging); }
  /** What is in the box as the spec has it. */
  const written = () => control.text();
  function answered() {
    if (sent === null) return true;
    return slider?.dragging ? false : agrees(row.field, sent) || (!counted && row.field.text !== before);
  }
  function show() {
    const slides = Boolean(row.field.slider) && typeof row.field.value === "number";
    if (!slider && slides) addSlider();
    if (slider) slider.root.hidden = !slides;
    if (row.refusal?.text != null || !answered()) return;
    sent = null;
    if (slides) slider.show(row.field);
    if (typed) return;
    control.show(row.field);
    original = row.field.text ?? "";
    if (counted) root.classList.toggle("st-long", input.value.length > LONG);
  }
  function addSlider() {
    slider = createSlider(row, {bounds: context.bounds, t, moved, ended});
    slider.range.disabled = row.locked;
    look.slide(slider);
  }
  function update(field, refusal, locked) {
    if (row.field === field && refusal === row.refusal && locked === row.locked && sent === null) return;
    const old = row.field, changed = old.text !== field.text || old.value !== field.value || old.unit !== field.unit;
    const bent = old.slider?.[0] !== field.slider?.[0] || old.slider?.[1] !== field.slider?.[1] || old.step !== field.step;
    const told = refusal?.message !== row.refusal?.message || refusal?.text !== row.refusal?.text;
    row.field = field;
    if (told) refuse(refusal); else row.refusal = refusal;
    if (locked !== row.locked) setLocked(locked);
    if (old.given !== field.given || old.default !== field.default) look.give(field);
    if (changed || bent || told || sent !== null) show();
  }
  function refuse(refusal) {
    const first = refusal && !row.refusal;
    row.refusal = refusal;
    sent = null;
    look.refuse(refusal);
    if (refusal && !held() && !control.whole && refusal.text != null) input.value = refusal.text;
    if (first) context.reveal(row);
  }
  function setLocked(locked) {
    row.locked = locked;
    look.lock(locked);
    if (slider) slider.range.disabled = locked;
  }

  // ---- to the server
  function expect(text) {
    sent = text; before = row.field.text;
    clearTimeout(patience);
    patience = setTimeout(() => { if (!slider?.dragging) { sent = null; show(); } }, PATIENCE);
  }
  function moved(text, id) {
    settle();
    if (written() !== text) input.value = unitsRead(text);
    sent = text;
    send({what: "set", key: row.key, text, gesture: id}, false);
  }
  function ended() {
    context.flush();
    if (sent !== null) expect(sent);
    show();  // the answer may have come already
    context.released();
  }
  function settle() { typed = false; clearTimeout(waiting); delete input.dataset.unsent; }
  function commit() {
    const text = written(), known = sent ?? row.refusal?.text;
    clearTimeout(waiting);
    delete input.dataset.unsent;
    if (known == null ? agrees(row.field, text) : text === known) return;
    if (last === null || !text.startsWith(last) && !last.startsWith(text)) gesture.begin();  // not a number that is typed on
    last = text;
    if (!text.trim() && (row.field.optional || row.field.default != null)) say({what: "unset", key: row.key});
    else if (row.field.list) { context.replaced(row.field); expect(text); say({what: "pick", key: row.key, text}); }
    else { expect(text); send({what: "set", key: row.key, text, gesture: gesture.current()}, true); }
  }
  /** The edit is over: the next one is another step of undo. */
  function finish() { last = null; gesture.end(); }
  function choose() {
    const text = control.text();
    gesture.begin();
    expect(text);
    if (text === "") say({what: "unset", key: row.key}); else send({what: "set", key: row.key, text, gesture: gesture.current()}, true);
  }
  function restore() {
    const back = original;
    settle();
    last = null;
    input.value = counted ? unitsRead(back) : back;
    if (row.refusal || sent !== null || row.field.text !== back) {
      sent = null;
      say({what: "set", key: row.key, text: back, gesture: gesture.current()});
    }
    input.select();
  }
  /** Arrow keys in a box: the number in it, one step on; ten with Shift. */
  function nudge(times) {
    const found = quantityOf(written()), step = row.field.step || 1;
    if (!found) return;
    const text = withUnit(Number((found[0] + step * times).toFixed(decimals(Math.abs(step)))), found[1]);
    input.value = unitsRead(text);
    typed = true;
    last = null;
    expect(text);
    send({what: "set", key: row.key, text, gesture: gesture.next()}, false);
  }

  // ---- from the user
  function keys(event) {
    const undo = (event.ctrlKey || event.metaKey) && "zy".includes(event.key.toLowerCase()), way = {ArrowUp: 1, ArrowDown: -1}[event.key];
    if (undo && input.dataset.unsent === undefined) settle();
    else if (event.key === "Enter") { commit(); finish(); settle(); show(); input.select(); }
    else if (event.key === "Escape") { event.preventDefault(); restore(); }
    else if (look.shortcut(event)) event.preventDefault();
    else if (counted && way && !row.locked) { event.preventDefault(); nudge(way * (event.shiftKey ? 10 : 1)); }
  }
  function type() {
    typed = true;
    input.dataset.unsent = "";
    clearTimeout(waiting);
    waiting = setTimeout(() => control.searching() || commit(), PAUSE);  // what is typed to search a list is no value yet
  }
  function leave() {
    if (context.moving) return;
    if (typed) commit();
    finish(); settle(); show(); context.released();
  }
  function listen() {
    if (control.whole) {
      input.addEventListener("change", choose);
      input.addEventListener("keydown", event => { if (look.shortcut(event)) event.preventDefault(); });
      return;
    }
    input.addEventListener("focus", () => { if (!context.moving) gesture.end(); });
    input.addEventListener("input", type);
    input.addEventListener("blur", leave);
    input.addEventListener("keydown", keys);
  }
  listen(); look.give(field); setLocked(false); show();
  return row;
}

// ---------------------------------------------------------------------------------------------------------------------- pair

/** A point or a pair: its parts side by side, each a field of its own. */
export function createPair(field, context) {
  const {t, say} = context, name = context.chinese() && field.zh || field.label;
  const called = index => t(field.names?.[index] ?? String(index + 1));
  const rows = field.parts.map((part, index) => createRow({...part, zh: null, label: `${name}: ${called(index)}`, hint: field.hint}, context));
  rows.forEach((row, index) => { row.root.querySelector(".st-name").textContent = called(index); });
  const message = messageOf(field.key), reset = tool("reset", t("Back to the usual value"), () => say({what: "unset", key: field.key}));
  reset.tabIndex = -1;
  const root = element("div", {class: "st-pair", role: "group", "aria-label": name, "data-testid": `field-${field.key}`, "data-key": field.key},
    element("div", {class: "st-pair-head"}, nameOf(field, name, t), element("span", {class: "st-tools"}, reset)),
    element("div", {class: "st-pair-parts"}, ...rows.map(row => row.root)), message);
  const pair = {key: field.key, field, name, root, refusal: null, update, held: () => rows.some(row => row.held()), rows};
  function update(now, refusal, locked) {
    const before = pair.field;
    pair.field = now;
    if (now.given !== before.given || now.default !== before.default) offerReset(reset, now, t);
    if (now.value !== null && before.value === null) root.classList.remove("st-unset");
    rows.forEach((row, index) => row.update(now.parts[index], context.refusal(row.key), locked || context.locked(row.key)));
    if (refusal?.message === pair.refusal?.message) return;
    pair.refusal = refusal;
    tell(message, root, refusal, t);
    if (refusal) context.reveal(pair);
  }
  offerReset(reset, field, t);
  return pair;
}
