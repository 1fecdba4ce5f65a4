"""The polynomial over a step, from its five coefficients r0 .. r4: with p = 1 - theta, r0 + theta (r1 + p (r2 + theta (r3 + p r4))).

r0 is the start, r1 the rise, r2 and r3 bring the slopes at both ends, r4 the fourth degree (form of DOPRI5; Hairer, Norsett & Wanner).
"""

from drivewright._jit import inner
from drivewright._typing import Floats


def polynomial(dense: Floats, theta: Floats | float) -> Floats:
    """State at the fraction theta of a step, from the coefficients (5, ...)."""
    r0, r1, r2, r3, r4 = dense
    return r0 + theta * (r1 + (1 - theta) * (r2 + theta * (r3 + (1 - theta) * r4)))


@inner
def component(dense: Floats, i: int, theta: float) -> float:
    """`polynomial` of component i alone, from the coefficients (5, n)."""
    return dense[0, i] + theta * (dense[1, i] + (1 - theta) * (dense[2, i] + theta * (dense[3, i] + (1 - theta) * dense[4, i])))


@inner
def hermite(h: float, y: Floats, trial: Floats, f: Floats, f_end: Floats, dense: Floats) -> None:
    """Coefficients (5, n) of the cubic through both ends y and `trial` (n,) with the slopes f and f_end (n,)."""
    for i in range(y.size):
        rise = trial[i] - y[i]
        dense[0, i] = y[i]
        dense[1, i] = rise
        dense[2, i] = h * f[i] - rise
        dense[3, i] = rise - h * f_end[i] - dense[2, i]
        dense[4, i] = 0.0
