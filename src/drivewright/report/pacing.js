// How finely moving solids are drawn: edges are smoothed while the machine keeps up, and always when nothing moves.

const APART = 200;  // ms: a longer gap between two drawings is rest
const COUNT = 20;  // drawings that are timed together
const SLOW = 22;  // ms between drawings from which on less is tried
const GAIN = 0.85;  // of the time that drawing without smoothing must take at most, to be worth it

/** {smooth(now)}: whether the drawing at `now` [ms] is to be smoothed; where it is not, still() is called when the motion has ended. */
export function createPacing(still) {
  const timed = {last: -Infinity, count: 0, sum: 0, before: 0};
  let mode = "smooth", waiting = 0;  // smooth: timed as it is; quick: without; settled: smoothed, as leaving it out does not help
  function judge(mean) {
    if (mode === "smooth" && mean > SLOW) { mode = "quick"; timed.before = mean; }
    else if (mode === "quick" && timed.before) { if (mean > GAIN * timed.before) mode = "settled"; timed.before = 0; }
  }
  return {
    get mode() { return mode; },
    smooth(now) {
      const gap = now - timed.last, moves = gap < APART;
      Object.assign(timed, {last: now, count: moves ? timed.count + 1 : 0, sum: moves ? timed.sum + gap : 0});
      if (timed.count === COUNT) { judge(timed.sum / COUNT); Object.assign(timed, {count: 0, sum: 0}); }
      clearTimeout(waiting);
      if (mode !== "quick" || !moves) return true;
      waiting = setTimeout(still, APART + 50);
      return false;
    },
    stop() { clearTimeout(waiting); },
  };
}
