"""Quantities given row by row in a CSV file, as the curves that a multibody model takes."""

import csv
import math
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from drivewright.errors import InputError, SpecError, UnitError
from drivewright.motion.tables import read_table
from drivewright.multibody.model import Curve, Load
from drivewright.numerics.splines import interpolating_spline
from drivewright.units import unit_factor

TURN = 2 * math.pi
OVER = {"time": "time", "angle": "angle", "speed": "angular speed"}  # what a load may depend on: column -> dimension
PURE = "a pure number"
SMOOTH_ENDS = {"rest": ("clamped", 0), "free": ("natural", 1)}  # kind of spline, terms of the end pieces beyond the value


class Rows(NamedTuple):
    """Two columns of a file by name, SI."""

    over: str
    x: np.ndarray
    what: str
    y: np.ndarray


def load_curve(file, what, dimension, periodic=False):
    """The Load of a CSV file: `what` over time, angle or speed, straight from row to row and level beyond the last.

    A table over a whole turn of the angle, or one called periodic, repeats itself.
    """
    rows = read_rows(file, OVER, {what: dimension})
    span = rows.x[-1] - rows.x[0]
    turns = rows.over == "angle" and math.isclose(span, TURN, rel_tol=1e-9)
    slopes = np.diff(rows.y) / np.diff(rows.x)
    curve = _curve(rows.x, np.column_stack([rows.y[:-1], slopes]), span if periodic or turns else 0.0)
    return Load(curve if curve.period else _with_ends(curve, rows.y[[0, -1]], (0.0, 0.0)), rows.over)


def profile_curve(file, ends, joint="revolute"):
    """The Curve of a drive over time: a spline with continuous velocity.

    The angle of a revolute joint is counted from the first row, the travel of a prismatic one from the point of its line.
    """
    rows = read_rows(file, {"time": "time"}, {"travel": "length"} if joint == "prismatic" else {"angle": "angle"})
    kind, moving = SMOOTH_ENDS[ends]
    values = rows.y if joint == "prismatic" else rows.y - rows.y[0]
    degree = 5 if kind == "clamped" and len(values) > 5 else 3
    spline = _spline(file, rows.x, values, degree, kind)
    speeds = moving * spline.derivative()(rows.x[[0, -1]])
    return _with_ends(_curve(rows.x, spline.c[::-1].T, 0.0), values[[0, -1]], speeds)


def lift_curve(file):
    """(Curve over the cam's angle, whether the lift is an angle) of a CSV file of one turn."""
    rows = read_table(file)
    if rows.lift_unit is None or not math.isclose(rows.angle[-1] - rows.angle[0], TURN, rel_tol=1e-9):
        raise SpecError(f"the angle runs over {math.degrees(rows.angle[-1] - rows.angle[0]):.6g} deg; a cam's lift is given over 360 deg",
                        file=str(file))
    return _curve(rows.angle, _spline(file, rows.angle, rows.lift, 5, "periodic").c[::-1].T, TURN), rows.lift_unit == "rad"


def _spline(file, x, y, degree, ends):
    try:
        return interpolating_spline(x, y, degree, ends)
    except InputError as error:
        raise SpecError(str(error), file=str(file)) from None


def _curve(breaks, coefficients, period):
    full = np.zeros((len(coefficients), 6))
    full[:, : coefficients.shape[1]] = coefficients
    return Curve(np.asarray(breaks, dtype=float), full, float(period))


def _with_ends(curve, values, slopes):
    """The curve with a straight piece before its first and after its last break; slopes are those at the breaks."""
    first, last = curve.breaks[[0, -1]]
    width = last - first
    before, after = [values[0] - slopes[0] * width, slopes[0], 0, 0, 0, 0], [values[1], slopes[1], 0, 0, 0, 0]
    return Curve(np.concatenate([[first - width], curve.breaks, [last + width]]), np.vstack([before, curve.coefficients, after]))


# -- reading -------------------------------------------------------------------------------------------------------------------


def read_rows(file, over, what):
    """The `Rows` of a CSV file with one column of `over` and one of `what`, each name -> dimension; x must increase."""
    try:
        lines = Path(file).read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise SpecError(f"cannot be read: {getattr(error, 'strerror', None) or error}", file=str(file)) from None
    reader = csv.reader(lines)
    header = next(reader, [])
    columns = [_column(header, names, file) for names in (over, what)]
    numbers = [[_number(cells, index, f"line {reader.line_num}", name, file) for index, name, _ in columns] for cells in reader if cells]
    table = np.array(numbers, dtype=float).reshape(-1, 2) * [factor for _, _, factor in columns]
    _refuse_disorder(table, columns[0][1], file)
    return Rows(columns[0][1], table[:, 0], columns[1][1], table[:, 1])


def _column(header, names, file):
    """(index, name, factor to SI) of the first column that has one of the names."""
    for index, cell in enumerate(header):
        match = re.fullmatch(r"\s*([a-z]+)\s*(?:\[(.+)\])?\s*", cell, re.IGNORECASE)
        if match and match[1].lower() in names:
            return index, match[1].lower(), _factor(match[2], names[match[1].lower()], match[1], file)
    wanted = " or ".join(repr(name if dimension == PURE else f"{name} [unit]") for name, dimension in names.items())
    raise SpecError(f"no column {wanted} in the first line {','.join(header)!r}", file=str(file))


def _factor(unit, dimension, name, file):
    if dimension == PURE:
        return 1.0
    try:
        return unit_factor(unit or "", dimension)
    except UnitError as error:
        raise error.located(key=f"column '{name}'", file=str(file)) from None


def _number(cells, index, place, name, file):
    try:
        number = float(cells[index])
    except (ValueError, IndexError):
        number = math.nan
    if not math.isfinite(number):
        got = repr(cells[index]) if index < len(cells) else "nothing"
        raise SpecError(f"{place}: the {name} is {got}, not a finite number", file=str(file))
    return number


def _refuse_disorder(table, name, file):
    if len(table) < 2:
        raise SpecError(f"{len(table)} rows are too few; give at least 2", file=str(file))
    if np.any(np.diff(table[:, 0]) <= 0):
        row = int(np.argmax(np.diff(table[:, 0]) <= 0)) + 2
        raise SpecError(f"row {row}: the {name} must increase from row to row; sort the rows and drop repeats", file=str(file))
