// The groups of the form: a tree of sections that fold, each with its fields, and buttons that add and take out.

import { icon } from "./icons.js";
import { pressable, tool } from "./parts.js";
import { element } from "./player.js";

const ALIKE = 8;  // elements of a list up to which they are open at first
const FEW = 3;    // fields that are not set, from which they hide behind one line

// ---------------------------------------------------------------------------------------------------------------------- tree

const within = (inner, outer) => outer.path.length > 0 && outer.path.length < inner.path.length
  && outer.path.every((name, index) => name === inner.path[index]);

/** The flat list of groups as a tree: [{group, children}]. */
function nested(groups) {
  const top = [], open = [];
  for (const group of groups) {
    while (open.length && !within(group, open.at(-1).group)) open.pop();
    const node = {group, children: []};
    (open.length ? open.at(-1).children : top).push(node);
    open.push(node);
  }
  return top;
}

const anyGiven = ({group, children}) => group.fields.some(field => field.given) || children.some(anyGiven);

/** A group that is only an offer: nothing in it yet, one click puts it there. */
const offered = ({group, children}) => !children.length && !group.fields.length
  && (group.role === "list" || group.role === "table" && group.optional && !group.present);

/** Whether two fields have the same boxes. */
export const sameBoxes = (old, now) => old.kind === now.kind && old.parts?.length === now.parts?.length
  && old.choices?.length === now.choices?.length;

/** Whether two forms have the same groups and fields, so that values alone can be set. */
export function sameShape(old, now) {
  if (!old || old.groups.length !== now.groups.length) return false;
  return now.groups.every((group, at) => {
    const was = old.groups[at];
    return was.key === group.key && was.present === group.present && was.role === group.role && was.fields.length === group.fields.length
      && group.fields.every((field, index) => was.fields[index].key === field.key && sameBoxes(was.fields[index], field));
  });
}

// ------------------------------------------------------------------------------------------------------------------ sections

