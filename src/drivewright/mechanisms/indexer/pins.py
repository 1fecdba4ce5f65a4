"""Hertz pressure of pins on the cams, and what is allowed."""

import numpy as np

from drivewright import contact, materials
from drivewright.result import Check, Value


def hertz(model, force, curvature):
    """Peak pressure [Pa] of a pin on the profile; nan at a corner, in a pull, or where the profile is as hollow as the pin."""
    relative = 1 / model.spec.pin_radius + curvature
    if not (force > 0 and np.isfinite(curvature) and relative > 0):
        return np.nan
    return float(contact.line_contact(force, model.spec.cam_width, 1 / relative, model.modulus).pressure)


def largest(forces):
    """Largest force and pressure of a table of pins."""
    values = {}
    if len(forces["force"].data):
        values["pins.max_force"] = Value(float(np.max(forces["force"].data)), "N", "largest force on a pin")
    if np.isfinite(forces["pressure"].data).any():
        values["pins.max_pressure"] = Value(float(np.nanmax(forces["pressure"].data)), "Pa", "largest Hertz pressure on a pin")
    return values


def pressure_check(model, values):
    """The Hertz pressure against what is allowed, or what the material stands."""
    allowed = model.spec.limits.contact_pressure or materials.material(model.spec.contact.material).hertz_limit
    if allowed and "pins.max_pressure" in values:
        yield Check(
            "contact_pressure", values["pins.max_pressure"].value, allowed, "<=", "Pa", "Hertz pressure on a pin", ("cam1", "wheel")
        )
