"""The spring with a damper about the angle between two bodies."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from drivewright._jit import inner
from drivewright.multibody.bodies import GROUND
from drivewright.multibody.forces.element import ForceElement
from drivewright.multibody.frames import apply_torque_pair
from drivewright.multibody.index import ModelIndex
from drivewright.multibody.records import OneRecord, Records, record_type

ROTATIONAL_SPRING = record_type("i j", "stiffness rest damping")


@dataclass(frozen=True)
class RotationalSpring(ForceElement):
    """Torque on `first`, its opposite on `second`: -k (angle - rest) - c rate, of first relative to second."""

    table: ClassVar[str] = "rotational_springs"

    first: str
    second: str = GROUND
    stiffness: float = 0.0
    rest: float = 0.0
    damping: float = 0.0

    def record(self, index: ModelIndex) -> Mapping[str, Any]:
        """Fields of its record."""
        whose = f"rotational spring {self.name!r}"
        return {
            "i": index.number(self.first, whose),
            "j": index.number(self.second, whose),
            "stiffness": self.stiffness,
            "rest": self.rest,
            "damping": self.damping,
        }


@inner
def apply_rotational_spring(poses: Records, spring: OneRecord) -> None:
    """Torque -k (angle - rest) - c rate on body i, its opposite on body j.  poses (bodies,) of POSE."""
    angle, rate = poses[spring.i].angle - poses[spring.j].angle, poses[spring.i].w - poses[spring.j].w
    apply_torque_pair(poses, spring, -spring.stiffness * (angle - spring.rest) - spring.damping * rate)
