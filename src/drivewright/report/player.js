// The motion player: one cycle of a mechanism on a canvas.  Plain ES2020, no build step; the report inlines it, a page may import it.
//
//   const clock = createClock({duration: 4});
//   const player = createPlayer(host, scene, {clock});      // scene: the dictionary of pack_scene
//
// Lengths arrive in metres, angles in radians, y up.  Colours are the custom properties --blue, --ink ... of the host's style.

// ---------------------------------------------------------------------------------------------------------------- shared

/** One phase 0..1 for everything on a page.  `turn` counts whole cycles; `duration` is the time of a cycle at speed 1, in seconds. */
export function createClock({duration = 4, speed = 1} = {}) {
  const listeners = new Set(), awake = new Set();
  let frame = 0, last = 0;
  const clock = {
    phase: 0, turn: 0, playing: false, speed, duration,
    set(phase) { clock.phase = Math.min(Math.max(phase, 0), 1); tell(); },
    step(change) {
      const at = clock.phase + change, whole = Math.floor(at);
      clock.turn += whole; clock.phase = at - whole; tell();
    },
    play() { clock.playing = true; tell(); run(); },
    pause() { clock.playing = false; tell(); },
    toggle() { clock.playing ? clock.pause() : clock.play(); },
    setSpeed(value) { clock.speed = value; tell(); },
    subscribe(listener) { listeners.add(listener); listener(clock); return () => listeners.delete(listener); },
    /** A view tells whether it can be seen; the loop sleeps while none can. */
    see(view, visible) { visible ? awake.add(view) : awake.delete(view); run(); },
    get running() { return frame !== 0; },
  };
  function tell() { for (const listener of listeners) listener(clock); }
  function run() {
    if (frame || !clock.playing || !awake.size || document.hidden) return;
    last = 0;
    frame = requestAnimationFrame(tick);
  }
  function tick(now) {
    frame = 0;
    if (!clock.playing || !awake.size || document.hidden) return;
    frame = requestAnimationFrame(tick);
    if (last) clock.step(Math.min(now - last, 100) / 1000 * clock.speed / clock.duration);
    last = now;
  }
  document.addEventListener("visibilitychange", run);
  return clock;
}

/** Float32Array of base64 text. */
export function floats(text) {
  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  return new Float32Array(bytes.buffer);
}

/** Index of the interval of the rising array `u` that holds `value`, and the part 0..1 of the way through it. */
export function locate(u, value) {
  let low = 0, high = u.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (u[middle] <= value) low = middle; else high = middle;
  }
  const width = u[high] - u[low];
  return [low, width > 0 ? Math.min(Math.max((value - u[low]) / width, 0), 1) : 0];
}

/** The largest of 1, 2, 5 times a power of ten up to `largest`. */
export function nice(largest) {
  const power = 10 ** Math.floor(Math.log10(largest));
  return [5, 2, 1].find(step => step * power <= largest * 1.000001) * power;
}

const ROLES = ["surface", "canvas", "line", "grid", "grid-strong", "ink", "muted", "accent", "cursor", "bad", "raised",
  "steel", "blue", "orange", "green", "violet", "ground"];

/** Colours of the host by role, and a call when the theme changes (the reader's preference, or data-theme / class of the page). */
export function watchTheme(host, changed) {
  const read = () => {
    const style = getComputedStyle(host), found = {};
    for (const role of ROLES) found[role] = style.getPropertyValue(`--${role}`).trim() || "#777";
    return found;
  };
  const theme = {colours: read(), stop() { media.removeEventListener("change", check); observer.disconnect(); }};
  const check = () => {
    const now = read();
    if (ROLES.every(role => now[role] === theme.colours[role])) return;  // some frameworks rewrite the class with the same value
    theme.colours = now;
    changed();
  };
  const media = matchMedia("(prefers-color-scheme: dark)"), observer = new MutationObserver(check);
  media.addEventListener("change", check);
  for (const element of [document.documentElement, document.body])
    observer.observe(element, {attributes: true, attributeFilter: ["class", "data-theme"]});
  return theme;
}

