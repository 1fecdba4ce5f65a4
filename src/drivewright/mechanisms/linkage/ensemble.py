"""Statistics of a run turn by turn: of the run itself where it repeats, else of an ensemble of runs that start almost alike."""

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from drivewright import cases
from drivewright.errors import SolverError
from drivewright.mechanisms.linkage.build import ideal_record, record_of, run_of
from drivewright.multibody.measures import ImpactLoad, impact_load, largest, peaks, span
from drivewright.multibody.observe import PIN_FIELDS
from drivewright.multibody.record import record
from drivewright.multibody.simulate import simulate
from drivewright.numerics.chaos import orbit_period
from drivewright.numerics.ensemble import Estimate, estimate, estimate_statistic
from drivewright.result import Check

SHIFT = 1e-3  # of the least clearance by which the starts of the members differ: below what is manufactured
SAME = 1e-6  # of its range to which place and rate of an output repeat themselves in a periodic motion
PAIRS = {True: (("angle", "w"), ("w", "alpha")), False: (("x", "vx"), ("y", "vy"), ("vx", "ax"), ("vy", "ay"))}  # what, and its rate


@dataclass(frozen=True)
class Member:
    """One run in numbers: `turns` {name: (whole turns of the window,)}, `whole` {name: number of the whole window}."""

    turns: dict
    whole: dict


@dataclass(frozen=True)
class Statistics:
    """The members' numbers, and after how many turns the motion repeats itself (0: it does not, or there are no turns to compare)."""

    members: tuple
    period: int

    def mean(self, name: str) -> Estimate:
        """Mean over the turns: every turn of every member is a sample."""
        return self._alone(name) if self._single(name) else estimate(self._turns(name))

    def of_run(self, name: str, turns: str) -> Estimate:
        """What a run of this length shows, a largest value for instance: every member is a sample.

        `turns` names the number of a turn by which it is told whether it had settled.
        """
        if self._single(turns):
            return self._alone(name)
        numbers = np.array([member.whole[name] for member in self.members])
        settled = estimate_statistic(self._turns(turns), np.max).settled
        return replace(estimate_statistic(numbers[:, None], np.mean), settled=settled)

    def _single(self, name):
        """Whether one run says it all: it repeats itself, or has no turns."""
        return self.period > 0 or not self.members[0].turns.get(name, np.empty(0)).size

    def _turns(self, name):
        return np.array([member.turns[name] for member in self.members])

    def _alone(self, name):
        """Of a motion that repeats itself: exact to rounding; without turns there is no interval."""
        value = float(self.members[0].whole[name])
        reach = SAME * abs(value) if self.period else np.nan
        return Estimate(value, value - reach, value + reach, "periodic" if self.period else "", True, 1.0, 0.0)


def acceleration(seen: Any, output: Any) -> tuple:
    """(samples, unit, word) of an output's acceleration: the point's where one is given, else that of the angle."""
    if output.point is None:
        return seen.point(output.name, "alpha"), "rad/s^2", "angular acceleration"
    return np.hypot(seen.point(output.name, "ax"), seen.point(output.name, "ay")), "m/s^2", "acceleration"


def settled_check(name: str, estimates: Any, parts: tuple = ()) -> Check:
    """The check that the statistics of a run no longer drift."""
    drifting = sum(not found.settled for found in estimates)
    return Check(name, float(drifting), 0.0, "<=", "-", "statistics that still drifted at the end of the run, or have too few turns; raise "
                                                        "simulate.turns, or discard more of them", parts)


@lru_cache(maxsize=4)
def statistics(model: Any) -> Statistics:
    """The `Statistics` of a model: of its run, and where that does not repeat itself, of the other members of the ensemble."""
    start = model.spec.start_of_window if model.spec.simulate else 0.0
    seen = _after(record_of(model), start)
    first, period = member(model, run_of(model), seen, start), repeats(model, seen)
    if model.assembly.freedom == 0:  # kinematics is exact
        return Statistics((replace(first, turns={}),), 0)
    if period or run_of(model).advice or not _counted(first):
        return Statistics((first,), period)
    return Statistics((first, *_others(model, start)), 0)


