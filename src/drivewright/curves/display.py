"""Outlines for pictures: the part that a family leaves, from the chords of its envelope.

Second route beside `trim`.  Whether a point is cut away changes only across the envelope, so the part around an uncovered point is
the face around it of the plane that the envelope's chords divide; no crossing has to be solved for.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from drivewright._typing import Complexes, Floats, Ints
from drivewright.curves.pieces import Piece, gather
from drivewright.curves.trim import EnvelopeFamily, trim
from drivewright.numerics.jets import Jet
from drivewright.scene import FINEST, Line, Outline, Spline

_ROUNDS = 4
_MOST = 64  # parts into which a chord is divided in one round
_CORNER = 0.3  # chords that turn more [rad] meet at a corner
_SAME = 1e-9  # points nearer than this are one, relative to the size of the curve
_PROBES = 200  # members among which one that sweeps over the interior point is sought
_DEEP = 20  # tolerances by which a point of the picture may lie in a cutter, at a sharp crossing of two chords


def display_outline(family: EnvelopeFamily, tolerance: float, interior: complex = 0j, fewest: int = 17) -> Outline:
    """Outline within a few `tolerance` [m] of the exact profile of a family, knots on it; the exact one where chords do not tell it.

    fewest: chords on each piece of the envelope before those that turn are divided.  Errors are those of `trim`.
    """
    pieces = family.envelope()
    index, t, z = chords(pieces, tolerance, fewest)
    points = _left(family, pieces, index, t, z, complex(interior), tolerance)
    if points is None:
        return trim(family, interior).outline(tolerance)
    return _outline(points)


def simple_outline(family: EnvelopeFamily, tolerance: float, interior: complex = 0j, fewest: int = 17) -> Outline | None:
    """The same where the envelope does not cross itself, so that nothing of it is cut away; else None."""
    pieces = family.envelope()
    index, t, z = chords(pieces, tolerance, fewest)
    kept = not _sweeps(family, pieces, index, t, complex(interior)) and not any(piece.loop for piece in pieces) and _is_simple(z)
    return _outline(z) if kept else None


def _outline(points):
    """Closed outline through points (complex): splines from corner to corner."""
    chord = np.roll(points, -1) - points
    kept = np.abs(chord) > _SAME * np.max(np.abs(points))  # the end of a piece is the start of the next
    points = points[kept]
    chord = np.roll(points, -1) - points
    corners = np.flatnonzero(np.abs(np.angle(chord / np.roll(chord, 1))) > _CORNER)
    around = np.roll(np.arange(len(points)), -corners[0] if len(corners) else 0)
    stops = [*(corners - corners[:1]), len(points)] if len(corners) else [0, len(points)]
    closed = np.append(points[around], points[around[0]])
    return Outline(tuple(_run(closed[start : stop + 1]) for start, stop in pairwise(stops)))


def _run(points):
    """Straight or smooth piece through points; the end tangents are those of the parabolas through the last three."""
    knots = np.stack([points.real, points.imag], axis=1)
    if len(points) == 2:
        return Line(*map(tuple, knots.tolist()))
    ways = np.diff(points)[[0, 1, -1, -2]]
    ways = ways / np.abs(ways)
    ends = 1.5 * ways[::2] - 0.5 * ways[1::2]
    return Spline(knots, *((float(end.real), float(end.imag)) for end in ends / np.abs(ends)))


def chords(pieces: Sequence[Piece], tolerance: float, fewest: int = 17) -> tuple[Ints, Floats, Complexes]:
    """Piece index, parameter and point of samples along the pieces.

    No chord is further from its curve than about `tolerance` [m], or `FINEST` of the curve's largest radius where that is more.
    """
    count = fewest + 1
    index = np.repeat(np.arange(len(pieces)), count)
    t = np.linspace([piece.start for piece in pieces], [piece.stop for piece in pieces], count).T.ravel()
    jet = gather(pieces, index, t)
    tolerance = max(tolerance, FINEST * np.max(np.abs(jet.d0)))
    for _ in range(_ROUNDS):
        parts = _parts(jet, index, tolerance)
        if np.all(parts == 1):
            break
        k = np.repeat(np.arange(len(parts)), parts - 1)
        share = (np.arange(len(k)) - np.repeat(np.cumsum(parts - 1) - (parts - 1), parts - 1) + 1) / parts[k]
        new, own = t[k] + share * (t[k + 1] - t[k]), index[k]
        between = gather(pieces, own, new)
        jet = Jet(*(np.insert(old, k + 1, add) for old, add in zip(jet, between, strict=True)))
        t, index = np.insert(t, k + 1, new), np.insert(index, k + 1, own)
    return index, t, jet.d0


def _parts(jet, index, tolerance):
    """Into how many each chord is to be divided: its sagitta is chord * turn / 8, and falls with the square of the number."""
    with np.errstate(invalid="ignore"):
        turn = np.abs(np.angle(np.conj(jet.d1[:-1]) * jet.d1[1:]))
    sagitta = np.abs(np.diff(jet.d0)) * np.nan_to_num(turn) / 8
    parts = np.clip(np.ceil(1.05 * np.sqrt(sagitta / tolerance)), 1, _MOST)  # a little more, or most would be divided once again
    return np.where((np.diff(index) == 0) & (sagitta > tolerance), parts, 1).astype(int)


def _left(family, pieces, index, t, z, interior, tolerance):
    """Points around the part, None where the envelope's chords do not bound it."""
    if _sweeps(family, pieces, index, t, interior):
        return None
    loop = np.array([piece.loop for piece in pieces])[index]
    if not loop.any() and _is_simple(z):
        return z
    points = _face([z[loop == number] for number in np.unique(loop)], interior, family.material, tolerance)
    if points is None or family.whole:
        return points
    members = family.members(*_moving(pieces, index, t))
    gaps = family.gap(members[..., family.deepest(members, points)], points)
    return points if np.min(gaps) >= -_DEEP * tolerance else None


def _sweeps(family, pieces, index, t, interior):
    """Whether the cutter passes over the interior point of a part inside the swept ring."""
    if family.material != "inside":
        return False
    source, moving = _moving(pieces, index, t)
    some = np.linspace(0, len(moving) - 1, _PROBES).astype(int)
    return np.min(family.gap(family.members(source[some], moving[some]), interior)) <= 0


def _moving(pieces, index, t):
    """Number in the family's motion and parameter of the samples that are not on a corner."""
    source = np.array([-1 if piece.source is None else piece.source for piece in pieces])[index]
    return source[source >= 0], t[source >= 0]


def _is_simple(points):
    import shapely

    return bool(shapely.is_simple(shapely.linearrings(_closed(points))))


def _face(loops, interior, material, tolerance):
    """Boundary of the face around the interior point, or around all faces where the part surrounds them; None without a face."""
    import shapely

    lines = [shapely.simplify(shapely.linestrings(_closed(points)), 0.5 * tolerance, preserve_topology=False) for points in loops]
    faces = shapely.get_parts(shapely.polygonize([shapely.unary_union(lines)]))
    if material == "inside":
        faces = faces[shapely.contains_xy(faces, interior.real, interior.imag)]
    whole = shapely.union_all(faces)
    if not isinstance(whole, shapely.Polygon) or whole.is_empty:
        return None
    return shapely.get_coordinates(shapely.get_exterior_ring(shapely.normalize(whole)))[-2::-1] @ (1, 1j)


def _closed(points):
    return np.stack([np.append(points.real, points.real[0]), np.append(points.imag, points.imag[0])], axis=1)
