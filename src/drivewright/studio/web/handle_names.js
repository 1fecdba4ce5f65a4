// What a handle is called: as its field is called in the form, after the element of a list that it belongs to.

/** `learn(groups)` takes the groups of the form; `of(handle)` is the name in the language of the page: "crank · A", "segments 2 · length". */
export function createNames({store, t}) {
  let groups = new Map(), fields = new Map();

  const chinese = () => store.state.lang === "zh";
  const called = ({zh, title, label}) => (chinese() && zh) || t(title || label || "");

  function learn(list) {
    groups = new Map(list.map(group => [group.key, group]));
    fields = new Map(list.flatMap(group => group.fields.map(field => [field.key, field])));
  }
  /** The name of the nearest element, or named table, around a key. */
  function elementOf(key) {
    for (let path = parent(key); path; path = parent(path)) {
      const group = groups.get(path);
      if (group?.role !== "element") continue;
      return /^\d+$/.test(group.title) ? `${t(called(groups.get(group.list) || group))} ${group.index + 1}` : called(group);
    }
    const group = groups.get(parent(key)), table = group?.role === "names" ? groups.get(parent(group.key)) : group;
    return table?.title ? called(table) : "";
  }
  /** The field of a key, or of the point whose part it is. */
  const fieldOf = key => fields.get(key) || fields.get(parent(key));

  function of({key, label}) {
    if (label) return t(label);
    const field = fieldOf(key), own = field ? called(field) : key, part = field && field.key !== key ? ` ${Number(key.split(".").at(-1)) + 1}` : "";
    const around = elementOf(key);
    return `${around ? `${around} · ` : ""}${own}${part}`;
  }
  return {learn, of};
}

const parent = key => key.split(".").slice(0, -1).join(".");
