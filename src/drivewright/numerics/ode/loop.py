"""Initial value problems y' = f(t, y), by any method of `methods`, with samples, events and limits.

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
"""

from collections.abc import Callable, Sequence
from contextvars import ContextVar, Token
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from drivewright._jit import formula_of, formulas_of, plain
from drivewright._typing import ArrayLike, Floats, Ints
from drivewright.errors import InputError, SolverError
from drivewright.numerics.ode import advancing
from drivewright.numerics.ode.advancing import GOES_ON
from drivewright.numerics.ode.dense_output import polynomial
from drivewright.numerics.ode.locating import NOTE, STOP, SWITCH, EventRules, StepBatch
from drivewright.numerics.ode.method import ERROR, STEP, TIME, Method, StepControl
from drivewright.numerics.ode.methods import METHODS
from drivewright.numerics.ode.system import Functions, NoEvents, events, rate, switch, with_jacobian

_BATCH = 500

_ADVICE = {
    "finished": "",
    "event": "",
    "max_steps": "the limit of {steps} steps is reached. Raise max_steps, loosen rtol, or look for a stiff or chattering part.",
    "min_step": "the step would fall below {min_step:.1e}. Look for a jump in the right-hand side or for a time constant far below "
    "the others; loosen rtol and atol, or stop at the jump with a terminal event.",
    "not_finite": "the right-hand side is not finite. Check the start and the parameters, or stop before the singular place with an event.",
}
_ADVICE_EQUAL_STEPS = "Too long steps of one size let the solution grow without bound: take a smaller max_step."
_OUTCOMES = ("max_steps", "finished", "event", "min_step", "not_finite")  # by code; a run that still goes on has met max_steps


class Event(NamedTuple):
    """What to watch for in one event function: rising (+1), falling (-1) or any (0) sign change.

    `terminal`: it ends the run.  `switches`: the run starts anew from the state that the system's `switch` makes of it.
    """

    direction: int = 0
    terminal: bool = False
    switches: bool = False

    @property
    def effect(self) -> int:
        """NOTE, STOP or SWITCH."""
        return STOP if self.terminal else SWITCH if self.switches else NOTE


class EventCrossing(NamedTuple):
    """An event that happened: time just after the sign change, number of the event function, state (n,) (after it switched)."""

    t: float
    event: int
    y: Floats


class EventCrossings(NamedTuple):
    """All events of a run, in order of time: `EventCrossing` in columns."""

    t: Floats  # (k,)
    event: Ints  # (k,)
    y: Floats  # (k, n)


@dataclass(frozen=True)
class Trajectory:
    """The solution at the times t (m,): y (m, n), up to t_end, y_end where the run ended.

    outcome: "finished", "event" (a terminal one), or, with `advice`, why it is partial: "max_steps", "min_step", "not_finite".
    """

    t: Floats
    y: Floats
    t_end: float
    y_end: Floats
    crossings: EventCrossings
    outcome: str
    advice: str
    steps: int
    rejected: int

    @property
    def events(self) -> tuple[EventCrossing, ...]:
        """The events one by one, in order of time."""
        return tuple(EventCrossing(float(t), int(event), y) for t, event, y in zip(*self.crossings, strict=True))

    def checked(self) -> "Trajectory":
        """This trajectory, or SolverError carrying it where it is partial."""
        if self.advice:
            raise SolverError(f"integration stopped at t = {self.t_end:.6g}: {self.advice}", partial=self)
        return self


def integrate(
    system: tuple[object, ...],
    t0: float,
    t1: float,
    y0: ArrayLike,
    rtol: float = 1e-8,
    atol: ArrayLike = 1e-10,
    *,
    method: str | Method = "dopri5",
    samples: ArrayLike | None = None,
    watch: Sequence[Event] = (),
    per_step: int = 1,
    max_steps: int = 100_000,
    max_step: float = np.inf,
    min_step: float = 0.0,
    first_step: float | None = None,
) -> Trajectory:
    """Integrate y' = rate(system, t, y) from y(t0) = y0 to t1 > t0; returns a Trajectory, a partial one with advice.

    `method`: "dopri5" (explicit), "radau" (implicit, for stiff systems), "rk4" (steps of one size, `max_step`), or a `Method`.
    The error of a step, over atol + rtol |y| (atol a number or one per component), is kept below 1 in the root mean square.
    `samples`: ascending times in [t0, t1] at which y is wanted; without them, `per_step` points of every step, its start first.
    `watch`: one Event per value that `events` writes.  Two sign changes of one event function within a step are found where they
    show in the step's middle or at the vertex of the parabola through it; else limit max_step.
    Without `first_step` a careful one is chosen.
    """
    times = None if samples is None else np.asarray(samples, dtype=float)
    chosen, start = method_by_name(method), np.array(y0, dtype=float)
    _check(system, t0, t1, start, times, watch, rtol, atol, chosen, max_step)
    control = _control(t0, t1, start, rtol, atol, max_step, min_step)
    problem = Problem(system, t0, start, control, chosen, times, tuple(watch), per_step, max_steps, first_step)
    solver = _solver.get()
    return solver(problem) if solver else solve(problem)


