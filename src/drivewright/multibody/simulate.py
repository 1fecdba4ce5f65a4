"""Motion over time: kinematics of a mechanism whose drives leave it no freedom, dynamics of any other."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from drivewright._jit import plain
from drivewright._typing import Floats
from drivewright.errors import DoesNotAssemble, counted
from drivewright.multibody.assembly import Assembly
from drivewright.multibody.chart import outside_fold, solve_kinematics
from drivewright.multibody.compile_model import compile_model
from drivewright.multibody.continuation import Stretch, continue_motion, kernels_of_continuation
from drivewright.multibody.drive_positions import drive_positions
from drivewright.multibody.dynamics import FIRST_PIN, begin_sliding
from drivewright.multibody.forces.joint_friction import JointFrictions
from drivewright.multibody.forces.pin_contact import LASTING, penetration
from drivewright.multibody.forces.resting_friction import balance_sticking
from drivewright.multibody.locking import locked_message
from drivewright.multibody.model import MultibodyModel
from drivewright.multibody.observe import FIELDS, kernels_of_observation, observe
from drivewright.multibody.partition import evaluate_at, partition_coordinates
from drivewright.multibody.passages import Passage, passage, smallest_singular_values
from drivewright.multibody.singular import Outlook, distance_to_singularity, look_ahead
from drivewright.multibody.system import System, Work, joints_with_friction, memory_size, motion, no_chart
from drivewright.multibody.tree import build_tree, expand
from drivewright.numerics.ode import Event, integrate, loop
from drivewright.stops import Stop, note_stop

GEAR = 1e-3  # absolute over relative tolerance, at lengths and angles of the size of 1
WARY, CAREFUL = 3.0, 0.2  # length of a leg towards a singular position, and longest step in it, over the time until it is reached
STRETCHED = 1e-4  # smallest singular value of loops in which a drive is stuck
MOST_STATES = 1_500_000  # that are kept of kinematics: about a kilobyte each with all that is observed of them
MOST_KEPT = 750_000  # that are kept of a run with freedom, whose ensemble is observed side by side: about three kilobytes
FULL = f"{MOST_KEPT / 1e6:g} million states reach the memory limit of a run; reduce turns, or raise the tolerances"
ROUNDING = 1e-12  # of the number of turns
SAMPLES = 720  # states of a turn where the drives leave no freedom and so no steps to report


@dataclass(frozen=True)
class Settings:
    """How to integrate.  `max_step` [s] None: a hundredth of a turn of the drive, without one so short that the run has `samples` states.
    `samples`: states of a turn, or of a run without turns, where drives leave no freedom.  method: "dopri5", or "radau" for heavy damping.

    "rk4" takes `max_step` for every step, which contacts in pins need well below a thousandth of a turn, and disregards rtol and atol.
    """

    rtol: float = 1e-8
    atol: float | None = None  # of positions [m] and angles [rad]; rates get it times 10 times the drive's speed
    max_step: float | None = None
    min_step: float = 0.0
    max_steps: int = 10_000_000
    method: str = "dopri5"
    per_step: int = 1
    singular: str = "smooth"  # or "stop": end the run in the first singular position
    samples: int = SAMPLES


class Leg(NamedTuple):
    """Until when a run is integrated at once, and how long its steps may be: short ones on the way to a singular position."""

    until: float
    max_step: float = np.inf


@dataclass(frozen=True)
class Run:
    """A motion up to the given time `until`: stretches one after the other, the impacts (time, number of the pin, speed of
    approach), with `advice` why it ended before, and the singular positions on the way."""

    assembly: Assembly
    stretches: tuple[Stretch, ...]
    impacts: Floats  # (k, 3)
    advice: str
    steps: int
    until: float
    passages: tuple[Passage, ...] = ()
    refined_until: float = -np.inf

    def __post_init__(self):
        note_stop(self.stop)

    @property
    def outcome(self) -> str:
        """complete, or partial where the run ended before its time."""
        return "partial" if self.advice else "complete"

    @property
    def stop(self) -> Stop | None:
        """The `Stop` of a run that ended before its time, else None."""
        return Stop(f"the run ends at t = {self.end[1]:.6g} s of {self.until:.6g} s", self.advice) if self.advice else None

    @property
    def end(self) -> tuple[System, float, Floats]:
        """(system, time, state) at the end."""
        last = self.stretches[-1]
        return last.system, last.t_end, last.y_end


def simulate(
    assembly: Assembly,
    duration: float,
    settings: Settings = Settings(),
    *,
    samples: Floats | None = None,
    state: Floats | None = None,
    start: float = 0.0,
) -> Run:
    """`Run` of an assembly over `duration` [s] from its start, or from a `state` of its system at time `start`.

    `samples`: the times at which states are wanted; without them every accepted step, `settings.per_step` points of each.
    """
    if assembly.freedom == 0:
        turns = max(duration * fastest_drive_speed(assembly) / (2 * np.pi), 1.0)
        states = np.ceil(settings.samples * turns * (1 - ROUNDING))
        count = counted(states, MOST_STATES, "states of the run", "reduce turns, samples_per_turn or duration")
        grid = np.linspace(start, start + duration, 1 + count)
        times = grid if samples is None else np.asarray(samples, float)
        return _driven(assembly, times, start + duration, settings, samples is None)
    system = assembly.system
    y = assembly.state if state is None else touching(system, start, np.array(state, float))
    y = rubbing(system, start, y)
    if duration == 0:
        return Run(assembly, (Stretch(system, np.array([start]), y[None], start, y),), np.zeros((0, 3)), "", 0, start)
    return _legs(assembly, start, start + duration, y, settings, samples)


def _legs(assembly, t, end, y, settings, samples):
    """The `Run` of a mechanism with freedom, leg by leg: to where the coordinates are split anew, or a chart leads across a fold."""
    system, leg = assembly.system, _leg(assembly.system, t, y, end)
    longest = (end - t) * settings.per_step / settings.samples  # of a run without turns
    stretches, impacts, passages, steps = [], [np.zeros((0, 3))], [], 0
    while True:
        inside = None if samples is None else samples[(samples <= leg.until) & ((samples > t) | (not stretches))]
        run = _integrate(system, t, leg, y, settings, steps, inside, fastest_drive_speed(assembly), longest)
        goes_on = run.outcome == "event" or (not run.advice and run.t_end < end)
        kept = slice(None, -1) if goes_on and samples is None else slice(None)  # the next stretch begins with the state at the end
        stretches.append(Stretch(system, run.t[kept], run.y[kept], run.t_end, run.y_end))
        impacts.append(_impacts(system, run))
        passages += _passages(system, run)
        t, y, steps, advice = run.t_end, run.y_end, steps + run.steps, run.advice
        if run.outcome == "max_steps" and steps < settings.max_steps:
            advice = FULL
        if run.outcome == "min_step" and _stretched(system, t, y):
            advice = _stuck(assembly, t, end)
        if run.outcome == "not_finite" and len(joints_with_friction(system)):
            advice = locked_message(assembly, system, t, y) or advice
        if goes_on:
            system, y, leg = _onward(system, t, y, end, run.outcome == "event")
            if len(system.chart.offsets) and stops_at_folds(system, settings):
                goes_on, advice = False, stop_advice(system.chart.origin_time, settings)
        if not goes_on:
            return Run(assembly, _joined(stretches), np.concatenate(impacts), advice, steps, end, tuple(passages))


def _stretched(system, t, y):
    """Whether a drive has brought a loop so far that it hardly closes: rates grow without bound there, and steps become too short."""
    return len(system.driven) > 0 and len(system.rows) > 0 and smallest_singular_values(system, np.array([t]), y[None])[0] < STRETCHED


def _joined(stretches):
    """The stretches with neighbours of one and the same system made one."""
    groups = []
    for part in stretches:
        if groups and groups[-1][-1].system is part.system:
            groups[-1].append(part)
        else:
            groups.append([part])
    return tuple(
        Stretch(
            group[0].system,
            np.concatenate([part.t for part in group]),
            np.concatenate([part.y for part in group]),
            group[-1].t_end,
            group[-1].y_end,
        )
        for group in groups
    )


def _onward(system, t, y, end, weak):
    """(system, state, `Leg`) with which a run goes on from the end of a leg, where the split of its coordinates may have become weak."""
    if not weak:
        return system, y, _leg(system, t, y, end)
    outlook = look_ahead(system, t, y) if len(system.chart.offsets) == 0 else Outlook(None, np.inf)
    if outlook.charted:
        return *outlook.charted, Leg(end)
    system, y = repartition(system, t, y)
    leg = _leg(system, t, y, end)
    return system, y, Leg(min(leg.until, t + WARY * outlook.time), min(leg.max_step, CAREFUL * outlook.time))


def _leg(system, t, y, end):
    """The `Leg` from a state on.  Loops without drives may move so evenly that a step would lead over a singular position: there a leg is
    as long as the bodies move by half the way to one, or about a radian, or the mechanism's length, and a step a part of it.  Pins with
    play step finely."""
    if len(system.rows) == 0 or len(system.driven) or len(system.contacts):
        return Leg(end)
    bodies, sizes = observe(system, [t], y[None]).bodies[0], [system.length, system.length, 1.0]
    rate, gain = (np.max(np.abs(bodies[:, first : first + 3]) / sizes) for first in map(FIELDS.index, ("vx", "ax")))
    way = min(1.0, distance_to_singularity(system, t, y))
    pace = rate / way + np.sqrt(gain / way)
    return Leg(min(end, t + 1.0 / pace), CAREFUL / pace) if pace > 0 else Leg(end)


def stops_at_folds(system: System, settings: Settings) -> bool:
    """Whether a run ends in a singular position: where that was requested, or where ideal joints rub, whose forces have no limit there."""
    return settings.singular == "stop" or len(joints_with_friction(system)) > 0


def stop_advice(time: float, settings: Settings) -> str:
    """Advice of a run that ends in a singular position."""
    if settings.singular == "stop":
        return (
            f'the mechanism reaches a singular position at t = {time:.6g} s, where simulate.singular = "stop" ends the run; '
            'set simulate.singular = "smooth" to pass through it'
        )
    return (
        f"the mechanism reaches a singular position at t = {time:.6g} s, where the joint forces and their friction grow without bound. "
        "Remove the friction of the ideal joints, give the pins clearance, or end the run before that time"
    )


def _passages(system, run):
    """`Passage` of each singular position that the run goes through in the chart of its system."""
    t, index, y = run.crossings
    return [passage(system, t[k], y[k]) for k in np.flatnonzero(index == FIRST_PIN - 1)]


def states_outside_folds(run: Run, start: float = -np.inf, most: int | None = None) -> list[tuple[System, Floats, Floats]]:
    """(system, times, states) of each stretch of a run from a time on, without the middles of folds; at most so many of all, if told."""
    clear = [np.flatnonzero((part.t >= start) & outside_fold(part.system, part.t, part.y)) for part in run.stretches]
    counts = np.cumsum([0, *map(len, clear)])
    stride = max(1, -(-counts[-1] // most)) if most else 1
    chosen = (rows[-before % stride :: stride] for rows, before in zip(clear, counts[:-1], strict=True))  # evenly across the stretches
    return [(part.system, part.t[rows], part.y[rows]) for part, rows in zip(run.stretches, chosen, strict=True) if len(rows)]


def touching(system: System, t: float, y: Floats) -> Floats:
    """A state in which every pin that begins within its wall, without an approach to remember, is in lasting contact."""
    work = work_at_state(system, t, y)
    for n, contact in enumerate(system.contacts):
        if y[contact.memory] == 0.0 <= plain(penetration)(system, work, n):
            y[contact.memory] = LASTING
    return y


def rubbing(system: System, t: float, y: Floats) -> Floats:
    """A state whose joints with friction slide where they move, and stick where they do not, unless it remembers whether they do."""
    frictions = system.frictions
    if isinstance(frictions, JointFrictions) and not np.any(y[[*frictions.table.sliding, *frictions.table.relaxation]]):
        moving = motion(system)
        begin_sliding(*moving, t, y, frictions, False)
        balance_sticking(moving, t, y, frictions)
    return y


def _integrate(system, t, leg, y, settings, steps, samples, speed, longest):
    most = settings.max_steps if samples is not None else min(settings.max_steps, MOST_KEPT // settings.per_step)
    longest = min(leg.max_step, settings.max_step or (2 * np.pi / speed / 100 if speed else longest))
    return integrate(
        motion(system),
        t,
        leg.until,
        y,
        settings.rtol,
        tolerances(system, settings, speed),
        method=settings.method,
        samples=samples,
        watch=_watched(system),
        max_steps=max(most - steps, 0),
        max_step=longest,
        min_step=settings.min_step,
        per_step=settings.per_step,
    )


def _watched(system):
    """What to do at each of `dynamics.event_values`."""
    pins, switches = len(system.contacts), Event(switches=True)
    rising = Event(1, switches=True)
    rubbing = len(joints_with_friction(system))
    return [Event(-1, terminal=True), Event(), *[switches] * pins, *[rising] * pins, *[switches] * pins, *[rising] * rubbing]


def unassembled(model: MultibodyModel) -> System:
    """The `System` of a model before it is assembled: its kernels have the same types."""
    expanded = expand(model)
    return compile_model(expanded, build_tree(expanded))


def kernels_of_run(system: System, settings: Settings | None = None) -> list[Callable[[], object]]:
    """What compiles the kernels that a run comes to last: with settings that of the steps of a simulation, then those of the observation of
    its states and of the kinematics."""
    steps = [loop.kernel_of_steps(motion(system), _watched(system), settings.method)] if settings else []
    return [*steps, *kernels_of_observation(system), *kernels_of_continuation(system)]


def fastest_drive_speed(assembly: Assembly) -> float:
    """Angular speed of the fastest drive at the start [rad/s]; 0 without one."""
    return float(np.max(np.abs(assembly.start.v[assembly.system.driven.coordinate]), initial=0.0))


def tolerances(system: System, settings: Settings, speed: float) -> Floats:
    """Absolute tolerance of every component of the state: rates get ten times the speed times that of the positions, memories none."""
    atol = settings.atol or settings.rtol * GEAR
    memories = memory_size(system)
    stored, free = np.full(len(system.stored), atol), np.full(len(system.independent), atol)
    values = np.concatenate([stored, 10 * max(speed, 1.0) * free, np.full(memories, 1.0)])
    for contact in system.contacts:
        if contact.bristle != contact.memory:
            values[contact.bristle] = atol
    for friction in joints_with_friction(system):
        values[friction.deflection] = atol / friction.presliding
    return values


def _impacts(system, run):
    """Touches among the events: those after which a pin remembers its speed of approach."""
    t, index, y = run.crossings
    rows, last = [], np.zeros(len(system.contacts))
    for time, pin, state in zip(t, index - FIRST_PIN, y, strict=True):
        if 0 <= pin < len(system.contacts):
            memory = state[system.contacts[pin].memory]
            if memory > 0.0 and memory != last[pin]:
                rows.append((time, pin, memory))
            last[pin] = memory
    return np.array(rows).reshape(-1, 3)


def repartition(system: System, t: float, y: Floats) -> tuple[System, Floats]:
    """(system, state) with the coordinates split anew at a state."""
    work = work_at_state(system, t, y)
    fresh = partition_coordinates(system._replace(chart=no_chart()), work.coordinates.q, t)
    return fresh, convert_state(system, t, y, fresh)


def convert_state(system: System, t: float, y: Floats, other: System) -> Floats:
    """A state of one split of the coordinates as a state of another one."""
    work = work_at_state(system, t, y)
    memory = y[len(system.stored) + len(system.independent) :]
    return np.concatenate([work.coordinates.q[system.stored], work.coordinates.v[other.independent], memory])


def work_at_state(system: System, t: float, y: Floats) -> Work:
    """`Work` of a state: loops closed, rates of all coordinates."""
    moving = motion(system)
    if not solve_kinematics(moving.system, moving.work, t, y):
        raise DoesNotAssemble(f"the loops do not close at t = {t:.6g} s")
    return moving.work


# -------------------------------------------------------------------------------------------------------------- no freedom


def _driven(assembly, times, end, settings, refine):
    """Kinematics: the dependent coordinates at the times, each from the one before."""
    continuation = continue_motion(assembly.system, times, end, assembly.state, stops_at_folds(assembly.system, settings), refine)
    if continuation.outcome == "stuck":
        raise DoesNotAssemble(_stuck(assembly, continuation.reached, end))
    advice = stop_advice(continuation.reached, settings) if continuation.outcome == "stopped" else ""
    return Run(
        assembly, continuation.stretches, np.zeros((0, 3)), advice, len(times), end, continuation.passages, continuation.refined_until
    )


def _stuck(assembly, t, end):
    """Message on a drive that cannot go on."""
    work = evaluate_at(assembly.system, np.zeros(len(assembly.start.q)), t)
    positions = drive_positions(assembly, assembly.system, work)
    joints = sorted({assembly.expanded.joints[row.joint].name for row in assembly.system.rows})
    if t <= 0.0:
        return (
            f"the mechanism starts in a singular position, drive {' and '.join(positions)}: links of the loop through joint"
            f"{'s' if len(joints) > 1 else ''} {', '.join(map(repr, joints))} are collinear there, and the side to which they fold is "
            "undetermined. Start a few degrees away"
        )
    return (
        f"the mechanism cannot go on beyond t = {t:.6g} s of {end:.6g} s, drive {' and '.join(positions)}: the loop through joint"
        f"{'s' if len(joints) > 1 else ''} {', '.join(map(repr, joints))} does not close there. Change a length, or reduce "
        "the range of the drive"
    )
