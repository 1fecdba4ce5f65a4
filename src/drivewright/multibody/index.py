"""What the elements of a model need to become records: numbers of the bodies, arms of their markers, numbers of the curves."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from drivewright.contact.film_table import FilmTable
from drivewright.errors import InputError, UnknownName
from drivewright.multibody.bodies import Marker
from drivewright.multibody.curves import Curve


class ModelIndex(NamedTuple):
    """By name of the body: its number in the arrays, its start angle [rad], its centroid in its frame [m]; and the
    curves, contact laws and oil films collected."""

    numbers: Mapping[str, int]
    angles: Mapping[str, float]
    centroids: Mapping[str, tuple[float, float]]
    curves: list[Curve]
    laws: list[Any]
    films: list[FilmTable]

    def number(self, name: str, whose: str) -> int:
        """Number of a body; UnknownName says who names it."""
        if name not in self.numbers:
            raise UnknownName(f"body of {whose}", name, self.numbers)
        return self.numbers[name]

    def arm(self, marker: Marker) -> tuple[float, float]:
        """A marker seen from the centroid of its body, in the body's frame [m]."""
        cx, cy = self.centroids[marker.body]
        return marker.x - cx, marker.y - cy

    def pair(self, first: Marker, second: Marker, whose: str) -> dict[str, float]:
        """Fields i, j, ax, ay, bx, by of two bodies and the points on them."""
        i, j = self.number(first.body, whose), self.number(second.body, whose)
        (ax, ay), (bx, by) = self.arm(first), self.arm(second)
        return {"i": i, "j": j, "ax": ax, "ay": ay, "bx": bx, "by": by}

    def add_curve(self, curve: Curve) -> int:
        """Number of a curve that the kernels are to know."""
        self.curves.append(curve)
        return len(self.curves) - 1

    def add_law(self, law: Any) -> int:
        """Number, from 1, of a contact law that the kernels are to know."""
        self.laws.append(law)
        return len(self.laws)

    def add_film(self, table: FilmTable) -> int:
        """Number of an oil film's table that the kernels are to know; the same table has one number."""
        if not any(table is other for other in self.films):
            self.films.append(table)
        return next(k for k, other in enumerate(self.films) if other is table)


def unit_axis(axis: tuple[float, float], joint: str) -> tuple[float, float]:
    """An axis of length 1; InputError where it has no direction."""
    length = np.hypot(*axis)
    if not length > 0:
        raise InputError(f"joint {joint!r}: its axis {axis} has no direction; give e.g. [1, 0]")
    return axis[0] / length, axis[1] / length
