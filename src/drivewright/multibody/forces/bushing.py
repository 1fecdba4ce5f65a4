"""The pin in rubber: springs and dampers along both directions and about the pin."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from drivewright._jit import inner
from drivewright.multibody.bodies import Marker
from drivewright.multibody.forces.element import ForceElement
from drivewright.multibody.frames import apply_force, apply_torque_pair, relative_motion
from drivewright.multibody.index import ModelIndex
from drivewright.multibody.records import OneRecord, Records, record_type
from drivewright.multibody.wrenches import ObservedBodies, Reaction, cross

BUSHING = record_type("i j", "ax ay bx by stiffness damping rotational_stiffness rotational_damping rest")


@dataclass(frozen=True)
class Bushing:
    """Springs and dampers between the pin's two halves: along both directions and about the pin."""

    stiffness: float  # [N/m]
    damping: float = 0.0  # [N s/m]
    rotational_stiffness: float = 0.0  # [N m/rad]
    rotational_damping: float = 0.0  # [N m s/rad]

    clearance: ClassVar[float] = 0.0
    noun: ClassVar[str] = "bushing"


@dataclass(frozen=True)
class BushingForce(ForceElement):
    """The force of a `Bushing` between a point of `first` and a point of `second`."""

    table: ClassVar[str] = "bushings"

    first: Marker
    second: Marker
    bushing: Bushing

    def record(self, index: ModelIndex) -> Mapping[str, Any]:
        """Fields of its record."""
        pair = index.pair(self.first, self.second, f"joint {self.name!r}")
        return pair | {
            "stiffness": self.bushing.stiffness,
            "damping": self.bushing.damping,
            "rotational_stiffness": self.bushing.rotational_stiffness,
            "rotational_damping": self.bushing.rotational_damping,
            "rest": index.angles[self.first.body] - index.angles[self.second.body],
        }

    def reaction(self, number: int, bodies: ObservedBodies) -> Reaction:
        """From the displacement and the rotation of its halves; `rest` is their angle at the start."""
        model, one, two = self.bushing, self.first, self.second
        rest = bodies.start_angles[one.body] - bodies.start_angles[two.body]
        displacement, rate = bodies.point(one) - bodies.point(two), bodies.velocity(one) - bodies.velocity(two)
        force = -model.stiffness * displacement - model.damping * rate
        turned, spin = (bodies.field(one.body, name) - bodies.field(two.body, name) for name in ("angle", "w"))
        twist = -model.rotational_stiffness * (turned - rest) - model.rotational_damping * spin
        return Reaction(force, twist - cross(displacement, force))


@inner
def apply_bushing(poses: Records, bush: OneRecord) -> None:
    """Both points and both angles are pulled together; the force acts at the point of j on both, so that it has no arm of its own.

    poses (bodies,) of POSE.
    """
    dx, dy, vx, vy, px, py, qx, qy = relative_motion(poses, bush)
    fx, fy = bush.stiffness * dx + bush.damping * vx, bush.stiffness * dy + bush.damping * vy
    apply_force(poses[bush.i], px - dx, py - dy, -fx, -fy)
    apply_force(poses[bush.j], qx, qy, fx, fy)
    angle, rate = poses[bush.i].angle - poses[bush.j].angle, poses[bush.i].w - poses[bush.j].w
    apply_torque_pair(poses, bush, -bush.rotational_stiffness * (angle - bush.rest) - bush.rotational_damping * rate)
