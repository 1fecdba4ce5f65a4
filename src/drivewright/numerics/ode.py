"""Initial value problems y' = f(t, y): Dormand-Prince 5(4) with step control, dense output and event location.

A system is a NamedTuple of numbers and arrays with its right-hand side stated once:

    class Oscillator(NamedTuple):
        stiffness: float

    @implements(rate, Oscillator)
    def _(system, t, y, dy):
        dy[0] = y[1]
        dy[1] = -system.stiffness * y[0]

    integrate(Oscillator(4.0), 0.0, 1.0, [1.0, 0.0])

It runs compiled; a new system touches nothing here.  `Functions` wraps ordinary Python functions and runs uncompiled.
The kernels run in batches of steps, between which Ctrl-C and other threads get their turn.
The method and its sources stand in `numerics.dopri5`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from drivewright._jit import formula_of, implements, plain
from drivewright.errors import InputError, SolverError
from drivewright.numerics.dopri5 import GOES_ON, NOTE, STOP, SWITCH, Batch, Settings, Unwatched, Watch, advance, begin, events, rate, switch

_BATCH = 500

_ADVICE = {
    "finished": "",
    "event": "",
    "max_steps": "the limit of {steps} steps is reached. Raise max_steps, loosen rtol, or look for a stiff or chattering part.",
    "min_step": "the step would fall below {min_step:.1e}. Look for a jump in the right-hand side or for a time constant far below "
    "the others; loosen rtol and atol, or stop at the jump with a terminal event.",
    "not_finite": "the right-hand side is not finite. Check the start and the parameters, or stop before the singular place with an event.",
}
_OUTCOMES = ("max_steps", "finished", "event", "min_step", "not_finite")  # by code; a run that still goes on has met max_steps


class Functions(NamedTuple):
    """A system of ordinary Python functions: rate(t, y) -> dy, events(t, y) -> values, switch(index, t, y) -> y."""

    rate: Callable
    events: Callable | None = None
    switch: Callable | None = None


@implements(rate, Functions)
def _(system, t, y, dy):
    dy[:] = system.rate(t, y)


@implements(events, Functions)
def _(system, t, y, values):
    values[:] = system.events(t, y)


@implements(switch, Functions)
def _(system, index, t, y):
    y[:] = system.switch(index, t, y)


class Event(NamedTuple):
    """What to watch for in one event function: rising (+1), falling (-1) or any (0) sign change.

    `terminal`: it ends the run.  `switches`: the run starts anew from the state that the system's `switch` makes of it.
    """

    direction: int = 0
    terminal: bool = False
    switches: bool = False

    @property
    def effect(self):
        return STOP if self.terminal else SWITCH if self.switches else NOTE


class Crossing(NamedTuple):
    """An event that happened: time just after the sign change, number of the event function, state (after it switched)."""

    t: float
    index: int
    y: np.ndarray


@dataclass(frozen=True)
class Trajectory:
    """The solution at the times t (m,): y (m, n), up to t_end, y_end where the run ended.

    outcome: "finished", "event" (a terminal one), or, with `advice`, why it is partial: "max_steps", "min_step", "not_finite".
    """

    t: np.ndarray
    y: np.ndarray
    t_end: float
    y_end: np.ndarray
    crossings: Crossing  # all of them: t (k,), index (k,), y (k, n)
    outcome: str
    advice: str
    steps: int
    rejected: int

    @property
    def events(self):
        """The events one by one, in order of time."""
        return tuple(Crossing(float(t), int(index), y) for t, index, y in zip(*self.crossings, strict=True))

    def checked(self):
        """This trajectory, or SolverError carrying it where it is partial."""
        if self.advice:
            raise SolverError(f"integration stopped at t = {self.t_end:.6g}: {self.advice}", partial=self)
        return self


def integrate(
    system,
    t0,
    t1,
    y0,
    rtol=1e-8,
    atol=1e-10,
    *,
    samples=None,
    watch=(),
    per_step=1,
    max_steps=100_000,
    max_step=np.inf,
    min_step=0.0,
    first_step=None,
):
    """Integrate y' = rate(system, t, y) from y(t0) = y0 to t1 > t0; returns a Trajectory, a partial one with advice.

    The error of a step, over atol + rtol |y| (atol a number or one per component), is kept below 1 in the root mean square.
    `samples`: ascending times in [t0, t1] at which y is wanted; without them, `per_step` points of every step, its start first.
    `watch`: one Event per value that `events` writes.  Two sign changes of one event function within a step are found where they
    show in the step's middle or at the vertex of the parabola through it; else limit max_step.
    Without `first_step` a careful one is chosen.
    """
    y = np.array(y0, dtype=float)
    samples = None if samples is None else np.asarray(samples, dtype=float)
    _check(system, t0, t1, y, samples, watch, rtol, atol)
    start, go_on = (plain(begin), plain(advance)) if isinstance(system, Functions) else (begin, advance)
    watched = system if watch else Unwatched(0)
    switched = system if any(event.switches for event in watch) else Unwatched(0)
    settings = Settings(
        float(t1),
        float(rtol),
        np.broadcast_to(np.asarray(atol, dtype=float), y.shape).copy(),
        float(max_step),
        max(min_step, 16 * np.finfo(float).eps * max(abs(t0), abs(t1))),
    )
    what = _watched(watch)
    clock, k, values = np.array([t0, 0.0, 1e-4]), np.empty((7, y.size)), np.empty(len(watch))
    code = start(system, watched, settings, clock, y, k, values)
    clock[1] = first_step or clock[1]
    scratch = np.empty(y.size), *np.empty((3, len(watch)))
    parts, crossings, steps, rejected = [], [], 0, 0
    while code == GOES_ON and steps < max_steps:
        size = min(_BATCH, max_steps - steps)
        batch = Batch(
            np.empty((size, 2)),
            np.empty((size, 5, y.size)),
            np.empty((2 * size * len(watch), 3)),
            np.empty((2 * size * len(watch), y.size)),
            *scratch,
        )
        code, done, refused, hits = go_on(system, watched, switched, settings, what, clock, y, k, values, batch)
        crossings.append(_crossings(batch, hits))
        parts.append(_pick(batch, done, clock[0], per_step) if samples is None else _sample(batch, done, samples, clock[0]))
        steps, rejected = steps + done, rejected + refused
    return _trajectory(t0, np.array(y0, dtype=float), parts, samples, clock[0], y, crossings, code, settings, steps, rejected)


def _check(system, t0, t1, y, samples, watch, rtol, atol):
    formula_of(rate, type(system))
    if watch:
        formula_of(events, type(system))
    if any(event.switches for event in watch):
        formula_of(switch, type(system))
    if not (rtol > 0 and np.all(np.asarray(atol) > 0)):
        raise InputError(f"integrate: rtol = {rtol:g} and atol = {atol} must be above 0; atol is the size of y that does not matter.")
    if not t1 > t0:
        raise InputError(f"integrate: t1 = {t1:g} must lie after t0 = {t0:g}. For a run backwards, integrate -rate over -t.")
    if y.ndim != 1 or not np.all(np.isfinite(y)):
        raise InputError(f"integrate: the start y0 must be one row of finite numbers, got {y}.")
    if samples is not None and samples.size and (np.any(np.diff(samples) < 0) or samples[0] < t0 or samples[-1] > t1):
        raise InputError(f"integrate: samples {samples[0]:g} .. {samples[-1]:g} must ascend within [{t0:g}, {t1:g}]; sort and clip them.")


def _watched(watch):
    directions, effects = np.array([[e.direction, e.effect] for e in watch], dtype=np.int64).reshape(-1, 2).T.copy()
    return Watch(directions, effects, any(event.switches for event in watch))


def _crossings(batch, hits):
    """The events of a batch in order of time; of equal ones the one that ended the step stays last."""
    start, size = batch.steps[batch.hits[:hits, 0].astype(int)].T
    t = start + batch.hits[:hits, 2] * size
    order = np.argsort(t, kind="stable")
    return Crossing(t[order], batch.hits[order, 1].astype(int), batch.found[order])


def _pick(batch, done, end, count):
    """(t, y) of a batch of steps at `count` evenly spaced points of each, the start being the first and the end left out."""
    start, size = batch.steps[:done].T
    if count == 1:
        return start.copy(), batch.dense[:done, 0].copy()
    length = np.append(start[1:], end)[:done] - start  # shorter than the size where a switch cut the step
    theta = (length / size)[:, None] * np.arange(count) / count
    y = _polynomial(np.moveaxis(batch.dense[:done], 1, 0)[:, :, None], theta[:, :, None])
    return (start[:, None] + theta * size[:, None]).ravel(), y.reshape(done * count, batch.dense.shape[-1])


def _sample(batch, done, samples, end):
    """(t, y) of a batch of steps at the samples up to `end`."""
    start, size = batch.steps[:done].T
    t = samples[(samples > (start[0] if done else end)) & (samples <= end)]
    row = np.searchsorted(start, t, side="left") - 1
    theta = (t - start[row]) / size[row]
    return t, _polynomial(np.moveaxis(batch.dense[row], 1, 0), theta[:, None])


def _trajectory(t0, y0, parts, samples, t_end, y_end, crossings, code, settings, steps, rejected):
    # The samples of a batch lie in (start, end]; without samples the start of each step is given and the end is missing.
    at_start = samples[samples == t0] if samples is not None else np.empty(0)
    rest = [(np.array([t_end]), y_end[None])] if samples is None else []
    parts = [(at_start, np.repeat(y0[None], at_start.size, axis=0)), *parts, *rest]
    outcome = _OUTCOMES[code]
    empty = Crossing(np.empty(0), np.empty(0, dtype=int), np.empty((0, y0.size)))
    crossings = Crossing(*(np.concatenate(pieces) for pieces in zip(empty, *crossings, strict=True)))
    return Trajectory(
        t=np.concatenate([t for t, _ in parts]),
        y=np.concatenate([y for _, y in parts]),
        t_end=float(t_end),
        y_end=y_end,
        crossings=crossings,
        outcome=outcome,
        advice=_ADVICE[outcome].format(steps=steps, min_step=settings.min_step),
        steps=steps,
        rejected=rejected,
    )


def _polynomial(dense, theta):
    """The interpolant at the fraction theta of a step, from its five coefficients (first axis)."""
    r0, r1, r2, r3, r4 = dense
    return r0 + theta * (r1 + (1 - theta) * (r2 + theta * (r3 + (1 - theta) * r4)))
