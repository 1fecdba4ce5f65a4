// Elements of an SVG.

const SVG = "http://www.w3.org/2000/svg";

/** svgPart("line", {x1: 0, class: "x"}, "text"); text is set as text, never as markup. */
export function svgPart(tag, attributes = {}, text = "") {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text) made.textContent = text;
  return made;
}
