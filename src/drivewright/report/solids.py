"""An assembly as triangles for a viewer, and how its parts move: flat arrays for the graphics card, as base64 text."""

import base64
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from drivewright._typing import Floats, Ints
from drivewright.errors import counted
from drivewright.report.pack import floats
from drivewright.scene import Body, Part, Scene, Turning, place
from drivewright.solids import facets
from drivewright.solids.shading import surface_shape
from drivewright.view.motion import fractions

TOLERANCE = 3e-5  # m: chords stay about so near to a round surface
MOST_TRIANGLES = 120_000  # of a report: about 5 MB of text
STRAIGHT = 1e-6  # rad, and part of the radius: so near to a half-plane lies what is in it
MOST_SHORT = 65536  # points that two bytes number


class SolidSurface(NamedTuple):
    """A part as triangles at its start position: points (n, 3) [m], corners (m, 3) counter-clockwise from outside.

    It moves by its `turning`, else with `body`.
    """

    name: str
    colour: str
    body: str
    points: Floats
    corners: Ints
    turning: Turning | None = None


def solid_surfaces(
    parts: Sequence[Part], progress: Callable[[int, int, str], object] | None = None, most: int | None = None
) -> tuple[SolidSurface, ...]:
    """The surfaces of parts, chords within about `TOLERANCE` of round ones.

    MissingExtra where a part needs the CAD kernel, InputError where there are more than `most` triangles.
    """
    made: list[SolidSurface] = []
    for number, part in enumerate(parts):
        if progress:
            progress(number, len(parts), part.name)
        made.append(SolidSurface(part.name, part.colour, part.body or part.name, *facets.viewed_triangles(part, TOLERANCE), part.turning))
        if most is not None:
            counted(
                sum(len(each.corners) for each in made),
                most,
                "triangles of the solids of a report",
                "export STEP or STL, which hold them all",
            )
    return tuple(made)


def pack_solids(surfaces: Sequence[SolidSurface], scene: Scene | None) -> dict[str, Any]:
    """{"unit": "m", "size", "low", "high", "motions", "turns", "u",
    "parts": [{"name", "colour", "triangles", "motion", "turn", ...`shaded`}], "repeats": [{"part", "motion"}]}.

    motions: base64 of (frames, 3) displacements (x, y, angle) from the start position about the z axis, at the phases `u` of the cycle;
    turns: [{"point", "direction", "angles": base64 of (frames,)}].  `motion` or `turn` of a part is the number of its own, -1 without.
    repeats: parts by their number that are there once more, as `repeats` finds them, each with its own motion.
    """
    packed: list[dict[str, Any]] = []
    moving = displacements(scene) if scene else {}
    motions: dict[str, int] = {}
    turns: list[dict[str, Any]] = []
    for each in surfaces:
        moved = None if each.turning else moving.get(each.body)
        motion = motions.setdefault(moved, len(motions)) if moved else -1
        turn = _numbered_turn(each.turning, turns) if each.turning and scene else -1
        known = {"name": each.name, "colour": each.colour, "triangles": len(each.corners), "motion": motion, "turn": turn}
        packed.append({**known, **shaded(each.points, each.corners, each.turning)})
    again = [
        {"part": number, "motion": motions.setdefault(floats(displacement(body, model)), len(motions))}
        for number, model, body in (repeats(surfaces, scene) if scene else ())
    ]
    low, high = (end([end(each.points, axis=0) for each in surfaces], axis=0) for end in (np.min, np.max))
    cycle = {"motions": list(motions), "turns": turns, "u": floats(fractions(scene.cycle)) if scene else ""}
    size = float(np.linalg.norm(high - low))
    return {"unit": "m", "size": size, "low": low.tolist(), "high": high.tolist(), "parts": packed, "repeats": again, **cycle}


def _numbered_turn(turning: Turning, turns: list[dict[str, Any]]) -> int:
    """The number of a turning among those that are packed, where it is put unless it is there."""
    packed = {"point": list(turning.point), "direction": list(turning.direction), "angles": floats(turning.angles)}
    if packed not in turns:
        turns.append(packed)
    return turns.index(packed)


