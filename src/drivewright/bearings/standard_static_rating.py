"""Basic static ratings of ISO 76 by the inner geometry, for one bearing or arrays of them; the standard's steel, its usual grooves.

`basic_static_rating` asks the same of a bearing with its own steel and grooves.  The standard was not opened: f_0 is that of NSK's
catalogue within 2 %, but for the thinnest sections (series 618), where the maker's is up to 8 % higher.
"""

import numpy as np

from drivewright._typing import Floats, Numbers
from drivewright.bearings.solving import PERMISSIBLE
from drivewright.contact import effective_modulus, point_contact, relative_radii

MODULUS, POISSON = 207e9, 0.3  # of the steel that the tables of f_0 stand for [Pa]
INNER_GROOVE, OUTER_GROOVE = 0.52, 0.53  # radii over the diameter of a ball
ROLLER_FACTOR = 44e6  # 44 N/mm^2: 4000 MPa at 206 GPa, a fifth of the load on the fullest roller


def ball_standard_static_rating(balls: Numbers, diameter: Numbers, pitch_diameter: Numbers, angle: float) -> Floats:
    """C0 [N] = f_0 Z Dw^2 cos a, f_0 = `static_factor`(Dw cos a/Dpw); diameters in [m]."""
    factor = static_factor(diameter * np.cos(angle) / pitch_diameter)
    return factor * np.asarray(balls) * np.square(diameter) * np.cos(angle)


def static_factor(curvature_ratio: Numbers) -> Floats:
    """f_0 [Pa] (1e6 of them are the table's N/mm^2): a fifth of the load that presses a ball of 1 m with 4200 MPa into the worse race."""
    g = np.asarray(curvature_ratio, dtype=float)
    modulus = effective_modulus(MODULUS, POISSON, MODULUS, POISSON)
    races = (0.5 * (1 - g) / g, -INNER_GROOVE), (-0.5 * (1 + g) / g, -OUTER_GROOVE)
    pressure = [point_contact(1.0, relative_radii((0.5, 0.5), race), modulus).pressure for race in races]
    return (PERMISSIBLE["point"][0] / np.maximum(pressure[0], pressure[1])) ** 3 / 5


def roller_standard_static_rating(rollers: Numbers, diameter: Numbers, length: Numbers, pitch_diameter: Numbers, angle: float) -> Floats:
    """C0 [N] = 44 (1 - Dw cos a/Dpw) Z L Dw cos a (N, mm) of one row; diameters and effective length in [m]."""
    cosine = np.cos(angle)
    return ROLLER_FACTOR * (1 - diameter * cosine / pitch_diameter) * np.asarray(rollers) * length * diameter * cosine
