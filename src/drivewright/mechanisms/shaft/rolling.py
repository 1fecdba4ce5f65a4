"""The rolling bearings under the shaft's load: stiffness with the load behind it, load distribution, pressure, life."""

from collections.abc import Iterator

import numpy as np

from drivewright import bearings, shafts
from drivewright.bearings import BearingEquilibrium, RollingBearing
from drivewright.bearings.tables import element_table, load_curve_table
from drivewright.errors import InputError, SolverError
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.refusals import is_rolling
from drivewright.mechanisms.shaft.spec import ShaftSpec
from drivewright.result import Answer, Answers, Check, Table, Value

FACTORS = np.geomspace(0.02, 4.0, 25)  # of the curve of stiffness, over the bearing's load


def no_rolling(spec: ShaftSpec) -> str | None:
    """Why there is nothing to say of rolling bearings."""
    return None if any(is_rolling(b) or b.table or b.radial_clearance for b in spec.bearings) else "all bearings are linear springs"


def rolling(model: ShaftModel, done: Answers) -> Answer:
    """Every bearing that is not linear, at the equilibrium of the loads."""
    at_rest: shafts.ShaftEquilibrium = done["statics"].data.equilibrium
    values, tables, checks, findings = {}, [], [], []
    for number, mount in enumerate(at_rest.model.mounts):
        name = mount.support.name
        if mount.support.law is None:
            continue
        stiffness = _stiffness(name, shafts.support_stiffness(at_rest, number, model.direction))
        values |= stiffness
        if not stiffness:
            findings.append(f"stiffness of bearing {name!r} is absent: nothing loads it")
        bearing = model.rolling.get(name)
        if bearing is not None and shafts.is_idle(at_rest, number):
            findings.append(f"bearing {name!r} carries nothing under these loads")
        elif bearing is not None:
            state = bearings.solve(bearing, displacement=shafts.bearing_displacement(at_rest, number))
            values |= _values(model, name, bearing, state)
            tables += [element_table(state, f"elements.{name}", f"Rolling elements of bearing {name}"), *_load_curve(name, bearing, state)]
            checks += _checks(model, name, state)
            findings += _findings(name, bearing, state)
    return Answer(values, tuple(tables), tuple(checks), tuple(findings))


def _stiffness(name: str, found: shafts.SupportStiffness) -> dict[str, Value]:
    """Tangent along the radial reaction and secant, with the load behind them; nothing where there is no load."""
    rows = (
        ("load", found.load, "N", f"radial force of bearing {name!r} behind its stiffness"),
        ("tangent", found.tangent, "N/m", f"change of radial force over displacement of bearing {name!r}, all else held"),
        ("secant", found.secant, "N/m", f"radial force over displacement of bearing {name!r}, from the seat's axis"),
        ("axial", found.axial, "N/m", f"tangent stiffness of bearing {name!r}, axial"),
        ("tilt_x", found.tilt_x, "N m/rad", f"tangent stiffness of bearing {name!r}, tilt about x"),
        ("tilt_y", found.tilt_y, "N m/rad", f"tangent stiffness of bearing {name!r}, tilt about y"),
    )
    values = {f"bearings.{name}.stiffness.{key}": Value(value, unit, meaning) for key, value, unit, meaning in rows if np.isfinite(value)}
    return values if found.tangent > 0 else {}


def _values(model: ShaftModel, name: str, bearing: RollingBearing, state: BearingEquilibrium) -> dict[str, Value]:
    of, unit = f"of bearing {name!r}", f"bearings.{name}"
    loaded = int(np.sum(state.element_loads > 0))
    values = {
        f"{unit}.max_element_load": Value(float(state.element_loads.max()), "N", f"load of the most loaded rolling element {of}"),
        f"{unit}.max_pressure": Value(float(state.pressures.max()), "Pa", f"largest Hertz pressure {of}"),
        f"{unit}.loaded_elements": Value(float(loaded), "-", f"rolling elements under load {of}"),
    }
    if loaded:
        values[f"{unit}.static_safety"] = Value(state.static_safety, "-", f"load at the permissible static pressure over the load {of}")
    load = bearings.equivalent_radial_load(state.force, bearing.contact_angle)
    basic = None if load is None else bearings.basic_life(bearing, load)
    if basic is not None:
        meaning = f"basic life L10 (ISO 281) {of}, revolutions, at P = its radial force"
        values[f"{unit}.basic_life"] = Value(float(basic), "-", meaning)
    life, drive = state.reference_life, model.spec.drive
    if life is not None and np.isfinite(life):
        values[f"{unit}.reference_life"] = Value(float(life), "-", f"reference life L10r {of}, revolutions")
        if drive:
            values[f"{unit}.reference_life.time"] = Value(_duration(life, drive.speed), "s", f"the same {of} at the shaft's speed")
    return values


def _duration(revolutions: float, speed: float) -> float:
    """Time [s] of so many revolutions at a speed [rad/s]."""
    return float(revolutions) * 2 * np.pi / speed


def _checks(model: ShaftModel, name: str, state: BearingEquilibrium) -> Iterator[Check]:
    limits, shock, life = model.spec.limits, model.spec.limits.shock_factor, state.reference_life
    if state.pressures.max() > 0:
        under = f", at {shock:g} times the load" if shock > 1 else ""
        message = f"static load of bearing {name!r} by its contact pressure over its load{under}"
        yield Check(f"static_safety.{name}", state.static_safety / shock, limits.static_safety, ">=", "-", message, (name,))
    if limits.life and model.spec.drive and life is not None and np.isfinite(life):
        seconds = _duration(life, model.spec.drive.speed)
        message = f"reference life of bearing {name!r}: {seconds / 3600:.4g} h of {limits.life / 3600:.4g} h"
        yield Check(f"life.{name}", seconds, limits.life, ">=", "s", message, (name,))


def _findings(name: str, bearing: RollingBearing, state: BearingEquilibrium) -> Iterator[str]:
    if bearing.dynamic_rating is None:
        yield f"life of bearing {name!r} is absent: it has no dynamic_rating"
    if bearing.contact_angle and state.reversed_elements:
        yield (
            f"bearing {name!r}: {state.reversed_elements} of its elements bear on the side that an angular-contact bearing does not have; "
            "it needs more preload or axial load, or turn it round (carries)"
        )


def _load_curve(name: str, bearing: RollingBearing, state: BearingEquilibrium) -> Iterator[Table]:
    """Displacement and stiffness over the load, its direction kept; nothing where no radial force acts or not all loads can be borne."""
    if not np.hypot(*state.force[:2]) > 0:
        return
    try:
        curve = bearings.load_curve(bearing, state.force, FACTORS)
    except (InputError, SolverError):
        return
    yield load_curve_table(curve, f"curve.{name}", f"Bearing {name} over its load")
