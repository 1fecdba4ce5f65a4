"""Motion, profile, contacts and play of the plane kinds."""

from collections.abc import Iterator, Mapping
from itertools import chain

import numpy as np

from drivewright._typing import Floats
from drivewright.indexing.cam_tables import (
    best_pressure_angles,
    contact_count_table,
    contact_map_array,
    contact_points_table,
    driving_pressure_angle,
    find_all_contacts,
    profile_table,
)
from drivewright.indexing.motion import motion_table
from drivewright.indexing.pin_wheel import profile_findings, sleeve_findings, wall_thicknesses
from drivewright.indexing.play import DIRECTIONS, find_play, play_table, turn_angles
from drivewright.indexing.values import (
    contact_count_values,
    contact_findings,
    motion_values,
    play_findings,
    play_values,
    pressure_angle_values,
    profile_values,
)
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.result import Answer, Answers, Check, Value

SUFFIXES = {"": "", ".second": ", cam 2"}  # of the values of cams that differ, and of their labels


def motion(model: IndexerModel, done: Answers) -> Answer:
    """The wheel over one turn of the input."""
    moving = model.drive.motion
    table = motion_table(moving)
    return Answer(motion_values(table, moving.motion_angle, model.spec.load.speed), (table,))


def profile(model: IndexerModel, done: Answers) -> Answer:
    """The trimmed profile of every cam that differs: measures, points, curvature, undercut."""
    levels, values = model.plane.levels, {}
    names = [(f"profile{suffix}", which) for _, (suffix, which) in zip(levels, SUFFIXES.items(), strict=False)]
    tables = tuple(profile_table(level, name, f"Cam profile{which}") for level, (name, which) in zip(levels, names, strict=True))
    for level, table, (_, which) in zip(levels, tables, names, strict=True):
        values |= profile_values(level, table, which)
    checks = chain(_curvature_checks(model, values), _wall_checks(model, values))
    return Answer(values, tables, tuple(checks), tuple(_findings(model)))


def _curvature_checks(model: IndexerModel, values: Mapping[str, Value]) -> Iterator[Check]:
    message = "minimum convex radius of the pitch curve over the pin radius; take thinner pins"
    for suffix, which in SUFFIXES.items():
        radius = values.get(f"profile{suffix}.min_convex_radius")
        if radius is not None:
            ratio = radius.value / model.spec.pin_radius
            limit, label = model.spec.limits.curvature_ratio, f"Convex radius over pin radius{which}"
            yield Check(f"curvature{suffix}", ratio, limit, ">=", "-", message, ("cam1",), label=label)


def _wall_checks(model: IndexerModel, values: Mapping[str, Value]) -> Iterator[Check]:
    outer, spacing = getattr(model.crank_bearing, "outer_diameter", None), model.spec.shaft_spacing
    if not outer or spacing is None:
        return
    holes, edge = wall_thicknesses(model.wheel, spacing, outer, (values["profile.min_radius"].value, values["profile.max_radius"].value))
    least, hint = model.spec.limits.wall, "take smaller crank bearings or change shaft_spacing"
    for name, wall, where, label in (
        ("holes", holes, "between the bearing holes of a cam", "Wall between bearing holes"),
        ("profile", edge, "between a bearing hole and the profile", "Wall between hole and profile"),
    ):
        yield Check(f"wall.{name}", wall, least, ">=", "m", f"minimum wall {where}; {hint}", ("cam1",), True, label=label)


def _findings(model: IndexerModel) -> Iterator[str]:
    """Where the measures of a pin wheel cut its profile away or leave no room for a sleeve."""
    if not model.translating:
        return
    yield from profile_findings(model.wheel)
    bore, shafts = getattr(model.crank_bearing, "bore", None), model.spec.shafts
    if bore and shafts:
        yield from sleeve_findings(model.wheel.eccentricity, bore, max(shafts.diameters[1:]))


def contact_map(model: IndexerModel, done: Answers) -> Answer:
    """Which pins touch one cam, which way it can push them, and how well."""
    drive, angles = model.plane, model.angles
    contacts = find_all_contacts(drive, angles)
    best = best_pressure_angles(contacts, drive.circle_radius)
    driving = driving_pressure_angle(drive.motion(angles).d2, best)
    table = contact_count_table(angles, contacts, drive, driving, best)
    touched = f"with {'one cam' if len(drive.levels) == 1 else 'the two cams together'} over the index period"
    values = contact_count_values(table, "pins", touched) | pressure_angle_values(driving, best)
    hint = "increase the eccentricity or the motion angle" if model.translating else "reduce the centre distance or enlarge the pin circle"
    checks = tuple(pressure_angle_check(model, values, f"maximum pressure angle of the driving pin; {hint}"))
    tables = (table, contact_points_table(angles, contacts, drive, drive.levels[0].pin_radius))
    arrays = {"contact_map": contact_map_array(angles, contacts, drive)}
    return Answer(values, tables, checks, tuple(contact_findings(angles, best)), arrays, data=contacts)


def pressure_angle_check(model: IndexerModel, values: Mapping[str, Value], message: str) -> Iterator[Check]:
    """The largest pressure angle, where there is one, against its limit."""
    if "pressure_angle.maximum" in values:
        largest = values["pressure_angle.maximum"].value
        limit = model.spec.limits.pressure_angle
        yield Check("pressure_angle", largest, limit, "<=", "rad", message, ("cam", "wheel"), label="Maximum pressure angle")


def free_play(model: IndexerModel, done: Answers) -> Answer:
    """Free rotation of the wheel in either direction over the whole cycle."""
    angle = turn_angles(model.plane) if model.spec.load.angle is None else model.angles
    return play_answer(model, angle, {name: find_play(model.plane, angle, direction) for name, direction in DIRECTIONS.items()})


def play_answer(model: IndexerModel, angle: Floats, rotations: Mapping[str, Floats]) -> Answer:
    """Values, table and checks of the free rotations by direction; nan where no contact stops the wheel."""
    values = play_values(angle, rotations, model.spec.pin_circle_radius)
    checks = _play_checks(model, angle, rotations) if model.spec.load.angle is None else ()  # at one angle nothing is known of the cycle
    return Answer(values, (play_table(angle, rotations),), tuple(checks), tuple(play_findings(angle, rotations)))


def holding_hint(model: IndexerModel) -> str:
    """What to change where the cams do not hold the wheel without play."""
    return "take a longer motion angle, thinner pins or a larger eccentricity" if model.translating else "check for undercut"


def _play_checks(model: IndexerModel, angle: Floats, rotations: Mapping[str, Floats]) -> Iterator[Check]:
    limit = model.spec.limits.play
    for name, free in rotations.items():
        if np.isfinite(free).all():
            at = int(np.argmax(free))
            where = f"maximum over the cycle at {np.degrees(angle[at]):.4g}°" if free[at] > 0 else "over the whole cycle"
            largest, message = free[at], f"play of the wheel {name}, {where}"
        else:
            largest = max(model.drive.pin_pitch, 2 * limit)
            message = f"play of the wheel {name}: no contact stops the wheel within a whole pitch"
        message = f"{message}; {holding_hint(model)}"
        yield Check(f"play.{name}", largest, limit, "<=", "rad", message, ("wheel", "cam"), label=f"Maximum play, {name}")