/** The sections of a form in `body`; `rowOf(field)` makes or finds the row of a field.  What is folded is remembered for each kind of drive. */
export function createGroups(body, {say, t, chinese}, rowOf) {
  const folded = new Map();
  let kind = "", wanted = "", titles = [], named = new Map();

  // ---- words
  const bare = group => (chinese() && group.zh) || t(group.title || "General");
  /** An element without a name of its own is called after its list. */
  const titleOf = group => group.role === "element" && /^\d+$/.test(group.title) && named.has(group.list)
    ? `${bare(named.get(group.list))} ${group.index + 1}` : bare(group);
  function retitle() {
    for (const [title, key] of titles) {
      const text = titleOf(named.get(key));
      if (title.textContent === text) continue;
      title.textContent = text;
      title.closest(".st-group").setAttribute("aria-label", text);
    }
  }

  // ---- folding
  function fold(section, open) {
    folded.set(`${kind}:${section.dataset.key}`, !open);
    section.dataset.open = open;
    section.querySelector(".st-group-toggle").setAttribute("aria-expanded", open);
  }
  /** Unfolds everything around a row. */
  function reveal(root) {
    for (let section = root.closest(".st-group"); section; section = section.parentElement.closest(".st-group")) fold(section, true);
  }
  function openAtFirst(node, at, depth, siblings) {
    const seen = folded.get(`${kind}:${node.group.key}`);
    if (seen !== undefined) return !seen;
    if (wanted) return true;
    return node.group.role === "element" ? siblings <= ALIKE && anyGiven(node) : anyGiven(node) || depth === 0 && at < 2;
  }

  // ---- adding and taking out
  function put(group) {
    wanted = group.key;
    say(group.role === "list" ? {what: "add", list: group.key} : {what: "put", table: group.key});
  }
  /** A name is asked for where the elements are named. */
  function askName(group, head) {
    const label = `${t("Name of the new element in")} ${titleOf(group)}`;
    const box = element("input", {type: "text", class: "st-box st-ask", placeholder: t("name, then Enter"), "aria-label": label,
      spellcheck: "false"});
    function finish(name) {
      if (box.isConnected) box.hidden = true;
      setTimeout(() => box.remove());
      if (name) { wanted = `${group.key}.${name}`; say({what: "put", table: wanted}); }
    }
    box.addEventListener("keydown", event => {
      if (event.key === "Enter") finish(box.value.trim());
      else if (event.key === "Escape") { event.preventDefault(); finish(""); }
    });
    box.addEventListener("blur", () => finish(""));
    box.dataset.unsent = "";
    head.after(box);
    box.focus();
  }
  function remove(group, parent) {
    say(parent?.role === "names" ? {what: "take", table: group.key} : {what: "drop", list: group.list, index: group.index});
  }
  /** The button of a group, where there is something to add or to take out. */
  function toolOf(group, parent, head) {
    const title = titleOf(group);
    if (group.role === "list") return tool("plus", `${t("Add to")} ${title}`, () => put(group));
    if (group.role === "names") return tool("plus", `${t("Add to")} ${title}`, () => askName(group, head));
    if (group.role === "element") return tool("cross", `${t("Remove")} ${title}`, () => remove(group, parent));
    if (!group.optional) return null;
    return group.present ? tool("cross", `${t("Take out")} ${title}`, () => say({what: "take", table: group.key}))
      : tool("plus", `${t("Add")} ${title}`, () => put(group));
  }
  function offers(nodes) {
    return element("div", {class: "st-offers"}, ...nodes.map(({group}) => pressable({
      class: "st-chip", title: `${t("Add")} ${titleOf(group)}${group.hint ? `\n${t(group.hint)}` : ""}`, "data-testid": `put-${group.key}`,
    }, () => put(group), icon("plus"), titleOf(group))));
  }

  // ---- drawing
  /** The rows of a group; those that are not set behind one line, where there are some. */
  function placeFields(group, section) {
    const made = group.fields.map(rowOf), fields = element("div", {class: "st-fields"}, ...made.map(row => row.root));
    const unset = made.filter(({field, refusal}) => field.value === null && !field.given && field.optional && !refusal);
    if (unset.length < FEW || unset.length === made.length) return fields;
    for (const row of unset) row.root.classList.add("st-unset");
    const show = () => { section.classList.add("st-all"); unset[0].root.querySelector("input, select")?.focus(); };
    fields.append(pressable({class: "st-more"}, show, `${unset.length} ${t("more, not set")}`));
    return fields;
  }
  function section(node, at, depth, siblings, parent) {
    const {group, children} = node, open = openAtFirst(node, at, depth, siblings), title = element("span", {class: "st-group-title"}, titleOf(group));
    const made = element("section", {class: `st-group st-depth-${Math.min(depth, 3)}`, "data-key": group.key, "data-open": String(open), role: "group", "aria-label": titleOf(group),
      "data-testid": `group-${group.key}`});
    const toggle = pressable({class: "st-group-toggle", "aria-expanded": String(open), title: t(group.hint || "")},
      () => fold(made, made.dataset.open !== "true"), icon("chevron"), title), head = element("div", {class: "st-group-head"}, toggle);
    if (group.role === "list" || group.role === "names")
      toggle.append(element("span", {class: "st-count"}, String(children.length + group.fields.length)));
    head.append(...[toolOf(group, parent, head)].filter(Boolean));
    titles.push([title, group.key]);
    made.append(head, element("div", {class: "st-inside"}, placeFields(group, made), ...branches(children, depth + 1, group)));
    folded.set(`${kind}:${group.key}`, !open);
    return made;
  }
  function branches(nodes, depth, parent) {
    const there = nodes.filter(node => !offered(node)), absent = nodes.filter(offered);
    const made = there.map((node, at) => section(node, at, depth, there.length, parent));
    if (absent.length) made.push(offers(absent));
    return made;
  }
  function draw(form) {
    titles = [];
    body.replaceChildren(...branches(nested(form.groups), 0, null));
  }
  /** Brings what was just added into view. */
  function showNew(form) {
    if (!wanted) return;
    const key = form.groups.filter(group => group.list === wanted).at(-1)?.key ?? wanted;
    const made = [...body.querySelectorAll(".st-group")].find(found => found.dataset.key === key);
    wanted = "";
    if (!made) return;
    fold(made, true);
    made.scrollIntoView({block: "nearest"});
    made.querySelector(".st-fields input")?.focus({preventScroll: true});
  }
  return {
    draw, showNew, reveal, retitle,
    /** Another form: its titles, and no memory of what was asked for where it is of another kind. */
    name(form, of) {
      if (of !== kind) wanted = "";
      kind = of;
      named = new Map(form.groups.map(group => [group.key, group]));
    },
    /** Group key -> title that is shown. */
    shown: () => new Map(titles.map(([title, key]) => [key, title.textContent])),
  };
}