class Problem(NamedTuple):
    """An initial value problem and how it is to be solved, see `integrate`."""

    system: tuple[object, ...]
    t0: float
    y0: Floats  # (n,)
    control: StepControl
    method: Method
    samples: Floats | None
    watch: tuple[Event, ...]
    per_step: int
    max_steps: int
    first_step: float | None


_solver: ContextVar[Callable[[Problem], Trajectory] | None] = ContextVar("solver of initial value problems", default=None)


def solving_with(solver: Callable[[Problem], Trajectory] | None) -> Token[Any]:
    """Let `integrate` hand its problems to a solver, in this context, until the token is given back."""
    return _solver.set(solver)


def solve(problem: Problem) -> Trajectory:
    """The Trajectory of a problem, step by step in this thread."""
    return finish(RunUnderWay(problem))


def finish(run: "RunUnderWay") -> Trajectory:
    """The Trajectory of a run, whose remaining steps are taken in this thread."""
    while run.goes_on:
        batch = run.batch(min(_BATCH, run.steps_left))
        run.take(batch, *run.advance(batch))
    return run.trajectory()


class RunUnderWay:
    """A run between two batches of steps: where it is, and what was kept of its steps."""

    def __init__(self, problem: Problem):
        self.problem, self.y, self.work = problem, problem.y0.copy(), problem.method.workspace(problem.y0.size)
        self.systems = _parts(problem.system, problem.watch, problem.method, problem.control)
        self.rules, watched = _rules(problem.watch), len(problem.watch)
        self.clock, self.values, self.scratch = np.empty(3), np.empty(watched), (np.empty(self.y.size), *np.empty((3, watched)))
        self.clock[TIME], self.clock[STEP], self.clock[ERROR] = problem.t0, 0.0, 1e-4
        self.code, *_ = self.advance(self.batch(0))
        self.clock[STEP] = problem.first_step or self.clock[STEP]
        self.parts: list[tuple[Floats, Floats]] = []
        self.crossings: list[EventCrossings] = []
        self.steps = self.rejected = 0

    @property
    def goes_on(self) -> bool:
        """Whether there are steps to take."""
        return self.code == GOES_ON and self.steps_left > 0

    @property
    def steps_left(self) -> int:
        """How many steps may still be taken."""
        return self.problem.max_steps - self.steps

    def batch(self, size: int) -> StepBatch:
        """Room for so many steps."""
        return _batch(size, self.y.size, len(self.values), self.scratch)

    def advance(self, batch: StepBatch) -> tuple[int, int, int, int]:
        """Take the steps of a batch in this thread, see `advancing.advance`."""
        kernel = plain(advancing.advance) if isinstance(self.problem.system, Functions) else advancing.advance
        return kernel(self.work, *self.systems, self.problem.control, self.rules, self.clock, self.y, self.values, batch)

    def take(self, batch: StepBatch, code: int, done: int, refused: int, hits: int) -> None:
        """Keep what is wanted of a batch of steps."""
        times, end = self.problem.samples, self.clock[TIME]
        self.code, self.steps, self.rejected = code, self.steps + done, self.rejected + refused
        self.crossings.append(_crossings(batch, hits))
        self.parts.append(_points(batch, done, end, self.problem.per_step) if times is None else _sampled(batch, done, times, end))

    def trajectory(self) -> Trajectory:
        """What the run came to."""
        t0, y0, control, method, times = (getattr(self.problem, name) for name in ("t0", "y0", "control", "method", "samples"))
        end = self.clock[TIME], self.y
        return _trajectory(t0, y0, self.parts, times, *end, self.crossings, self.code, control, self.steps, self.rejected, method)


def kernel_of_steps(system: tuple[object, ...], watch: Sequence[Event] = (), method: str | Method = "dopri5") -> Callable[[], object]:
    """What compiles the kernel with which `integrate` takes its steps; how many states there are does not matter for that."""
    chosen, y = method_by_name(method), np.zeros(1)
    control = _control(0.0, 1.0, y, 1e-6, 1e-6, np.inf, 0.0)
    system, event_system, switch_system = _parts(system, watch, chosen, control)
    batch = _batch(1, y.size, len(watch), (np.empty(y.size), *np.empty((3, len(watch)))))
    clock, values = np.empty(3), np.empty(len(watch))
    advance: Any = advancing.advance
    systems = system, event_system, switch_system
    return partial(advance.compile_for, chosen.workspace(y.size), *systems, control, _rules(watch), clock, y, values, batch)


