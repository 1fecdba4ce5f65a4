"""All plots of a result as JSON for a page that offers a choice: over the cycle, over anything else, and those drawn as pictures."""

from collections.abc import Iterable, Sequence
from fnmatch import fnmatchcase
from typing import Any, TypeAlias

import numpy as np

from drivewright import registry
from drivewright._typing import ArrayLike, Floats, Ints
from drivewright.report.numbering import UNRELATED, relation
from drivewright.report.pack import MOST_ROWS, along, envelope_rows, floats, pack_cycle, pack_plot_groups
from drivewright.result import Check, Plot, Result
from drivewright.scene import Scene
from drivewright.view.panels import Panel, decimals, drawable, panels, span
from drivewright.view.text import display_unit

DRAWN = ("line", "points", "stems", "bars")  # styles that a page draws itself
MOST_SHOWN, MOST_FAILED = 4, 2  # panels that a page opens with, and those among them that show failed checks
Packed: TypeAlias = dict[str, Any]


def pack_every_plot(result: Result[Any], scene: Scene | None, plots: Sequence[Plot], quick: bool = False) -> Packed | None:
    """{"cycle", "plots", "first", "diagrams"}; None where the result has no plots.

    plots: as of `pack_plot_groups`, each panel with an `id`, "plot/column" of its first line.  A panel over something else than the
    cycle has an `axis` {"label", "unit", "factor" from SI, "low", "high", "names", "places"} and its `u` in that unit; `names` are the
    texts of an axis without numbers, `equal` says that both axes have one scale, `phase` where on the cycle each of its points is.  A plot
    that a page cannot draw has no panels, but `picture`.  `first` are the panels to begin with, `diagrams` those of the drive
    that belong under its drawing, on the axis that points to the right.  `quick`, while a design changes: of the plots that are not over
    the cycle only those that the drive names.
    """
    if not (shown := drawable(result, plots)):
        return None
    known = registry.mechanism(result.mechanism)
    named = [pattern.partition("/")[0] for pattern in (*known.main_plots, *known.diagrams)]
    linked = pack_plot_groups(result, scene, shown) if scene else None
    found = {plot["name"]: plot for plot in linked["plots"]} if linked else {}
    if quick:
        shown = tuple(plot for plot in shown if plot.name in found or any(fnmatchcase(plot.name, name) for name in named))
    packed = [_packed_plot(result, scene, plot, found.get(plot.name)) for plot in shown]
    ids = {plot.name: [panel["id"] for panel in each["panels"]] for plot, each in zip(shown, packed, strict=True)}
    every = [each for own in ids.values() for each in own]
    diagrams = _chosen(every, known.diagrams)
    cycle = pack_cycle(scene, result.units) if scene else None
    return {"cycle": cycle, "plots": packed, "first": first_panels(result, shown, ids, known.main_plots, diagrams), "diagrams": diagrams}


def first_panels(
    result: Result[Any], plots: Sequence[Plot], ids: dict[str, list[str]], main: Sequence[str], apart: Sequence[str] = ()
) -> list[str]:
    """Panels that a page opens with, none of those shown `apart`: a few that show failed checks, then the main ones of the drive."""
    every = [each for own in ids.values() for each in own]
    failing = [each for check in result.checks if not check.ok for each in _showing(check, plots, ids) if each not in apart]
    leading = [each for each in (_chosen(every, main) or every) if each not in apart]
    ranked = dict.fromkeys([*list(dict.fromkeys(failing))[:MOST_FAILED], *leading, *failing])
    return list(ranked)[:MOST_SHOWN]


def _showing(check: Check, plots: Sequence[Plot], ids: dict[str, list[str]]) -> list[str]:
    """The panel that shows a check best, [] where none does; limits are drawn in the first panel of a plot."""
    best = min((plot for plot in plots if ids[plot.name]), key=lambda plot: relation(plot, check), default=None)
    if best is None or relation(best, check) == UNRELATED:
        return []
    own, names = ids[best.name], {check.name, check.name.partition(".")[0]}
    named = [each for each in own if names & set(each.partition("/")[2].split("."))]
    return [named[0] if named and not best.limits else own[0]]


