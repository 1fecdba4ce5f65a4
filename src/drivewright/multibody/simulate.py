"""Motion over time: kinematics of a mechanism whose drives leave it no freedom, dynamics of any other."""

import math
from dataclasses import dataclass

import numpy as np

from drivewright._jit import inner, outer, plain
from drivewright.errors import DoesNotAssemble
from drivewright.multibody.assembly import Assembly, at, split
from drivewright.multibody.dynamics import pose
from drivewright.multibody.kinematics import move
from drivewright.multibody.loads import SLOWEST, gap_of
from drivewright.multibody.system import System, motion
from drivewright.numerics.ode import Event, integrate
from drivewright.numerics.radau import integrate_stiff

GEAR = 1e-3  # absolute over relative tolerance, at lengths and angles of the size of 1
GRID = 720  # samples of a turn where the drives leave no freedom and so no steps to report
NEAR = 0.2  # a coordinate that is farther from where its rate led to is on another assembly [m], [rad]
SHORTEST = 1e-9  # part of the way below which a drive that finds no way on is stuck


@dataclass(frozen=True)
class Settings:
    """How to integrate.  `max_step` [s] None: a hundredth of a turn of the drive.  method: "dopri5", or "radau" for heavy damping."""

    rtol: float = 1e-8
    atol: float | None = None  # of positions [m] and angles [rad]; rates get it times 10 times the drive's speed
    max_step: float | None = None
    min_step: float = 0.0
    max_steps: int = 10_000_000
    method: str = "dopri5"
    per_step: int = 1


@dataclass(frozen=True)
class Stretch:
    """States y (m, n) at the times t (m,) of one system, that is of one split of the coordinates; the end of it is in `t_end`, `y_end`."""

    system: System
    t: np.ndarray
    y: np.ndarray
    t_end: float
    y_end: np.ndarray


@dataclass(frozen=True)
class Run:
    """A motion: stretches one after the other, the impacts (time, number of the pin, speed of approach), and how it ended."""

    assembly: Assembly
    stretches: tuple
    impacts: np.ndarray  # (k, 3)
    advice: str
    steps: int

    @property
    def outcome(self):
        return "partial" if self.advice else "complete"

    @property
    def end(self):
        """(system, time, state) at the end."""
        last = self.stretches[-1]
        return last.system, last.t_end, last.y_end


def simulate(assembly, duration, settings=Settings(), *, samples=None, state=None, start=0.0):
    """`Run` of an assembly over `duration` [s] from its start, or from a `state` of its system at time `start`.

    `samples`: the times at which states are wanted; without them every accepted step, `settings.per_step` points of each.
    """
    if assembly.freedom == 0:
        turns = max(duration * speed_of(assembly) / (2 * np.pi), 1.0)
        grid = np.linspace(start, start + duration, 1 + math.ceil(GRID * turns))
        times = grid if samples is None else np.asarray(samples, float)
        return _follow(assembly, times, start + duration)
    system = assembly.system
    y = assembly.state if state is None else touching(system, start, np.array(state, float))
    if duration == 0:
        return Run(assembly, (Stretch(system, np.array([start]), y[None], start, y),), np.zeros((0, 3)), "", 0)
    t, stretches, impacts, steps, advice = start, [], [np.zeros((0, 3))], 0, ""
    while True:
        inside = None if samples is None else samples[(samples > t) | (t == start)]
        run = _integrate(system, t, start + duration, y, settings, steps, inside, speed_of(assembly))
        stretches.append(Stretch(system, run.t, run.y, run.t_end, run.y_end))
        impacts.append(_impacts(system, run))
        t, y, steps, advice = run.t_end, run.y_end, steps + run.steps, run.advice
        if run.outcome != "event":
            return Run(assembly, tuple(stretches), np.concatenate(impacts), advice, steps)
        system, y = resplit(system, t, y)


def touching(system, t, y):
    """A state in which every pin that begins within its wall remembers an approach, the slowest: without one the wall would not hold it."""
    work = at_state(system, t, y)
    for n, contact in enumerate(system.contacts):
        if y[contact.memory] <= 0.0 <= plain(gap_of)(system, work, n):
            y[contact.memory] = SLOWEST
    return y


def _integrate(system, t, t1, y, settings, steps, samples, speed):
    watch = [Event(-1, terminal=True), *[Event(switches=True)] * len(system.contacts)]
    longest = settings.max_step or (2 * np.pi / speed / 100 if speed else np.inf)
    solve = integrate_stiff if settings.method == "radau" else integrate
    return solve(motion(system), t, t1, y, settings.rtol, tolerances(system, settings, speed), samples=samples, watch=watch,
                 max_steps=max(settings.max_steps - steps, 0), max_step=longest, min_step=settings.min_step,
                 per_step=settings.per_step)


def speed_of(assembly):
    """Angular speed of the fastest drive at the start [rad/s]; 0 without one."""
    return float(np.max(np.abs(assembly.start.v[assembly.system.driven.coordinate]), initial=0.0))


