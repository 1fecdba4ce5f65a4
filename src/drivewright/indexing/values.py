"""Motion, profile, contacts and play of plate cams as values and findings of a result."""

from collections.abc import Iterator, Mapping

import numpy as np

from drivewright._typing import Floats
from drivewright.indexing.cam_tables import angle_ranges, least_convex_radius
from drivewright.indexing.plane import PROFILE_TOLERANCE, PlaneDrive
from drivewright.indexing.play import DIRECTIONS
from drivewright.result import Table, Value


def motion_values(table: Table, motion_angle: float, speed: float | None = None) -> dict[str, Value]:
    """Peaks of a `motion_table` over the input angle, and in time at a constant speed [rad/s] of the input; motion_angle [rad]."""
    rate, second = (np.max(np.abs(table[name].data)) for name in ("rate", "bend"))
    values = {
        "motion.motion_angle": Value(motion_angle, "rad", "input angle over which the wheel moves", label="Motion angle"),
        "motion.velocity_factor": Value(
            rate, "-", "maximum speed of the wheel over that of the input", label="Maximum speed ratio, wheel to input"
        ),
        "motion.acceleration_factor": Value(
            second,
            "1/rad",
            "maximum second derivative of the wheel angle by the input angle",
            label="Maximum second derivative of wheel angle",
        ),
    }
    if speed:
        values["motion.peak_speed"] = Value(rate * speed, "rad/s", "maximum speed of the wheel")
        values["motion.peak_acceleration"] = Value(
            second * speed**2, "rad/s^2", "maximum angular acceleration of the wheel", label="Maximum wheel acceleration"
        )
    return values


def profile_values(drive: PlaneDrive, table: Table, which: str = "") -> dict[str, Value]:
    """Measures of the trimmed profile of a cam, named after its `profile_table`; no convex radius where the cam is nowhere convex.

    which: ", cam 2" behind the labels and meanings of a cam that is not the first.
    """
    trimmed, name, convex = drive.profile, table.name, least_convex_radius(drive)
    radius = np.hypot(table["x"].data, table["y"].data)
    rows = [
        ("area", trimmed.area, "m^2", "area within the profile of the cam", "Area of the cam profile"),
        ("perimeter", trimmed.perimeter, "m", "length of the profile of the cam", "Length of the cam profile"),
        ("min_radius", np.min(radius), "m", "minimum distance of the profile from the cam's centre", "Minimum radius of the cam profile"),
        ("max_radius", np.max(radius), "m", "maximum distance of the profile from the cam's centre", "Maximum radius of the cam profile"),
        ("corners", float(len(trimmed.corners)), "-", "number of sharp corners where undercut trims the profile", "Sharp corners"),
    ]
    if np.isfinite(convex):
        meaning = "minimum radius of curvature of the pitch curve where the cam is convex"
        rows.append(("min_convex_radius", convex, "m", meaning, "Minimum convex pitch-curve radius"))
    return {
        f"{name}.{key}": Value(number, unit, f"{meaning}{which}", label=f"{label}{which}") for key, number, unit, meaning, label in rows
    }


def contact_count_values(table: Table, parts: str, where: str) -> dict[str, Value]:
    """Fewest and most pins in contact of a table of contacts; parts: "pins" or "rollers"; where: "with one cam"."""
    count = table["pins"].data
    return {
        f"contacts.{end}": Value(
            float(number), "-", f"{end} number of {parts} in contact {where}", label=f"{end.capitalize()} number of {parts} in contact"
        )
        for end, number in (("minimum", count.min()), ("maximum", count.max()))
    }


def pressure_angle_values(driving: Floats, best: Floats) -> dict[str, Value]:
    """Largest of the pressure angles (n,) and (2, n) [rad] of `driving_pressure_angle` and `best_pressure_angles`; none of no pin."""
    if not np.isfinite(driving).any():
        return {}
    meaning = "maximum pressure angle of the driving pin, the best placed one that accelerates the wheel"
    values = {"pressure_angle.maximum": Value(float(np.nanmax(driving)), "rad", meaning, label="Maximum pressure angle")}
    for name, angles in zip(DIRECTIONS, best, strict=True):
        if np.isfinite(angles).any():
            meaning = f"maximum pressure angle of the best placed pin that the cam can push {name}"
            label = f"Maximum pressure angle, {name}"
            values[f"pressure_angle.{name}.maximum"] = Value(float(np.nanmax(angles)), "rad", meaning, label=label)
    return values


def contact_findings(angles: Floats, best: Floats) -> Iterator[str]:
    """Directions in which no pin can be pushed at some of the input angles (n,) [rad]; best (2, n) [rad]."""
    for (name, against), lost in zip((("forward", "backward"), ("backward", "forward")), np.isnan(best), strict=True):
        if lost.any():
            yield (
                f"no contact can push a pin {name} at {lost.sum()} of {len(angles)} positions ({angle_ranges(angles, lost)}): "
                f"the cams do not hold the wheel there against a torque that acts {against}"
            )


def play_values(angle: Floats, rotations: Mapping[str, Floats], circle_radius: float) -> dict[str, Value]:
    """Largest free rotation [rad] in each direction, and where it is; absent where nothing stops the wheel at some input angle.

    angle (n,) [rad]; rotations (n,) [rad] by direction, nan where nothing stops the wheel; circle_radius of the pins [m].
    """
    values = {}
    for name, free in rotations.items():
        if not np.isfinite(free).all():
            continue
        worst = int(np.argmax(free))
        meaning = f"maximum free rotation of the wheel {name}, the input locked"
        values[f"play.{name}.maximum"] = Value(free[worst], "rad", meaning, label=f"Maximum play, {name}")
        if free[worst] > PROFILE_TOLERANCE / circle_radius:
            values[f"play.{name}.maximum.at"] = Value(
                angle[worst], "rad", f"input angle at maximum play, {name}", label=f"Input angle at maximum play, {name}"
            )
    return values


def play_findings(angle: Floats, rotations: Mapping[str, Floats]) -> Iterator[str]:
    """Directions in which no contact stops the wheel at some of the input angles (n,) [rad]; rotations (n,) [rad] by direction."""
    for name, free in rotations.items():
        lost = ~np.isfinite(free)
        if lost.any():
            yield (
                f"no contact stops the wheel {name} at {np.sum(lost)} of {len(angle)} input angles ({angle_ranges(angle, lost)}): "
                f"play.{name}.maximum does not exist"
            )
