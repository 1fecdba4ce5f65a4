// "Fix it" on a failed check: asks for the smallest change with which it passes, shows it, and enters it as one step.

import { button, progress, put } from "./parts.js";
import { element } from "./player.js";

const NAME = "fix";  // of the job: one at a time

/** "prime radius 36 mm instead of 24 mm and ..." */
export function sentence({changes, value}, t) {
  const parts = changes.map(({label, given, before}) => t("* * instead of *", t(label), given, before));
  return t("* gives *", parts.join(t(" and ")), value);
}

/**
 * What stands below the cards of checks that fail.  `place(name)` gives the element of a card to put it in, null where it has none.
 * Returns {offer(check) -> the button of a failed check, stops}.
 */
export function createFix(place, {store, say, t}) {
  const bar = progress(NAME, {say, t}), words = element("p", {class: "fx-words", role: "status"}), more = element("p", {class: "pn-note"});
  const apply = button(t("Apply"), () => { say(pick ? {what: "pick", ...pick} : {what: "load", changes: load}); dismiss(); }, {testid: "fix-apply", look: "main"});
  const away = button(t("Dismiss"), dismiss, {testid: "fix-dismiss", look: "quiet"});
  const longer = button(t("Search longer"), () => ask(wanted, true), {testid: "fix-longer", look: "quiet"});
  const row = element("div", {class: "pn-row"}, apply, longer, away);
  const box = element("div", {class: "fx-box", "data-testid": "fix-answer"}, bar.node, words, more, row);
  let wanted = null, load = {}, pick = null, before = null, gen = null;

  function ask(check, patient = false) {
    wanted = check;
    gen = store.state.design?.gen;
    words.hidden = more.hidden = row.hidden = true;  // of the answer before, until the job has begun
    place(check)?.append(box);
    say({what: "job", name: NAME, options: {check, longer: patient}});
  }
  function dismiss() {
    if (store.state.jobs?.[NAME]?.state === "running") say({what: "cancel", name: NAME});
    wanted = null;
    box.remove();
  }
  function told({state, text, answer}) {
    if (state === "failed") return [text || t("failed"), ""];
    if (state === "cancelled") return [t("cancelled"), ""];
    if (state !== "done" || !answer) return ["", ""];
    if (answer.reason) return [t("No change found"), t(answer.reason)];
    const list = names => names.map(name => t(name)).join(", ");
    const also = answer.also_passes.length ? [t("also passes then: *", list(answer.also_passes))] : [];
    const fails = answer.then_fails.length ? [t("fails then: *", list(answer.then_fails))] : [];
    return [sentence(answer, t), [...also, ...fails].join("\n")];
  }
  function update({jobs}) {
    const job = jobs?.[NAME] || {state: "idle"};
    if (job === before || !wanted) return;
    before = job;
    const done = job.state === "done" && job.answer, [main, small] = told(job);
    load = done ? job.answer.load : {}; pick = done && job.answer.pick || null;  // another bought part is chosen, with what it has of its own
    bar.show(job);
    put(words, main); put(more, small);
    words.hidden = !main; more.hidden = !small;
    words.classList.toggle("pn-bad", job.state === "failed");
    apply.hidden = !pick && !Object.keys(load).length;
    longer.hidden = !(done && job.answer.stopped);
    row.hidden = job.state === "running";
  }
  /** What was found belongs to the design that it was asked for. */
  function outdated({design}) { if (wanted && design && design.gen !== gen) dismiss(); }
  return {
    offer: check => button(t("Fix it"), () => ask(check), {testid: `fix-${check}`, look: "fix",
      title: t("Search the smallest change of one or two dimensions with which this check passes")}),
    shown: name => { if (wanted === name && !box.isConnected) place(name)?.append(box); },
    stops: [store.on(["jobs"], update), store.on(["design"], outdated)],
  };
}
