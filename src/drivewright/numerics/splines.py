"""Splines through points, as piecewise polynomials: scipy's PPoly (coefficients .c, breaks .x, .derivative()), and `Cubics` where a
sampled signal is all there is to it, for scipy.interpolate takes longer to import than a small run of a mechanism."""

from math import factorial
from typing import NamedTuple

import numpy as np
import scipy

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError

# Derivatives that vanish at an end, by kind of end and degree; a spline of degree k needs (k - 1)/2 of them.
_VANISHING = {("clamped", 3): (1,), ("clamped", 5): (1, 2), ("natural", 3): (2,), ("natural", 5): (3, 4)}


class Cubics(NamedTuple):
    """Polynomials sum_k coefficients[k] (x - breaks[i])^(3 - k) between neighbouring breaks; breaks (m,), coefficients (4, m - 1)."""

    breaks: Floats
    coefficients: Floats

    def at(self, x: Floats) -> Floats:
        """Values at every x (n,) between the first break and the last."""
        piece = np.clip(np.searchsorted(self.breaks, x, side="right") - 1, 0, len(self.breaks) - 2)
        (third, second, first, value), along = self.coefficients[:, piece], x - self.breaks[piece]
        return value + along * (first + along * (second + along * third))

    def integrals_to(self, at: Floats) -> Floats:
        """Integrals from breaks[0] to every `at` (n,) between the first break and the last."""
        whole = np.concatenate([[0.0], np.cumsum(_integral(self.coefficients, np.diff(self.breaks)))])
        piece = np.clip(np.searchsorted(self.breaks, at, side="right") - 1, 0, len(self.breaks) - 2)
        return whole[piece] + _integral(self.coefficients[:, piece], at - self.breaks[piece])


def _integral(coefficients, width):
    third, second, first, value = coefficients
    return width * (value + width * (first / 2 + width * (second / 3 + width * third / 4)))


def cubic_spline(x: Floats, y: Floats) -> Cubics:
    """The C2 cubic spline y(x) with a third derivative that is continuous at the second and last but one sample ("not a knot").

    x (m,) ascending, y (m,), m >= 2; a straight line through two samples, a parabola through three.  The slopes s at the samples solve,
    with steps h and chords c, h[i] s[i-1] + 2 (h[i-1] + h[i]) s[i] + h[i-1] s[i+1] = 3 (h[i] c[i-1] + h[i-1] c[i])
    (de Boor, A Practical Guide to Splines, chapter IV; recalled).
    """
    h, chord = np.diff(x), np.diff(y) / np.diff(x)
    return hermite_cubics(x, y, _slopes(h, chord))


def hermite_cubics(x: Floats, y: Floats, slope: Floats) -> Cubics:
    """The cubics through samples y (m,) at x (m,), ascending, with these slopes (m,) there."""
    h, chord, left, right = np.diff(x), np.diff(y) / np.diff(x), slope[:-1], slope[1:]
    return Cubics(x, np.stack([(left + right - 2 * chord) / h**2, (3 * chord - 2 * left - right) / h, left, y[:-1]]))


def _slopes(h, chord):
    if len(h) == 1:
        return np.repeat(chord, 2)
    if len(h) == 2:
        bend = (chord[1] - chord[0]) / (h[0] + h[1])
        return np.array([chord[0] - bend * h[0], chord[0] + bend * h[0], chord[1] + bend * h[1]])
    below = np.concatenate([[0.0], h[1:], [h[-1] + h[-2]]])
    above = np.concatenate([[h[0] + h[1]], h[:-1], [0.0]])
    diagonal = np.concatenate([[h[1]], 2 * (h[:-1] + h[1:]), [h[-2]]])
    inner = 3 * (h[1:] * chord[:-1] + h[:-1] * chord[1:])
    return solve_tridiagonal(below, diagonal, above, np.concatenate([[_end(h, chord)], inner, [_end(h[::-1], chord[::-1])]]))


def _end(h, chord):
    """Right-hand side of the condition at the first sample, that the first two intervals have one cubic."""
    both = h[0] + h[1]
    return ((h[0] + 2 * both) * h[1] * chord[0] + h[0] ** 2 * chord[1]) / both


