"""Loads of the crank and support bearings over a turn of the crank, their lives, and the statics of equations (7) to (12)."""

from collections.abc import Iterator, Mapping

import numpy as np

from drivewright import bearings
from drivewright.indexing.motion import TURN
from drivewright.indexing.stiffness.loading import solve_after_play, solve_loaded
from drivewright.indexing.stiffness.tables import bearing_forces, bearing_load_table
from drivewright.indexing.stiffness.values import bearing_load_values, statics_values
from drivewright.mechanisms.indexer.build import STEP, IndexerModel
from drivewright.mechanisms.indexer.refusals import TRANSLATING
from drivewright.mechanisms.indexer.spec import IndexerSpec
from drivewright.result import Answer, Answers, Check, Value

RATED = {"crank": "crank_bearings", "support": "support_bearings"}


def no_loads(spec: IndexerSpec) -> str | None:
    """Why there are none."""
    if spec.kind not in TRANSLATING:
        return f"kind {spec.kind!r} has no cranks"
    if spec.load.torque is None:
        return "load.torque is not given"
    return (
        None
        if spec.crank_bearings or spec.support_bearings
        else "no bearings are given, so statics does not determine their loads; give crank_bearings or support_bearings"
    )


def bearing_loads(model: IndexerModel, done: Answers) -> Answer:
    """Forces on every bearing over the turn, largest and mean loads, lives, and the corrected statics beside them."""
    torque, whole_turn = model.torque, model.spec.load.angle is None
    angles = np.linspace(0, TURN, int(round(TURN / STEP)) + 1) if whole_turn else model.angles
    result, contacts = solve_loaded(model.loaded_wheel, angles, torque)
    loaded, _, _ = solve_after_play(model.loaded_wheel, angles, torque, result, contacts)
    forces = bearing_forces(loaded)
    values, checks = {}, []
    for group, table in RATED.items():
        own = {name: force for name, force in forces.items() if name.startswith(group)}
        if any(np.isfinite(force).any() for force in own.values()):
            values |= bearing_load_values(group, own, model.rolling.get(table) if whole_turn else None, model.spec.load.speed)
            checks += _checks(model, group, values)
    lost = int(np.sum(~loaded.carried))
    absent = f"bearing loads are absent at {lost} of {len(angles)} input angles, where no contact carries the torque; lives exclude them"
    train = model.train
    if model.spec.cams == 2 and model.wheel.side == "inside" and train is not None and train.crank is not None:
        values |= statics_values(result, contacts, model.wheel.eccentricity, train.spacing)
    return Answer(values, (bearing_load_table(angles, forces),), tuple(checks), (absent,) if lost else ())


def static_rating(model: IndexerModel, table: str) -> float | None:
    """C0 [N] as given, else of the catalogue, else by the permissible pressure; None for a stiffness without one."""
    given, rolling = getattr(model.spec, table), model.rolling.get(table)
    if rolling is None:
        return given.static_rating if given else None
    return bearings.static_rating(rolling)


def _checks(model: IndexerModel, group: str, values: Mapping[str, Value]) -> Iterator[Check]:
    limits, largest = model.spec.limits, values[f"{group}.max_load"].value
    rating, life = static_rating(model, RATED[group]), values.get(f"{group}.basic_life.time")
    if rating and largest > 0:
        message = f"static rating of {rating / 1e3:.4g} kN over the maximum load of {largest / 1e3:.4g} kN; take larger {group} bearings"
        label = f"Static safety, {group} bearings"
        yield Check(f"static_rating.{group}", rating / largest, limits.static_safety, ">=", "-", message, (group,), label=label)
    if limits.life and life:
        message = f"basic life of the most loaded {group} bearing; take bearings of larger dynamic rating or a lower speed"
        yield Check(f"life.{group}", life.value, limits.life, ">=", "s", message, (group,), label=f"Basic life L10h, {group} bearings")
