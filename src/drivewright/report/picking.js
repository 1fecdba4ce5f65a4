// Which part is under the pointer, by its triangles at the phase that is drawn.

/** How far along `ray` from `eye` (both in the space of the part) the first triangle is that it meets; Infinity without one. */
export function firstHit({points, corners}, eye, ray) {
  let nearest = Infinity;
  const count = corners ? corners.length : points.length / 3, spot = n => 3 * (corners ? corners[n] : n);
  for (let n = 0; n < count; n += 3) {
    const [a, b, c] = [spot(n), spot(n + 1), spot(n + 2)];
    const ux = points[b] - points[a], uy = points[b + 1] - points[a + 1], uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a], vy = points[c + 1] - points[a + 1], vz = points[c + 2] - points[a + 2];
    const px = ray[1] * vz - ray[2] * vy, py = ray[2] * vx - ray[0] * vz, pz = ray[0] * vy - ray[1] * vx, size = ux * px + uy * py + uz * pz;
    if (Math.abs(size) < 1e-30) continue;
    const sx = eye[0] - points[a], sy = eye[1] - points[a + 1], sz = eye[2] - points[a + 2], along = (sx * px + sy * py + sz * pz) / size;
    if (along < 0 || along > 1) continue;
    const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux, aside = (ray[0] * qx + ray[1] * qy + ray[2] * qz) / size;
    if (aside < 0 || along + aside > 1) continue;
    nearest = Math.min(nearest, (vx * qx + vy * qy + vz * qz) / size);
  }
  return nearest;
}

/** A point, or with `free` a direction, taken back by a matrix of rotation and shift. */
export function takenBack(m, v, free = false) {
  const [x, y, z] = v.map((part, k) => free ? part : part - m[12 + k]);
  return [0, 1, 2].map(k => m[4 * k] * x + m[4 * k + 1] * y + m[4 * k + 2] * z);
}