def _after(seen, start):
    start = start if seen.t[-1] > start else 0.0
    return seen.after(start * (1 - 1e-12))


def _counted(one):
    return next(iter(one.turns.values())).size if one.turns else 0


def repeats(model: Any, seen: Any) -> int:
    """After how many turns place and rate of every output repeat themselves, in units of their range; 0 where they do not."""
    if not model.period or not model.spec.outputs:
        return 0
    start = seen.t[0]
    times = start + model.period * np.arange(int((seen.t[-1] - start) / model.period + 1e-9) + 1)
    rows = [_scaled(seen.t, seen.point(output.name, place), seen.point(output.name, rate), times)
            for output in model.spec.outputs for place, rate in PAIRS[output.point is None]]
    points = np.stack([row for row in rows if row is not None], axis=1)
    return orbit_period(points, SAME) if len(times) >= 3 else 0


def _scaled(t, x, rate, times):
    """x at the times over its range, by cubics between the samples and their rates; None where it stands still."""
    from scipy.interpolate import CubicHermiteSpline

    keep = np.flatnonzero(np.append(True, np.diff(t) > 0))
    size = np.ptp(x)
    return CubicHermiteSpline(t[keep], x[keep], rate[keep])(times) / size if size > 0 else None


def _others(model, start):
    """The other members, those that came to the end, in threads."""
    def one(number):
        run = simulate(model.assembly, model.duration, replace(model.settings, per_step=1), state=shifted(model, number))
        if run.advice:
            raise SolverError(run.advice)
        return member(model, run, record(run, model.markers, start * (1 - 1e-12)), start)

    rows = cases.run(one, range(1, model.ensemble), workers=None).rows
    return tuple(row.value for row in rows if row.ok)


def shifted(model: Any, number: int) -> np.ndarray:
    """The start of a member, its independent coordinates moved by `SHIFT` of the least clearance in a direction of its own.

    Member 0 starts as stated; without play the least clearance is taken as a thousandth of the mechanism.
    """
    system, y = model.assembly.system, model.assembly.state.copy()
    if number == 0:
        return y
    free = np.searchsorted(system.stored, system.independent)
    direction = np.random.default_rng((model.spec.simulate.seed if model.spec.simulate else 1, number)).normal(size=len(free))
    played = (getattr(joint, "model", None) for joint in model.assembly.model.joints)
    sizes = [getattr(getattr(play, "contact", play), "clearance", 0.0) for play in played]
    clearance = min((size for size in sizes if size), default=1e-3 * system.length)
    y[free] += SHIFT * clearance / system.length * system.sizes[system.independent] * direction / np.linalg.norm(direction)
    return y


# ------------------------------------------------------------------------------------------------------------ numbers of a run


def member(model, run, seen, start):
    """The `Member` of a run whose window from a start on is recorded; its turns begin there, up to a step before the first record."""
    start = start if start <= seen.t[0] else 0.0
    count = int((seen.t[-1] - start) / model.period + 1e-9) if model.period else 0
    ends = start + (model.period or 0.0) * np.arange(count + 1)
    found = Member({}, {})
    for output in model.spec.outputs:
        _motion(seen, output, ends, found)
        _output(model, seen, output, ends, found)
    if model.assembly.model.drives:
        torque = np.max(np.abs(seen.drives), axis=1)
        found.whole["drive.torque"] = float(np.max(torque))
        found.turns.update({"drive.torque": _largest_of_turns(seen.t, torque, ends)} if len(ends) > 1 else {})
    for number, name in enumerate(model.pins):
        _pin(model, run, seen, number, name, ends, found)
    return found


