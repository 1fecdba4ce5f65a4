"""Equilibrium of one rolling bearing: displacement to force, force to displacement, and what each rolling element carries.

A kind of bearing is a spec class with an entry in `law_of` and `life_of`, and a NamedTuple of numbers, its law, with a formula
under each of `response`, `measures` and `elements`.  Nothing here knows their names.
"""

from collections.abc import Collection
from dataclasses import dataclass
from functools import cached_property, singledispatch
from typing import Any, Literal, Protocol

import numpy as np

from drivewright._jit import generic, kernel
from drivewright._typing import ArrayLike, Floats
from drivewright.bearings.newton import (
    MAX_STEPS,
    NOT_CONVERGED,
    UNRESISTED,
    BearingMeasures,
    centre_ring,
    equilibria,
    equilibrium,
    measures,
)
from drivewright.bearings.response import FREEDOMS, evaluate_response, response
from drivewright.errors import InputError, SolverError, UnknownName, brief

__all__ = [
    "PERMISSIBLE",
    "BearingEquilibrium",
    "BearingMeasures",
    "RollingBearing",
    "contact_of",
    "elements",
    "equilibria",
    "equilibrium",
    "basic_static_rating",
    "law_of",
    "life_of",
    "measures",
    "solve",
    "warm",
]


class RollingBearing(Protocol):
    """What every spec of a rolling bearing gives: nominal contact angle and place of the first element [rad], ratings C and C0 [N]."""

    @property
    def contact_angle(self) -> float:
        """Nominal contact angle [rad]."""
        ...

    @property
    def first_element(self) -> float:
        """Angle of the first element from +x towards +y [rad]."""
        ...

    @property
    def dynamic_rating(self) -> float | None:
        """C [N]."""
        ...

    @property
    def static_rating(self) -> float | None:
        """C0 [N]."""
        ...


@singledispatch
def law_of(bearing: object) -> Any:
    """The law of a bearing: the NamedTuple of numbers that its formulas take."""
    raise InputError(f'bearing: {brief(bearing)} is no bearing; build one, e.g. BallBearing(balls=9, ball_diameter="8 mm", ...).')


@singledispatch
def life_of(bearing: object, state: "BearingEquilibrium") -> float | None:
    """Reference life [revolutions] of a bearing in an `BearingEquilibrium`; None without a dynamic rating."""
    raise InputError(f"bearing: no reference life is known for a {type(bearing).__name__}.")


def refuse_other(bearing: object, kind: type[object], what: str) -> None:
    """InputError where `what` is known of another kind of bearing alone."""
    if not isinstance(bearing, kind):
        law_of(bearing)  # its own message where this is no bearing at all
        raise InputError(f"bearing: {what} is stated for a {kind.__name__}, and this is a {type(bearing).__name__}.")


# Peak pressure [Pa] at the static rating, which leaves 1e-4 of an element's diameter, and the power of it that the load is.  ISO 76,
# recalled; the ratings that follow are those of the catalogues within a few per cent.
PERMISSIBLE = {"point": (4.2e9, 3.0), "line": (4.0e9, 2.0)}


def contact_of(bearing: object) -> Literal["point", "line"]:
    """ "point" or "line": how its elements touch."""
    return "line" if measures(law_of(bearing)).laminae else "point"


@singledispatch
def basic_static_rating(bearing: object) -> float:
    """C0 [N] of ISO 76: the radial load at which the fullest element, 5 F/(Z cos a), has the permissible pressure."""
    law_of(bearing)
    raise InputError(f"bearing: no static rating is known for a {type(bearing).__name__}.")


@generic
def elements(law: Any, displacement: Floats, loads: Floats, angles: Floats, pressures: Floats, laminae: Floats) -> None:
    """Writes what each rolling element carries at a displacement (5,): load [N] and contact angle [rad] (n,), peak pressure [Pa] at
    the inner and outer race (n, 2), load of each lamina [N] (n, laminae).  The load and pressure of an unloaded element are 0."""


@kernel
def _state(law, displacement, force, stiffness, loads, angles, pressures, laminae):
    """Everything at a displacement; returns the energy.

    displacement, force (5,), stiffness (5, 5) in [m, rad, N, N m]; the others as for `elements`, all but the first written.
    """
    elements(law, displacement, loads, angles, pressures, laminae)
    return response(law, displacement, force, stiffness)


@dataclass(frozen=True)
class BearingEquilibrium:
    """A bearing under load.  Five freedoms: x, y, z [m, N] and rotations about x and y [rad, N m], z the axis.

    force: what is applied to the inner ring; displacement: of the inner ring against the outer; stiffness (5, 5): the tangent;
    element_loads [N] and contact_angles [rad] (n,): of the rolling elements, from the first one towards +y; an unloaded one has the
    angle at which its grooves stand; pressures [Pa] (n, 2): peak at the inner and outer race; lamina_loads [N] (n, laminae);
    energy [J]; steps: of Newton's method, 0 where the displacement was given.
    """

    bearing: RollingBearing
    displacement: Floats
    force: Floats
    stiffness: Floats
    element_loads: Floats
    contact_angles: Floats
    pressures: Floats
    lamina_loads: Floats
    energy: float
    steps: int

    @cached_property
    def reference_life(self) -> float | None:
        """L10r [revolutions]; inf where nothing is loaded, None where the bearing has no dynamic rating."""
        return life_of(self.bearing, self)

    @property
    def static_safety(self) -> float:
        """(permissible pressure/pressure)^3 of balls, ^2 of rollers [-]: how many times the load would reach the static rating."""
        pressure, power = PERMISSIBLE[contact_of(self.bearing)]
        return float((pressure / self.pressures.max()) ** power) if self.pressures.max() > 0 else np.inf

    @property
    def reversed_elements(self) -> int:
        """How many loaded elements bear on the side that an angular-contact bearing does not have."""
        return int(np.sum((self.element_loads > 0) & (self.contact_angles < 0)))


