"""The plots of an indexing drive; they depend on what was computed."""

from collections.abc import Iterator
from typing import Any

from drivewright.indexing.solid.tables import assembly_plots
from drivewright.indexing.stiffness.tables import stiffness_plots
from drivewright.mechanisms.indexer.geometry import SUFFIXES
from drivewright.result import Plot, Result


def plots(result: Result[Any]) -> tuple[Plot, ...]:
    """All plots whose table the result has."""
    return tuple(plot for plot in _all(result) if plot.table in result.tables)


def _all(result: Result[Any]) -> Iterator[Plot]:
    yield Plot("motion", "Motion of the wheel", "motion", "angle", ("wheel", "rate", "bend", "third"))
    yield Plot("drive_torque", "Torque on the table and at the input", "drive", "angle", ("table_torque", "input_torque"))
    yield Plot("drive_power", "Power at the input", "drive", "angle", ("input_power",))
    for suffix, which in SUFFIXES.items():
        if f"profile{suffix}" in result.tables and "z" not in [column.name for column in result.tables["profile"].columns]:
            yield Plot(f"profile{suffix}", f"Cam profile{which}", f"profile{suffix}", "x", ("y",), equal=True)
    yield Plot("curvature", "Curvature of the cam profile", "profile", "angle", ("curvature",), style="points")
    yield Plot("contacts", "Contacts by direction of push", "contacts", "angle", ("pins", "forward", "backward"))
    pushed, meaning = ("pin_forward", "pin_backward"), "Pins in contact with one cam, by the direction in which it can push them."
    yield Plot("contact_map", "Contact map of one cam", "contact_points", "angle", pushed, style="points", meaning=meaning)
    yield Plot("levers", "Moment arms of the contacts", "contact_points", "angle", ("arm",), style="points")
    if "contacts" in result.tables:
        angles = tuple(column.name for column in result.tables["contacts"].columns if column.name.startswith("pressure_angle"))
        yield Plot("pressure_angle", "Pressure angle", "contacts", "angle", angles, (("pressure_angle", "limit"),))
    ways, limit, meaning = ("forward", "backward"), (("play.forward", "limit"),), "Free rotation of the wheel with the input locked."
    yield Plot("play", "Play of the wheel", "play", "angle", ways, limit, unit="arcmin", whole=True, meaning=meaning)
    yield from stiffness_plots(result.tables)
    yield from assembly_plots(result.tables)
