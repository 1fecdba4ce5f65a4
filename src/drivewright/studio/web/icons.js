// Drawn signs: not every font has ticks, crosses and arrows.

const SVG = "http://www.w3.org/2000/svg";
const PATHS = {
  undo: "M8 5 4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11H9",
  redo: "m16 5 4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h5",
  open: "M3 18V6a1 1 0 0 1 1-1h5l2 2.5h8a1 1 0 0 1 1 1V10M3 18l2.6-7.3a1 1 0 0 1 1-.7H21a.8.8 0 0 1 .8 1L19.6 18a1 1 0 0 1-1 .8H4a1 1 0 0 1-1-.8Z",
  save: "M5 4h11l4 4v11a1 1 0 0 1-1 1H5a1 1 0 0 1-1-1V5a1 1 0 0 1 1-1ZM8 4v5h7V4M8 20v-6h8v6",
  share: "M15.5 7.5 8.5 11M15.5 16.5l-7-3.5M18 3.5a2.6 2.6 0 1 1 0 5.2 2.6 2.6 0 0 1 0-5.2ZM6 9.4a2.6 2.6 0 1 1 0 5.2 2.6 2.6 0 0 1 0-5.2Z"
    + "M18 15.3a2.6 2.6 0 1 1 0 5.2 2.6 2.6 0 0 1 0-5.2Z",
  compare: "M12 3v18M9 6H4v12h5M15 6h5v12h-5",
  report: "M6 3h8l5 5v12a1 1 0 0 1-1 1H6a1 1 0 0 1-1-1V4a1 1 0 0 1 1-1ZM14 3v5h5M12 11v6M9.5 14.7 12 17.2l2.5-2.5",
  sun: "M12 8a4 4 0 1 1 0 8 4 4 0 0 1 0-8ZM12 2.5v2M12 19.5v2M2.5 12h2M19.5 12h2"
    + "M5.3 5.3l1.4 1.4M17.3 17.3l1.4 1.4M18.7 5.3l-1.4 1.4M6.7 17.3l-1.4 1.4",
  moon: "M20 14.5A8.5 8.5 0 0 1 9.5 4a8.5 8.5 0 1 0 10.5 10.5Z",
  down: "m7 10 5 5 5-5",
  plus: "M12 5v14M5 12h14",
  cross: "m6.5 6.5 11 11M17.5 6.5l-11 11",
  lock: "M6 11h12v9H6ZM8.5 11V8a3.5 3.5 0 0 1 7 0v3",
  unlock: "M6 11h12v9H6ZM8.5 11V7.5a3.5 3.5 0 0 1 6.8-1.2",
  reset: "M5 5v5h5M5.6 10a7.5 7.5 0 1 1-.9 5",
  chevron: "m9 6 6 6-6 6",
  more: "M5 12h.01M12 12h.01M19 12h.01",
  handles: "M7.5 7.5l9 9M5.5 3.5a2 2 0 1 1 0 4 2 2 0 0 1 0-4ZM18.5 16.5a2 2 0 1 1 0 4 2 2 0 0 1 0-4ZM17 4v6M14 7h6",
  dimension: "M4 5v14M20 5v14M4 12h16M7.5 8.5 4 12l3.5 3.5M16.5 8.5 20 12l-3.5 3.5",
  ruler: "M3 9h18v6H3ZM7 9v3M11 9v3M15 9v3M19 9v3",
  search: "M10.5 4a6.5 6.5 0 1 1 0 13 6.5 6.5 0 0 1 0-13ZM15.5 15.5 20 20",
  target: "M12 5a7 7 0 1 1 0 14a7 7 0 0 1 0-14ZM12 2.5v5M12 16.5v5M2.5 12h5M16.5 12h5",
  ok: "M4 12.5l5.5 5.5L20 7",
  bad: "M6 6l12 12M18 6L6 18",
  warn: "M8 9a4 4 0 1 1 5.6 3.7c-1.1.5-1.6 1.2-1.6 2.3M12 19.2v.3",
  stale: "M12 6v6l4 3M12 3a9 9 0 1 0 .01 0",
};

/** An SVG element with one path for each text of path commands. */
function drawing(attributes, ...paths) {
  const made = document.createElementNS(SVG, "svg");
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  for (const commands of paths) made.append(document.createElementNS(SVG, "path"));
  paths.forEach((commands, at) => made.children[at].setAttribute("d", commands));
  return made;
}

const small = (look, ...paths) => drawing({viewBox: "0 0 24 24", class: look, "aria-hidden": "true"}, ...paths);

/** A small sign in the colour of the text around it. */
export const icon = (name, look = "st-icon") => small(look, PATHS[name]);

/** Another sign in the place of one. */
export const setIcon = (made, name) => made.firstChild.setAttribute("d", PATHS[name]);

/** The product's mark: a wheel on its shaft, and the link it drives. */
export const mark = () => small("st-mark", "M9 5a7 7 0 1 1 0 14A7 7 0 0 1 9 5Z", "M9 12 20.5 6", "M9 10.4a1.6 1.6 0 1 1 0 3.2 1.6 1.6 0 0 1 0-3.2Z");
