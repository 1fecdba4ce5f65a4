// A pane of the centre that shows the answer of a job, and asks for it when it opens.

import { button, outcome, progress } from "./parts.js";
import { element } from "./player.js";

/** Words in the middle of a pane. */
export const empty = (...children) => element("div", {class: "vw-empty"}, ...children);

/**
 * The pane in `host`; `shown(body, answer)` fills it, `wanted` are the words while it waits, `options()` go with the job.
 * An answer for an older design stays, with a bar that offers a new one.
 */
export function createAsked(host, name, {store, say, t}, {wanted, shown, options = () => ({})}) {
  const bar = progress(name, {say, t}), note = outcome(t), body = element("div", {class: "vw-body"});
  const old = element("div", {class: "vw-old", hidden: ""}, t("The design has changed since."), button(t("Show the new one"), ask, {look: "main"}));
  const retry = button(t("Try again"), ask, {testid: `job-${name}`}), wait = empty(element("p", {}, wanted), bar.node, note.node, retry);
  let asked = null, got = null, answer = null, opened = false, before = null, drive = null;
  host.append(body, wait, old);

  const gen = () => store.state.design?.gen;
  function ask() { asked = gen(); say({what: "job", name, options: options()}); }
  function take(job) {
    if (job === before) return;
    before = job;
    bar.show(job); note.show(job);
    if (job.state !== "done" || !job.answer || job.answer === answer) return;
    answer = job.answer;
    got = job.gen;
    shown(body, answer);
  }
  function update({jobs, design}) {
    const job = jobs?.[name] || {state: "idle"}, running = job.state === "running", failed = job.state === "failed";
    if (design && design.opened !== drive) { drive = design.opened; answer = asked = got = null; }  // nothing of another drive stays
    take(job);
    body.hidden = !answer;
    wait.hidden = Boolean(answer) && !running && !failed;
    wait.classList.toggle("is-over", Boolean(answer));
    retry.hidden = running || !failed && job.state !== "cancelled";
    old.hidden = !answer || running || failed || got === gen();
    if (opened && !answer && !running && asked === null && gen() !== undefined) ask();
  }
  function open() {
    opened = true;
    if (gen() !== undefined && asked !== gen() && store.state.jobs?.[name]?.state !== "running") ask();
  }
  const stop = store.on(["jobs", "design"], update);
  return {open, close() { opened = false; }, again() { asked = null; if (opened) open(); }, destroy: stop};
}
