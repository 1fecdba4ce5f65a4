"""A pin in a hole with clearance, both elastic and of one material, in an endless plate: Persson's closed form.

With y = tan(phi/2) at the angle phi from the load, b = y at the end of the contact, c = R_hole - R_pin, Q the load over the thickness,
r = sqrt(b^2 + 1), q = sqrt(b^2 - y^2) and E' = E/(1 - nu^2) (plane strain; E in plane stress):

    E' c/Q = (2 - ln(b^2 + 1) - 2 b^4)/(pi b^2 (b^2 + 1)),
    p R/Q  = 2 q/(pi r (1 + y^2)) + ln[(r + q)/(r - q)]/(2 pi b^2 (1 + b^2)).

Source: Persson's thesis (1964) in the form of Ciavarella and Decuzzi (2001), recalled; the tests find the load from the pressure again, and
both from finite elements.
"""

from typing import Any

import numpy as np
from scipy.optimize import brentq

from drivewright._typing import Floats, Numbers
from drivewright.errors import InputError

LEAST = 1e-6  # of b


def conforming_half_angle(load: float, clearance: float, modulus: float) -> float:
    """Half the angle of contact [rad] under a load [N/m] with a radial clearance [m] and E' [Pa]; without clearance 84.8 deg."""
    if not (load > 0 and clearance >= 0 and modulus > 0):
        raise InputError(
            f"conforming contact: load {load:g} N/m, clearance {clearance:g} m, modulus {modulus:g} Pa; load and modulus must be above 0, "
            "the clearance not below"
        )
    wanted = modulus * clearance / load
    if _clearance(LEAST) < wanted:
        raise InputError(
            f"conforming contact: a clearance of {clearance:g} m leaves a contact of negligible width; take a Hertz line contact"
        )
    end: Any = brentq(lambda b: _clearance(b) - wanted, LEAST, 1.0, xtol=1e-15)
    return 2 * float(np.arctan(end))


def conforming_pressure(angle: Numbers, half_angle: float) -> Floats:
    """Pressure p R/Q [-] at angles [rad] from the load; 0 outside the contact."""
    y, b = np.tan(0.5 * np.asarray(angle, float)), np.tan(0.5 * half_angle)
    inside = np.abs(y) < b
    q, r = np.sqrt(np.where(inside, b * b - y * y, 0.0)), np.sqrt(b * b + 1)
    return 2 * q / (np.pi * r * (1 + y * y)) + np.log((r + q) / (r - q)) / (2 * np.pi * b * b * (1 + b * b))


def _clearance(b: float) -> float:
    """E' c/Q."""
    return float((2 - np.log(b * b + 1) - 2 * b**4) / (np.pi * b * b * (b * b + 1)))
