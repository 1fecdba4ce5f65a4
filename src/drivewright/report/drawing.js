// The drawing of one scene on a canvas, the window onto it, and how a hand moves that window.

import { locate, nice, useFont } from "./clock.js";
import { STILL, boxOf, carry, isDrawn, pathOf, poseAt, poseOf, seenFrom } from "./scene.js";

// -------------------------------------------------------------------------------------------------------------- drawing

const FILLED = new Set(["profile", "body", "roller"]);
const LOOKS = {pitch: [1.2, [9, 3, 2, 3]], base: [1.1, [2, 3]], axis: [1, [12, 3, 2, 3]], ground: [2.2, []], defect: [3, []]};
const PLAIN = [1.8, []];
// Ways to draw a body: `fill` its share of the colour inside, `bare` only what is filled, without holes and lines.
const NORMAL = {alpha: 1, fill: 0.24}, LIT = {alpha: 1, fill: 0.5, width: 3.2}, DIM = {alpha: 0.35, fill: 0.24};
const GHOST = {alpha: 0.28, fill: 0, width: 1, bare: true}, COMPARED = {alpha: 0.6, fill: 0.14, width: 1, bare: true, colour: "muted"};
const TRACES = ["violet", "orange", "green", "blue", "steel"];
const PAST = 4, GHOSTS = 8, WORDS = "11.5px system-ui, sans-serif";
const ABOVE = 17, BELOW = 11;  // px from a point to the middle of its word: above, a handle stands on it