/** Canvas as large as its box, sharp on every screen; calls `resized` after each change.  Returns {context, width, height, stop}. */
export function fitCanvas(canvas, resized) {
  const surface = {context: canvas.getContext("2d"), width: 0, height: 0, ratio: 1, stop() { observer.disconnect(); }};
  const observer = new ResizeObserver(() => {
    surface.ratio = window.devicePixelRatio || 1;
    surface.width = canvas.clientWidth; surface.height = canvas.clientHeight;
    canvas.width = Math.round(surface.width * surface.ratio); canvas.height = Math.round(surface.height * surface.ratio);
    resized();
  });
  observer.observe(canvas);
  return surface;
}

export function watchVisible(element, tell) {
  const observer = new IntersectionObserver(entries => tell(entries[entries.length - 1].isIntersecting));
  observer.observe(element);
  return () => observer.disconnect();
}

/** element("button", {class: "x", title: "y"}, "text", child ...); text is set as text, never as markup. */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) if (value !== false) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/** A number with fixed decimals and a true minus. */
export const fixed = (value, decimals) => Number.isFinite(value) ? value.toFixed(decimals).replace(/^-(?=.*[1-9])/, "−").replace(/^-/, "") : "–";

// ---------------------------------------------------------------------------------------------------------------- motion

/** Pose [x, y, angle] of a motion at frame `low` + `part`. */
function poseAt(motion, low, part) {
  if (motion.length === 3) return motion;
  const i = 3 * low;
  return [0, 1, 2].map(k => motion[i + k] + part * (motion[i + 3 + k] - motion[i + k]));
}

/** Pose of a body in the frame of an observer. */
function seenFrom(pose, eye) {
  const dx = pose[0] - eye[0], dy = pose[1] - eye[1], c = Math.cos(eye[2]), s = Math.sin(eye[2]);
  return [c * dx + s * dy, c * dy - s * dx, pose[2] - eye[2]];
}

function carry([x, y], pose) {
  const c = Math.cos(pose[2]), s = Math.sin(pose[2]);
  return [pose[0] + c * x - s * y, pose[1] + s * x + c * y];
}

/** Box [x0, y0, x1, y1] around points. */
function boxOf(points, box = [Infinity, Infinity, -Infinity, -Infinity]) {
  for (const [x, y] of points) {
    if (x < box[0]) box[0] = x;
    if (y < box[1]) box[1] = y;
    if (x > box[2]) box[2] = x;
    if (y > box[3]) box[3] = y;
  }
  return box;
}

const corners = ([x0, y0, x1, y1]) => [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];

/** The packed scene with arrays instead of text, and a drawable path and box for each shape. */
function unpack(packed) {
  const motions = packed.motions.map(floats);
  const shape = ({layer, closed, points}) => {
    const flat = floats(points), path = new Path2D(), list = [];
    for (let i = 0; i < flat.length; i += 2) {
      i ? path.lineTo(flat[i], flat[i + 1]) : path.moveTo(flat[0], flat[1]);
      list.push([flat[i], flat[i + 1]]);
    }
    if (closed) path.closePath();
    return {layer, closed, path, list, box: boxOf(list)};
  };
  const ready = thing => ({...thing, motion: motions[thing.motion], shapes: thing.shapes.map(shape)});
  return {...packed, u: floats(packed.u), bodies: packed.bodies.map(ready), observers: packed.observers.map(ready)};
}

// -------------------------------------------------------------------------------------------------------------- drawing

const FILLED = new Set(["profile", "body", "roller"]);
const LOOKS = {pitch: [1.2, [9, 3, 2, 3]], base: [1.1, [2, 3]], axis: [1, [12, 3, 2, 3]], ground: [2.2, []], defect: [3, []]};
const TRACES = ["violet", "orange", "green", "blue", "steel"];
const PAST = 4, GHOSTS = 8;