def solve(
    bearing: RollingBearing,
    *,
    force: ArrayLike | None = None,
    displacement: ArrayLike | None = None,
    held: Collection[str] = (),
    start: ArrayLike | None = None,
) -> BearingEquilibrium:
    """The `BearingEquilibrium` at one of: `force` (Fx, Fy, Fz, Mx, My) in N and N m, or `displacement` of its five freedoms [m, rad].

    held: names from FREEDOMS that a given force does not move; they stay at their `start` (0 unless given), and the force found
    there is the reaction.  start (5,): where the search begins, and where what nothing resists remains.
    """
    if (force is None) == (displacement is None):
        raise InputError("bearing: give either force=[Fx, Fy, Fz, Mx, My] or displacement=[x, y, z, tilt_x, tilt_y].")
    law = law_of(bearing)
    if displacement is not None:
        if len(held) or start is not None:
            raise InputError("bearing: held and start need a given force; at a given displacement there is nothing to solve.")
        return _state_of(bearing, law, _checked_vector(displacement, "displacement", "m, m, m, rad, rad"), 0)
    return _state_of(bearing, law, *_solve_force(law, _checked_vector(force, "force", "N, N, N, N·m, N·m"), held, start))


def _solve_force(law, force, held, start):
    """(displacement, steps) at a force, or our error."""
    kept = _held_freedoms(held, force)
    place = np.zeros(5) if start is None else _checked_vector(start, "start", "m, m, m, rad, rad")
    if start is None:
        centre_ring(law, force, kept, place)
    place, steps = equilibrium(law, force, kept, place)
    if steps == UNRESISTED:
        _refuse(law, force, place)
    if steps == NOT_CONVERGED:
        raise SolverError(
            f"bearing: no equilibrium with the force {_number_list(force)} after {MAX_STEPS} Newton steps. "
            "Give a closer start=, or less load.",
            partial={"displacement": place},
        )
    return place, steps


def _refuse(law, force, place):
    """Name the freedom that ran away."""
    sizes = measures(law)
    way = int(np.argmax(np.abs(place) * ([1.0] * 3 + [sizes.arm] * 2)))
    name, unit, sign = FREEDOMS[way], "N" if way < 3 else "N·m", "-" if place[way] < 0 else "+"
    raise InputError(
        f"bearing: nothing resists {sign}{name}, where {force[way]:.6g} {unit} of the force {_number_list(force)} acts: the inner ring "
        f"moves without limit. Reverse the force, hold it with held=({name!r},), or take a bearing that carries such a load."
    )


def _held_freedoms(held, force):
    """Which freedoms are held, (5,) of bool."""
    names = (held,) if isinstance(held, str) else tuple(held)
    for name in names:
        if name not in FREEDOMS:
            raise UnknownName("freedom of a bearing", name, FREEDOMS)
        if force[FREEDOMS.index(name)] != 0.0:
            raise InputError(
                f"bearing: {name} is held, so its force is a reaction to be found, but {force[FREEDOMS.index(name)]:.6g} is given; "
                f"set it to 0, or do not hold {name}."
            )
    return np.array([name in names for name in FREEDOMS])


def _state_of(bearing, law, displacement, steps):
    sizes = measures(law)
    force, stiffness = np.empty(5), np.empty((5, 5))
    loads, angles = np.empty(sizes.elements), np.empty(sizes.elements)
    pressures, laminae = np.empty((sizes.elements, 2)), np.empty((sizes.elements, sizes.laminae))
    energy = _state(law, displacement, force, stiffness, loads, angles, pressures, laminae)
    if not np.isfinite(energy + loads.sum()):
        raise InputError(f"bearing: the displacement {_number_list(displacement)} is too large; it is in m and rad.")
    return BearingEquilibrium(bearing, displacement, force, stiffness, loads, angles, pressures, laminae, energy, int(steps))


def warm(bearing: RollingBearing, held: Collection[str] = ()) -> None:
    """Compile everything for a bearing's law."""
    solve(bearing, force=[1.0, 0.0, 0.0, 0.0, 0.0])
    equilibria(law_of(bearing), np.ones((1, 5)), np.array([name in held for name in FREEDOMS]))
    evaluate_response(law_of(bearing), np.zeros(5))


def _checked_vector(values, name, units):
    """Five finite floats, a copy."""
    try:
        array = np.array(values, dtype=float)
    except (TypeError, ValueError):
        array = np.empty(0)
    if array.shape != (5,) or not np.all(np.isfinite(array)):
        raise InputError(f"bearing: {name} needs five finite numbers [{units}], got {brief(values)}.")
    return array


def _number_list(values):
    return f"[{', '.join(f'{value:.6g}' for value in values)}]"
