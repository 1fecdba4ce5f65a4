"""Where words in a chart find room: beside the curves, not upon them."""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from drivewright._typing import Floats

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LETTER, LINE = 0.0085, 0.07  # of the axes' width and height that a letter and a line of words take
UPRIGHT = 0.03  # of the axes' width that upright words take
DENSE = 400  # points of a curve that are looked at


class Place(NamedTuple):
    """Where words begin, as fractions of the axes, and where they go from there: 1 or -1 for right or left, and for above or below."""

    x: float
    y: float
    right: int
    up: int


class Room:
    """The points of a chart that are taken, as fractions of its axes; what is placed is taken too."""

    def __init__(self, axis: "Axes", lines: Iterable[tuple[Floats, Floats]]) -> None:
        self._to_fraction = axis.transData + axis.transAxes.inverted()
        self._slimness = axis.bbox.width / axis.bbox.height
        self._taken = np.concatenate([np.empty((0, 2)), *(self._to_fraction.transform(dense_points(x, y)) for x, y in lines)])

    def fraction(self, x: float, y: float) -> tuple[float, float]:
        """A point of the data as fractions of the axes."""
        across, along = self._to_fraction.transform((x, y))
        return float(across), float(along)

    def best(self, text: str, places: Sequence[Place]) -> Place:
        """Of the places the one where a text lies within the axes upon the fewest points; it is taken from then on."""
        size = LETTER * len(text), LINE
        chosen = min(places, key=lambda place: (self._beyond(place, size), self._crowd(place, size)))
        across, along = np.meshgrid(np.linspace(0.0, size[0], 20), np.linspace(0.0, size[1], 5))
        self.take(np.stack([chosen.x + chosen.right * across.ravel(), chosen.y + chosen.up * along.ravel()], axis=1))
        return chosen

    def take(self, points: Floats) -> None:
        """Count points (points, 2), fractions of the axes, as taken."""
        self._taken = np.concatenate([self._taken, points])

    def gap(self, text: str, x: float) -> float:
        """Where the middle of a text stands that is written upright, right of a fraction x of the axes: in the largest free height."""
        inside = (self._taken[:, 0] >= x) & (self._taken[:, 0] <= x + UPRIGHT)
        heights = np.sort(np.concatenate([[0.0, 1.0], self._taken[inside, 1]]).clip(0.0, 1.0))
        widest = int(np.argmax(np.diff(heights)))
        half = min(0.5 * LETTER * len(text) * self._slimness, 0.5)
        return float(np.clip(0.5 * (heights[widest] + heights[widest + 1]), half, 1.0 - half))

    def _beyond(self, place, size):
        ends = place.x + place.right * size[0], place.y + place.up * size[1]
        return not all(0.0 <= end <= 1.0 for end in ends)

    def _crowd(self, place, size):
        across, along = place.right * (self._taken[:, 0] - place.x), place.up * (self._taken[:, 1] - place.y)
        return int(np.sum((across > 0) & (across < size[0]) & (along > 0) & (along < size[1])))


def dense_points(x: Floats, y: Floats) -> Floats:
    """(points, 2) along a curve, close to each other, where it is finite."""
    at = np.linspace(0, len(x) - 1, max(DENSE, len(x)))
    points = np.stack([np.interp(at, np.arange(len(x)), each) for each in (x, y)], axis=1)
    return points[np.isfinite(points).all(axis=1)]
