"""The basic dynamic rating of balls and rollers by their inner geometry: ISO 281 and Lundberg & Palmgren 1947.

The factors f_c are written as closed forms.  That of balls is recalled; that of rollers stands in two public transcriptions of
ISO 281.  Neither standard was opened: both forms give the printed ratings of a maker's catalogue (NSK, Rolling Bearings) within 1 %
where the inner geometry is known, for 130 ball and 50 cylindrical roller bearings.
"""

from functools import singledispatch

import numpy as np

from drivewright._typing import Floats, Numbers
from drivewright.bearings.ball import BallBearing
from drivewright.bearings.roller import RollerBearing
from drivewright.bearings.solving import law_of
from drivewright.errors import InputError

MATERIAL = 1.3  # b_m of balls, the standard's; makers rate steels and finishes of today some per cent higher
ROLLER_MATERIAL = 1.1  # b_m of cylindrical and tapered rollers, recalled
LARGE_BALL = 25.4  # mm, above which C grows with Dw^1.4 instead of Dw^1.8


@singledispatch
def basic_dynamic_rating(bearing: object) -> float:
    """C [N] of ISO 281 by the inner geometry: `ball_dynamic_rating` or `roller_dynamic_rating` of the bearing's numbers.

    Of balls the standard states it for grooves up to 0.52 Dw inside and 0.53 Dw outside.
    """
    law_of(bearing)  # its own message where this is no bearing at all
    raise InputError(f"bearing: no dynamic rating is known by the geometry of a {type(bearing).__name__}. Give dynamic_rating.")


@basic_dynamic_rating.register(BallBearing)
def _(bearing):
    inner, outer = bearing.inner_conformity, bearing.outer_conformity
    if inner > 0.52 or outer > 0.53:
        raise InputError(
            f"bearing: no dynamic rating is known for grooves of {inner:g} and {outer:g} ball diameters; "
            "ISO 281 goes to 0.52 inside and 0.53 outside. Give dynamic_rating."
        )
    return float(ball_dynamic_rating(bearing.balls, bearing.ball_diameter, bearing.pitch_diameter, bearing.contact_angle))


@basic_dynamic_rating.register(RollerBearing)
def _(bearing):
    size = bearing.roller_diameter, bearing.roller_length
    return float(roller_dynamic_rating(bearing.rollers, *size, bearing.pitch_diameter, bearing.contact_angle))


def ball_dynamic_rating(balls: Numbers, diameter: Numbers, pitch_diameter: Numbers, angle: float) -> Floats:
    """C [N] = b_m f_c (cos a)^0.7 Z^(2/3) Dw^1.8 in mm, above 25.4 mm with 3.647 Dw^1.4 instead, b_m = 1.3; diameters in [m].

    f_c = 38.2 (1 + h^(10/3))^(-3/10) g^0.3 (1 - g)^1.39/(1 + g)^(1/3) (2 f/(2 f - 1))^0.41 with g = Dw cos a/Dpw, f = 0.52 at both
    races and h = 1.04 ((1 - g)/(1 + g))^1.72.
    """
    g, size = diameter * np.cos(angle) / pitch_diameter, 1e3 * np.asarray(diameter)
    h = 1.04 * ((1 - g) / (1 + g)) ** 1.72
    factor = 0.41 * 0.95 * 98.0665 * (1 + h ** (10 / 3)) ** -0.3 * g**0.3 * (1 - g) ** 1.39 / np.cbrt(1 + g) * 26**0.41
    return MATERIAL * factor * np.cos(angle) ** 0.7 * balls ** (2 / 3) * np.minimum(size, LARGE_BALL) ** 0.4 * size**1.4


def roller_dynamic_rating(rollers: Numbers, diameter: Numbers, length: Numbers, pitch_diameter: Numbers, angle: float) -> Floats:
    """C [N] = b_m f_c (L cos a)^(7/9) Z^(3/4) Dw^(29/27) in mm, of one row, b_m = 1.1; diameters and effective length in [m].

    f_c = `roller_factor`(Dw cos a/Dpw).
    """
    g = diameter * np.cos(angle) / pitch_diameter
    loaded = (1e3 * np.asarray(length) * np.cos(angle)) ** (7 / 9) * np.asarray(rollers) ** 0.75
    return ROLLER_MATERIAL * roller_factor(g) * loaded * (1e3 * np.asarray(diameter)) ** (29 / 27)


def roller_factor(curvature_ratio: Numbers) -> Floats:
    """f_c of radial roller bearings, 551.13 * 0.377 * 0.83 g^(2/9) (1 - g)^(29/27)/(1 + g)^(1/4) (1 + h^(9/2))^(-2/9) (N, mm) with
    h = 1.04 ((1 - g)/(1 + g))^(143/108); the most, 88.8, at g = 0.18.  0.83 is the part of the load that edges and tilt leave."""
    g = np.asarray(curvature_ratio)
    h = 1.04 * ((1 - g) / (1 + g)) ** (143 / 108)
    return 551.13373 * 0.377 * 0.83 * g ** (2 / 9) * (1 - g) ** (29 / 27) / (1 + g) ** 0.25 * (1 + h**4.5) ** (-2 / 9)
