"""Statistics of a run turn by turn: of the run itself where it repeats, else of an ensemble of runs that start almost alike."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from drivewright import cases
from drivewright._typing import Floats
from drivewright.errors import SolverError
from drivewright.multibody.analyses.simulation_model import TURN, SimulationModel, run_of
from drivewright.multibody.analyses.turns import RunNumbers, output_numbers, start_of_window, turn_ends, window_record
from drivewright.multibody.record import POINT_FIELDS, Record
from drivewright.multibody.simulate import Run, simulate
from drivewright.numerics.chaos import orbit_period
from drivewright.numerics.ensemble import Estimate, estimate, estimate_statistic
from drivewright.numerics.splines import hermite_cubics
from drivewright.result import Check, Value

SHIFT = 1e-3  # of the least clearance by which the starts of the members differ: below what is manufactured
SAME = 1e-6  # of its range to which place and rate of an output repeat themselves in a periodic motion
MOST_NAMED = 3  # statistics that have not settled
STILL = 1e-6  # part of the mechanism's length, or of its drive's speed, over which nothing moves that repeats itself


@dataclass(frozen=True)
class Statistics:
    """The members' numbers, and after how many turns the motion repeats itself (0: it does not, or there are no turns to compare)."""

    members: tuple[RunNumbers, ...]
    period: int

    def mean(self, name: str) -> Estimate:
        """Mean over the turns: every turn of every member is a sample."""
        if self._single(name):
            return self._alone(name)
        turns = self._turns(name)
        return _exact(turns.flat[0]) if np.ptp(turns) == 0.0 else estimate(turns)

    def of_run(self, name: str, turns: str = "") -> Estimate:
        """What a run of this length shows, a largest value for instance: every member is a sample.

        `turns` names the number of a turn by which it is judged whether it had settled; its own unless told.
        """
        turns = turns or name
        if self._single(turns):
            return self._alone(name)
        numbers = np.array([member.whole[name] for member in self.members if turns in member.turns])
        if np.ptp(numbers) == 0.0:  # not the chaotic part of the motion
            return _exact(numbers[0])
        settled = estimate_statistic(self._turns(turns), np.max).settled
        return replace(estimate_statistic(numbers[:, None], np.mean), settled=settled)

    def worst(self, name: str) -> float:
        """The largest of the members: for what a computation has missed."""
        return max(member.whole[name] for member in self.members)

    def _single(self, name):
        """Whether one run says it all: it repeats itself, or has no turns."""
        return self.period > 0 or not self.members[0].turns.get(name, np.empty(0)).size

    def _turns(self, name):
        return np.array([member.turns[name] for member in self.members if name in member.turns])  # a run may lack peaks

    def _alone(self, name):
        """Of a motion that repeats itself: exact to rounding; without turns there is no interval."""
        value = float(self.members[0].whole[name])
        reach = SAME * abs(value) if self.period else np.nan
        return Estimate(value, value - reach, value + reach, "periodic" if self.period else "", True, 1.0, 0.0)


def _exact(value):
    """Of what all turns and members share."""
    return Estimate(float(value), np.nan, np.nan, "", True, 1.0)


def settled_check(name: str, estimates: Iterable[Value], label: str = "Settled statistics") -> Check:
    """The check that the statistics of a run no longer drift: how many of them have settled, of all."""
    settled = [estimate.settled for estimate in estimates]
    message = (
        "number of statistics that no longer drift, of all estimated ones; raise simulate.turns or simulate.discard until all have settled"
    )
    return Check(name, float(sum(settled)), float(len(settled)), ">=", "-", message, label=label)


def unsettled(values: Mapping[str, Value]) -> tuple[str, ...]:
    """A finding that names the values which still drifted; none where all have settled."""
    names = [name for name, value in values.items() if not value.settled]
    listed = ", ".join(names[:MOST_NAMED]) + (f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else "")
    return (f"not settled, therefore not among the headline values: {listed}; raise simulate.turns or simulate.discard",) if names else ()


