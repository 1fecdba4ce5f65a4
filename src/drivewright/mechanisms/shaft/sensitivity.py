"""How the flexibility follows every dimension, stiffness and modulus - and what is held while one of them changes.

Logarithmic derivatives d ln(delta_ij)/d ln(p); where delta_ij is 0 they do not exist.  Of stiffnesses and sections they follow from
the shares: a change of a part's compliance changes delta by the virtual work of its forces, whatever else the shaft has.  Places are
moved, and delta differentiated by central differences of order four; a place that cannot move both ways has no derivative.
"""

import numpy as np

from drivewright import shafts
from drivewright.errors import InputError
from drivewright.mechanisms.shaft.frequencies import tangent_shaft
from drivewright.result import Answer, Column, Table, Value
from drivewright.shafts import beam as beams

STEP = 2e-3
WEIGHTS = ((-2, 1 / 12), (-1, -8 / 12), (1, 8 / 12), (2, -1 / 12))


def sensitivities(model, done):
    """A row for every parameter; where bearings are not linear they keep their tangents at the equilibrium."""
    at_rest, found = done["statics"].data.equilibrium, done["flexibility"].data
    pairs = [(i, j) for i in range(len(model.names)) for j in range(i, len(model.names))]
    rows, values = [], {}
    for name, held, slope in (*_of_parts(model, found), *_of_sections(model, at_rest, found), *_of_places(model, at_rest)):
        with np.errstate(divide="ignore", invalid="ignore"):
            part = np.where(np.abs(found.delta) > 1e-12 * np.abs(found.delta).max(), slope / found.delta, np.nan)
        rows.append((name, held, *(part[p] for p in pairs)))
        values |= {
            f"sensitivity.{model.names[i]}.{model.names[j]}.{name}": Value(
                float(part[i, j]), "-", f"relative change of the flexibility over that of {name}; {held}"
            )
            for i, j in pairs
            if np.isfinite(part[i, j])
        }
    names, held, *columns = zip(*rows, strict=True)
    return Answer(
        values,
        (
            Table(
                "sensitivities",
                "Sensitivities of the flexibility, relative change over relative change",
                (
                    Column("parameter", "-", "parameter", np.array(names)),
                    Column("held", "-", "what is held", np.array(held)),
                    *(
                        Column(f"{model.names[i]}.{model.names[j]}", "-", f"of {model.names[i]}, {model.names[j]}", np.array(column))
                        for (i, j), column in zip(pairs, columns, strict=True)
                    ),
                ),
            ),
        ),
    )


def _of_parts(model, found):
    """Modulus and bearings: delta is the sum of its shares, each inversely proportional to a stiffness."""
    shares = dict(zip(found.names, found.shares, strict=True))
    elastic = [support.name for support in model.shaft.supports if is_elastic(support)]
    inside = [share for name, share in shares.items() if name in ("bending", "shear", "tension")]
    yield "youngs_modulus", "shear modulus in proportion; bearings held", -np.sum(inside, axis=0)
    if elastic:
        yield "bearings.stiffness", "all bearings with their housings in proportion", -sum(shares[name] for name in elastic)
    for name in elastic if len(elastic) > 1 else ():
        yield f"bearings.{name}.stiffness", "with its housing; all else held", -shares[name]


def is_elastic(support):
    return support.law is not None or any(0 < k < np.inf for k in (*support.stiffness, *support.seat))


def _of_sections(model, at_rest, found):
    """Diameters: d delta_ij = sum over the pieces of f_i' dF f_j, F their flexibility and f the forces at their ends."""
    beam, shaft = at_rest.model.beam, model.shaft
    middles = beam.z[:-1] + 0.5 * beam.pieces[:, 0]
    at = np.clip(np.searchsorted(shaft.ends, middles) - 1, 0, len(shaft.sections) - 1)
    change = (
        sum(weight * beams.clamped(beam.pieces * (1.0, np.exp(k * STEP), np.exp(k * STEP), 1.0), shaft)[0] for k, weight in WEIGHTS) / STEP
    )
    forces = np.array([[beams.end_forces(beam, plane, column) for column in found.unknowns.T] for plane in (0, 1)])
    for number in range(len(shaft.sections)):
        own = at == number
        slope = np.einsum("pina,nab,pjnb->ij", forces[:, :, own], change[own], forces[:, :, own])
        yield f"segments.{number}.diameter", "lengths and bore held", slope


def _of_places(model, at_rest):
    """Distances and places of stations."""
    base = tangent_shaft(model.shaft, at_rest)
    features = sorted((*base.supports, *base.stations), key=lambda each: each.position)
    for one, two in zip(features, features[1:], strict=False):
        if two.position > one.position:
            yield (
                f"distance.{one.name}-{two.name}",
                "all other distances held, what is right of it moves along",
                _slope(model, lambda f, a=one.position, b=two.position: _stretched(base, a, b, f)),
            )
    for station in base.stations:
        if 0 < station.position < base.length:
            yield (f"stations.{station.name}.position", "all else held", _slope(model, lambda f, name=station.name: _moved(base, name, f)))


def _slope(model, change):
    """d delta / d ln f at f = 1; nan where the changed shaft is none."""
    try:
        return sum(weight * _delta(model, change(np.exp(k * STEP))) for k, weight in WEIGHTS) / STEP
    except InputError:
        return np.full((len(model.names),) * 2, np.nan)


def _delta(model, shaft):
    system = shafts.assemble(shaft)
    at_rest = shafts.solve(system, 0 * shafts.work(system, ()))
    return shafts.flexibility(at_rest, [station.position for station in shaft.stations], model.direction).delta


def _stretched(shaft, start, end, factor):
    """The shaft with the stretch from `start` to `end` longer by a factor, everything beyond carried along."""

    def place(z):
        return z + (factor - 1) * np.clip(z - start, 0.0, end - start)

    sections = tuple(section._replace(length=length) for section, length in zip(shaft.sections, np.diff(place(shaft.ends)), strict=True))
    supports = tuple(support._replace(position=float(place(support.position))) for support in shaft.supports)
    stations = tuple(station._replace(position=float(place(station.position))) for station in shaft.stations)
    return shaft._replace(sections=sections, supports=supports, stations=stations)


def _moved(shaft, name, factor):
    return shaft._replace(stations=tuple(s._replace(position=factor * s.position) if s.name == name else s for s in shaft.stations))