def solve_tridiagonal(below: Floats, diagonal: Floats, above: Floats, right: Floats) -> Floats:
    """x (n,) with below[i] x[i-1] + diagonal[i] x[i] + above[i] x[i+1] = right[i]; below[0] and above[-1] are 0.

    Cyclic reduction: every other unknown is eliminated from the rest, all at once (Golub & Van Loan, section 4.5.4), in log2 n rounds.
    Stable where the diagonal dominates, as in splines.
    """
    n = len(diagonal)
    if n == 1:
        return right / diagonal
    odd = np.arange(1, n, 2)
    before, after = odd - 1, np.minimum(odd + 1, n - 1)  # an `above` of 0 belongs to the one that is not there
    down, up = below[odd] / diagonal[before], above[odd] / diagonal[after]
    x = np.empty(n)
    x[odd] = solve_tridiagonal(
        -down * below[before],
        diagonal[odd] - down * above[before] - up * below[after],
        -up * above[after],
        right[odd] - down * right[before] - up * right[after],
    )
    even = np.arange(0, n, 2)
    beside = np.concatenate([[0.0], x[odd], [0.0]])  # x[2 k - 1], x[2 k + 1]
    x[even] = (right[even] - below[even] * beside[: len(even)] - above[even] * beside[1 : len(even) + 1]) / diagonal[even]
    return x


def interpolating_spline(x: ArrayLike, y: ArrayLike, degree: int = 3, ends: str = "natural") -> "scipy.interpolate.PPoly":
    """The spline of degree 3 or 5 with y(x) = y and all derivatives below the degree continuous; breaks at x.

    x (m,) ascending, y (m, ...).  ends: "periodic" (y[0] = y[-1]); "clamped": at rest, first derivative 0 and for degree 5
    the second too; "natural": free, second derivative 0, for degree 5 third and fourth.
    """
    x, y = _points(x, y, degree)
    if ends == "periodic":
        _check_period(y)
        y = np.concatenate([y[:-1], y[:1]])
        return _pieces(scipy.interpolate.make_interp_spline(x, y, degree, bc_type="periodic"), x, "periodic")
    if (ends, degree) not in _VANISHING:
        raise InputError(f"spline: ends must be 'periodic', 'clamped' or 'natural', got {ends!r}.")
    conditions = [(order, np.zeros(y.shape[1:])) for order in _VANISHING[ends, degree]]
    return _pieces(scipy.interpolate.make_interp_spline(x, y, degree, bc_type=(conditions, conditions)), x, True)


def _points(x, y, degree):
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    if degree not in (3, 5):
        raise InputError(f"spline: the degree must be 3 or 5, got {degree}.")
    if x.ndim != 1 or y.shape[:1] != x.shape or not (np.all(np.isfinite(x)) and np.all(np.isfinite(y))):
        raise InputError(f"spline: x (m,) and y (m, ...) must be finite and of one length, got shapes {x.shape} and {y.shape}.")
    if x.size <= degree:
        raise InputError(f"spline: degree {degree} needs at least {degree + 1} points, got {x.size}.")
    if np.any(np.diff(x) <= 0):
        first = int(np.argmax(np.diff(x) <= 0))
        raise InputError(f"spline: x must increase, but x[{first + 1}] = {x[first + 1]:g} follows {x[first]:g}; sort and drop repeats.")
    return x, y


def _check_period(y):
    gap = np.max(np.abs(y[-1] - y[0]))
    if gap > 1e-9 * np.ptp(y):
        raise InputError(
            f"spline: a periodic one must end where it starts, but the last value differs from the first by {gap:.3g}. "
            "Repeat the first value at the end of the period, or choose other ends."
        )


def _pieces(spline, breaks, extrapolate):
    """The polynomial of each interval between breaks, by Taylor's formula at its left end.

    PPoly.from_spline would list empty and outlying intervals too, and takes scalar splines only.
    """
    taylor = [spline(breaks[:-1], nu=order) / factorial(order) for order in range(spline.k, -1, -1)]
    return scipy.interpolate.PPoly(np.stack(taylor), breaks, extrapolate=extrapolate)
