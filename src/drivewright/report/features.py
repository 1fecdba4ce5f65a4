"""What can be measured on a packed scene: lines and arcs of its outlines, exact, which the chords of a picture no longer show."""

from typing import Any

from drivewright.scene import Arc, Line, Outline, Scene, Shape

MOST_LINES = 40  # of an outline; with more it is a curve, whose chords mean nothing


def pack_features(scene: Scene) -> list[dict[str, Any]]:
    """For each shape of `pack_scene`, in its order: {"lines": [[x0, y0, x1, y1]], "arcs": [[x, y, radius, start, sweep]]} [m, rad]."""
    shapes: dict[int, Shape] = {}
    for owner in (*scene.bodies, *scene.frames):
        for shape in owner.shapes:
            shapes.setdefault(id(shape), shape)
    return [_features(shape.outline) for shape in shapes.values()]


def _features(outline: Outline) -> dict[str, Any]:
    lines = [[*map(float, (*piece.start, *piece.end))] for piece in outline.pieces if isinstance(piece, Line)]
    arcs = [[*map(float, (*piece.center, piece.radius, piece.start, piece.sweep))] for piece in outline.pieces if isinstance(piece, Arc)]
    return {"lines": lines if len(lines) <= MOST_LINES else [], "arcs": arcs if len(arcs) <= MOST_LINES else []}
