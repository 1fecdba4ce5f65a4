"""Jets: a function's value and its first three derivatives, carried through ordinary arithmetic.

Write a position as a formula of jets and velocity, acceleration and jerk follow exactly, without a finite difference
and without a second formula that must agree with the first:

    t = variable(np.linspace(0, 1, 5))
    point = 0.1 * exp(1j * t) + 0.02 * exp(3j * t)      # a point in the complex plane
    point.d1, point.d2                                   # its velocity and acceleration

The rules are Leibniz (products), Faa di Bruno (f(g(t))) and its inverse (change of the independent variable).
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from drivewright._typing import ArrayLike
from drivewright.errors import InputError

JetPart: TypeAlias = np.ndarray[Any, Any]  # (...) of real or of complex numbers


@dataclass(frozen=True, eq=False)
class Jet:
    """Value d0 and derivatives d1, d2, d3 of a real or complex function of one variable; arrays that broadcast."""

    d0: JetPart
    d1: JetPart
    d2: JetPart
    d3: JetPart

    __array_ufunc__ = None  # an array on the left hands `array * jet` over to __rmul__

    def __iter__(self) -> Iterator[JetPart]:
        """Unpack: s, v, a, j = jet."""
        return iter((self.d0, self.d1, self.d2, self.d3))

    def __getitem__(self, index: Any) -> "Jet":
        """The same part of the value and of each derivative."""
        return Jet(*(part[index] for part in np.broadcast_arrays(*self)))

    def __add__(self, other: "Jet | ArrayLike") -> "Jet":
        if not isinstance(other, Jet) and np.ndim(other) == 0:
            return Jet(self.d0 + other, self.d1, self.d2, self.d3)
        return Jet(*(a + b for a, b in zip(self, _jet(other), strict=True)))

    __radd__ = __add__

    def __neg__(self) -> "Jet":
        return Jet(*(-part for part in self))

    def __sub__(self, other: "Jet | ArrayLike") -> "Jet":
        return self + -_jet(other)

    def __rsub__(self, other: "Jet | ArrayLike") -> "Jet":
        return -self + other

    def __mul__(self, other: "Jet | ArrayLike") -> "Jet":
        """Leibniz: (f g)''' = f''' g + 3 f'' g' + 3 f' g'' + f g'''."""
        f0, f1, f2, f3 = self
        if not isinstance(other, Jet):
            other = other if np.isscalar(other) else np.asarray(other)
            return Jet(f0 * other, f1 * other, f2 * other, f3 * other)
        g0, g1, g2, g3 = _jet(other)
        return Jet(f0 * g0, f1 * g0 + f0 * g1, f2 * g0 + 2 * f1 * g1 + f0 * g2, f3 * g0 + 3 * f2 * g1 + 3 * f1 * g2 + f0 * g3)

    __rmul__ = __mul__

    def __truediv__(self, other: "Jet | ArrayLike") -> "Jet":
        return self * _jet(other) ** -1

    def __rtruediv__(self, other: "Jet | ArrayLike") -> "Jet":
        return self**-1 * other

    def __pow__(self, exponent: float) -> "Jet":
        """Power with a constant scalar exponent."""
        x, p = self.d0, exponent
        # A vanished coefficient is written as zero: 0 * x**-1 would be nan at x = 0.
        factors = (1.0, p, p * (p - 1), p * (p - 1) * (p - 2))
        return compose(Jet(*(factor * x ** (p - k) if factor else 0.0 * x for k, factor in enumerate(factors))), self)

    @property
    def real(self) -> "Jet":
        """Real part."""
        return Jet(*(np.real(part) for part in self))

    @property
    def imag(self) -> "Jet":
        """Imaginary part."""
        return Jet(*(np.imag(part) for part in self))

    def conj(self) -> "Jet":
        """Complex conjugate."""
        return Jet(*(np.conj(part) for part in self))

    def abs2(self) -> "Jet":
        """Square of the modulus, z conj(z), real."""
        return (self * self.conj()).real

    def with_respect_to(self, x: "Jet") -> "Jet":
        """The jet of f as a function of x, from f(t) (self) and x(t), both jets in t.

        f_x = f'/x',  f_xx = (f'' - f_x x'')/x'^2,  f_xxx = (f''' - 3 f_xx x' x'' - f_x x''')/x'^3.
        Raises InputError where x' is 0: there f has no derivative by x.
        """
        _, x1, x2, x3 = x
        _refuse_standstill(x)
        _, f1, f2, f3 = self
        by_x = f1 / x1
        by_xx = (f2 - by_x * x2) / x1**2
        return Jet(self.d0, by_x, by_xx, (f3 - 3 * by_xx * x1 * x2 - by_x * x3) / x1**3)

    def inverse(self, at: ArrayLike) -> "Jet":
        """The jet of t(x), from this jet of x(t) taken at t = `at`.  Raises InputError where x' is 0."""
        return variable(at).with_respect_to(self)


