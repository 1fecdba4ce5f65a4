// What every part of a page uses: the clock, arrays out of text, the page's colours, a canvas as large as its box, elements, numbers as text.

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

/** The bytes of base64 text. */
export function bytesOf(text) {
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  return bytes.buffer;
}

/** Float32Array of base64 text. */
export const floats = text => new Float32Array(bytesOf(text));

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

const ROLES = ["surface", "canvas", "line", "grid", "grid-strong", "ink", "muted", "accent", "cursor", "bad", "warn", "raised",
  "steel", "blue", "orange", "green", "violet", "ground", "run-1", "run-2", "run-3", "run-4"];

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
    fonts.delete(surface.context);  // a canvas of another size has forgotten everything
    resized();
  });
  observer.observe(canvas);
  return surface;
}

// What differs is set, what is the same is left alone: the browser styles and lays out anew whatever is touched.

/** The text of a node that has nothing else in it. */
export function put(node, text) {
  const own = node.firstChild;
  if (own?.data === undefined || own.nextSibling) node.textContent = text;
  else if (own.data !== text) own.data = text;
}

/** An attribute of a node. */
export function putAttribute(node, name, value) { if (node.getAttribute(name) !== String(value)) node.setAttribute(name, value); }

/** A class of a node, there or not. */
export function putClass(node, name, on) { if (node.classList.contains(name) !== on) node.classList.toggle(name, on); }

const fonts = new WeakMap();  // of each context, as it was last given

/** The font of a context.  Giving it one has the whole page laid out, even where it is the same. */
export function useFont(context, font) {
  if (fonts.get(context) === font) return;
  context.font = font;
  fonts.set(context, font);
}

export function watchVisible(element, tell) {
  const observer = new IntersectionObserver(entries => tell(entries[entries.length - 1].isIntersecting));
  observer.observe(element);
  return () => observer.disconnect();
}

/** element("button", {class: "x", title: "y"}, "text", child ...); text is set as text, never as markup. */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "style") made.style.cssText = value;  // the attribute itself is what a content security policy refuses
    else if (value !== false) made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

/** A number with fixed decimals and a true minus. */
export const fixed = (value, decimals) => Number.isFinite(value) ? value.toFixed(decimals).replace(/^-(?=.*[1-9])/, "−").replace(/^-/, "") : "–";

/** A button with what is in it; `act(button)` when it is pressed. */
export function pressable(attributes, act, ...inside) {
  const made = element("button", {type: "button", ...attributes}, ...inside);
  made.addEventListener("click", () => act(made));
  return made;
}

/** Whether two lists have the same entries. */
export const same = (a, b) => a === b || (a && b && a.length === b.length && a.every((x, n) => x === b[n]));
