"""Motion laws s(u), 0 <= u <= 1, by name.

The classical laws, each stated by its acceleration (names and shapes as in the cam handbooks of Norton and Rothbart;
source recalled, verified by closed forms and quadrature in the tests).  More laws come through the entry-point group
`drivewright.motion_laws`: a function of the law's parameters that returns a `MotionLaw`.
"""

import inspect
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from drivewright import plugins
from drivewright._typing import Floats, Ints, Numbers
from drivewright.errors import InputError, UnknownName
from drivewright.motion.acceleration import Acceleration, hold, integrate, wave
from drivewright.motion.piecewise import CLOSURE, Motion, Peaks, Piecewise

PLUGINS = "drivewright.motion_laws"
BUILT_IN: "dict[str, Callable[..., Any]]" = {}
BuildT = TypeVar("BuildT", bound=Callable[..., Any])


@dataclass(frozen=True, eq=False)
class MotionLaw:
    """A motion over u = 0..1; called with u it gives Motion(s, v, a, j), derivatives with respect to u.

    s is the part of a rise.  Where `span` is given, s is an absolute lift [m or rad] and span the angle [rad] that u = 1 stands for.
    Peaks and continuity are computed, at the ends against a standstill (a closed law: against its other end).
    """

    name: str
    function: Piecewise = field(repr=False)
    span: float | None = None

    def __call__(self, u: Numbers) -> Motion:
        return self.function(self.function.inside(u, 0.0, 1.0, f"motion law {self.name!r}: u", "a Programme repeats it over a cycle"))

    def on_piece(self, k: int | Ints, u: Numbers) -> Motion:
        """Motion by the formula of piece k (or pieces, an array), one-sided at its ends; u within breaks[k] .. breaks[k + 1]."""
        return self.function.on_own_piece(k, u, f"motion law {self.name!r} on a piece: u")

    def peaks(self) -> Peaks:
        """Largest |v|, |a|, |j| and |a v|."""
        return self.function.peaks()

    @property
    def breaks(self) -> Floats:
        """Ends of the pieces, 0 and 1 included."""
        return self.function.breaks

    @property
    def closed(self) -> bool:
        """True where the end meets the start, as for a table over a whole cycle."""
        return self.function.closed

    @property
    def continuity(self) -> int:
        """Order of the highest derivative that does not jump: 0 position only, 1 velocity, 2 acceleration ... (6 stands for more)."""
        return self.function.continuity

    @cached_property
    def symmetric(self) -> bool:
        """True where the second half is the first turned about its end: s(1 - u) = s(0) + s(1) - s(u)."""
        u = np.linspace(0, 1, 1001)
        s = self.function(u).s
        return bool(np.max(np.abs(s + s[::-1] - s[0] - s[-1])) <= CLOSURE * np.max(np.abs(s)))


def register(*names: str) -> Callable[[BuildT], BuildT]:
    """Decorator: a function of a law's parameters is built in under these names; it returns a `Piecewise` or a `MotionLaw`."""

    def keep(build):
        BUILT_IN.update((name, build) for name in names)
        return build

    return keep


def names() -> list[str]:
    """Names of all motion laws, built in or plugged in, sorted."""
    return sorted({*BUILT_IN, *plugins.installed(PLUGINS)})


def law(name: str, **parameters: Any) -> MotionLaw:
    """The motion law of a name, e.g. law("scca", b=0.25, c=0, d=0.75)."""
    if name not in names():
        raise UnknownName("motion law", name, names())
    build = BUILT_IN.get(name) or plugins.load(PLUGINS, name, "motion law")
    try:
        inspect.signature(build).bind(**parameters)
    except TypeError as error:
        wanted = ", ".join(inspect.signature(build).parameters) or "none"
        raise InputError(f"motion law {name!r}: {error}; its parameters: {wanted}.") from None
    made = build(**parameters)
    return MotionLaw(name, made) if isinstance(made, Piecewise) else made


@register("constant-velocity", "uniform")
def _constant_velocity():
    return integrate([hold(1, 0)], start_velocity=1)


@register("parabolic")
def _parabolic():
    return integrate([hold(1 / 2, 1), hold(1 / 2, -1)])


@register("simple-harmonic")
def _simple_harmonic():
    return integrate([wave(1, math.pi / 2, 3 * math.pi / 2)])


@register("double-harmonic")
def _double_harmonic():
    """a ~ cos(pi u) - cos(2 pi u): starts softly, ends with a jump; made for a rise that turns back at once."""
    first, second = wave(1, math.pi / 2, 3 * math.pi / 2), wave(1, math.pi / 2, 5 * math.pi / 2, level=-1)
    return integrate([Acceleration(1, waves=first.waves + second.waves)])


@register("cycloidal")
def _cycloidal():
    return integrate([wave(1, 0, 2 * math.pi)])


