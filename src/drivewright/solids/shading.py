"""How a triangle surface is to look: normals that are smooth on round faces, and edges where faces meet in a crease."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats, Ints

CREASE = np.cos(np.radians(30))  # faces that turn by more meet in an edge


class SurfaceShape(NamedTuple):
    """proper (m,): which triangles have an area; corners (k, 3) of those, equal points being one, and unit normals (k, 3, 3) at them;
    edges (e, 2): points at the ends of a side where two faces meet in a crease."""

    proper: Bools
    corners: Ints
    normals: Floats
    edges: Ints


def surface_shape(points: Floats, corners: Ints, crease: float = CREASE) -> SurfaceShape:
    """`SurfaceShape` of a surface: points (n, 3), corners (m, 3); crease: cosine of the angle from which on faces meet in an edge."""
    proper, corners, faces = _proper(points, corners)
    sides = np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    edges = _sharp(sides, np.repeat(np.arange(len(corners)), 3), faces, crease)
    return SurfaceShape(proper, corners, _normals(points, corners, faces, crease), edges)


def _proper(points, corners):
    """(which triangles have an area, their corners, their normals as long as twice that area), equal points being one."""
    _, first, same = np.unique(points.round(9), axis=0, return_index=True, return_inverse=True)
    corners = first[np.ravel(same)][corners]
    a, b, c = np.moveaxis(points[corners], 1, 0)
    normals = np.cross(b - a, c - a)
    proper = np.linalg.norm(normals, axis=1) > 0
    return proper, corners[proper], normals[proper]


def _unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def _angles(points, corners):
    """Angle [rad] of each triangle at each of its corners (m, 3)."""
    ahead = _unit(points[np.roll(corners, -1, axis=1)] - points[corners])
    return np.arccos(np.clip(-np.einsum("ijk,ijk->ij", ahead, np.roll(ahead, 1, axis=1)), -1.0, 1.0))


def _normals(points, corners, faces, crease):
    """Unit normals (m, 3, 3) at the corners: of the faces at the point that turn by less than a crease from the own one, each by its
    angle there, so that it does not matter how a flat face is cut into triangles."""
    spots, owners = corners.ravel(), np.repeat(np.arange(len(corners)), 3)
    order = np.argsort(spots, kind="stable")
    counts = np.bincount(spots)[spots[order]]
    starts = np.searchsorted(spots[order], spots[order])
    mine = np.repeat(np.arange(len(order)), counts)
    theirs = np.repeat(starts, counts) + np.arange(len(mine)) - np.repeat(np.cumsum(counts) - counts, counts)
    own, other = owners[order][mine], owners[order][theirs]
    unit = _unit(faces)
    near = np.einsum("ij,ij->i", unit[own], unit[other]) > crease
    total = np.zeros((len(order), 3))
    weights = _angles(points, corners).ravel()[order][theirs]
    np.add.at(total, mine[near], (weights[:, None] * unit[other])[near])
    normals = np.empty_like(total)
    normals[order] = _unit(total)
    return normals.reshape(-1, 3, 3)


def _sharp(sides, owners, faces, crease):
    """Sides (k, 2) where two faces meet in a crease, or that only one face has."""
    order = np.lexsort(sides.T)
    sides, owners, unit = sides[order], owners[order], _unit(faces)
    first = np.flatnonzero(np.concatenate([[True], np.any(np.diff(sides, axis=0) != 0, axis=1)]))
    count = np.diff(np.append(first, len(sides)))
    partner = np.minimum(first + 1, len(sides) - 1)
    flat = (count == 2) & (np.einsum("ij,ij->i", unit[owners[first]], unit[owners[partner]]) > crease)
    return sides[first[~flat]]
