"""The plots of an indexing drive; they depend on what was computed."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from drivewright.indexing.stiffness.tables import GROUP_LABELS
from drivewright.result import Plot, Result

TRACE = 1e-9  # a smaller share is rounding


def plots(result: Result[Any]) -> tuple[Plot, ...]:
    """All plots whose table the result has."""
    return tuple(plot for plot in _all(result) if plot.table in result.tables)


def _all(result: Result[Any]) -> Iterator[Plot]:
    yield Plot("motion", "Motion of the wheel by the input angle", "motion", "angle", ("wheel", "rate", "bend", "third"))
    for suffix, words in (("", ""), (".second", ", second cam")):
        if f"profile{suffix}" in result.tables and "z" not in [column.name for column in result.tables["profile"].columns]:
            yield Plot(f"profile{suffix}", f"Trimmed profile of the cam{words}", f"profile{suffix}", "x", ("y",), equal=True)
    yield Plot(
        "curvature",
        "Curvature of the profile by the input angle at which it is touched",
        "profile",
        "angle",
        ("curvature",),
        style="points",
    )
    yield Plot("contacts", "Pins that touch one cam, and which way it can push them", "contacts", "angle", ("pins", "forward", "backward"))
    yield Plot(
        "contact_map",
        "Contact map: pins that touch cam 1, by the way it can push them",
        "contact_points",
        "angle",
        ("pin_forward", "pin_backward"),
        style="points",
    )
    yield Plot("levers", "Levers of the contacts about the wheel's axis", "contact_points", "angle", ("arm",), style="points")
    if "contacts" in result.tables:
        angles = tuple(column.name for column in result.tables["contacts"].columns if column.name.startswith("pressure_angle"))
        yield Plot("pressure_angle", "Pressure angle", "contacts", "angle", angles, (("pressure_angle", "limit"),))
    yield Plot(
        "play",
        "Free rotation of the wheel, the input standing still",
        "play",
        "angle",
        ("forward", "backward"),
        (("play.forward", "limit"),),
    )
    yield Plot("stiffness", "Torsional stiffness", "stiffness", "angle", ("secant", "tangent", "secant_reversed"))
    if "stiffness" in result.tables:
        table = result.tables["stiffness"]
        largest = {name: np.nanmax(np.abs(table[name].data), initial=0.0) for name in GROUP_LABELS}
        groups = tuple(name for name, share in largest.items() if share > TRACE * max(largest.values()))
        yield Plot("budget", "Who yields: compliance by parts", "stiffness", "angle", groups, style="bars")
    yield Plot("pin_forces", "Forces on the pins", "pin_forces", "angle", ("force", "pressure"), style="points")
    if "bearing_loads" in result.tables:
        names = [column.name for column in result.tables["bearing_loads"].columns if column.name[-2:] not in (".x", ".y")][1:]
        for group in ("crank", "support"):
            own = tuple(name for name in names if name.startswith(group))
            yield Plot(f"{group}_loads", f"Loads of the {group} bearings", "bearing_loads", "angle", own)
