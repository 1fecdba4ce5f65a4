"""Hertz pressure of a pin on a profile, and the contact that resists a torque best."""

import numpy as np

from drivewright import contact
from drivewright._typing import Floats
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.plane import PinDrive, contacts_at
from drivewright.result import Column, Table, Value


def pin_pressure(force: float, curvature: float, pin_radius: float, width: float, modulus: float) -> float:
    """Peak pressure [Pa] of Hertz's line contact of a pin; nan at a corner, in a pull, or where the profile is as hollow as the pin.

    force [N], curvature [1/m] of the profile, positive where convex, pin radius and width [m], effective modulus E* [Pa].
    """
    relative = 1 / pin_radius + curvature
    if not (force > 0 and np.isfinite(curvature) and relative > 0):
        return np.nan
    return float(contact.line_contact(force, width, 1 / relative, modulus).pressure)


def best_resisting_contact(contacts: CamContacts, torque: float) -> tuple[int, float, float]:
    """(pin, arm [m], curvature [1/m]) of the intended contact that resists the torque with the longest arm; arm 0 where none does."""
    lever = np.where(contacts.intended, -np.sign(torque) * contacts.arm, -np.inf)
    if not len(lever) or np.max(lever) <= 0:
        return 0, 0.0, 0.0
    k = int(np.argmax(lever))
    return int(contacts.pin[k]), float(contacts.arm[k]), float(contacts.curvature[k])


def longest_lever_table(drive: PinDrive, angles: Floats, torque: float, width: float, modulus: float) -> Table:
    """Force T/r and Hertz pressure of the roller with the longest lever r against a torque [N m], as if it carried all of it.

    angles (n,) [rad]: a row for each at which a roller of any cam resists; width of the cams [m], effective modulus E* [Pa].
    """
    rows, levels = [], zip(*(contacts_at(level, angles) for level in drive.levels), strict=True)
    for angle, contacts in zip(angles, levels, strict=True):
        best = [best_resisting_contact(each, torque) for each in contacts]
        number, (pin, arm, curvature) = max(enumerate(best), key=lambda each: abs(each[1][1]))
        if arm:
            force, level = abs(torque / arm), drive.levels[number]
            rows.append(
                (angle, pin + drive.levels[0].pins * number, force, arm, pin_pressure(force, curvature, level.pin_radius, width, modulus))
            )
    data = np.array(rows, dtype=float).reshape(-1, 5).T
    return Table(
        "pin_forces",
        "Force on the roller with the longest lever",
        (
            Column("angle", "rad", "input angle", data[0]),
            Column("pin", "-", "roller", data[1]),
            Column("force", "N", "force on the roller", data[2]),
            Column("arm", "m", "lever about the wheel's axis", data[3]),
            Column("pressure", "Pa", "Hertz pressure", data[4]),
        ),
    )


def largest_pin_values(forces: Table) -> dict[str, Value]:
    """Largest force and pressure of a table of pins."""
    values = {}
    if len(forces["force"].data):
        values["pins.max_force"] = Value(float(np.max(forces["force"].data)), "N", "largest force on a pin")
    if np.isfinite(forces["pressure"].data).any():
        values["pins.max_pressure"] = Value(float(np.nanmax(forces["pressure"].data)), "Pa", "largest Hertz pressure on a pin")
    return values
