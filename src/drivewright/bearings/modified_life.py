"""Modified life of ISO 281, L_nm = a1 a_ISO L10: reliability, lubricant film and contamination against the fatigue limit.

Numbers after public transcriptions of ISO 281:2007 (equations 27 to 36 and annex B.3.3) that agree with each other.  The formulas of
a_ISO meet at kappa = 0.4 and 1 within 0.1 %, and give 0.1 at kappa = 0.1 whatever the load, within 0.3 %.
"""

import numpy as np

from drivewright.bearings.life import REVOLUTIONS
from drivewright.errors import InputError

RATED = 0.9  # reliability of L10
LEAST_LIFE = 0.05  # of L10, that every bearing reaches: Weibull's third parameter, ISO/TR 1281-2
SLOPE = 1.5  # Weibull's slope at high reliability, there
# by contact: constant, exponent of the bracket, exponent of the load ratio, exponent of the whole; (constant, exponent) of kappa by range
FACTORS = {
    "point": (2.5671, 0.83, 1 / 3, -9.3, ((2.2649, 0.054381), (1.9987, 0.19087), (1.9987, 0.071739))),
    "line": (1.5859, 1.0, 0.4, -9.185, ((1.3993, 0.054381), (1.2348, 0.19087), (1.2348, 0.071739))),
}
RANGES = (0.4, 1.0)  # of kappa, where the formulas change
THINNEST, THICKEST = 0.1, 4.0  # kappa between which ISO 281 gives a_ISO
LONGEST = 50.0  # a_ISO at most
FATIGUE_SHARE = {"point": (22.0, 0.5), "line": (8.2, 0.3)}  # C0/Cu up to a pitch diameter of 100 mm, and the exponent beyond
LARGE = 0.1  # m


def reliability_factor(reliability: float) -> float:
    """a1 [-] of ISO 281: c + (1 - c) (ln(1/S)/ln(1/0.9))^(2/3), c = 0.05, the formula behind the table of the standard (ISO/TR 1281-2,
    recalled); it gives the printed 1, 0.64, 0.55, 0.47, 0.37, 0.25 at 90, 95, 96, 97, 98, 99 % and 0.077 at 99.95 %."""
    if not RATED <= reliability < 1:
        raise InputError(f"bearing: the reliability of a modified life lies between 0.9 and 1, got {reliability:g}.")
    return float(LEAST_LIFE + (1 - LEAST_LIFE) * (np.log(reliability) / np.log(RATED)) ** (1 / SLOPE))


def reference_viscosity(speed: float, pitch_diameter: float) -> float:
    """nu1 [m^2/s] that separates the surfaces: speed [rad/s], without its sign, pitch diameter [m].

    4500 n^-0.5 Dpw^-0.5 mm^2/s with n in rpm and Dpw in mm, below 1000 rpm 45000 n^-0.83 Dpw^-0.5: at 1000 rpm 2.3 % more.
    """
    rpm, diameter = abs(speed) * 30 / np.pi, 1e3 * pitch_diameter
    if not rpm > 0:
        raise InputError("bearing: at rest no lubricant film forms, and no viscosity is sufficient; the modified life needs a speed.")
    return float(1e-6 * (45000 * rpm**-0.83 if rpm < 1000 else 4500 * rpm**-0.5) * diameter**-0.5)


def fatigue_limit_load(static_rating: float, pitch_diameter: float, contact: str) -> float:
    """Cu [N] of ISO 281 by the simple way: C0/22 of balls ("point"), C0/8.2 of rollers ("line"), above Dpw = 100 mm times
    (100 mm/Dpw)^0.5 and ^0.3.

    C0 [N], Dpw [m].  The exponent of rollers is recalled.
    """
    share, power = FATIGUE_SHARE[contact]
    return static_rating / share * min(1.0, LARGE / pitch_diameter) ** power


def life_modification_factor(viscosity_ratio: float, load_ratio: float, contact: str) -> float:
    """a_ISO [-] for kappa = nu/nu1 and e_C Cu/P, balls ("point") or rollers ("line"); at most 50.

    Balls 0.1 (1 - (2.5671 - c/kappa^m)^0.83 (e_C Cu/P)^(1/3))^-9.3, rollers 0.1 (1 - (1.5859 - c/kappa^m) (e_C Cu/P)^0.4)^-9.185.
    kappa counts up to 4; below 0.1, where the standard says nothing, it is 0.1 as at 0.1 itself.
    """
    kappa = min(max(viscosity_ratio, THINNEST), THICKEST)
    constant, power, load_power, whole, ranges = FACTORS[contact]
    factor, exponent = ranges[int(np.searchsorted(RANGES, kappa, side="right"))]
    bracket = 1 - max(constant - factor / kappa**exponent, 0.0) ** power * load_ratio**load_power
    return float(min(0.1 * bracket**whole, LONGEST)) if bracket > 0 else LONGEST


def reference_load(dynamic_rating: float, life: float, exponent: float) -> float:
    """P_ref [N] that gives a life [revolutions] by L = 1e6 (C/P)^p."""
    return float(dynamic_rating / (life / REVOLUTIONS) ** (1 / exponent))
