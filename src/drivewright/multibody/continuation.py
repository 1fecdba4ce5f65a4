"""Kinematics over time: a mechanism whose drives leave it no freedom, carried on along its branch.

A step is as long as the branch is nearly straight over it: Newton's correction and the change of the rates are small beside the way, and
the determinant of the loops does not fall by more than half.  So the steps shrink towards a singular position instead of leading over it
to another branch; from near by `multibody.singular` lays a chart across.  What comes out does not depend on the times asked for.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, cast

import numpy as np

from drivewright._jit import inner
from drivewright._typing import Floats
from drivewright.multibody.chart import solve_kinematics, solve_kinematics_all, update_kinematics
from drivewright.multibody.dynamics import validity_of_split
from drivewright.multibody.kinematics import jacobian_determinant
from drivewright.multibody.partition import evaluate_at, partition_into
from drivewright.multibody.passages import Passage, passage
from drivewright.multibody.singular import Outlook, look_ahead
from drivewright.multibody.system import System, Work, motion

LONGEST = 0.05  # way of the fastest coordinate in a step [rad], [lengths of the mechanism]
BENT = 0.25  # Newton's correction, and half the change of the rates, over the way of a step
SHRUNK = 0.5  # part of the determinant that is left after a step, at least
SHORTEST = 1e-9  # part of the way below which a drive that finds no way on is stuck
FINE = 160  # times added on the way to, and from, a place where the branches come near each other
STEADY = 1e-9  # correction that is none, however short the way

REACHED, STUCK, WEAK = range(3)


@dataclass(frozen=True)
class Stretch:
    """States y (m, n) at the times t (m,) of one system, that is of one split of the coordinates; the end of it is in `t_end`, `y_end`."""

    system: System
    t: Floats
    y: Floats
    t_end: float
    y_end: Floats


@dataclass(frozen=True)
class Continuation:
    """Stretches one after another, the singular positions passed, the time reached, and whether it is stuck or was asked to stop there,
    before a singular position; `refined_until`: the last of the times added, which may lie beyond the end."""

    stretches: tuple[Stretch, ...]
    passages: tuple[Passage, ...]
    reached: float
    outcome: str  # "finished", "stuck" or "stopped"
    refined_until: float = -np.inf


def continue_motion(system: System, times: Floats, end: float, y: Floats, stop: bool = False, refine: bool = False) -> Continuation:
    """The `Continuation` of a driven system from its state y at time 0 through ascending times to the end; it ends in the first singular
    position with `stop`.  With `refine` times are added where two branches come near each other and the motion bends sharply."""
    t, stretches, passages, refined_until = 0.0, [], [], -np.inf
    while True:
        ahead = times[times >= t] if not stretches else times[times > t]
        if len(system.chart.offsets) == 0:
            stretch, code = carry_on(system, t, ahead, end, y)
        else:
            stretch, code = _across(system, ahead, end, y), REACHED if end <= _leave(system) else WEAK
            if t < system.chart.origin_time < stretch.t_end:
                if stop:
                    return Continuation(tuple(stretches), (), system.chart.origin_time, "stopped", refined_until)
                passages.append(_passage(system, y))
        stretches.append(stretch)
        t, y = stretch.t_end, stretch.y_end
        if code != WEAK:
            return Continuation(tuple(stretches), tuple(passages), t, "finished" if code == REACHED else "stuck", refined_until)
        outlook = look_ahead(system, t, y) if len(system.chart.offsets) == 0 else Outlook(None, np.inf)
        system = outlook.charted[0] if outlook.charted else _split(system, t, y)
        if refine and not outlook.charted and np.isfinite(outlook.time):
            added = t + outlook.time * np.linspace(0.0, 2.0, FINE + 1)[1:]
            times, refined_until = np.union1d(times, added[added < end]), max(refined_until, added[-1])


def kernels_of_continuation(system: System) -> list[Callable[[], object]]:
    """What compiles the kernels of `continue_motion` for systems like this one: along a branch, and of a single state."""
    moving, y, kernels = motion(system), np.zeros(1), cast(Any, (continue_through, solve_kinematics))
    return [
        partial(kernels[0].compile_for, *moving, 0.0, np.zeros(1), y, y, np.zeros((1, 1))),
        partial(kernels[1].compile_for, *moving, 0.0, y),
    ]


def _split(system, t, y):
    """The system without a chart, its determinant measured at the state."""
    work = motion(system).work
    solve_kinematics(system, work, t, y)
    return partition_into(system, system.dependent, evaluate_at(system, work.coordinates.q, t))


def carry_on(system: System, t: float, times: Floats, end: float, y: Floats) -> tuple[Stretch, int]:
    """(`Stretch` of a driven system without a chart from its state y at the time t through ascending times to the end, why it ends:
    REACHED, STUCK, or WEAK where the determinant of the loops has left the decade about its reference)."""
    moving, y = motion(system), y.copy()
    ways = np.append(times, end)
    states = np.empty((len(ways), len(y)))
    t_end, count, code = continue_through(moving.system, moving.work, t, ways, y, np.empty_like(y), states)
    count = min(count, len(times))
    return Stretch(system, times[:count], states[:count], t_end, y), code


def _leave(system):
    """Time at which a driven system leaves its chart."""
    return system.chart.origin_time + system.chart.reach * system.chart.pace


def _across(system, times, end, y):
    """`Stretch` up to where the chart is left."""
    leave = min(_leave(system), end)
    inside = times[times <= leave]
    states = _states(system, np.append(inside, leave), y)
    return Stretch(system, inside, states[:-1], leave, states[-1])


def _passage(system, y):
    """The `Passage` of the singular position in a driven system's chart."""
    time = system.chart.origin_time
    return passage(system, time, _states(system, np.array([time]), y)[0])


