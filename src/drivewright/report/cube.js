// A small cube that turns with the view of the solids; a press on a face looks at the assembly from there.  By the keyboard it is one stop:
// arrow keys go from face to face, Enter or space looks.

import { element } from "./clock.js";

const HALF = 27;  // px: half of an edge
// Of each face its name, and how it is turned from the one in front.
const FACES = [["front", ""], ["back", "rotateY(180deg)"], ["side", "rotateY(90deg)"], ["left", "rotateY(-90deg)"], ["top", "rotateX(90deg)"],
  ["bottom", "rotateX(-90deg)"]];

/** {node, turn(axes)}: axes are the rows right, up, towards the eye of the view; `picked(name)` is called with the view of a face. */
export function createCube(picked, t) {
  const words = {front: t("Front"), back: t("Back"), side: t("Right"), left: t("Left"), top: t("Top"), bottom: t("Bottom")};
  const faces = FACES.map(([name, turned]) => {
    const made = element("button", {type: "button", class: "so-face", tabindex: name === "front" ? 0 : -1, "data-testid": `cube-${name}`}, words[name]);
    made.style.transform = `${turned} translateZ(${HALF}px)`;
    made.addEventListener("click", () => picked(name));
    made.addEventListener("focus", () => faces.forEach(face => { face.tabIndex = face === made ? 0 : -1; }));
    return made;
  });
  const inside = element("div", {class: "so-cube"}, ...faces);
  const node = element("div", {class: "so-cube-place", role: "group", "aria-label": t("View cube")}, inside);
  node.addEventListener("keydown", event => {
    const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key], from = faces.indexOf(document.activeElement);
    if (!step || from < 0) return;
    event.preventDefault(); event.stopPropagation();
    const face = faces[(from + step + faces.length) % faces.length];
    face.focus();
    picked(FACES[faces.indexOf(face)][0]);  // a face behind cannot be seen: the view follows
  });
  return {
    node,
    /** The page's y axis points down, the view's up: the signs of the second row and column change. */
    turn([right, up, eye]) {
      const m = [right[0], -up[0], eye[0], 0, -right[1], up[1], -eye[1], 0, right[2], -up[2], eye[2], 0, 0, 0, 0, 1];
      inside.style.transform = `matrix3d(${m.map(x => x.toFixed(5)).join(",")})`;
    },
  };
}
