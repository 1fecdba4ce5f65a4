// Triangles with normals and feature edges on a WebGL canvas.

import { EDGE, FACE, FIELD } from "./shaders.js";

export const AT_START = new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);  // a part where it was at the start
const UNCUT = [0, 0, 0, 1];  // a plane beyond which nothing lies

/** Red, green, blue of "#abc" or "#aabbcc", each 0..1. */
function rgb(hex) {
  const digits = hex.slice(1), n = parseInt(digits.length === 3 ? digits.replace(/./g, "$&$&") : digits, 16);
  return [n >> 16 & 255, n >> 8 & 255, n & 255].map(c => c / 255);
}

/** A program {made, at(name) of an attribute, set(name) of a uniform}; both are looked up once. */
function program(gl, {vertex, fragment}) {
  const made = gl.createProgram(), attributes = new Map(), uniforms = new Map();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text); gl.compileShader(shader); gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  const once = (known, name, find) => known.has(name) ? known.get(name) : known.set(name, find()).get(name);
  return {made, at: name => once(attributes, name, () => gl.getAttribLocation(made, name)), set: name => once(uniforms, name, () => gl.getUniformLocation(made, name))};
}

function buffer(gl, values, kind = gl.ARRAY_BUFFER) {
  const made = gl.createBuffer();
  gl.bindBuffer(kind, made); gl.bufferData(kind, values, gl.STATIC_DRAW);
  return made;
}

/** A texture of colours "#rrggbb" in a row, evenly blended. */
function ramp(gl, stops) {
  const made = gl.createTexture(), wide = 256, bytes = new Uint8Array(4 * wide), known = stops.map(rgb);
  for (let i = 0; i < wide; i++) {
    const at = i / (wide - 1) * (known.length - 1), low = Math.min(Math.floor(at), known.length - 2), part = at - low;
    for (let k = 0; k < 3; k++) bytes[4 * i + k] = Math.round(255 * (known[low][k] * (1 - part) + known[low + 1][k] * part));
    bytes[4 * i + 3] = 255;
  }
  gl.bindTexture(gl.TEXTURE_2D, made);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, wide, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE],
    [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]]) gl.texParameteri(gl.TEXTURE_2D, name, value);
  return made;
}

/** A target with several samples a pixel, as large as the canvas and of its format, or nothing can go over: {begin(), end()}, between which what is drawn goes to it. */
function smoothed(gl) {
  const target = gl.createFramebuffer(), samples = Math.min(4, gl.getParameter(gl.MAX_SAMPLES)), size = [0, 0];
  const stores = [[gl.COLOR_ATTACHMENT0, gl.RGBA8], [gl.DEPTH_ATTACHMENT, gl.DEPTH_COMPONENT24]].map(([place, format]) => [place, format, gl.createRenderbuffer()]);
  return {
    begin() {
      const {drawingBufferWidth: width, drawingBufferHeight: height} = gl;
      gl.bindFramebuffer(gl.FRAMEBUFFER, target);
      if (size[0] === width && size[1] === height) return;
      size.splice(0, 2, width, height);
      for (const [place, format, store] of stores) {
        gl.bindRenderbuffer(gl.RENDERBUFFER, store);
        gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples, format, width, height);
        gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, store);
      }
    },
    end() {
      const box = [0, 0, ...size];
      gl.bindFramebuffer(gl.READ_FRAMEBUFFER, target); gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
      gl.blitFramebuffer(...box, ...box, gl.COLOR_BUFFER_BIT, gl.NEAREST);
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    },
  };
}

/**
 * Drawing on one WebGL context, null where there is none: `load(parts)`, `paint({matrix, turn}, colours, {hidden, faint, cut, smooth})`, where
 * `hidden` is a set of names, `faint(part)` tells which are seen through, `cut` is a plane [normal, distance] or null and `smooth` asks for
 * several samples a pixel; `ready()` after the context was lost.  A part is closed, its triangles counter-clockwise from outside: {points, normals, corners, edges} with numbers of points in the
 * last two, or {points, normals, edges, levels} with three points a triangle and two an edge.  Those with `levels` (one a point, 0 ... 1,
 * below 0 for none) are drawn in the colours of `setRamp(stops, bare)`.
 */
