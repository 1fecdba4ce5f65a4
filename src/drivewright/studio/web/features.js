// What a hand can pick on a drawing to measure it: points, straight lines and circles, each bound to its body.

const SAME = 1e-7;  // m: two features of a body that are one
const FRAME = "";  // what stands still

/** A point [x, y] of a body's frame as its pose carries it. */
export function carried([x, y], [px, py, angle]) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return [px + c * x - s * y, py + s * x + c * y];
}

/**
 * Everything of a packed scene that can be picked, those first that have a name: [{ref, kind, body, owner, label, of, point, to, radius, last}].
 * `ref` finds it again in the next state of the design; `last` is the name of a point of the spec, which has no label; `body` is a number, -1 for the frame; `kind` is "point", "line" or "circle".
 */
export function featuresOf(scene) {
  const found = [], taken = new Set();
  const name = number => scene.bodies[number]?.name ?? FRAME, title = number => scene.bodies[number]?.label ?? "frame";
  function add(kind, body, ref, label, point, more = {}) {
    const place = [kind, body, ...point, ...(more.to || []), more.radius ?? 0].map(part => typeof part === "number" ? Math.round(part / SAME) : part).join(" ");
    if (taken.has(place)) return;
    taken.add(place);
    found.push({kind, body, owner: name(body), ref: `${name(body)}|${ref}`, label, of: title(body), point, ...more});
  }
  for (const handle of scene.handles || []) if (!handle.direction) add("point", handle.body, `handle ${handle.key}`, handle.label, handle.point, {handle});
  for (const {body, point, label} of scene.traces) add("point", body, `trace ${label}`, label, point);
  const all = scene.bodies.flatMap((body, number) => body.shapes.map((shape, n) => [number, n, scene.features?.[shape] || {lines: [], arcs: []}]));
  for (const [number, n, {arcs}] of all) arcs.forEach(([x, y], k) => add("point", number, `centre ${n} ${k}`, "centre on *", [x, y]));
  for (const [number, n, {arcs}] of all) arcs.forEach(([x, y, radius], k) => add("circle", number, `circle ${n} ${k}`, "circle of *", [x, y], {radius}));
  for (const [number, n, {lines}] of all) lines.forEach(([x0, y0, x1, y1], k) => {
    add("point", number, `start ${n} ${k}`, "corner of *", [x0, y0]);
    add("point", number, `end ${n} ${k}`, "corner of *", [x1, y1]);
    if (Math.hypot(x1 - x0, y1 - y0) > SAME) add("line", number, `line ${n} ${k}`, "edge of *", [x0, y0], {to: [x1, y1]});
  });
  for (const [{body, point}, next] of neighbours(scene.handles || [])) if (Math.hypot(point[0] - next.point[0], point[1] - next.point[1]) > SAME)
    add("line", body, `between ${next.key}`, "centre line of *", point, {to: next.point});
  return found;
}

/** Pairs of points of each moving body that follow each other: the centre lines of its bars. */
function neighbours(handles) {
  const own = new Map();
  for (const handle of handles) if (!handle.direction && handle.body >= 0) own.set(handle.body, [...own.get(handle.body) || [], handle]);
  return [...own.values()].flatMap(points => points.slice(1).map((next, n) => [points[n], next]));
}

/** How far from a pixel a feature is seen, Infinity where it is no candidate; `seen(body, point)` gives pixels, `scale` px per metre. */
export function distanceTo(feature, [x, y], seen, scale) {
  const [ax, ay] = seen(feature.body, feature.point), away = Math.hypot(x - ax, y - ay);
  if (feature.kind === "point") return away;
  if (feature.kind === "circle") return Math.min(Math.abs(away - feature.radius * scale), away);
  const [bx, by] = seen(feature.body, feature.to), dx = bx - ax, dy = by - ay, along = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1);
  return along < 0 || along > 1 ? Infinity : Math.hypot(x - ax - along * dx, y - ay - along * dy);
}
