"""Motion, profile, contacts and play of the plane kinds."""

from collections.abc import Iterator, Mapping

import numpy as np

from drivewright._typing import Floats
from drivewright.indexing.cam_tables import (
    angle_ranges,
    best_pressure_angles,
    contact_count_table,
    contact_map_array,
    contact_points_table,
    driving_pressure_angle,
    find_all_contacts,
    least_convex_radius,
    profile_table,
)
from drivewright.indexing.motion import TURN, motion_table
from drivewright.indexing.plane import PROFILE_TOLERANCE, PlaneDrive
from drivewright.indexing.play import BACKWARD, FORWARD, find_play, refine_about_peak
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.result import Answer, Answers, Check, Column, Table, Value

SUFFIXES = ("", ".second")  # of the values of cams that differ
POINTS = 721  # of the search of play over the whole turn
WAYS = (("forward", FORWARD), ("backward", BACKWARD))


def motion(model: IndexerModel, done: Answers) -> Answer:
    """The wheel over one turn of the input."""
    table = motion_table(model.drive.motion)
    rate, bend = (np.max(np.abs(table[name].data)) for name in ("rate", "bend"))
    values = {
        "motion.motion_angle": Value(model.drive.motion.motion_angle, "rad", "input angle in which the wheel moves"),
        "motion.velocity_factor": Value(rate, "-", "largest speed of the wheel over that of the input"),
        "motion.acceleration_factor": Value(bend, "1/rad", "largest d2 phi/d theta2"),
    }
    if speed := model.spec.load.speed:
        values["motion.peak_speed"] = Value(rate * speed, "rad/s", "largest speed of the wheel")
        values["motion.peak_acceleration"] = Value(bend * speed**2, "rad/s^2", "largest angular acceleration of the wheel")
    return Answer(values, (table,))


def profile(model: IndexerModel, done: Answers) -> Answer:
    """The trimmed profile of every cam that differs: measures, points, curvature, undercut."""
    parts = [_profile(model, level, suffix) for level, suffix in zip(model.plane.levels, SUFFIXES, strict=False)]
    values = {name: value for part in parts for name, value in part[0].items()}
    checks = [check for part in parts for check in part[2]]
    return Answer(values, tuple(part[1] for part in parts), (*checks, *walls(model, values)), tuple(_remarks(model)))


def _profile(model: IndexerModel, drive: PlaneDrive, suffix: str) -> tuple[dict[str, Value], Table, tuple[Check, ...]]:
    """(values, table, checks) of one cam."""
    trimmed = drive.profile
    table = profile_table(trimmed, f"profile{suffix}")
    radius = np.hypot(table["x"].data, table["y"].data)
    convex = least_convex_radius(drive)
    values = {
        f"profile{suffix}.area": Value(trimmed.area, "m^2", "area within the profile of a cam"),
        f"profile{suffix}.perimeter": Value(trimmed.perimeter, "m", "length of the profile"),
        f"profile{suffix}.min_radius": Value(np.min(radius), "m", "least distance of the profile from the cam's centre"),
        f"profile{suffix}.max_radius": Value(np.max(radius), "m", "greatest distance of the profile from the cam's centre"),
        f"profile{suffix}.corners": Value(float(len(trimmed.corners)), "-", "sharp corners, where the envelope was trimmed"),
    }
    if not np.isfinite(convex):
        return values, table, ()
    values[f"profile{suffix}.min_convex_radius"] = Value(convex, "m", "least radius of the centre curve where the cam is convex")
    check = Check(
        f"curvature{suffix}",
        convex / drive.pin_radius,
        model.spec.limits.curvature_ratio,
        ">=",
        "-",
        "least convex radius of the centre curve over the pin's radius",
        ("cam1",),
    )
    return values, table, (check,)


def walls(model: IndexerModel, values: Mapping[str, Value]) -> Iterator[Check]:
    """Material between the two bearing holes of a cam, and between them and the profile."""
    outer = getattr(model.crank_bearing, "outer_diameter", None)
    spacing, least = model.spec.shaft_spacing, model.spec.limits.wall
    if not outer or spacing is None:
        return
    inside = values["profile.min_radius"].value - 0.5 * (spacing + outer)
    outside = 0.5 * (spacing - outer) - values["profile.max_radius"].value
    between = {
        "holes": (spacing - outer, "between the bearing holes of a cam"),
        "profile": (inside if model.spec.side == "inside" else outside, "between a bearing hole and the profile"),
    }
    for name, (width, words) in between.items():
        yield Check(f"wall.{name}", width, least, ">=", "m", f"wall {words}", ("cam1",), True)


def _remarks(model: IndexerModel) -> Iterator[str]:
    """What a designer should know and no number tells."""
    spec, moving = model.spec, model.drive.motion
    eccentricity = spec.eccentricity or 0.0
    if model.translating and moving.motion_angle < TURN and spec.pin_radius >= eccentricity:
        yield (
            f"pins of {1e3 * spec.pin_radius:.4g} mm reach the eccentricity of {1e3 * eccentricity:.4g} mm: the tops of the lobes "
            "that would touch in the dwell are cut away"
        )
    turns_back = eccentricity * moving.divisions / spec.pin_circle_radius if model.translating and moving.law.name == "uniform" else 0.0
    if turns_back > 1:
        yield (
            f"eccentricity times pins over pin_circle_radius is {turns_back:.4g}, above 1: the centre curve turns back in loops; parts of "
            "the profile are cut away"
        )
    bore = getattr(model.crank_bearing, "bore", None)
    shaft = max(spec.shafts.diameters[1:]) if spec.shafts else None
    if bore and shaft and bore / 2 - eccentricity - shaft / 2 <= 0:
        yield (
            f"a bore of {1e3 * bore:.4g} mm on an eccentricity of {1e3 * eccentricity:.4g} mm leaves no sleeve around a shaft of "
            f"{1e3 * shaft:.4g} mm (at most {1e3 * max(bore - 2 * eccentricity, 0):.4g} mm): make shaft and crank pins of one piece"
        )


