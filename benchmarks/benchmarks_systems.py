"""Systems that the benchmarks integrate; in a module of their own so that their kernels are cached."""

from typing import NamedTuple

from drivewright._jit import implements
from drivewright.numerics.ode import rate


class VanDerPol(NamedTuple):
    """y'' = mu (1 - y^2) y' - y."""

    mu: float


@implements(rate, VanDerPol)
def _(system, t, y, dy):
    dy[0] = y[1]
    dy[1] = system.mu * (1 - y[0] ** 2) * y[1] - y[0]


def rate_of(mu):
    """The same for SciPy."""
    return lambda t, y: (y[1], mu * (1 - y[0] ** 2) * y[1] - y[0])
