"""A line contact of which a mesh sees only a load spread over a Gaussian strip: how far the strip comes nearer to a point in the depth.

A line load on a half-space in plane strain moves its surface at the distance x, against the point at the depth d under it, by

    u = 2 (1 - nu^2)/(pi E) [ln(d/|x|) - 1/(2 (1 - nu))],   |x| << d   (Flamant),  [m] for 1 N/m.

Everything here follows from its mean over the load, one body and a line load of 1 N/m each; any arrays that broadcast, SI.  The depth
must be large against the strip.  Source: Johnson, Contact Mechanics (1985), 2.2, 2.3 and 5.6, recalled; the tests integrate the strains
that the line load causes.
"""

import numpy as np

from drivewright._typing import Numbers


def gaussian_strip_approach(sigma: Numbers, depth: Numbers, modulus: Numbers, poisson: Numbers) -> Numbers:
    """How far a Gaussian strip comes nearer to a point at `depth` d under it, mean over the strip  [m^2/N]:

    2 (1 - nu^2)/(pi E) [ln(d/sigma) + gamma/2 - 1/(2 (1 - nu))],

    with E ln|X - Y| = ln sigma - gamma/2 of two normal variables of the standard deviation sigma [m]; d [m], E [Pa], gamma of Euler.
    """
    return _factor(modulus, poisson) * (np.log(depth / sigma) + np.euler_gamma / 2 - 1 / (2 * (1 - poisson)))


def hertz_beyond_strip(sigma: Numbers, half_width: Numbers, modulus: Numbers, poisson: Numbers) -> Numbers:
    """How much more a Hertz contact of half width b [m] comes nearer to the depth than a Gaussian strip does  [m^2/N], below 0 where less:

    2 (1 - nu^2)/(pi E) [ln(2 sigma/b) + 1/2 - gamma/2],

    the difference of Hertz's ln(2 d/b) - nu/(2 (1 - nu)) in these brackets and of `gaussian_strip_approach`; sigma [m], E [Pa].
    """
    return _factor(modulus, poisson) * (np.log(2 * sigma / half_width) + 0.5 - np.euler_gamma / 2)


def _factor(modulus: Numbers, poisson: Numbers) -> Numbers:
    """2 (1 - nu^2)/(pi E)  [1/Pa]."""
    return 2 * (1 - np.square(poisson)) / (np.pi * modulus)
