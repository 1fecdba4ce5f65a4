"""Mean and extremes of a quantity known by values and slopes at samples, compiled: a cubic between each two."""

import numpy as np

from drivewright._jit import kernel
from drivewright._typing import Floats


@kernel
def measure(x: Floats, y: Floats, before: Floats, after: Floats) -> tuple[float, float, float]:
    """Integral mean, least and greatest value of y(x); `before` and `after`: slopes on both sides of a sample, which differ at a kink.

    x, y (n,) in units of their own, before, after (n,) [y/x].

    The area under the cubic is h (y0 + y1)/2 + h^2 (s0 - s1)/12.
    """
    area, low, high = 0.0, y[0], y[0]
    for k in range(1, len(x)):
        h = x[k] - x[k - 1]
        start, end, rise = h * after[k - 1], h * before[k], y[k] - y[k - 1]
        area += h * (0.5 * rise + (start - end) / 12 + y[k - 1] - y[0])
        low, high = min(low, y[k]), max(high, y[k])
        bend, jerk = 3 * rise - 2 * start - end, start + end - 2 * rise
        root = bend * bend - 3 * jerk * start
        if root >= 0.0:
            q = -(bend + np.copysign(np.sqrt(root), bend))
            for part, whole in ((q, 3 * jerk), (start, q)):
                if part * whole > 0.0 and abs(part) < abs(whole):
                    t = part / whole
                    value = y[k - 1] + t * (start + t * (bend + t * jerk))
                    low, high = min(low, value), max(high, value)
    return y[0] + area / (x[-1] - x[0]), low, high
