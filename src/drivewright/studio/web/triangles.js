// Triangles with normals and feature edges on a WebGL canvas.

// What lies beyond the plane `cut` (normal, distance) is left out; what is seen from inside then is as if the section were filled.
const CUT = {declare: "uniform vec4 cut; varying vec3 spot;", test: "if (dot(cut.xyz, spot) > cut.w) discard;"};

const FACE = {vertex: `
  attribute vec3 position, normal;
  uniform mat4 place, own; uniform mat3 turn;
  varying vec3 facing, spot;
  void main() { vec4 at = own * vec4(position, 1.0); facing = turn * mat3(own) * normal; spot = at.xyz; gl_Position = place * at; }`, fragment: `
  precision highp float;
  uniform vec3 colour, sky, inside; uniform float strength, filled;
  varying vec3 facing; ${CUT.declare}
  void main() {
    ${CUT.test}
    vec3 n = normalize(facing);
    if (filled > 0.5 && !gl_FrontFacing) { gl_FragColor = vec4(mix(sky, inside, strength), 1.0); return; }
    float key = max(dot(n, normalize(vec3(-0.35, 0.55, 0.76))), 0.0), back = max(dot(n, normalize(vec3(0.7, -0.25, 0.35))), 0.0);
    float light = 0.42 + 0.2 * n.y * 0.5 + 0.5 * key + 0.14 * back;
    float rim = pow(1.0 - abs(n.z), 3.0) * 0.18, shine = pow(max(dot(n, normalize(vec3(-0.2, 0.32, 0.93))), 0.0), 40.0) * 0.16;
    gl_FragColor = vec4(mix(sky, colour * light + rim * sky + shine, strength), 1.0);
  }`};
// A value at every corner, 0 ... 1 along the colours; below 0 there is none.
const FIELD = {vertex: `
  attribute vec3 position, normal; attribute float level;
  uniform mat4 place, own; uniform mat3 turn;
  varying vec3 facing, spot; varying float value;
  void main() {
    vec4 at = own * vec4(position, 1.0);
    facing = turn * mat3(own) * normal; spot = at.xyz; value = level; gl_Position = place * at;
  }`, fragment: `
  precision highp float;
  uniform vec3 bare, sky, inside; uniform float strength, filled; uniform sampler2D colours;
  varying vec3 facing; varying float value; ${CUT.declare}
  void main() {
    ${CUT.test}
    vec3 n = normalize(facing), own = value < -0.01 ? bare : texture2D(colours, vec2(clamp(value, 0.004, 0.996), 0.5)).rgb;
    float light = 0.84 + 0.2 * max(dot(n, normalize(vec3(-0.35, 0.55, 0.76))), 0.0);
    gl_FragColor = vec4(mix(sky, gl_FrontFacing || filled < 0.5 ? own * light : inside, strength), 1.0);
  }`};
const EDGE = {vertex: `
  attribute vec3 position;
  uniform mat4 place, own;
  varying vec3 spot;
  void main() { vec4 at = own * vec4(position, 1.0); spot = at.xyz; gl_Position = place * at; gl_Position.z -= 0.0006 * gl_Position.w; }`, fragment: `
  precision highp float;
  uniform vec4 colour; ${CUT.declare}
  void main() { ${CUT.test} gl_FragColor = colour; }`};
const STILL = new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);  // a part where it was at the start
const WHOLE = [0, 0, 0, 1];  // a plane beyond which nothing lies

/** Red, green, blue of "#abc" or "#aabbcc", each 0..1. */
function rgb(hex) {
  const digits = hex.slice(1), n = parseInt(digits.length === 3 ? digits.replace(/./g, "$&$&") : digits, 16);
  return [n >> 16 & 255, n >> 8 & 255, n & 255].map(c => c / 255);
}

function program(gl, {vertex, fragment}) {
  const made = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text); gl.compileShader(shader); gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  return made;
}

function buffer(gl, values) {
  const made = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, made); gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
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

/**
 * Drawing on one WebGL context, null where there is none: `load(parts)`, `paint({matrix, turn}, colours, {hidden, faint, cut})`, where `hidden` is a
 * set of names, `faint(part)` tells which are seen through and `cut` is a plane [normal, distance] or null; `ready()` after the context was lost.  Parts with `levels` (one a corner, 0 ... 1, below
 * 0 for none) are drawn in the colours of `setRamp(stops, bare)`.
 */
