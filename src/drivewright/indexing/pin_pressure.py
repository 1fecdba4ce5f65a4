"""Hertz pressure of a pin on a profile, and the contact that resists a torque best."""

import numpy as np

from drivewright import contact
from drivewright.indexing.plane import PlaneDrive, find_contacts


def pin_pressure(force: float, curvature: float, pin_radius: float, width: float, modulus: float) -> float:
    """Peak pressure [Pa] of Hertz's line contact of a pin; nan at a corner, in a pull, or where the profile is as hollow as the pin.

    force [N], curvature [1/m] of the profile, positive where convex, pin radius and width [m], effective modulus E* [Pa].
    """
    relative = 1 / pin_radius + curvature
    if not (force > 0 and np.isfinite(curvature) and relative > 0):
        return np.nan
    return float(contact.line_contact(force, width, 1 / relative, modulus).pressure)


def best_resisting_contact(drive: PlaneDrive, angle: float, torque: float) -> tuple[int, float, float]:
    """(pin, arm [m], curvature [1/m]) of the intended contact that resists the torque with the longest arm; arm 0 where none does."""
    contacts = find_contacts(drive, angle)
    lever = np.where(contacts.intended, -np.sign(torque) * contacts.arm, -np.inf)
    if not len(lever) or np.max(lever) <= 0:
        return 0, 0.0, 0.0
    k = int(np.argmax(lever))
    return int(contacts.pin[k]), float(contacts.arm[k]), float(contacts.curvature[k])