def variable(x: ArrayLike) -> Jet:
    """The independent variable itself: value x, first derivative 1."""
    x = np.asarray(x) * 1.0
    return Jet(x, np.ones_like(x), np.zeros_like(x), np.zeros_like(x))


def constant(value: ArrayLike) -> Jet:
    """A value that does not change."""
    value = np.asarray(value) * 1.0
    zero = np.zeros_like(value)
    return Jet(value, zero, zero, zero)


def compose(outer: Iterable[Any], inner: Iterable[Any]) -> Jet:
    """Jet of outer(inner(t)): `outer` is a jet in its own argument, taken at inner.d0 (Faa di Bruno)."""
    f0, f1, f2, f3 = outer
    _, g1, g2, g3 = inner
    return Jet(f0, f1 * g1, f2 * g1**2 + f1 * g2, f3 * g1**3 + 3 * f2 * g1 * g2 + f1 * g3)


def exp(z: Jet) -> Jet:
    """Exponential, complex arguments included."""
    value = np.exp(z.d0)
    return compose(Jet(value, value, value, value), z)


def log(z: Jet) -> Jet:
    """Natural logarithm; of a complex argument its principal value."""
    r = 1.0 / z.d0
    return compose(Jet(np.log(z.d0), r, -(r**2), 2 * r**3), z)


def sin(x: Jet) -> Jet:
    """Sine."""
    s, c = np.sin(x.d0), np.cos(x.d0)
    return compose(Jet(s, c, -s, -c), x)


def cos(x: Jet) -> Jet:
    """Cosine."""
    s, c = np.sin(x.d0), np.cos(x.d0)
    return compose(Jet(c, -s, -c, s), x)


def tan(x: Jet) -> Jet:
    """Tangent: tan' = 1 + tan^2."""
    t = np.tan(x.d0)
    slope = 1 + t**2
    return compose(Jet(t, slope, 2 * t * slope, slope * (2 + 6 * t**2)), x)


def atan(x: Jet) -> Jet:
    """Inverse tangent: atan' = 1/(1 + x^2)."""
    slope = 1.0 / (1 + x.d0**2)
    return compose(Jet(np.arctan(x.d0), slope, -2 * x.d0 * slope**2, (6 * x.d0**2 - 2) * slope**3), x)


def atan2(y: Jet | ArrayLike, x: Jet | ArrayLike) -> Jet:
    """Direction of the real point (x, y), in (-pi, pi]: the imaginary part of log(x + i y)."""
    x, y = _jet(x), _jet(y)
    return Jet(np.arctan2(y.d0, x.d0), *list(log(x + 1j * y).imag)[1:])


def sqrt(x: Jet) -> Jet:
    """Square root."""
    return x**0.5


def _jet(value):
    return value if isinstance(value, Jet) else constant(value)


def _refuse_standstill(x):
    value, slope, _, _ = np.broadcast_arrays(*x)
    still = slope == 0
    if np.any(still):
        raise InputError(
            f"jet: the new variable does not change (x' = 0) at {np.sum(still)} of {still.size} points, "
            f"first at x = {value[still][0]:.6g}. A derivative by x does not exist there; leave those points out or keep the old variable."
        )