def contact_map(model: IndexerModel, done: Answers) -> Answer:
    """Which pins touch one cam, which way it can push them, and how well."""
    drive, angles = model.plane, model.angles
    contacts = [find_all_contacts(drive, angle) for angle in angles]
    best = best_pressure_angles(contacts, drive.circle_radius)
    driving = driving_pressure_angle(drive.motion(angles).d2, best)
    table = contact_count_table(angles, contacts, drive, driving, best)
    one = "one cam" if len(drive.levels) == 1 else "the two cams together"
    values = contact_counts(
        table, f"fewest pins that touch {one} over the index period", f"most pins that touch {one} over the index period"
    )
    checks = []
    if np.isfinite(driving).any():
        worst = float(np.nanmax(driving))
        values["pressure_angle.maximum"] = Value(worst, "rad", "largest pressure angle of the pin that accelerates the wheel best")
        for side, (name, _) in enumerate(WAYS):
            if np.isfinite(best[side]).any():
                values[f"pressure_angle.{name}.maximum"] = Value(
                    float(np.nanmax(best[side])), "rad", f"largest pressure angle of the pin that pushes best {name}"
                )
        words = "angle between the normal and the way of the pin that accelerates the wheel best"
        checks.append(pressure_angle_check(model, worst, words))
    findings = tuple(
        f"no pin can be pushed {name} by contact at {lost.sum()} of {len(angles)} positions ({angle_ranges(angles, lost)}): "
        f"it does not hold the wheel there against a torque that acts {'backward' if name == 'forward' else 'forward'}"
        for (name, _), lost in zip(WAYS, np.isnan(best), strict=True)
        if lost.any()
    )
    tables = (table, contact_points_table(angles, contacts, drive, drive.levels[0].pin_radius))
    arrays = {"contact_map": contact_map_array(angles, contacts, drive)}
    return Answer(values, tables, tuple(checks), findings, arrays, data=contacts)


def contact_counts(table: Table, fewest: str, most: str) -> dict[str, Value]:
    """Fewest and most pins in contact of a table of contacts, in those words."""
    count = table["pins"].data
    return {"contacts.minimum": Value(float(count.min()), "-", fewest), "contacts.maximum": Value(float(count.max()), "-", most)}


def pressure_angle_check(model: IndexerModel, worst: float, words: str) -> Check:
    """The largest pressure angle [rad] against its limit."""
    return Check("pressure_angle", worst, model.spec.limits.pressure_angle, "<=", "rad", words, ("cam", "wheel"))


def free_play(model: IndexerModel, done: Answers) -> Answer:
    """Free rotation of the wheel in either direction over the whole cycle."""
    if model.spec.load.angle is not None:
        return play_answer(model, model.angles, {name: find_play(model.plane, model.angles, way) for name, way in WAYS})
    angle = np.linspace(0, TURN, POINTS)
    for _, way in WAYS:
        angle = np.union1d(angle, refine_about_peak(model.plane, angle, way))
    return play_answer(model, angle, {name: find_play(model.plane, angle, way) for name, way in WAYS})


def play_answer(model: IndexerModel, angle: Floats, rotations: Mapping[str, Floats]) -> Answer:
    """Values, table and checks of the free rotations by direction; nan where nothing stops the wheel."""
    values, checks, findings = {}, [], []
    columns = [Column("angle", "rad", "input angle", angle)]
    for name, free in rotations.items():
        columns.append(Column(name, "rad", f"free rotation {name}", free))
        stopped = np.isfinite(free)
        if not stopped.all():
            findings.append(
                f"nothing stops the wheel {name} at {np.sum(~stopped)} of {len(angle)} input angles "
                f"({angle_ranges(angle, ~stopped)}): play.{name}.maximum does not exist"
            )
            checks.append(
                Check(
                    f"play.{name}",
                    max(model.drive.motion.pitch, 2 * model.spec.limits.play),
                    model.spec.limits.play,
                    "<=",
                    "rad",
                    f"free rotation {name}: nothing stops the wheel within a whole pitch",
                    ("wheel", "cam"),
                )
            )
            continue
        worst = int(np.argmax(free))
        where = f"largest over the cycle at {np.degrees(angle[worst]):.4g} deg" if free[worst] > 0 else "over the whole cycle"
        values[f"play.{name}.maximum"] = Value(free[worst], "rad", f"largest free rotation of the wheel {name}")
        if free[worst] > PROFILE_TOLERANCE / model.spec.pin_circle_radius:
            values[f"play.{name}.maximum.at"] = Value(angle[worst], "rad", "input angle of it")
        checks.append(
            Check(
                f"play.{name}",
                free[worst],
                model.spec.limits.play,
                "<=",
                "rad",
                f"free rotation of the wheel {name}, {where}",
                ("wheel", "cam"),
            )
        )
    checks = [] if model.spec.load.angle is not None else checks  # of one angle they would speak of the cycle
    return Answer(values, (Table("play", "Play of the wheel", tuple(columns)),), tuple(checks), tuple(findings))
