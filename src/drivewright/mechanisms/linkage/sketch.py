"""How big a linkage's picture is, which points span a body, and the outlines around them."""

import math
from collections.abc import Iterable

import numpy as np

from drivewright._typing import Floats
from drivewright.mechanisms.linkage.refusals import CENTROID, GROUND, place, points_of
from drivewright.mechanisms.linkage.spec import LinkageSpec

SLIM = 0.03  # half the width of a drawn bar over the largest body
SHORT = 0.25  # the same over the shortest distance between two points of a body, at most
NEAR = 1e-9  # points closer than this are one [m]


def nodes(spec: LinkageSpec, name: str) -> Floats:
    """Points (n, 2) of a body, each once; the centroid counts where something holds on to it or a single point would be all."""
    named = points_of(spec, name)
    points = distinct(point for key, point in named.items() if key != CENTROID or _held(spec, name))
    return points if len(points) > 1 or name == GROUND else distinct([*points, named[CENTROID]])


def distinct(points: Iterable[Iterable[float]]) -> Floats:
    """Points (n, 2) without repetitions, in their order."""
    found = []
    for point in points:
        if all(math.dist(point, other) > NEAR for other in found):
            found.append(tuple(point))
    return np.array(found).reshape(-1, 2)


def _held(spec, name):
    """Whether a joint or spring holds on to a body's centroid."""
    return any(place(text) == (name, CENTROID) for item in (*spec.joints, *spec.springs) for text in item.connects)


def extent(spec: LinkageSpec) -> float:
    """The largest distance between two points of a body [m]; of the ground where every body is a point; else a decimetre."""
    spans = [np.ptp(nodes(spec, name), axis=0).max() for name in spec.bodies]
    ground = nodes(spec, GROUND)
    return float(max(spans, default=0.0) or (np.ptp(ground, axis=0).max() if len(ground) else 0.0) or 0.1)


def half_width(spec: LinkageSpec) -> float:
    """Half the width of the drawn bars [m]."""
    gaps = [math.dist(a, b) for name in spec.bodies for n, a in enumerate(nodes(spec, name)) for b in nodes(spec, name)[:n]]
    return min(SLIM * extent(spec), SHORT * min(gaps, default=np.inf))
