"""A taut loop around any number of circles, inside and outside of it: the layout of a serpentine chain or belt.

The loop runs through the circles in their order.  A circle with turn = +1 lies to the left of the running direction (the loop goes round
it counter-clockwise), one with -1 to the right.  In a loop that runs counter-clockwise the circles inside are +1, those that press
on its back -1.
"""

from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.standards.given import above_zero
from drivewright.errors import InputError

_NO_WRAP = 1e-9  # rad; a wrap that misses a whole turn by less is rounding about 0


class Circle(NamedTuple):
    """Centre x, y [m], radius [m] and sense of turn: +1 counter-clockwise, -1 clockwise.  A radius of 0 is a peg."""

    x: float
    y: float
    radius: float
    turn: int = 1


Given: TypeAlias = Circle | tuple[float, float, float] | tuple[float, float, float, int]


class Loop(NamedTuple):
    """The taut loop around n circles, strand i from circle i to the next.

    starts, ends (n, 2): ends of the strands [m]; lengths (n,) of the strands [m]; wraps (n,): angle [rad] over which circle i is wrapped.
    """

    circles: tuple[Circle, ...]
    starts: Floats
    ends: Floats
    lengths: Floats
    wraps: Floats

    @property
    def length(self) -> float:
        """Strands and arcs together [m]."""
        radii = np.array([circle.radius for circle in self.circles])
        return float(np.sum(self.lengths) + np.sum(radii * self.wraps))

    def links(self, pitch: float, teeth: Sequence[int]) -> float:
        """Number of links of a chain: strands in pitches, arcs at z to the turn; teeth = 0 for a smooth idler, its arc in pitches."""
        above_zero("chain loop", pitch=pitch)
        numbers = np.asarray(teeth, dtype=float)
        if numbers.shape != self.wraps.shape:
            raise InputError(f"chain loop: {numbers.size} tooth numbers for {self.wraps.size} circles; give one each, 0 for a smooth one.")
        radii = np.array([circle.radius for circle in self.circles])
        arcs = np.where(numbers > 0, numbers * self.wraps / (2 * np.pi), radii * self.wraps / pitch)
        return float(np.sum(self.lengths) / pitch + np.sum(arcs))


def taut_loop(circles: Sequence[Given]) -> Loop:
    """The `Loop` around circles (`Circle` or x, y, radius[, turn]), in the order in which it meets them.

    With s = turn x radius a strand of direction u and left normal n joins the tangent points c - s n: c2 - c1 = l u + (s2 - s1) n.
    Hence l^2 = |c2 - c1|^2 - (s2 - s1)^2, and u lies atan2(s2 - s1, l) clockwise of the line of centres.
    """
    circles = tuple(Circle(*circle) for circle in circles)  # pyright: ignore[reportArgumentType]  the fourth is the turn
    _check(circles)
    centres = np.array([(circle.x, circle.y) for circle in circles], dtype=float)
    signed = np.array([circle.turn * circle.radius for circle in circles], dtype=float)
    lengths, headings = tangents(centres, signed)
    normals = np.column_stack([-np.sin(headings), np.cos(headings)])
    starts = centres - signed[:, None] * normals
    ends = np.roll(centres, -1, axis=0) - np.roll(signed, -1)[:, None] * normals
    turns = np.array([circle.turn for circle in circles])
    wraps = (turns * (headings - np.roll(headings, 1))) % (2 * np.pi)
    wraps = np.where(wraps > 2 * np.pi - _NO_WRAP, 0.0, wraps)
    _check_closes(turns, wraps)
    return Loop(circles, starts, ends, lengths, wraps)


def loop_length(circles: Sequence[Given]) -> float:
    """Length [m] of the taut loop around the circles, see `taut_loop`."""
    return taut_loop(circles).length


def tangents(centres: Floats, signed: Floats, names: Sequence[str] = ()) -> tuple[Floats, Floats]:
    """Length [m] and heading [rad] of each strand between circles with centres (n, 2) and turn times radius (n,) [m].

    InputError where two of them are too near, by their names where these are given.
    """
    to_next = np.roll(centres, -1, axis=0) - centres
    rise = np.roll(signed, -1) - signed
    square = np.sum(to_next**2, axis=1) - rise**2
    if np.any(square <= 0):
        first = int(np.argmin(square))
        one, other = (names[first], names[(first + 1) % len(names)]) if names else (f"circle {first + 1}", "the next")
        side = "change the side of the loop on which one of them lies" if names else "check on which side (turn) each is passed"
        raise InputError(
            f"{'chain drive' if names else 'loop'}: no strand fits between {one} and {other}: their centres are "
            f"{1e3 * np.hypot(*to_next[first]):.4g} mm apart and must be more than {1e3 * abs(rise[first]):.4g} mm apart. Move them "
            f"apart, or {side}."
        )
    lengths = np.sqrt(square)
    return lengths, np.arctan2(to_next[:, 1], to_next[:, 0]) - np.arctan2(rise, lengths)


def _check(circles):
    if len(circles) < 2:
        raise InputError(f"loop: needs two circles or more, got {len(circles)}.")
    for number, circle in enumerate(circles, 1):
        if circle.turn not in (-1, 1):
            raise InputError(f"loop: turn of circle {number} must be +1 (counter-clockwise) or -1, got {circle.turn!r}.")
        if not (np.all(np.isfinite(circle)) and circle.radius >= 0):
            raise InputError(f"loop: circle {number} needs a finite centre and a radius of 0 or more, got {tuple(circle)}.")


def _check_closes(turns, wraps):
    """A loop that does not cross itself turns once."""
    turned = np.sum(turns * wraps) / (2 * np.pi)
    if abs(abs(turned) - 1) > 1e-6:
        most = int(np.argmax(wraps))
        raise InputError(
            f"loop: it turns {turned:.3g} times in all instead of once; the largest wrap is {np.degrees(wraps[most]):.0f}° on circle "
            f"{most + 1}. Leave out circles that the loop misses, or change their order or the side (turn) on which they are passed."
        )
