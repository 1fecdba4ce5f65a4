"""The loaded shaft: deflections, reactions, forces and stresses along it."""

from collections.abc import Iterator

import numpy as np

from drivewright import shafts
from drivewright.mechanisms.shaft.bearing_table import Bearing
from drivewright.mechanisms.shaft.build import ShaftModel, tooth_load
from drivewright.mechanisms.shaft.refusals import is_rolling
from drivewright.result import Answer, Answers, Check, Table, Value
from drivewright.shafts.force_results import seat_values, tooth_values, vector_table
from drivewright.shafts.tables import diagram_table, reaction_table
from drivewright.shafts.values import extreme_values, station_values, support_values

BALANCED = 1e-9  # of all forces; Newton's method stops at 1e-11
NO_FORCE = 1e-9  # of the largest load
SAMPLES = 241  # along the shaft, besides the nodes


def statics(model: ShaftModel, done: Answers) -> Answer:
    """Equilibrium under all loads; `data` is the `LoadedShaft` for the analyses that start from it."""
    loaded = shafts.apply_loads(model.shaft, model.loads, [notch.position for notch in model.spec.notches])
    values, checks = _linear_stiffness(model), tuple(_slenderness(model))
    if not model.loaded:
        findings = ("there are no loads: deflections and stresses are absent, and the flexibility is that of the unloaded shaft",)
        return Answer(values, (), checks, findings, data=loaded)
    along = shafts.diagram(loaded, SAMPLES)
    along_loads = "along unit loads" if model.spec.stations else model.direction_words[0]
    values |= station_values(loaded.equilibrium, model.direction) | support_values(loaded.equilibrium, model.direction, along_loads)
    values |= extreme_values(along)
    tables = [diagram_table(along, model.direction, model.direction_words), reaction_table(loaded.equilibrium)]
    values |= _gear_values(model, loaded.equilibrium)
    tables.append(_force_vectors(model, loaded.equilibrium))
    return Answer(values, tuple(tables), (*checks, *_checks(model, loaded, along)), data=loaded)


def _linear_stiffness(model: ShaftModel) -> dict[str, Value]:
    """The radial stiffness of the springs that have no clearance: the same at any load."""
    values = {}
    for support, bearing in zip(model.shaft.supports, model.spec.bearings, strict=True):
        if not is_rolling(bearing) and bearing.radial_stiffness not in (None, np.inf) and not bearing.radial_clearance:
            stiffness, name = support.stiffness[0], f"bearings.{support.name}.stiffness"
            words = f"stiffness of bearing {support.name!r}, radial, the same at any load"
            values |= {f"{name}.{way}": Value(stiffness, "N/m", f"{way} {words}") for way in ("tangent", "secant")}
    return values


def _gear_values(model: ShaftModel, at_rest: shafts.ShaftEquilibrium) -> dict[str, Value]:
    values = {}
    for gear in model.spec.gears:
        forces = shafts.tooth_forces(gear.pitch_diameter, gear.torque, gear.pressure_angle, gear.helix_angle)
        values |= tooth_values(gear.name, forces) | seat_values(gear.name, at_rest, tooth_load(gear), gear.face_width)
    return values


def _force_vectors(model: ShaftModel, at_rest: shafts.ShaftEquilibrium) -> Table:
    acting = {f"bearing {b.name}": reaction for b, reaction in zip(model.spec.bearings, at_rest.reactions, strict=True)}
    acting |= {f"gear {gear.name}": np.array(tooth_load(gear).force) for gear in model.spec.gears}
    for number, load in enumerate(model.spec.loads):
        if load.force:
            acting[f"load {load.name or number}"] = load.force * shafts.transverse_direction(load.angle)
    return vector_table(acting)


# -- checks --------------------------------------------------------------------------------------------------------------------


def _slenderness(model: ShaftModel) -> Iterator[Check]:
    """Whether a length may have been given in a wrong unit."""
    ratio = model.shaft.length / min(min(s.start, s.end) for s in model.shaft.sections)
    limits, words = model.spec.limits, "length over minimum diameter; check the units of lengths and diameters"
    yield Check("slenderness", ratio, limits.slenderness, "<=", "-", f"slenderness of the shaft, {words}", ("shaft",))
    yield Check("stockiness", ratio, limits.stockiness, ">=", "-", f"stockiness of the shaft, {words}", ("shaft",))


