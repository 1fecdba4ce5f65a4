"""The shaft as a solid of finite elements beside the beam, on the same springs over the same bands."""

from drivewright.errors import InputError
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.result import Answer, Answers, Check, Value
from drivewright.shafts import solid_check
from drivewright.shafts.values import pair_values, station_array


def solid(model: ShaftModel, done: Answers) -> Answer:
    """Flexibility of the solid, how far the beam is from it, and the picture of the deformed solid."""
    try:
        at_rest = done["statics"].data.equilibrium
        found, beam = solid_check.solid_and_beam(at_rest, model.places, model.direction, model.spec.analysis.solid_band)
    except InputError as error:
        return Answer(findings=(f"the solid check is absent: {error}",), outcome="left out")
    deviation = solid_check.relative_difference(beam, found.flexibility)
    meaning = "maximum deviation of the beam from the solid, over the geometric mean of the two diagonals"
    values = {
        "solid.deviation": Value(deviation, "-", meaning, label="Maximum deviation of beam from solid"),
        "solid.unknowns": Value(float(found.unknowns), "-", "unknowns of the finite elements"),
        "solid.seconds": Value(float(found.seconds), "s", "time for meshing and solution"),
    }
    words = "solid flexibility {a!r}/{b!r}, displacement of {a!r} under a unit force at {b!r}"
    values |= pair_values("solid.flexibility", model.names, found.flexibility, "m/N", words)
    arrays = {
        "solid.flexibility": station_array(model.names, found.flexibility, "m/N"),
        "solid.beam": station_array(model.names, beam, "m/N"),
    }
    last, allowed = len(model.names) - 1, solid_check.allowed_difference(model.shaft)
    table = solid_check.surface_table(found, last, title=f"Shaft as a solid, force at {model.names[last]}")
    check = Check(
        "solid",
        deviation,
        allowed,
        "<=",
        "-",
        "maximum deviation of the beam from the solid, over the geometric mean of the two diagonals",
        ("shaft",),
        label="Deviation of beam from solid",
    )
    return Answer(values, (table,), (check,), (), arrays)
