"""Equivalent load of a bearing under radial and axial force: dynamic, P = X Fr + Y Fa of ISO 281, and static, P0 = X0 Fr + Y0 Fa of ISO 76.

The factors of balls are those of the Koyo catalogue's page "Calculation of equivalent load" (deep groove; contact angles of 15, 30 and
40 deg) and, for the other angles, of public transcriptions of ISO 281, table 3, and ISO 76, whose values at the shared angles are the
same.  Between the rows they are interpolated linearly, beyond them the last row holds, as the standard has it.  They hold for a bearing
without clearance and for its balls' usual grooves; the reference life of a `BearingEquilibrium` knows its own clearance and grooves.
"""

from collections.abc import Sequence
from functools import singledispatch
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.bearings.ball import BallBearing
from drivewright.bearings.roller import RollerBearing
from drivewright.bearings.solving import RollingBearing

CATALOGUE = "ISO 281, table 3, as catalogues print it"
# Fa/(Z Dw^2) [N/mm^2] of the rows; below 20 deg e and Y depend on it
RELATIVE_LOADS = (0.172, 0.345, 0.689, 1.03, 1.38, 2.07, 3.45, 5.17, 6.89)
# contact angle [deg]: X, Y and e by row; up to 5 deg a bearing counts as deep groove
SMALL_ANGLES = {
    0.0: (0.56, (2.30, 1.99, 1.71, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00), (0.19, 0.22, 0.26, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44)),
    5.0: (0.56, (2.30, 1.99, 1.71, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00), (0.19, 0.22, 0.26, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44)),
    10.0: (0.46, (1.88, 1.71, 1.52, 1.41, 1.34, 1.23, 1.10, 1.01, 1.00), (0.29, 0.32, 0.36, 0.38, 0.40, 0.44, 0.49, 0.54, 0.54)),
    15.0: (0.44, (1.47, 1.40, 1.30, 1.23, 1.19, 1.12, 1.02, 1.00, 1.00), (0.38, 0.40, 0.43, 0.46, 0.47, 0.50, 0.55, 0.56, 0.56)),
}
# contact angle [deg]: X, Y, e
LARGE_ANGLES = {
    20.0: (0.43, 1.00, 0.57),
    25.0: (0.41, 0.87, 0.68),
    30.0: (0.39, 0.76, 0.80),
    35.0: (0.37, 0.66, 0.95),
    40.0: (0.35, 0.57, 1.14),
    45.0: (0.33, 0.50, 1.34),
}
STEEPEST = np.radians(45.0) * (1 + 1e-9)  # beyond it ISO 281 counts a bearing as a thrust bearing
# contact angle [deg], X0, Y0 of balls
STATIC_ANGLES = (0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0)
STATIC_RADIAL = (0.6, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5)
STATIC_AXIAL = (0.5, 0.52, 0.50, 0.46, 0.42, 0.38, 0.33, 0.29, 0.26, 0.22)


class LoadFactors(NamedTuple):
    """X and Y of an axial force beyond e Fr, and the e; 1, 0 and infinity where only a radial force counts [-]."""

    X: float
    Y: float
    e: float


class EquivalentLoad(NamedTuple):
    """P or P0 [N]; the X and Y that made it, 1 and 0 where the radial force alone counts; e, of P0 nan; where the factors come from."""

    load: float
    X: float
    Y: float
    e: float
    source: str


@singledispatch
def load_factors(bearing: object, axial: float) -> LoadFactors | None:
    """X, Y, e of a bearing under an axial force [N] without its sign; None where ISO 281 has none for it."""
    return None


@load_factors.register
def _(bearing: BallBearing, axial: float) -> LoadFactors | None:
    return ball_load_factors(bearing.contact_angle, axial / (bearing.balls * (1e3 * bearing.ball_diameter) ** 2))


@load_factors.register
def _(bearing: RollerBearing, axial: float) -> LoadFactors | None:
    """Without a contact angle a roller bearing is taken to carry no axial force: what its ribs carry by sliding is no fatigue load."""
    if bearing.contact_angle > STEEPEST:
        return None
    if not bearing.contact_angle:
        return LoadFactors(1.0, 0.0, np.inf)
    slope = float(np.tan(bearing.contact_angle))
    return LoadFactors(0.4, 0.4 / slope, 1.5 * slope)


def ball_load_factors(contact_angle: float, relative_load: float) -> LoadFactors | None:
    """X, Y, e of ISO 281 for a single row of balls: contact angle [rad], Fa/(Z Dw^2) [N/mm^2]; None beyond 45 deg."""
    if contact_angle > STEEPEST:
        return None
    small = [
        (x, np.interp(relative_load, RELATIVE_LOADS, y), np.interp(relative_load, RELATIVE_LOADS, e)) for x, y, e in SMALL_ANGLES.values()
    ]
    rows = np.array([*small, *LARGE_ANGLES.values()])
    angles = [*SMALL_ANGLES, *LARGE_ANGLES]
    return LoadFactors(*(float(np.interp(np.degrees(contact_angle), angles, column)) for column in rows.T))


def equivalent_load(bearing: RollingBearing, force: Sequence[float] | Floats) -> EquivalentLoad | None:
    """P [N] of ISO 281 under a force (Fx, Fy, Fz, ...) [N]: the larger of Fr and X Fr + Y |Fz|; None where the standard has no factors.

    The standard takes Fr up to |Fz| = e Fr and the other beyond; X + Y e is 1 but for the rounding of the table, so that the larger of
    the two is the same within 0.5 % and does not jump.
    """
    radial, axial = _parts(force)
    factors = load_factors(bearing, axial)
    if factors is None:
        return None
    load = factors.X * radial + factors.Y * axial
    x, y, load = (factors.X, factors.Y, load) if load > radial else (1.0, 0.0, radial)
    return EquivalentLoad(load, x, y, factors.e, CATALOGUE)


@singledispatch
def static_load_factors(bearing: object) -> tuple[float, float] | None:
    """(X0, Y0) of ISO 76; None where it has none for a bearing."""
    return None


@static_load_factors.register
def _(bearing: BallBearing) -> tuple[float, float] | None:
    if bearing.contact_angle > STEEPEST:
        return None
    angle = np.degrees(bearing.contact_angle)
    return float(np.interp(angle, STATIC_ANGLES, STATIC_RADIAL)), float(np.interp(angle, STATIC_ANGLES, STATIC_AXIAL))


@static_load_factors.register
def _(bearing: RollerBearing) -> tuple[float, float] | None:
    if bearing.contact_angle > STEEPEST:
        return None
    return (0.5, 0.22 / float(np.tan(bearing.contact_angle))) if bearing.contact_angle else (1.0, 0.0)


def equivalent_static_load(bearing: RollingBearing, force: Sequence[float] | Floats) -> EquivalentLoad | None:
    """P0 [N] of ISO 76 under a force (Fx, Fy, Fz, ...) [N]: the larger of Fr and X0 Fr + Y0 |Fz|."""
    radial, axial = _parts(force)
    factors = static_load_factors(bearing)
    if factors is None:
        return None
    load = factors[0] * radial + factors[1] * axial
    x, y, load = (*factors, load) if load > radial else (1.0, 0.0, radial)
    return EquivalentLoad(load, x, y, np.nan, "ISO 76, as catalogues print it")


def _parts(force):
    """(radial, axial) force [N], both without sign."""
    return float(np.hypot(force[0], force[1])), abs(float(force[2]))
