"""How bodies and joints are drawn: outlines in the frames of the bodies, from the poses of a motion."""

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.scene import Arc, Line, Outline, Point, capsule, circle, polygon

PIN = 0.5  # radius of a pin over half a bar's width
BLOCK = 2.6  # half the height of a sliding block over half a bar's width


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
