"""The rolling bearings under the shaft's load: stiffness with the load behind it, load distribution, pressure, life."""

from collections.abc import Iterator

import numpy as np

from drivewright import bearings, shafts
from drivewright.bearings import BearingEquilibrium
from drivewright.bearings.tables import element_table, load_curve_tables
from drivewright.bearings.values import bearing_findings, life_values, load_values
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.refusals import is_rolling
from drivewright.mechanisms.shaft.spec import ShaftSpec
from drivewright.result import Answer, Answers, Check
from drivewright.shafts.values import stiffness_values

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
        stiffness = stiffness_values(name, shafts.support_stiffness(at_rest, number, model.direction))
        values |= stiffness
        if not stiffness:
            findings.append(f"stiffness of bearing {name!r} is absent: nothing loads it")
        bearing = model.rolling.get(name)
        if bearing is not None and shafts.is_idle(at_rest, number):
            findings.append(f"bearing {name!r} carries nothing under these loads")
        elif bearing is not None:
            state = bearings.solve(bearing, displacement=shafts.bearing_displacement(at_rest, number))
            values |= load_values(name, state) | life_values(name, state, model.spec.drive.speed if model.spec.drive else None)
            tables += [element_table(state, name), *load_curve_tables(state, name, FACTORS)]
            checks += _checks(model, name, state)
            findings += bearing_findings(name, state)
    return Answer(values, tuple(tables), tuple(checks), tuple(findings))


def _checks(model: ShaftModel, name: str, state: BearingEquilibrium) -> Iterator[Check]:
    limits, shock, life = model.spec.limits, model.spec.limits.shock_factor, state.reference_life
    if state.pressures.max() > 0:
        under = f", at {shock:g} times the load" if shock > 1 else ""
        message = f"static load of bearing {name!r} by its contact pressure over its load{under}"
        yield Check(f"static_safety.{name}", state.static_safety / shock, limits.static_safety, ">=", "-", message, (name,))
    if limits.life and model.spec.drive and life is not None and np.isfinite(life):
        seconds = bearings.life_duration(life, model.spec.drive.speed)
        message = f"reference life of bearing {name!r}: {seconds / 3600:.4g} h of {limits.life / 3600:.4g} h"
        yield Check(f"life.{name}", seconds, limits.life, ">=", "s", message, (name,))