/** All drawing of one scene: `paint(context, view, observer, clock, colours, switches, reference)`; sizes in pixels, poses in metres. */
export function createPainter(scene) {
  const paths = new Map();

  /** Points of every trace for an observer, one per frame. */
  function traces(observer, scale) {
    const key = `${observer.name} ${scale}`, last = scene.frames - 1;
    const path = ({body, point}) => {
      const points = new Float64Array(2 * scene.frames);
      for (let i = 0; i <= last; i++) {
        const low = Math.min(i, last - 1), part = i - low, eye = poseAt(observer.motion, low, part);
        points.set(carry(point, seenFrom(poseOf(scene.bodies[body], low, part, scale), eye)), 2 * i);
      }
      return points;
    };
    if (!paths.has(key)) { paths.clear(); paths.set(key, scene.traces.map(path)); }
    return paths.get(key);
  }

  /** How far the traces of the cycle before lie from this one's, for an observer that travels on. */
  function stepBack(observer) {
    const [x, y] = observer.advance, angle = observer.motion[2], c = Math.cos(angle), s = Math.sin(angle);
    return [c * x + s * y, c * y - s * x];
  }

  /** Box around everything that is seen over the cycle; an advancing observer's camera goes along, so its drift is taken off. */
  function extent(observer, scale) {
    const back = stepBack(observer), moving = back[0] || back[1], box = boxOf([]);
    for (let n = 0; n < 60; n++) {
      const phase = n / 60, [low, part] = locate(scene.u, phase), eye = poseAt(observer.motion, low, part);
      for (const body of scene.bodies) {
        const pose = seenFrom(poseOf(body, low, part, scale), eye);
        pose[0] += phase * back[0]; pose[1] += phase * back[1];
        boxOf(body.far, pose, box);
      }
    }
    if (!moving) for (const points of traces(observer, scale)) boxOf(points, STILL, box);
    const near = 0.25 * Math.max(box[2] - box[0], box[3] - box[1]), [x0, y0, x1, y1] = [box[0] - near, box[1] - near, box[2] + near, box[3] + near];
    const soil = observer.far.map((v, i) => i % 2 ? Math.min(Math.max(v, y0), y1) : Math.min(Math.max(v, x0), x1));  // longer than what is worth seeing
    boxOf(soil, STILL, box);
    if (moving) boxOf([box[0] + 0.8 * Math.min(back[0], 0), box[1] + 0.8 * Math.min(back[1], 0),
      box[2] + 0.8 * Math.max(back[0], 0), box[3] + 0.8 * Math.max(back[1], 0)], STILL, box);
    return Number.isFinite(box[0]) ? box : [-1, -1, 1, 1];
  }

  function grid(context, view, origin, colours) {
    const [factor] = scene.length ?? [1], step = nice(190 / view.scale * factor) / factor, fine = nice(step / 4 * factor) / factor;
    for (const [spacing, colour] of [[fine, colours.grid], [step, colours["grid-strong"]]]) {
      context.beginPath();
      const [x0, y0, x1, y1] = view.window();
      for (let x = Math.ceil((x0 - origin[0]) / spacing) * spacing + origin[0]; x < x1; x += spacing) {
        const at = Math.round(view.toX(x)) + 0.5; context.moveTo(at, 0); context.lineTo(at, view.height);
      }
      for (let y = Math.ceil((y0 - origin[1]) / spacing) * spacing + origin[1]; y < y1; y += spacing) {
        const at = Math.round(view.toY(y)) + 0.5; context.moveTo(0, at); context.lineTo(view.width, at);
      }
      context.strokeStyle = colour; context.lineWidth = 1; context.stroke();
    }
  }

  /** One shape in the frame that the context stands in. */
  function shape(context, view, {layer, outline}, colour, colours, look, hatched = true) {
    const filled = FILLED.has(layer), px = 1 / view.scale, path = pathOf(outline, view.level);
    if (look.bare && !filled) return;
    const [width, dashes] = LOOKS[layer] || PLAIN;
    if (filled && outline.closed && look.fill) { context.globalAlpha = look.alpha * look.fill; context.fillStyle = colour; context.fill(path); }
    context.globalAlpha = look.alpha;
    if (layer === "hole") { context.fillStyle = colours.canvas; context.fill(path); }
    context.strokeStyle = {hole: colours.ink, axis: colours.muted, defect: colours.bad}[layer] || colour;
    context.lineWidth = (look.width || width) * px;
    if (dashes.length) context.setLineDash(dashes.map(d => d * px));
    context.lineCap = dashes.length ? "butt" : "round";  // pieces of a bent shaft meet at an angle
    context.stroke(path);
    if (dashes.length) context.setLineDash([]);
    if (layer === "ground" && !outline.closed && hatched) hatch(context, outline.points, px);
  }

  /** Strokes on the right of a line of ground as it runs (below, from left to right): the mark of what does not move. */
  function hatch(context, points, px) {
    context.beginPath();
    for (let i = 2; i < points.length; i += 2) {
      const ax = points[i - 2], ay = points[i - 1], bx = points[i], by = points[i + 1], length = Math.hypot(bx - ax, by - ay) || 1, tx = (bx - ax) / length, ty = (by - ay) / length;
      for (let at = 5 * px; at < length; at += 7 * px) {
        const x = ax + at * tx, y = ay + at * ty;
        context.moveTo(x, y); context.lineTo(x + 6 * px * (ty - tx), y - 6 * px * (tx + ty));
      }
    }
    context.lineWidth = px;
    context.stroke();
  }

  /** [body, pose] of everything that is switched on and reaches into the window, from the lowest to the topmost. */
  function* standing(view, observer, phase, {hidden, scale}) {
    const [low, part] = locate(scene.u, phase), eye = poseAt(observer.motion, low, part), [x0, y0, x1, y1] = view.window();
    for (const body of scene.bodies) {
      if (hidden.has(body.title) || !isDrawn(body, low, part)) continue;
      const pose = seenFrom(poseOf(body, low, part, scale), eye), [x, y] = pose, reach = body.reach;
      if (x + reach > x0 && x - reach < x1 && y + reach > y0 && y - reach < y1) yield [body, pose];
    }
  }

  function bodies(context, view, observer, phase, colours, switches, look) {
    for (const [body, pose] of standing(view, observer, phase, switches)) {
      const colour = colours[look && look.colour || body.colour] || colours.steel;
      const own = look || (switches.lit.has(body.name) ? LIT : switches.lit.size ? DIM : NORMAL);
      view.place(context, pose);
      for (const one of body.shapes) shape(context, view, one, colour, colours, own);
    }
    context.globalAlpha = 1; context.lineCap = "butt";
  }

  /** Name of the topmost body at a pixel; undefined where there is none.  What is not filled can be hit within 5 px of its line. */
  function pick(context, view, observer, {phase}, switches, x, y) {
    const at = [x * view.ratio, y * view.ratio];
    const hit = ([{shapes}, pose]) => {
      view.place(context, pose);
      context.lineWidth = 10 / view.scale;
      return shapes.some(({layer, outline}) => {
        const path = pathOf(outline, view.level);
        return FILLED.has(layer) && outline.closed ? context.isPointInPath(path, ...at) : context.isPointInStroke(path, ...at);
      });
    };
    return [...standing(view, observer, phase, switches)].reverse().filter(hit).map(([body]) => body.name)[0];
  }

  function line(context, view, points, shift, from, to) {
    context.beginPath();
    for (let i = from; i <= to; i++) context.lineTo(view.toX(points[2 * i] + shift[0]), view.toY(points[2 * i + 1] + shift[1]));
    context.stroke();
  }

  /** The whole path dashed, what has been run through drawn full, earlier cycles faint, a dot at the point itself. */
  function tracks(context, view, observer, phase, colours, scale) {
    const back = stepBack(observer), moving = back[0] || back[1], [low, part] = locate(scene.u, phase), last = scene.frames - 1;
    context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    traces(observer, scale).forEach((points, n) => {
      const colour = colours[scene.traces[n].colour || TRACES[n % TRACES.length]];
      context.strokeStyle = context.fillStyle = colour;
      context.lineWidth = 1.5; context.globalAlpha = 0.45;
      for (let k = 1; moving && k <= PAST; k++) line(context, view, points, [k * back[0], k * back[1]], 0, last);
      context.globalAlpha = 1; context.setLineDash([6, 4]);
      line(context, view, points, [0, 0], moving ? low : 0, last);
      context.setLineDash([]);
      if (moving) line(context, view, points, [0, 0], 0, low);
      const [ax, ay, bx, by] = points.slice(2 * low, 2 * low + 4);
      context.beginPath();
      context.arc(view.toX(ax + part * (bx - ax)), view.toY(ay + part * (by - ay)), 4, 0, 7);
      context.fill();
    });
  }

  /** Words beside their points, on a ground of their own so that they can be read over lines; one that would cover another is left out. */
  function labels(context, view, observer, phase, colours, {hidden, scale}) {
    const [low, part] = locate(scene.u, phase), eye = poseAt(observer.motion, low, part), taken = [];
    context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    useFont(context, WORDS); context.textAlign = "center"; context.textBaseline = "middle";
    for (const {text, body, point, above} of scene.labels || []) {
      const carrier = scene.bodies[body];
      if (carrier && hidden.has(carrier.title)) continue;
      const [x, y] = carry(point, seenFrom(carrier ? poseOf(carrier, low, part, scale) : STILL, eye)), wide = context.measureText(text).width + 8;
      const px = view.toX(x), py = view.toY(y) + (above ? -ABOVE : BELOW), box = [px - wide / 2, py - 8, px + wide / 2, py + 8];
      if (taken.some(other => box[0] < other[2] && box[2] > other[0] && box[1] < other[3] && box[3] > other[1])) continue;
      taken.push(box);
      context.fillStyle = colours.canvas; context.globalAlpha = 0.8;
      context.fillRect(box[0], box[1], wide, 16);
      context.globalAlpha = 1; context.fillStyle = colours.ink;
      context.fillText(text, px, py);
    }
    context.textAlign = "left"; context.textBaseline = "alphabetic";
  }

  /** The scene as one that another is compared with: thin and grey. */
  function behind(context, view, observer, phase, colours, switches) {
    bodies(context, view, observer, phase, colours, switches, COMPARED);
    if (!switches.traces) return;
    context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    context.strokeStyle = colours.muted; context.lineWidth = 1; context.setLineDash([3, 4]);
    for (const points of traces(observer, switches.scale)) line(context, view, points, [0, 0], 0, scene.frames - 1);
    context.setLineDash([]);
  }

  function paint(context, view, observer, {phase, turn}, colours, switches, reference) {
    const back = stepBack(observer), moving = back[0] || back[1];
    context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    context.fillStyle = colours.canvas;
    context.fillRect(0, 0, view.width, view.height);
    context.lineJoin = "miter"; context.miterLimit = 3;  // round joins cost half as much again
    view.follow = [-phase * back[0], -phase * back[1]];
    grid(context, view, [turn * back[0], turn * back[1]], colours);
    for (let k = moving ? -2 : 0; k <= (moving ? PAST : 0); k++) {
      view.place(context, [k * back[0], k * back[1], 0]);
      for (const one of observer.shapes) shape(context, view, one, colours.ground, colours, NORMAL, !moving);
    }
    if (reference) reference.painter.behind(context, view, reference.observer, phase, colours, switches);
    if (switches.ghosts) for (let n = 0; n < GHOSTS; n++) bodies(context, view, observer, n / GHOSTS, colours, switches, GHOST);
    if (switches.traces) tracks(context, view, observer, phase, colours, switches.scale);
    bodies(context, view, observer, phase, colours, switches);
    if (scene.labels) labels(context, view, observer, phase, colours, switches);
    scaleBar(context, view, colours);
  }

  function scaleBar(context, view, colours) {
    const [factor, unit] = scene.length ?? [1, ""], size = nice(170 / view.scale * factor), length = size / factor;
    const x = 16.5, y = view.height - 16.5, end = x + length * view.scale;
    context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    context.strokeStyle = colours.muted; context.lineWidth = 1.5;
    context.beginPath(); context.moveTo(x, y - 4); context.lineTo(x, y); context.lineTo(end, y); context.lineTo(end, y - 4); context.stroke();
    context.fillStyle = colours.muted; useFont(context, WORDS);
    context.fillText(unit ? `${+size.toPrecision(3)} ${unit}` : lengthText(length), x + 5, y - 6);
  }

  return {paint, behind, pick, extent};
}

