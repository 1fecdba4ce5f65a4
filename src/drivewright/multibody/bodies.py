"""Bodies and the points on them: frozen descriptions that know no solver.

Every body has a frame of its own; `Marker` is a point in that frame.  Angles count counter-clockwise.  SI units.
The reserved body "ground" does not move; its frame is the world.
"""

from dataclasses import dataclass
from typing import NamedTuple

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
