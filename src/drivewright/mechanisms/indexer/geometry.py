"""Motion, profile, contacts and play of the plane kinds."""

import numpy as np

from drivewright.indexing.contacts import Contacts
from drivewright.indexing.motion import TURN
from drivewright.indexing.plane import ALIVE, contacts
from drivewright.indexing.play import BACKWARD, FORWARD, play
from drivewright.result import Answer, Array, Check, Column, Table, Value

SUFFIXES = ("", ".second")  # of the values of cams that differ
POINTS = 721  # of the tables over the whole turn
WAYS = (("forward", FORWARD), ("backward", BACKWARD))


def motion(model, done):
    """The wheel over one turn of the input."""
    angle = np.linspace(0, TURN, POINTS)
    phi, rate, bend, third = model.drive.motion(angle)
    values = {
        "motion.motion_angle": Value(model.drive.motion.motion_angle, "rad", "input angle in which the wheel moves"),
        "motion.velocity_factor": Value(np.max(np.abs(rate)), "-", "largest speed of the wheel over that of the input"),
        "motion.acceleration_factor": Value(np.max(np.abs(bend)), "1/rad", "largest d2 phi/d theta2"),
    }
    columns = [
        Column("angle", "rad", "input angle", angle),
        Column("wheel", "rad", "wheel angle", phi),
        Column("rate", "-", "speed of the wheel over that of the input", rate),
        Column("bend", "1/rad", "second derivative of the wheel angle", bend),
        Column("third", "1/rad^2", "third derivative of the wheel angle", third),
    ]
    speed = model.spec.load.speed
    if speed:
        values["motion.peak_speed"] = Value(np.max(np.abs(rate)) * speed, "rad/s", "largest speed of the wheel")
        values["motion.peak_acceleration"] = Value(np.max(np.abs(bend)) * speed**2, "rad/s^2", "largest angular acceleration of the wheel")
    return Answer(values, (Table("motion", "Motion of the wheel", tuple(columns)),))


def profile(model, done):
    """The trimmed profile of every cam that differs: measures, points, curvature, undercut."""
    parts = [_profile(model, level, suffix) for level, suffix in zip(model.drive.levels, SUFFIXES, strict=False)]
    values = {name: value for part in parts for name, value in part[0].items()}
    checks = [check for part in parts for check in part[2]]
    return Answer(values, tuple(part[1] for part in parts), (*checks, *walls(model, values)), tuple(_remarks(model)))


def _profile(model, drive, suffix):
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


def walls(model, values):
    """Material between the two bearing holes of a cam, and between them and the profile."""
    outer = getattr(model.crank_bearing, "outer_diameter", None)
    if not outer:
        return
    spacing, least = model.spec.shaft_spacing, model.spec.limits.wall
    inside = values["profile.min_radius"].value - 0.5 * (spacing + outer)
    outside = 0.5 * (spacing - outer) - values["profile.max_radius"].value
    between = {
        "holes": (spacing - outer, "between the bearing holes of a cam"),
        "profile": (inside if model.spec.side == "inside" else outside, "between a bearing hole and the profile"),
    }
    for name, (width, words) in between.items():
        yield Check(f"wall.{name}", width, least, ">=", "m", f"wall {words}", ("cam1",), True)


def _remarks(model):
    """What a designer should know and no number tells."""
    spec, moving = model.spec, model.drive.motion
    if model.translating and moving.motion_angle < TURN and spec.pin_radius >= spec.eccentricity:
        yield (
            f"pins of {1e3 * spec.pin_radius:.4g} mm reach the eccentricity of {1e3 * spec.eccentricity:.4g} mm: the tops of the lobes "
            "that would touch in the dwell are cut away"
        )
    turns_back = (
        spec.eccentricity * moving.divisions / spec.pin_circle_radius if model.translating and moving.law.name == "uniform" else 0.0
    )
    if turns_back > 1:
        yield (
            f"eccentricity times pins over pin_circle_radius is {turns_back:.4g}, above 1: the centre curve turns back in loops; parts of "
            "the profile are cut away"
        )
    bore = getattr(model.crank_bearing, "bore", None)
    shaft = max(spec.shafts.diameters[1:]) if spec.shafts else None
    if bore and shaft and bore / 2 - spec.eccentricity - shaft / 2 <= 0:
        yield (
            f"a bore of {1e3 * bore:.4g} mm on an eccentricity of {1e3 * spec.eccentricity:.4g} mm leaves no sleeve around a shaft of "
            f"{1e3 * shaft:.4g} mm (at most {1e3 * max(bore - 2 * spec.eccentricity, 0):.4g} mm): make shaft and crank pins of one piece"
        )