/** 0.05 -> "50 mm", 2 -> "2 m", 2e-5 -> "20 µm". */
function lengthText(length) {
  const [factor, unit] = length > 0.999 ? [1, "m"] : length > 0.000999 ? [1e3, "mm"] : [1e6, "µm"];
  return `${+(length * factor).toPrecision(3)} ${unit}`;
}

// ------------------------------------------------------------------------------------------------------------- the view

/** Window onto the plane: `scale` px per metre about `centre`; `follow` moves along with an advancing observer. */
export function createView() {
  return {
    scale: 1000, centre: [0, 0], follow: [0, 0], width: 1, height: 1, ratio: 1,
    get level() { return Math.ceil(2 * Math.log2(this.scale * this.ratio)) / 2; },
    middle() { return [this.centre[0] + this.follow[0], this.centre[1] + this.follow[1]]; },
    toX(x) { return this.width / 2 + (x - this.centre[0] - this.follow[0]) * this.scale; },
    toY(y) { return this.height / 2 - (y - this.centre[1] - this.follow[1]) * this.scale; },
    window([x, y] = this.middle()) {
      const w = this.width / 2 / this.scale, h = this.height / 2 / this.scale;
      return [x - w, y - h, x + w, y + h];
    },
    place(context, [x, y, angle]) {
      const k = this.scale * this.ratio, c = Math.cos(angle) * k, s = Math.sin(angle) * k;
      context.setTransform(c, -s, -s, -c, this.toX(x) * this.ratio, this.toY(y) * this.ratio);
    },
    /** Scale and centre that show a box within margins. */
    fitting([x0, y0, x1, y1], {top, right, bottom, left}) {
      const w = Math.max(this.width - left - right, LEAST), h = Math.max(this.height - top - bottom, LEAST);
      const scale = Math.max(Math.min(w / Math.max(x1 - x0, 1e-9), h / Math.max(y1 - y0, 1e-9)), 1e-6);
      return {scale, centre: [(x0 + x1) / 2 + (right - left) / 2 / scale, (y0 + y1) / 2 + (top - bottom) / 2 / scale]};
    },
    /** Whether a box has left the window or has become small in it. */
    loses(box, margins) {
      const [x0, y0, x1, y1] = this.window(this.centre);
      return box[0] < x0 || box[1] < y0 || box[2] > x1 || box[3] > y1 || this.scale < SMALL * this.fitting(box, margins).scale;
    },
    zoom(factor, px, py) {
      const x = (px - this.width / 2) / this.scale, y = (this.height / 2 - py) / this.scale;
      this.scale *= factor;
      this.centre = [this.centre[0] + x * (1 - 1 / factor), this.centre[1] + y * (1 - 1 / factor)];
    },
    pan(dx, dy) { this.centre = [this.centre[0] - dx / this.scale, this.centre[1] + dy / this.scale]; },
  };
}

