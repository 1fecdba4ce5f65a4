"""Plots of the tables of a shaft; they depend on its stations and modes."""

from collections.abc import Iterator
from typing import Any

from drivewright.result import Plot, Result

SURFACE = Plot(
    "solid_surface",
    "Shaft as a solid of finite elements",
    "solid_surface",
    "z",
    ("y", "x", "displacement"),
    equal=True,
    style="mesh",
    reference=("rest_z", "rest_y"),
    meaning="Dashed: outline of the undeformed shaft.",
)


def shaft_plots(result: Result[Any], places: tuple[tuple[float, str], ...] = ()) -> Iterator[Plot]:
    """The plots of the tables of `shafts.tables` under the names that these give them, whether or not the result has them.

    `places` are (position [m], name) of what stands on the shaft.
    """
    stations = _labels(result, "flexibility")
    across = "_across" if "diagram" in result.tables and any(result.tables["diagram"]["moment_across"].data) else ""
    columns = [name for each in ("deflection", "slope", "shear", "moment") for name in dict.fromkeys((each, each + across))]
    rigid = tuple(f"{name}.rigid" for name in stations)
    yield Plot("diagram", "Deflections and forces along the shaft", "diagram", "z", tuple(columns), places=places)
    yield Plot("stress", "Stress along the shaft", "diagram", "z", ("stress",), places=places)
    beside = "Dashed: on rigid bearings."
    yield Plot("unit_load", "Unit-force deflection", "unit_load", "z", stations, reference=rigid, places=places, meaning=beside)
    parts = _labels(result, "flexibility.shares")
    yield Plot("shares", "Flexibility contributions", "shares", "entry", parts, style="bars")
    if "modes" in result.tables:
        shapes = tuple(column.name for column in result.tables["modes"].columns[1:])
        yield Plot("modes", "Natural modes of bending", "modes", "z", shapes, places=places)


def _labels(result: Result[Any], array: str) -> tuple[str, ...]:
    """Labels along the first axis of an array; none where the result has no such array."""
    return tuple(result.arrays[array].labels[0]) if array in result.arrays else ()