def profile_table(trimmed, name, chords=24):
    """Points along the profile with the input angle and the pin that cuts them; curvature positive where the cam is convex."""
    rows = []
    for span in trimmed.spans:
        t = np.linspace(span.start, span.stop, chords + 1)
        jet = span.piece.at(t)
        bend = np.imag(np.conj(jet.d1) * jet.d2) / np.maximum(np.abs(jet.d1), 1e-300) ** 3 * np.sign(span.stop - span.start)
        rows.append(np.stack(np.broadcast_arrays(t, jet.d0.real, jet.d0.imag, bend)))
    t, x, y, bend = np.concatenate(rows, axis=1)
    turns = np.floor(np.clip(t, 0, None) / TURN * (1 - 1e-12))
    way = np.sign(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    return Table(
        name,
        "Trimmed profile of the cam",
        (
            Column("angle", "rad", "input angle at which a pin touches here", t - TURN * turns),
            Column("pin", "-", "the pin", turns),
            Column("x", "m", "from the cam's centre", x),
            Column("y", "m", "from the cam's centre", y),
            Column("curvature", "1/m", "of the profile, positive where the cam is convex", way * bend),
        ),
    )


def least_convex_radius(drive):
    """Least radius of the centre curve [m] where the trimmed profile is convex; nan where it never is."""
    radii = []
    for span in drive.profile.spans:
        jet = span.piece.at(np.linspace(span.start, span.stop, 257))
        speed = np.maximum(np.abs(jet.d1), 1e-300)
        bend = np.imag(np.conj(jet.d1) * jet.d2) / speed**3 * np.sign(span.stop - span.start)
        convex = drive.way * bend > 0
        radii.append(np.min(1 / np.abs(bend[convex]) + drive.pin_radius, initial=np.inf))
    least = float(np.min(radii))
    return least if np.isfinite(least) else np.nan


def contact_map(model, done):
    """Which pins touch at every position, which way they can push, and how well."""
    drive, angles = model.drive, model.angles
    found = [all_contacts(drive, angle) for angle in angles]
    pins = drive.pins * len(drive.levels)
    way, alive = np.zeros((len(angles), pins)), np.zeros((len(angles), pins), dtype=bool)
    best = np.full((2, len(angles)), np.nan)
    for row, each in enumerate(found):
        live = each.intended
        alive[row, each.pin[live]] = True
        way[row, each.pin[live]] = np.sign(each.arm[live])
        for side, sign in enumerate((1, -1)):
            arms = sign * each.arm[live]
            if np.any(arms > 0):
                best[side, row] = np.arccos(min(np.max(arms) / drive.circle_radius, 1.0))
    count = alive.sum(axis=1)
    one = "one cam" if len(drive.levels) == 1 else "the two cams together"
    values = {
        "contacts.minimum": Value(float(count.min()), "-", f"fewest pins that touch {one} over the index period"),
        "contacts.maximum": Value(float(count.max()), "-", f"most pins that touch {one} over the index period"),
    }
    checks, findings = [], []
    driving = _driving(drive.motion(angles).d2, best)
    if np.isfinite(driving).any():
        worst = float(np.nanmax(driving))
        values["pressure_angle.maximum"] = Value(worst, "rad", "largest pressure angle of the pin that accelerates the wheel best")
        for side, name in enumerate(("forward", "backward")):
            if np.isfinite(best[side]).any():
                values[f"pressure_angle.{name}.maximum"] = Value(
                    float(np.nanmax(best[side])), "rad", f"largest pressure angle of the pin that pushes best {name}"
                )
        checks.append(
            Check(
                "pressure_angle",
                worst,
                model.spec.limits.pressure_angle,
                "<=",
                "rad",
                "angle between the normal and the way of the pin that accelerates the wheel best",
                ("cam", "wheel"),
            )
        )
    for side, name in enumerate(("forward", "backward")):
        lost = np.isnan(best[side])
        if lost.any():
            findings.append(
                f"no pin can be pushed {name} by contact at {lost.sum()} of {len(angles)} positions ({stretches(angles, lost)}): it does "
                f"not hold the wheel there against a torque that acts {'backward' if name == 'forward' else 'forward'}"
            )
    table = Table(
        "contacts",
        "Pins in contact with one cam",
        (
            Column("angle", "rad", "input angle", angles),
            Column("pins", "-", "pins that touch", count.astype(float)),
            Column("forward", "-", "pins that the cam can push forward", np.sum(way > 0, axis=1).astype(float)),
            Column("backward", "-", "pins that the cam can push backward", np.sum(way < 0, axis=1).astype(float)),
            Column("pressure_angle", "rad", "of the pin that accelerates the wheel best", driving),
            Column("pressure_angle_forward", "rad", "of the pin pushed best forward", best[0]),
            Column("pressure_angle_backward", "rad", "of the pin pushed best backward", best[1]),
        ),
    )
    points = _contact_points(angles, found, drive)
    names = (tuple(f"{np.degrees(angle):.6g} deg" for angle in angles), tuple(str(k) for k in range(pins)))
    arrays = {"contact_map": Array("-", ("angle", "pin"), names, np.where(alive, np.where(way == 0, 0.5, way), 0.0))}
    return Answer(values, (table, points), tuple(checks), tuple(findings), arrays, data=found)


def _driving(acceleration, best):
    """Pressure angle in the direction in which the wheel is accelerated; the worse of both where it is not."""
    still = np.abs(acceleration) <= 1e-9 * np.max(np.abs(acceleration), initial=1e-9)
    return np.where(still, np.fmax(best[0], best[1]), np.where(acceleration > 0, best[0], best[1]))


def spread(values, where):
    """Values of any broadcast shape at the places `where`."""
    return np.broadcast_to(values, where.shape)[where]


def all_contacts(drive, angle):
    """Contacts of one cam of each shape; pins of the second level count on from those of the first."""
    found = [contacts(level, angle) for level in drive.levels]
    shifted = [each._replace(pin=each.pin + drive.pins * k) for k, each in enumerate(found)]
    return Contacts(*(np.concatenate(parts) for parts in zip(*shifted, strict=True)))


def stretches(angles, lost, most=6):
    """In words, the stretches of the table of angles that are lost."""
    degrees = np.degrees(angles)
    edges = np.flatnonzero(np.diff(np.concatenate([[0], lost.astype(int), [0]])))
    parts = [
        f"{degrees[a]:.4g}" if b - a == 1 else f"{degrees[a]:.4g} to {degrees[b - 1]:.4g}"
        for a, b in zip(edges[::2], edges[1::2], strict=True)
    ]
    return f"{', '.join(parts[:most])}{' ...' if len(parts) > most else ''} deg"


def _contact_points(angles, found, drive):
    """Every contact of cam 0, one row each."""
    live = [each.intended for each in found]
    column = {
        key: np.concatenate([getattr(each, key)[keep] for each, keep in zip(found, live, strict=True)])
        for key in ("pin", "centre", "normal", "arm", "curvature")
    }
    at = column["centre"] - drive.pin_radius * column["normal"]
    return Table(
        "contact_points",
        "Contacts of one cam",
        (
            Column("angle", "rad", "input angle", np.repeat(angles, [np.sum(keep) for keep in live])),
            Column("pin", "-", "pin", column["pin"].astype(float)),
            Column("pin_forward", "-", "pin pushed forward", np.where(column["arm"] > 0, column["pin"], np.nan)),
            Column("pin_backward", "-", "pin pushed backward", np.where(column["arm"] < 0, column["pin"], np.nan)),
            Column("x", "m", "point of contact from the wheel's axis", at.real),
            Column("y", "m", "the same, y", at.imag),
            Column("arm", "m", "lever of the normal, forward above 0", column["arm"]),
            Column(
                "pressure_angle",
                "rad",
                "between the normal and the pin's way",
                np.arccos(np.minimum(np.abs(column["arm"]) / drive.circle_radius, 1)),
            ),
            Column("curvature", "1/m", "of the profile, positive where the cam is convex", column["curvature"]),
        ),
    )


def free_play(model, done):
    """Free rotation of the wheel in either direction over the whole cycle."""
    if model.spec.load.angle is not None:
        return play_answer(model, model.angles, {name: play(model.drive, model.angles, way) for name, way in WAYS})
    angle = np.linspace(0, TURN, POINTS)
    for _, way in WAYS:
        angle = np.union1d(angle, _about_the_peak(model.drive, angle, way))
    return play_answer(model, angle, {name: play(model.drive, angle, way) for name, way in WAYS})


def _about_the_peak(drive, angle, way, finer=16, passes=3):
    """Input angles about the largest play, ever finer; the curve is pointed there."""
    found = angle
    for _ in range(passes):
        free = np.nan_to_num(play(drive, angle, way), nan=-1.0)
        k = int(np.argmax(free))
        if free[k] <= 0:
            return found
        angle = np.linspace(angle[max(k - 1, 0)], angle[min(k + 1, len(angle) - 1)], 2 * finer + 1)
        found = np.union1d(found, angle)
    return found


def play_answer(model, angle, rotations):
    """Values, table and checks of the free rotations by direction; nan where nothing stops the wheel."""
    values, checks, findings = {}, [], []
    columns = [Column("angle", "rad", "input angle", angle)]
    for name, free in rotations.items():
        columns.append(Column(name, "rad", f"free rotation {name}", free))
        stopped = np.isfinite(free)
        if not stopped.all():
            findings.append(
                f"nothing stops the wheel {name} at {np.sum(~stopped)} of {len(angle)} input angles "
                f"({stretches(angle, ~stopped)}): play.{name}.maximum does not exist"
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
        if free[worst] > ALIVE / model.spec.pin_circle_radius:
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
