"""Outlines as polylines with no more points than a picture needs."""

import numpy as np


def thinned(outline, tolerance):
    """Points (n, 2) of an outline, each dropped that lies within `tolerance` [m] of the line through its neighbours."""
    import shapely

    points = outline.points(tolerance)
    kept = shapely.get_coordinates(shapely.simplify(shapely.linestrings(points), tolerance, preserve_topology=False))
    return kept if len(kept) > 2 or len(points) < 3 else points


def overall_size(scene):
    """A length that stands for the whole scene: the larger of the spread of the bodies' origins and the largest shape [m]."""
    spots = np.concatenate([np.asarray(body.poses)[:, :2] for body in scene.bodies])
    shapes = [shape.outline.points(1e-3) for body in scene.bodies for shape in body.shapes]
    return max(float(np.ptp(spots, axis=0).max()), *(float(np.ptp(points, axis=0).max()) for points in shapes), 1e-9)
