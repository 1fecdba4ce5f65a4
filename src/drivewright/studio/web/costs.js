// How long a search or a study takes, from the seconds that the analyses of the design took.

const least = new WeakMap();  // store -> {drive, timings}

/** Keep the shortest time that each analysis of this drive has taken: the first run may have compiled. */
export function learn(store) {
  const {result, design, jobs} = store.state, known = least.get(store), drive = design?.opened;
  const timings = known && known.drive === drive ? known.timings : {};
  const measured = [result?.timings, jobs?.timing?.answer?.timings].flatMap(each => Object.entries(each || {}));
  for (const [name, seconds] of measured) timings[name] = Math.min(timings[name] ?? Infinity, seconds);
  least.set(store, {drive, timings});
}

/** Seconds of one design by the analyses that give these names, and what they need; of all default ones without names; null where unknown. */
export function secondsOf(store, names = []) {
  const {needs = {}, sources = {}} = store.state.result || {}, timings = least.get(store)?.timings || {};
  const wanted = names.length ? names.map(name => sources[name]).filter(Boolean) : Object.keys(timings);
  const all = new Set(wanted.flatMap(name => needs[name] || [name])), known = [...all].map(name => timings[name]).filter(Number.isFinite);
  return known.length ? known.reduce((sum, each) => sum + each, 0) : null;
}

/** A duration as people say it: "3 s", "4 min", "2.5 h". */
export function durationText(seconds, t) {
  if (seconds < 1) return t("less than * s", 1);
  if (seconds < 90) return t("* s", Math.round(seconds));
  if (seconds < 5400) return t("* min", Math.round(seconds / 60));
  return t("* h", (seconds / 3600).toFixed(1));
}

/** Designs of one generation: by differential evolution the next power of two, by NSGA-II as many as the population says. */
export function members(unknowns, several, population) {
  const least = population || Math.max(16, 8 * unknowns);
  if (several) return least;
  const wanted = Math.max(5, Math.max(1, Math.ceil(least / Math.max(unknowns, 1))) * Math.max(unknowns, 1));
  return 2 ** Math.ceil(Math.log2(wanted));
}

/** Generations for about so many designs. */
export const generationsFor = (designs, size, several) => Math.max(1, Math.round(designs / size) - (several ? 0 : 1));

/** Designs that so many generations try at most. */
export const designsOf = (generations, size, several) => size * (generations + (several ? 0 : 1));
