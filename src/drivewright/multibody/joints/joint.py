"""The interface of a joint: its role in the spanning tree, its constraint rows, its reaction, its drawing.

A joint is one frozen class in one file, of this or of any other package; nothing outside asks for its type.  What a joint does not
override is what a joint without that ability answers.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import Floats
from drivewright.multibody.bodies import Body, Marker
from drivewright.multibody.drawing import positions_of, rotate
from drivewright.multibody.index import ModelIndex
from drivewright.multibody.wrenches import ObservedBodies, Reaction, Wrench, cross
from drivewright.scene import Shape

if TYPE_CHECKING:
    from drivewright.multibody.forces.contact import Dry
    from drivewright.multibody.forces.element import ForceElement
    from drivewright.multibody.forces.joint_friction import JointFrictionForce
    from drivewright.multibody.joints.pin_models import MasslessLink, Play

RowFields: TypeAlias = Mapping[str, Any]  # fields of system.ROW; `kind` is a number of system, or an equation under @implements(row_terms)
Axis: TypeAlias = tuple[float, float]  # a direction in a body's frame, of any length
PRISMATIC, PIN, SLIDING_PIN = range(3)  # order in which joints are taken into the spanning tree, behind those that are driven


class TreeRole(NamedTuple):
    """How a joint carries a body in the spanning tree: order in which it is taken, whether the body turns and slides against its parent,
    and whether its angle counts from the parent's (else from the world)."""

    order: int
    turns: bool
    slides: bool
    from_parent: bool


class Expansion(NamedTuple):
    """Bodies, joints and forces that stand for a joint in the model that is simulated."""

    bodies: "tuple[Body, ...]"
    joints: "tuple[Joint, ...]"
    forces: "tuple[ForceElement, ...]"


class JointDrawing(NamedTuple):
    """What joints are drawn from: poses {body: (samples, 3)} [m, m, rad] of the bodies' own frames, half the width of a drawn bar [m],
    the bodies in the order in which they are drawn, and all joints of the mechanism."""

    poses: Mapping[str, Floats]
    half_width: float
    order: tuple[str, ...]
    joints: "tuple[Joint, ...]"


@dataclass(frozen=True)
class Joint:
    """A joint between two bodies."""

    name: str

    # -- topology

    @property
    def bodies(self) -> tuple[str, str]:
        """Names of the two bodies that a message about the joint names."""
        raise NotImplementedError

    @property
    def is_constraint(self) -> bool:
        """Whether it takes freedom away; a pin with play does not: it is a force."""
        return True

    @property
    def tree_role(self) -> TreeRole | None:
        """How it carries a body in the spanning tree; None: it only closes loops."""
        return None

    @property
    def idealised(self) -> "Joint":
        """The same joint without play."""
        return self

    @property
    def expansion(self) -> Expansion | None:
        """What stands for it in the simulation; None: it itself does."""
        return None

    @property
    def force_element(self) -> "ForceElement | None":
        """The force that a joint with play, or one that gives way, consists of."""
        return None

    @property
    def friction_force(self) -> "JointFrictionForce | None":
        """The friction of an ideal joint, whose size is that of what the joint transmits."""
        return None

    @property
    def pin_markers(self) -> tuple[Marker, Marker] | None:
        """Its two points where it is a pin, about which both bodies turn."""
        return None

    # -- play of a pin

    @property
    def play(self) -> "Play | None":
        """The model of a pin that is not ideal."""
        return None

    @property
    def dry_contact(self) -> "Dry | None":
        """The contact of a pin that separates and impacts."""
        return None

    @property
    def massless_link(self) -> "MasslessLink | None":
        """The massless link that stands for the play of a pin."""
        return None

    # -- constraint and drive

    def constraint_rows(self, index: ModelIndex) -> list[RowFields]:
        """Fields of its constraint rows (`system.ROW`).  A constant that is nan is read off the assembled mechanism."""
        raise NotImplementedError

    @property
    def driven_motion(self) -> str | None:
        """What a drive prescribes: "rotation" or "displacement" of the first body; None: it cannot be driven."""
        return None

    def drive_wrench(self, bodies: ObservedBodies, mover: str, base: str) -> Wrench:
        """What a drive of the joint gives to the body that it moves, and takes from the one on which it rests."""
        raise NotImplementedError

    # -- reaction

    def wrenches(self, bodies: ObservedBodies) -> list[Wrench]:
        """What it can transmit."""
        raise NotImplementedError

    @property
    def reaction_marker(self) -> Marker:
        """The point of a body about which its reaction is stated."""
        raise NotImplementedError

    def reaction(self, group: list[Wrench], sizes: Floats, bodies: ObservedBodies) -> Reaction:
        """`Reaction` from the sizes (m, wrenches) [N], [N m] of its wrenches."""
        body = self.reaction_marker.body
        total = Reaction(np.zeros((len(sizes), 2)), np.zeros(len(sizes)))
        for wrench, size in zip(group, sizes.T, strict=True):
            moment = size * wrench.torques.get(body, 0.0)
            if wrench.force is not None and wrench.point is not None:
                moment = moment + size * cross(wrench.point - bodies.point(self.reaction_marker), wrench.force)
                total = total._replace(force=total.force + size[:, None] * wrench.force)
            total = total._replace(moment=total.moment + moment)
        return total

    # -- drawing

    def own_shapes(self, body: str, drawing: JointDrawing) -> Iterable[Shape]:
        """What it adds to the body that slides or rolls, which needs no plate then."""
        return ()

    def guide_shapes(self, body: str, drawing: JointDrawing) -> Iterable[Shape]:
        """What it adds to the body along which the other one moves."""
        return ()

    def pin_shapes(self, body: str, drawing: JointDrawing) -> Iterable[Shape]:
        """Its pin, on one of the two bodies."""
        return ()

    @property
    def support_markers(self) -> tuple[Marker, ...]:
        """Points that are drawn as a support where they are on the ground."""
        return ()


@dataclass(frozen=True)
class PointJoint(Joint):
    """A joint between a point of `first` and a point of `second`."""

    first: Marker
    second: Marker

    @property
    def bodies(self) -> tuple[str, str]:
        """Names of the two bodies that a message about the joint names."""
        return self.first.body, self.second.body

    @property
    def reaction_marker(self) -> Marker:
        """The point of a body about which its reaction is stated."""
        return self.first

    @property
    def slide_axis(self) -> Axis:
        """Direction in the frame of `second` along which the body slides that it carries."""
        raise NotImplementedError

    def pair(self, index: ModelIndex) -> dict[str, float]:
        """Fields of both bodies and points."""
        return index.pair(self.first, self.second, f"joint {self.name!r}") | {"lift": -1}


def line_direction(body: str, axis: Axis, bodies: ObservedBodies) -> Floats:
    """Direction of a line of a body (m, 2) in the world."""
    return bodies.rotated(body, np.array(axis) / np.hypot(*axis))


def travel(point: Marker, on: Marker, axis: Axis, drawing: JointDrawing) -> tuple[float, float]:
    """(least, largest) place [m] of a point along the line through `on` that has direction `axis` in its body."""
    here, there = (positions_of(marker[1:], drawing.poses[marker.body]) for marker in (point, on))
    along = rotate(np.broadcast_to(axis, here.shape), drawing.poses[on.body][:, 2])
    way = np.sum((here - there) * along, axis=1)
    return float(way.min()), float(way.max())
