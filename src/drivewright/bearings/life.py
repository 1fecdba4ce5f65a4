"""Ratings and life of ball bearings, the inner ring turning.

ISO 281 (basic ratings, equivalent load), ISO/TS 16281 (reference life) and Lundberg & Palmgren 1947, all recalled.  The tests
compare the reference life with another program and the two lives with each other.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from drivewright._typing import Floats
from drivewright.bearings.solving import PERMISSIBLE, RollingBearing, basic_static_rating, contact_of, law_of
from drivewright.errors import InputError

if TYPE_CHECKING:
    from drivewright.bearings.ball import BallBearing

AXIAL_SHARE = 0.19  # least e of ISO 281: axial over radial force up to which P = Fr in every deep-groove bearing
REVOLUTIONS = 1e6  # to which ratings refer
MATERIAL = 1.3  # b_m, today's steel against that of 1947


def _capacity_ratio(bearing):
    """h: capacity of the inner race over the outer, 1.044 ((1 - g)/(1 + g))^1.72 (ri (2 re - Dw)/(re (2 ri - Dw)))^0.41."""
    g, inner, outer = bearing.curvature_ratio, bearing.inner_conformity, bearing.outer_conformity
    return 1.044 * ((1 - g) / (1 + g)) ** 1.72 * (inner * (2 * outer - 1) / (outer * (2 * inner - 1))) ** 0.41


def ball_reference_life(bearing: "BallBearing", loads: Floats) -> float | None:
    """L10r [revolutions] for the loads of the balls [N]; inf where all are 0, None without a dynamic rating.

    L = ((Qci/Qi)^(-10/3) + (Qce/Qe)^(-10/3))^(-9/10) 1e6,  Qi = (mean Q^3)^(1/3) on the turning inner ring,
    Qe = (mean Q^(10/3))^(3/10) on the standing outer one, Qc the capacity of each at the nominal contact angle.
    """
    if bearing.dynamic_rating is None:
        return None
    peak = np.max(loads)
    if peak == 0:
        return np.inf
    h = _capacity_ratio(bearing)
    share = bearing.dynamic_rating / (bearing.balls * np.cos(bearing.contact_angle) * peak)
    inner = share / 0.407 * (1 + h ** (10 / 3)) ** 0.3 / np.cbrt(np.mean((loads / peak) ** 3))
    outer = share / 0.389 * (1 + h ** (-10 / 3)) ** 0.3 / np.mean((loads / peak) ** (10 / 3)) ** 0.3
    return float(REVOLUTIONS * (inner ** (-10 / 3) + outer ** (-10 / 3)) ** -0.9)


def basic_dynamic_rating(bearing: "BallBearing") -> float:
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


def static_rating(bearing: RollingBearing) -> float:
    """C0 [N] as the bearing gives it, else by its inner geometry (`basic_static_rating`)."""
    return basic_static_rating(bearing) if bearing.static_rating is None else bearing.static_rating


def ball_static_rating(bearing: "BallBearing") -> float:
    """C0 [N]: the radial load F whose most loaded ball, Q = 5 F/(Z cos a), reaches 4200 MPa at one of its races."""
    law = law_of(bearing)
    ball = (PERMISSIBLE["point"][0] / max(law.inner_pressure, law.outer_pressure)) ** 3
    return float(ball * bearing.balls * np.cos(bearing.contact_angle) / 5)


def life_exponent(bearing: RollingBearing) -> float:
    """p of ISO 281: 3 of balls, 10/3 of rollers."""
    return 10 / 3 if contact_of(bearing) == "line" else 3


def basic_life(bearing: RollingBearing, load: float) -> float | None:
    """L10 [revolutions] of ISO 281: 1e6 (C/P)^p, p = 3 of balls and 10/3 of rollers; None without a dynamic rating.

    P [N] is the load itself where it is radial.  The factors X and Y for a combined load are not stated here: those recalled differ
    from the reference life of this geometry by up to 30 % of the load.  Take `BearingEquilibrium.reference_life` there.
    """
    if not load > 0:
        raise InputError(f"bearing: the life wants a load above 0 N, got {load:g}.")
    power = life_exponent(bearing)
    if bearing.dynamic_rating is None:
        return None
    return REVOLUTIONS * (bearing.dynamic_rating / load) ** power


def equivalent_radial_load(force: Sequence[float] | Floats, contact_angle: float = 0.0) -> float | None:
    """P [N] of ISO 281 under a force (Fx, Fy, Fz, ...) [N] where it is the radial force itself; None where X and Y would count.

    So it is without a contact angle and with |Fz| <= e Fr, e = 0.19 being the least of all deep-groove bearings.
    """
    radial, axial = float(np.hypot(force[0], force[1])), abs(force[2])
    return None if contact_angle or not radial > 0 or axial > AXIAL_SHARE * radial else radial


def life_duration(revolutions: float, speed: float) -> float:
    """Time [s] of so many revolutions at a speed [rad/s]."""
    return float(revolutions) * 2 * np.pi / speed
