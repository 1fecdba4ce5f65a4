"""The linear actuator: a force along a line of one body on a point of another, over time, travel or velocity along that line."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from drivewright._jit import inner
from drivewright.multibody.bodies import Marker
from drivewright.multibody.curves import curve_at
from drivewright.multibody.forces.element import ForceElement
from drivewright.multibody.forces.load import LoadCurve
from drivewright.multibody.frames import apply_force, relative_motion, rotated
from drivewright.multibody.index import ModelIndex, unit_axis
from drivewright.multibody.records import OneRecord, Records, record_type

TIME, TRAVEL, VELOCITY = range(3)
OVER = {"time": TIME, "travel": TRAVEL, "velocity": VELOCITY}
ACTUATOR = record_type("i j over curve", "ax ay bx by ex ey")


@dataclass(frozen=True)
class LinearActuator(ForceElement):
    """Force on a point of `first` along the line through a point of `second` that has direction `axis` in its frame; its opposite acts on
    `second` in the same point."""

    table: ClassVar[str] = "actuators"

    first: Marker
    second: Marker
    axis: tuple[float, float]
    load: LoadCurve  # over "time" [s], "travel" [m] or "velocity" [m/s]

    def record(self, index: ModelIndex) -> Mapping[str, Any]:
        """Fields of its record."""
        ex, ey = unit_axis(self.axis, self.name)
        return index.pair(self.first, self.second, f"actuator {self.name!r}") | {
            "over": OVER[self.load.over],
            "curve": index.add_curve(self.load.curve),
            "ex": ex,
            "ey": ey,
        }


@inner
def apply_actuator(poses: Records, actuator: OneRecord, curves: Records, pieces: Records, t: float) -> None:
    """The force of an actuator along its line on both bodies, at the time t.  poses (bodies,) of POSE."""
    one, two, x = poses[actuator.i], poses[actuator.j], t
    dx, dy, vx, vy, px, py, qx, qy = relative_motion(poses, actuator)
    ux, uy = rotated(two, actuator.ex, actuator.ey)
    if actuator.over == TRAVEL:
        x = ux * dx + uy * dy
    elif actuator.over == VELOCITY:  # the line turns with its body
        x = ux * vx + uy * vy + two.w * (ux * dy - uy * dx)
    value, _, _ = curve_at(curves, pieces, actuator.curve, x)
    apply_force(one, px, py, value * ux, value * uy)
    apply_force(two, qx + dx, qy + dy, -value * ux, -value * uy)
