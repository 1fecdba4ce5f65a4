"""A pair of non-circular gears from any ratio function."""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from drivewright._typing import ArrayLike
from drivewright.errors import InputError
from drivewright.gears.integral import RunningIntegral
from drivewright.gears.rolling import RollingPair, check_length
from drivewright.numerics.jets import Jet, compose, variable

_CLOSED = 1e-9  # relative error of the mean ratio below which the pitch curve counts as closed
_LARGEST = 12  # largest number of lobes looked for
_PROBES = np.linspace(0.0, 2 * np.pi, 97)


@dataclass(frozen=True)
class NonCircularPair(RollingPair):
    """Gears with d driven / d angle = ratio(angle) at the given centre distance [m].

    ratio maps the driver angle, as a jet, to the ratio as a jet: write it with `numerics.jets`, e.g. 1 + 0.2 * cos(2 * x).
    It must be positive, have period 2 pi, and its mean must be a fraction n/m for which it repeats n times per turn: then the
    driven gear's pitch curve closes after m repeats.  Raises InputError telling by how much it does not.
    """

    ratio_function: Callable[[Jet], Jet | float]
    centre_distance: float

    def __post_init__(self):
        check_length("centre_distance", self.centre_distance)
        probes = self.ratio_jet(_PROBES).d0
        if not np.all(np.isfinite(probes)) or np.min(probes) <= 0:
            worst = int(np.argmin(np.where(np.isfinite(probes), probes, -np.inf)))
            raise InputError(
                f"NonCircularPair: ratio = {probes[worst]:.4g} at driver angle {np.rad2deg(_PROBES[worst]):.4g}°; gears that keep "
                "rolling need a positive ratio everywhere. Raise its mean or reduce its swing."
            )
        self._refuse_no_period(1)
        self._refuse_open()

    def _refuse_no_period(self, repeats):
        miss = np.abs(self.ratio_jet(_PROBES + 2 * np.pi / repeats).d0 - self.ratio_jet(_PROBES).d0)
        if np.max(miss) > _CLOSED * np.max(self.ratio_jet(_PROBES).d0):
            raise InputError(
                f"NonCircularPair: the ratio does not repeat after {360 / repeats:.5g}° of the driver: it differs by {np.max(miss):.3g} "
                f"at {np.rad2deg(_PROBES[np.argmax(miss)]):.4g}°. A mean ratio of {self.lobes[0]}/{self.lobes[1]} needs that period."
            )

    def _refuse_open(self):
        n, m = self.lobes
        mean = self._integral.total / (2 * np.pi)
        if abs(mean - n / m) > _CLOSED * mean:
            raise InputError(
                f"NonCircularPair: the mean ratio is {mean:.9g}; the nearest fraction with up to {_LARGEST} lobes is {n}/{m}, so after {m} "
                f"repeats the driven pitch curve fails to close by {np.rad2deg(2 * np.pi * (m * mean / n - 1)):.4g}°. "
                f"Multiply the ratio by {n / m / mean:.9g}."
            )
        self._refuse_no_period(n)

    def ratio_jet(self, angle: ArrayLike) -> Jet:
        """The ratio as a jet of the driver angle, an array."""
        value = self.ratio_function(variable(np.asarray(angle, dtype=float)))
        return value if isinstance(value, Jet) else variable(angle) * 0.0 + value

    @cached_property
    def _integral(self):
        return RunningIntegral(lambda angle: self.ratio_jet(angle).d0)

    @cached_property
    def lobes(self) -> tuple[int, int]:  # pyright: ignore[reportIncompatibleVariableOverride]  read only, as everywhere
        """(n, m) with mean ratio n/m in lowest terms."""
        nearest = Fraction(self._integral.total / (2 * np.pi)).limit_denominator(_LARGEST)
        return nearest.numerator, nearest.denominator

    def jet(self, angle: ArrayLike | Jet) -> Jet:
        """Driven angle [rad] as a jet; `angle` is an array or a jet."""
        x = np.asarray(angle.d0 if isinstance(angle, Jet) else angle, dtype=float)
        ratio = self.ratio_jet(x)
        outer = Jet(self._integral(x), ratio.d0, ratio.d1, ratio.d2)
        return compose(outer, angle) if isinstance(angle, Jet) else outer
