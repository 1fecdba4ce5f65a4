"""Load and Hertz pressure of the rollers of a roller-gear cam under a torque on the turret."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.contact import hertz
from drivewright.errors import InputError
from drivewright.indexing.roller_gear.flanks import CamFlanks


class RollerLoads(NamedTuple):
    """line_load (theta,) [N/m], the same on all contact lines that resist the torque; force (roller, theta) [N] of each roller;
    pressure (roller, theta, u) [Pa], peak of Hertz's line contact, nan off the finished cam; pressure_maximum (theta,) [Pa].

    All nan at angles where nothing resists the torque.
    """

    line_load: Floats
    force: Floats
    pressure: Floats
    pressure_maximum: Floats


def compute_roller_loads(flanks: CamFlanks, torque: float, modulus: float) -> RollerLoads:
    """Loads of the rollers under a torque [N m] on the turret, positive in +phi; modulus: effective E* [Pa] of roller and cam.

    Rigid turret, no friction, an even load q on every contact line that resists: q = |T| / sum of the integrals of |arm| along them;
    p0 = sqrt(q E*/(pi R)) with the relative radius R across the contact line.  A positive torque is resisted by flank -1.
    """
    if not (np.isfinite(torque) and torque != 0):
        raise InputError(f"roller loads: torque = {torque} N·m; it must be finite and not 0; its sign decides which flanks resist it.")
    if not (np.isfinite(modulus) and modulus > 0):
        raise InputError(f"roller loads: effective modulus = {modulus} Pa; it must be positive and finite.")
    side = 1 if torque > 0 else 0
    leverage = flanks.integrate_along_lines(np.abs(flanks.contact.arm))[side].sum(axis=0)
    with np.errstate(divide="ignore"):
        load = np.where(leverage > 0, abs(torque) / leverage, np.nan)
    force = load * flanks.integrate_along_lines(np.ones_like(flanks.contact.arm))[side]
    curvature = np.where(flanks.on_cam[side], flanks.contact.relative_curvature[side], np.nan)
    pressure = np.asarray(hertz.line_contact(load[:, None], 1.0, 1.0 / curvature, modulus).pressure)
    worst = np.where(np.isfinite(pressure), pressure, -np.inf).max(axis=(0, 2))
    return RollerLoads(load, force, pressure, np.where(np.isfinite(worst), worst, np.nan))
