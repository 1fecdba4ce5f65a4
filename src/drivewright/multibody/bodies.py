"""Bodies and the points on them: frozen descriptions, independent of any solver.

Every body has a frame of its own; `Marker` is a point in that frame.  Angles count counter-clockwise.  SI units.
The reserved body "ground" does not move; its frame is the world.
"""

import itertools
import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike

GROUND = "ground"


class Marker(NamedTuple):
    """A point (x, y) [m] in the frame of a body."""

    body: str
    x: float = 0.0
    y: float = 0.0


@dataclass(frozen=True)
class Body:
    """A rigid body.  `angle` is a start guess that picks the assembly; the rates start a mechanism that is free to move."""

    name: str
    mass: float = 0.0  # [kg]
    inertia: float = 0.0  # about the centroid [kg m^2]
    centroid: tuple[float, float] = (0.0, 0.0)  # in the body's frame [m]
    angle: float = 0.0  # of the body's frame in the world [rad]
    velocity: tuple[float, float] | None = None  # of the centroid [m/s]
    angular_velocity: float | None = None  # [rad/s]


def largest_radius_of_gyration(points: ArrayLike, centroid: ArrayLike) -> float | None:
    """Largest radius of gyration about the centroid (2,) [m] of mass within the hull of points (n, 2) [m].

    None where the centroid is outside, or in a corner.

    The largest of sum w r^2 over shares w >= 0 with sum w = 1 and sum w (p - c) = 0.  It is linear in w, so three points at most carry
    mass; of a bar with the ends a and b off its centroid it is sqrt(a b).
    """
    arms = np.asarray(points, dtype=float).reshape(-1, 2) - centroid
    size = np.max(np.abs(arms), initial=0.0)
    best = -1.0
    for corners in itertools.combinations_with_replacement(range(len(arms)), 3):
        equations = np.vstack([arms[list(corners)].T / (size or 1.0), np.ones(3)])
        shares = np.linalg.lstsq(equations, np.array([0.0, 0.0, 1.0]), rcond=None)[0]
        if np.min(shares) > -1e-9 and np.allclose(equations @ shares, [0.0, 0.0, 1.0], atol=1e-9):
            best = max(best, float(shares @ np.sum(arms[list(corners)] ** 2, axis=1)))
    return math.sqrt(best) if best > (1e-6 * size) ** 2 else None
