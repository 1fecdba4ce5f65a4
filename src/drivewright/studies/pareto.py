"""Designs that no other design beats in every objective."""

from bisect import bisect_right
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from drivewright._typing import Bools, Floats

FRONT, DOMINATED, FAILS, ABSENT = "front", "dominated", "fails", "absent"


def classify_designs(columns: Sequence[Floats], goals: Iterable[str], passes: Bools) -> NDArray[np.object_]:
    """(n,) texts: front, dominated, fails (a limit; such a design beats nobody), or absent where an objective has no number.

    `columns`: an array (n,) for each objective; `goals`: minimise or maximise for each; `passes` (n,) whether every limit is kept.
    """
    signs = [{"minimise": 1.0, "maximise": -1.0}[goal] for goal in goals]
    points = np.stack([sign * np.asarray(column, dtype=float) for column, sign in zip(columns, signs, strict=True)], axis=1)
    present = np.all(np.isfinite(points), axis=1)
    classes = np.where(present, FAILS, ABSENT).astype(object)
    rows = np.flatnonzero(present & passes)
    classes[rows] = np.where(nondominated(points[rows]), FRONT, DOMINATED)
    return classes


def nondominated(points: Floats) -> Bools:
    """(n,) whether a point (n, m), to be made small, has no other that is nowhere greater and somewhere smaller; equal points share it.

    The distinct points in ascending order of all columns can be dominated by earlier ones only; n log n for two and three objectives.
    """
    if not len(points):
        return np.zeros(0, dtype=bool)
    rows, place = np.unique(points, axis=0, return_inverse=True)
    sieve = {1: _first, 2: _descending, 3: _staircase}.get(rows.shape[1], _sieved)
    return sieve(rows)[np.ravel(place)]


def _first(rows):
    return np.arange(len(rows)) == 0


def _descending(rows):
    """Those whose second column is below that of all earlier ones."""
    lowest = np.minimum.accumulate(rows[:, 1])
    return np.concatenate([[True], rows[1:, 1] < lowest[:-1]])


def _staircase(rows):
    """Those below the stairs that the second and third columns of the earlier ones make: steps of rising y and falling z."""
    ys, zs, front = [], [], np.zeros(len(rows), dtype=bool)
    for number, (y, z) in enumerate(rows[:, 1:].tolist()):
        place = bisect_right(ys, y)
        if place and zs[place - 1] <= z:
            continue
        front[number] = True
        end = place
        while end < len(zs) and zs[end] >= z:
            end += 1
        ys[place:end], zs[place:end] = [y], [z]
    return front


def _sieved(rows):
    """Those left when each in turn has removed what it dominates."""
    left, at = np.arange(len(rows)), 0
    while at < len(left):
        keep = np.any(rows[left] < rows[left[at]], axis=1)
        keep[: at + 1] = True
        left, at = left[keep], at + 1
    return np.isin(np.arange(len(rows)), left)
