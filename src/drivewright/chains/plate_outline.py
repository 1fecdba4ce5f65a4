"""Outlines of straight lines and true arcs whose pieces have names: polygons with rounded corners, mirror images, exact area moments."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import Complexes
from drivewright.errors import InputError
from drivewright.scene import Arc, Line, Outline, Spline

Pieces: TypeAlias = dict[str, Arc | Line]  # of an outline by name, in its sense
_NOTHING = 1e-9  # a straight piece shorter than this, relative to the polygon's size, is none


def rounded(corners: Sequence[tuple[float, float]], radii: Sequence[float], edges: Sequence[str], arcs: Sequence[str]) -> Pieces:
    """Pieces {name: Line or Arc} of a polygon with rounded corners, in its sense, from the first edge on.

    corners (n, 2) [m], radii (n,) [m]; edge i runs from corner i to the next and is called edges[i]; arc i at corner i is called arcs[i].
    Fillets that use up an edge exactly leave it out.
    """
    points: Complexes = np.asarray(corners, float) @ np.array([1, 1j])
    along = np.roll(points, -1) - points
    length, heading = np.abs(along), along / np.abs(along)
    turn = np.angle(heading / np.roll(heading, 1))
    cut = np.asarray(radii, float) * np.abs(np.tan(turn / 2))
    left = length - cut - np.roll(cut, -1)
    size = np.ptp(points.real) + np.ptp(points.imag)
    _refuse_short(left, length, edges, arcs, size)
    pieces = {}
    for i, name in enumerate(edges):
        j = (i + 1) % len(points)
        start, end = points[i] + cut[i] * heading[i], points[j] - cut[j] * heading[i]
        if left[i] > _NOTHING * size:
            pieces[name] = Line(_pair(start), _pair(end))
        if radii[j] > 0 and turn[j] != 0:
            pieces[arcs[j]] = _fillet(end, heading[i], radii[j], turn[j])
    return pieces


def _refuse_short(left, length, edges, arcs, size):
    worst = int(np.argmin(left))
    if left[worst] < -_NOTHING * size:
        raise InputError(
            f"plate outline: the roundings '{arcs[worst]}' and '{arcs[(worst + 1) % len(arcs)]}' need "
            f"{-left[worst] * 1e3:.4g} mm more than "
            f"the {length[worst] * 1e3:.4g} mm of edge '{edges[worst]}' between them. Take smaller radii or a longer edge."
        )


def _fillet(start, heading, radius, turn):
    """Arc that leaves `start` in the direction `heading` and turns by `turn`."""
    side = 1j * heading * np.sign(turn)
    return Arc(_pair(start + radius * side), float(radius), float(np.angle(-side)), float(turn))


def _pair(z):
    return float(z.real), float(z.imag)


def mirrored(pieces: Pieces) -> Pieces:
    """The mirror image of named pieces about the y axis, in the same sense."""
    return {name: _backwards(piece.transformed((0.0, 0.0, np.pi), True)) for name, piece in reversed(pieces.items())}


def _backwards(piece):
    if isinstance(piece, Line):
        return Line(piece.end, piece.start)
    return Arc(piece.center, piece.radius, piece.start + piece.sweep, -piece.sweep)


def outline(pieces: Mapping[str, Arc | Line | Spline]) -> Outline:
    """Closed Outline of named pieces."""
    return Outline(tuple(pieces.values()))


class Moments(NamedTuple):
    """area [m^2], first moment int z dA [m^3] (complex, x + iy), polar moment int |z|^2 dA [m^4] about the origin."""

    area: float
    first: complex
    polar: float

    def __add__(self, other):
        return Moments(*(a + b for a, b in zip(self, other, strict=True)))

    def __sub__(self, other):
        return Moments(*(a - b for a, b in zip(self, other, strict=True)))

    @property
    def centroid(self) -> tuple[float, float]:
        """Centre of area (x, y)  [m]."""
        return _pair(self.first / self.area)

    @property
    def central(self) -> float:
        """Polar moment about the centre of area  [m^4]."""
        return self.polar - abs(self.first) ** 2 / self.area


def area_moments(closed: Outline) -> Moments:
    """Exact `Moments` of what a counter-clockwise Outline of lines and arcs encloses, by Green's formulas.

    int dA = (1/2i) oint z* dz;  int z dA = (1/2i) oint z z* dz;  int |z|^2 dA = (1/4i) oint z z*^2 dz.
    """
    area, first, polar = np.sum([_line(p) if isinstance(p, Line) else _arc(p) for p in closed.pieces], axis=0)
    return Moments(float(area.real), complex(first), float(polar.real))


def _line(line):
    """The three integrals along a line; Gauss's rule with two points is exact for cubics."""
    a, b = complex(*line.start), complex(*line.end)
    z = 0.5 * (a + b) + 0.5 * (b - a) * np.array([-1, 1]) / np.sqrt(3)
    w = np.conj(z)
    return np.array([np.sum(w) / 2j, np.sum(z * w) / 2j, np.sum(z * w * w) / 4j]) * 0.5 * (b - a)


def _arc(arc):
    """The three integrals along an arc z = c + r u, z* = c* + r/u, dz = i r u dt, with s_k = int u^k dt."""
    c, r = complex(*arc.center), arc.radius
    s = {k: (np.exp(1j * k * (arc.start + arc.sweep)) - np.exp(1j * k * arc.start)) / (1j * k) if k else arc.sweep for k in (-1, 0, 1, 2)}
    k = np.conj(c)
    first = abs(c) ** 2 * s[1] + r * c * s[0] + r * k * s[2] + r * r * s[1]
    polar = c * k * k * s[1] + 2 * c * k * r * s[0] + c * r * r * s[-1] + r * k * k * s[2] + 2 * k * r * r * s[1] + r**3 * s[0]
    return np.array([0.5 * r * (k * s[1] + r * s[0]), 0.5 * r * first, 0.25 * r * polar])
