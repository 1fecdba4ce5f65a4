"""The spring with a damper between two points."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from drivewright._jit import inner
from drivewright.multibody.bodies import Marker
from drivewright.multibody.forces.element import ForceElement
from drivewright.multibody.frames import apply_force, relative_motion
from drivewright.multibody.index import ModelIndex
from drivewright.multibody.records import OneRecord, Records, record_type
from drivewright.numerics.lanes import where

SPRING = record_type("i j", "ax ay bx by stiffness free_length damping")


@dataclass(frozen=True)
class PointSpring(ForceElement):
    """Spring and damper between two points: tension k (L - L0) + c L'."""

    table: ClassVar[str] = "springs"

    first: Marker
    second: Marker
    stiffness: float
    free_length: float = 0.0
    damping: float = 0.0

    def record(self, index: ModelIndex) -> Mapping[str, Any]:
        """Fields of its record."""
        return index.pair(self.first, self.second, f"spring {self.name!r}") | {
            "stiffness": self.stiffness,
            "free_length": self.free_length,
            "damping": self.damping,
        }


@inner
def apply_spring(poses: Records, spring: OneRecord) -> None:
    """Tension k (L - L0) + c L' along the line between the points.  poses (bodies,) of POSE."""
    dx, dy, vx, vy, px, py, qx, qy = relative_motion(poses, spring)
    length = np.sqrt(dx * dx + dy * dy)
    divisor = where(length == 0.0, 1.0, length)  # then there is no direction and no force
    ux, uy = dx / divisor, dy / divisor
    tension = spring.stiffness * (length - spring.free_length) + spring.damping * (ux * vx + uy * vy)
    apply_force(poses[spring.i], px, py, -tension * ux, -tension * uy)
    apply_force(poses[spring.j], qx, qy, tension * ux, tension * uy)
