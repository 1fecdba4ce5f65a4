"""Sparse markers that tell the lines of one panel apart without their colours."""

import numpy as np

from drivewright._typing import ArrayLike
from drivewright.view.palette import MARKERS

MARKED = 8  # markers along one line


def line_marker(number: int) -> str:
    """The marker of a panel's line of that number."""
    return MARKERS[number % len(MARKERS)]


def marked_rows(x: ArrayLike, y: ArrayLike, number: int, count: int, upright: bool = True) -> list[int]:
    """Rows of line `number` out of `count` that carry a marker: evenly spaced, each line beginning a little behind the one before.

    x, y (rows,): the points of the line, nan where it has a gap.  Even along x where x rises and the plot is `upright`, else along the
    path, to the scale of the range of either axis.
    """
    x, y = np.asarray(x, float), np.asarray(y, float)
    known = np.flatnonzero(np.isfinite(x) & np.isfinite(y))
    if len(known) < 2:
        return known.tolist()
    x, y = x[known], y[known]
    along = x if upright and np.all(np.diff(x) >= 0) else _path_length(x, y)
    wanted = along[0] + (np.arange(MARKED) + (number + 0.5) / count) / MARKED * (along[-1] - along[0])
    return sorted(set(known[np.searchsorted(along, wanted).clip(max=len(known) - 1)].tolist()))


def _path_length(x, y):
    """Length along the points (rows,), each axis over its range."""
    steps = [np.diff(each) / (np.ptp(each) or 1.0) for each in (x, y)]
    return np.concatenate([[0.0], np.cumsum(np.hypot(*steps))])
