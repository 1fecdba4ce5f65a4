"""Two congruent elliptic pairs in a row by algebra: no trigonometric function per point.

In half angles a pair is rational, tan(theta/2) = r tan(x/2), so cos(t/2) and sin(t/2) of a carrier angle give the planet's
direction e^{ip} and its first two derivatives by a dozen products.  `half` is e^{i bend/2}, r the slope of the pair at angle 0.
"""

import numpy as np

from drivewright._jit import kernel
from drivewright._typing import Floats


@kernel
def phase(half: complex, r: float) -> complex:
    """Direction e^{ip} of the planet, from the unit number e^{i x/2} of its input: tan(p/2) = r tan(x/2)."""
    c, d = half.real, r * half.imag
    return complex(c * c - d * d, 2 * c * d) / (c * c + d * d)


@kernel
def planet(t: float, half: complex, r: float) -> tuple[complex, float, float]:
    """(e^{ip}, p', p'') of the planet at the carrier angle t [rad], derivatives by t."""
    c, d = np.cos(t / 2), np.sin(t / 2)
    return planet_at(c, d, half, r)


@kernel
def planet_at(c: float, d: float, half: complex, r: float) -> tuple[complex, float, float]:
    """The same from cos(t/2), sin(t/2).  With (c, r d) turned by half the bend to (x, y): p' = r^2/Q, Q = x^2 + r^2 y^2."""
    x, y = half.real * c - half.imag * r * d, half.imag * c + half.real * r * d
    x1, y1 = 0.5 * (-half.real * d - half.imag * r * c), 0.5 * (-half.imag * d + half.real * r * c)
    q = x * x + r * r * y * y
    q1 = 2 * (x * x1 + r * r * y * y1)
    return complex(x * x - r * r * y * y, 2 * r * x * y) / q, r * r / q, -r * r * q1 / (q * q)


@kernel
def planet_rates(start: float, width: float, half: complex, r: float, first: Floats, second: Floats) -> None:
    """Fill first and second (n,) with p' [-] and p'' [1/rad] at n equidistant carrier angles from `start` over `width` [rad]."""
    n = first.shape[0]
    turn, place = np.exp(0.5j * (width / (n - 1))), np.exp(0.5j * start)
    for i in range(n):
        _, first[i], second[i] = planet_at(place.real, place.imag, half, r)
        place *= turn
