"""The wheel that rolls without slip."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from drivewright._typing import Floats
from drivewright.multibody.bodies import GROUND
from drivewright.multibody.forces.joint_friction import JointFriction, JointFrictionForce
from drivewright.multibody.index import ModelIndex, unit_axis
from drivewright.multibody.joints.joint import Axis, JointDrawing, PointJoint, RowFields, line_direction, travel
from drivewright.multibody.joints.rows import CIRCLE, DISTANCE
from drivewright.multibody.wrenches import NORMAL_OF, ObservedBodies, Wrench
from drivewright.scene import Shape, circle, polygon


@dataclass(frozen=True)
class Rolling(PointJoint):
    """A wheel of `first`, centred at its marker, rolls without slip on a track of `second`.

    The track is a line through the marker of `second` along `axis`, the wheel to the left of it, or, where `track_radius` is not 0,
    a circle about that marker: positive for a wheel outside on it, negative for a wheel inside a ring.
    """

    radius: float
    axis: Axis = (1.0, 0.0)
    track_radius: float = 0.0
    friction: JointFriction | None = None  # its resistance to rolling

    @property
    def idealised(self) -> "Rolling":
        """The same joint without resistance."""
        return replace(self, friction=None)

    @property
    def friction_force(self) -> JointFrictionForce | None:
        """The moment that resists rolling."""
        if self.friction is None:
            return None
        rub = replace(self.friction, guide=self.track_radius)
        return JointFrictionForce(self.name, "wheel", self.first, self.second, rub, self.axis, self.radius)

    def constraint_rows(self, index: ModelIndex) -> list[RowFields]:
        """Fields of its constraint rows."""
        pair = self.pair(index)
        if self.track_radius:
            reach = self.radius + self.track_radius
            return [
                pair | {"kind": DISTANCE, "constant": abs(reach)},
                pair | {"kind": CIRCLE, "gi": self.radius, "gj": self.track_radius, "constant": np.nan},
            ]
        x, y = unit_axis(self.axis, self.name)
        return [
            pair | {"k": pair["j"], "ex": -y, "ey": x, "constant": self.radius},
            pair | {"k": pair["j"], "ex": x, "ey": y, "gi": self.radius, "gj": -self.radius, "constant": np.nan},
        ]

    def wrenches(self, bodies: ObservedBodies) -> list[Wrench]:
        """What it can transmit."""
        point = self._contact_point(bodies)
        return [Wrench({}, *self.bodies, np.broadcast_to(axis, point.shape), point) for axis in ((1.0, 0.0), (0.0, 1.0))]

    def _contact_point(self, bodies: ObservedBodies) -> Floats:
        """Where the wheel touches its track (m, 2) [m]."""
        centre = bodies.point(self.first)
        if not self.track_radius:
            return centre - self.radius * line_direction(self.second.body, self.axis, bodies) @ NORMAL_OF
        hub = bodies.point(self.second)
        offset = centre - hub
        return hub + abs(self.track_radius) * offset / np.hypot(*offset.T)[:, None]

    def own_shapes(self, body: str, drawing: JointDrawing) -> Iterable[Shape]:
        """The wheel, with a radius that shows its rotation."""
        if self.first.body == body:
            x, y = self.first[1:]
            yield Shape("body", circle((x, y), self.radius))
            yield Shape("axis", polygon([(x, y), (x + self.radius, y)], closed=False))

    def guide_shapes(self, body: str, drawing: JointDrawing) -> Iterable[Shape]:
        """The track, as far as the wheel rolls on it."""
        if self.second.body != body:
            return
        layer, origin = "ground" if body == GROUND else "body", np.array(self.second[1:])
        if self.track_radius:
            yield Shape(layer, circle(self.second[1:], abs(self.track_radius)))
            return
        low, high = travel(self.first, self.second, self.axis, drawing)
        ends = low - self.radius, high + self.radius
        yield Shape(layer, polygon([origin + s * np.array(self.axis) for s in ends], closed=False))
