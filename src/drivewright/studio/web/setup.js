// A form that is opened in the panel of a job: asks the server what may vary, shows what is refused, goes when the job begins.

import { learn, secondsOf } from "./costs.js";
import { button } from "./parts.js";

const SHORT = 20;  // seconds of all analyses up to which they are timed once more, without compiling

/**
 * What is in an open form is kept in the store while the column is made anew in another language.
 * `create(tools, closed)` makes the form of the table `name`.  Returns {node, opener, open(), wanted() -> whether the design lacks its table,
 * follow(job), stops}; `opener` is the button that opens it.
 */
export function createSetup(name, words, tools, create) {
  const {store, say} = tools, form = create(tools, close), opener = button(words, open, {testid: `setup-${name}`});
  opener.setAttribute("aria-label", form.node.getAttribute("aria-label"));  // there are two of them
  let shown = false, asked = false, before = null, drive = null, was = null;  // before: proposals that were there when others were asked for
  form.node.hidden = true;

  function open() {
    shown = true;
    form.node.hidden = false;
    form.refused("");
    toTop();
    asked = true; before = store.state.proposals;
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
    const ended = was === "running" && (state === "done" || state === "cancelled");
    was = state;
    if (!shown) return;
    if (ended) close();
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
    store.on(["proposals"], ({proposals}) => { if (asked && proposals && proposals !== before) { asked = false; form.load(proposals); } }),
    store.on(["result"], () => { learn(store); if (shown) form.result(); }), store.on(["refused"], refused), store.on(["design"], designed),
    () => keep(shown ? form.draft() : null),
  ];
  const keep = draft => store.set({drafts: {...store.state.drafts, [name]: draft}}), draft = store.state.drafts?.[name];
  if (draft) {
    keep(null);
    shown = true;
    form.node.hidden = false;
    form.load(draft);
  }
  return {
    node: form.node, opener, open, follow, stops,
    wanted: () => !store.state.design?.form.groups.some(group => group.key === name && group.present !== false && (group.fields.length || group.role === "table")),
  };
}
