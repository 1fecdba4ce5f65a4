"""What a system of ordinary differential equations states: a NamedTuple of numbers and arrays, with formulas under @implements.

Only `rate` is required; `events` where events are watched for, `switch` where they change the state, `jacobian` where it is known.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference, formulas_of, generic, implements, inner
from drivewright._typing import ArrayLike, Floats
from drivewright.numerics.lanes import where


@generic
def rate(system: object, t: float, y: Floats, dy: Floats) -> None:
    """Write the derivative of the state y (n,) at time t into dy (n,)."""


@generic
def events(system: object, t: float, y: Floats, values: Floats) -> None:
    """Write the event functions at (t, y) into `values` (m,); an event happens where one of them changes sign."""


@generic
def switch(system: object, index: int, t: float, y: Floats) -> None:
    """Event number `index` has happened at (t, y): change y (n,), where the system starts anew from here."""


@generic
def jacobian(system: object, t: float, y: Floats, J: Floats) -> None:
    """Write the derivative of rate i by y[j] at (t, y) into J[i, j] (n, n), which arrives as zeros.

    A system need not state it: for methods that need one, `FiniteDifferences` then takes the place of the system.
    """


class Functions(NamedTuple):
    """A system of ordinary Python functions: rate(t, y) -> dy, events(t, y) -> values, switch(index, t, y) -> y.  Runs uncompiled."""

    rate: Callable[[float, Floats], ArrayLike]
    events: Callable[[float, Floats], ArrayLike] | None = None
    switch: Callable[[int, float, Floats], ArrayLike] | None = None


@implements(rate, Functions)
def _(system, t, y, dy):
    dy[:] = system.rate(t, y)


@implements(events, Functions)
def _(system, t, y, values):
    values[:] = system.events(t, y)


@implements(switch, Functions)
def _(system, index, t, y):
    y[:] = system.switch(index, t, y)


class NoEvents(NamedTuple):
    """In place of the system where no events are watched for."""

    nothing: int


@implements(events, NoEvents)
def _(system, t, y, values):
    pass


@implements(switch, NoEvents)
def _(system, index, t, y):
    pass


@by_reference
class FiniteDifferences(NamedTuple):
    """A system whose Jacobian is taken by differences of its rate: y[j] is moved by `share` (|y[j]| + least[j])."""

    system: object
    share: float  # relative size of the move [-]
    least: Floats  # (n,) size of y that does not matter, in its units
    scratch: Floats  # (3, n) moved state, rate, rate at the moved state


@implements(rate, FiniteDifferences)
def _(system, t, y, dy):
    rate(system.system, t, y, dy)


@implements(jacobian, FiniteDifferences)
def _(system, t, y, J):
    moved, base, changed = system.scratch[0], system.scratch[1], system.scratch[2]
    copy(y, moved)
    rate(system.system, t, y, base)
    for j in range(y.size):
        step = system.share * (abs(y[j]) + system.least[j])
        moved[j] = y[j] + (step if base[j] >= 0.0 else -step)  # to the side where the next stages are
        rate(system.system, t, moved, changed)
        for i in range(y.size):
            J[i, j] = (changed[i] - base[i]) / (moved[j] - y[j])
        moved[j] = y[j]


def with_jacobian(system: tuple[object, ...], rtol: float, atol: Floats) -> tuple[object, ...]:
    """The system itself where it states its Jacobian, else `FiniteDifferences` of it.

    y is moved by its tolerance, and no more than a billionth: so little that nothing which the run resolves bends over it, be it a
    play of a micrometre after a hundred turns, and far above rounding.  Newton's method needs no more than three digits.
    """
    if type(system) in formulas_of(jacobian):
        return system
    return FiniteDifferences(system, min(max(rtol, 1e-11), 1e-9), atol / rtol, np.empty((3, atol.size)))


# ------------------------------------------------------------------------------------------------------------- kernels


@inner
def rate_at(system: object, t: float, y: Floats, dy: Floats) -> None:
    """`rate`, compiled once for the places where it is not called often. y (n,), dy (n,) written."""
    rate(system, t, y, dy)


@inner
def events_at(event_system: object, t: float, y: Floats, values: Floats) -> None:
    """`events`, likewise. y (n,), values (m,) written."""
    events(event_system, t, y, values)


@inner
def switch_at(switch_system: object, index: int, t: float, y: Floats) -> None:
    """`switch`, likewise. y (n,), in place."""
    switch(switch_system, index, t, y)


@inner
def copy(source: Floats, target: Floats) -> None:
    """target[:] = source, both (n,)."""
    # Written as the slice it would cost three seconds of compiling, for the message on unequal shapes.
    for i in range(source.size):
        target[i] = source[i]


@inner
def copy_where(condition: bool, source: Floats, target: Floats) -> None:
    """`copy` where a condition holds."""
    for i in range(source.size):
        target[i] = where(condition, source[i], target[i])
