"""Flexibility and stiffness at the stations, the parts of it, and what fails first."""

from drivewright import bearings, shafts
from drivewright.errors import InputError
from drivewright.mechanisms.shaft.bearing_table import Bearing
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.refusals import is_rolling
from drivewright.mechanisms.shaft.spec import ShaftSpec
from drivewright.mechanisms.shaft.statics import BALANCED
from drivewright.result import Answer, Answers, Check, Value
from drivewright.shafts.tables import limit_table, share_table, unit_load_table
from drivewright.shafts.values import flexibility_arrays, limit_values, pair_values, station_array


def no_stations(spec: ShaftSpec) -> str | None:
    """Why the stations are not evaluated."""
    return None if spec.stations else "the spec declares no [[stations]]"


def flexibility(model: ShaftModel, done: Answers) -> Answer:
    """Flexibility, its shares, stiffness, reactions per unit load, at the equilibrium of the loads; `data` is the `Flexibility`."""
    at_rest: shafts.ShaftEquilibrium = done["statics"].data.equilibrium
    try:
        found = shafts.flexibility(at_rest, model.places, model.direction)
    except InputError as error:
        return Answer(findings=(f"flexibility and stiffness are absent: {error}",), outcome="left out")
    labels, names = model.names, tuple(support.name for support in model.shaft.supports)
    arrays = flexibility_arrays(found, labels, names)
    values = pair_values(
        "flexibility", labels, found.delta, "m/N", "flexibility {a!r}/{b!r}, displacement of {a!r} under a unit force at {b!r}"
    )
    findings = []
    try:
        stiffness = shafts.stiffness(found.delta, labels)
        arrays["stiffness"] = station_array(labels, stiffness, "N/m")
        values |= pair_values(
            "stiffness", labels, stiffness, "N/m", "stiffness {a!r}/{b!r}, force at {a!r} under a unit displacement of {b!r}, others held"
        )
        values["condition_number"] = Value(found.condition, "-", "condition number of the flexibility, also of the stiffness")
    except InputError as error:
        findings.append(f"array 'stiffness' is absent: {error}")
    if any(support.law is not None for support in model.shaft.supports):
        findings.append("bearings are not linear: flexibility and stiffness are tangents at the equilibrium of the given loads")
    if any(is_rolling(bearing) and "tilt" not in bearing.free for bearing in model.spec.bearings):
        findings.append(
            "rolling bearings also resist the slope of the shaft, which the rigid supports of the comparison (dashed, '.rigid') do not: "
            "a curve on real bearings may lie below the one on rigid supports"
        )
    off = shafts.unit_imbalance(found, model.shaft, model.places, model.direction)
    message = "equilibrium under unit loads, maximum of the unbalanced forces and moments"
    check = Check("equilibrium.unit_loads", off, BALANCED, "<=", "-", message, ("shaft",))
    tables = (unit_load_table(at_rest, found, labels, model.direction), share_table(found, labels))
    return Answer(values, tables, (check,), tuple(findings), arrays, data=found)


# -- what fails first ----------------------------------------------------------------------------------------------------------


def no_strength(spec: ShaftSpec) -> str | None:
    """Why the limiting force is not evaluated."""
    rated = any(b.static_rating or is_rolling(b) for b in spec.bearings)
    known = rated or spec.material.yield_strength or spec.material.card
    return no_stations(spec) or (None if known else "neither a static rating of a bearing nor a yield strength is given")


def failure(model: ShaftModel, done: Answers) -> Answer:
    """For a force at each station alone: at which size a bearing reaches its static rating, and the shaft its yield strength."""
    found, at_rest = done["flexibility"].data, done["statics"].data.equilibrium
    ratings = [static_rating(model, bearing) for bearing in model.spec.bearings]
    limits = {
        name: list(shafts.limit_loads(found, at_rest, number, model.direction, ratings, model.yield_strength))
        for number, name in enumerate(model.names)
    }
    if not any(limits.values()):
        return Answer(findings=("limit loads are absent: no bearing has a static rating, and no yield strength is given",))
    shock, values = model.spec.limits.shock_factor, {}
    for name, loads in limits.items():
        if loads:  # none where it stands on a bearing that has no rating
            values |= limit_values(name, loads, shock)
    return Answer(values, (limit_table(limits, shock),))


def static_rating(model: ShaftModel, bearing: Bearing) -> float | None:
    """C0 of a bearing [N]: as given, of a rolling bearing else by its inner geometry; None where neither is known."""
    rolling = model.rolling.get(bearing.name)
    return bearing.static_rating if rolling is None else bearings.static_rating(rolling)
