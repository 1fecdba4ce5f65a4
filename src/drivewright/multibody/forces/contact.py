"""The contact of a pin with play: dry, or with a film of oil between journal and bearing."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

import numpy as np

from drivewright._jit import generic, implements
from drivewright.contact.film_table import film_table
from drivewright.contact.impact import lasting_factor
from drivewright.contact.normal import normal_force
from drivewright.multibody.bodies import Marker
from drivewright.multibody.forces.element import ForceElement
from drivewright.multibody.index import ModelIndex
from drivewright.multibody.records import record_type
from drivewright.multibody.wrenches import ObservedBodies, Reaction, cross

NO_FRICTION, COULOMB, AMBROSIO, LUGRE = range(4)
NO_FILM, LONG_FILM, SHORT_FILM, REYNOLDS_FILM = range(4)
CONTACT = record_type(
    "i j memory bristle law film film_table cylinder further",
    "ax ay bx by clearance bearing_radius stiffness exponent hysteresis lasting damping friction slip_speed dead_speed static_friction "
    "bristle_stiffness bristle_damping viscous viscosity length roughness",
)
_FRICTION = {"none": NO_FRICTION, "coulomb": COULOMB, "ambrosio": AMBROSIO, "lugre": LUGRE}
_FILM = {"long": LONG_FILM, "short": SHORT_FILM, "reynolds": REYNOLDS_FILM}


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
    law: tuple[Any, ...] | None = None  # a law of `contact.normal_force` instead; stiffness and exponent tell roughly how hard it is

    noun: ClassVar[str] = "clearance"


@dataclass(frozen=True)
class Lubricated:
    """A film of oil between journal and bearing, with a dry contact behind it."""

    contact: Dry
    viscosity: float  # [Pa s]
    film: str = "long"  # long | short | reynolds: of its length, by a table
    roughness: float = 1e-6  # least film thickness; film and contact blend over this depth [m]

    noun: ClassVar[str] = "clearance"

    @property
    def clearance(self) -> float:
        """Radial [m]."""
        return self.contact.clearance


class NoLaws(NamedTuple):
    """All pins press by the laws of the package."""

    codes: int = 0


class Laws(NamedTuple):
    """The law of the contact number `code`, and those of the others; contacts number from 1."""

    code: int
    law: tuple[Any, ...]
    others: "NoLaws | Laws"


@generic
def further_force(laws: Any, code: int, gap: float, gap_rate: float) -> float:
    """Normal force [N] by the law of a contact that has one of its own."""
    raise NotImplementedError


@implements(further_force, NoLaws)
def _(laws, code, gap, gap_rate):
    return 0.0


@implements(further_force, Laws)
def _(laws, code, gap, gap_rate):
    if code == laws.code:
        return normal_force(laws.law, gap, gap_rate)
    return further_force(laws.others, code, gap, gap_rate)


@dataclass(frozen=True)
class PinContact(ForceElement):
    """The contact of a journal, a point of `second`, in a bearing, a point of `first`."""

    table: ClassVar[str] = "contacts"

    first: Marker
    second: Marker
    model: Dry | Lubricated

    def record(self, index: ModelIndex) -> Mapping[str, Any]:
        """Fields of its record."""
        oil = self.model if isinstance(self.model, Lubricated) else None
        dry = self.model.contact if isinstance(self.model, Lubricated) else self.model
        rub = dry.friction
        film = {"film": _FILM[oil.film], "viscosity": oil.viscosity, "roughness": oil.roughness} if oil else {}
        if oil and oil.film == "reynolds":
            film["film_table"] = index.add_film(film_table(dry.length / (2 * dry.bearing_radius)))
        return (
            index.pair(self.first, self.second, f"joint {self.name!r}")
            | film
            | {
                "memory": -1,
                "bristle": -1,
                "cylinder": dry.cylinder,
                "clearance": dry.clearance,
                "bearing_radius": dry.bearing_radius,
                "stiffness": dry.stiffness,
                "exponent": dry.exponent,
                "hysteresis": dry.hysteresis,
                "lasting": lasting_factor(dry.hysteresis),
                "damping": dry.damping,
                "length": dry.length,
                "further": index.add_law(dry.law) if dry.law is not None else 0,
                "law": _FRICTION[rub.law] if rub.coefficient > 0 else NO_FRICTION,
                "friction": rub.coefficient,
                "slip_speed": rub.speed,
                "dead_speed": rub.dead_speed,
                "static_friction": rub.static_coefficient,
                "bristle_stiffness": rub.bristle_stiffness,
                "bristle_damping": rub.bristle_damping,
                "viscous": rub.viscous,
            }
        )

    def reaction(self, number: int, bodies: ObservedBodies) -> Reaction:
        """The walls press at the bearing's radius, the oil at the journal's centre, about which it drags the bearing along."""
        observed = {name: bodies.observed.pin(number, name) for name in ("depth", "normal", "friction", "nx", "ny", "fx", "fy", "drag")}
        contact = self.model.contact if isinstance(self.model, Lubricated) else self.model
        n, force = np.stack([observed["nx"], observed["ny"]], axis=-1), np.stack([observed["fx"], observed["fy"]], axis=-1)
        rubbing = observed["friction"][:, None] * n @ np.array([[0.0, -1.0], [1.0, 0.0]])
        oil = force + observed["normal"][:, None] * n - rubbing
        moment = -contact.bearing_radius * cross(n, rubbing) - (observed["depth"] + contact.clearance) * cross(n, oil)
        return Reaction(force, moment + observed["drag"])
