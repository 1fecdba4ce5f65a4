"""The plots of an indexing drive; they depend on what was computed."""

from collections.abc import Iterator
from typing import Any

from drivewright.indexing.solid.tables import assembly_plots
from drivewright.indexing.stiffness.tables import stiffness_plots
from drivewright.result import Plot, Result


def plots(result: Result[Any]) -> tuple[Plot, ...]:
    """All plots whose table the result has."""
    return tuple(plot for plot in _all(result) if plot.table in result.tables)


def _all(result: Result[Any]) -> Iterator[Plot]:
    yield Plot("motion", "Motion of the wheel by the input angle", "motion", "angle", ("wheel", "rate", "bend", "third"))
    yield Plot("drive_torque", "Torque on the table and at the input", "drive", "angle", ("table_torque", "input_torque"))
    yield Plot("drive_power", "Power at the input", "drive", "angle", ("input_power",))
    for suffix, words in (("", ""), (".second", ", second cam")):
        if f"profile{suffix}" in result.tables and "z" not in [column.name for column in result.tables["profile"].columns]:
            yield Plot(f"profile{suffix}", f"Trimmed profile of the cam{words}", f"profile{suffix}", "x", ("y",), equal=True)
    title = "Curvature of the profile by the input angle at which it is touched"
    yield Plot("curvature", title, "profile", "angle", ("curvature",), style="points")
    yield Plot("contacts", "Pins that touch one cam, and which way it can push them", "contacts", "angle", ("pins", "forward", "backward"))
    title = "Contact map: pins that touch cam 1, by the way it can push them"
    yield Plot("contact_map", title, "contact_points", "angle", ("pin_forward", "pin_backward"), style="points")
    yield Plot("levers", "Levers of the contacts about the wheel's axis", "contact_points", "angle", ("arm",), style="points")
    if "contacts" in result.tables:
        angles = tuple(column.name for column in result.tables["contacts"].columns if column.name.startswith("pressure_angle"))
        yield Plot("pressure_angle", "Pressure angle", "contacts", "angle", angles, (("pressure_angle", "limit"),))
    title = "Free rotation of the wheel, the input standing still"
    ways, limit = ("forward", "backward"), (("play.forward", "limit"),)
    yield Plot("play", title, "play", "angle", ways, limit, unit="arcmin", whole=True)
    yield from stiffness_plots(result.tables)
    yield from assembly_plots(result.tables)
