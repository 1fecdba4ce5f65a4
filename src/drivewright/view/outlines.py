"""Outlines as polylines with no more points than a picture needs."""

from functools import lru_cache

import numpy as np

from drivewright._typing import Floats
from drivewright.scene import Outline, Scene

_KEPT = 512  # outlines whose points are remembered: bodies of a scene share shapes, and the next scene has most of them again


class _Itself:
    """An outline with arrays as a key: equal to itself only."""

    def __init__(self, outline: Outline) -> None:
        self.outline = outline

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Itself) and self.outline is other.outline

    def __hash__(self) -> int:
        return id(self.outline)

    def points(self, tolerance: float) -> Floats:
        return self.outline.points(tolerance)


def _key(outline: Outline) -> "Outline | _Itself":
    """What the points of an outline are remembered by."""
    try:
        hash(outline)
    except TypeError:
        return _Itself(outline)
    return outline


def simplified_points(outline: Outline, tolerance: float) -> Floats:
    """Points (n, 2) of an outline, read-only, each dropped that lies within `tolerance` [m] of the line through its neighbours."""
    return _simplified_points(
        _key(outline), 2.0 ** (np.floor(8 * np.log2(tolerance)) / 8)
    )  # in steps, which a picture that grows a little keeps


@lru_cache(maxsize=_KEPT)
def _simplified_points(outline: "Outline | _Itself", tolerance: float) -> Floats:
    import shapely

    points = outline.points(tolerance)
    kept = shapely.get_coordinates(shapely.simplify(shapely.linestrings(points), tolerance, preserve_topology=False))
    kept = kept if len(kept) > 2 or len(points) < 3 else np.array(points)
    kept.setflags(write=False)
    return kept


def overall_size(scene: Scene) -> float:
    """A length that stands for the whole scene: the larger of the spread of the bodies' origins and the largest shape [m]."""
    spots = np.concatenate([np.asarray(body.poses)[:, :2] for body in scene.bodies])
    extents = (_extent(_key(shape.outline)) for body in scene.bodies for shape in body.shapes)
    return max(float(np.ptp(spots, axis=0).max()), *extents, 1e-9)


@lru_cache(maxsize=_KEPT)
def _extent(outline: "Outline | _Itself") -> float:
    return float(np.ptp(outline.points(1e-3), axis=0).max())
