"""How big a linkage's picture is, which points span a body, and the outlines around them."""

import math

import numpy as np

from drivewright.mechanisms.linkage.refusals import CENTROID, GROUND, place, points_of
from drivewright.scene import Arc, Line, Outline, capsule, circle, polygon

SLIM = 0.03  # half the width of a drawn bar over the largest body
SHORT = 0.25  # the same over the shortest distance between two points of a body, at most
NEAR = 1e-9  # points closer than this are one [m]


def nodes(spec, name):
    """Points (n, 2) of a body, each once; the centroid counts where something holds on to it or a single point would be all."""
    named = points_of(spec, name)
    points = distinct(point for key, point in named.items() if key != CENTROID or _held(spec, name))
    return points if len(points) > 1 or name == GROUND else distinct([*points, named[CENTROID]])


def distinct(points):
    """Points (n, 2) without repetitions, in their order."""
    found = []
    for point in points:
        if all(math.dist(point, other) > NEAR for other in found):
            found.append(tuple(point))
    return np.array(found).reshape(-1, 2)


def _held(spec, name):
    """Whether a joint or spring holds on to a body's centroid."""
    return any(place(text) == (name, CENTROID) for item in (*spec.joints, *spec.springs) for text in item.connects)


def extent(spec):
    """The largest distance between two points of a body [m]; of the ground where every body is a point; else a decimetre."""
    spans = [np.ptp(nodes(spec, name), axis=0).max() for name in spec.bodies]
    ground = nodes(spec, GROUND)
    return float(max(spans, default=0.0) or (np.ptp(ground, axis=0).max() if len(ground) else 0.0) or 0.1)


def half_width(spec):
    """Half the width of the drawn bars [m]."""
    gaps = [math.dist(a, b) for name in spec.bodies for n, a in enumerate(nodes(spec, name)) for b in nodes(spec, name)[:n]]
    return min(SLIM * extent(spec), SHORT * min(gaps, default=np.inf))


def rounded(points, radius):
    """Outline of all within `radius` of the convex hull of points (n, 2): a disc, a bar with round ends, a plate with round corners."""
    import shapely

    points = np.asarray(points, float)
    hull = shapely.convex_hull(shapely.MultiPoint(points))
    if hull.geom_type == "Point":
        return circle(points[0], radius)
    if hull.geom_type == "LineString":
        return capsule(*shapely.get_coordinates(hull), radius)
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


def block(center, angle, half_length, half_height):
    """Outline of a rectangle about a point, its length at an angle."""
    along = half_length * np.array([np.cos(angle), np.sin(angle)])
    across = half_height * np.array([-np.sin(angle), np.cos(angle)])
    return polygon([np.asarray(center) + a * along + b * across for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))])


def carried(points, poses):
    """Places (frames, 2) of a point (x, y) of a body through its poses (frames, 3)."""
    x, y = points
    c, s = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    return poses[:, :2] + np.stack([c * x - s * y, s * x + c * y], axis=1)


def turned(vectors, angle):
    """Vectors (frames, 2) turned by angles (frames,)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * vectors[:, 0] - s * vectors[:, 1], s * vectors[:, 0] + c * vectors[:, 1]], axis=1)