def _checks(model: ShaftModel, loaded: shafts.LoadedShaft, along: shafts.Diagram) -> Iterator[Check]:
    limits, shock, own = model.spec.limits, model.spec.limits.shock_factor, ("shaft",)
    at_rest = loaded.equilibrium
    under, beyond = f", at {shock:g} times the load" if shock > 1 else "", "above the limit, linear beam theory does not hold"
    stiffen = "stiffen the shaft or the bearings"
    stress = float(along.von_mises.max())
    if model.yield_strength and stress > 0:
        message = (
            f"nominal yield safety, yield strength over the maximum von Mises stress{under}; take a larger diameter or a stronger material"
        )
        yield Check("yield_safety", model.yield_strength / (shock * stress), limits.yield_safety, ">=", "-", message, own)
    message = "equilibrium of the shaft, unbalanced forces and moments over the sum of all"
    yield Check("equilibrium", shafts.imbalance(loaded, model.loads), BALANCED, "<=", "-", message, own)
    farthest, message = (shafts.largest_displacement(loaded, along), f"maximum relative deflection, over the length of the shaft; {beyond}")
    yield Check("small_deflections", farthest / model.shaft.length, limits.largest_deflection, "<=", "-", message, own)
    slope = float(np.hypot(*along.slope.T).max())
    yield Check("small_slopes", slope, limits.largest_slope, "<=", "rad", f"maximum slope; {beyond}", own)
    pressed = along.axial.min() < -NO_FORCE * np.abs(loaded.force).max(initial=0)
    factor = shafts.buckling_factor_under(model.shaft, model.loads) if pressed else None
    if factor is not None:
        message = f"buckling safety, buckling load over axial force{under}; take a larger diameter or a shorter shaft"
        yield Check("buckling", factor / shock, limits.buckling, ">=", "-", message, own)
    if limits.deflection:
        for station in model.shaft.stations:
            size, message = (
                float(np.hypot(*at_rest.displacement_at(station.position))),
                f"deflection of station {station.name!r}; {stiffen}",
            )
            yield Check(f"deflection.{station.name}", size, limits.deflection, "<=", "m", message, own)
    yield from _gear_checks(model, at_rest)
    for bearing, reaction in zip(model.spec.bearings, at_rest.reactions, strict=True):
        yield from _bearing_checks(model, at_rest, bearing, float(np.hypot(*reaction[:2])), under)


def _gear_checks(model: ShaftModel, at_rest: shafts.ShaftEquilibrium) -> Iterator[Check]:
    for gear in model.spec.gears:
        values, name = seat_values(gear.name, at_rest, tooth_load(gear), gear.face_width), f"gears.{gear.name}"
        for key, limit in (("deflection", model.spec.limits.deflection), ("slope", model.spec.limits.gear_slope)):
            if limit:
                value = values[f"{name}.{key}"]
                message = f"{value.meaning}; stiffen the shaft or the bearings"
                yield Check.of(value, f"{key}.{gear.name}", limit, "<=", message, ("shaft",))


def _bearing_checks(model: ShaftModel, at_rest: shafts.ShaftEquilibrium, bearing: Bearing, force: float, under: str) -> Iterator[Check]:
    limits, own = model.spec.limits, (bearing.name,)
    if limits.slope:
        slope, message = (
            float(np.hypot(*at_rest.slope_at(bearing.position))),
            f"slope of the shaft in bearing {bearing.name!r}; stiffen the shaft, or take a self-aligning bearing",
        )
        yield Check(f"slope.{bearing.name}", slope, limits.slope, "<=", "rad", message, own)
    if bearing.static_rating and force > 0:  # of a rolling bearing beside the check of its pressure
        name = "static_rating" if bearing.name in model.rolling else "static_safety"
        message = f"static safety C0/Fr of bearing {bearing.name!r}, static rating over radial force{under}; take a larger bearing"
        safety = bearing.static_rating / (limits.shock_factor * force)
        yield Check(f"{name}.{bearing.name}", safety, limits.static_safety, ">=", "-", message, own)