/** All drawing of one scene: `paint(context, view, observer, clock, switches)`; sizes in pixels, poses in metres. */
function createPainter(scene) {
  const paths = new Map();

  /** Points of every trace for an observer, one per frame. */
  function traces(observer) {
    if (!paths.has(observer)) paths.set(observer, scene.traces.map(trace => {
      const motion = scene.bodies[trace.body].motion;
      return Array.from({length: scene.frames}, (_, i) =>
        carry(trace.point, seenFrom(poseAt(motion, Math.min(i, scene.frames - 2), i === scene.frames - 1 ? 1 : 0),
          poseAt(observer.motion, Math.min(i, scene.frames - 2), i === scene.frames - 1 ? 1 : 0))));
    }));
    return paths.get(observer);
  }

  /** How far the traces of the cycle before lie from this one's, for an observer that travels on. */
  function stepBack(observer) {
    const [x, y] = observer.advance, angle = observer.motion[2], c = Math.cos(angle), s = Math.sin(angle);
    return [c * x + s * y, c * y - s * x];
  }

  /** Box around everything that is seen over the cycle; an advancing observer's camera goes along, so its drift is taken off. */
  function extent(observer) {
    const back = stepBack(observer), moving = back[0] || back[1], box = boxOf([]);
    for (let n = 0; n < 60; n++) {
      const phase = n / 60, [low, part] = locate(scene.u, phase), eye = poseAt(observer.motion, low, part);
      for (const body of scene.bodies) {
        const pose = seenFrom(poseAt(body.motion, low, part), eye);
        pose[0] += phase * back[0]; pose[1] += phase * back[1];
        for (const shape of body.shapes) boxOf(corners(shape.box).map(p => carry(p, pose)), box);
      }
    }
    if (!moving) for (const points of traces(observer)) boxOf(points, box);
    const near = 0.25 * Math.max(box[2] - box[0], box[3] - box[1]), [x0, y0, x1, y1] = [box[0] - near, box[1] - near, box[2] + near, box[3] + near];
    for (const shape of observer.shapes)  // a soil line is longer than what is worth seeing
      boxOf(corners(shape.box).map(([x, y]) => [Math.min(Math.max(x, x0), x1), Math.min(Math.max(y, y0), y1)]), box);
    if (moving) boxOf([[box[0] + 0.8 * Math.min(back[0], 0), box[1] + 0.8 * Math.min(back[1], 0)],
      [box[2] + 0.8 * Math.max(back[0], 0), box[3] + 0.8 * Math.max(back[1], 0)]], box);
    return Number.isFinite(box[0]) ? box : [-1, -1, 1, 1];
  }

  function grid(context, view, origin, colours) {
    const step = nice(190 / view.scale), fine = nice(step / 4);
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

  function shape(context, view, one, pose, colour, colours, {alpha = 1, edgeOnly = false, strong = false, hatched = true} = {}) {
    const filled = FILLED.has(one.layer);
    if (edgeOnly && !filled) return;
    view.place(context, pose);
    const [width, dashes] = LOOKS[one.layer] || [1.8, []];
    const px = 1 / view.scale;
    context.globalAlpha = alpha;
    if (filled && one.closed && !edgeOnly) { context.globalAlpha = alpha * (strong ? 0.5 : 0.24); context.fillStyle = colour; context.fill(one.path); }
    if (one.layer === "hole") { context.fillStyle = colours.canvas; context.fill(one.path); }
    context.globalAlpha = alpha;
    context.strokeStyle = {hole: colours.ink, axis: colours.muted, defect: colours.bad}[one.layer] || colour;
    context.lineWidth = (edgeOnly ? 1 : strong ? 3.2 : width) * px;
    context.setLineDash(dashes.map(d => d * px));
    context.lineJoin = "round";
    context.stroke(one.path);
    context.setLineDash([]);
    if (one.layer === "ground" && !one.closed && hatched) hatch(context, one.list, px);
    context.globalAlpha = 1;
  }

  /** Strokes on the right of a line of ground as it runs (below, from left to right): the mark of what does not move. */
  function hatch(context, list, px) {
    context.beginPath();
    for (let i = 1; i < list.length; i++) {
      const [[ax, ay], [bx, by]] = [list[i - 1], list[i]], length = Math.hypot(bx - ax, by - ay) || 1, tx = (bx - ax) / length, ty = (by - ay) / length;
      for (let at = 5 * px; at < length; at += 7 * px) {
        const x = ax + at * tx, y = ay + at * ty;
        context.moveTo(x, y); context.lineTo(x + 6 * px * (ty - tx), y - 6 * px * (tx + ty));
      }
    }
    context.lineWidth = px;
    context.stroke();
  }

  function bodies(context, view, observer, phase, colours, switches, look = {}) {
    const [low, part] = locate(scene.u, phase), eye = poseAt(observer.motion, low, part);
    for (const body of scene.bodies) {
      if (switches.hidden.has(body.label)) continue;
      const pose = seenFrom(poseAt(body.motion, low, part), eye), lit = switches.lit.has(body.name);
      const dim = switches.lit.size && !lit ? 0.35 : 1;
      for (const one of body.shapes)
        shape(context, view, one, pose, colours[body.colour] || colours.steel, colours, {strong: lit, ...look, alpha: (look.alpha ?? 1) * dim});
    }
  }

  function line(context, view, points, shift, from, to) {
    context.beginPath();
    for (let i = from; i <= to; i++) context.lineTo(view.toX(points[i][0] + shift[0]), view.toY(points[i][1] + shift[1]));
    context.stroke();
  }

  /** The whole path dashed, what has been run through drawn full, earlier cycles faint, a dot at the point itself. */
  function tracks(context, view, observer, phase, turn, colours) {
    const back = stepBack(observer), moving = back[0] || back[1], [low, part] = locate(scene.u, phase), last = scene.frames - 1;
    context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    traces(observer).forEach((points, n) => {
      const colour = colours[TRACES[n % TRACES.length]];
      context.strokeStyle = context.fillStyle = colour;
      context.lineWidth = 1.5; context.globalAlpha = 0.45;
      for (let k = 1; moving && k <= PAST; k++) line(context, view, points, [k * back[0], k * back[1]], 0, last);
      context.globalAlpha = 1; context.setLineDash([6, 4]);
      line(context, view, points, [0, 0], moving ? low : 0, last);
      context.setLineDash([]);
      if (moving) line(context, view, points, [0, 0], 0, low);
      const a = points[low], b = points[Math.min(low + 1, last)];
      context.beginPath();
      context.arc(view.toX(a[0] + part * (b[0] - a[0])), view.toY(a[1] + part * (b[1] - a[1])), 4, 0, 7);
      context.fill();
    });
  }

  function paint(context, view, observer, {phase, turn}, colours, switches) {
    const back = stepBack(observer), moving = back[0] || back[1];
    context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    context.fillStyle = colours.canvas;
    context.fillRect(0, 0, view.width, view.height);
    view.follow = [-phase * back[0], -phase * back[1]];
    grid(context, view, [turn * back[0], turn * back[1]], colours);
    for (let k = moving ? -2 : 0; k <= (moving ? PAST : 0); k++)
      for (const one of observer.shapes) shape(context, view, one, [k * back[0], k * back[1], 0], colours.ground, colours, {hatched: !moving});
    if (switches.ghosts) for (let n = 0; n < GHOSTS; n++)
      bodies(context, view, observer, n / GHOSTS, colours, switches, {edgeOnly: true, alpha: 0.28});
    tracks(context, view, observer, phase, turn, colours);
    bodies(context, view, observer, phase, colours, switches);
    scaleBar(context, view, colours);
  }

  function scaleBar(context, view, colours) {
    const length = nice(170 / view.scale), x = 16.5, y = view.height - 16.5, end = x + length * view.scale;
    context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    context.strokeStyle = colours.muted; context.lineWidth = 1.5;
    context.beginPath(); context.moveTo(x, y - 4); context.lineTo(x, y); context.lineTo(end, y); context.lineTo(end, y - 4); context.stroke();
    context.fillStyle = colours.muted; context.font = "11px system-ui, sans-serif";
    context.fillText(lengthText(length), x + 5, y - 6);
  }

  return {paint, extent};
}

/** 0.05 -> "50 mm", 2 -> "2 m", 2e-5 -> "20 µm". */
function lengthText(length) {
  const [factor, unit] = length > 0.999 ? [1, "m"] : length > 0.000999 ? [1e3, "mm"] : [1e6, "µm"];
  return `${+(length * factor).toPrecision(3)} ${unit}`;
}

// ------------------------------------------------------------------------------------------------------------- the view

/** Window onto the plane: `scale` px per metre about `centre`; `follow` moves along with an advancing observer. */
function createView() {
  return {
    scale: 1000, centre: [0, 0], follow: [0, 0], width: 1, height: 1, ratio: 1,
    middle() { return [this.centre[0] + this.follow[0], this.centre[1] + this.follow[1]]; },
    toX(x) { return this.width / 2 + (x - this.centre[0] - this.follow[0]) * this.scale; },
    toY(y) { return this.height / 2 - (y - this.centre[1] - this.follow[1]) * this.scale; },
    window() {
      const [x, y] = this.middle(), w = this.width / 2 / this.scale, h = this.height / 2 / this.scale;
      return [x - w, y - h, x + w, y + h];
    },
    place(context, [x, y, angle]) {
      const k = this.scale * this.ratio, c = Math.cos(angle) * k, s = Math.sin(angle) * k;
      context.setTransform(c, -s, -s, -c, this.toX(x) * this.ratio, this.toY(y) * this.ratio);
    },
    fit([x0, y0, x1, y1], margins) {
      const {top, right, bottom, left} = margins, w = this.width - left - right, h = this.height - top - bottom;
      this.scale = Math.max(Math.min(w / Math.max(x1 - x0, 1e-9), h / Math.max(y1 - y0, 1e-9)), 1e-6);
      this.centre = [(x0 + x1) / 2 + (right - left) / 2 / this.scale, (y0 + y1) / 2 + (top - bottom) / 2 / this.scale];
    },
    zoom(factor, px, py) {
      const x = (px - this.width / 2) / this.scale, y = (this.height / 2 - py) / this.scale;
      this.scale *= factor;
      this.centre = [this.centre[0] + x * (1 - 1 / factor), this.centre[1] + y * (1 - 1 / factor)];
    },
    pan(dx, dy) { this.centre = [this.centre[0] - dx / this.scale, this.centre[1] + dy / this.scale]; },
  };
}

/** Mouse, wheel and touch on the canvas.  The wheel zooms once the canvas has the focus (or with Ctrl), so that a page still scrolls. */
function steer(canvas, view, redraw, moved) {
  const fingers = new Map();
  const at = event => { const box = canvas.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
  const spread = () => { const [a, b] = [...fingers.values()]; return [Math.hypot(a[0] - b[0], a[1] - b[1]), (a[0] + b[0]) / 2, (a[1] + b[1]) / 2]; };
  canvas.addEventListener("pointerdown", event => {
    canvas.focus({preventScroll: true});
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, at(event));
  });
  canvas.addEventListener("pointermove", event => {
    if (!fingers.has(event.pointerId)) return;
    const before = fingers.size === 2 ? spread() : null, old = fingers.get(event.pointerId), now = at(event);
    fingers.set(event.pointerId, now);
    if (before) {
      const after = spread();
      view.zoom(after[0] / Math.max(before[0], 1), after[1], after[2]);
      view.pan(after[1] - before[1], after[2] - before[2]);
    } else view.pan(now[0] - old[0], now[1] - old[1]);
    moved(); redraw();
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, event => fingers.delete(event.pointerId));
  canvas.addEventListener("wheel", event => {
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    view.zoom(Math.exp(-Math.max(-200, Math.min(200, event.deltaY)) * 0.0016), ...at(event));
    moved(); redraw();
  }, {passive: false});
}

// ------------------------------------------------------------------------------------------------------------- controls

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];
const TEXT = {play: "Play (space)", pause: "Pause (space)", ghosts: "Ghost poses (g)", fit: "Fit (f)", speed: "Speed", real: "real time",
  scrub: "Position in the cycle", canvas: "Moving mechanism: space plays, arrow keys step, drag moves, wheel zooms", frame: "Seen from"};
const ICONS = {play: "M7 4.5v15l12-7.5z", pause: "M6 5h4v14H6zM14 5h4v14h-4z",
  fit: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5", ghosts: "M5 20V10a7 7 0 0 1 14 0v10l-3-2.5-2 2.5-2-2.5-2 2.5-2-2.5z"};

function icon(name) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg"), path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  svg.setAttribute("viewBox", "0 0 24 24"); svg.setAttribute("aria-hidden", "true");
  svg.classList.add(name === "fit" || name === "ghosts" ? "dw-stroke" : "dw-solid");
  path.setAttribute("d", ICONS[name]); svg.append(path);
  return svg;
}

function button(text, act, name) {
  const made = element("button", {type: "button", title: text, "aria-label": text, class: "dw-button"}, icon(name));
  made.addEventListener("click", act);
  return made;
}

/** Row of choices, one pressed: [[key, label], ...] -> {node, choose(key)}. */
function segments(title, choices, picked) {
  const node = element("div", {class: "dw-segments", role: "group", "aria-label": title});
  const buttons = choices.map(([key, label]) => {
    const made = element("button", {type: "button", "data-key": key, "aria-pressed": "false"}, label);
    made.addEventListener("click", () => picked(key));
    node.append(made);
    return made;
  });
  return {node, choose(key) { for (const b of buttons) b.setAttribute("aria-pressed", String(b.dataset.key === String(key))); }};
}

/** Slider over the cycle with a tick for every mark. */
function scrubber(clock, cycle, text) {
  const input = element("input", {type: "range", min: 0, max: 1, step: 0.0001, value: 0, "aria-label": text.scrub, class: "dw-range"});
  const node = element("div", {class: "dw-scrub"}, input);
  for (const [u, label] of cycle.marks) {
    const tick = element("button", {type: "button", class: "dw-mark", title: label, "aria-label": label, style: `--u:${u}`, tabindex: -1});
    tick.addEventListener("click", () => clock.set(u));
    node.append(tick);
  }
  input.addEventListener("input", () => {
    const wanted = +input.value;  // pausing shows the old phase in the slider
    clock.pause();
    clock.set(wanted);
  });
  return {node, show(phase) { input.value = phase; input.style.setProperty("--part", phase); }};
}

function speedBox(clock, period, text) {
  const select = element("select", {class: "dw-speed", "aria-label": text.speed, title: text.speed});
  for (const speed of SPEEDS) select.append(element("option", {value: speed}, `${speed}×`));
  if (period) select.append(element("option", {value: clock.duration / period}, text.real));
  select.value = String(clock.speed);
  select.addEventListener("change", () => clock.setSpeed(+select.value));
  return select;
}

/** How much slower or faster than the machine itself: "1 : 13 of real time". */
function pace(clock, period) {
  if (!period) return "";
  const factor = period * clock.speed / clock.duration, ratio = factor < 1 ? 1 / factor : factor, shown = ratio < 10 ? +ratio.toFixed(1) : Math.round(ratio);
  return shown === 1 ? "real time" : factor < 1 ? `${shown}× slower than real` : `${shown}× faster than real`;
}

/** The last mark and how far behind it the cycle is: "lowest + 12.5°". */
function sinceMark({marks, span, unit}, phase, digits) {
  if (!marks.length) return "";
  const [u, label] = marks.filter(([at]) => at <= phase + 1e-9).pop() || marks[marks.length - 1], gone = Math.abs((phase - u + 1 + 1e-9) % 1 * span);
  return `${label} + ${fixed(gone, digits)}${unit.startsWith("°") ? unit : ` ${unit}`}`;
}

// ----------------------------------------------------------------------------------------------------------- the player

/**
 * A player inside `host`.  Options: clock (shared with plots), autoplay, duration [s per cycle at speed 1], text (labels in another language).
 * Returns {clock, view, frame, load(scene), fit(), redraw(), setFrame(name), setGhosts(on), highlight(names), destroy()}.
 */
export function createPlayer(host, packed, options = {}) {
  const clock = options.clock || createClock({duration: options.duration || 4}), text = {...TEXT, ...options.text};
  const canvas = element("canvas", {class: "dw-canvas", tabindex: 0, role: "img", "aria-label": text.canvas});
  const legend = element("div", {class: "dw-legend"}), top = element("div", {class: "dw-top"}), bar = element("div", {class: "dw-bar"});
  const stage = element("div", {class: "dw-stage"}, canvas, top);
  const view = createView(), switches = {ghosts: false, hidden: new Set(), lit: new Set()};
  const state = {scene: null, painter: null, observer: null, fitted: true, dirty: false, controls: null};
  host.classList.add("dw-player");
  host.replaceChildren(stage, bar);

  const surface = fitCanvas(canvas, () => {
    Object.assign(view, {width: surface.width, height: surface.height, ratio: surface.ratio});
    if (state.fitted) fit(); else draw();
  });
  const theme = watchTheme(host, () => redraw());
  const unwatch = watchVisible(canvas, visible => clock.see(player, visible));
  steer(canvas, view, () => redraw(), () => { state.fitted = false; });

  function draw() {
    state.dirty = false;
    if (!state.scene || view.width < 2) return;
    state.painter.paint(surface.context, view, state.observer, clock, theme.colours, switches);
    host.dataset.phase = clock.phase.toFixed(4);
  }
  function redraw() {
    if (state.dirty) return;
    state.dirty = true;
    requestAnimationFrame(draw);
  }
  function fit() {
    state.fitted = true;
    if (!state.scene || view.width < 2) return;
    const across = Math.min(34, view.width / 8);
    view.fit(state.painter.extent(state.observer), {top: 26 + top.offsetHeight, right: across, bottom: 44, left: across});
    redraw();
  }
  function setFrame(name) {
    state.observer = state.scene.observers.find(o => o.name === name) || state.scene.observers[0];
    state.controls.frames.choose(state.observer.name);
    host.dataset.frame = state.observer.name;
    fit();
  }
  function setGhosts(on) { switches.ghosts = on; state.controls.ghosts.setAttribute("aria-pressed", String(on)); redraw(); }

  function load(next) {
    state.scene = unpack(next);
    state.painter = createPainter(state.scene);
    const name = state.observer && state.observer.name;
    state.controls = build();
    setFrame(name);
    show();
  }

  function build() {
    const scene = state.scene;
    const play = button(text.play, () => clock.toggle(), "play"), ghosts = button(text.ghosts, () => setGhosts(!switches.ghosts), "ghosts");
    const scrub = scrubber(clock, scene.cycle, text), speed = speedBox(clock, scene.period, text);
    const frames = segments(text.frame, scene.observers.map(o => [o.name, o.label]), setFrame);
    const value = element("span", {class: "dw-value"}), phase = element("span", {class: "dw-phase"}), rate = element("span", {class: "dw-rate"});
    legend.replaceChildren(...names());
    top.replaceChildren(legend, ...(scene.observers.length > 1 ? [frames.node] : []));
    bar.replaceChildren(play, scrub.node, element("div", {class: "dw-readout"}, value, phase), element("div", {class: "dw-pace"}, speed, rate),
      ghosts, button(text.fit, fit, "fit"));
    return {play, ghosts, scrub, frames, value, phase, rate};
  }

  /** A switch for every label among the bodies, in the body's colour. */
  function names() {
    const seen = new Map(state.scene.bodies.map(body => [body.label, body.colour]));
    return [...seen].map(([label, colour]) => {
      const chip = element("button", {type: "button", class: "dw-chip", "aria-pressed": "true", style: `--chip: var(--${colour}, var(--steel))`}, label);
      chip.addEventListener("click", () => {
        const gone = switches.hidden.delete(label) ? false : (switches.hidden.add(label), true);
        chip.setAttribute("aria-pressed", String(!gone));
        redraw();
      });
      return chip;
    });
  }

  function show() {
    if (!state.scene) return;
    const {cycle, period} = state.scene, {play, scrub, value, phase, rate} = state.controls;
    if (play.dataset.on !== String(clock.playing)) {
      play.dataset.on = String(clock.playing);
      play.replaceChildren(icon(clock.playing ? "pause" : "play"));
      play.title = clock.playing ? text.pause : text.play;
      play.setAttribute("aria-label", play.title);
    }
    scrub.show(clock.phase);
    const at = cycle.start + clock.phase * cycle.span, digits = Math.abs(cycle.span) >= 50 ? 1 : Math.max(0, 3 - Math.floor(Math.log10(Math.abs(cycle.span) || 1)));
    value.textContent = fixed(at, digits) + (cycle.unit.startsWith("°") ? cycle.unit : " " + cycle.unit);
    value.title = cycle.label;
    phase.textContent = sinceMark(cycle, clock.phase, digits);
    rate.textContent = pace(clock, period);
    redraw();
  }

  function keys(event) {
    if (["INPUT", "SELECT", "TEXTAREA"].includes(event.target.tagName) && event.key !== " ") return;
    const frame = 1 / Math.max(1, state.scene.frames - 1);
    const acts = {" ": () => clock.toggle(), ArrowRight: () => clock.step(event.shiftKey ? 10 * frame : frame), f: fit, g: () => setGhosts(!switches.ghosts),
      ArrowLeft: () => clock.step(event.shiftKey ? -10 * frame : -frame), Home: () => clock.set(0), "+": () => zoom(1.25), "-": () => zoom(0.8)};
    if (!acts[event.key] || event.ctrlKey || event.metaKey || (event.key === " " && event.target.tagName === "BUTTON")) return;
    event.preventDefault();
    if (event.key.startsWith("Arrow")) clock.pause();
    acts[event.key]();
  }
  function zoom(factor) { state.fitted = false; view.zoom(factor, view.width / 2, view.height / 2); redraw(); }

  host.addEventListener("keydown", keys);
  canvas.addEventListener("dblclick", fit);
  const player = {
    clock, view, load, fit, redraw, setFrame, setGhosts,
    highlight(list) { switches.lit = new Set(list); redraw(); },
    get frame() { return state.observer.name; },
    destroy() { unsubscribe(); unwatch(); theme.stop(); surface.stop(); clock.see(player, false); host.removeEventListener("keydown", keys); host.replaceChildren(); },
  };
  load(packed);
  const unsubscribe = clock.subscribe(show);
  if (options.autoplay && !matchMedia("(prefers-reduced-motion: reduce)").matches) clock.play();
  return player;
}
