"""The shaft as a solid of finite elements beside the beam, on the same springs over the same bands."""

import numpy as np

from drivewright.errors import InputError
from drivewright.result import Answer, Array, Check, Value
from drivewright.shafts import solid_check


def no_solid(spec):
    return None if spec.stations else "the spec declares no [[stations]]"


def solid(model, done):
    """Flexibility of the solid, how far the beam is from it, and the picture of the deformed solid."""
    try:
        at_rest = done["statics"].data.equilibrium
        found, beam = solid_check.solid_and_beam(at_rest, model.places, model.direction, model.spec.analysis.solid_band)
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
    table = solid_check.surface_table(found, last, title=f"Shaft as a solid, force at {model.names[last]}")
    check = Check(
        "solid",
        float(np.abs(apart).max()),
        solid_check.allowed_difference(model.shaft),
        "<=",
        "-",
        "beam against solid, over the diagonals",
        ("shaft",),
    )
    return Answer(values, (table,), (check,), (), arrays)
