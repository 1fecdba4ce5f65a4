// "Bring to a value" at a key number: asks which change of one dimension gives the number that is wanted, and enters the one that is chosen.

import { sentence } from "./fix.js";
import { box } from "./key_list.js";
import { numberOf, quantityOf, withUnit } from "./numbers.js";
import { button, progress, put, tool } from "./parts.js";
import { element } from "./player.js";

const NAME = "reach";  // of the job: one at a time

/**
 * The form below the row of a key number.  `place(name)` gives the row, null where it is not shown.
 * Returns {offer(name) -> the button of a row, shown(): after the rows were made anew, stops}.
 */
export function createReach(place, {store, say, t}) {
  const bar = progress(NAME, {say, t}), words = element("p", {class: "fx-words", role: "status"}), more = element("p", {class: "pn-note"});
  const target = box("", t("Wanted value"), "reach-target"), ways = element("div", {class: "rc-ways"});
  const find = button(t("Find a change"), () => ask(), {testid: "reach-find", look: "main"}), away = button(t("Close"), close, {testid: "reach-close", look: "quiet"});
  const longer = button(t("Search longer"), () => ask(true), {testid: "reach-longer", look: "quiet"});
  const node = element("div", {class: "fx-box rc-box", role: "group", "aria-label": t("Bring to a value"), "data-testid": "reach"},
    element("p", {class: "pn-about"}, t("Searches for each dimension by itself the size with which this number is as wanted. What is locked stays.")),
    element("label", {class: "sf-pair"}, t("Wanted value"), target), element("div", {class: "pn-row"}, find, longer, away), bar.node, words, ways, more);
  let wanted = null, before = null, gen = null, asked = false;

  const value = () => store.state.result?.values.find(({name}) => name === wanted);
  const unit = () => { const now = value()?.unit || ""; return now === "-" ? "" : now; };
  function open(name) {
    if (wanted === name && node.isConnected) return close();
    stop();
    wanted = name;
    target.value = withUnit(numberOf(value()?.number ?? ""), unit());
    clear();
    place(name)?.append(node);
    target.focus();
    return target.select();
  }
  function clear() {
    asked = false;
    put(words, ""); put(more, "");
    ways.replaceChildren();
    words.hidden = more.hidden = longer.hidden = true;
  }
  function ask(patient = false) {
    const text = target.value.replaceAll("−", "-").trim(), [, given] = quantityOf(text) || [];
    clear();
    asked = true; before = store.state.jobs?.[NAME]; gen = store.state.design?.gen;
    say({what: "job", name: NAME, options: {value: wanted, target: given === "" ? withUnit(text, unit()) : text, longer: patient}});
  }
  function stop() { if (asked && store.state.jobs?.[NAME]?.state === "running") say({what: "cancel", name: NAME}); }
  function close() {
    stop();
    wanted = null; asked = false;
    node.remove();
  }
  /** A way as a sentence with its button. */
  function row(way) {
    const list = names => names.map(name => t(name)).join(", ");
    const also = way.also_passes.length ? [t("also passes then: *", list(way.also_passes))] : [], fails = way.then_fails.length ? [t("fails then: *", list(way.then_fails))] : [];
    const apply = button(t("Apply"), () => { say({what: "load", changes: way.load}); close(); }, {testid: `reach-apply-${way.changes[0].key}`});
    return element("div", {class: `rc-way${fails.length ? " is-bad" : ""}`}, element("p", {}, sentence(way, t)), ...[...also, ...fails].map(text => element("p", {class: "pn-note"}, text)), apply);
  }
  function told({state, text, answer}) {
    if (state === "failed") return [text || t("failed"), ""];
    if (state === "cancelled") return [t("cancelled"), ""];
    if (state !== "done" || !answer || !answer.reason) return ["", ""];
    const {nearest} = answer;
    return [t(answer.reason), nearest ? t("The nearest that was found: *, with * *", nearest.value, t(nearest.label), nearest.at) : ""];
  }
  function update({jobs}) {
    const job = jobs?.[NAME] || {state: "idle"};
    if (job === before || !asked) return;
    before = job;
    const [main, small] = told(job), done = job.state === "done";
    bar.show(job);
    find.disabled = job.state === "running";
    put(words, main); put(more, small);
    words.hidden = !main; more.hidden = !small;
    words.classList.toggle("pn-bad", job.state === "failed");
    longer.hidden = !(done && job.answer?.stopped);
    ways.replaceChildren(...(done ? job.answer.ways.map(row) : []));
    if (done) node.scrollIntoView({block: "nearest"});
  }
  /** What was found belongs to the design that it was asked for. */
  function outdated({design}) { if (asked && design && design.gen !== gen) { stop(); clear(); bar.show({state: "idle"}); find.disabled = false; } }
  target.addEventListener("keydown", event => {
    if (event.key === "Enter") { event.preventDefault(); ask(); }
    if (event.key === "Escape") { event.stopPropagation(); close(); }
  });
  return {
    offer(name) {
      const made = tool("target", t("Bring to a value"), () => open(name));
      made.dataset.testid = `reach-${name}`;
      return made;
    },
    shown() { if (wanted && !node.isConnected) { const row = place(wanted); if (row) row.append(node); else close(); } },
    stops: [store.on(["jobs"], update), store.on(["design"], outdated)],
  };
}
