"""Boundary dimensions and clearance classes of metric rolling bearings by series and bore, from tables, read at the first look-up."""

import tomllib
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from drivewright.bearings.inner_geometry import BearingType

PER_METRE_MM, PER_METRE_UM = 1e3, 1e6  # divided by, 72 mm are 0.072 m to the last digit
CLEARANCE_CLASSES = ("C2", "CN", "C3", "C4", "C5")
SAME_DIMENSIONS = {"70": "60", "72": "62", "73": "63"}  # angular-contact and deep-groove bearings share a dimension series


class BoundaryDimensions(NamedTuple):
    """Bore, outer diameter, width (of a tapered bearing the assembled one, T); raceways of the inner and the outer ring of cylindrical
    roller bearings, else 0 [m]; contact angle of tapered ones, else 0 [rad]."""

    bore: float
    outer_diameter: float
    width: float
    inner_raceway: float = 0.0
    outer_raceway: float = 0.0
    contact_angle: float = 0.0


@cache
def boundary_dimensions(kind: BearingType, series: str) -> dict[str, BoundaryDimensions]:
    """The `BoundaryDimensions` of a type and series, e.g. "deep-groove" and "62", by the bore code of the designation: "00" to "20"."""
    if kind == "angular-contact":
        return boundary_dimensions("deep-groove", SAME_DIMENSIONS[series])
    read = _tapered if kind == "tapered" else _metres
    return {bore_code(row[0]): read(row) for row in _table("boundary_dimensions")[kind][series]["rows"]}


def known_series() -> dict[BearingType, tuple[str, ...]]:
    """The series of every type."""
    tables = _table("boundary_dimensions")
    kinds: tuple[BearingType, ...] = ("deep-groove", "cylindrical", "tapered")
    return {**{kind: tuple(tables[kind]) for kind in kinds}, "angular-contact": tuple(SAME_DIMENSIONS)}


def clearance_range(kind: BearingType, bore: float, clearance_class: str) -> tuple[float, float] | None:
    """Least and most radial clearance across the diameter [m] of a class for a bore [m]; None where no table states it."""
    rows = _table("internal_clearance").get(kind, {"rows": ()})["rows"]
    place = 1 + 2 * CLEARANCE_CLASSES.index(clearance_class)
    for row in rows:
        if bore <= row[0] / PER_METRE_MM:
            return row[place] / PER_METRE_UM, row[place + 1] / PER_METRE_UM
    return None


def bore_code(bore: float) -> str:
    """The last two figures of a designation by its bore [mm]: 00 to 03 for 10, 12, 15 and 17 mm, then a fifth of it."""
    small = {10: "00", 12: "01", 15: "02", 17: "03"}
    return small.get(int(bore)) or f"{int(bore) // 5:02d}"


def _metres(row):
    return BoundaryDimensions(*(value / PER_METRE_MM for value in row))


def _tapered(row):
    """e = 1.5 tan(contact angle) is what makers print of the angle."""
    return BoundaryDimensions(*(value / PER_METRE_MM for value in row[:3]), contact_angle=float(np.arctan(row[5] / 1.5)))


@cache
def _table(name):
    return tomllib.loads(Path(__file__).with_name(f"{name}.toml").read_text(encoding="utf-8"))
