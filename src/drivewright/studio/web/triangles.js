// Triangles with normals and feature edges on a WebGL canvas.

const FACE = {vertex: `
  attribute vec3 position, normal;
  uniform mat4 place; uniform mat3 turn;
  varying vec3 facing;
  void main() { facing = turn * normal; gl_Position = place * vec4(position, 1.0); }`, fragment: `
  precision mediump float;
  uniform vec3 colour, sky; uniform float strength;
  varying vec3 facing;
  void main() {
    vec3 n = normalize(facing);
    float key = max(dot(n, normalize(vec3(-0.35, 0.55, 0.76))), 0.0), back = max(dot(n, normalize(vec3(0.7, -0.25, 0.35))), 0.0);
    float light = 0.42 + 0.2 * n.y * 0.5 + 0.5 * key + 0.14 * back;
    float rim = pow(1.0 - abs(n.z), 3.0) * 0.18, shine = pow(max(dot(n, normalize(vec3(-0.2, 0.32, 0.93))), 0.0), 40.0) * 0.16;
    gl_FragColor = vec4(mix(sky, colour * light + rim * sky + shine, strength), 1.0);
  }`};
const EDGE = {vertex: `
  attribute vec3 position;
  uniform mat4 place;
  void main() { gl_Position = place * vec4(position, 1.0); gl_Position.z -= 0.0006 * gl_Position.w; }`, fragment: `
  precision mediump float;
  uniform vec4 colour;
  void main() { gl_FragColor = colour; }`};

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

/**
 * Drawing on one WebGL context, null where there is none: `load(parts)`, `paint({matrix, turn}, colours, {hidden, faint})`, where `hidden` is a set
 * of names and `faint(part)` tells which are seen through; `ready()` after the context was lost.
 */
export function createRenderer(canvas) {
  const gl = canvas.getContext("webgl", {antialias: true, alpha: false, preserveDrawingBuffer: false});
  if (!gl) return null;
  let face, edge, parts = [];
  function ready() { face = program(gl, FACE); edge = program(gl, EDGE); parts = parts.map(upload); }
  const upload = part => ({...part, faces: buffer(gl, part.points), sides: buffer(gl, part.normals), lines: buffer(gl, part.edges)});
  function feed(shader, name, data) {
    const place = gl.getAttribLocation(shader, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, data); gl.enableVertexAttribArray(place); gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
  }
  function paintFaces(seen, {matrix, turn}, colours, {sky, dark, faint}) {
    gl.useProgram(face);
    gl.uniformMatrix4fv(gl.getUniformLocation(face, "place"), false, matrix);
    gl.uniformMatrix3fv(gl.getUniformLocation(face, "turn"), false, turn);
    gl.uniform3fv(gl.getUniformLocation(face, "sky"), sky);
    for (const part of seen) {
      const own = rgb(colours[part.colour] || colours.steel);
      gl.uniform3fv(gl.getUniformLocation(face, "colour"), own.map(c => dark ? 0.06 + 0.94 * c : 0.34 + 0.66 * c));
      gl.uniform1f(gl.getUniformLocation(face, "strength"), faint(part) ? 0.28 : 1);
      feed(face, "position", part.faces); feed(face, "normal", part.sides);
      gl.drawArrays(gl.TRIANGLES, 0, part.points.length / 3);
    }
  }
  function paintEdges(seen, matrix, colour, strength) {
    gl.useProgram(edge);
    gl.disableVertexAttribArray(gl.getAttribLocation(face, "normal"));
    gl.uniformMatrix4fv(gl.getUniformLocation(edge, "place"), false, matrix);
    for (const part of seen) {
      gl.uniform4f(gl.getUniformLocation(edge, "colour"), ...colour, strength(part));
      feed(edge, "position", part.lines);
      gl.drawArrays(gl.LINES, 0, part.edges.length / 3);
    }
  }
  ready();
  return {
    ready,
    load(next) {
      for (const part of parts) for (const data of [part.faces, part.sides, part.lines]) gl.deleteBuffer(data);
      parts = next.map(upload);
    },
    paint({matrix, turn}, colours, {hidden, faint}) {
      const seen = parts.filter(part => !hidden.has(part.name));
      const sky = rgb(colours.canvas), ink = rgb(colours.ink), dark = sky[0] + sky[1] + sky[2] < 1.5;
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.clearColor(...sky, 1); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      gl.enable(gl.DEPTH_TEST); gl.enable(gl.BLEND); gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
      paintFaces(seen, {matrix, turn}, colours, {sky, dark, faint});
      paintEdges(seen, matrix, dark ? [0, 0, 0] : ink, part => faint(part) ? 0.15 : dark ? 0.7 : 0.55);
    },
    close() { gl.getExtension("WEBGL_lose_context")?.loseContext(); },
  };
}
