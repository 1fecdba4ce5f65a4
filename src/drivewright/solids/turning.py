"""Turned bodies: rings of (length, outer diameter at start, at end, bore) in a row, with cones, steps and bores; lengths in metres.

Their volume, their outline in a half-plane through the axis, their surface as triangles, and the frustums between cuts across them,
without a CAD kernel.
"""

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Bools, Floats, Ints
from drivewright.errors import InputError
from drivewright.scene import FINEST, Turned

SAME = 1e-6  # m: cuts closer together than this are one


class Band(NamedTuple):
    """A seat around a turned body: middle [m] along the axis, width [m], radial stiffness [N/m] of what holds it (inf is rigid)."""

    position: float
    width: float
    stiffness: float = np.inf

    @property
    def edges(self) -> tuple[float, float]:
        """Both ends along the axis [m]."""
        return self.position - self.width / 2, self.position + self.width / 2

    def holds(self, low: float, high: float) -> bool:
        """Whether the middle between two places [m] along the axis lies in the band."""
        return abs((low + high) / 2 - self.position) < self.width / 2


class Frustum(NamedTuple):
    """A length of a turned body between two neighbouring cuts: its ends [m] along the axis, outer diameter at either end, bore [m]."""

    low: float
    high: float
    start: float
    end: float
    bore: float

    @property
    def lateral_area(self) -> float:
        """Area of the outside [m^2], pi (D + E)/2 times the slant."""
        return np.pi * (self.start + self.end) / 2 * np.hypot(self.high - self.low, (self.end - self.start) / 2)


def split_rings(rings: ArrayLike, cuts: Iterable[float]) -> list[Frustum]:
    """`Frustum`s of rings (n, 4) between all their ends and the cuts [m]; cuts next to one already there are left out."""
    rings = np.asarray(rings, float)
    ends = np.concatenate([[0.0], np.cumsum(rings[:, 0])])
    places = _merged(ends, cuts)
    return [_frustum(rings, ends, low, high) for low, high in zip(places[:-1], places[1:], strict=True)]


def _frustum(rings: Floats, ends: Floats, low: float, high: float) -> Frustum:
    number = int(np.searchsorted(ends, (low + high) / 2)) - 1
    length, start, end, bore = rings[number]
    at_low, at_high = (start + (end - start) * np.clip((cut - ends[number]) / length, 0.0, 1.0) for cut in (low, high))
    return Frustum(float(low), float(high), float(at_low), float(at_high), float(bore))


def _merged(fixed: Floats, others: Iterable[float]) -> Floats:
    """`fixed` cuts and those of the others that are not next to one already there, in order."""
    cuts = list(fixed)
    for cut in others:
        if min(abs(cut - known) for known in cuts) > SAME:
            cuts.append(cut)
    return np.sort(cuts)


def checked_rings(rings: Sequence[Sequence[float]] | Floats, name: str) -> Floats:
    """The rings as floats (n, 4); InputError naming `name`, the ring and the numbers where they make no one solid."""
    rings = np.array([tuple(ring) for ring in rings], float)
    if not len(rings):
        raise InputError(f"{name}: a turned body without rings; give it at least one (length, diameter, end diameter, bore)")
    for number, (length, start, end, bore) in enumerate(rings):
        if not (np.isfinite(rings[number]).all() and length > 0 and min(start, end) > bore >= 0):
            raise InputError(
                f"{name}: ring {number} has length {1e3 * length:g} mm, diameters {1e3 * start:g} and {1e3 * end:g} mm, bore "
                f"{1e3 * bore:g} mm; it must have a positive length and both diameters larger than a bore of 0 or more"
            )
    for number, ((*_, end, bore), (_, start, _, next_bore)) in enumerate(zip(rings[:-1], rings[1:], strict=True)):
        if max(bore, next_bore) >= min(end, start):
            raise InputError(
                f"{name}: rings {number} and {number + 1} do not touch: a bore of {1e3 * max(bore, next_bore):g} mm meets a "
                f"diameter of {1e3 * min(end, start):g} mm; make the bore smaller"
            )
    return rings


def ring_volume(rings: ArrayLike) -> float:
    """Volume [m^3]: sum of pi L (D^2 + D E + E^2)/12 of the cones less pi L d^2/4 of the bores."""
    length, start, end, bore = np.asarray(rings, float).T
    return float(np.pi * np.sum(length * (start**2 + start * end + end**2) / 12 - length * bore**2 / 4))


def half_section(rings: Sequence[Sequence[float]] | Floats, name: str) -> Floats:
    """Corners (n, 2) [m] of the half-section, (distance along the axis, radius), counter-clockwise; no three of them in line."""
    rings = checked_rings(rings, name)
    ends = np.concatenate([[0.0], np.cumsum(rings[:, 0])])
    along = np.repeat(ends, 2)[1:-1]
    inner = np.column_stack([along, np.repeat(rings[:, 3], 2) / 2])
    outer = np.column_stack([along, rings[:, 1:3].ravel() / 2])
    return _without_idle(np.concatenate([inner, outer[::-1]]))


def turned_triangles(turned: Turned, name: str, tolerance: float) -> tuple[Floats, Ints]:
    """Closed surface, outward counter-clockwise: points (n, 3) [m] and corners (m, 3); chords within `tolerance` [m] of the circles."""
    corners = half_section(turned.rings, name)
    turn = _turn(corners[:, 1].max(), tolerance)
    points, first = [], []
    for s, r in corners:
        first.append(sum(map(len, points)))
        angle = turn if r > 0 else turn[:1]
        points.append(np.column_stack([np.full(len(angle), s), r * np.cos(angle), r * np.sin(angle)]))
    spots = np.array([start + np.arange(len(turn)) % len(ring) for start, ring in zip(first, points, strict=True)])
    return np.concatenate(points) + (*turned.start, turned.z), _walls(spots, corners[:, 1] > 0)


def _without_idle(corners: Floats) -> Floats:
    """Corners without repeated ones and without those on the straight line between their neighbours."""
    corners = corners[np.any(corners != np.roll(corners, 1, axis=0), axis=1)]
    back, on = corners - np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0) - corners
    turn = back[:, 0] * on[:, 1] - back[:, 1] * on[:, 0]
    return corners[np.abs(turn) > 1e-12 * np.hypot(*back.T) * np.hypot(*on.T)]


def _turn(radius: float, tolerance: float) -> Floats:
    """Angles of the corners of a polygon in a circle with that sagitta at most; a multiple of four keeps the overall height."""
    half = np.arccos(1 - min(max(tolerance / radius, FINEST), 1.0))
    return np.linspace(0, 2 * np.pi, max(4 * int(np.ceil(np.pi / (4 * half))), 8), endpoint=False)


def _walls(spots: Ints, off_axis: Bools) -> Ints:
    """Triangles between neighbouring corners of the profile: `spots` (corners, n) numbers the points of each, equal on the axis."""
    here, there = spots, np.roll(spots, -1, axis=0)
    wide, wide_next = off_axis, np.roll(off_axis, -1)
    here_on, there_on = np.roll(here, -1, axis=1), np.roll(there, -1, axis=1)
    first = np.stack([here, there, there_on], axis=2)[wide_next]
    second = np.stack([here, there_on, here_on], axis=2)[wide]
    return np.concatenate([first.reshape(-1, 3), second.reshape(-1, 3)])
