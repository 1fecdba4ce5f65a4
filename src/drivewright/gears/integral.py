"""Running integral of a smooth periodic function, at any argument and over many periods."""

from collections.abc import Callable
from functools import cached_property

import numpy as np

from drivewright._typing import ArrayLike, Floats

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(10)


class RunningIntegral:
    """F(x) = int_0^x f, for f of period 2 pi: Gauss's rule on fixed panels, and once more from the panel's edge to x.

    f maps an array to an array.  Exact to rounding when f is smooth on the scale of a panel, 2 pi / panels.
    """

    def __init__(self, f: Callable[[Floats], Floats], panels: int = 256) -> None:
        self.f, self.panels = f, panels

    @cached_property
    def edges(self) -> Floats:
        """F at the panel edges, the first 0, the last the integral over one period."""
        width = 2 * np.pi / self.panels
        start = width * np.arange(self.panels)
        return np.append(0.0, np.cumsum(self._between(start, start + width)))

    @property
    def total(self) -> float:
        """The integral over one period."""
        return float(self.edges[-1])

    def __call__(self, x: ArrayLike) -> Floats:
        x = np.asarray(x, dtype=float)
        turn, rest = np.divmod(x, 2 * np.pi)
        panel = np.clip((rest * self.panels / (2 * np.pi)).astype(int), 0, self.panels - 1)
        start = 2 * np.pi * panel / self.panels
        return turn * self.total + self.edges[panel] + self._between(start, rest)

    def _between(self, start, stop):
        half = 0.5 * (stop - start)[..., None]
        points = 0.5 * (stop + start)[..., None] + half * _NODES
        return np.sum(half * _WEIGHTS * self.f(points), axis=-1)

    def inverse(self, value: ArrayLike, steps: int = 60) -> Floats:
        """x with F(x) = value, for positive f: Newton's method kept inside the panel."""
        value = np.asarray(value, dtype=float)
        turn, rest = np.divmod(value, self.total)
        panel = np.clip(np.searchsorted(self.edges, rest, side="right") - 1, 0, self.panels - 1)
        low, high = 2 * np.pi * panel / self.panels, 2 * np.pi * (panel + 1) / self.panels
        share = (rest - self.edges[panel]) / (self.edges[panel + 1] - self.edges[panel])
        x = low + share * (high - low)
        for _ in range(steps):
            step = (rest - self.edges[panel] - self._between(low, x)) / self.f(x)
            x = np.clip(x + step, low, high)
            if np.all(np.abs(step) <= 1e-15 * 2 * np.pi):
                break
        return 2 * np.pi * turn + x
