// As much of a browser's page as the studio's modules use, for tests that run them without one.

class Style {
  setProperty(name, value) { this[name] = value; }
  removeProperty(name) { delete this[name]; }
}

class Classes extends Set {
  contains(name) { return this.has(name); }
  remove(...names) { names.forEach(name => this.delete(name)); }
  toggle(name, on = !this.has(name)) { on ? this.add(name) : this.delete(name); return on; }
}

export class Part {
  constructor(tag) {
    Object.assign(this, {tagName: tag.toUpperCase(), children: [], attributes: {}, dataset: {}, style: new Style(), classList: new Classes(), listeners: {},
      parentElement: null, hidden: false, value: "", clientWidth: 600, clientHeight: 400, offsetWidth: 50, offsetHeight: 20, box: {left: 0, top: 0, width: 600, height: 400}});
  }
  setAttribute(name, value) {
    this.attributes[name] = String(value);
    if (name === "class") String(value).split(" ").forEach(each => this.classList.add(each));
    if (name.startsWith("data-")) this.dataset[name.slice(5)] = String(value);
    if (name === "hidden") this.hidden = true;
    if (name === "value") this.value = String(value);
  }
  getAttribute(name) { return this.attributes[name] ?? null; }
  append(...parts) { for (const part of parts) { this.children.push(part); if (part instanceof Part) part.parentElement = this; } }
  replaceWith(other) { this.parentElement?.swap(this, other); }
  swap(old, made) { this.children = this.children.map(each => each === old ? made : each); made.parentElement = this; old.parentElement = null; }
  replaceChildren(...parts) { this.children = []; this.append(...parts); }
  remove() { if (this.parentElement) this.parentElement.children = this.parentElement.children.filter(each => each !== this); }
  contains(other) { return this === other || this.children.some(each => each instanceof Part && each.contains(other)); }
  get textContent() { return this.children.map(each => each instanceof Part ? each.textContent : each).join(""); }
  set textContent(text) { this.children = [text]; }
  get firstChild() {
    const {children} = this;
    return typeof children[0] === "string" ? {get data() { return children[0]; }, set data(text) { children[0] = text; }} : children[0] || null;
  }
  addEventListener(name, act) { (this.listeners[name] ||= new Set()).add(act); }
  removeEventListener(name, act) { this.listeners[name]?.delete(act); }
  /** Tells an event to this part and those around it. */
  fire(name, more = {}) {
    let going = true;
    const event = {type: name, target: this, button: 0, preventDefault() {}, stopPropagation() { going = false; }, ...more};
    for (let at = this; at && going; at = at.parentElement) for (const act of [...at.listeners[name] || []]) act(event);
  }
  getBoundingClientRect() { return this.box; }
  setPointerCapture(id) { this.captured = id; }
  hasPointerCapture(id) { return this.captured === id; }
  closest(tag) { for (let at = this; at; at = at.parentElement) if (at.tagName === tag.toUpperCase()) return at; return null; }
  getContext() { return this.context ||= drawnOn(); }
  get options() { return this.querySelectorAll("option"); }
  get isConnected() { return this.parentElement !== null; }
  get parentNode() { return this.parentElement; }
  focus() { document.activeElement = this; }
  select() {}
  /** All parts inside that a test id begins. */
  named(start) { return this.all().filter(({dataset}) => (dataset.testid || "").startsWith(start)); }
  all() { return this.children.filter(each => each instanceof Part).flatMap(each => [each, ...each.all()]); }
  querySelectorAll(tag) { return this.all().filter(({tagName}) => tagName === tag.toUpperCase()); }
}

/** A canvas's context that notes what is called, [[name, ...arguments]], and the colour of a stroke. */
function drawnOn() {
  const calls = [], own = {calls, measureText: text => ({width: 6 * text.length})};
  return new Proxy(own, {get: (_, name) => own[name] ?? ((...given) => { calls.push(name === "stroke" ? [name, own.strokeStyle] : [name, ...given]); }), set: (_, name, value) => { own[name] = value; return true; }});
}

class Watcher { constructor(act) { this.act = act; watchers.push(this); } observe() {} disconnect() {} }
const watchers = [];

/** A canvas has its size. */
export function resized() { watchers.forEach(each => { if (each instanceof Sizes) each.act(); }); }
class Sizes extends Watcher {}

let frames = [];
Object.assign(globalThis, {
  document: {createElement: tag => new Part(tag), createElementNS: (_, tag) => new Part(tag), addEventListener() {}, removeEventListener() {}, activeElement: null, styleSheets: []},
  window: globalThis, devicePixelRatio: 1, ResizeObserver: Sizes, MutationObserver: Watcher,
  getComputedStyle: () => ({getPropertyValue: name => name}), matchMedia: () => ({matches: false, addEventListener() {}, removeEventListener() {}}),
  requestAnimationFrame: act => frames.push(act),
  cancelAnimationFrame: number => { if (number) frames[number - 1] = () => {}; },
  addEventListener() {}, removeEventListener() {}, innerHeight: 900,
});

/** What waits for the next frame. */
export function nextFrame() { const now = frames; frames = []; now.forEach(act => act()); }

/** Words as they are in English. */
export const t = (text, ...parts) => parts.reduce((all, part) => all.replace("*", part), text);
