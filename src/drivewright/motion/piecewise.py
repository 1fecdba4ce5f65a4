"""One representation for every motion: pieces of polynomial plus harmonics.

On piece k, with t measured from the middle of the piece,

    s(x) = sum_m poly[k, m] t^m + Re sum_h amplitude[k, h] exp(i frequency[k, h] t)

so that values, derivatives of any order, jumps at the breaks and peaks come from one place, whatever the law is called.
(From the middle, because powers of a coordinate that starts at one end cancel badly at the other.)
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Complexes, Floats, Ints, Numbers
from drivewright.errors import InputError
from drivewright.numerics.roots import bracketed_roots

HIGHEST_ORDER = 6  # higher orders of continuity are not distinguished
CLOSURE = 1e-9  # difference of two numbers that are meant to be the same, as part of their size
SLACK = 1e-12  # an argument this far outside, relative to the whole interval, is rounding and is moved to the end


class Motion(NamedTuple):
    """Position and its first three derivatives; floats or arrays of one shape."""

    s: Floats  # floats, where the argument is one
    v: Floats
    a: Floats
    j: Floats


class Peaks(NamedTuple):
    """Largest |v|, |a|, |j| and |a v|; inf where a jump makes the derivative infinite."""

    Vm: float
    Am: float
    Jm: float
    AVm: float


@dataclass(frozen=True, eq=False)
class Piecewise:
    """Pieces of polynomial plus harmonics between `breaks`; called with x, it gives the `Motion` there.

    breaks (n+1,) increasing; poly (n, degree+1) by ascending powers; amplitude (n, h) complex; frequency (n, h) real.
    `closed`: the end meets the start again; otherwise everything stands still before and after.
    """

    breaks: Floats
    poly: Floats
    amplitude: Complexes
    frequency: Floats
    closed: bool = False

    @property
    def count(self) -> int:
        """Number of pieces."""
        return len(self.poly)

    @cached_property
    def middle(self) -> Floats:
        """Middle of each piece, where its t is zero."""
        return 0.5 * (self.breaks[:-1] + self.breaks[1:])

    def __call__(self, x: ArrayLike) -> Motion:
        x = np.asarray(x, dtype=float)
        # At a break the piece to its right is evaluated.
        return self.on_piece(np.clip(np.searchsorted(self.breaks, x, side="right") - 1, 0, self.count - 1), x)

    def on_piece(self, k: int | Ints, x: Numbers) -> Motion:
        """Motion at x by the formula of piece k, an index or an array of them."""
        t = x - self.middle[k]
        s = v = a = j = np.zeros_like(t)
        # Horner's scheme for the value and, in the same pass, for derivative/order! of orders 1 to 3.
        for column in self.poly.T[::-1]:
            j, a, v, s = j * t + a, a * t + v, v * t + s, s * t + column[k]
        a, j = 2 * a, 6 * j
        for size, frequency in zip(self.amplitude.T, self.frequency.T, strict=True):
            w = frequency[k]
            wave = size[k] * np.exp(1j * w * t)
            s, v, a, j = s + wave.real, v - w * wave.imag, a - w**2 * wave.real, j + w**3 * wave.imag
        return Motion(s, v, a, j) if np.ndim(t) else Motion(*map(float, (s, v, a, j)))  # pyright: ignore[reportArgumentType]  floats of a float

    def derivative(self, order: int = 1) -> "Piecewise":
        """The derivative of an order, in the same representation."""
        function = self
        for _ in range(order):
            powers = np.arange(1, function.poly.shape[1])
            poly = function.poly[:, 1:] * powers if len(powers) else np.zeros_like(function.poly)
            amplitude = 1j * function.frequency * function.amplitude
            function = Piecewise(self.breaks, poly, amplitude, self.frequency, self.closed)
        return function

    def scaled(self, width: float = 1.0, height: float = 1.0, start: float = 0.0, level: float = 0.0) -> "Piecewise":
        """level + height s((x - start)/width) as a function of x."""
        poly = height * self.poly / width ** np.arange(self.poly.shape[1])
        poly[:, 0] += level
        return Piecewise(start + width * self.breaks, poly, height * self.amplitude, self.frequency / width, self.closed)

    def inside(self, x: ArrayLike, low: Numbers, high: Numbers, what: str, remedy: str) -> Floats:
        """x as floats, pulled onto low .. high where it is outside by rounding only; InputError where it is further out."""
        x = np.asarray(x, dtype=float)
        slack = SLACK * max(abs(self.breaks[0]), abs(self.breaks[-1]))
        outside = ~((x >= low - slack) & (x <= high + slack))
        if np.any(outside):
            first, low, high = (part[outside][0] for part in np.broadcast_arrays(x, low, high))
            count = f" ({outside.sum()} of {outside.size} values do)" if outside.size > 1 else ""
            raise InputError(f"{what} = {first:.9g} lies outside {low:.9g} .. {high:.9g}{count}; {remedy}.")
        return np.clip(x, low, high)

    def on_own_piece(self, k: int | Ints, x: Numbers, what: str) -> Motion:
        """`on_piece` for callers who may ask for a piece that is not there, or for x that is not on it: InputError."""
        k = np.asarray(k)
        if np.any((k < 0) | (k >= self.count)):
            wrong = k[(k < 0) | (k >= self.count)].flat[0]
            raise InputError(f"{what}: there is no piece {wrong}; the pieces are 0 .. {self.count - 1}.")
        return self.on_piece(k, self.inside(x, self.breaks[k], self.breaks[k + 1], what, "call the motion itself, it finds the piece"))

    def jumps(self, order: int) -> Floats:
        """Right minus left value of the derivative of an order at every break (n+1,); 0.0 where the difference is rounding.

        When closed, the two outer ends are compared with each other, otherwise with a standstill at the level reached.
        """
        function, pieces = self.derivative(order), np.arange(self.count)
        left, right = (function.on_piece(pieces, ends).s for ends in (self.breaks[:-1], self.breaks[1:]))
        outer = (right[-1], left[0]) if self.closed else (left[0], right[-1]) if order == 0 else (0.0, 0.0)
        jump = np.append(left, outer[1]) - np.insert(right, 0, outer[0])
        return np.where(np.abs(jump) <= self._rounding(function, order), 0.0, jump)

    def relative_jump(self, order: int) -> float:
        """Largest jump of the derivative of an order over the largest magnitude of that derivative; 0 where it vanishes."""
        if order not in self._relative_jumps:
            self._relative_jumps[order] = self._relative_jump(order)
        return self._relative_jumps[order]

    @cached_property
    def _relative_jumps(self) -> dict[int, float]:
        """{order: jump} of those that were asked for."""
        return {}

    def _relative_jump(self, order):
        slope = self.derivative(order)
        peak = max(map(abs, slope.extremes(lambda k, x: slope.on_piece(k, x)[:2])))
        return float(np.max(np.abs(self.jumps(order)))) / peak if peak else 0.0

    def _rounding(self, function, order):
        """The jump at each break that rounding alone can make in the derivative of an order."""
        width = np.diff(self.breaks)
        k, x = self.samples(4)
        size, lift = np.max(np.abs(function.on_piece(k, x).s)), np.max(np.abs(self.on_piece(k, x).s))
        wider = np.maximum(np.append(width, width[0]), np.insert(width, 0, width[-1]))
        # A lift known to machine precision gives a spline's n-th derivative to eps * lift / width^n only.
        return CLOSURE * size + 64 * np.finfo(float).eps * lift / wider**order

    @cached_property
    def continuity(self) -> int:
        """Order of the highest derivative that nowhere jumps (0: v jumps, 1: a jumps, 2: j jumps ...), at most HIGHEST_ORDER."""
        smooth = (order - 1 for order in range(HIGHEST_ORDER + 1) if np.any(self.jumps(order)))
        return next(smooth, HIGHEST_ORDER)

    def peaks(self) -> Peaks:
        """`Peaks`, exact to rounding; j and the others one-sided at jumps."""
        return self._peaks

    @cached_property
    def _peaks(self) -> Peaks:
        slope = self.derivative()
        v, a = (self.extremes(lambda k, x, n=n: self.on_piece(k, x)[n : n + 2]) for n in (1, 2))
        j = self.extremes(lambda k, x: slope.on_piece(k, x)[2:4])
        power = self.extremes(lambda k, x: _power(self.on_piece(k, x)))
        v, a, j, power = (float(np.max(np.abs(both))) for both in (v, a, j, power))
        if self.continuity == 0:
            a = power = math.inf
        return Peaks(v, a, j if self.continuity > 1 else math.inf, power)

    def extremes(self, value_and_slope: Callable[..., Sequence[Any]]) -> tuple[float, float]:
        """(least, greatest) of a quantity given as value_and_slope(k, x) on piece k, over all pieces with their ends."""
        k, x = self.samples(16 + 2 * self.poly.shape[1] + int(np.max(np.abs(self._turns), initial=0.0) * 8 / np.pi))
        # Each piece gets its own unit of y with a gap before the next, so that both sides of a break have a place.
        y = (2 * np.arange(self.count)[:, None] + np.linspace(0, 1, x.shape[1])).ravel()
        flat = self._place(bracketed_roots(lambda y: value_and_slope(*self._place(y))[1], y))
        values = np.append(value_and_slope(k, x)[0].ravel(), value_and_slope(*flat)[0])
        return float(values.min()), float(values.max())

    @property
    def _turns(self):
        return self.frequency * np.diff(self.breaks)[:, None]

    def samples(self, intervals: int) -> tuple[Ints, Floats]:
        """Piece numbers and places (n, intervals + 1), ends included."""
        k = np.repeat(np.arange(self.count)[:, None], intervals + 1, axis=1)
        return k, self.breaks[k] + np.diff(self.breaks)[k] * np.linspace(0, 1, intervals + 1)

    def _place(self, y):
        k = np.minimum((y // 2).astype(int), self.count - 1)
        return k, self.breaks[k] + np.diff(self.breaks)[k] * np.minimum(y - 2 * k, 1.0)


def _power(motion):
    """a v and its slope."""
    return motion.a * motion.v, motion.a**2 + motion.v * motion.j


def joined(functions: Iterable[Piecewise], closed: bool) -> Piecewise:
    """One `Piecewise` of several that follow each other."""
    functions = list(functions)
    breaks = np.append(np.concatenate([f.breaks[:-1] for f in functions]), functions[-1].breaks[-1])
    poly, amplitude, frequency = (_stacked([getattr(f, name) for f in functions]) for name in ("poly", "amplitude", "frequency"))
    return Piecewise(breaks, poly, amplitude, frequency, closed)


def _stacked(tables):
    """Rows of all tables, the shorter ones filled up with zeros."""
    columns = max(table.shape[1] for table in tables)
    return np.concatenate([np.pad(table, ((0, 0), (0, columns - table.shape[1]))) for table in tables])
