"""Curves of several designs that lie upon each other: where they do, and which are the same altogether."""

from collections.abc import Sequence

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.view.panels import Panel, Series

HIDDEN = 0.004  # of a panel's height: nearer than this, a line hides the one under it
SAME = 1e-9  # of a curve's range: nearer than this everywhere, two curves are one
LONGEST = 24  # letters of a label within a legend


def show_coincident(panel: Panel) -> Panel:
    """The panel with what draws and names curves that coincide: `Series.covered`, and "(same as ...)" in the legend.

    Curves are compared in the order in which they are drawn, references left aside.
    """
    solid = [n for n, series in enumerate(panel.series) if not series.dashed]
    series = list(panel.series)
    for place, n in enumerate(solid):
        own = panel.series[n]
        twin = next((panel.series[k] for k in solid[:place] if _is_same(panel.series[k], own, panel)), None)
        label = own.label if twin is None else f"{own.label} (same as {_shortened(twin.label)})"
        later = [panel.series[k] for k in solid[place + 1 :]]
        series[n] = own._replace(label=label, covered=_covered(own, later, panel) if panel.style == "line" else None)
    return panel._replace(series=tuple(series))


def _covered(own: Series, later: Sequence[Series], panel: Panel) -> Ints | None:
    """How many of the later curves hide this one at each of its rows (rows,); None where none does."""
    height = np.ptp(_scaled(np.array([panel.low, panel.high]), panel.log))
    y = _scaled(own.data, panel.log)
    counts = np.zeros(len(y), int)
    for other in later:
        counts += np.abs(_scaled(_at_rows_of(own, other, panel), panel.log) - y) <= HIDDEN * height
    return counts if counts.any() else None


def _is_same(first: Series, other: Series, panel: Panel) -> bool:
    """Whether two curves agree at all rows, gaps included."""
    one, two = np.asarray(first.data, float), _at_rows_of(first, other, panel)
    known = np.isfinite(one)
    if not known.any() or not np.array_equal(known, np.isfinite(two)):
        return False
    return bool(np.all(np.abs(one - two)[known] <= SAME * np.max(np.abs(one[known]), initial=0.0)))


def _at_rows_of(own: Series, other: Series, panel: Panel) -> Floats:
    """The other curve at the places of this one, nan where it has none or where that cannot be told."""
    x, places = _places(own, panel), _places(other, panel)
    if len(x) == len(places) and np.allclose(x, places, rtol=0, atol=1e-9 * max(np.ptp(x), 1e-300) if len(x) else 0, equal_nan=True):
        return np.asarray(other.data, float)
    if panel.style != "line" or len(places) < 2 or not all(np.all(np.diff(each) > 0) for each in (x, places)):
        return np.full(len(x), np.nan)
    return np.interp(x, places, np.asarray(other.data, float), left=np.nan, right=np.nan)


def _places(series: Series, panel: Panel) -> Floats:
    x = panel.x.data if series.x is None else series.x
    return np.arange(len(x), dtype=float) if np.asarray(x).dtype.kind not in "fiub" else np.asarray(x, float)


def _scaled(data: Floats, log: bool) -> Floats:
    data = np.asarray(data, float)
    return np.log10(np.where(data > 0, data, np.nan)) if log else data


def is_covered(covered: Ints) -> Bools:
    """Rows of covered stretches (rows,); a single row, where two curves cross, is none."""
    on = np.asarray(covered) > 0
    beside = np.zeros_like(on)
    beside[1:] |= on[:-1]
    beside[:-1] |= on[1:]
    return on & beside


def _shortened(label: str) -> str:
    return label if len(label) <= LONGEST else f"{label[: LONGEST - 1].rstrip()}…"