def _chosen(ids: Sequence[str], patterns: Iterable[str]) -> list[str]:
    """Ids in the order of the patterns "plot/column" or "plot", with "*" for what users name; the first plot alone where several fit."""
    found: dict[str, None] = {}
    for pattern in patterns:
        fitting = [each for each in ids if fnmatchcase(each, pattern if "/" in pattern else f"{pattern}/*")]
        plot = fitting[0].partition("/")[0] if fitting else ""
        found |= dict.fromkeys(each for each in fitting if each.partition("/")[0] == plot)
    return list(found)


def _packed_plot(result: Result[Any], scene: Scene | None, plot: Plot, linked: Packed | None) -> Packed:
    """One plot with its panels."""
    about = {"name": plot.name, "title": plot.title, **({"meaning": plot.meaning} if plot.meaning else {})}
    if plot.style not in DRAWN:
        return {**about, "panels": [], "picture": True}
    if linked:
        packed = linked["panels"]
    else:
        drawn, phase = panels(result, plot), _phase(result, scene, plot)
        factor = display_unit(result.tables[plot.table][plot.x].unit, result.units)[0]
        packed = [_apart(each, phase, len(drawn), factor) for each in drawn]
    return {**about, "panels": [{**panel, "id": f"{plot.name}/{panel['name']}"} for panel in packed]}


def _phase(result: Result[Any], scene: Scene | None, plot: Plot) -> Floats | None:
    """Where on the cycle each row of a plot's table is; None where that is not known."""
    if scene is None or not scene.table or plot.table != scene.table:
        return None
    return along(result.tables[plot.table].columns[0].data, scene)


def _apart(panel: Panel, phase: Floats | None, count: int, factor: float) -> Packed:
    """A panel over something else than the cycle; `factor` is the unit of x per SI unit."""
    x, names = _places(panel.x.data)
    own = [x if each.x is None else np.asarray(each.x, float) for each in panel.series]
    low, high = (-0.5, len(x) - 0.5) if names is not None or panel.style == "bars" else span(own)
    if panel.style == "bars" and names is None:  # bars stand side by side, whatever numbers they are named after
        names, x = [f"{value:.4g}" for value in x], np.arange(len(x), dtype=float)
        own = [x for _ in own]
    rows = _rows(panel, x)
    alone = all(each.x is None for each in panel.series)
    first = panel.series[0]
    return {
        "name": first.name,
        "title": first.label if count > 1 and len(panel.series) == 1 else panel.title,
        "label": panel.label,
        "low": panel.low,
        "high": panel.high,
        "decimals": int(decimals(panel.low, panel.high)),
        "u": floats(x[rows]),
        "style": panel.style,
        "log": panel.log,
        "equal": panel.equal,
        "shade": [list(stretch) for stretch in panel.shade],
        "limits": [[float(value), text] for value, text in panel.limits],
        "axis": {
            "label": panel.x.label,
            "unit": panel.x.unit,
            "factor": float(factor),
            "low": float(low),
            "high": float(high),
            "names": names,
            "places": [[float(at), name] for at, name in panel.places],
        },
        **({"phase": floats(phase[rows])} if phase is not None and alone and len(phase) == len(x) else {}),
        "series": [
            {
                "label": each.label,
                "unit": each.unit,
                "role": each.role,
                "dashed": each.dashed,
                **({"marked": True} if each.marker else {}),
                "data": floats(np.asarray(each.data, float)[rows]),
                **({"x": floats(place[rows])} if each.x is not None else {}),
                **({"ends": [floats(end[rows]) for end in each.ends]} if each.ends else {}),
            }
            for each, place in zip(panel.series, own, strict=True)
        ],
    }


def _places(x: ArrayLike) -> tuple[Floats, list[str] | None]:
    """(numbers, texts that stand for them where the column holds texts)."""
    data = np.asarray(x)
    if data.dtype.kind in "fiub":
        return data.astype(float), None
    return np.arange(len(data), dtype=float), [str(text) for text in data]


def _rows(panel: Panel, x: Floats) -> Ints:
    """Rows that draw the same picture; of a path, which runs back and forth, every so many."""
    lines = [np.asarray(each.data, float) for each in panel.series]
    if len(x) <= MOST_ROWS or panel.style == "bars":
        return np.arange(len(x))
    rising = all(each.x is None for each in panel.series) and np.all(np.diff(x) >= 0)
    return envelope_rows(lines) if rising else np.unique(np.linspace(0, len(x) - 1, MOST_ROWS).astype(int))