@lru_cache(maxsize=12)
def statistics(model: SimulationModel, numbers: Callable[[SimulationModel, Run], RunNumbers] = output_numbers) -> Statistics:
    """`numbers(model, run)`, a `RunNumbers`, of a model's run, and where that does not repeat itself, of the other runs of the ensemble."""
    first = numbers(model, run_of(model))
    if model.assembly.freedom == 0:  # kinematics is exact
        return Statistics((replace(first, turns={}),), 0)
    others = cases.run(lambda run: numbers(model, run), other_runs(model), workers=None).rows
    return Statistics((first, *(row.value for row in others)), turns_to_repeat(model))


@lru_cache(maxsize=4)
def turns_to_repeat(model: SimulationModel) -> int:
    """After how many turns the model's run repeats itself in its window; 0 where it does not."""
    return orbit_turns(model, window_record(model, run_of(model)))


@lru_cache(maxsize=1)
def other_runs(model: SimulationModel) -> tuple[Run, ...]:
    """The other runs of the ensemble, those that came to the end, in threads; kept for the analyses that follow.

    None where the run repeats itself, has no whole turn, ended early or is mere kinematics.
    """
    run = run_of(model)
    turns = len(turn_ends(model, start_of_window(model, run.end[1]), run.end[1])) - 1
    if model.assembly.freedom == 0 or run.advice or not turns or turns_to_repeat(model):
        return ()
    rows = cases.run(lambda number: ensemble_run(model, number), range(1, model.ensemble), workers=None).rows
    return tuple(row.value for row in rows if row.ok)


def ensemble_run(model: SimulationModel, number: int, per_step: int = 2) -> Run:
    """The run of a member from its own start, with so many points a step; SolverError where it ends early."""
    run = simulate(model.assembly, model.run_length, replace(model.settings, per_step=per_step), state=perturbed_start(model, number))
    if run.advice:
        raise SolverError(run.advice)
    return run


def orbit_turns(model: SimulationModel, record: Record) -> int:
    """After how many turns place and rate of every marker repeat themselves, in units of their range; 0 where they do not."""
    if not model.period:
        return 0
    start = record.t[0]
    times = start + model.period * np.arange(int((record.t[-1] - start) / model.period + 1e-9) + 1)
    rows = [
        _scaled(record.t, x, rate, times) for name in model.markers for x, rate, size in _places(model, record, name) if np.ptp(x) > size
    ]
    return orbit_period(np.stack(rows, axis=1), SAME) if rows and len(times) >= 3 else 0


def _places(model, record, name):
    """(samples, their rates, range below which they stand still) of place, direction and rates of a marker."""
    angle, w, alpha, x, y, vx, vy, ax, ay = (record.point(name, field) for field in POINT_FIELDS)
    length, speed = model.assembly.system.length, TURN / model.period
    yield from ((np.cos(angle), -np.sin(angle) * w, STILL), (np.sin(angle), np.cos(angle) * w, STILL), (w, alpha, STILL * speed))
    yield from ((place, rate, STILL * length) for place, rate in ((x, vx), (y, vy)))
    yield from ((place, rate, STILL * length * speed) for place, rate in ((vx, ax), (vy, ay)))


def _scaled(t, x, rate, times):
    """x at the times over its range, by cubics between the samples and their rates."""
    keep = np.flatnonzero(np.append(True, np.diff(t) > 0))
    return hermite_cubics(t[keep], x[keep], rate[keep]).at(times) / np.ptp(x)


def perturbed_start(model: SimulationModel, number: int) -> Floats:
    """The start of a member, its independent coordinates moved by `SHIFT` of the least clearance in a direction of its own.

    Member 0 starts as stated; without play the least clearance is taken as a thousandth of the mechanism.
    """
    system, y = model.assembly.system, model.assembly.state.copy()
    if number == 0:
        return y
    free = np.searchsorted(system.stored, system.independent)
    direction = np.random.default_rng((model.seed, number)).normal(size=len(free))
    sizes = [joint.play.clearance for joint in model.assembly.model.joints if joint.play]
    clearance = min((size for size in sizes if size), default=1e-3 * system.length)
    y[free] += SHIFT * clearance / system.length * system.sizes[system.independent] * direction / np.linalg.norm(direction)
    return y
