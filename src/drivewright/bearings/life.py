"""Basic life of rolling bearings by ISO 281; `equivalent_loads` has the load that it takes, `modified_life` lubricant and reliability.

The reference life stands with each kind of bearing.
"""

import numpy as np

from drivewright.bearings.solving import RollingBearing, basic_static_rating, contact_of
from drivewright.errors import InputError

REVOLUTIONS = 1e6  # to which ratings refer


def static_rating(bearing: RollingBearing) -> float:
    """C0 [N] as the bearing gives it, else by its inner geometry (`basic_static_rating`)."""
    return basic_static_rating(bearing) if bearing.static_rating is None else bearing.static_rating


def life_exponent(bearing: RollingBearing) -> float:
    """p of ISO 281: 3 of balls, 10/3 of rollers."""
    return 10 / 3 if contact_of(bearing) == "line" else 3


def basic_life(bearing: RollingBearing, load: float) -> float | None:
    """L10 [revolutions] of ISO 281: 1e6 (C/P)^p, p = 3 of balls and 10/3 of rollers; None without a dynamic rating.

    P [N] is the radial load, or of a combined one its `equivalent_load`.
    """
    if not load > 0:
        raise InputError(f"bearing: the life needs a load above 0 N, got {load:g}.")
    power = life_exponent(bearing)
    if bearing.dynamic_rating is None:
        return None
    return REVOLUTIONS * (bearing.dynamic_rating / load) ** power


def life_duration(revolutions: float, speed: float) -> float:
    """Time [s] of so many revolutions at a speed [rad/s], whichever way it turns."""
    return float(revolutions) * 2 * np.pi / abs(speed)