def _parts(system, watch, method, control):
    """The system as the method needs it; what stands for it where events are watched, and where they switch: one type for all runs with
    events, whether these switch or not, so that the steps are compiled once."""
    event_system = system if watch else NoEvents(0)
    switch_system = system if watch and type(system) in formulas_of(switch) else NoEvents(0)
    return with_jacobian(system, control.rtol, control.atol) if method.needs_jacobian else system, event_system, switch_system


def method_by_name(method: str | Method) -> Method:
    """The method of this name, or the `Method` itself."""
    if isinstance(method, Method):
        return method
    if method not in METHODS:
        raise InputError(f"integrate: method = {method!r} is not known; take one of {', '.join(sorted(METHODS))}.")
    return METHODS[method]


def _check(system, t0, t1, y, samples, watch, rtol, atol, method, max_step):
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
    if not method.adaptive and not 0.0 < max_step < np.inf:
        raise InputError(f"integrate: method {method.name!r} takes steps of one size; give it as max_step.")


def _control(t0, t1, y, rtol, atol, max_step, min_step):
    tolerance = np.broadcast_to(np.asarray(atol, dtype=float), y.shape).copy()
    least = max(min_step, 16 * np.finfo(float).eps * max(abs(t0), abs(t1)))
    return StepControl(float(t1), float(rtol), tolerance, float(max_step), least)


def _rules(watch):
    directions, effects = np.array([[e.direction, e.effect] for e in watch], dtype=np.int64).reshape(-1, 2).T.copy()
    return EventRules(directions, effects, any(event.switches for event in watch))


def _batch(size, states, watched, scratch):
    """Arrays for so many steps: of each event function at most two hits in a step."""
    hits = 2 * size * watched
    return StepBatch(np.empty((size, 2)), np.empty((size, 5, states)), np.empty((hits, 3)), np.empty((hits, states)), *scratch)


def _crossings(batch, hits):
    """The events of a batch in order of time; of equal ones the one that ended the step stays last."""
    start, size = batch.steps[batch.hits[:hits, 0].astype(int)].T
    t = start + batch.hits[:hits, 2] * size
    order = np.argsort(t, kind="stable")
    return EventCrossings(t[order], batch.hits[order, 1].astype(int), batch.hit_states[order])


def _points(batch, done, end, count):
    """(t, y) of a batch of steps at `count` evenly spaced points of each, the start being the first and the end left out."""
    start, size = batch.steps[:done].T
    if count == 1:
        return start.copy(), batch.dense[:done, 0].copy()
    length = np.append(start[1:], end)[:done] - start  # shorter than the size where a switch cut the step
    theta = (length / size)[:, None] * np.arange(count) / count
    y = polynomial(np.moveaxis(batch.dense[:done], 1, 0)[:, :, None], theta[:, :, None])
    return (start[:, None] + theta * size[:, None]).ravel(), y.reshape(done * count, batch.dense.shape[-1])


def _sampled(batch, done, samples, end):
    """(t, y) of a batch of steps at the samples up to `end`."""
    start, size = batch.steps[:done].T
    t = samples[(samples > (start[0] if done else end)) & (samples <= end)]
    row = np.searchsorted(start, t, side="left") - 1
    theta = (t - start[row]) / size[row]
    return t, polynomial(np.moveaxis(batch.dense[row], 1, 0), theta[:, None])


def _trajectory(t0, y0, parts, samples, t_end, y_end, crossings, code, control, steps, rejected, method):
    # The samples of a batch lie in (start, end]; without samples the start of each step is given and the end is missing.
    at_start = samples[samples == t0] if samples is not None else np.empty(0)
    rest = [(np.array([t_end]), y_end[None])] if samples is None else []
    parts = [(at_start, np.repeat(y0[None], at_start.size, axis=0)), *parts, *rest]
    outcome = _OUTCOMES[code]
    advice = _ADVICE[outcome].format(steps=steps, min_step=control.min_step)
    if outcome == "not_finite" and not method.adaptive:
        advice = f"{advice} {_ADVICE_EQUAL_STEPS}"
    empty = EventCrossings(np.empty(0), np.empty(0, dtype=int), np.empty((0, y0.size)))
    crossings = EventCrossings(*(np.concatenate(pieces) for pieces in zip(empty, *crossings, strict=True)))
    return Trajectory(
        t=np.concatenate([t for t, _ in parts]),
        y=np.concatenate([y for _, y in parts]),
        t_end=float(t_end),
        y_end=y_end,
        crossings=crossings,
        outcome=outcome,
        advice=advice,
        steps=steps,
        rejected=rejected,
    )
