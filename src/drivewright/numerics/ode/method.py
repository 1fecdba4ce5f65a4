"""What an integration method states: a description with its order and tableau, and five formulas on the type of its workspace.

A method is one file in `methods`: a NamedTuple of arrays as workspace, `begin`, `step`, `interpolate`, `carry_over` and `restart`
under @implements, and `METHOD`, the description that the loop, `METHODS` and the tests of the orders read.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference, generic, inner
from drivewright._typing import Floats

TIME, STEP, ERROR = range(3)  # the clock: time, size of the next step, last error over its tolerance (nan: rate not finite)


@by_reference
class StepControl(NamedTuple):
    """Until when a run goes, how accurate and how long its steps are."""

    t1: float
    rtol: float
    atol: Floats  # (n,)
    max_step: float
    min_step: float


class Tableau(NamedTuple):
    """Butcher tableau of a method of s stages: Y_i = y + h sum_j a_ij f(t + c_j h, Y_j), y_new = y + h sum_i b_i f(t + c_i h, Y_i)."""

    a: Floats  # (s, s)
    b: Floats  # (s,)
    c: Floats  # (s,)


@dataclass(frozen=True)
class Method:
    """An integration method.  `order`: of the ends of its steps; `dense_order`: of the polynomial between them."""

    name: str
    order: int
    dense_order: int
    tableau: Tableau
    citation: str
    workspace: Callable[[int], tuple[object, ...]]  # by the number of states: the NamedTuple that carries the method's formulas
    adaptive: bool = True  # False: all steps have the size max_step, whatever the tolerance
    needs_jacobian: bool = False

    @property
    def stages(self) -> int:
        """Number of stages of a step."""
        return len(self.tableau.b)


@generic
def begin(work: object, system: object, control: StepControl, clock: Floats, y: Floats) -> None:
    """Make ready for the first step from y (n,) at the time in the clock (3,), and write that step's size into the clock."""


@generic
def step(
    work: object, system: object, control: StepControl, clock: Floats, t: float, h: float, again: bool, y: Floats, trial: Floats
) -> bool:
    """Try the step h from (t, y), `again` after it failed with a longer h: its result into `trial` (n,), whether it is good enough.

    The size of the next step, or of the next try, goes into the clock, with the error.
    """
    return False


@generic
def interpolate(work: object, h: float, y: Floats, trial: Floats, dense: Floats) -> None:
    """Write the polynomial over the good step from y to `trial` into `dense` (5, n), as `dense_output` reads it."""


@generic
def carry_over(work: object, system: object, t: float, y: Floats, is_good: bool) -> None:
    """Make ready for the next step from (t, y), the end of a good one; where many cases step at once, of those whose step is good."""


@generic
def restart(work: object, system: object, control: StepControl, clock: Floats, y: Floats) -> None:
    """Make ready for a step from y at the time in the clock, where an event has changed the system."""


@inner
def first_step(f: Floats, control: StepControl, clock: Floats, y: Floats) -> None:
    """A careful first step into the clock, by the rate f (n,): a hundredth of the time in which y (n,) changes by its size."""
    size = change = 0.0
    for i in range(y.size):
        scale = control.atol[i] + control.rtol * abs(y[i])
        size += (y[i] / scale) ** 2
        change += (f[i] / scale) ** 2
    if not np.isfinite(change):
        clock[ERROR] = np.nan
    first = 0.01 * np.sqrt(size / change) if min(size, change) > 1e-10 else 1e-6 * (control.t1 - clock[TIME])
    clock[STEP] = max(first, control.min_step)
