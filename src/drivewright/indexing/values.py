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
        "motion.motion_angle": Value(motion_angle, "rad", "input angle in which the wheel moves"),
        "motion.velocity_factor": Value(rate, "-", "largest speed of the wheel over that of the input"),
        "motion.acceleration_factor": Value(second, "1/rad", "largest d2 phi/d theta2"),
    }
    if speed:
        values["motion.peak_speed"] = Value(rate * speed, "rad/s", "largest speed of the wheel")
        values["motion.peak_acceleration"] = Value(second * speed**2, "rad/s^2", "largest angular acceleration of the wheel")
    return values


def profile_values(drive: PlaneDrive, table: Table) -> dict[str, Value]:
    """Measures of the trimmed profile of a cam, named after its `profile_table`; no convex radius where the cam is nowhere convex."""
    trimmed, name, convex = drive.profile, table.name, least_convex_radius(drive)
    radius = np.hypot(table["x"].data, table["y"].data)
    values = {
        f"{name}.area": Value(trimmed.area, "m^2", "area within the profile of a cam"),
        f"{name}.perimeter": Value(trimmed.perimeter, "m", "length of the profile"),
        f"{name}.min_radius": Value(np.min(radius), "m", "least distance of the profile from the cam's centre"),
        f"{name}.max_radius": Value(np.max(radius), "m", "greatest distance of the profile from the cam's centre"),
        f"{name}.corners": Value(float(len(trimmed.corners)), "-", "sharp corners, where the envelope was trimmed"),
    }
    if np.isfinite(convex):
        values[f"{name}.min_convex_radius"] = Value(convex, "m", "least radius of the centre curve where the cam is convex")
    return values


def contact_count_values(table: Table, fewest: str, most: str) -> dict[str, Value]:
    """Fewest and most pins in contact of a table of contacts, with these meanings."""
    count = table["pins"].data
    return {"contacts.minimum": Value(float(count.min()), "-", fewest), "contacts.maximum": Value(float(count.max()), "-", most)}


def pressure_angle_values(driving: Floats, best: Floats) -> dict[str, Value]:
    """Largest of the pressure angles (n,) and (2, n) [rad] of `driving_pressure_angle` and `best_pressure_angles`; none of no pin."""
    if not np.isfinite(driving).any():
        return {}
    meaning = "largest pressure angle of the pin that accelerates the wheel best"
    values = {"pressure_angle.maximum": Value(float(np.nanmax(driving)), "rad", meaning)}
    for name, angles in zip(DIRECTIONS, best, strict=True):
        if np.isfinite(angles).any():
            meaning = f"largest pressure angle of the pin that pushes best {name}"
            values[f"pressure_angle.{name}.maximum"] = Value(float(np.nanmax(angles)), "rad", meaning)
    return values


def contact_findings(angles: Floats, best: Floats) -> Iterator[str]:
    """Directions in which no pin can be pushed at some of the input angles (n,) [rad]; best (2, n) [rad]."""
    for (name, against), lost in zip((("forward", "backward"), ("backward", "forward")), np.isnan(best), strict=True):
        if lost.any():
            yield (
                f"no pin can be pushed {name} by contact at {lost.sum()} of {len(angles)} positions ({angle_ranges(angles, lost)}): "
                f"it does not hold the wheel there against a torque that acts {against}"
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
        values[f"play.{name}.maximum"] = Value(free[worst], "rad", f"largest free rotation of the wheel {name}")
        if free[worst] > PROFILE_TOLERANCE / circle_radius:
            values[f"play.{name}.maximum.at"] = Value(angle[worst], "rad", "input angle of it")
    return values


def play_findings(angle: Floats, rotations: Mapping[str, Floats]) -> Iterator[str]:
    """Directions in which nothing stops the wheel at some of the input angles (n,) [rad]; rotations (n,) [rad] by direction."""
    for name, free in rotations.items():
        lost = ~np.isfinite(free)
        if lost.any():
            yield (
                f"nothing stops the wheel {name} at {np.sum(lost)} of {len(angle)} input angles ({angle_ranges(angle, lost)}): "
                f"play.{name}.maximum does not exist"
            )
