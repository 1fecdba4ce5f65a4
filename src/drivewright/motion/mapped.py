"""A programme that is stated in one coordinate and followed in another: the lift of a valve, and the swing of the rocker that drives it."""

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from drivewright._typing import Floats, Ints, Numbers
from drivewright.motion.piecewise import Motion, Peaks, Piecewise
from drivewright.motion.programme import Programme
from drivewright.numerics.jets import Jet


class CoordinateMap(Protocol):
    """An increasing smooth function of one coordinate and its slope, both of jets."""

    def value(self, stated: Jet) -> Jet:
        """The other coordinate, a jet of the same variable."""
        ...

    def slope(self, stated: Jet) -> Jet:
        """Its derivative by the stated coordinate, a jet of the same variable."""
        ...


@dataclass(frozen=True)
class Composed:
    """One `CoordinateMap` after another."""

    first: CoordinateMap
    second: CoordinateMap

    def value(self, stated: Jet) -> Jet:
        """second(first(stated))."""
        return self.second.value(self.first.value(stated))

    def slope(self, stated: Jet) -> Jet:
        """Its derivative, by the chain rule."""
        return self.second.slope(self.first.value(stated)) * self.first.slope(stated)


@dataclass(frozen=True, eq=False)
class MappedPiecewise(Piecewise):
    """y(x) = f(s(x)) of a `Piecewise` s, with derivatives by the chain rule; jumps stand where s has them.

    `poly`, `amplitude` and `frequency` are those of s.
    """

    outer: CoordinateMap | None = None

    @classmethod
    def through(cls, stated: Piecewise, outer: CoordinateMap) -> "MappedPiecewise":
        """f(s) of a function s, which may be mapped itself."""
        if isinstance(stated, MappedPiecewise):
            assert stated.outer is not None
            outer = Composed(stated.outer, outer)
        return cls(stated.breaks, stated.poly, stated.amplitude, stated.frequency, stated.closed, outer)

    @cached_property
    def stated(self) -> Piecewise:
        """The function s itself."""
        return Piecewise(self.breaks, self.poly, self.amplitude, self.frequency, self.closed)

    @cached_property
    def _slope(self):
        return self.stated.derivative()

    def on_piece(self, k: int | Ints, x: Numbers) -> Motion:
        """Motion at x by the formula of piece k, an index or an array of them."""
        assert self.outer is not None
        y = self.outer.value(Jet(*(np.asarray(part) for part in self.stated.on_piece(k, x))))
        return Motion(*y) if np.ndim(y.d0) else Motion(*map(float, y))  # pyright: ignore[reportArgumentType]  floats of a float

    def rates(self, k: int | Ints, x: Numbers) -> Jet:
        """(y', y'', y''', y'''') at x by the formula of piece k: y' = f'(s) s' as a jet."""
        assert self.outer is not None
        stated, slope = (Jet(*(np.asarray(part) for part in function.on_piece(k, x))) for function in (self.stated, self._slope))
        return self.outer.slope(stated) * slope

    def derivative(self, order: int = 1) -> "Piecewise":
        """A derivative is no `Piecewise` of the same kind; `rates` has it."""
        raise NotImplementedError("the derivatives of a mapped motion are in `rates`")

    def jumps(self, order: int) -> Floats:
        """Right minus left value of the derivative of an order <= 3 at every break; 0.0 where neither s nor a lower derivative jumps."""
        pieces = np.arange(self.count)
        left, right = (self.on_piece(pieces, ends)[order] for ends in (self.breaks[:-1], self.breaks[1:]))
        outer = (right[-1], left[0]) if self.closed else (left[0], right[-1]) if order == 0 else (0.0, 0.0)
        stands = np.any([self.stated.jumps(lower) != 0 for lower in range(order + 1)], axis=0)
        return np.where(stands, np.append(left, outer[1]) - np.insert(right, 0, outer[0]), 0.0)

    def _relative_jump(self, order):
        peak = max(map(abs, self.extremes(lambda k, x: tuple(self.rates(k, x))[order - 1 : order + 1])))
        return float(np.max(np.abs(self.jumps(order)))) / peak if peak else 0.0

    @cached_property
    def continuity(self) -> int:
        """Order of the highest derivative that nowhere jumps: that of s, as f is smooth."""
        return self.stated.continuity

    @cached_property
    def _peaks(self) -> Peaks:
        v, a, j = (self._peak(lambda rates, n=n: (rates[n], rates[n + 1])) for n in range(3))
        power = self._peak(lambda r: (r[0] * r[1], r[1] ** 2 + r[0] * r[2]))
        if self.continuity == 0:
            a = power = np.inf
        return Peaks(v, a, j if self.continuity > 1 else np.inf, power)

    def _peak(self, value_and_slope):
        return float(np.max(np.abs(self.extremes(lambda k, x: value_and_slope(tuple(self.rates(k, x)))))))


@dataclass(frozen=True, eq=False)
class MappedProgramme(Programme):
    """A `Programme` whose segments state one coordinate, and which moves another: called with theta it gives the other one."""

    outer: CoordinateMap | None = None

    @cached_property
    def _followed(self) -> MappedPiecewise:
        assert self.outer is not None
        return MappedPiecewise.through(self.stated, self.outer)

    @property
    def function(self) -> Piecewise:
        """The whole cycle of the other coordinate."""
        return self._followed