def _motion(seen, output, ends, found):
    """Largest magnitudes and the range of the angle of an output, in SI."""
    name, angle = output.name, seen.point(output.name, "angle")
    sizes = {"alpha": np.abs(seen.point(name, "alpha")), "acceleration": np.abs(acceleration(seen, output)[0])}
    found.whole.update({f"{name}.{key}": largest(seen.t, x) for key, x in sizes.items()} | {f"{name}.swing": span(seen.t, angle)})
    if len(ends) > 1:
        found.turns.update({f"{name}.{key}": _largest_of_turns(*peaks(seen.t, x), ends) for key, x in sizes.items()})
        low, high = np.min(angle), np.max(angle)
        above, below = _largest_of_turns(seen.t, angle - low, ends), _largest_of_turns(seen.t, high - angle, ends)
        found.turns[f"{name}.swing"] = above + below - (high - low)


def _output(model, seen, output, ends, found):
    name, data = output.name, acceleration(seen, output)[0]
    peak = largest(ideal_record(model).t, acceleration(ideal_record(model), output)[0])
    load = impact_load(seen.t, data, peak, model.period)
    found.whole[f"{name}.ratio"] = largest(seen.t, data) / peak if peak else np.nan
    found.whole.update({f"{name}.{field}": value for field, value in zip(ImpactLoad._fields, load, strict=True)})
    if np.isfinite(load.turn_mean):
        found.turns[f"{name}.peak"] = found.turns[f"{name}.turn_mean"] = _largest_of_turns(*peaks(seen.t, np.abs(data)), ends) / peak


def _pin(model, run, seen, number, name, ends, found):
    pin = dict(zip(PIN_FIELDS, np.moveaxis(seen.pins[:, number], 1, 0), strict=True))
    force, span = np.hypot(pin["fx"], pin["fy"]), seen.t[-1] - seen.t[0]
    at = run.impacts[(run.impacts[:, 1] == number) & (run.impacts[:, 0] >= seen.t[0]) & (run.impacts[:, 0] <= seen.t[-1]), 0]
    means = {"touching": (pin["depth"] > 0).astype(float), "lost": np.abs(pin["friction"] * pin["slip"])}
    found.whole.update({f"{name}.force": float(np.max(force)), f"{name}.depth": max(float(np.max(pin["depth"])), 0.0),
                        f"{name}.hits": len(at) * (model.period or 0.0) / span})
    found.whole.update({f"{name}.{key}": float(means_of_turns(seen.t, x, seen.t[[0, -1]])[0]) for key, x in means.items()})
    if len(ends) > 1:
        found.turns.update({f"{name}.force": _largest_of_turns(seen.t, force, ends),
                            f"{name}.hits": np.histogram(at, ends)[0].astype(float),
                            f"{name}.depth": np.maximum(_largest_of_turns(seen.t, pin["depth"], ends), 0.0)})
        found.turns.update({f"{name}.{key}": means_of_turns(seen.t, x, ends) for key, x in means.items()})


def _largest_of_turns(t, x, ends):
    """Largest of x (m,) between every two of the ends; 0 where there is none."""
    turns = np.searchsorted(ends, t, side="right") - 1
    found = np.zeros(len(ends) - 1)
    inside = (turns >= 0) & (turns < len(found))
    np.maximum.at(found, turns[inside], x[inside])
    return found


def means_of_turns(t: np.ndarray, x: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Time means (turns,) of the polygon x (m,) between every two of the ends."""
    whole = np.concatenate([[0.0], np.cumsum(np.diff(t) * 0.5 * (x[1:] + x[:-1]))])
    row = np.clip(np.searchsorted(t, ends, side="right") - 1, 0, len(t) - 2)
    part = ends - t[row]
    slope = np.divide(x[row + 1] - x[row], t[row + 1] - t[row], out=np.zeros(len(ends)), where=t[row + 1] > t[row])
    return np.diff(whole[row] + part * (x[row] + 0.5 * part * slope)) / np.diff(ends)
