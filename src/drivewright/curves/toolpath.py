"""Parallel outline at a distance: the path of the centre of a cutter or grinding wheel."""

import numpy as np

from drivewright.curves.outlines import interpolant, outline_area
from drivewright.errors import InputError
from drivewright.scene import Arc, Line, Outline, Spline, xy

_SMOOTH = 1e-6  # a turn [rad] below this is rounding and no corner
_GOUGE = 1e-4  # the cutter may come nearer to the far side of the outline by this part of its radius: sampling error


def offset_outline(outline: Outline, distance: float) -> Outline:
    """Outline parallel to a closed one, outside it for distance > 0, inside for distance < 0 [m].

    Arcs stay arcs, outer corners are rounded by arcs about the corner.  Raises InputError with place and radius where a
    concave place is tighter than the distance, or where a cutter of that radius would touch another part of the outline.
    """
    left = -distance * np.sign(outline_area(outline))
    if left == 0:
        return outline
    pieces = []
    for piece, following in zip(outline.pieces, (*outline.pieces[1:], outline.pieces[0]), strict=True):
        pieces += [_parallel(piece, left), *_around_corner(piece, following, left)]
    path = Outline(tuple(pieces))
    _refuse_gouge(outline, path, abs(left))
    return path


def _parallel(piece, left):
    if isinstance(piece, Arc):
        toward = np.sign(piece.sweep) * left
        if toward >= piece.radius:
            _too_tight(piece.radius, complex(*piece.center) + piece.radius * np.exp(1j * (piece.start + 0.5 * piece.sweep)), left)
        return piece._replace(radius=float(piece.radius - toward))
    if isinstance(piece, Line):
        shift = 1j * left * _heading(piece, "end")
        return Line(xy(complex(*piece.start) + shift), xy(complex(*piece.end) + shift))
    return _parallel_spline(piece, left)


def _parallel_spline(spline, left):
    curve, u = interpolant(spline)
    fine = _subdivided(u)
    slope, second = curve(fine, 1), curve(fine, 2)
    bend = np.imag(np.conj(slope) * second) / np.abs(slope) ** 3
    worst = int(np.argmax(bend * left))
    if bend[worst] * left >= 1:
        _too_tight(1 / abs(bend[worst]), complex(curve(fine[worst])), left)
    knots = np.asarray(spline.knots) @ (1, 1j) + 1j * left * curve(u, 1) / np.abs(curve(u, 1))
    return spline._replace(knots=np.stack([knots.real, knots.imag], axis=1))


def _subdivided(u, parts=8):
    return np.append((u[:-1, None] + np.diff(u)[:, None] * np.arange(parts) / parts).ravel(), u[-1])


def _around_corner(piece, following, left):
    """The arc that rolls the cutter around an outer corner; none where the outline goes on smoothly."""
    before, after = _heading(piece, "end"), _heading(following, "start")
    turn = float(np.angle(after / before))
    if abs(turn) < _SMOOTH:
        return
    corner = _point(piece)
    if turn * left > 0:
        _too_tight(0.0, corner, left)
    yield Arc(xy(corner), float(abs(left)), float(np.angle(1j * left * before)), turn)


def _heading(piece, end):
    """Unit tangent of a piece at its start or end, as a complex number."""
    if isinstance(piece, Spline):
        return complex(*(piece.start_tangent if end == "start" else piece.end_tangent))
    if isinstance(piece, Arc):
        angle = piece.start + (piece.sweep if end == "end" else 0.0)
        return 1j * np.sign(piece.sweep) * np.exp(1j * angle)
    along = complex(*piece.end) - complex(*piece.start)
    return along / abs(along)


def _point(piece):
    """End point of a piece."""
    if isinstance(piece, Spline):
        return complex(*piece.knots[-1])
    if isinstance(piece, Arc):
        return complex(*piece.center) + piece.radius * np.exp(1j * (piece.start + piece.sweep))
    return complex(*piece.end)


def _refuse_gouge(outline, path, radius):
    import shapely

    ring, places = _dense(outline), _dense(path)
    chords = shapely.linestrings(np.stack([ring, np.roll(ring, -1, axis=0)], axis=1))
    tree = shapely.STRtree(np.asarray(chords, dtype=object))
    _, room = tree.query_nearest(shapely.points(places), return_distance=True, all_matches=False)
    worst = int(np.argmin(room))
    if room[worst] < (1 - _GOUGE) * radius:
        x, y = places[worst] * 1e3
        raise InputError(
            f"a cutter of radius {radius * 1e3:.4g} mm with its centre at ({x:.4g}, {y:.4g}) mm cuts "
            f"{(radius - room[worst]) * 1e3:.3g} mm into another part of the outline. "
            f"The place is {(radius + room[worst]) * 1e3:.4g} mm wide; take a cutter of less diameter, or open it."
        )


def _dense(outline):
    """Points (n, 2) close enough that chords do not matter."""
    chains = []
    for piece in outline.pieces:
        if isinstance(piece, Spline):
            curve, u = interpolant(piece)
            z = curve(_subdivided(u))
            chains.append(np.stack([z.real, z.imag], axis=1))
        else:
            chains.append(piece.points(1e-6 * getattr(piece, "radius", 1.0)))
    return np.concatenate(chains)


def _too_tight(radius, place, left):
    raise InputError(
        f"at ({place.real * 1e3:.4g}, {place.imag * 1e3:.4g}) mm the outline is concave towards the cutter with radius "
        f"{radius * 1e3:.4g} mm; "
        f"a cutter of radius {abs(left) * 1e3:.4g} mm cannot reach it. Take a smaller cutter, or round the place to a larger radius."
    )
