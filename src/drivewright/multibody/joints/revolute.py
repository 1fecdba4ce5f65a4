"""The pin, without play or with one of the models of its play."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from drivewright.multibody.bodies import GROUND, Body, Marker
from drivewright.multibody.drawing import PIN as PIN_RADIUS
from drivewright.multibody.forces.bushing import Bushing, BushingForce
from drivewright.multibody.forces.contact import Dry, Lubricated, PinContact
from drivewright.multibody.forces.element import ForceElement
from drivewright.multibody.forces.joint_friction import JointFriction, JointFrictionForce
from drivewright.multibody.forces.rotational_spring import RotationalSpring
from drivewright.multibody.index import ModelIndex
from drivewright.multibody.joints.joint import PIN, Expansion, Joint, JointDrawing, PointJoint, RowFields, TreeRole
from drivewright.multibody.joints.pin_models import Ideal, MasslessLink, PinModel, Play
from drivewright.multibody.wrenches import ObservedBodies, Wrench, sum_torques
from drivewright.scene import Shape, circle


@dataclass(frozen=True)
class Revolute(PointJoint):
    """A pin.  `first` carries the bearing (bush), `second` the journal; only a joint with play can tell them apart."""

    model: PinModel = Ideal()
    friction: JointFriction | None = None  # of an ideal pin

    @property
    def is_constraint(self) -> bool:
        """Whether it takes freedom away."""
        return isinstance(self.model, Ideal)

    @property
    def tree_role(self) -> TreeRole | None:
        """How it carries a body in the spanning tree."""
        return TreeRole(PIN, turns=True, slides=False, from_parent=False) if self.is_constraint else None

    @property
    def idealised(self) -> "Revolute":
        """The same joint without play and friction."""
        return replace(self, model=Ideal(), friction=None)

    @property
    def play(self) -> Play | None:
        """The model of a pin that is not ideal."""
        return None if isinstance(self.model, Ideal) else self.model

    @property
    def dry_contact(self) -> Dry | None:
        """The contact of a pin that separates and impacts."""
        model = self.model
        return model.contact if isinstance(model, Lubricated) else model if isinstance(model, Dry) else None

    @property
    def massless_link(self) -> MasslessLink | None:
        """The massless link that stands for the play of a pin."""
        return self.model if isinstance(self.model, MasslessLink) else None

    @property
    def expansion(self) -> Expansion | None:
        """A massless link is a body of its own, named link:JOINT, between two ideal pins."""
        model = self.massless_link
        if model is None:
            return None
        link = Body(f"link:{self.name}", angle=model.angle)
        pins: tuple[Joint, ...] = (
            Revolute(self.name, self.first, Marker(link.name)),
            Revolute(far_end_name(self), Marker(link.name, model.clearance), self.second),
        )
        return Expansion((link,), pins, (RotationalSpring(link.name, link.name, damping=model.damping),))

    @property
    def force_element(self) -> ForceElement | None:
        """The force that a joint with play, or one that gives way, consists of."""
        model, ends = self.model, (self.name, self.first, self.second)
        if isinstance(model, Bushing):
            return BushingForce(*ends, model)
        return PinContact(*ends, model) if isinstance(model, (Dry, Lubricated)) else None

    @property
    def friction_force(self) -> JointFrictionForce | None:
        """The friction of an ideal pin."""
        if self.friction is None or not self.is_constraint:
            return None
        return JointFrictionForce(self.name, "pin", self.first, self.second, self.friction, radius=self.friction.arm)

    @property
    def pin_markers(self) -> tuple[Marker, Marker]:
        """Its two points where it is a pin, about which both bodies turn."""
        return self.first, self.second

    def constraint_rows(self, index: ModelIndex) -> list[RowFields]:
        """Fields of its constraint rows."""
        pair = self.pair(index)
        return [pair | {"ex": 1.0}, pair | {"ey": 1.0}]

    @property
    def driven_motion(self) -> str:
        """What a drive prescribes."""
        return "rotation"

    def drive_wrench(self, bodies: ObservedBodies, mover: str, base: str) -> Wrench:
        """What a drive of the joint gives to the body that it moves, and takes from the one on which it rests."""
        return Wrench(sum_torques((mover, 1.0)) if base == GROUND else sum_torques((mover, 1.0), (base, -1.0)))

    def wrenches(self, bodies: ObservedBodies) -> list[Wrench]:
        """What it can transmit."""
        point = bodies.point(self.first)
        return [Wrench({}, *self.bodies, np.broadcast_to(axis, point.shape), point) for axis in ((1.0, 0.0), (0.0, 1.0))]

    def pin_shapes(self, body: str, drawing: JointDrawing) -> Iterable[Shape]:
        """A pin without play, on the body of the two that is drawn later."""
        upper = max((self.first, self.second), key=lambda marker: drawing.order.index(marker.body))
        if self.is_constraint and upper.body == body:
            yield Shape("hole", circle(upper[1:], PIN_RADIUS * drawing.half_width))

    @property
    def support_markers(self) -> tuple[Marker, ...]:
        """Points that are drawn as a support where they are on the ground."""
        return self.first, self.second


def far_end_name(joint: Joint) -> str:
    """Name of the pin at the other end of the massless link that stands for the play of a joint."""
    return f"{joint.name} (link)"
