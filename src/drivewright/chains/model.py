"""What a chain drive is made of, for any solver of its motion: frozen descriptions, in SI units.

Frame: x to the right, y up, angles counter-clockwise.  Plates are numbered clockwise around the loop, along their own x; the
sprockets lie inside unless they say so, in any order.  Teeth have their centre lines at the polar angles psi + k 2 pi/z; a plate seated
astride of one is turned by psi + k 2 pi/z - pi/2.  A sprocket inside that carries the chain along the plates' x turns clockwise: its
speed is negative.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.link import Link
from drivewright.chains.roller_tooth import RollerTooth
from drivewright.chains.tooth import Tooth
from drivewright.errors import InputError

if TYPE_CHECKING:
    from drivewright.contact.laws import ContactParameters

LINEAR = "kelvin-voigt"


@dataclass(frozen=True)
class ChainContact:
    """ChainContact with a body: stiffness k [N/m], damping c [N s/m], and the law that is made from them.

    law: LINEAR, force k depth + c rate, never tensile; or a registered contact law, by name or as the function that makes it.
    """

    stiffness: float
    damping: float = 0.0
    law: "str | Callable[[ContactParameters], Any]" = LINEAR


@dataclass(frozen=True)
class Chain:
    """N plates and their joints.

    link; count N; mass [kg] and moment of inertia [kg m^2] of a plate; joint stiffness k_j [N/m] and damping beta [s] (a force
    beta k_j times the rate of the joint's stretch); centre_offset [m]: mass centre above the line of the plate's own pins;
    toe, crotch [m]: how far below that line the flank ends and begins (endless flanks meet teeth that real ones clear);
    elongation: relative to the pitch; deviations (N,) [m] of
    the single hole pitches: pins move in the plates by both, the flanks stay; articulation_damping [N m s]: torque of a joint over the
    rate at which its plates turn against each other.
    """

    link: Link
    count: int
    mass: float
    inertia: float
    joint_stiffness: float
    joint_damping: float = 0.0
    centre_offset: float = 0.0
    toe: float = np.inf
    crotch: float = -np.inf
    elongation: float = 0.0
    deviations: tuple[float, ...] = ()
    articulation_damping: float = 0.0

    @property
    def hole_pitches(self) -> Floats:
        """Hole pitch of every plate, A + elongation p + its deviation (N,)  [m]."""
        own = np.asarray(self.deviations, float) if len(self.deviations) else np.zeros(self.count)
        return self.link.hole_pitch + self.elongation * self.link.pitch + own

    @property
    def line_density(self) -> float:
        """Mass per length of the straight chain  [kg/m]."""
        return self.mass / self.link.pitch


@dataclass(frozen=True)
class SpeedRamp:
    """Prescribed speed [rad/s], reached from `start` within `ramp` [s]: start + (speed - start)(x - sin(2 pi x)/(2 pi)), x = t/ramp."""

    speed: float
    start: float = 0.0
    ramp: float = 0.0


@dataclass(frozen=True)
class Slide:
    """One direction (angle [rad]) in which a centre may move by q, with the force F - k q - c dq/dt along it  [N], [N/m], [N s/m].

    With a pivot [m] the centre turns about it instead, by q over the `lever` [m] (counter-clockwise where that is above 0): q and the
    forces are those at the end of the lever, and the direction means nothing.  travel [m]: least and greatest q that there is room for.
    """

    direction: float
    force: float = 0.0
    stiffness: float = 0.0
    damping: float = 0.0
    pivot: tuple[float, float] | None = None
    lever: float = 1.0
    travel: tuple[float, float] = (-np.inf, np.inf)

    def turn(self, q: Any) -> Any:
        """Angle [rad] by which the body has turned about its pivot."""
        return q / self.lever if self.pivot else 0.0

    def shift(self, centre: complex, q: Any) -> Any:
        """By how much [m] a centre that stands at `centre` for q = 0 has moved."""
        if self.pivot is None:
            return q * np.exp(1j * self.direction)
        return (centre - complex(*self.pivot)) * (np.exp(1j * self.turn(q)) - 1)

    def way(self, centre: complex, q: float) -> complex:
        """Derivative of the place by q  [-]."""
        if self.pivot is None:
            return complex(np.exp(1j * self.direction))
        return 1j / self.lever * (centre - complex(*self.pivot)) * np.exp(1j * self.turn(q))


@dataclass(frozen=True)
class Sprocket:
    """A sprocket: its `Tooth` (or `RollerTooth`), how it touches, and how it may move.

    centre [m] at q = 0; angle psi [rad] at the start (None: as the chain asks); tip and form radius [m] of the active flank;
    drive, or free with inertia [kg m^2], torque [N m] counter-clockwise and rotational damping [N m s] against rates that differ from
    `reference_speed` [rad/s]; slide with mass [kg], or fixed; outside of the loop it meets the back of a roller chain.
    """

    tooth: Tooth | RollerTooth
    contact: ChainContact
    centre: tuple[float, float] = (0.0, 0.0)
    angle: float | None = None
    tip_radius: float = np.inf
    form_radius: float = 0.0
    mass: float = 0.0
    inertia: float = 0.0
    torque: float = 0.0
    damping: float = 0.0
    reference_speed: float = 0.0
    drive: SpeedRamp | None = None
    slide: Slide | None = None
    outside: bool = False
    name: str = ""


@dataclass(frozen=True)
class Guide:
    """A convex arc that plates slide on with their back ("outside") or belly ("inside"), `distance` [m] off the line of their pins.

    centre [m] and radius [m] of the arc, from the polar angle `start` counter-clockwise to `end` [rad]; Coulomb friction regularised
    below `slip` [m/s]; a slide with mass [kg] makes it a tensioner.
    """

    centre: tuple[float, float]
    radius: float
    start: float
    end: float
    side: str
    distance: float
    contact: ChainContact
    friction: float = 0.0
    slip: float = 1e-2
    mass: float = 0.0
    slide: Slide | None = None
    name: str = ""


@dataclass(frozen=True)
class ChainDrive:
    """A drive: chain, sprockets, guides, gravity (x, y) [m/s^2]."""

    chain: Chain
    sprockets: tuple[Sprocket, ...]
    guides: tuple[Guide, ...] = ()
    gravity: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        check(self)

    @property
    def drive(self) -> SpeedRamp:
        """Speed of the driver."""
        drive = self.sprockets[self.driver].drive
        assert drive is not None
        return drive

    @property
    def driver(self) -> int:
        """Number of the first sprocket with a drive."""
        return next(n for n, sprocket in enumerate(self.sprockets) if sprocket.drive)

    @property
    def measured(self) -> int:
        """Number of the driven sprocket, whose distance from the driver counts: the first other one inside of the loop."""
        return next(n for n, sprocket in enumerate(self.sprockets) if n != self.driver and not sprocket.outside)


def at_speed(model: ChainDrive, speed: float) -> ChainDrive:
    """The model with its driver at a constant speed [rad/s] from the start; reference speeds of the dampers change in the same ratio."""
    share = speed / model.drive.speed
    slower = replace(model, sprockets=tuple(replace(each, reference_speed=share * each.reference_speed) for each in model.sprockets))
    return with_sprocket(slower, model.driver, drive=SpeedRamp(speed, speed))


def with_sprocket(model: ChainDrive, number: int, **changes: Any) -> ChainDrive:
    """The model with one sprocket changed."""
    changed = list(model.sprockets)
    changed[number] = replace(changed[number], **changes)
    return replace(model, sprockets=tuple(changed))


# ------------------------------------------------------------------------------------------------------------------ checks


def check(model: ChainDrive) -> None:
    """InputError where the description has no meaning."""
    _check_chain(model.chain)
    if len(model.sprockets) < 2:
        raise InputError(f"chain drive: {len(model.sprockets)} sprocket is not enough for a loop; give two or more.")
    for number, sprocket in enumerate(model.sprockets, 1):
        _check_sprocket(sprocket, f"sprocket {number}")
    for number, sprocket in enumerate(model.sprockets, 1):
        if sprocket.outside and not isinstance(sprocket.tooth, RollerTooth):
            raise InputError(
                f"sprocket {number}: outside of the loop it meshes with roller chains only; use a guide on the backs of plates."
            )
    if not any(sprocket.drive for sprocket in model.sprockets):
        raise InputError("chain drive: no sprocket is driven; give one a SpeedRamp(speed).")
    for number, guide in enumerate(model.guides, 1):
        _check_guide(guide, f"guide {number}")
    _finite("gravity", model.gravity)


def _check_chain(chain):
    if isinstance(chain.count, bool) or not isinstance(chain.count, int | np.integer) or chain.count < 6:
        raise InputError(f"chain: count must be a whole number from 6 up, got {chain.count!r}.")
    for name in ("mass", "inertia", "joint_stiffness"):
        _above("chain", name, getattr(chain, name))
    _from_zero("chain", "joint_damping", chain.joint_damping)
    _from_zero("chain", "articulation_damping", chain.articulation_damping)
    _finite("chain: centre_offset", (chain.centre_offset, chain.elongation))
    if not chain.toe > chain.crotch:
        raise InputError(f"chain: the toe ({chain.toe:g} m below the pins) must lie deeper than the crotch ({chain.crotch:g} m).")
    if len(chain.deviations) not in (0, chain.count):
        raise InputError(f"chain: {len(chain.deviations)} pitch deviations for {chain.count} plates; give one for each, or none.")
    _finite("chain: deviations", chain.deviations)


def _check_sprocket(sprocket, where):
    _check_contact(sprocket.contact, where)
    _finite(f"{where}: centre", sprocket.centre)
    if not sprocket.tip_radius > sprocket.form_radius >= 0:
        raise InputError(
            f"{where}: tip radius {sprocket.tip_radius:g} m must exceed form radius {sprocket.form_radius:g} m, which is 0 or more."
        )
    if sprocket.drive is None:
        _above(where, "inertia", sprocket.inertia, " of a sprocket without a drive")
    elif not sprocket.drive.ramp >= 0 or not np.isfinite(sprocket.drive.speed + sprocket.drive.start):
        raise InputError(f"{where}: the drive needs finite speeds and a ramp of 0 s or more, got {sprocket.drive}.")
    _from_zero(where, "damping", sprocket.damping)
    _finite(f"{where}: torque and reference speed", (sprocket.torque, sprocket.reference_speed))
    _check_slide(sprocket, where)


def _check_guide(guide, where):
    _check_contact(guide.contact, where)
    if guide.side not in ("outside", "inside"):
        raise InputError(f"{where}: side must be 'outside' or 'inside', got {guide.side!r}.")
    for name in ("radius", "slip"):
        _above(where, name, getattr(guide, name))
    _from_zero(where, "friction", guide.friction)
    if not 0 < guide.end - guide.start <= 2 * np.pi:
        raise InputError(
            f"{where}: the arc runs counter-clockwise from start to end by up to a turn, got {guide.start:g} .. {guide.end:g} rad."
        )
    _finite(f"{where}: centre and distance", (*guide.centre, guide.distance))
    _check_slide(guide, where)


def _check_slide(body, where):
    if body.slide is None:
        return
    _above(where, "mass", body.mass, " of a body on a slide")
    _from_zero(where, "slide damping", body.slide.damping)
    _from_zero(where, "slide stiffness", body.slide.stiffness)
    _finite(f"{where}: slide", (body.slide.direction, body.slide.force, *(body.slide.pivot or ())))
    if body.slide.pivot and not (np.isfinite(body.slide.lever) and body.slide.lever != 0):
        raise InputError(f"{where}: the lever of a pivot must be finite and not 0, got {body.slide.lever:g} m.")


def _check_contact(contact, where):
    _above(where, "contact stiffness", contact.stiffness)
    _from_zero(where, "contact damping", contact.damping)


def _above(where, name, value, more=""):
    if not (np.isfinite(value) and value > 0):
        raise InputError(f"{where}: {name}{more} must be finite and above 0, got {value:g}.")


def _from_zero(where, name, value):
    if not (np.isfinite(value) and value >= 0):
        raise InputError(f"{where}: {name} must be finite and 0 or more, got {value:g}.")


def _finite(where, values):
    if not np.all(np.isfinite(values)):
        raise InputError(f"{where} must be finite, got {values}.")
