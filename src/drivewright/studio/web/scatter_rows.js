// What the points of a study span, and which of them are still the same ones when more have come.

const FARTHEST = 3;  // widths of the points, beyond which the current design is told at the edge
const AROUND = 2;  // widths of the feasible points that the axes reach beyond them at most, where others would press them together

/** Where a row of a study stands in what came of the same study since, -1 where it is not there. */
export function sameRow(before, n, now) {
  const found = n < 0 || !before?.cases || !now.cases ? -1 : now.cases.indexOf(before.cases[n]);
  return found >= 0 && JSON.stringify(before.load?.[n]) === JSON.stringify(now.load?.[found]) ? found : -1;
}

/** The range, stretched to a value that lies near: one far away would press the points together. */
export function stretched([low, high], value) {
  const room = FARTHEST * (high - low), edge = 0.04 * (high - low);
  if (!Number.isFinite(value) || value >= low && value <= high || value < low - room || value > high + room) return [low, high];
  return [Math.min(low, value - edge), Math.max(high, value + edge)];
}

/** Least and greatest finite value of a column, a little wider; never empty. */
export function rangeOf(rows, n, wider = 0.04) {
  let low = Infinity, high = -Infinity;
  for (const row of rows) if (Number.isFinite(row[n])) { if (row[n] < low) low = row[n]; if (row[n] > high) high = row[n]; }
  if (!(high >= low)) return [0, 1];
  const edge = (high - low) * wider || Math.abs(high) * 0.05 || 1;
  return [low - edge * (wider > 0), high + edge * (wider > 0)];
}

/** The range of a column that is worth looking at: that of all rows, unless a few that fail lie far from all that is feasible. */
export function reachOf(rows, feasible, n) {
  const good = rows.filter((_, k) => feasible[k]), all = rangeOf(rows, n), [low, high] = rangeOf(good, n, 0), room = AROUND * (high - low);
  if (!good.some(row => row[n] !== good[0][n]) || all[1] - all[0] <= (2 * AROUND + 1) * (high - low)) return all;
  return [Math.max(all[0], low - room), Math.min(all[1], high + room)];
}
