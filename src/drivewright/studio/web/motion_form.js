// The motion programme, drawn: borders, lifts and points are dragged, laws are chosen, segments and points are added and removed.

import { createMotionBar } from "./motion_bar.js";
import { createMotionDesign } from "./motion_design.js";
import { createMotionDrag } from "./motion_drag.js";
import { createMotionPlot } from "./motion_plot.js";
import { createMotionStatus } from "./motion_status.js";
import { jumpsOf, peaksOf, unpacked } from "./motion_segments.js";
import { element, watchTheme } from "./player.js";

const WAIT = 1500;  // ms that what a hand has left stays drawn without an answer

/** The pane of the motion programme in `host`. */
export function createMotionForm(host, tools) {
  const {store, say, t, clock} = tools;
  const canvas = element("canvas", {class: "mf-canvas"}), cursor = element("div", {class: "dw-cursor mf-cursor"}), layer = element("div", {class: "mf-layer"});
  const stage = element("div", {class: "mf-stage", "data-testid": "programme"}, canvas, cursor, layer), head = element("div", {class: "mf-head"}), foot = element("div", {class: "mf-foot"});
  let programme = null, packed = null, selected = 0, point = null, opened = false, timer = 0, waiting = false;  // point: {n, k}; waiting for the answer to another list
  let drive = null, shown = null, design = null, current = true;  // the drive that all of it belongs to; as drawn; as the form has it; whether the segments of both are the same
  host.classList.add("mf");
  host.append(head, stage, foot);
  const numbers = createMotionDesign(() => store.state.design?.locks || []);
  const theme = watchTheme(host, () => render()), plot = createMotionPlot(canvas, () => place()), status = createMotionStatus(foot, tools);
  const drag = createMotionDrag({layer, stage, plot, drawn: () => shown, isCurrent: () => current, number: numbers.number, numberAt: numbers.numberAt, hold, select, choose, chosen: () => point, tools});
  const bar = createMotionBar(head, {state: () => ({design, shown, selected, point, current, waiting}), numbers, drag, arrange, select, choose, tools});

  function render() {
    if (!programme || !opened) return;
    numbers.complete();
    design = numbers.read();
    current = design.segments.length === programme.segments.length && design.segments.every(({law}, n) => law === programme.segments[n].law);
    shown = numbers.drawn(current);
    selected = Math.max(0, Math.min(selected, design.segments.length - 1));
    stage.classList.toggle("is-old", !current);
    stage.setAttribute("aria-busy", String(numbers.holds()));  // until the design has what the hand left
    const jumps = jumpsOf(shown), peaks = peaksOf(shown, jumps), {factors, titles} = status.words(shown, peaks);
    plot.show({programme: shown, jumps, selected, factors, titles, held: drag.held(), axis: `${t(shown.cycle.label)} [${shown.cycle.unit}]`}, theme.colours);
    place();
    status.tell(shown, jumps, titles);
    bar.fill();
  }
  function place() {
    if (!shown || !opened) return;
    drag.place(selected);
    follow();
  }
  function follow() {
    if (!shown) return;
    cursor.style.transform = `translateX(${Math.round(plot.toX(clock.phase * shown.cycle.span - (shown.origin ?? 0)))}px)`;
    cursor.style.height = `${plot.bottom() - 24}px`;
  }

  // ---- what is chosen, and a hand
  function select(n) { selected = n; if (point?.n !== n) point = null; render(); }
  function choose(n, k) { if (point?.n === n && point.k === k) return; selected = n; point = {n, k}; render(); }
  function arrange(elements) { waiting = true; say({what: "arrange", list: programme.list, elements}); bar.fill(); }
  /** Numbers {key: SI} and texts {key: text} in the hand, drawn at once; null lets go as soon as the design has them. */
  function hold(held, texts) {
    clearTimeout(timer);
    if (held) numbers.hold(held, texts); else timer = setTimeout(() => { numbers.hold(null); render(); }, WAIT);
    render();
  }
  function designChanged({design: next}) {
    waiting = false;
    if (next?.opened !== drive) { drive = next?.opened; programme = packed = shown = design = point = null; numbers.hold(null); selected = 0; }
    numbers.fill(new Map((next?.form?.groups || []).flatMap(group => group.fields.map(field => [field.key, field]))));
    if (programme && numbers.holds() && !drag.held() && numbers.arrived()) numbers.hold(null);
    render();
  }
  function sceneChanged({scene}) {
    if (!scene?.programme || scene.programme === packed) return;
    packed = scene.programme;
    programme = unpacked(packed);
    numbers.load(programme);
    render();
  }
  canvas.setAttribute("role", "img");
  const name = () => canvas.setAttribute("aria-label", t("Lift, velocity, acceleration and jerk over the cycle"));
  name();
  const stops = [store.on(["design"], designChanged), store.on(["scene"], sceneChanged), store.on(["result"], () => { if (shown && opened) status.check(shown); }), store.on(["refused"], () => { waiting = false; if (opened) bar.fill(); }), clock.subscribe(follow)];
  return {
    open() { opened = true; render(); },
    close() { opened = false; },
    reword() { bar.reword(); drag.reword(); name(); render(); },
    destroy() { clearTimeout(timer); stops.forEach(stop => stop()); theme.stop(); plot.stop(); drag.destroy(); host.replaceChildren(); },
  };
}
