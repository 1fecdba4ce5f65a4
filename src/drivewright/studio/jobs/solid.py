"""The assembly as triangles for a viewer: flat arrays for the graphics card, round surfaces smooth, edges sharp."""

from typing import Any, NamedTuple

import numpy as np

from drivewright import registry, runner
from drivewright._typing import Bools, Floats, Ints
from drivewright.errors import InputError
from drivewright.report.pack import floats
from drivewright.scene import Scene
from drivewright.solids import facets
from drivewright.studio.design import Design
from drivewright.studio.jobs.progress import Progress
from drivewright.view.motion import fractions

CREASE = np.cos(np.radians(30))  # faces that turn by more meet in an edge
TOLERANCE = 3e-5  # m: chords stay about so near to a round surface


def solid(design: Design, progress: Progress) -> dict[str, Any]:
    """{"unit": "m", "size", "low", "high", "parts": [{"name", "colour", "triangles", "positions", "normals", "edges", "motion"}],
    "motions", "u", "analyses": [{"name", "meaning", "missing"}] whose fields a viewer can show}.

    positions and normals: base64 of float32 x, y, z, three corners a triangle, counter-clockwise from outside; edges: two ends each.
    motions: base64 of (frames, 3) displacements (x, y, angle) from the start position about the z axis, at the phases `u` of the cycle;
    `motion` of a part is the number of its own, -1 where it stands still.
    InputError where the drive has no solids; MissingExtra where a part needs the CAD kernel.
    """
    spec = design.spec()
    mechanism = registry.mechanism(spec.mechanism)
    model = runner.build(spec)
    parts = tuple(mechanism.parts(model)) if mechanism.parts else ()
    if not parts:
        raise InputError(f"{mechanism.kind} has no solids to show")
    packed, ends = [], []
    scene = mechanism.scene(model) if mechanism.scene else None
    moving = displacements(scene) if scene else {}
    motions: dict[str, int] = {}
    for number, part in enumerate(parts):
        progress(number, len(parts), part.name)
        points, corners = facets.surface_triangles(part, TOLERANCE)
        ends += [points.min(axis=0), points.max(axis=0)]
        moved = moving.get(part.body or part.name)
        motion = motions.setdefault(moved, len(motions)) if moved else -1
        packed.append({"name": part.name, "colour": part.colour, "triangles": len(corners), "motion": motion, **shaded(points, corners)})
    low, high = np.min(ends, axis=0), np.max(ends, axis=0)
    analyses = [{"name": a.name, "meaning": a.meaning, "missing": a.missing(spec)} for a in mechanism.analyses if a.fields]
    size = float(np.linalg.norm(high - low))
    cycle = {"motions": list(motions), "u": floats(fractions(scene.cycle)) if scene else ""}
    return {"unit": "m", "size": size, "low": low.tolist(), "high": high.tolist(), "parts": packed, **cycle, "analyses": analyses}


def displacements(scene: Scene) -> dict[str, str]:
    """{body: its displacements (frames, 3) from the first frame as text} of the bodies that move, without play that is drawn enlarged.

    A point p of the start position is at  (x, y) + R(angle) p.
    """
    packed = {}
    for body in scene.bodies:
        poses = np.asarray(body.poses if body.rest is None else body.rest, float)
        angle = np.unwrap(poses[:, 2]) - poses[0, 2]
        (x, y), c, s = poses[0, :2], np.cos(angle), np.sin(angle)
        moved = np.column_stack([poses[:, 0] - (c * x - s * y), poses[:, 1] - (s * x + c * y), angle])
        if np.any(np.ptp(moved, axis=0) > 0):
            packed[body.name] = floats(moved)
    return packed


def shaded(points: Floats, corners: Ints) -> dict[str, Any]:
    """{"positions", "normals", "edges"} of a closed surface: points (n, 3), corners (m, 3)."""
    shape = surface_shape(points, corners)
    return {"positions": floats(points[shape.corners]), "normals": floats(shape.normals), "edges": floats(points[shape.edges])}


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
