"""What a planar multibody system consists of: frozen descriptions that know no solver.

Every body has a frame of its own; `Marker` is a point in that frame.  Angles count counter-clockwise.  SI units.
The reserved body "ground" stands still; its frame is the world.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

GROUND = "ground"


class Marker(NamedTuple):
    """A point (x, y) [m] in the frame of a body."""

    body: str
    x: float = 0.0
    y: float = 0.0


@dataclass(frozen=True)
class Body:
    """A rigid body.  `angle` is a start guess that picks the assembly; the rates start a mechanism that is free to move."""

    name: str
    mass: float = 0.0  # [kg]
    inertia: float = 0.0  # about the centroid [kg m^2]
    centroid: tuple = (0.0, 0.0)  # in the body's frame [m]
    angle: float = 0.0  # of the body's frame in the world [rad]
    velocity: tuple | None = None  # of the centroid [m/s]
    angular_velocity: float | None = None  # [rad/s]


@dataclass(frozen=True, eq=False)
class Curve:
    """A quantity as piecewise polynomials: f(x) = sum c_k (x - x_i)^k in [x_i, x_(i+1)], repeated every `period` where it is not 0.

    breaks (n + 1,), coefficients (n, 6) in ascending powers; outside its breaks an aperiodic curve goes on with its end pieces.
    """

    breaks: np.ndarray
    coefficients: np.ndarray
    period: float = 0.0


def line(start, slope):
    """The Curve start + slope x."""
    return Curve(np.array([0.0, 1.0]), np.array([[start, slope, 0.0, 0.0, 0.0, 0.0]]))


# ---------------------------------------------------------------------------------------------------- models of a pin joint


@dataclass(frozen=True)
class Ideal:
    """No play."""


@dataclass(frozen=True)
class MasslessLink:
    """Continuous contact: the journal's centre is held at the distance of the clearance by a rigid link without mass."""

    clearance: float  # radial [m]
    damping: float = 0.0  # of the link's own rotation [N m s/rad]
    angle: float = 0.0  # start angle, from the centre of the first body's pin towards that of the second's [rad]


@dataclass(frozen=True)
class Friction:
    """Sliding friction at a dry pin.  law: none | coulomb | ambrosio | lugre."""

    law: str = "coulomb"
    coefficient: float = 0.0
    speed: float = 0.01  # v_d of tanh(v/v_d), upper end of Ambrosio's ramp, Stribeck speed of LuGre [m/s]
    dead_speed: float = 0.0  # lower end of Ambrosio's ramp [m/s]
    static_coefficient: float = 0.0  # LuGre
    bristle_stiffness: float = 0.0  # LuGre sigma_0 [1/m]: friction force over normal force per bristle deflection
    bristle_damping: float = 0.0  # LuGre sigma_1 [s/m]
    viscous: float = 0.0  # LuGre sigma_2 [s/m]


@dataclass(frozen=True)
class Dry:
    """Contact and separation: F = K d^n (1 + h d'/d0'), d0' the approach speed at onset; or K d^n + c d'; or the cylinder law."""

    clearance: float  # radial, bearing radius minus journal radius [m]
    bearing_radius: float  # [m]
    stiffness: float  # K [N/m^n]; for the cylinder law the effective modulus [Pa]
    exponent: float = 1.5
    hysteresis: float = 0.0  # h
    damping: float = 0.0  # c [N s/m], Kelvin-Voigt
    cylinder: bool = False  # the elastic force is that of a cylinder in a hollow instead of K d^n
    length: float = 0.0  # of the bearing [m]; cylinder law, film and wear
    friction: Friction = Friction()


@dataclass(frozen=True)
class Lubricated:
    """A film of oil between journal and bearing, with a dry contact behind it."""

    contact: Dry
    viscosity: float  # [Pa s]
    film: str = "long"  # long | short
    roughness: float = 1e-6  # least film thickness; film and contact blend over this depth [m]