def _states(system, times, y):
    """States (m, n) of a driven system at times within its chart; what elements remember is as in the state y."""
    moving, states = motion(system), np.tile(y, (len(times), 1))
    q, v = np.empty((2, len(times), len(system.sizes)))
    solve_kinematics_all(moving.system, moving.work, times, states, q, v)
    states[:, : len(system.stored)] = q[:, system.stored]
    return states


@inner
def continue_through(
    system: System, work: Work, start: float, times: Floats, y: Floats, rates: Floats, states: Floats
) -> tuple[float, int, int]:
    """Carry the dependent coordinates in y from time `start` through all times, filling `states`: (time reached, samples, why it ends).

    times (m,) [s], states (m, n), y and rates (n,) as in `loads.apply_forces`.
    """
    t = start
    update_kinematics(system, work, t, y)
    for n in range(times.size):
        t, code = continue_to(system, work, t, times[n], y, rates)
        if code != REACHED:
            return t, n, code
        for k in range(y.size):
            states[n, k] = y[k]
    return t, times.size, REACHED


@inner
def continue_to(system: System, work: Work, t: float, end: float, y: Floats, rates: Floats) -> tuple[float, int]:
    """Carry the dependent coordinates in y on to the time `end`, in steps small enough to stay on the same branch: (time reached, why it
    ends).  `work` holds the state at t, and in the end that at `end` where it gets there; rates is scratch, of the size of y.

    y (n,) as in `loads.apply_forces`.
    """
    step, size = end - t, jacobian_determinant(system, work)
    while t != end:
        if validity_of_split(system, work) <= 0.0:
            return t, WEAK
        step = _predict(system, work, y, step, rates)
        if abs(end - t - step) <= 1e-15 * abs(end):
            step = end - t
        closed = update_kinematics(system, work, t + step, work.node_state)
        left = jacobian_determinant(system, work) / size if size != 0.0 else 1.0
        if closed and left >= SHRUNK and _straight(system, work, rates, step):
            t, size = end if step == end - t else t + step, jacobian_determinant(system, work)
            for k in range(system.stored.size):
                y[k] = work.coordinates[system.stored[k]].q
            step = end - t
        elif abs(step) < SHORTEST * max(abs(end), 1e-9):
            return t, STUCK
        else:
            update_kinematics(system, work, t, y)
            step *= 0.5
    return t, REACHED


@inner
def _predict(system, work, y, step, rates):
    """Where the rates lead to in a step, in work.node_state, the rates, and the step: no longer than LONGEST.

    y, rates (n,) as in `loads.apply_forces`; step [s].
    """
    fastest = 0.0
    for k in range(system.stored.size):
        rates[k] = work.coordinates[system.stored[k]].v
        fastest = max(fastest, abs(rates[k]) / system.sizes[system.stored[k]])
    if abs(step) * fastest > LONGEST:
        step = np.copysign(LONGEST / fastest, step)
    for k in range(system.stored.size):
        work.node_state[k] = y[k] + step * rates[k]
    return step


@inner
def _straight(system, work, rates, step):
    """Whether the branch is nearly straight over a step from where the rates were these to what `work` holds; node_state is predicted.

    rates (n,) as in `loads.apply_forces`; step [s].
    """
    way = 0.0
    for k in range(system.stored.size):
        way = max(way, abs(rates[k] * step) / system.sizes[system.stored[k]])
    for k in range(system.stored.size):
        coordinate, size = work.coordinates[system.stored[k]], system.sizes[system.stored[k]]
        off, turned = abs(coordinate.q - work.node_state[k]) / size, abs((coordinate.v - rates[k]) * step) / size
        if off > BENT * way + STEADY or turned > 2 * BENT * way + STEADY:
            return False
    return True