export function createRenderer(canvas) {
  const gl = canvas.getContext("webgl2", {antialias: false, preserveDrawingBuffer: false});
  if (!gl) return null;
  let face, field, edge, fine, texture = null, row = {stops: ["#000000", "#ffffff"], bare: "#b8b8b8"}, parts = [];
  function ready() {
    fine = smoothed(gl);
    [face, field, edge] = [FACE, FIELD, EDGE].map(each => program(gl, each));
    texture = ramp(gl, row.stops);
    load(parts);
  }
  /** Parts with the same points share what was uploaded of the first. */
  function load(next) {
    const known = new Map();
    parts = next.map(part => {
      if (!known.has(part.points)) known.set(part.points, upload(part));
      return {...part, ...known.get(part.points)};
    });
  }
  function upload(part) {
    const {points, normals, levels, corners, edges} = part, order = numbers => ({data: buffer(gl, numbers, gl.ELEMENT_ARRAY_BUFFER),
      count: numbers.length, type: numbers instanceof Uint16Array ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT});
    const spots = buffer(gl, points), faces = {buffers: {position: [spots, 3], normal: [buffer(gl, normals), 3]}, count: points.length / 3};
    if (levels) faces.buffers.level = [buffer(gl, levels), 1];
    return {faces: {...faces, order: corners && order(corners)}, lines: corners
      ? {buffers: {position: [spots, 3]}, order: order(edges)} : {buffers: {position: [buffer(gl, edges), 3]}, count: edges.length / 3}};
  }
  function drop({faces, lines}) {
    const all = [faces, lines].flatMap(({buffers, order}) => [...Object.values(buffers).map(([data]) => data), order?.data]);
    for (const data of new Set(all)) gl.deleteBuffer(data || null);
  }
  /** Triangles or lines {buffers: {name: [data, size]}, order, count} of a part, which nothing else may be fed from afterwards. */
  function draw(kind, shader, {buffers, order, count}) {
    const places = Object.entries(buffers).map(([name, [data, size]]) => {
      const place = shader.at(name);
      gl.bindBuffer(gl.ARRAY_BUFFER, data); gl.enableVertexAttribArray(place); gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
      return place;
    });
    if (order) { gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, order.data); gl.drawElements(kind, order.count, order.type, 0); }
    else gl.drawArrays(kind, 0, count);
    places.forEach(place => gl.disableVertexAttribArray(place));
  }
  const put = (shader, part) => gl.uniformMatrix4fv(shader.set("own"), false, part.own || AT_START);
  function begin(shader, matrix, cut) {
    gl.useProgram(shader.made);
    gl.uniform4fv(shader.set("cut"), cut || UNCUT);
    gl.uniformMatrix4fv(shader.set("place"), false, matrix);
  }
  function paintFaces(seen, shader, {matrix, turn}, {sky, faint, cut, own}) {
    begin(shader, matrix, cut);
    gl.uniformMatrix3fv(shader.set("turn"), false, turn);
    gl.uniform3fv(shader.set("sky"), sky);
    gl.uniform1f(shader.set("filled"), cut ? 1 : 0);
    for (const part of seen) {
      own(part);
      put(shader, part);
      gl.uniform1f(shader.set("strength"), faint(part) ? 0.28 : 1);
      draw(gl.TRIANGLES, shader, part.faces);
    }
  }
  const coloured = (colours, dark) => part => {
    const plain = rgb(colours[part.colour] || colours.steel), own = plain.map(c => dark ? 0.06 + 0.94 * c : 0.34 + 0.66 * c);
    gl.uniform3fv(face.set("colour"), own);
    gl.uniform3fv(face.set("inside"), plain.map(c => 0.55 * c + 0.12));
  };
  const mapped = inside => () => {
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.uniform3fv(field.set("bare"), rgb(row.bare));
    gl.uniform3fv(field.set("inside"), inside);
  };
  function paintEdges(seen, matrix, cut, colour, strength) {
    begin(edge, matrix, cut);
    for (const part of seen) {
      gl.uniform4f(edge.set("colour"), ...colour(part), strength(part));
      put(edge, part);
      draw(gl.LINES, edge, part.lines);
    }
  }
  ready();
  return {
    ready,
    /** Where each part stands: a matrix (16) for each, or nothing for one that is where it was at the start. */
    move(places) { parts.forEach((part, n) => { part.own = places[n]; }); },
    load(next) {
      parts.forEach(drop);
      load(next);
    },
    setRamp(stops, bare) {
      row = {stops, bare};
      gl.deleteTexture(texture);
      texture = ramp(gl, stops);
    },
    paint({matrix, turn}, colours, {hidden, faint, cut, smooth = true}) {
      const seen = parts.filter(part => !hidden.has(part.name));
      const sky = rgb(colours.canvas), ink = rgb(colours.ink), dark = sky[0] + sky[1] + sky[2] < 1.5;
      if (smooth) fine.begin();
      gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
      gl.clearColor(...sky, 1); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      gl.enable(gl.DEPTH_TEST); gl.enable(gl.BLEND); gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      if (cut) gl.disable(gl.CULL_FACE); else gl.enable(gl.CULL_FACE);  // of a closed part the inside is seen in a section alone
      paintFaces(seen.filter(part => !part.levels), face, {matrix, turn}, {sky, faint, cut, own: coloured(colours, dark)});
      gl.disable(gl.CULL_FACE);
      paintFaces(seen.filter(part => part.levels), field, {matrix, turn}, {sky, faint, cut, own: mapped(rgb(colours["grid-strong"]))});
      paintEdges(seen, matrix, cut, part => dark || part.levels ? [0, 0, 0] : ink,
        part => faint(part) ? 0.15 : dark || part.levels ? 0.7 : 0.55);
      if (smooth) fine.end();
    },
    close() { gl.getExtension("WEBGL_lose_context")?.loseContext(); },
  };
}
