"""The shaft as a solid of finite elements beside the beam, on the same springs over the same bands."""

import numpy as np

from drivewright import shafts
from drivewright.errors import InputError
from drivewright.result import Answer, Array, Check, Value
from drivewright.shafts.beam import POINT
from drivewright.solids import shaft_check

ALLOWED, AT_SHOULDERS = 0.01, 0.05  # of the diagonals: what a beam does not know of the ground under a bearing, and of shoulders


def no_solid(spec):
    return None if spec.stations else "the spec declares no [[stations]]"


def bands(model, at_rest):
    """A `Band` for every bearing: its width, or where it is a point the one of the analysis, and its radial tangent stiffness along the
    unit loads, its housing in series.  At an end of the shaft the band lies inside it."""
    way = np.concatenate([model.direction, np.zeros(3)])
    for support, tangent in zip(model.shaft.supports, at_rest.tangent, strict=True):
        rigid = np.isinf(np.diag(tangent)) @ np.abs(way) > 0
        stiffness = np.inf if rigid else float(way @ np.where(np.isfinite(tangent), tangent, 0.0) @ way)
        if stiffness > 0:
            yielding = 1 / stiffness + float(np.sum(model.direction**2 / np.array(support.seat[:2])))
            own = support.width > POINT * model.shaft.length
            width = support.width if own else min(model.spec.analysis.solid_band, model.shaft.length / 10)
            middle = float(np.clip(support.position, width / 2, model.shaft.length - width / 2))
            yield shaft_check.Band(middle, width, 1 / yielding if yielding else np.inf)


def beam_on(model, seats):
    """Flexibility of the beam on the same bands."""
    supports = tuple(
        shafts.Support(f"band {n}", band.position, (band.stiffness,) * 2 + (0.0,) * 3, width=band.width) for n, band in enumerate(seats)
    )
    system = shafts.assemble(model.shaft._replace(supports=supports))
    return shafts.flexibility(shafts.solve(system, shafts.work(system, ())), model.places, model.direction).delta


def compared(model, at_rest):
    """(bands, the solid's answer, flexibility of the beam on the same bands)."""
    seats = tuple(bands(model, at_rest))
    found = shaft_check.solid_flexibility(
        tuple(section[:4] for section in model.shaft.sections), model.shaft.modulus, model.shaft.poisson, seats, tuple(model.places)
    )
    return seats, found, beam_on(model, seats)


def allowed(shaft):
    """Largest difference of beam and solid that needs no explanation, over the diagonals."""
    ends = [(section.start, section.end, section.bore) for section in shaft.sections]
    smooth = all(one[1] == two[0] and one[2] == two[2] for one, two in zip(ends, ends[1:], strict=False))
    return ALLOWED if smooth else AT_SHOULDERS


def solid(model, done):
    """Flexibility of the solid, how far the beam is from it, and the picture of the deformed solid."""
    try:
        _, found, beam = compared(model, done["statics"].data.equilibrium)
    except InputError as error:
        return Answer(findings=(f"the solid check is absent: {error}",), outcome="left out")
    scale = np.sqrt(np.outer(np.diag(found.flexibility), np.diag(found.flexibility)))
    apart = (beam - found.flexibility) / scale
    values = {
        "solid.deviation": Value(
            float(np.abs(apart).max()), "-", "largest difference of beam and solid, over the geometric mean of the two diagonals"
        ),
        "solid.unknowns": Value(float(found.unknowns), "-", "unknowns of the finite elements"),
        "solid.seconds": Value(float(found.seconds), "s", "time to mesh and solve"),
    }
    values |= {
        f"solid.flexibility.{a}.{b}": Value(float(found.flexibility[i, j]), "m/N", f"displacement of {a!r} by a unit force at {b!r}, solid")
        for i, a in enumerate(model.names)
        for j, b in enumerate(model.names)
        if j >= i
    }
    arrays = {
        "solid.flexibility": Array("m/N", ("station", "station"), (model.names, model.names), found.flexibility),
        "solid.beam": Array("m/N", ("station", "station"), (model.names, model.names), beam),
    }
    last = len(model.names) - 1
    table = shaft_check.surface_table(found, last, title=f"Shaft as a solid, force at {model.names[last]}")
    check = Check(
        "solid", float(np.abs(apart).max()), allowed(model.shaft), "<=", "-", "beam against solid, over the diagonals", ("shaft",)
    )
    return Answer(values, (table,), (check,), (), arrays)
