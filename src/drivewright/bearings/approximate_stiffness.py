"""Radial stiffness of a rolling bearing from a few catalogue numbers: power laws without clearance, preload, tilt or coupling.

All of them rest on Palmgren's approach of the fullest rolling element, which carries 5 F/(Z cos a): the load goes with the 3/2 power
(ball) or the 10/9 power (roller) of the approach.  A power law has two stiffnesses: the tangent dF/dd, for small changes about a
load, and the secant F/d, for the deflection under it; a linear spring from 0 needs the secant.
"""

from typing import Literal, NamedTuple

import numpy as np

from drivewright._typing import Numbers
from drivewright.errors import InputError

INCH, POUND = 0.0254, 4.4482216152605
BALL, ROLLER = 2 / 3, 9 / 10  # secant over tangent: one over the exponent of the load in the approach
FULLEST_SHARE = 5.0  # load of the fullest element over F/(Z cos a), for usual clearance


class RadialStiffness(NamedTuple):
    """A radial stiffness [N/m] at a load: `value` as the source gives it, and its `kind`; `ratio` = secant over tangent."""

    value: Numbers
    kind: Literal["tangent", "secant"]
    ratio: float
    source: str

    @property
    def tangent(self) -> Numbers:
        """dF/dd at the load [N/m]."""
        return self.value if self.kind == "tangent" else self.value / self.ratio

    @property
    def secant(self) -> Numbers:
        """F/d at the load [N/m]."""
        return self.value if self.kind == "secant" else self.value * self.ratio


def kraemer_ball(force: Numbers, balls: int, ball_diameter: float, contact_angle: float = 0.0) -> RadialStiffness:
    """k = 13e6 (Z^2 F D cos^5 a)^(1/3)  [N/m; N, m].  Some 10 % above the others: the same law with another constant."""
    _check(force, balls, ball_diameter, contact_angle)
    value = 13e6 * np.cbrt(balls**2 * force * ball_diameter * np.cos(contact_angle) ** 5)
    return RadialStiffness(value, "tangent", BALL, _KRAEMER)


def kraemer_roller(force: Numbers, rollers: int, roller_length: float, contact_angle: float = 0.0) -> RadialStiffness:
    """k = 1.0e9 Z^0.9 l^0.8 F^0.1 cos^1.9 a  [N/m; N, m]."""
    _check(force, rollers, roller_length, contact_angle)
    value = 1.0e9 * rollers**0.9 * roller_length**0.8 * force**0.1 * np.cos(contact_angle) ** 1.9
    return RadialStiffness(value, "tangent", ROLLER, _KRAEMER)


def gargiulo_ball(force: Numbers, balls: int, ball_diameter: float, contact_angle: float = 0.0) -> RadialStiffness:
    """k = 0.0325e6 (D F Z^2 cos^5 a)^(1/3)  [lbf/in; lbf, in], here in SI."""
    _check(force, balls, ball_diameter, contact_angle)
    value = 0.0325e6 * np.cbrt(ball_diameter / INCH * force / POUND * balls**2 * np.cos(contact_angle) ** 5)
    return RadialStiffness(value * POUND / INCH, "tangent", BALL, _GARGIULO)


def gargiulo_roller(force: Numbers, rollers: int, roller_length: float, contact_angle: float = 0.0) -> RadialStiffness:
    """k = 0.300e6 F^0.1 Z^0.9 l^0.8 cos^1.9 a  [lbf/in; lbf, in], here in SI; for cylindrical and tapered rollers."""
    _check(force, rollers, roller_length, contact_angle)
    value = 0.300e6 * (force / POUND) ** 0.1 * rollers**0.9 * (roller_length / INCH) ** 0.8 * np.cos(contact_angle) ** 1.9
    return RadialStiffness(value * POUND / INCH, "tangent", ROLLER, _GARGIULO)


def palmgren_ball(force: Numbers, balls: int, ball_diameter: float, contact_angle: float = 0.0) -> RadialStiffness:
    """F/d of d = 4.4e-4/cos a (Q^2/D)^(1/3) mm, Q = 5 F/(Z cos a)  [N, mm]."""
    _check(force, balls, ball_diameter, contact_angle)
    fullest = FULLEST_SHARE * force / (balls * np.cos(contact_angle))
    approach = 4.4e-4 / np.cos(contact_angle) * np.cbrt(fullest**2 / (1e3 * ball_diameter)) * 1e-3
    return RadialStiffness(force / approach, "secant", BALL, _PALMGREN)


def palmgren_roller(force: Numbers, rollers: int, roller_length: float, contact_angle: float = 0.0) -> RadialStiffness:
    """F/d of d = 7.7e-5/cos a Q^0.9/l^0.8 mm, Q = 5 F/(Z cos a)  [N, mm]."""
    _check(force, rollers, roller_length, contact_angle)
    fullest = FULLEST_SHARE * force / (rollers * np.cos(contact_angle))
    approach = 7.7e-5 / np.cos(contact_angle) * fullest**0.9 / (1e3 * roller_length) ** 0.8 * 1e-3
    return RadialStiffness(force / approach, "secant", ROLLER, _PALMGREN)


def liu_ball(force: Numbers, balls: int, ball_diameter: float, contact_angle: float = 0.0) -> RadialStiffness:
    """ky = 0.118e4 (d1 R Z^2 cos^5 b)^(1/3)  [N/mm; N, mm], here in SI: Liu et al. 2017, eq. (6)."""
    _check(force, balls, ball_diameter, contact_angle)
    value = 0.118e4 * np.cbrt(1e3 * ball_diameter * force * balls**2 * np.cos(contact_angle) ** 5)
    return RadialStiffness(1e3 * value, "tangent", BALL, _LIU)


def liu_roller(force: Numbers, rollers: int, roller_length: float, contact_angle: float = 0.0) -> RadialStiffness:
    """kx = 0.340e4 R^0.1 Z^0.9 L^0.8 cos^1.9 g  [N/mm; N, mm], here in SI: Liu et al. 2017, eq. (5)."""
    _check(force, rollers, roller_length, contact_angle)
    value = 0.340e4 * force**0.1 * rollers**0.9 * (1e3 * roller_length) ** 0.8 * np.cos(contact_angle) ** 1.9
    return RadialStiffness(1e3 * value, "tangent", ROLLER, _LIU)


def _check(force, count, size, contact_angle):
    """Refuse what the formulas have no meaning for; arrays allowed."""
    for name, value, unit in (("force", force, " N"), ("number of rolling elements", count, ""), ("size of a rolling element", size, " m")):
        if not np.all(np.asarray(value) > 0):
            raise InputError(f"bearing: the {name} must be above 0, got {np.min(value):g}{unit}. Without load there is no stiffness.")
    if not np.all(np.abs(contact_angle) < np.pi / 2):
        worst = np.degrees(np.max(np.abs(contact_angle)))
        raise InputError(
            f"bearing: the contact angle must lie below 90°, got {worst:g}° (the formulas take radians); "
            "a thrust bearing has no radial stiffness."
        )


_KRAEMER = "E. Kraemer, Dynamics of Rotors and Foundations (1993), recalled"
_GARGIULO = "E. P. Gargiulo, A simple way to estimate bearing stiffness, Machine Design (1980), recalled"
_PALMGREN = "A. Palmgren's approaches as in makers' catalogues (NSK), recalled"
_LIU = (
    "Liu Mingtao et al., factors influencing the torsional stiffness of inner parallel indexing cam mechanism, 2017, "
    "doi:10.13364/j.issn.1672-6510.20160015, eq. (5) and (6); read"
)
