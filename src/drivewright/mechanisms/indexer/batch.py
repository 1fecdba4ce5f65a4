"""Many pin wheels at once: play, contacts and pressure angles in compiled code; stiffness and loads on the same sampled profile, design by
design, in threads, with equilibria in compiled code."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TypeAlias

import numpy as np

from drivewright import cases
from drivewright._typing import Floats
from drivewright.errors import DrivewrightError
from drivewright.indexing.batch import evaluate_designs, sampled
from drivewright.indexing.batch.designs import DesignValues
from drivewright.indexing.batch.pin_wheels import PinWheelValues
from drivewright.indexing.motion import TURN, step_angle
from drivewright.mechanisms.indexer import drive, geometry, loads, stiffness
from drivewright.mechanisms.indexer.build import IndexerModel, build, law_parameters, motion_to_dwell
from drivewright.mechanisms.indexer.refusals import POINTS, TRANSLATING, law_name, refuse_contradictions, required
from drivewright.mechanisms.indexer.spec import IndexerSpec
from drivewright.result import Answer, Check
from drivewright.spec import value_at
from drivewright.spec.designs import numbers_of, sample_of, with_columns, within_limits

TABLES = ("motion", "load", "table", "motor", "contact", "crank_bearings", "support_bearings", "shafts", "gear", "housing", "limits")
RATIO = "motion.motion_to_dwell"
LAW = {"motion.b": "b", "motion.c": "c", "motion.d": "d"}
VALUES = {
    "play.forward.maximum": "play_forward",
    "play.backward.maximum": "play_backward",
    "contacts.minimum": "contacts_minimum",
    "contacts.maximum": "contacts_maximum",
    "pressure_angle.forward.maximum": "pressure_forward",
    "pressure_angle.backward.maximum": "pressure_backward",
    "profile.min_convex_radius": "convex_radius",
}
MOTION = {f"motion.{name}": name for name in ("motion_angle", "velocity_factor", "acceleration_factor")}
CHECKS = ("check.play.forward", "check.play.backward", "check.curvature")
COMPILED = {*VALUES, *MOTION, *CHECKS}
Measure: TypeAlias = Callable[[IndexerModel], Answer]


def batch(spec: IndexerSpec, keys: Sequence[str], names: Sequence[str]) -> Callable[[Floats], dict[str, Floats]] | None:
    """designs (n, d) -> {name: (n,)}; None where a key or a value is beyond the batch, which then runs one by one.

    A design that is refused is nan in every name; a value that does not exist for a design is nan.
    """
    if (
        spec.kind not in TRANSLATING
        or spec.bodies != "rigid"
        or spec.load.angle is not None
        or (spec.stations or spec.pins) != spec.pins
        or (spec.stations is not None and "pins" in keys)
        or spec.pin_phase
        or law_name(spec) in POINTS
        or not all(_is_number(spec, key) for key in keys)
    ):
        return None
    refuse_contradictions(spec)
    measures = _measures(with_columns(spec, {key: sample_of(spec, key) for key in keys if value_at(spec, key) is None}), names)
    if measures is None:
        return None
    compiled = [name for name in names if name in COMPILED]
    play = any("play." in name for name in compiled)

    def evaluate(designs: Floats) -> dict[str, Floats]:
        """{name: (n,)} of designs (n, d), nan for an impossible one."""
        columns = dict(zip(keys, np.asarray(designs, float).T, strict=True))
        values = {name: np.full(len(designs), np.nan) for name in names}
        wheels = np.full((len(PinWheelValues._fields), len(designs)), np.nan)

        def measure(row: int) -> None:
            numbers, wheel = _measured(_design(spec, columns, row), measures, play)
            for name in set(names) - COMPILED:
                values[name][row] = numbers.get(name, np.nan)
            wheels[:, row] = wheel
            possible[row] = True

        possible = np.zeros(len(designs), bool)
        accepted = np.flatnonzero(within_limits(type(spec), columns, len(designs))).tolist()
        if cases.run(measure, accepted, None if measures else 1).interrupted:
            raise KeyboardInterrupt
        if compiled and possible.any():
            rest = {key: column[possible] for key, column in columns.items()}
            known = PinWheelValues(*wheels[:, possible]) if measures else None
            for name, column in _compiled(spec, rest, int(np.sum(possible)), compiled, play, known).items():
                values[name][possible] = column
        return values

    return evaluate


def _is_number(spec, key):
    """Whether a key is a number of the wheel or of a table that the spec has."""
    table, _, rest = key.rpartition(".")
    if (table and key.split(".")[0] not in TABLES) or value_at(spec, table or "pins") is None or rest == "angle":
        return False
    return key == RATIO or not isinstance(value_at(spec, key), (str, bool, tuple))


def _design(spec, columns, row):
    """The spec of one design."""
    whole = {key for key in columns if isinstance(value_at(spec, key), int)}
    return with_columns(spec, {key: int(column[row]) if key in whole else float(column[row]) for key, column in columns.items()})


# -- in compiled code, many designs in one call ----------------------------------------------------------------------------------


def _compiled(
    spec: IndexerSpec, columns: Mapping[str, Floats], count: int, names: Iterable[str], play: bool, wheels: PinWheelValues | None
) -> dict[str, Floats]:
    """{name: (n,)} of the designs that the spec accepts; wheels: their values where they are known."""
    pins = columns.get("pins", np.full(count, spec.pins))
    values = {name: np.full(count, np.nan) for name in names}
    for number in np.unique(pins):
        rows = pins == number
        own = with_columns(spec, {"pins": int(number)} | {key: column[rows] for key, column in columns.items() if key != "pins"})
        known = wheels and PinWheelValues(*(column[rows] for column in wheels))
        found = _evaluated(own, int(np.sum(rows)), any(name in MOTION for name in names), play, known)
        numbers = {name: getattr(found.wheels, field) for name, field in VALUES.items()}
        numbers |= {name: getattr(found, field) for name, field in MOTION.items()}
        numbers |= dict(numbers_of(Answer(checks=tuple(_checks(own, numbers)))))
        for name, column in values.items():
            column[rows] = np.where(np.isfinite(numbers["contacts.minimum"]), numbers[name], np.nan)
    return values


def _evaluated(spec: IndexerSpec, count: int, factors: bool, play: bool, wheels: PinWheelValues | None) -> DesignValues:
    """The values of designs, arrays in the place of the numbers of a spec, in compiled code."""
    law, circle = law_name(spec), np.broadcast_to(spec.pin_circle_radius, count)
    throw, angle = required(spec, "eccentricity"), step_angle(law, motion_to_dwell(spec))
    return evaluate_designs(
        law, law_parameters(spec), spec.pins, circle, spec.pin_radius, throw, angle, spec.side, factors, play=play, wheels=wheels
    )


def _checks(spec, numbers):
    """Checks of play and curvature, as a run has them."""
    limits = spec.limits
    for name in ("forward", "backward"):
        free = numbers[f"play.{name}.maximum"]
        whole = np.where(np.isfinite(free), free, np.maximum(TURN / spec.pins, 2 * limits.play))
        yield Check(f"play.{name}", whole, limits.play, "<=", "rad", "", ())
    yield Check("curvature", numbers["profile.min_convex_radius"] / spec.pin_radius, limits.curvature_ratio, ">=", "-", "", ())


# -- on the sampled profile, design by design ------------------------------------------------------------------------------------


def _where(missing: Callable[[IndexerSpec], str | None], measure: Measure, model: IndexerModel) -> Answer:
    """The answer of a measure, nothing where a run leaves it out."""
    return measure(model) if missing(model.spec) is None else Answer()


def _with(analysis, model):
    return analysis(model, {})


MEASURES: tuple[Measure, ...] = (
    partial(_where, stiffness.no_stiffness, stiffness.secant_stiffness),
    partial(_where, stiffness.no_stiffness, stiffness.pin_loads),
    partial(_where, stiffness.no_stiffness, stiffness.dwell_stiffness),
    partial(_where, stiffness.no_stiffness, stiffness.pin_pressure),
    partial(_with, geometry.contact_map),
    partial(_with, geometry.motion),
    partial(_where, drive.no_drive, partial(_with, drive.drive)),
    partial(_where, loads.no_loads, partial(_with, loads.bearing_loads)),
)


def _measured(spec: IndexerSpec, measures: Sequence[Measure], play: bool) -> tuple[dict[str, float], PinWheelValues | float]:
    """({name: number} by the measures, `PinWheelValues`) of one design from one profile; nothing and nan where there are no measures."""
    if not measures:
        refuse_contradictions(spec)
        return {}, np.nan
    model = build(spec)
    wheel = sampled(model.wheel)
    quick = _quick(model, wheel)
    found = {name: number for measure in measures for name, number in numbers_of(measure(quick))}
    return found, wheel.values(play)


def _quick(model, wheel):
    """The model with a sampled profile, whose equilibria are solved in compiled code."""
    return replace(model, drive=wheel, compiled=True)


def _measures(spec: IndexerSpec, names: Iterable[str]) -> list[Measure] | None:
    """The measures of the names that no compiled code gives; None where one of the names is not among them."""
    missing, chosen = set(names) - COMPILED, []
    if not missing:
        return []
    try:
        model = _quick(built := build(spec), sampled(built.wheel))
        for measure in MEASURES:
            own = dict(numbers_of(measure(model))).keys() & missing
            if own:
                chosen.append(measure)
                missing -= own
    except DrivewrightError:  # the run of one design says why
        return None
    return None if missing else chosen
