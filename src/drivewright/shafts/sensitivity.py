"""How the flexibility follows every dimension, stiffness and modulus - and what is held while one of them changes.

Derivatives d delta_ij/d ln(p).  Of stiffnesses and sections they follow from
the shares: a change of a part's compliance changes delta by the virtual work of its forces, whatever else the shaft has.  Places are
moved, and delta differentiated by central differences of order four; a place that cannot move both ways has no derivative.
"""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import InputError
from drivewright.shafts import beam as beams
from drivewright.shafts.assembly import assemble, nodal_forces
from drivewright.shafts.equilibrium import ShaftEquilibrium, solve
from drivewright.shafts.influence import Flexibility, flexibility
from drivewright.shafts.linearised import tangent_shaft
from drivewright.shafts.model import Shaft, Support

STEP = 2e-3
NO_FLEXIBILITY = 1e-12  # of the largest entry: rounding
WEIGHTS = ((-2, 1 / 12), (-1, -8 / 12), (1, 8 / 12), (2, -1 / 12))


class FlexibilitySlope(NamedTuple):
    """How the flexibility follows a parameter p, and what is held meanwhile: `slope` (s, s) is d delta/d ln(p) [m/N], or relative [-]."""

    parameter: str
    held: str
    slope: Floats


def flexibility_slopes(equilibrium: ShaftEquilibrium, flexibility: Flexibility, direction: Floats) -> Iterator[FlexibilitySlope]:
    """(parameter, what is held, d delta/d ln(parameter) (s, s) [m/N]) of the flexibility between the shaft's stations along `direction`.

    Bearings that are not linear keep their tangents at the equilibrium.
    """
    yield from _of_parts(equilibrium.model.beam.shaft, flexibility)
    yield from _of_sections(equilibrium, flexibility)
    yield from _of_places(equilibrium, direction)


def relative_flexibility_slopes(equilibrium: ShaftEquilibrium, flexibility: Flexibility, direction: Floats) -> Iterator[FlexibilitySlope]:
    """`flexibility_slopes` as relative changes over relative changes, d ln(delta)/d ln(p) [-]; nan where delta is 0."""
    known = np.abs(flexibility.delta) > NO_FLEXIBILITY * np.abs(flexibility.delta).max()
    for name, held, slope in flexibility_slopes(equilibrium, flexibility, direction):
        with np.errstate(divide="ignore", invalid="ignore"):
            relative = np.where(known, slope / flexibility.delta, np.nan)
        yield FlexibilitySlope(name, held, relative)


def _of_parts(shaft: Shaft, flexibility: Flexibility) -> Iterator[FlexibilitySlope]:
    """Modulus and bearings: delta is the sum of its shares, each inversely proportional to a stiffness."""
    shares = dict(zip(flexibility.names, flexibility.shares, strict=True))
    elastic = [support.name for support in shaft.supports if is_elastic(support)]
    inside = [share for name, share in shares.items() if name in ("bending", "shear", "tension")]
    yield FlexibilitySlope("youngs_modulus", "shear modulus in proportion; bearings held", -np.sum(inside, axis=0))
    if elastic:
        together = -np.sum([shares[name] for name in elastic], axis=0)
        yield FlexibilitySlope("bearings.stiffness", "all bearings with their housings in proportion", together)
    for name in elastic if len(elastic) > 1 else ():
        yield FlexibilitySlope(f"bearings.{name}.stiffness", "with its housing; all else held", -shares[name])


def is_elastic(support: Support) -> bool:
    """Whether a support yields: by its law, a spring or its seat."""
    return support.law is not None or any(0 < k < np.inf for k in (*support.stiffness, *support.seat))


def _of_sections(at_rest: ShaftEquilibrium, flexibility: Flexibility) -> Iterator[FlexibilitySlope]:
    """Diameters: d delta_ij = sum over the pieces of f_i' dF f_j, F their flexibility and f the forces at their ends."""
    beam, shaft = at_rest.model.beam, at_rest.model.beam.shaft
    middles = beam.z[:-1] + 0.5 * beam.pieces[:, 0]
    at = np.clip(np.searchsorted(shaft.ends, middles) - 1, 0, len(shaft.sections) - 1)
    factors = [np.exp(k * STEP) for k, _ in WEIGHTS]
    flexibilities = [
        weight * beams.clamped_flexibility(beam.pieces * (1.0, f, f, 1.0), shaft)[0]
        for f, (_, weight) in zip(factors, WEIGHTS, strict=True)
    ]
    change = np.sum(flexibilities, axis=0) / STEP
    forces = np.array([[beams.end_forces(beam, plane, column) for column in flexibility.unknowns.T] for plane in (0, 1)])
    for number in range(len(shaft.sections)):
        own = at == number
        slope = np.einsum("pina,nab,pjnb->ij", forces[:, :, own], change[own], forces[:, :, own])
        yield FlexibilitySlope(f"segments.{number}.diameter", "lengths and bore held", slope)


def _of_places(at_rest: ShaftEquilibrium, direction: Floats) -> Iterator[FlexibilitySlope]:
    """Distances and places of stations."""
    base = tangent_shaft(at_rest)
    features = sorted((*base.supports, *base.stations), key=lambda each: each.position)
    for one, two in zip(features, features[1:], strict=False):
        if two.position > one.position:
            yield FlexibilitySlope(
                f"distance.{one.name}-{two.name}",
                "all other distances held, what is right of it moves along",
                _slope(base, direction, lambda f, a=one.position, b=two.position: _stretched(base, a, b, f)),
            )
    for station in base.stations:
        if 0 < station.position < base.length:
            yield FlexibilitySlope(
                f"stations.{station.name}.position",
                "all else held",
                _slope(base, direction, lambda f, name=station.name: _moved(base, name, f)),
            )


def _slope(base: Shaft, direction: Floats, change: Callable[[float], Shaft]) -> Floats:
    """d delta / d ln f at f = 1; nan where the changed shaft is none."""
    try:
        return np.sum([weight * _delta(direction, change(np.exp(k * STEP))) for k, weight in WEIGHTS], axis=0) / STEP
    except InputError:
        return np.full((len(base.stations),) * 2, np.nan)


def _delta(direction: Floats, shaft: Shaft) -> Floats:
    system = assemble(shaft)
    at_rest = solve(system, 0 * nodal_forces(system, ()))
    return flexibility(at_rest, [station.position for station in shaft.stations], direction).delta


def _stretched(shaft: Shaft, start: float, end: float, factor: float) -> Shaft:
    """The shaft with the stretch from `start` to `end` longer by a factor, everything beyond carried along."""

    def place(z: float | Floats) -> float | Floats:
        return z + (factor - 1) * np.clip(z - start, 0.0, end - start)

    sections = tuple(section._replace(length=length) for section, length in zip(shaft.sections, np.diff(place(shaft.ends)), strict=True))
    supports = tuple(support._replace(position=float(place(support.position))) for support in shaft.supports)
    stations = tuple(station._replace(position=float(place(station.position))) for station in shaft.stations)
    return shaft._replace(sections=sections, supports=supports, stations=stations)


def _moved(shaft: Shaft, name: str, factor: float) -> Shaft:
    return shaft._replace(stations=tuple(s._replace(position=factor * s.position) if s.name == name else s for s in shaft.stations))
