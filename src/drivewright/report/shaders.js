// Shaders of the solids: faces in one colour, faces with values, edges.  All of them stop at the plane of a section.

// What lies beyond the plane `cut` (normal, distance) is left out; what is seen from inside then is as if the section were filled.
const CUT = {declare: "uniform vec4 cut; varying vec3 spot;", test: "if (dot(cut.xyz, spot) > cut.w) discard;"};

export const FACE = {vertex: `
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
export const FIELD = {vertex: `
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
export const EDGE = {vertex: `
  attribute vec3 position;
  uniform mat4 place, own;
  varying vec3 spot;
  void main() { vec4 at = own * vec4(position, 1.0); spot = at.xyz; gl_Position = place * at; gl_Position.z -= 0.0006 * gl_Position.w; }`, fragment: `
  precision highp float;
  uniform vec4 colour; ${CUT.declare}
  void main() { ${CUT.test} gl_FragColor = colour; }`};
