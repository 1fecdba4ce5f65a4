"""The cam and its follower."""

from dataclasses import dataclass

import numpy as np

from drivewright.multibody.bodies import GROUND, Marker
from drivewright.multibody.curves import Curve, curve_slope
from drivewright.multibody.index import ModelIndex, unit_axis
from drivewright.multibody.joints.joint import Axis, Joint, RowFields
from drivewright.multibody.wrenches import ObservedBodies, Wrench, sum_torques


@dataclass(frozen=True)
class CamPair(Joint):
    """A follower that is held to its programme: motion of `follower` relative to `carrier` as a Curve of the cam's angle relative to it.

    With an `axis` (in the carrier's frame) the marker moves along it by lift(cam angle) from the carrier's `origin`; without one
    the follower turns by lift(cam angle).
    """

    cam: str
    follower: Marker
    lift: Curve
    carrier: str = GROUND
    origin: tuple[float, float] = (0.0, 0.0)
    axis: Axis | None = None

    @property
    def bodies(self) -> tuple[str, str]:
        """Names of the two bodies that a message about the joint names."""
        return self.cam, self.follower.body

    @property
    def reaction_marker(self) -> Marker:
        """The point of a body about which its reaction is stated."""
        return self.follower

    def constraint_rows(self, index: ModelIndex) -> list[RowFields]:
        """Fields of its constraint rows."""
        whose = f"cam pair {self.name!r}"
        i, k, l = (index.number(name, whose) for name in (self.follower.body, self.carrier, self.cam))
        row = {"i": i, "j": k, "k": k, "l": l, "lift": index.add_curve(self.lift)}
        if self.axis is None:
            return [row | {"gi": 1.0, "gk": -1.0, "constant": index.angles[self.follower.body] - index.angles[self.carrier]}]
        (ax, ay), (bx, by) = index.arm(self.follower), index.arm(Marker(self.carrier, *self.origin))
        ex, ey = unit_axis(self.axis, self.name)
        return [row | {"ax": ax, "ay": ay, "bx": bx, "by": by, "ex": ex, "ey": ey}]

    def wrenches(self, bodies: ObservedBodies) -> list[Wrench]:
        """Virtual work: F ds = F s'(angle) d(angle) of the cam."""
        slope = curve_slope(self.lift, bodies.field(self.cam, "angle") - bodies.field(self.carrier, "angle"))
        geared = ((self.cam, -slope), (self.carrier, slope))
        if self.axis is None:
            return [Wrench(sum_torques((self.follower.body, 1.0), (self.carrier, -1.0), *geared))]
        axis = bodies.rotated(self.carrier, np.array(self.axis) / np.hypot(*self.axis))
        return [Wrench(sum_torques(*geared), self.follower.body, self.carrier, axis, bodies.point(self.follower))]
