"""Motion given row by row: a CSV file or arrays of angle and absolute lift."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import InputError, SpecError
from drivewright.motion.laws import MotionLaw, register
from drivewright.motion.piecewise import CLOSURE
from drivewright.motion.ripple import Ripple, Rounding, Smoothing, ripple, rms_jerk, rounding
from drivewright.motion.splines import LEAST_POINTS, of_spline, refuse_disorder, through_points
from drivewright.numerics.smoothing import smoothest_within
from drivewright.spec import csv_words
from drivewright.spec.csv_headings import Wanted
from drivewright.spec.csv_table import read_csv
from drivewright.spec.length_or_angle import AngleGiven

LEAST_SMOOTHED = 7  # rows
GAP = 1.5  # times the usual step
ROUNDED = 0.35  # of the usual step, by which rounded angles depart from it: 0.3, 0.7, 1.0 deg are thirds
EVEN = 0.9  # part of the steps that are the usual one in an even table
MOST_NAMED = 5  # gaps
ANGLES = ("cam angle", "camshaft angle", "theta", "phi", "rotation", "cam", *csv_words.ANGLE, *csv_words.CAM_ANGLE)
LIFTS = ("displacement", "rise", "stroke", "travel", "position", "swing", "s", "y", *csv_words.LIFT, *csv_words.TRAVEL)
ANGLE = Wanted("angle", {"angle": "deg"}, ANGLES, csv_words.CRANK_ANGLE)
LIFT = Wanted("lift", {"length": "mm", "angle": "deg"}, LIFTS)


@dataclass(frozen=True, eq=False)
class TableLaw(MotionLaw):
    """A motion law through rows of angle [rad] and lift, `lift_unit` "m" or "rad" (None: not said).  Its s is the lift itself."""

    rows: Floats | None = field(default=None, repr=False)  # (n, 2): u and lift
    lift_unit: str | None = None
    digit: float = 0.0  # step of the last printed digit of the lift; 0 where it is not known
    smoothing: Smoothing | None = None

    @property
    def findings(self) -> Iterator[str]:
        """Where rows are missing; what rounding does to acceleration and jerk, or what the smoothing did."""
        assert self.rows is not None
        yield from missing_rows((self.span or 1.0) * self.rows[:, 0])
        if self.smoothing:
            yield self.smoothing.message(self.lift_unit)
            return
        yield from (message for message in (self.ripple.message, self.rounding.message(self.lift_unit)) if message)

    @cached_property
    def rounding(self) -> Rounding:
        """What the last printed digit of the rows does to the jerk."""
        assert self.rows is not None
        u, lift = self.rows.T
        return rounding(u, lift, self.digit, self.function)

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
    digit: float = 0.0  # step of the last digit of the lift; 0 where it is not known


@register("table")
def _table(file=None, angle=None, lift=None, degree=5, ends=None, band=None, rows=None):
    """Spline through the rows of a CSV file (header "angle [deg],lift [mm]"), of two arrays in SI, or through rows (angle, lift) in SI.

    The angle runs from 0; the lift is absolute.  `ends` unless given: "periodic" over a full turn, otherwise "clamped" (v = a = 0).
    With a `band` [m or rad] the smoothest lift within the band of every row (`numerics.smoothing`) instead of the spline through them.
    """
    if sum(given is not None for given in (file, rows, angle)) != 1 or (angle is None) != (lift is None):
        raise InputError("motion law 'table': give either a file, or the arrays angle [rad] and lift [m or rad], or rows (angle, lift).")
    rows = read_table(file) if file is not None else _from_rows(rows) if rows is not None else _from_arrays(angle, lift)
    _refuse_rows(rows)
    span = float(rows.angle[-1])
    ends = ends or ("periodic" if math.isclose(span, 2 * math.pi, rel_tol=CLOSURE) else "clamped")
    if ends == "periodic":
        _refuse_open(rows)
    u = rows.angle / span
    function = through_points(u, rows.lift, degree, ends, rows.what)
    law = TableLaw("table", function, span, np.column_stack([u, rows.lift]), rows.lift_unit, rows.digit)
    if rows.lift_unit is not None and band is not None and isinstance(band, AngleGiven) == (rows.lift_unit == "m"):
        raise InputError(f"{rows.what}: the band must be {'a length' if rows.lift_unit == 'm' else 'an angle'}, as the lifts of the table.")
    return law if band is None else _smoothed(law, float(band), degree, ends, rows.what)


def _smoothed(law, band, degree, ends, what):
    """The law with the smoothest lift within a band of the rows."""
    u, lift = law.rows.T
    if degree != 5:
        raise InputError(
            f"{what}: degree {degree} is given with a band, but the smoothest lift within it has degree 5; leave the degree out."
        )
    if len(u) < LEAST_SMOOTHED:
        raise InputError(f"{what}: {len(u)} rows are too few to smooth; give at least {LEAST_SMOOTHED}, or leave the band out.")
    if band >= 0.5 * np.ptp(lift):
        raise InputError(f"{what}: the band of {band:.6g} (SI) is half the stroke of {np.ptp(lift):.6g} or more; give a narrower one.")
    spline = smoothest_within(u, lift, band, ends == "periodic")
    smooth = of_spline(spline, u, degree, ends == "periodic")
    at = [rms_jerk(function) for function in (smooth, law.function)]
    found = Smoothing(band, float(np.max(np.abs(spline(u) - lift))), at[0] / at[1] if at[1] else 1.0, len(u))
    return replace(law, function=smooth, smoothing=found)


def read_table(file: str | Path) -> Rows:
    """The `Rows` of a CSV file; columns "angle [unit]" and "lift [unit]", others are left alone."""
    table = read_csv(Path(file), (ANGLE, LIFT), (("angle",), ("lift",)))
    if ANGLE.is_mistaken(heading := table.columns["angle"].heading) or "crank" in heading.lower():
        raise SpecError(
            f"the column {heading!r} is no cam angle: the cam of a four-stroke engine turns half as far; give the cam angle, as "
            f"{ANGLE.heading!r}: half of these, or, where the cam turns with the crank, these",
            file=table.file,
        )
    unit = "m" if table.columns["lift"].dimension == "length" else "rad"
    places = [f"row {number} (line {line})" for number, line in enumerate(table.lines, 1)]
    return Rows(table.numbers("angle"), table.numbers("lift"), unit, f"table '{file}'", places, table.last_digit("lift"))


def missing_rows(angle: Floats) -> Iterator[str]:
    """A sentence on the gaps of otherwise even rows of angle (n,) [rad]: steps of `GAP` times the usual one or more.

    Rows are even where the part `EVEN` of the steps is within `ROUNDED` of their median; of uneven ones, which have no usual step, nothing
    is said.
    """
    step = np.diff(angle)
    usual = float(np.median(step))
    wide = np.flatnonzero(step > GAP * usual)
    if not len(wide) or np.mean(np.abs(step - usual) <= ROUNDED * usual) < EVEN:
        return
    degrees = np.degrees(angle)
    places = [f"{degrees[k]:.6g} to {degrees[k + 1]:.6g}°" for k in wide[:MOST_NAMED]]
    more = f" and {len(wide) - len(places)} more" if len(wide) > len(places) else ""
    yield (
        f"rows of the table are missing from {', '.join(places)}{more}: elsewhere there is one every {math.degrees(usual):.4g}°. "
        "The lift there is that of the spline, not measured; give the missing rows, or check the motion there"
    )


def _from_arrays(angle, lift):
    angle, lift = np.asarray(angle, dtype=float), np.asarray(lift, dtype=float)
    if angle.ndim != 1 or angle.shape != lift.shape:
        raise InputError(f"motion law 'table': angle and lift must be two rows of equal length, got shapes {angle.shape} and {lift.shape}.")
    return Rows(angle, lift, None, "motion law 'table'", [f"row {k + 1}" for k in range(len(angle))])


def _from_rows(rows):
    """Rows (angle, lift) as a spec has them: lifts that are angles are `AngleGiven`."""
    angular = [isinstance(lift, AngleGiven) for _, lift in rows]
    for k in [k for k, own in enumerate(angular) if own != angular[0]][:1]:
        first, other = ("an angle", "a length") if angular[0] else ("a length", "an angle")
        raise InputError(f"motion law 'table', row {k + 1}: the lift is {other}, but that of the first row {first}; give all in one kind.")
    angle, lift = (np.array([float(row[column]) for row in rows]) for column in (0, 1))
    unit = ("rad" if angular[0] else "m") if angular else None
    return Rows(angle, lift, unit, "motion law 'table'", [f"row {k + 1}" for k in range(len(rows))])


def _refuse_rows(rows):
    if len(rows.angle) < LEAST_POINTS:
        raise InputError(f"{rows.what}: {len(rows.angle)} rows are too few for a spline; give at least {LEAST_POINTS}.")
    refuse_disorder(np.degrees(rows.angle), rows.lift, rows.what, rows.places, "the angle in deg")
    if rows.angle[0] != 0:
        raise InputError(
            f"{rows.what}, {rows.places[0]}: the angle starts at {math.degrees(rows.angle[0]):.9g}°; "
            f"it is counted from the start of the segment, so start at 0: take {math.degrees(rows.angle[0]):.9g}° off every angle."
        )


def _refuse_open(rows):
    gap, stroke = rows.lift[-1] - rows.lift[0], np.ptp(rows.lift)
    if abs(gap) > CLOSURE * stroke:
        raise InputError(
            f"{rows.what}: the first and the last row disagree: the lift starts at {rows.lift[0]:.9g} and ends at "
            f"{rows.lift[-1]:.9g} ({gap:+.3g}, SI), so the cycle does not close. Repeat the first lift in the last row."
        )
