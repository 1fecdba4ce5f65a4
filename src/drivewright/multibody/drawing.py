"""How bodies and joints are drawn: outlines in the frames of the bodies, from the poses of a motion."""

import math
from collections.abc import Iterable, Mapping

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.multibody.bodies import GROUND
from drivewright.scene import Arc, Line, Outline, Point, capsule, circle, polygon

PIN = 0.5  # radius of a pin over half a bar's width
BLOCK = 2.6  # half the height of a sliding block over half a bar's width
SLIM = 0.03  # half the width of a drawn bar over the largest body
SHORT = 0.25  # the same over the shortest distance between two points of a body, at most
NEAR = 1e-9  # points closer than this are one [m]


def distinct_points(points: Iterable[Iterable[float]]) -> Floats:
    """Points (n, 2) without repetitions, in their order."""
    kept: list[tuple[float, ...]] = []
    for point in points:
        place = tuple(point)
        if all(math.dist(place, other) > NEAR for other in kept):
            kept.append(place)
    return np.array(kept).reshape(-1, 2)


def drawn_extent(points: Mapping[str, Floats]) -> float:
    """The largest distance along an axis between points {body: (n, 2)} of a body [m].

    Of the ground where every body is a point; else a decimetre.
    """
    spans = [np.ptp(of_body, axis=0).max() for name, of_body in points.items() if name != GROUND]
    ground = points.get(GROUND, np.zeros((0, 2)))
    return float(max(spans, default=0.0) or (np.ptp(ground, axis=0).max() if len(ground) else 0.0) or 0.1)


def bar_half_width(points: Mapping[str, Floats]) -> float:
    """Half the width of drawn bars [m], for points {body: (n, 2)} that they span."""
    bodies = [of_body for name, of_body in points.items() if name != GROUND]
    gaps = [math.dist(a, b) for of_body in bodies for n, a in enumerate(of_body) for b in of_body[:n]]
    return min(SLIM * drawn_extent(points), SHORT * min(gaps, default=np.inf))


def rounded(points: ArrayLike, radius: float) -> Outline:
    """Outline of all within `radius` of the convex hull of points (n, 2): a disc, a bar with round ends, a plate with round corners."""
    import shapely

    points = np.asarray(points, float)
    hull = shapely.convex_hull(shapely.MultiPoint(points))
    if hull.geom_type == "Point":
        return circle(points[0], radius)
    if hull.geom_type == "LineString":
        start, end = shapely.get_coordinates(hull)
        return capsule(tuple(start), tuple(end), radius)
    return _plate(shapely.get_coordinates(shapely.orient_polygons(hull))[:-1], radius)


def _plate(corners, radius):
    """Outline at `radius` around a convex polygon whose corners run counter-clockwise."""
    edges = np.roll(corners, -1, axis=0) - corners
    heading = np.arctan2(edges[:, 1], edges[:, 0]) - np.pi / 2  # outward normal of the edge behind each corner
    pieces = []
    for n, corner in enumerate(corners):
        normal = radius * np.array([np.cos(heading[n]), np.sin(heading[n])])
        turn = (heading[n] - heading[n - 1]) % (2 * np.pi)
        end = corners[(n + 1) % len(corners)]
        pieces += [Arc(tuple(corner), radius, heading[n - 1], turn), Line(tuple(corner + normal), tuple(end + normal))]
    return Outline(tuple(pieces))


def block(center: ArrayLike, angle: float, half_length: float, half_height: float) -> Outline:
    """Outline of a rectangle about a point, its length at an angle."""
    along = half_length * np.array([np.cos(angle), np.sin(angle)])
    across = half_height * np.array([-np.sin(angle), np.cos(angle)])
    return polygon([np.asarray(center) + a * along + b * across for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))])


def positions_of(point: Point, poses: Floats) -> Floats:
    """Places (frames, 2) of a point (x, y) of a body through its poses (frames, 3)."""
    x, y = point
    c, s = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    return poses[:, :2] + np.stack([c * x - s * y, s * x + c * y], axis=1)


def rotate(vectors: Floats, angle: Floats) -> Floats:
    """Vectors (frames, 2) turned by angles (frames,)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * vectors[:, 0] - s * vectors[:, 1], s * vectors[:, 0] + c * vectors[:, 1]], axis=1)


def coil_symbol(length: float, height: float, turns: int = 6) -> Outline:
    """A spring's symbol along +x, from the origin; height [m] of its turns to either side."""
    x = np.linspace(0.12, 0.88, 2 * turns) * length
    y = height * np.where(np.arange(2 * turns) % 2, 1.0, -1.0)
    return polygon([(0, 0), (0.08 * length, 0), *zip(x, y, strict=True), (0.92 * length, 0), (length, 0)], closed=False)
