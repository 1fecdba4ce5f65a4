"""Turned bodies: rings of (length, outer diameter at start, at end, bore) in a row, with cones, steps and bores; lengths in metres.

Their volume, their outline in a half-plane through the axis, and their surface as triangles, without a CAD kernel.
"""

import numpy as np

from drivewright.errors import InputError


def checked(rings, name):
    """The rings as floats (n, 4); InputError naming `name`, the ring and the numbers where they make no one solid."""
    if not len(rings):
        raise InputError(f"{name}: a turned body without rings; give it at least one (length, diameter, end diameter, bore)")
    rings = np.array([tuple(ring) for ring in rings], float)
    for number, (length, start, end, bore) in enumerate(rings):
        if not (np.isfinite(rings[number]).all() and length > 0 and min(start, end) > bore >= 0):
            raise InputError(
                f"{name}: ring {number} has length {1e3 * length:g} mm, diameters {1e3 * start:g} and {1e3 * end:g} mm, bore "
                f"{1e3 * bore:g} mm; it wants a positive length and both diameters larger than a bore of 0 or more"
            )
    for number, ((*_, end, bore), (_, start, _, next_bore)) in enumerate(zip(rings[:-1], rings[1:], strict=True)):
        if max(bore, next_bore) >= min(end, start):
            raise InputError(
                f"{name}: rings {number} and {number + 1} do not touch: a bore of {1e3 * max(bore, next_bore):g} mm meets a "
                f"diameter of {1e3 * min(end, start):g} mm; make the bore smaller"
            )
    return rings


def volume(rings):
    """Volume [m^3]: sum of pi L (D^2 + D E + E^2)/12 of the cones less pi L d^2/4 of the bores."""
    length, start, end, bore = np.array([tuple(ring) for ring in rings], float).T
    return float(np.pi * np.sum(length * (start**2 + start * end + end**2) / 12 - length * bore**2 / 4))


def profile(rings, name):
    """Corners (n, 2) of the half-section, (distance along the axis, radius), counter-clockwise; no three of them in line."""
    rings = checked(rings, name)
    ends = np.concatenate([[0.0], np.cumsum(rings[:, 0])])
    along = np.repeat(ends, 2)[1:-1]
    inner = np.column_stack([along, np.repeat(rings[:, 3], 2) / 2])
    outer = np.column_stack([along, rings[:, 1:3].ravel() / 2])
    return _without_idle(np.concatenate([inner, outer[::-1]]))


def triangles(turned, name, tolerance):
    """Closed surface, outward counter-clockwise: points (n, 3) [m] and corners (m, 3); chords within `tolerance` [m] of the circles."""
    corners = profile(turned.rings, name)
    turn = _turn(corners[:, 1].max(), tolerance)
    points, first = [], []
    for s, r in corners:
        first.append(sum(map(len, points)))
        angle = turn if r > 0 else turn[:1]
        points.append(np.column_stack([np.full(len(angle), s), r * np.cos(angle), r * np.sin(angle)]))
    spots = np.array([start + np.arange(len(turn)) % len(ring) for start, ring in zip(first, points, strict=True)])
    return np.concatenate(points) + (*turned.start, turned.z), _walls(spots, corners[:, 1] > 0)


def _without_idle(corners):
    """Corners without repeated ones and without those on the straight line between their neighbours."""
    corners = corners[np.any(corners != np.roll(corners, 1, axis=0), axis=1)]
    back, on = corners - np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0) - corners
    bend = back[:, 0] * on[:, 1] - back[:, 1] * on[:, 0]
    return corners[np.abs(bend) > 1e-12 * np.hypot(*back.T) * np.hypot(*on.T)]


def _turn(radius, tolerance):
    """Angles of the corners of a polygon in a circle with that sagitta at most; a multiple of four keeps the overall height."""
    half = np.arccos(max(1 - tolerance / radius, 0.0))
    return np.linspace(0, 2 * np.pi, max(4 * int(np.ceil(np.pi / (4 * half))), 8), endpoint=False)


def _walls(spots, off_axis):
    """Triangles between neighbouring corners of the profile: `spots` (corners, n) numbers the points of each, equal on the axis."""
    here, there = spots, np.roll(spots, -1, axis=0)
    wide, wide_next = off_axis, np.roll(off_axis, -1)
    here_on, there_on = np.roll(here, -1, axis=1), np.roll(there, -1, axis=1)
    first = np.stack([here, there, there_on], axis=2)[wide_next]
    second = np.stack([here, there_on, here_on], axis=2)[wide]
    return np.concatenate([first.reshape(-1, 3), second.reshape(-1, 3)])
