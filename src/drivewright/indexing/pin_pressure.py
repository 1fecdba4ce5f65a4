"""Hertz pressure of a pin on a profile, the contact that resists a torque best, and tables of forces on pins."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from drivewright import contact
from drivewright._typing import Floats
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.plane import PinDrive, contacts_at
from drivewright.result import Column, Table, Value

FORCE_COLUMNS = {
    "angle": ("rad", "input angle"),
    "cam": ("-", "cam"),
    "pin": ("-", "roller"),
    "force": ("N", "force on the roller"),
    "arm": ("m", "moment arm about the wheel's axis"),
    "length": ("m", "length of the contact line"),
    "pressure": ("Pa", "Hertz pressure"),
}
"""Unit and label of every column that a table of forces on pins or rollers may have."""
WIDEST = 0.1  # half-width of a line contact over its relative radius, up to which it is small against the bodies, as Hertz's theory assumes


def relative_width(pressure: float, modulus: float) -> float:
    """Half-width of a line contact over its relative radius, b/R = 2 p0/E*; peak pressure p0, effective modulus E* [Pa]."""
    return 2 * pressure / modulus


def largest_approach(radius: float) -> float:
    """Approach [m] of a roller of this radius [m] and a flank alike in material at which the contact is as wide as `WIDEST`.

    delta = F'/(pi E*) (2 ln(4 R/b) - 1) with F' = pi E* b^2/(4 R), each body compressed as a cylinder (`contact.cylinder_compression`);
    0.016 R for b = R/10, whatever the modulus.
    """
    return radius * WIDEST**2 / 4 * (2 * math.log(4 / WIDEST) - 1)


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
    return contact_force_table("pin_forces", "Roller force at the longest moment arm", ("angle", "pin", "force", "arm", "pressure"), rows)


def contact_force_table(
    name: str,
    title: str,
    columns: Sequence[str],
    rows: Sequence[tuple[float, ...]],
    labels: Mapping[str, str] | None = None,
    missing: str = "",
) -> Table:
    """The table of forces with these columns of `FORCE_COLUMNS`, a row for each contact; `labels` of columns that have another one here."""
    data = np.array(rows, dtype=float).reshape(-1, len(columns)).T
    units = {column: FORCE_COLUMNS[column] for column in columns}
    named = {column: (labels or {}).get(column, label) for column, (_, label) in units.items()}
    made = (Column(column, units[column][0], named[column], numbers) for column, numbers in zip(columns, data, strict=True))
    return Table(name, title, tuple(made), missing=missing)


def largest_pin_values(forces: Table, part: str = "pin") -> dict[str, Value]:
    """Largest force and pressure of a table of forces on each `part`, a pin or a roller."""
    values = {}
    if len(forces["force"].data):
        values["pins.max_force"] = Value(float(np.max(forces["force"].data)), "N", f"maximum force on a {part}")
    if np.isfinite(forces["pressure"].data).any():
        values["pins.max_pressure"] = Value(float(np.nanmax(forces["pressure"].data)), "Pa", f"maximum Hertz pressure on a {part}")
    return values
