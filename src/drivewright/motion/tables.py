"""Motion given row by row: a CSV file or arrays of angle and absolute lift."""

import math
import re
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import InputError, SpecError, UnitError, brief
from drivewright.motion.laws import MotionLaw, register
from drivewright.motion.piecewise import CLOSURE
from drivewright.motion.ripple import Ripple, ripple
from drivewright.motion.splines import LEAST_POINTS, refuse_disorder, through_points
from drivewright.spec.csv_text import csv_rows, read_data_file
from drivewright.units import unit_factor

HEADER = "angle [deg],lift [mm]"


@dataclass(frozen=True, eq=False)
class TableLaw(MotionLaw):
    """A motion law through rows of angle [rad] and lift, `lift_unit` "m" or "rad" (None: not said).  Its s is the lift itself."""

    rows: Floats | None = field(default=None, repr=False)  # (n, 2): u and lift
    lift_unit: str | None = None

    @cached_property
    def ripple(self) -> Ripple:
        """What rounding of the rows does to the acceleration: a `Ripple`."""
        assert self.rows is not None
        u, lift = self.rows.T
        return ripple(u, lift, self.function)


class Rows(NamedTuple):
    """Columns in SI, and where each row was read."""

    angle: Floats
    lift: Floats
    lift_unit: str | None
    what: str
    places: list[str]


@register("table")
def _table(file=None, angle=None, lift=None, degree=5, ends=None):
    """Spline through the rows of a CSV file (header "angle [deg],lift [mm]") or of two arrays in SI.

    The angle runs from 0; the lift is absolute.  `ends` unless given: "periodic" over a full turn, otherwise "clamped" (v = a = 0).
    """
    if (file is None) == (angle is None) or (angle is None) != (lift is None):
        raise InputError("motion law 'table': give either a file, or the arrays angle [rad] and lift [m or rad].")
    rows = read_table(file) if file is not None else _from_arrays(angle, lift)
    _refuse_rows(rows)
    span = float(rows.angle[-1])
    ends = ends or ("periodic" if math.isclose(span, 2 * math.pi, rel_tol=CLOSURE) else "clamped")
    if ends == "periodic":
        _refuse_open(rows)
    u = rows.angle / span
    function = through_points(u, rows.lift, degree, ends, rows.what)
    return TableLaw("table", function, span, np.column_stack([u, rows.lift]), rows.lift_unit)


def read_table(file: str | Path) -> Rows:
    """The `Rows` of a CSV file; columns "angle [unit]" and "lift [unit]", others are left alone."""
    path = Path(file)
    what = f"table '{path}'"
    try:
        rows = list(csv_rows(read_data_file(path).splitlines(), path))
    except SpecError as error:
        raise InputError(f"{what} {error.message}.") from None
    header = rows[0][1] if rows else []
    columns = [_column(name, header, what) for name in ("angle", "lift")]
    factors = (_factor(columns[0], ("angle",), path)[0], *_factor(columns[1], ("length", "angle"), path))
    numbers, places = [], []
    for line, cells in rows[1:]:
        place = f"row {len(places) + 1} (line {line})"
        numbers.append([_number(cells, index, f"{what}, {place}", name) for (index, name, _) in columns])
        places.append(place)
    values = np.array(numbers).reshape(-1, 2)
    return Rows(values[:, 0] * factors[0], values[:, 1] * factors[1], "m" if factors[2] == "length" else "rad", what, places)


def _column(name, header, what):
    """(index, name, unit) of a column."""
    for index, cell in enumerate(header):
        if match := re.fullmatch(rf"\s*{name}\s*\[(.+)\]\s*", cell, re.IGNORECASE):
            return index, name, match[1]
    raise InputError(f"{what}: no column '{name} [unit]' in the first line {brief(','.join(header))}; it should read {HEADER!r}.")


def _factor(column, dimensions, path):
    """(factor to SI, dimension) of a column's unit, by the first dimension that fits."""
    _, name, unit = column
    *others, last = dimensions
    for dimension in others:
        try:
            return unit_factor(unit, dimension), dimension
        except UnitError:
            continue
    try:
        return unit_factor(unit, last), last
    except UnitError as error:
        raise error.located(key=f"column '{name}'", file=path) from None


def _number(cells, index, where, name):
    try:
        return float(cells[index])
    except (ValueError, IndexError):
        got = brief(cells[index]) if index < len(cells) else "nothing"
        raise InputError(f"{where}: the {name} is {got}, not a number.") from None


def _from_arrays(angle, lift):
    angle, lift = np.asarray(angle, dtype=float), np.asarray(lift, dtype=float)
    if angle.ndim != 1 or angle.shape != lift.shape:
        raise InputError(f"motion law 'table': angle and lift must be two rows of equal length, got shapes {angle.shape} and {lift.shape}.")
    return Rows(angle, lift, None, "motion law 'table'", [f"row {k + 1}" for k in range(len(angle))])


def _refuse_rows(rows):
    if len(rows.angle) < LEAST_POINTS:
        raise InputError(f"{rows.what}: {len(rows.angle)} rows are too few for a spline; give at least {LEAST_POINTS}.")
    refuse_disorder(np.degrees(rows.angle), rows.lift, rows.what, rows.places, "the angle in deg")
    if rows.angle[0] != 0:
        raise InputError(
            f"{rows.what}, {rows.places[0]}: the angle starts at {math.degrees(rows.angle[0]):.9g} deg; "
            "it is counted from the start of the segment, so start at 0."
        )


def _refuse_open(rows):
    gap, stroke = rows.lift[-1] - rows.lift[0], np.ptp(rows.lift)
    if abs(gap) > CLOSURE * stroke:
        raise InputError(
            f"{rows.what}: the first and the last row disagree: the lift starts at {rows.lift[0]:.9g} and ends at "
            f"{rows.lift[-1]:.9g} ({gap:+.3g}, SI), so the cycle does not close. Repeat the first lift in the last row."
        )
