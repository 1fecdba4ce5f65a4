// A form that is opened in the panel of a job: asks the server what may vary, shows what is refused, goes when the job begins.

import { learn, secondsOf } from "./costs.js";
import { button } from "./parts.js";

const SHORT = 20;  // seconds of all analyses up to which they are timed once more, without compiling

/**
 * `create(tools, closed)` makes the form of the table `name`.  Returns {node, opener, open(), wanted() -> whether the design lacks its table,
 * follow(job), stops}; `opener` is the button that opens it.
 */
export function createSetup(name, words, tools, create) {
  const {store, say} = tools, form = create(tools, close), opener = button(words, open, {testid: `setup-${name}`});
  let shown = false, before = null, drive = null;
  form.node.hidden = true;

  function open() {
    shown = true;
    form.node.hidden = false;
    form.refused("");
    toTop();
    say({what: "propose"});
    if (!store.state.jobs?.timing && (secondsOf(store) ?? 0) < SHORT) say({what: "job", name: "timing", options: {}});
  }
  function toTop() { form.node.closest(".sd-section").scrollIntoView({block: "start"}); }
  function close() {
    shown = false;
    form.node.hidden = true;
  }
  /** While its job runs the form is out of the way; it comes back with the reason where the job fails. */
  function follow({state, text}) {
    if (!shown) return;
    if (state === "done" || state === "cancelled") close();
    form.node.hidden = !shown || state === "running";
    if (state === "failed") form.refused(text);
  }
  /** What is refused of its table. */
  function refused({refused = {}}) {
    const own = Object.entries(refused).filter(([key]) => key === "" || key === name || key.startsWith(`${name}.`));
    if (own.length || !shown) form.refused(own.map(([, {message}]) => message).join("\n"));
  }
  function designed({design}) {
    if (design && design.opened !== drive) { drive = design.opened; close(); }
  }
  let timed = null;
  function timing({jobs}) {
    const answer = jobs?.timing?.answer;
    if (!answer || answer === timed) return;
    timed = answer;
    learn(store);
    if (shown) form.result();
  }
  const stops = [store.on(["jobs"], timing),
    store.on(["proposals"], ({proposals}) => { if (proposals && shown && proposals !== before) { before = proposals; form.load(proposals); } }),
    store.on(["setup"], ({setup}) => { if (setup === name) { store.set({setup: null}); open(); } }),
    store.on(["result"], () => { learn(store); if (shown) form.result(); }), store.on(["refused"], refused), store.on(["design"], designed),
  ];
  return {
    node: form.node, opener, open, follow, stops,
    wanted: () => !store.state.design?.form.groups.some(group => group.key === name && group.present !== false && (group.fields.length || group.role === "table")),
  };
}
