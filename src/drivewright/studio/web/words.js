// English texts in the language of the page.

const TYPED = "--only ";  // what stands behind it is typed as it is
const MOST = 4000;  // translations kept; running numbers would fill the memory

/**
 * t(text, ...values): the text in the store's language, each * of it filled with a value.
 *
 * `store.state.words` (of the studio), `store.state.design.words` (of the kind of drive, which go first) and `store.state.hints` (what its keys
 * mean, as soon as they are here) are {english: translation}.
 * A * on both sides stands for a part that varies: the parts come in the same order, and one that is a known text is translated too.
 * What is not known stays English.
 */
export function createWords(store) {
  const compiled = new WeakMap(), kept = new Map();
  let keptOf = [];

  const book = words => {
    if (!compiled.has(words)) compiled.set(words, Object.keys(words).map(pattern).filter(Boolean).sort((a, b) => b.weight - a.weight));
    return compiled.get(words);
  };

  const books = () => {
    const found = [store.state.design?.words, store.state.words, store.state.hints].filter(Boolean);
    if (found.length !== keptOf.length || found.some((words, n) => words !== keptOf[n])) { kept.clear(); keptOf = found; }
    return found;
  };

  /** The translation, null where there is none. */
  function known(text, all) {
    if (kept.has(text)) return kept.get(text);
    const found = exact(text, all) ?? exact(otherCase(text), all) ?? fitting(text, all);
    if (kept.size >= MOST) kept.clear();
    kept.set(text, found);
    return found;
  }

  function fitting(text, all) {
    for (const words of all) {
      for (const {english, shape} of book(words)) {
        const parts = shape.exec(text) || shape.exec(otherCase(text));
        const before = english.split("*"), told = (part, n) => before[n].endsWith(TYPED) ? part : known(part, all) ?? part;
        if (parts) return filled(words[english], parts.slice(1).map(told));
      }
    }
    return null;
  }

  return (text, ...values) => {
    const all = text && store.state.lang !== "en" ? books() : [];
    return filled((all.length && known(text, all)) || text, values);
  };
}

const exact = (text, all) => all.find(words => Object.hasOwn(words, text))?.[text] ?? null;

/** First letter small instead of large, or the other way round: headings begin with a capital. */
const otherCase = text => {
  const first = text.slice(0, 1), small = first.toLowerCase();
  return (first === small ? first.toUpperCase() : small) + text.slice(1);
};

/**
 * How to recognise an English text with * in it: what says most goes first.  Null for a plain text, and for a * alone, which says nothing.
 * A word between two parts ("* of *") would be found in nearly every sentence: there the parts are numbers.
 */
function pattern(english) {
  const literal = english.replaceAll("*", ""), part = /^\*.*[a-z].*\*$/i.test(english) ? "([\\d.,\\s]+?)" : "(.+?)";
  if (literal === english || !literal.trim()) return null;
  const escaped = english.split("*").map(part => part.replace(/[.+?^${}()|[\]\\]/g, "\\$&"));
  return {english, shape: new RegExp(`^${escaped.join(part)}$`), weight: literal.length};
}

/** Each * of a text replaced by the next value, as long as there are some. */
function filled(text, values) {
  let next = 0;
  return values.length ? text.replace(/\*/g, star => next < values.length ? String(values[next++]) : star) : text;
}

/** What was refused, in the language of the page, line by line; a line may begin with the key that it is about. */
export function refusedText(text, t) {
  return text.split("\n").map(line => {
    const [, key, words] = /^(\s*[\w.-]+: )(.+)$/.exec(line) || [line, "", line];
    return key && t(line) === line ? key + t(words) : t(line);
  }).join("\n");
}

/** A remark on a drawing that has no motion, without what its heading says. */
const reasonOf = text => text.replace(/^no motion to show: /, "");

/** Why the design as it stands has no motion, in sentences; none where it has, or where the drawing is that of an earlier one. */
export function reasonsOf({scene, design, refused}) {
  const impossible = scene?.gen === design?.gen ? Object.values(refused || {}).filter(({text}) => text === null).map(({message}) => message) : [];
  return [...new Set([...(scene?.remarks || []).map(reasonOf), ...impossible])];
}