export function createRenderer(canvas) {
  const gl = canvas.getContext("webgl", {antialias: true, alpha: false, preserveDrawingBuffer: false});
  if (!gl) return null;
  let face, field, edge, texture = null, row = {stops: ["#000000", "#ffffff"], bare: "#b8b8b8"}, parts = [];
  function ready() {
    [face, field, edge] = [FACE, FIELD, EDGE].map(each => program(gl, each));
    texture = ramp(gl, row.stops);
    parts = parts.map(upload);
  }
  const upload = part => ({...part, faces: buffer(gl, part.points), sides: buffer(gl, part.normals), lines: buffer(gl, part.edges),
    values: part.levels ? buffer(gl, part.levels) : null});
  function feed(shader, name, data, size = 3) {
    const place = gl.getAttribLocation(shader, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, data); gl.enableVertexAttribArray(place); gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
    return place;
  }
  /** Triangles or lines of a part with its buffers {name: [data, size]}, which nothing else may be fed from afterwards. */
  function draw(kind, shader, buffers, count) {
    const places = Object.entries(buffers).map(([name, [data, size]]) => feed(shader, name, data, size));
    gl.drawArrays(kind, 0, count);
    places.forEach(place => gl.disableVertexAttribArray(place));
  }
  const set = (shader, part) => gl.uniformMatrix4fv(gl.getUniformLocation(shader, "own"), false, part.own || STILL);
  function paintFaces(seen, shader, {matrix, turn}, {sky, faint, cut, own}) {
    gl.useProgram(shader);
    gl.uniform4fv(gl.getUniformLocation(shader, "cut"), cut);
    gl.uniformMatrix4fv(gl.getUniformLocation(shader, "place"), false, matrix);
    gl.uniformMatrix3fv(gl.getUniformLocation(shader, "turn"), false, turn);
    gl.uniform3fv(gl.getUniformLocation(shader, "sky"), sky);
    for (const part of seen) {
      own(part);
      set(shader, part);
      gl.uniform1f(gl.getUniformLocation(shader, "strength"), faint(part) ? 0.28 : 1);
      draw(gl.TRIANGLES, shader, {position: [part.faces, 3], normal: [part.sides, 3], ...(part.values ? {level: [part.values, 1]} : {})},
        part.points.length / 3);
    }
  }
  const coloured = (colours, dark, cut) => part => {
    const plain = rgb(colours[part.colour] || colours.steel), own = plain.map(c => dark ? 0.06 + 0.94 * c : 0.34 + 0.66 * c);
    gl.uniform3fv(gl.getUniformLocation(face, "colour"), own);
    gl.uniform3fv(gl.getUniformLocation(face, "inside"), plain.map(c => 0.55 * c + 0.12));
    gl.uniform1f(gl.getUniformLocation(face, "filled"), cut ? 1 : 0);
  };
  const mapped = (inside, cut) => () => {
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.uniform3fv(gl.getUniformLocation(field, "bare"), rgb(row.bare));
    gl.uniform3fv(gl.getUniformLocation(field, "inside"), inside);
    gl.uniform1f(gl.getUniformLocation(field, "filled"), cut ? 1 : 0);
  };
  function paintEdges(seen, matrix, cut, colour, strength) {
    gl.useProgram(edge);
    gl.uniform4fv(gl.getUniformLocation(edge, "cut"), cut);
    gl.uniformMatrix4fv(gl.getUniformLocation(edge, "place"), false, matrix);
    for (const part of seen) {
      gl.uniform4f(gl.getUniformLocation(edge, "colour"), ...colour(part), strength(part));
      set(edge, part);
      draw(gl.LINES, edge, {position: [part.lines, 3]}, part.edges.length / 3);
    }
  }
  ready();
  return {
    ready,
    /** Where each part stands: a matrix (16) for each, or nothing for one that is where it was at the start. */
    move(places) { parts.forEach((part, n) => { part.own = places[n]; }); },
    load(next) {
      for (const part of parts) for (const data of [part.faces, part.sides, part.lines, part.values]) gl.deleteBuffer(data);
      parts = next.map(upload);
    },
    setRamp(stops, bare) {
      row = {stops, bare};
      gl.deleteTexture(texture);
      texture = ramp(gl, stops);
    },
    paint({matrix, turn}, colours, {hidden, faint, cut}) {
      const seen = parts.filter(part => !hidden.has(part.name));
      const sky = rgb(colours.canvas), ink = rgb(colours.ink), dark = sky[0] + sky[1] + sky[2] < 1.5;
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.clearColor(...sky, 1); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      gl.enable(gl.DEPTH_TEST); gl.enable(gl.BLEND); gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
      paintFaces(seen.filter(part => !part.values), face, {matrix, turn}, {sky, faint, cut: cut || WHOLE, own: coloured(colours, dark, cut)});
      paintFaces(seen.filter(part => part.values), field, {matrix, turn}, {sky, faint, cut: cut || WHOLE, own: mapped(rgb(colours["grid-strong"]), cut)});
      paintEdges(seen, matrix, cut || WHOLE, part => dark || part.levels ? [0, 0, 0] : ink,
        part => faint(part) ? 0.15 : dark || part.levels ? 0.7 : 0.55);
    },
    close() { gl.getExtension("WEBGL_lose_context")?.loseContext(); },
  };
}
