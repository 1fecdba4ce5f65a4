// Small parts that several modules are made of: buttons, lists that hang below a button, progress and outcome of a job.

import { icon } from "./icons.js";
import { element, pressable, put, putAttribute } from "./player.js";

export { pressable, put, putAttribute, putClass, same } from "./player.js";

/** The theme that is seen: the chosen one, else the reader's. */
export const themeOf = ({theme}) => theme || (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");

// ------------------------------------------------------------------------------------------------------------------- buttons

/** A button of words, which looks "plain", "main", "quiet" or "jump". */
export const button = (text, act, {testid, look = "plain", title} = {}) =>
  pressable({class: `pn-button pn-${look}`, "data-testid": testid || false, title: title || false}, act, text);

/** A small sign that does something; its title says what. */
export const tool = (sign, title, act) => pressable({class: "st-tool", title, "aria-label": title}, act, icon(sign));

// ---------------------------------------------------------------------------------------------------------------------- jobs

/** Bar of a job's progress with its words and a cancel button; hidden while the job does not run. */
export function progress(name, {say, t}) {
  const part = element("i", {}), words = element("span", {class: "pn-words"});
  const cancel = button(t("Cancel"), () => say({what: "cancel", name}), {testid: `cancel-${name}`, look: "quiet"});
  const about = {role: "progressbar", "aria-label": t("Progress"), "data-testid": `progress-${name}`};
  const node = element("div", {class: "pn-progress", ...about, hidden: ""},
    element("div", {class: "pn-track"}, part), element("div", {class: "pn-row"}, words, cancel));
  function show(job) {
    const running = job?.state === "running", known = running && job.total > 0;
    node.hidden = !running;
    if (!running) return;
    node.classList.toggle("pn-vague", !known);
    part.style.transform = known ? `scaleX(${Math.min(job.done / job.total, 1)})` : "";
    if (known) { putAttribute(node, "aria-valuemax", job.total); putAttribute(node, "aria-valuenow", job.done); }
    const counted = known && !/\d/.test(job.text) ? t("* of *", job.done, job.total) : "";
    put(words, [job.text ? t(job.text) : "", counted].filter(Boolean).join(" · ") || t("starting"));
  }
  return {node, show};
}

/** What a finished, failed or cancelled job says. */
export function outcome(t) {
  const node = element("p", {class: "pn-note", role: "status", hidden: ""});
  return {node, show(job) {
    const text = job?.state === "failed" ? job.text || t("failed") : job?.state === "cancelled" ? t("cancelled") : "";
    node.hidden = !text;
    node.classList.toggle("pn-bad", job?.state === "failed");
    put(node, text);
  }};
}

// ------------------------------------------------------------------------------------------------------------------ popovers

/** Menus and answers that hang below a button: one open at a time, Escape and a click elsewhere close it, arrow keys walk through it. */
export function createPopovers() {
  let open = null;
  function close(refocus) {
    if (!open) return;
    open.panel.remove();
    open.button.setAttribute("aria-expanded", "false");
    if (refocus) open.button.focus();
    open = null;
  }
  function walk(event) {
    const items = [...open.panel.querySelectorAll("button, input")].filter(item => item.checkVisibility()), at = items.indexOf(document.activeElement);
    const to = {ArrowDown: at + 1, ArrowUp: at < 0 ? -1 : at - 1, Home: 0, End: -1}[event.key];
    if (to === undefined || document.activeElement?.matches("input") && event.key !== "ArrowDown" && event.key !== "ArrowUp") return;
    event.preventDefault();
    items.at(to % items.length)?.focus();
  }
  function keys(event) {
    if (!open) return;
    if (event.key === "Escape") { event.preventDefault(); close(true); } else if (event.key === "Tab") requestAnimationFrame(left); else walk(event);
  }
  function left() { if (open && !open.panel.contains(document.activeElement) && document.activeElement !== open.button) close(false); }
  function outside(event) { if (open && !open.panel.contains(event.target) && !open.button.contains(event.target)) close(false); }

  /** Hangs `content` below `button`; the first thing in it takes the focus. */
  function show(button, role, label, content) {
    close(false);
    const panel = element("div", {class: "st-popover", role, "aria-label": label}, ...content);
    button.parentElement.append(panel);
    button.setAttribute("aria-expanded", "true");
    open = {button, panel};
    panel.style.maxHeight = `${innerHeight - panel.getBoundingClientRect().top - 10}px`;
    const over = panel.getBoundingClientRect().right - innerWidth + 8;
    if (over > 0) panel.style.marginLeft = `${-over}px`;
    panel.querySelector("button, input")?.focus({preventScroll: true});
  }
  document.addEventListener("keydown", keys);
  document.addEventListener("pointerdown", outside);
  return {
    close, show,
    toggle(button, role, label, fill) { if (open?.button === button) close(true); else show(button, role, label, fill()); },
    destroy() { close(false); document.removeEventListener("keydown", keys); document.removeEventListener("pointerdown", outside); },
  };
}