def tolerances(system, settings, speed):
    """Absolute tolerance of every component of the state: rates get ten times the speed times that of the positions, memories none."""
    stored, free = len(system.stored), len(system.independent)
    atol = settings.atol or settings.rtol * GEAR
    memories = len(system.contacts) + int(np.sum(system.contacts.bristle != system.contacts.memory))
    values = np.concatenate([np.full(stored, atol), np.full(free, 10 * max(speed, 1.0) * atol), np.full(memories, 1.0)])
    for contact in system.contacts:
        if contact.bristle != contact.memory:
            values[contact.bristle] = atol
    return values


def _impacts(system, run):
    """Touches among the events: those after which a pin remembers its speed of approach."""
    t, index, y = run.crossings
    rows, last = [], np.zeros(len(system.contacts))
    for time, pin, state in zip(t, index - 1, y, strict=True):
        if pin >= 0:
            memory = state[system.contacts[pin].memory]
            if memory > 0.0 and memory != last[pin]:
                rows.append((time, pin, memory))
            last[pin] = memory
    return np.array(rows).reshape(-1, 3)


def resplit(system, t, y):
    """(system, state) with the coordinates split anew at a state."""
    work = at_state(system, t, y)
    fresh = split(system, work.coordinates.q, t)
    return fresh, restated(system, t, y, fresh)


def restated(system, t, y, other):
    """A state of one split of the coordinates as a state of another one."""
    work = at_state(system, t, y)
    memory = y[len(system.stored) + len(system.independent):]
    return np.concatenate([work.coordinates.q[system.stored], work.coordinates.v[other.independent], memory])


def at_state(system, t, y):
    """`Work` of a state: loops closed, rates of all coordinates."""
    moving = motion(system)
    if not settle_at(moving.system, moving.work, t, y):
        raise DoesNotAssemble(f"the loops do not close at t = {t:.6g} s")
    return moving.work


@inner
def settled(system, work, t, y):
    """Coordinates and rates of a state in `work`; False where the loops cannot be closed."""
    closed = pose(system, work, t, y)
    move(system, work)
    return closed


@outer
def settle_at(system, work, t, y):
    """`settled`, to be called from Python."""
    return settled(system, work, t, y)


# -------------------------------------------------------------------------------------------------------------- no freedom


def _follow(assembly, times, end):
    """Kinematics: the dependent coordinates at the times, each from the one before."""
    system = assembly.system
    y, moving = assembly.state.copy(), motion(system)
    ways = np.append(times, end)
    states = np.empty((len(ways), len(y)))
    done = follow_all(moving.system, moving.work, ways, y, np.empty_like(y), states)
    if done < end:
        raise DoesNotAssemble(_stuck(assembly, y, done, end))
    stretch = Stretch(system, times, states[:-1], end, states[-1])
    return Run(assembly, (stretch,), np.zeros((0, 3)), "", len(times))


@outer
def follow_all(system, work, times, y, trial, states):
    """`follow` from time 0 through all times, filling `states`; the time reached."""
    t = 0.0
    for n in range(times.size):
        done = follow(system, work, t, times[n], y, trial)
        if done < times[n]:
            return done
        t = times[n]
        for k in range(y.size):
            states[n, k] = y[k]
    return t


@inner
def follow(system, work, t, end, y, trial):
    """Carry the dependent coordinates in y on to the time `end`, in steps small enough to stay on the same assembly; the time reached.

    trial is scratch, of the size of y.
    """
    step = end - t
    settled(system, work, t, y)
    while t != end:
        for k in range(system.stored.size):
            trial[k] = y[k] + step * work.coordinates[system.stored[k]].v
        closed = settled(system, work, t + step, trial)
        far = 0.0
        for k in range(system.stored.size):
            far = max(far, abs(work.coordinates[system.stored[k]].q - trial[k]))
        if closed and far < NEAR:
            t = end if abs(end - t - step) <= 1e-15 * abs(end) else t + step
            for k in range(system.stored.size):
                y[k] = work.coordinates[system.stored[k]].q
            step = end - t
        elif abs(step) < SHORTEST * max(abs(end), 1e-9):
            return t
        else:
            settled(system, work, t, y)
            step *= 0.5
    return t


def _stuck(assembly, y, t, end):
    """Message on a drive that cannot go on."""
    work = at(assembly.system, np.zeros(len(assembly.start.q)), t)
    told = []
    for drive, driven in zip(assembly.model.drives, assembly.system.driven, strict=True):
        value = driven.sign * work.coordinates.q[driven.coordinate]
        turning = any(link.turn == driven.coordinate for link in assembly.tree.links)
        told.append(f"{drive.joint!r} at {np.degrees(value) % 360:.2f} deg" if turning else f"{drive.joint!r} at {1e3 * value:.4g} mm")
    joints = sorted({assembly.wide.joints[row.joint].name for row in assembly.system.rows})
    return (f"the mechanism cannot go on beyond t = {t:.6g} s of {end:.6g} s, drive {' and '.join(told)}: the loop through joint"
            f"{'s' if len(joints) > 1 else ''} {', '.join(map(repr, joints))} does not close there. Change a length, or drive over less")