@dataclass(frozen=True)
class Bushing:
    """Springs and dampers between the pin's two halves: along both directions and about the pin."""

    stiffness: float  # [N/m]
    damping: float = 0.0  # [N s/m]
    rotational_stiffness: float = 0.0  # [N m/rad]
    rotational_damping: float = 0.0  # [N m s/rad]


# ------------------------------------------------------------------------------------------------------------------ joints


@dataclass(frozen=True)
class Revolute:
    """A pin.  `first` carries the bearing (bush), `second` the journal; only a joint with play can tell them apart."""

    name: str
    first: Marker
    second: Marker
    model: Ideal | MasslessLink | Dry | Lubricated | Bushing = Ideal()


@dataclass(frozen=True)
class Prismatic:
    """A point of `first` slides along a line of `second` that has direction `axis` in its frame; no relative rotation."""

    name: str
    first: Marker
    second: Marker
    axis: tuple = (1.0, 0.0)


@dataclass(frozen=True)
class PinSlot:
    """A point of `first` slides along a line of `second` and may turn."""

    name: str
    first: Marker
    second: Marker
    axis: tuple = (1.0, 0.0)


@dataclass(frozen=True)
class Gear:
    """Relative to the carrier, `second` turns `ratio` times as far as `first`: negative for outer gears, positive for a ring or a belt."""

    name: str
    first: str
    second: str
    ratio: float
    carrier: str = GROUND


@dataclass(frozen=True)
class Rolling:
    """A wheel of `first`, centred at its marker, rolls without slip on a track of `second`.

    The track is a line through the marker of `second` along `axis`, the wheel to the left of it, or, where `track_radius` is not 0,
    a circle about that marker: positive for a wheel outside on it, negative for a wheel inside a ring.
    """

    name: str
    first: Marker
    second: Marker
    radius: float
    axis: tuple = (1.0, 0.0)
    track_radius: float = 0.0


@dataclass(frozen=True)
class CamPair:
    """A follower that is held to its programme: motion of `follower` relative to `carrier` as a Curve of the cam's angle relative to it.

    With an `axis` (in the carrier's frame) the marker moves along it by lift(cam angle) from the carrier's `origin`; without one
    the follower turns by lift(cam angle).
    """

    name: str
    cam: str
    follower: Marker
    lift: Curve
    carrier: str = GROUND
    origin: tuple = (0.0, 0.0)
    axis: tuple | None = None


# ------------------------------------------------------------------------------------------------------------------ forces


@dataclass(frozen=True)
class Spring:
    """Spring and damper between two points: tension k (L - L0) + c L'."""

    name: str
    first: Marker
    second: Marker
    stiffness: float
    free_length: float = 0.0
    damping: float = 0.0


@dataclass(frozen=True)
class RotationalSpring:
    """Torque on `first`, its opposite on `second`: -k (angle - rest) - c rate, of first relative to second."""

    name: str
    first: str
    second: str = GROUND
    stiffness: float = 0.0
    rest: float = 0.0
    damping: float = 0.0


@dataclass(frozen=True)
class Load:
    """A quantity over "time" [s], over the "angle" of `body` relative to `on` [rad], or over their relative "speed" [rad/s]."""

    curve: Curve
    over: str = "time"


@dataclass(frozen=True)
class Torque:
    """Torque on `body`, its opposite on `on`.  A motor is a torque over the speed."""

    name: str
    body: str
    load: Load
    on: str = GROUND


@dataclass(frozen=True)
class Force:
    """Force (x, y) times a load factor on a point; `follows` where the direction turns with the body."""

    name: str
    point: Marker
    direction: tuple
    load: Load
    follows: bool = False


@dataclass(frozen=True)
class Drive:
    """Prescribed rotation (revolute) or displacement (prismatic): start + motion(time), the start of a rotation being the bodies' guesses.

    It counts for the joint's first body relative to its second; where the first is the ground, for the second relative to the ground.
    """

    joint: str
    motion: Curve


@dataclass(frozen=True)
class Model:
    """A planar multibody system."""

    bodies: tuple
    joints: tuple
    forces: tuple = ()
    drives: tuple = ()
    gravity: tuple = (0.0, 0.0)