def repeats(surfaces: Sequence[SolidSurface], scene: Scene) -> Iterator[tuple[int, Body, Body]]:
    """(number of a surface, the body that it moves with, another body with the same shapes that has no surface of its own).

    A chain has solids of its first links alone, for a CAD file; the others repeat them in turn.
    """
    of_body: dict[str, list[int]] = {}
    for number, each in enumerate(surfaces):
        if each.turning is None:
            of_body.setdefault(each.body, []).append(number)
    alike: dict[int, list[Body]] = {}
    for body in scene.bodies:
        alike.setdefault(id(body.shapes), []).append(body)
    for family in alike.values():
        models = [body for body in family if body.name in of_body]
        for number_of, body in enumerate(family):
            if models and body.name not in of_body:
                model = models[number_of % len(models)]
                yield from ((number, model, body) for number in of_body[model.name])


def with_repeats(surfaces: Sequence[SolidSurface], scene: Scene | None) -> tuple[SolidSurface, ...]:
    """The surfaces and those that repeat them, all at the start position."""
    more = []
    for number, model, body in repeats(surfaces, scene) if scene else ():
        points = surfaces[number].points
        moved = np.column_stack([place(points[:, :2], displacement(body, model)[0]), points[:, 2]])
        more.append(surfaces[number]._replace(body=body.name, points=moved))
    return (*surfaces, *more)


def displacements(scene: Scene) -> dict[str, str]:
    """{body: its `displacement` as text} of the bodies that move."""
    moved = {body.name: displacement(body, body) for body in scene.bodies}
    return {name: floats(each) for name, each in moved.items() if np.any(np.ptp(each, axis=0) > 0)}


def displacement(body: Body, start: Body) -> Floats:
    """How a body is displaced (frames, 3) from where `start` is in the first frame, without play that is drawn enlarged.

    A point p of that position is at  (x, y) + R(angle) p.
    """
    poses, (x, y, turned) = _true_poses(body), _true_poses(start)[0]
    angle = np.unwrap(poses[:, 2]) - turned
    c, s = np.cos(angle), np.sin(angle)
    return np.column_stack([poses[:, 0] - (c * x - s * y), poses[:, 1] - (s * x + c * y), angle])


def _true_poses(body: Body) -> Floats:
    return np.asarray(body.poses if body.rest is None else body.rest, float)


def shaded(points: Floats, corners: Ints, turning: Turning | None = None) -> dict[str, Any]:
    """{"positions", "normals", "corners", "edges"} of a closed surface: points (n, 3), corners (m, 3).

    positions and normals: base64 of float32 x, y, z, every different pair once; corners: three numbers of such pairs a triangle,
    counter-clockwise from outside; edges: two of them each, numbers as `numbered`.  A round part that turns has its meridian among them,
    or nobody would see it turn.
    """
    shape = surface_shape(points, corners)
    rows = np.column_stack([points[shape.corners.ravel()], shape.normals.reshape(-1, 3)]).astype("<f4")
    vertices, numbers = np.unique(rows + np.float32(0.0), axis=0, return_inverse=True)  # + 0: a normal -0 is 0
    numbers = np.ravel(numbers)
    of_point = np.zeros(len(points), int)
    of_point[shape.corners.ravel()] = numbers
    count = len(vertices)
    edges = shape.edges if turning is None else np.concatenate([shape.edges, meridian(points, shape.corners, turning)])
    return {
        "positions": floats(vertices[:, :3]),
        "normals": floats(vertices[:, 3:]),
        "corners": numbered(numbers, count),
        "edges": numbered(of_point[edges], count),
    }


def meridian(points: Floats, corners: Ints, turning: Turning) -> Ints:
    """Sides (k, 2) of triangles in one half-plane through the axis of a part that is round about it; none of another part."""
    along = np.asarray(turning.direction) / np.linalg.norm(turning.direction)
    arms = points - turning.point
    arms = arms - np.outer(arms @ along, along)
    radius = np.linalg.norm(arms, axis=1)
    first = arms[np.argmax(radius)] / radius.max()
    at = np.arctan2(arms @ np.cross(along, first), arms @ first)
    sides = np.unique(np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2), axis=1), axis=0)
    lying = np.all((np.abs(at[sides]) < STRAIGHT) & (radius[sides] > STRAIGHT * radius.max()), axis=1)
    count = len(np.unique(at.round(3)))
    return sides[lying] if count * np.sum(lying) < len(sides) else np.zeros((0, 2), int)


def numbered(values: Ints, count: int) -> str:
    """base64 of whole numbers below `count`: as uint16 where all below have room there, else as uint32."""
    return base64.b64encode(np.ascontiguousarray(values, "<u2" if count <= MOST_SHORT else "<u4").tobytes()).decode()