/**
 * Mouse, wheel and touch on the canvas.  The wheel zooms once the canvas has the focus (or with Ctrl), so that a page still scrolls.
 * A press that does not travel calls `clicked(x, y)`.
 */
export function steer(canvas, view, redraw, moved, clicked) {
  const fingers = new Map();
  let travelled = 0;
  const at = event => { const box = canvas.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
  const spread = () => { const [a, b] = [...fingers.values()]; return [Math.hypot(a[0] - b[0], a[1] - b[1]), (a[0] + b[0]) / 2, (a[1] + b[1]) / 2]; };
  canvas.addEventListener("pointerdown", event => {
    canvas.focus({preventScroll: true});
    canvas.setPointerCapture(event.pointerId);
    travelled = fingers.size ? Infinity : 0;
    fingers.set(event.pointerId, at(event));
  });
  canvas.addEventListener("pointermove", event => {
    if (!fingers.has(event.pointerId)) return;
    const before = fingers.size === 2 ? spread() : null, old = fingers.get(event.pointerId), now = at(event);
    travelled = Math.max(travelled, Math.hypot(now[0] - old[0], now[1] - old[1]));
    if (travelled < SHAKE) return;
    fingers.set(event.pointerId, now);
    if (before) {
      const after = spread();
      view.zoom(after[0] / Math.max(before[0], 1), after[1], after[2]);
      view.pan(after[1] - before[1], after[2] - before[2]);
    } else view.pan(now[0] - old[0], now[1] - old[1]);
    moved(); redraw();
  });
  canvas.addEventListener("pointerup", event => { if (fingers.delete(event.pointerId) && travelled < SHAKE) clicked(...at(event)); });
  canvas.addEventListener("pointercancel", event => fingers.delete(event.pointerId));
  canvas.addEventListener("wheel", event => {
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    view.zoom(Math.exp(-Math.max(-200, Math.min(200, event.deltaY)) * 0.0016), ...at(event));
    moved(); redraw();
  }, {passive: false});
}

const SMALL = 0.45, SHAKE = 4, LEAST = 24;  // of the window, before it is fitted anew; px of a hand that clicks; px that a fitted drawing has
