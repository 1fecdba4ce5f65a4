"""Dry friction in ideal pins, slides, slots and rolling wheels: the description, and its records.

The force is that of the joint itself: in a pin mu R |F|, in a slide mu max(|N|, 2 |M|/L), which is that of its two ends, in a slot mu |N|;
a wheel is held back by the moment e |N|.  mu = mu(v) of `contact.friction.stribeck`, and what is viscous grows with the speed.

A joint sticks elastically: before it slides it gives way by the presliding displacement d,

    g = mu_s u + tau u',   u' = v/d   while |g| <= mu_s;     g = sign(v) mu(v) while it slides

(the reset integrator model: Haessig & Friedland 1991, recalled).  So a joint that sticks stays where it is under any load that it can
hold, several joints that stick share a load, and what they do together is never ambiguous.  tau damps the spring near-critically.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

from drivewright._jit import by_reference
from drivewright._typing import Floats
from drivewright.multibody.bodies import Marker
from drivewright.multibody.forces.element import ForceElement
from drivewright.multibody.index import ModelIndex, unit_axis
from drivewright.multibody.records import Records, record_type

PIN, SLIDE, SLOT, WHEEL = range(4)
KINDS = {"pin": PIN, "slide": SLIDE, "slot": SLOT, "wheel": WHEEL}
# `child`: the body that hangs by the joint in the tree, else -1, its force being that of the rows of the joint number `joint`.
# Of the state: `sliding` -1, 0, 1; `deflection` u; `relaxation` tau [s].
JOINT_FRICTION = record_type(
    "kind i j child joint sliding deflection relaxation",
    "ax ay bx by ex ey arm guide friction static_friction stribeck_speed viscous presliding",
)
STATES = 3  # of a joint with friction
JOINT_FIELDS = ("rate", "coefficient", "friction", "load", "mobility", "normal", "tangential")
RATE, COEFFICIENT, FRICTION, LOAD, MOBILITY, NORMAL, TANGENTIAL = range(
    7
)  # rate of the joint, g, friction on its first body, friction at g = 1, see `rub`


@dataclass(frozen=True)
class JointFriction:
    """Friction of an ideal joint.  `arm`: radius of a pin, lever arm of a wheel's resistance [m]; `guide`: length of a slide [m], 0: what
    tilts it is not counted."""

    coefficient: float  # of sliding; 1 for a wheel
    static_coefficient: float
    stribeck_speed: float = 0.01  # [m/s]
    viscous: float = 0.0  # friction over normal force, per sliding speed [s/m]
    presliding: float = 1e-5  # displacement before it slides [m]
    arm: float = 1.0
    guide: float = 0.0


@dataclass(frozen=True)
class JointFrictionForce(ForceElement):
    """The friction of the joint `name` between a point of `first` and one of `second`, along `axis` of `second` where it slides."""

    table: ClassVar[str] = "frictions"

    kind: str  # of KINDS
    first: Marker
    second: Marker
    friction: JointFriction
    axis: tuple[float, float] = (1.0, 0.0)
    radius: float = 1.0  # of the surface that slides or rolls, for joints that turn [m]

    def record(self, index: ModelIndex) -> Mapping[str, Any]:
        """Fields of its record."""
        ex, ey = unit_axis(self.axis, self.name)
        rub, turned = self.friction, self.radius if self.kind in ("pin", "wheel") else 1.0  # sliding over the joint's own coordinate
        return index.pair(self.first, self.second, f"joint {self.name!r}") | {
            "kind": KINDS[self.kind],
            "child": -1,
            "joint": -1,
            "ex": ex,
            "ey": ey,
            "arm": rub.arm,
            "guide": rub.guide,
            "friction": rub.coefficient,
            "static_friction": rub.static_coefficient,
            "stribeck_speed": rub.stribeck_speed / turned,
            "viscous": rub.viscous * turned,
            "presliding": rub.presliding / turned,
        }


class NoJointFriction(NamedTuple):
    """No ideal joint rubs: such systems share kernels without a trace of friction."""

    joints: int = 0


@by_reference
class JointFrictions(NamedTuple):
    """The joints of a system that rub."""

    table: Records  # (joints,) of JOINT_FRICTION


class NoFrictionWork(NamedTuple):
    """Scratch of a system in which no ideal joint rubs."""

    joints: int = 0


@by_reference
class FrictionWork(NamedTuple):
    """Scratch, and at the last state that was evaluated what the joints with friction do."""

    wrenches: Floats  # (bodies, 3): what holds each body's subtree
    rows: Floats  # (rows, 7): ux, uy, gi, gj, gk, gl of a unit multiplier, then the multiplier
    unit: Floats  # (joints, 4): x, y of a unit force on the first body, torques of it and of its opposite on the second about the centroids
    accelerations: Floats  # (joints, independent): of a unit force
    response: Floats  # (joints, 1 + joints, 2): what a joint transmits without friction, and per unit force of each joint's friction
    matrix: Floats  # (joints, joints)
    columns: Floats  # (2, joints): residuals and corrections, pivots
    joints: Floats  # (joints, JOINT_FIELDS)
    given: Floats  # (independent,): accelerations without friction
    rates: Floats  # (states,)
