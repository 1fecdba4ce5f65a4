"""Quantities given row by row in a CSV file, as the curves that a multibody model takes."""

import math
from pathlib import Path

import numpy as np

from drivewright.errors import InputError, SpecError
from drivewright.motion.tables import read_table
from drivewright.multibody.model import Curve, LoadCurve
from drivewright.numerics.splines import interpolating_spline
from drivewright.spec.csv_columns import read_columns

TURN = 2 * math.pi
OVER = {"time": "time", "angle": "angle", "speed": "angular speed"}  # what a load may depend on: column -> dimension
SLIDING = {"time": "time", "travel": "length", "velocity": "velocity"}  # what the force of an actuator may depend on
SMOOTH_ENDS = {"rest": ("clamped", 0), "free": ("natural", 1)}  # kind of spline, terms of the end pieces beyond the value


def load_curve(file: Path, what: str, dimension: str, periodic: bool = False) -> LoadCurve:
    """The Load of a CSV file: `what` over time, angle or speed, straight from row to row and level beyond the last.

    A table over a whole turn of the angle, or one called periodic, repeats itself.
    """
    rows = read_columns(file, OVER, {what: dimension})
    span = rows.x[-1] - rows.x[0]
    turns = rows.x_name == "angle" and math.isclose(span, TURN, rel_tol=1e-9)
    slopes = np.diff(rows.y) / np.diff(rows.x)
    curve = _curve(rows.x, np.column_stack([rows.y[:-1], slopes]), span if periodic or turns else 0.0)
    return LoadCurve(curve if curve.period else _with_ends(curve, rows.y[[0, -1]], (0.0, 0.0)), rows.x_name)


def actuator_curve(file: Path) -> LoadCurve:
    """The Load of an actuator's CSV file: force over time, travel or velocity of its slide, straight from row to row, level beyond."""
    rows = read_columns(file, SLIDING, {"force": "force"})
    slopes = np.diff(rows.y) / np.diff(rows.x)
    curve = _curve(rows.x, np.column_stack([rows.y[:-1], slopes]), 0.0)
    return LoadCurve(_with_ends(curve, rows.y[[0, -1]], (0.0, 0.0)), rows.x_name)


def delayed(curve: Curve, time: float) -> Curve:
    """A Curve over time that begins so much later [s]."""
    return Curve(curve.breaks + time, curve.coefficients, curve.period)


def profile_curve(file: Path, ends: str, joint: str = "revolute") -> Curve:
    """The Curve of a drive over time: a spline with continuous velocity.

    The angle of a revolute joint is counted from the first row, the travel of a prismatic joint or pin-slot from the point of its line.
    """
    rows = read_columns(file, {"time": "time"}, {"travel": "length"} if joint != "revolute" else {"angle": "angle"})
    kind, moving = SMOOTH_ENDS[ends]
    values = rows.y if joint != "revolute" else rows.y - rows.y[0]
    degree = 5 if kind == "clamped" and len(values) > 5 else 3
    spline = _spline(file, rows.x, values, degree, kind)
    speeds = moving * spline.derivative()(rows.x[[0, -1]])
    return _with_ends(_curve(rows.x, spline.c[::-1].T, 0.0), values[[0, -1]], speeds)


def lift_curve(file: Path) -> tuple[Curve, bool]:
    """(Curve over the cam's angle, whether the lift is an angle) of a CSV file of one turn."""
    rows = read_table(file)
    if rows.lift_unit is None or not math.isclose(rows.angle[-1] - rows.angle[0], TURN, rel_tol=1e-9):
        raise SpecError(
            f"the angle covers {math.degrees(rows.angle[-1] - rows.angle[0]):.6g}°; give the cam's lift over 360°", file=str(file)
        )
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