@register("scca")
def _scca(b, c, d):
    """Sine ramps of b/2 at the ends, constant parts of c/2, a cosine of d between them; b + c + d = 1."""
    _refuse_parts(b=b, c=c, d=d)
    if abs(b + c + d - 1) > CLOSURE:
        raise InputError(f"motion law 'scca': b + c + d = {b + c + d:.9g}, but these parts of the motion must sum to 1.")
    quarter = math.pi / 2
    return integrate(
        [wave(b / 2, 0, quarter), hold(c / 2, 1), wave(d, quarter, 3 * quarter), hold(c / 2, -1), wave(b / 2, 3 * quarter, 4 * quarter)]
    )


@register("modified-sine")
def _modified_sine():
    return _scca(1 / 4, 0, 3 / 4)


@register("modified-trapezoid")
def _modified_trapezoid():
    return _scca(1 / 4, 1 / 2, 1 / 4)


@register("mcv")
def _modified_constant_velocity(c):
    """Modified-sine acceleration with a part c of constant velocity in the middle: sine rise (1-c)/8, cosine fall 3(1-c)/8 at each end."""
    _refuse_parts(c=c)
    if not c < 1:
        raise InputError(f"motion law 'mcv': the part of constant velocity c = {c:.9g} must leave room to accelerate; give 0 <= c < 1.")
    ramp, quarter = (1 - c) / 8, math.pi / 2
    return integrate(
        [
            wave(ramp, 0, quarter),
            wave(3 * ramp, quarter, 2 * quarter),
            hold(c, 0),
            wave(3 * ramp, 2 * quarter, 3 * quarter),
            wave(ramp, 3 * quarter, 4 * quarter),
        ]
    )


@register("mcv50")
def _mcv50():
    return _modified_constant_velocity(1 / 2)


@register("mcv33")
def _mcv33():
    return _modified_constant_velocity(1 / 3)


@register("mcv20")
def _mcv20():
    return _modified_constant_velocity(1 / 5)


@register("polynomial-345")
def _polynomial_345():
    return _rest_to_rest(1)


@register("polynomial-4567")
def _polynomial_4567():
    return _rest_to_rest(2)


@register("polynomial-56789")
def _polynomial_56789():
    return _rest_to_rest(3)


def _rest_to_rest(order):
    """a ~ (u (1 - u))^n (1 - 2u): zero n-fold at both ends; in t = u - 1/2 that is -2 t (1/4 - t^2)^n."""
    t = np.polynomial.Polynomial([0, 1])
    return integrate([Acceleration(1, tuple((-t * (1 / 4 - t**2) ** order).coef))])


@register("polynomial")
def _polynomial(start=(0.0, 0.0), end=(0.0, 0.0), interior=()):
    """Least-degree polynomial with s(0) = 0, s(1) = 1 and given normalised derivatives.

    start, end: (v, a, j ...) at u = 0 and 1, as many as wanted; interior: (u, order, value) of further conditions,
    order 0 for s.  Raises InputError where the conditions contradict one another or leave the polynomial open.
    """
    at_ends = [(u, order, value) for u, s, values in ((0.0, 0.0, start), (1.0, 1.0, end)) for order, value in enumerate((s, *values))]
    conditions = [*at_ends, *interior]
    rows, values = _condition_rows(conditions)
    if np.linalg.cond(rows) > 1e13:
        raise InputError(
            f"motion law 'polynomial': {len(values)} conditions contradict or repeat one another, or leave a polynomial of "
            f"degree {len(values) - 1} open (a derivative is asked for where no lower one is). Leave one out or add one."
        )
    coefficients = np.linalg.solve(rows, values) * 2.0 ** np.arange(len(values))
    empty = np.zeros((1, 0))
    return Piecewise(np.array([0.0, 1.0]), coefficients[None], empty.astype(complex), empty)


def _condition_rows(conditions):
    """Matrix and right-hand side of (d/du)^order s = value at u, s = sum c_m (2u - 1)^m, each row scaled to its largest factor."""
    powers = np.arange(len(conditions))
    rows, values = np.zeros((len(conditions), len(conditions))), np.zeros(len(conditions))
    for row, (u, order, value) in enumerate(conditions):
        _refuse_condition(u, order, value)
        factors = 2.0**order * np.array([math.perm(power, order) for power in powers])
        size = max(np.max(factors), 1.0)
        rows[row] = factors / size * (2.0 * u - 1) ** np.maximum(powers - order, 0)
        values[row] = value / size
    return rows, values


def _refuse_condition(u, order, value):
    if not (0 <= u <= 1 and math.isfinite(value)):
        raise InputError(f"motion law 'polynomial': condition (u = {u}, order {order}, value {value}) needs u in 0..1 and a finite value.")
    if order != int(order) or order < 0:
        raise InputError(f"motion law 'polynomial': condition at u = {u} has order {order}; give 0 for s, 1 for v, 2 for a ...")


def _refuse_parts(**parts):
    for name, value in parts.items():
        if not 0 <= value <= 1:
            raise InputError(f"motion law: part {name} = {value} of the motion must lie in 0..1.")
