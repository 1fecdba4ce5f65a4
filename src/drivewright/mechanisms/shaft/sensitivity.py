"""How the flexibility follows every dimension, stiffness and modulus - and what is held while one of them changes.

Logarithmic derivatives d ln(delta_ij)/d ln(p), by central differences of order four; where delta_ij is 0 they do not exist.
"""

import numpy as np

from drivewright import shafts
from drivewright.mechanisms.shaft.frequencies import tangent_shaft
from drivewright.result import Answer, Column, Table, Value

STEP = 2e-3
WEIGHTS = ((-2, 1 / 12), (-1, -8 / 12), (1, 8 / 12), (2, -1 / 12))


def sensitivities(model, done):
    """A row for every parameter; `tangent` supports hold their stiffness where bearings are not linear."""
    base = tangent_shaft(model.shaft, done["statics"].data.equilibrium)
    delta = done["flexibility"].data.delta
    pairs = [(i, j) for i in range(len(model.names)) for j in range(i, len(model.names))]
    rows, values = [], {}
    for name, held, change in parameters(base):
        slope = sum(weight * _delta(model, change(np.exp(k * STEP))) for k, weight in WEIGHTS) / STEP
        with np.errstate(divide="ignore", invalid="ignore"):
            found = np.where(np.abs(delta) > 1e-12 * np.abs(delta).max(), slope / delta, np.nan)
        rows.append((name, held, *(found[p] for p in pairs)))
        values |= {
            f"sensitivity.{model.names[i]}.{model.names[j]}.{name}": Value(
                float(found[i, j]), "-", f"d ln flexibility / d ln {name}; {held}"
            )
            for i, j in pairs
            if np.isfinite(found[i, j])
        }
    names, held, *columns = zip(*rows, strict=True)
    return Answer(values, (Table("sensitivities", "Sensitivities of the flexibility, d ln / d ln", (
        Column("parameter", "-", "parameter", np.array(names)), Column("held", "-", "what is held", np.array(held)),
        *(Column(f"{model.names[i]}.{model.names[j]}", "-", f"of {model.names[i]}, {model.names[j]}", np.array(column))
          for (i, j), column in zip(pairs, columns, strict=True)))),))


def _delta(model, shaft):
    system = shafts.assemble(shaft)
    at_rest = shafts.solve(system, 0 * shafts.work(system, ()))
    return shafts.flexibility(at_rest, [station.position for station in shaft.stations], model.direction).delta


def parameters(shaft):
    """(name, what is held, factor -> changed shaft) of everything that can be varied alone."""
    elastic = [number for number, support in enumerate(shaft.supports) if _is_elastic(support)]
    yield "youngs_modulus", "shear modulus in proportion; bearings held", lambda f: shaft._replace(modulus=f * shaft.modulus)
    if elastic:
        yield "bearings.stiffness", "all bearings in proportion", lambda f: _softened(shaft, elastic, f)
    for number in elastic if len(elastic) > 1 else ():
        yield f"bearings.{shaft.supports[number].name}.stiffness", "all else held", lambda f, n=number: _softened(shaft, [n], f)
    for number in range(len(shaft.sections)):
        yield f"segments.{number}.diameter", "lengths and bore held", lambda f, n=number: _thicker(shaft, n, f)
    features = sorted((*shaft.supports, *shaft.stations), key=lambda each: each.position)
    for one, two in zip(features, features[1:], strict=False):
        if two.position > one.position:
            yield (f"distance.{one.name}-{two.name}", "all other distances held, what is right of it moves along",
                   lambda f, a=one.position, b=two.position: _stretched(shaft, a, b, f))
    for station in shaft.stations:
        if 0 < station.position < shaft.length:
            yield f"stations.{station.name}.position", "all else held", lambda f, name=station.name: _moved(shaft, name, f)


def _is_elastic(support):
    return support.law is not None or any(0 < k < np.inf for k in support.stiffness)


def _softened(shaft, numbers, factor):
    supports = list(shaft.supports)
    for number in numbers:
        support = supports[number]
        law = support.law and shafts.Tangent(factor * support.law.k)
        supports[number] = support._replace(stiffness=tuple(factor * k for k in support.stiffness), law=law)
    return shaft._replace(supports=tuple(supports))


def _thicker(shaft, number, factor):
    sections = list(shaft.sections)
    section = sections[number]
    sections[number] = section._replace(start=factor * section.start, end=factor * section.end)
    return shaft._replace(sections=tuple(sections))


def _stretched(shaft, start, end, factor):
    """The shaft with the stretch from `start` to `end` longer by a factor, everything beyond carried along."""
    def place(z):
        return z + (factor - 1) * np.clip(z - start, 0.0, end - start)

    ends = place(shaft.ends)
    sections = tuple(section._replace(length=length) for section, length in zip(shaft.sections, np.diff(ends), strict=True))
    supports = tuple(support._replace(position=float(place(support.position))) for support in shaft.supports)
    stations = tuple(station._replace(position=float(place(station.position))) for station in shaft.stations)
    return shaft._replace(sections=sections, supports=supports, stations=stations)


def _moved(shaft, name, factor):
    return shaft._replace(stations=tuple(s._replace(position=factor * s.position) if s.name == name else s for s in shaft.stations))
