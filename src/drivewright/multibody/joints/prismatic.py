"""The prismatic joint."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from drivewright.multibody.bodies import GROUND
from drivewright.multibody.drawing import BLOCK, block
from drivewright.multibody.forces.joint_friction import JointFriction, JointFrictionForce
from drivewright.multibody.index import ModelIndex, unit_axis
from drivewright.multibody.joints.joint import PRISMATIC, Axis, JointDrawing, PointJoint, RowFields, TreeRole, line_direction, travel
from drivewright.multibody.wrenches import NORMAL_OF, ObservedBodies, Wrench, sum_torques
from drivewright.scene import Shape, polygon


@dataclass(frozen=True)
class Prismatic(PointJoint):
    """A point of `first` slides along a line of `second` that has direction `axis` in its frame; no relative rotation."""

    axis: Axis = (1.0, 0.0)
    friction: JointFriction | None = None

    @property
    def idealised(self) -> "Prismatic":
        """The same joint without friction."""
        return replace(self, friction=None)

    @property
    def friction_force(self) -> JointFrictionForce | None:
        """The friction of the slide."""
        return JointFrictionForce(self.name, "slide", self.first, self.second, self.friction, self.axis) if self.friction else None

    @property
    def tree_role(self) -> TreeRole:
        """How it carries a body in the spanning tree."""
        return TreeRole(PRISMATIC, turns=False, slides=True, from_parent=True)

    @property
    def slide_axis(self) -> Axis:
        """Direction in the frame of `second` along which the body slides that it carries."""
        return self.axis

    def constraint_rows(self, index: ModelIndex) -> list[RowFields]:
        """Fields of its constraint rows."""
        pair, (x, y) = self.pair(index), unit_axis(self.axis, self.name)
        locked = index.angles[self.first.body] - index.angles[self.second.body]
        across = pair | {"k": pair["j"], "ex": -y, "ey": x}
        return [across, {"i": pair["i"], "j": pair["j"], "lift": -1, "gi": 1.0, "gj": -1.0, "constant": locked}]

    @property
    def driven_motion(self) -> str:
        """What a drive prescribes."""
        return "displacement"

    def drive_wrench(self, bodies: ObservedBodies, mover: str, base: str) -> Wrench:
        """What a drive of the joint gives to the body that it moves, and takes from the one on which it rests."""
        return Wrench({}, mover, base, line_direction(self.second.body, self.axis, bodies), bodies.point(self.first))

    def wrenches(self, bodies: ObservedBodies) -> list[Wrench]:
        """What it can transmit."""
        across = Wrench({}, *self.bodies, line_direction(self.second.body, self.axis, bodies) @ NORMAL_OF, bodies.point(self.first))
        return [across, Wrench(sum_torques((self.first.body, 1.0), (self.second.body, -1.0)))]

    def own_shapes(self, body: str, drawing: JointDrawing) -> Iterable[Shape]:
        """The sliding block."""
        if self.first.body == body:
            turned = drawing.poses[self.second.body][0, 2] + np.arctan2(self.axis[1], self.axis[0]) - drawing.poses[body][0, 2]
            yield Shape("body", block(self.first[1:], turned, 3.2 * drawing.half_width, BLOCK * drawing.half_width))

    def guide_shapes(self, body: str, drawing: JointDrawing) -> Iterable[Shape]:
        """Two rails as long as the travel."""
        if self.second.body != body:
            return
        along, across = np.array(self.axis), np.array([-self.axis[1], self.axis[0]])
        low, high = travel(self.first, self.second, self.axis, drawing)
        origin, slim = np.array(self.second[1:]), drawing.half_width
        ends = low - 4 * slim, high + 4 * slim
        for side, (a, b) in ((-1, ends), (1, ends[::-1])):  # ground is hatched on the right of a line
            rail = polygon([origin + s * along + side * BLOCK * slim * across for s in (a, b)], closed=False)
            yield Shape("ground" if body == GROUND else "body", rail)
