"""Do the rows of a table carry enough digits?  A spline goes through every one of them, rounding included.

A lift rounded to r, sampled every h, makes the acceleration of an interpolating spline wrong by about r/h^2: finer
sampling makes it worse.  A smoothing spline, its softness chosen by generalised cross-validation, tells scatter from motion.
"""

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
            f"the table's rows scatter by {self.scatter:.2g} (rms, SI) about a smooth curve, as rounded data do; the acceleration of "
            f"the spline through them ripples by {self.acceleration:.0%}. Give the lifts with more digits, or fewer rows."
        )


def ripple(x: Floats, y: Floats, function: Piecewise) -> Ripple:
    """`Ripple` of rows x, y on 0..1 against the interpolating `Piecewise` function, closed or at rest beyond its ends."""
    smooth = _smoothed(x, y, function.closed)
    acceleration, wanted = function(x).a, smooth(x, nu=2)
    size = np.sqrt(np.mean(wanted**2))
    difference = np.sqrt(np.mean((acceleration - wanted) ** 2))
    return Ripple(float(np.sqrt(np.mean((smooth(x) - y) ** 2))), float(difference / size) if size > 0 else 0.0)


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
