"""The basic dynamic rating of a ball bearing by its inner geometry: ISO 281 and Lundberg & Palmgren 1947, recalled."""

import numpy as np

from drivewright.bearings.ball import BallBearing
from drivewright.bearings.solving import contact_of
from drivewright.errors import InputError

MATERIAL = 1.3  # b_m, today's steel against that of 1947


def basic_dynamic_rating(bearing: BallBearing) -> float:
    """C [N] of ISO 281: b_m f_c (cos a)^0.7 Z^(2/3) Dw^1.8 in mm, above 25.4 mm with 3.647 Dw^1.4 instead, b_m = 1.3.

    f_c = 38.2 (1 + h^(10/3))^(-3/10) g^0.3 (1 - g)^1.39/(1 + g)^(1/3) (2 f/(2 f - 1))^0.41 with f = 0.52 at both races and
    h = 1.04 ((1 - g)/(1 + g))^1.72.  The standard states it for grooves up to 0.52 Dw inside and 0.53 Dw outside.  Of balls alone: the
    factors of rollers are not stated here.
    """
    if contact_of(bearing) == "line":
        raise InputError(f"bearing: no dynamic rating is known by the geometry of a {type(bearing).__name__}. Give dynamic_rating.")
    inner, outer = bearing.inner_conformity, bearing.outer_conformity
    if inner > 0.52 or outer > 0.53:
        raise InputError(
            f"bearing: no dynamic rating is known for grooves of {inner:g} and {outer:g} ball diameters; "
            "ISO 281 goes to 0.52 inside and 0.53 outside. Give dynamic_rating."
        )
    g, diameter = bearing.curvature_ratio, 1e3 * bearing.ball_diameter
    h = 1.04 * ((1 - g) / (1 + g)) ** 1.72
    factor = 0.41 * 0.95 * 98.0665 * (1 + h ** (10 / 3)) ** -0.3 * g**0.3 * (1 - g) ** 1.39 / np.cbrt(1 + g) * 26**0.41
    size = min(diameter, 25.4) ** 0.4 * diameter**1.4
    return float(MATERIAL * factor * np.cos(bearing.contact_angle) ** 0.7 * bearing.balls ** (2 / 3) * size)
