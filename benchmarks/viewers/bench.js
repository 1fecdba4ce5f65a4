// Both renderers over the same parts, the same cycle and the same window: how long a frame takes, and how far their pixels differ.

import { matrixAt, reachOf, unpackMotion, unpackParts } from "/studio/assembly.js";

const COLOURS = {canvas: "#ffffff", "grid-strong": "#c3ccd6", ink: "#1d2733", steel: "#6b7785", blue: "#2563b8", orange: "#c2660a", green: "#2f7d46", violet: "#7747a8", ground: "#555555"};
const TURN = 0.62, TILT = 0.5;  // the oblique view
const MODULES = {own: "/studio/triangles.js", quick: "/studio/triangles.js", three: "/bench/three_renderer.js", same: "/bench/three_renderer.js"};

/** {parts, moving, whole} of an answer of the job "solid". */
export function unpack(answer) {
  const moving = unpackMotion(answer), parts = unpackParts(answer);
  const {low, high, size} = answer, whole = {low, high, size, centre: low.map((end, k) => (end + high[k]) / 2)};
  return {parts, moving, whole: reachOf(parts, moving, whole)};
}

/** Matrices {matrix, turn} of the oblique view on the whole. */
function placing({centre, size}, width, height) {
  const c = Math.cos(TURN), s = Math.sin(TURN), ct = Math.cos(TILT), st = Math.sin(TILT), axes = [[c, 0, -s], [-s * st, ct, -c * st], [s * ct, st, c * ct]];
  const px = 1.2 * Math.min(width, height) / size, scales = [2 * px / width, 2 * px / height, -1 / (0.6 * size)];
  const matrix = [0, 1, 2].flatMap(k => [...axes.map((row, n) => scales[n] * row[k]), 0]);
  matrix.push(...axes.map((row, n) => -scales[n] * row.reduce((sum, a, k) => sum + a * centre[k], 0)), 1);
  return {matrix: new Float32Array(matrix), turn: new Float32Array([0, 1, 2].flatMap(k => axes.map(row => row[k])))};
}

function canvasOf(width, height) {
  const canvas = document.createElement("canvas");
  Object.assign(canvas, {width, height});
  canvas.style.cssText = `display: block; width: ${width}px; height: ${height}px`;
  document.body.append(canvas);
  return canvas;
}

/** A renderer on a canvas of its own: {draw(phase), wait(), pixels()}; `wait` returns when everything is rasterised. */
export async function opened(kind, assembly, width, height, cut = null) {
  const {createRenderer} = await import(MODULES[kind]), canvas = canvasOf(width, height);
  const renderer = createRenderer(canvas, ...(kind === "same" ? [await import("/studio/shaders.js")] : []));
  const gl = canvas.getContext("webgl2") || canvas.getContext("webgl"), view = placing(assembly.whole, width, height), one = new Uint8Array(4);
  const look = {hidden: new Set(), faint: () => false, cut, smooth: kind !== "quick"};
  renderer.load(assembly.parts);
  return {
    gl, renderer,
    draw(phase) {
      renderer.move(assembly.parts.map(part => matrixAt(assembly.moving, part, phase)));
      renderer.paint(view, COLOURS, look);
    },
    wait() { gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, one); },
    pixels() { const all = new Uint8Array(4 * width * height); gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, all); return all; },
    close() { renderer.close(); canvas.remove(); },
  };
}

/** [ms in JavaScript, ms until it is rasterised] of each of `count` frames over the cycle. */
export function timed(shown, count) {
  const found = [];
  for (let n = 0; n < count; n++) {
    const began = performance.now();
    shown.draw(n / count);
    const issued = performance.now();
    shown.wait();
    found.push([issued - began, performance.now() - began]);
  }
  return found;
}

/** Gaps [ms] between frames while the page plays for `seconds`, drawn as a page does it: one drawing a frame, nothing waited for. */
export async function played(shown, seconds) {
  const gaps = [], next = () => new Promise(requestAnimationFrame);
  for (let n = 0; n < 10; n++) { shown.draw(0); await next(); }
  let last = await next(), first = last;
  while (last - first < 1000 * seconds) {
    shown.draw((last - first) / 4000 % 1);
    const now = await next();
    gaps.push(now - last);
    last = now;
  }
  return gaps;
}

/** Parts of the pixels over `count` phases that differ: {any: by more than 2 of 255, outline: background in one picture alone}. */
export function difference(a, b, count) {
  let any = 0, outline = 0, all = 0;
  const bare = (p, i) => p[i] > 250 && p[i + 1] > 250 && p[i + 2] > 250;
  for (let n = 0; n < count; n++) {
    a.draw(n / count); const p = a.pixels();
    b.draw(n / count); const q = b.pixels();
    for (let i = 0; i < p.length; i += 4) {
      all++;
      if (Math.max(Math.abs(p[i] - q[i]), Math.abs(p[i + 1] - q[i + 1]), Math.abs(p[i + 2] - q[i + 2])) > 2) any++;
      if (bare(p, i) !== bare(q, i)) outline++;
    }
  }
  return {any: any / all, outline: outline / all};
}
