"""The pin in a slot."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from drivewright.multibody.bodies import GROUND
from drivewright.multibody.drawing import PIN, rounded
from drivewright.multibody.forces.joint_friction import JointFriction, JointFrictionForce
from drivewright.multibody.index import ModelIndex, unit_axis
from drivewright.multibody.joints.joint import SLIDING_PIN, Axis, JointDrawing, PointJoint, RowFields, TreeRole, line_direction, travel
from drivewright.multibody.wrenches import NORMAL_OF, ObservedBodies, Wrench
from drivewright.scene import Shape, circle


@dataclass(frozen=True)
class PinSlot(PointJoint):
    """A point of `first` slides along a line of `second` and may turn."""

    axis: Axis = (1.0, 0.0)
    friction: JointFriction | None = None

    @property
    def idealised(self) -> "PinSlot":
        """The same joint without friction."""
        return replace(self, friction=None)

    @property
    def friction_force(self) -> JointFrictionForce | None:
        """The friction of the pin in its slot."""
        return JointFrictionForce(self.name, "slot", self.first, self.second, self.friction, self.axis) if self.friction else None

    @property
    def tree_role(self) -> TreeRole:
        """How it carries a body in the spanning tree."""
        return TreeRole(SLIDING_PIN, turns=True, slides=True, from_parent=False)

    @property
    def slide_axis(self) -> Axis:
        """Direction in the frame of `second` along which the body slides that it carries."""
        return self.axis

    def constraint_rows(self, index: ModelIndex) -> list[RowFields]:
        """Fields of its constraint rows."""
        pair, (x, y) = self.pair(index), unit_axis(self.axis, self.name)
        return [pair | {"k": pair["j"], "ex": -y, "ey": x}]

    @property
    def driven_motion(self) -> str:
        """What a drive prescribes: the place of the pin along its slot."""
        return "displacement"

    def drive_wrench(self, bodies: ObservedBodies, mover: str, base: str) -> Wrench:
        """What a drive of the joint gives to the body that it moves, and takes from the one on which it rests."""
        return Wrench({}, mover, base, line_direction(self.second.body, self.axis, bodies), bodies.point(self.first))

    def wrenches(self, bodies: ObservedBodies) -> list[Wrench]:
        """What it can transmit."""
        return [Wrench({}, *self.bodies, line_direction(self.second.body, self.axis, bodies) @ NORMAL_OF, bodies.point(self.first))]

    def guide_shapes(self, body: str, drawing: JointDrawing) -> Iterable[Shape]:
        """A slot as long as the travel."""
        if self.second.body != body:
            return
        along, origin, (low, high) = np.array(self.axis), np.array(self.second[1:]), travel(self.first, self.second, self.axis, drawing)
        slot = [origin + low * along, origin + high * along]
        if body != GROUND:
            yield Shape("body", rounded([*slot, origin], drawing.half_width))
        yield Shape("hole", rounded(slot, 1.3 * PIN * drawing.half_width))

    def pin_shapes(self, body: str, drawing: JointDrawing) -> Iterable[Shape]:
        """Its pin, on one of the two bodies."""
        if self.first.body == body:
            yield Shape("hole", circle(self.first[1:], PIN * drawing.half_width))
