"""Cosine and sine of one angle, or of many in lanes: one reduction and two polynomials, without a branch.

Cody and Waite's reduction by pi/2 in three parts, then the polynomials of least error on [-pi/4, pi/4] that FreeBSD's and Sun's libraries
have (Ng, 1985; coefficients recalled, checked against the mathematics library by the tests).  Errors are below 2e-16 up to `FAR`, where
the parts no longer suffice: from there on the library's functions are called.
"""

import numpy as np

from drivewright._jit import inner, per_lane
from drivewright.numerics.lanes import any_lane, where

FAR = 1e5  # [rad]: the product of the quarter turns with the first part of pi/2 is exact up to here
QUARTERS = 2.0 / np.pi
_ONE, _TWO, _THREE = 1.57079632673412561417e00, 6.07710050630396597660e-11, 2.02226624879595063154e-21  # pi/2 = their sum
_S = (
    -1.66666666666666324348e-01,
    8.33333333332248946124e-03,
    -1.98412698298579493134e-04,
    2.75573137070700676789e-06,
    -2.50507602534068634195e-08,
    1.58969099521155010221e-10,
)
_C = (
    4.16666666666666019037e-02,
    -1.38888888888741095749e-03,
    2.48015872894767294178e-05,
    -2.75573143513906633035e-07,
    2.08757232129817482790e-09,
    -1.13596475577881948265e-11,
)


@inner
def cos_sin(angle: float) -> tuple[float, float]:
    """(cos, sin) of an angle [rad]."""
    quarters = np.floor(angle * QUARTERS + 0.5)
    r = ((angle - quarters * _ONE) - quarters * _TWO) - quarters * _THREE
    z = r * r
    sine = r + r * z * (_S[0] + z * (_S[1] + z * (_S[2] + z * (_S[3] + z * (_S[4] + z * _S[5])))))
    cosine = 1.0 - (0.5 * z - z * z * (_C[0] + z * (_C[1] + z * (_C[2] + z * (_C[3] + z * (_C[4] + z * _C[5]))))))
    turn = quarters - 4.0 * np.floor(0.25 * quarters)
    is_odd = (turn == 1.0) | (turn == 3.0)
    c, s = where(is_odd, sine, cosine), where(is_odd, cosine, sine)
    c, s = where((turn == 1.0) | (turn == 2.0), -c, c), where(turn >= 2.0, -s, s)
    is_far = abs(angle) > FAR
    if any_lane(is_far):
        far_c, far_s = _far(angle)
        c, s = where(is_far, far_c, c), where(is_far, far_s, s)
    return c, s


@per_lane
def _far(angle):
    """`cos_sin` of any angle."""
    return np.cos(angle), np.sin(angle)
