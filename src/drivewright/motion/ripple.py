"""Whether the rows of a table carry enough digits: a spline passes through every one of them, rounding included.

The last printed digit says how far each row may be off, evenly within half a step: rms q/sqrt(12).  `rounding` is what that makes of the
jerk; `ripple` asks the rows themselves:

A lift rounded to r, sampled every h, makes the acceleration of an interpolating spline wrong by about r/h^2: finer
sampling makes it worse.  A smoothing spline, its softness chosen by generalised cross-validation, tells scatter from motion.
"""

from functools import cache
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.motion.piecewise import Piecewise

LIMIT = 0.2  # part of the acceleration; sampled smooth laws stay below it from 12 rows a turn on
MARGIN = 12  # rows added at either end, so that the ends are smoothed like the rest


class Ripple(NamedTuple):
    """rms scatter of the rows about a smooth curve [unit of the lift] and rms ripple as part of the rms smooth acceleration."""

    scatter: float
    acceleration: float

    @property
    def significant(self) -> bool:
        """True where the ripple is too large to build from."""
        return self.acceleration > LIMIT

    @property
    def message(self) -> str:
        """The finding in a sentence; empty where there is nothing to say."""
        if not self.significant:
            return ""
        return (
            f"the rows of the table scatter by {self.scatter:.2g} (RMS, SI) about a smooth curve, as rounded data do; this makes a ripple "
            f"of {self.acceleration:.0%} in the acceleration of the spline through them. Give the lifts with more digits, or fewer rows."
        )


def ripple(x: Floats, y: Floats, function: Piecewise) -> Ripple:
    """`Ripple` of rows x, y on 0..1 against the interpolating `Piecewise` function, closed or at rest beyond its ends."""
    smooth = _smoothed(x, y, function.closed)
    acceleration, wanted = function(x).a, smooth(x, nu=2)
    size = np.sqrt(np.mean(wanted**2))
    difference = np.sqrt(np.mean((acceleration - wanted) ** 2))
    return Ripple(float(np.sqrt(np.mean((smooth(x) - y) ** 2))), float(difference / size) if size > 0 else 0.0)


class Smoothing(NamedTuple):
    """What smoothing within a band did: band and largest departure from a row [unit of the lift], rms jerk over that of the spline through
    all rows, number of rows."""

    band: float
    departure: float
    jerk: float
    rows: int

    def message(self, unit: str | None) -> str:
        """The finding in a sentence."""
        return (
            f"the table is smoothed: its lift is the one with the least integral of the squared jerk within {_length(self.band, unit)} of "
            f"each of its {self.rows} rows. The maximum deviation is {_length(self.departure, unit)}, the RMS jerk {self.jerk:.2g} times "
            "that of a spline through all rows"
        )


class Rounding(NamedTuple):
    """Step of the last digit and spacing of the rows [unit of the lift, part of the table's span], rms jerk that rounding makes and that of
    the motion itself [unit of the lift per span^3]."""

    digit: float
    spacing: float
    jerk: float
    wanted: float

    @property
    def share(self) -> float:
        """Jerk of rounding over that of the motion."""
        return self.jerk / self.wanted if self.wanted > 0 else 0.0

    def message(self, unit: str | None) -> str:
        """The finding in a sentence; empty where rounding does not show."""
        if not self.share > LIMIT:
            return ""
        return (
            f"the lifts of the table are rounded to {_length(self.digit, unit)}: with rows so close, the rounding alone causes an RMS jerk "
            f"of {self.share:.2g} times that of the motion. Give more digits or fewer rows, or smooth the lifts with "
            f'band = "{_length(0.5 * self.digit, unit)}", half the last digit'
        )


def _length(value, unit):
    factor, shown = (1e3, "mm") if unit == "m" else (180 / np.pi, "deg") if unit == "rad" else (1.0, "(SI)")
    return f"{factor * value:.4g} {shown}"


def rounding(x: Floats, y: Floats, digit: float, function: Piecewise) -> Rounding:
    """`Rounding` of rows x, y on 0..1 printed to a digit, against the interpolating `Piecewise` function.

    Independent errors of rms q/sqrt(12) make the third derivative of the spline through them wrong by `gain` q/(sqrt(12) h^3) rms, h the
    spacing of the rows; the motion's own jerk is that of the smoothing spline.  Without a digit there is nothing to compare it with.
    """
    spacing = np.diff(x)
    if digit == 0:
        return Rounding(0.0, float(np.mean(spacing)), 0.0, 0.0)
    near = float(np.sqrt(np.average(spacing**-6.0, weights=spacing)))
    wanted = _smoothed(x, y, function.closed)(np.linspace(0, 1, 20 * len(x)), nu=3)
    jerk = digit / np.sqrt(12) * jerk_gain(function.poly.shape[1] - 1) * near
    return Rounding(digit, float(np.mean(spacing)), jerk, float(np.sqrt(np.mean(wanted**2))))


@cache
def jerk_gain(degree: int) -> float:
    """Rms third derivative of an interpolating spline of a degree through independent unit errors at unit spacing.

    sqrt(int (d3L/dx3)^2 dx) of the cardinal spline L, which is 1 at one row and 0 at all others: each row adds its own L.
    """
    from scipy.interpolate import make_interp_spline

    rows = np.arange(65.0)
    cardinal = make_interp_spline(rows, np.where(rows == 32, 1.0, 0.0), k=degree, bc_type="periodic")
    node, weight = np.polynomial.legendre.leggauss(4)
    third = cardinal(rows[:-1, None] + 0.5 * (1 + node), nu=3)
    return float(np.sqrt(np.sum(0.5 * weight * third**2)))


def rms_jerk(function: Piecewise) -> float:
    """Root of the mean square of the third derivative over 0..1."""
    node, weight = np.polynomial.legendre.leggauss(4)
    pieces = np.arange(function.count)[:, None]
    width = np.diff(function.breaks)[:, None]
    third = function.on_piece(pieces, function.breaks[:-1, None] + 0.5 * width * (1 + node)).j
    return float(np.sqrt(np.sum(0.5 * width * weight * third**2)))


def _smoothed(x, y, closed):
    from scipy.interpolate import BSpline, make_smoothing_spline

    rows, step = min(MARGIN, len(x) - 1), 1 / (len(x) - 1)
    if closed:
        x, y = np.concatenate([x[-rows - 1 : -1] - 1, x, x[1 : rows + 1] + 1]), np.concatenate([y[-rows - 1 : -1], y, y[1 : rows + 1]])
    else:
        beyond = step * np.arange(1, rows + 1)
        x, y = np.concatenate([-beyond[::-1], x, 1 + beyond]), np.pad(y, rows, mode="edge")
    # In units of the mean step, because the search for the softness spans 0 .. number of rows in the abscissa's own unit.
    spline = make_smoothing_spline(x / step, y)
    return BSpline(spline.t * step, spline.c, spline.k)
