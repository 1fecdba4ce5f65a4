"""Loads from outside: torques and forces whose size is given over time, over an angle or over a speed."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from drivewright._jit import inner
from drivewright._typing import Floats
from drivewright.multibody.bodies import GROUND, Marker
from drivewright.multibody.curves import Curve, curve_at, curve_values
from drivewright.multibody.forces.element import ForceElement
from drivewright.multibody.frames import apply_force, apply_torque_pair, rotated
from drivewright.multibody.index import ModelIndex
from drivewright.multibody.records import OneRecord, Records, record_type

TIME, ANGLE, SPEED = range(3)
OVER = {"time": TIME, "angle": ANGLE, "speed": SPEED}
TORQUE = record_type("i j over curve", "")
FORCE = record_type("i over curve follows k", "ax ay ex ey")


@dataclass(frozen=True)
class LoadCurve:
    """A quantity over "time" [s], over the "angle" of `body` relative to `on` [rad], or over their relative "speed" [rad/s]."""

    curve: Curve
    over: str = "time"

    def values(self, times: Floats, angles: Floats, speeds: Floats) -> Floats:
        """The quantity (n,) at these times [s], angles [rad] and speeds [rad/s] of the body, of which one counts."""
        return curve_values(self.curve, {"time": times, "angle": angles, "speed": speeds}[self.over])


@dataclass(frozen=True)
class AppliedTorque(ForceElement):
    """Torque on `body`, its opposite on `on`.  A motor is a torque over the speed."""

    table: ClassVar[str] = "torques"

    body: str
    load: LoadCurve
    on: str = GROUND

    def record(self, index: ModelIndex) -> Mapping[str, Any]:
        """Fields of its record."""
        whose = f"torque {self.name!r}"
        return {
            "i": index.number(self.body, whose),
            "j": index.number(self.on, whose),
            "over": OVER[self.load.over],
            "curve": index.add_curve(self.load.curve),
        }


@dataclass(frozen=True)
class AppliedForce(ForceElement):
    """Force (x, y) times a load factor on a point; `follows` where the direction turns with the body."""

    table: ClassVar[str] = "forces"

    point: Marker
    direction: tuple[float, float]
    load: LoadCurve
    follows: bool = False

    def record(self, index: ModelIndex) -> Mapping[str, Any]:
        """Fields of its record."""
        i = index.number(self.point.body, f"force {self.name!r}")
        (ax, ay), (ex, ey) = index.arm(self.point), self.direction
        return {
            "i": i,
            "over": OVER[self.load.over],
            "curve": index.add_curve(self.load.curve),
            "follows": self.follows,
            "k": i if self.follows else 0,
            "ax": ax,
            "ay": ay,
            "ex": ex,
            "ey": ey,
        }


@inner
def apply_torque(poses: Records, torque: OneRecord, curves: Records, pieces: Records, t: float) -> None:
    """The torque of a load on body i, its opposite on body j, at the time t.  poses (bodies,) of POSE."""
    one, two, x = poses[torque.i], poses[torque.j], t
    if torque.over != TIME:
        x = one.angle - two.angle if torque.over == ANGLE else one.w - two.w
    value, _, _ = curve_at(curves, pieces, torque.curve, x)
    apply_torque_pair(poses, torque, value)


@inner
def apply_load_force(poses: Records, force: OneRecord, curves: Records, pieces: Records, t: float) -> None:
    """The force of a load on its point, at the time t.  poses (bodies,) of POSE."""
    one, ground, x = poses[force.i], poses[0], t
    if force.over != TIME:
        x = one.angle - ground.angle if force.over == ANGLE else one.w - ground.w
    value, _, _ = curve_at(curves, pieces, force.curve, x)
    fx, fy = rotated(poses[force.k], force.ex, force.ey)
    px, py = rotated(one, force.ax, force.ay)
    apply_force(one, px, py, value * fx, value * fy)
