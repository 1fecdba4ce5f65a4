// Where a dragged point goes when it comes near something: the grid, other points, a level, an equal length.

const NEAR = 7;  // px

/**
 * The place [x, y] that a hand means by `at`, all in pixels: {at, guides, words}.
 * `fixed`: points that it may fall upon; `partners`: points that it may stand level with, above, or `lengths` away from.
 */
export function snapped(at, {fixed = [], partners = [], lengths = []}) {
  const upon = nearest(fixed, at);
  if (upon) return {at: [...upon], guides: [], words: "on a point"};
  const level = partners.find(([, y]) => Math.abs(y - at[1]) < NEAR), plumb = partners.find(([x]) => Math.abs(x - at[0]) < NEAR);
  const straight = [plumb ? plumb[0] : at[0], level ? level[1] : at[1]], guides = [level, plumb].filter(Boolean).map(to => [straight, to]);
  if (level || plumb) return {at: straight, guides, words: level && plumb ? "" : level ? "horizontal" : "vertical"};
  for (const from of partners) {
    const dx = at[0] - from[0], dy = at[1] - from[1], now = Math.hypot(dx, dy);
    const length = lengths.find(each => Math.abs(each - now) < NEAR && each > NEAR);
    if (length && now) {
      const to = [from[0] + dx / now * length, from[1] + dy / now * length];
      return {at: to, guides: [[from, to]], words: "equal length"};
    }
  }
  return {at, guides: [], words: ""};
}

function nearest(points, at) {
  const found = points.map(point => [Math.hypot(point[0] - at[0], point[1] - at[1]), point]).sort(([a], [b]) => a - b)[0];
  return found && found[0] < NEAR ? found[1] : null;
}

/** The number on a grid of `step` that is nearest; the number itself without a step. */
export const onGrid = (number, step) => step ? Number((Math.round(number / step) * step).toPrecision(12)) : number;
