// What is drawn behind the plots: the design that is compared with, and the runs that are kept and switched on.

const REFERENCE = {colour: "muted", dash: [4, 3]};

/** [{name, colour, dash, plots}] of the store's state. */
export function overlays({reference, kept}, t) {
  const other = reference?.result?.plots ? [{...REFERENCE, name: t(reference.title), plots: reference.result.plots}] : [];
  return [...other, ...(kept || []).filter(({on}) => on)];
}

/** A packed panel in the language of the page. */
export function translated(one, t) {
  const axis = one.axis && {...one.axis, label: t(one.axis.label), names: one.axis.names?.map(text => t(text)) ?? null, places: one.axis.places.map(([at, name]) => [at, t(name)])};
  return {...one, title: t(one.title), ...(one.label ? {label: t(one.label.replace(/ \[[^\]]*\]$/, ""))} : {}), ...(axis ? {axis} : {}), series: one.series.map(series => ({...series, label: t(series.label)})),
    limits: one.limits.map(([value, text]) => [value, t(text)])};
}

/** The panels of a result's plots by their ids, in the order of the ids. */
export const panelsOf = (plots, ids) => ids.map(id => plots.flatMap(({panels}) => panels).find(panel => panel.id === id)).filter(Boolean);
