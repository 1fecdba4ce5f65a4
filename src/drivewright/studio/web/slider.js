// The slider of a field: a thumb, the two numbers at its ends, and which of its steps are one step of undo.

import { decimals, quantityOf, withUnit } from "./numbers.js";
import { element } from "./player.js";
import { pressable } from "./parts.js";

const SESSION = 800;  // ms between steps that end one undo step

let gestures = 0;

/** The id of the steps of a field that are undone together: a drag, or steps that follow quickly. */
export function createGesture(key) {
  let id = "", last = 0;
  const begin = () => { id = `${key}:${++gestures}:${Math.round(performance.now())}`; };
  return {
    begin,
    end() { id = ""; },
    current() { if (!id) begin(); return id; },
    /** The id of a step that belongs to the one before unless there was a pause. */
    next(dragging = false) {
      const now = performance.now();
      if (!dragging && now - last > SESSION || !id) begin();
      last = now;
      return id;
    },
  };
}

const stepOf = (field, [from, to]) => field.kind === "integer" ? Math.max(1, Math.round(field.step || 1)) : field.step || (to - from) / 200;
const short = value => String(Number(value.toPrecision(4)));

/** A slider for a row of the form, `bounds` holding the ends that were typed.  `moved(text, gesture)` while it moves, `ended()` after. */
export function createSlider(row, {bounds, t, moved, ended}) {
  const range = element("input", {type: "range", class: "st-range", "data-testid": `slider-${row.key}`, "aria-label": row.name,
    tabindex: -1});  // the arrow keys of the box do the same
  const ends = ["low", "high"].map((side, index) => pressable({class: `st-bound st-bound-${side}`, tabindex: "-1",
    title: t("Click to type another end of the slider")}, end => typeBound(end, index)));
  const slider = {root: element("div", {class: "st-slide"}, range, ...ends), range, dragging: false, show}, gesture = createGesture(row.key);
  let span = null, step = 1, drawn = "";

  /** Ends in force: typed ones, else the server's. */
  function fit(field) {
    const typed = bounds.get(row.key), own = typed && typed.unit === field.unit ? typed : {};
    const low = own.low ?? Math.min(field.slider[0], field.value), high = own.high ?? Math.max(field.slider[1], field.value);
    const mark = `${low} ${high} ${field.step} ${field.unit}`;
    if (mark === drawn) return;
    drawn = mark;
    span = [low, high];
    step = stepOf(field, span);
    range.min = low; range.max = high; range.step = step;
    ends.forEach((end, index) => {
      end.textContent = short(span[index]);
      end.setAttribute("aria-label", `${t(index ? "Upper end of the slider" : "Lower end of the slider")}: ${end.textContent}`);
    });
  }
  function paint() { range.style.setProperty("--part", (range.value - span[0]) / (span[1] - span[0] || 1)); }
  function show(field) {
    if (slider.dragging || typeof field.value !== "number") return;
    fit(field);
    range.value = field.value;
    range.setAttribute("aria-valuetext", field.text);
    paint();
  }

  // ---- moving
  function press(event) { if (event.button === 0) { slider.dragging = true; gesture.begin(); } }
  function move() {
    const text = withUnit(Number(Number(range.value).toFixed(decimals(step))), row.field.unit);
    paint();
    range.setAttribute("aria-valuetext", text);
    moved(text, gesture.next(slider.dragging));
  }
  function release() { if (slider.dragging) { slider.dragging = false; gesture.end(); ended(); } }
  range.addEventListener("pointerdown", press);
  range.addEventListener("input", move);
  for (const name of ["pointerup", "pointercancel", "lostpointercapture", "blur"]) range.addEventListener(name, release);
  range.addEventListener("change", ended);

  // ---- other ends
  function typeBound(end, index) {
    const name = t(index ? "Upper end of the slider" : "Lower end of the slider");
    const box = element("input", {type: "text", class: `${end.className} st-bound-box`, "aria-label": name});
    let done = false;
    const finish = take => {
      if (done) return;
      done = true;
      const value = take ? quantityOf(box.value)?.[0] : undefined;
      box.replaceWith(end);
      if (Number.isFinite(value)) setBound(index, value);
    };
    box.addEventListener("keydown", event => {
      if (event.key !== "Enter" && event.key !== "Escape") return;
      event.preventDefault(); event.stopPropagation();
      finish(event.key === "Enter");
      range.focus();
    });
    box.addEventListener("blur", () => finish(true));
    box.value = end.textContent;
    end.replaceWith(box);
    box.focus(); box.select();
  }
  function setBound(index, value) {
    const {low, high, unit} = row.field, kept = Math.min(Math.max(value, low ?? -Infinity), high ?? Infinity), other = span[1 - index];
    if (index ? kept <= other : kept >= other) return;
    bounds.set(row.key, {...bounds.get(row.key), unit, [index ? "high" : "low"]: kept});
    show(row.field);
  }
  return slider;
}
