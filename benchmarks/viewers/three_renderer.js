// The renderer of the studio's solids once more with three.js: same calls as web/triangles.js, without fields of values.

import { THREE } from "/three.js";

/** Light as near to ours as materials of the library come. */
function lights() {
  const key = new THREE.DirectionalLight(0xffffff, 1.6), back = new THREE.DirectionalLight(0xffffff, 0.45);
  key.position.set(-0.35, 0.55, 0.76); back.position.set(0.7, -0.25, 0.35);
  return [new THREE.AmbientLight(0xffffff, 1.35), key, back];
}

/** The 4 x 4 matrix of a rotation (3 x 3, column by column). */
const widened = m => new THREE.Matrix4().set(m[0], m[3], m[6], 0, m[1], m[4], m[7], 0, m[2], m[5], m[8], 0, 0, 0, 0, 1);

/** `shaders` {FACE, EDGE}: ours in place of the library's materials. */
export function createRenderer(canvas, shaders = null) {
  const renderer = new THREE.WebGLRenderer({canvas, antialias: true, alpha: false});
  const scene = new THREE.Scene(), camera = new THREE.Camera(), lamps = lights(), plane = new THREE.Plane();
  let parts = [], section = false, wide = 0, high = 0;
  scene.matrixWorldAutoUpdate = false; camera.matrixAutoUpdate = false;
  scene.add(...lamps);
  renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
  renderer.localClippingEnabled = true;

  const geometry = (points, normals, order) => {
    const made = new THREE.BufferGeometry();
    made.setAttribute("position", points);
    if (normals) made.setAttribute("normal", new THREE.BufferAttribute(normals, 3));
    made.setIndex(new THREE.BufferAttribute(order, 1));
    return made;
  };
  const raw = ({vertex, fragment}, uniforms) => new THREE.RawShaderMaterial({vertexShader: vertex, fragmentShader: fragment, transparent: true, side: THREE.FrontSide,
    uniforms: Object.fromEntries(Object.entries(uniforms).map(([name, value]) => [name, {value}]))});
  function upload(part) {
    const face = shaders ? raw(shaders.FACE, {place: new THREE.Matrix4(), own: new THREE.Matrix4(), turn: new THREE.Matrix3(), cut: new THREE.Vector4(),
      sky: new THREE.Color(), colour: new THREE.Color(), inside: new THREE.Color(), strength: 1, filled: 0})
      : new THREE.MeshPhongMaterial({side: THREE.FrontSide, shininess: 40, specular: 0x222222});
    const line = shaders ? raw(shaders.EDGE, {place: new THREE.Matrix4(), own: new THREE.Matrix4(), cut: new THREE.Vector4(), colour: new THREE.Vector4()})
      : new THREE.LineBasicMaterial({transparent: true, opacity: 0.55});
    const spots = new THREE.BufferAttribute(part.points, 3), made = {...part, face: new THREE.Mesh(geometry(spots, part.normals, part.corners), face),
      line: new THREE.LineSegments(geometry(spots, null, part.edges), line)};
    made.line.renderOrder = 1;
    for (const each of [made.face, made.line]) { each.frustumCulled = false; each.matrixAutoUpdate = false; scene.add(each); }
    return made;
  }
  function drop(part) {
    for (const each of [part.face, part.line]) { scene.remove(each); each.geometry.dispose(); each.material.dispose(); }
  }
  /** The camera looks along -z of the turned space; the rest of the matrix is its projection. */
  function aim({matrix, turn}) {
    const view = widened(turn), place = new THREE.Matrix4().fromArray(matrix);
    camera.matrixWorldInverse.copy(view);
    camera.matrixWorld.copy(view).invert();
    camera.projectionMatrix.multiplyMatrices(place, camera.matrixWorld);
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
    lamps.forEach(lamp => lamp.position.lengthSq() && (lamp.userData.at ||= lamp.position.clone()) && lamp.position.copy(lamp.userData.at).applyMatrix4(camera.matrixWorld));
    lamps.forEach(lamp => lamp.updateMatrixWorld());
    return place;
  }
  const STILL = new THREE.Matrix4();
  function shade(part, place, {turn}, colours, faint, cut) {
    const plain = new THREE.Color().setStyle(colours[part.colour] || colours.steel, THREE.LinearSRGBColorSpace), own = plain.clone().multiplyScalar(0.66).addScalar(0.34);
    const weak = faint(part), ink = new THREE.Color().setStyle(colours.ink, THREE.LinearSRGBColorSpace);
    if (!shaders) {
      part.face.material.color.copy(own); part.line.material.color.copy(ink);
      Object.assign(part.face.material, {transparent: weak, opacity: weak ? 0.28 : 1});
      part.line.material.opacity = weak ? 0.15 : 0.55;
      return;
    }
    const {uniforms: face} = part.face.material, {uniforms: line} = part.line.material, beyond = cut || [0, 0, 0, 1];
    for (const each of [face, line]) { each.place.value.copy(place); each.own.value.copy(part.face.matrix); each.cut.value.fromArray(beyond); }
    face.turn.value.fromArray(turn); face.sky.value.setStyle(colours.canvas, THREE.LinearSRGBColorSpace); face.colour.value.copy(own);
    face.inside.value.copy(plain).multiplyScalar(0.55).addScalar(0.12);
    face.strength.value = weak ? 0.28 : 1; face.filled.value = cut ? 1 : 0;
    line.colour.value.set(ink.r, ink.g, ink.b, weak ? 0.15 : 0.55);
  }
  return {
    load(next) { parts.forEach(drop); parts = next.map(upload); },
    move(places) {
      parts.forEach((part, n) => [part.face, part.line].forEach(each => {
        if (places[n]) each.matrix.fromArray(places[n]); else each.matrix.copy(STILL);
        each.matrixWorld.copy(each.matrix);
      }));
    },
    paint(view, colours, {hidden, faint, cut}) {
      const place = aim(view);
      if (wide !== canvas.width || high !== canvas.height) { [wide, high] = [canvas.width, canvas.height]; renderer.setViewport(0, 0, wide, high); }
      renderer.setClearColor(new THREE.Color().setStyle(colours.canvas, THREE.LinearSRGBColorSpace));
      for (const part of parts) if (Boolean(cut) !== section) { part.face.material.side = cut ? THREE.DoubleSide : THREE.FrontSide; part.face.material.needsUpdate = true; }
      if (cut) plane.set(new THREE.Vector3(-cut[0], -cut[1], -cut[2]), cut[3]);
      for (const part of parts) {
        part.face.visible = part.line.visible = !hidden.has(part.name);
        if (!shaders && Boolean(cut) !== section) part.face.material.clippingPlanes = part.line.material.clippingPlanes = cut ? [plane] : null;
        shade(part, place, view, colours, faint, cut);
      }
      section = Boolean(cut);
      renderer.render(scene, camera);
    },
    close() { renderer.dispose(); },
  };
}
