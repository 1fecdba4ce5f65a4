"""Statistics of a running chain: windows of one revolution of the chain, in several runs whose starts differ by nanometres.

ContactLaws that open and close make the run of a chain chaotic: after some milliseconds such runs share nothing but their statistics.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from drivewright._typing import Floats
from drivewright.cases import run as run_cases
from drivewright.chains.explicit.assembly import Start
from drivewright.chains.explicit.motion import Motion, RunSettings
from drivewright.chains.explicit.signals import Signal, signals
from drivewright.chains.explicit.simulate import Settings, first_start, simulate
from drivewright.chains.model import ChainDrive
from drivewright.errors import InputError, SolverError
from drivewright.numerics.ensemble import ENOUGH, Estimate, estimate
from drivewright.numerics.signals import order_spectrum, time_mean

DISTURBANCE = 1e-9  # standard deviation of the plates' places at the start, far below any manufacture  [m]
PARTS = 4  # of a window, by which it is judged whether the run has settled
LITTLE = 0.1  # of a statistic: a drift between halves that does not matter
MEMORY = 3  # enough to trust that a larger one is chance: effective samples of each member, of PARTS times its revolutions
TOGETHER = 1e-2  # of the range of the signal: runs that are nowhere further apart are one
ROUNDING = 1e-6  # windows that agree to this part of a statistic repeat each other
GROWTH = 1.5  # of the distance between two runs from the first window to the last: with more, neither stays in the motion that it is in


@dataclass(frozen=True)
class Ensemble:
    """Runs of one drive, the first undisturbed; the first alone where they stay together, and are not chaotic.

    A signal is a function of a run that returns its samples (m,).  `growth`: by how much two runs that stay together part from the first
    window to the last.  Where it is above 1 the motion is unstable, and the runs will leave it for another.
    """

    members: tuple[Motion, ...]
    chaotic: bool = True
    growth: float = 1.0

    @property
    def stable(self) -> bool:
        """Whether the motion stays as it is: a disturbance does not grow in it."""
        return self.growth <= GROWTH

    @property
    def first(self) -> Motion:
        """The undisturbed run."""
        return self.members[0]

    @property
    def signal(self) -> Signal:
        """By which the evenness of these runs is judged."""
        return signals(self.first.model)[0]

    def windows(self, statistic: Callable, parts: int = 1) -> np.ndarray:
        """statistic(run, rows) in every window of every member (members, windows); `parts` divides the windows."""
        return np.array([[statistic(run, rows) for rows in run.windows(parts)] for run in self.members])

    def estimate(self, statistic: Callable, spread: Callable | None = None) -> Estimate:
        """The mean over all windows.  `spread`: the statistic that says what counts as little, itself unless given."""
        samples = self.windows(statistic)
        centre = samples[0, 0] if spread else 0.0
        scale = float(np.max(np.abs(self.windows(spread or statistic))))
        found = estimate(samples - centre, rounding=ROUNDING, scale=scale)
        settled = (found.interval == "periodic" and self.stable) or self.is_settled(statistic, scale)
        return replace(found, value=found.value + centre, low=found.low + centre, high=found.high + centre, settled=settled)

    def estimate_mean(self, signal: Callable, spread: Callable | None = None) -> Estimate:
        """The mean over time of a signal that belongs to no plate or joint; `spread` as in `estimate`.

        The few windows of a run that stands alone may agree by chance, so its interval is no narrower than that by parts of windows.
        """
        found = self.estimate(mean_of(signal), spread)
        if found.interval != "windows":
            return found
        parts = estimate(self.windows(mean_of(signal), PARTS))
        reach = max(found.high - found.value, 0.5 * (parts.high - parts.low))
        return replace(found, low=found.value - reach, high=found.value + reach)

    def extreme(self, statistic: Callable) -> Estimate:
        """The mean of statistic(run, rows) over the whole steady part of each member; it grows with the duration."""
        mean_of_members = np.array([statistic(run, run.steady) for run in self.members])
        return replace(estimate(mean_of_members[:, None]), settled=self.is_settled(statistic, float(np.max(mean_of_members))))

    def is_settled(self, statistic: Callable, scale: float) -> bool:
        """Whether the two halves agree, to `LITTLE` or as far as chance lets them, with memory so short that this means something.

        It is told from parts of windows; what belongs to one plate or joint differs from part to part of a revolution, so the mean of each
        part over all revolutions is taken off.  A single revolution cannot tell.  Where chance has no part in the motion, windows tell by
        themselves.
        """
        if self.first.revolutions < 2 or not self.stable:
            return False
        if not self.chaotic:
            return self._drift(statistic) <= LITTLE * scale
        samples = self.windows(statistic, PARTS)
        parts = samples.reshape(len(samples), self.first.revolutions, -1)
        found = estimate((parts - np.mean(parts, axis=(0, 1))).reshape(samples.shape))
        if self._drift(statistic) <= LITTLE * scale:
            return found.effective >= ENOUGH
        return found.settled and found.effective >= MEMORY * len(samples)

    def _drift(self, statistic: Callable) -> float:
        """Between the means of the first and the last half of the windows."""
        samples = self.windows(statistic)
        half = samples.shape[1] // 2
        return abs(float(np.mean(samples[:, :half]) - np.mean(samples[:, -half:])))

    @cached_property
    def mesh_orders(self) -> tuple:
        """(orders, amplitudes (members, orders)) of the signal: means over the windows of each member."""
        found = [[run.orders_in(rows, self.signal.of(run)) for rows in run.windows()] for run in self.members]
        return found[0][0][0], np.array([np.mean([amplitudes for _, amplitudes in windows], axis=0) for windows in found])

    @property
    def energy_drift(self) -> float:
        """The largest of the members."""
        return max(run.energy_drift for run in self.members)

    @property
    def advice(self) -> str:
        """What is wrong with the first member that failed; empty where none did."""
        return next((run.advice for run in self.members if run.advice), "")


def mean_of(signal: Callable) -> Callable:
    """Statistic: mean over time."""
    return lambda run, rows: time_mean(run.t[rows], signal(run)[rows])


def range_of(signal: Callable) -> Callable:
    """Statistic: greatest less least value."""
    return lambda run, rows: float(np.ptp(signal(run)[rows]))


def maximum_of(signal: Callable) -> Callable:
    """Statistic: the greatest value."""
    return lambda run, rows: float(np.max(signal(run)[rows]))


def amplitude_of(signal: Callable, order: float = 1.0) -> Callable:
    """Statistic: amplitude at a multiple of the mesh frequency, over the whole teeth in the rows."""

    def amplitude(run, rows):
        teeth = (rows.stop - 1 - rows.start) // run.per_tooth
        whole = slice(rows.start, rows.start + teeth * run.per_tooth + 1)
        t = run.t[whole]
        return float(order_spectrum(t, signal(run)[whole], (t[-1] - t[0]) / teeth, [order])[0])

    return amplitude


def centre_distance(run: Motion) -> Floats:
    """Signal: distance of the driven sprocket from the driver."""
    return run.centre_distance


def ensemble(
    model: ChainDrive,
    duration: float,
    settings: RunSettings = Settings(),
    members: int = 4,
    *,
    seed: int = 0,
    solve: Callable[..., Any] = simulate,
    workers: int | None = None,
    progress: Callable[[int, int, str], object] | None = None,
) -> Ensemble:
    """The `Ensemble` of so many runs of `solve` (explicit or implicit), from starts disturbed by `DISTURBANCE`, in threads.

    Where the second run stays with the first the drive is not chaotic, and the first stands alone: its windows make the intervals.
    The same seed gives the same runs, whatever the number of workers.  SolverError where a run gives up.
    """
    if isinstance(members, bool) or not isinstance(members, int) or members < 1:
        raise InputError(f"chain drive: an ensemble has 1 member or more, got {members!r}.")
    begin = first_start(model, settings)

    def member(number):
        return solve(model, duration, settings, begin=disturbed(begin, (seed, number)) if number else begin)

    runs = _runs(member, range(min(members, 2)), workers, progress)
    if len(runs) < 2:
        return Ensemble(runs)
    if _same(*runs):
        return Ensemble(runs[:1], chaotic=False, growth=_growth(*runs))
    return Ensemble((*runs, *_runs(member, range(2, members), workers, progress)))


def _runs(member, numbers, workers, progress):
    """The members with these numbers, in threads."""
    rows = run_cases(member, numbers, workers, progress).rows
    failed = next((row for row in rows if not row.ok), None)
    if failed:
        raise SolverError(failed.reason, partial=failed.value)
    return tuple(row.value for row in rows)


def _same(one, other):
    """Whether two runs stay together in their steady part: they are not chaotic, and more of them would tell nothing more."""
    signal = signals(one.model)[0]
    a, b = signal.of(one)[one.steady], signal.of(other)[other.steady]
    return bool(np.max(np.abs(a - b)) <= TOGETHER * np.ptp(a))


def _growth(one, other):
    """Distance of two runs in the last window over that in the first, root mean squares; 1 where it is rounding."""
    signal = signals(one.model)[0]
    a, b = signal.of(one), signal.of(other)
    apart = [float(np.sqrt(np.mean((a[rows] - b[rows]) ** 2))) for rows in one.windows()]
    return apart[-1] / apart[0] if apart[-1] > ROUNDING * np.ptp(a[one.steady]) else 1.0


def disturbed(begin: Start, seed: tuple[int, int]) -> Start:
    """The `Start` with every plate moved by nanometres."""
    shifts = np.random.default_rng(seed).normal(0.0, DISTURBANCE, (len(begin.poses), 2))
    return replace(begin, poses=begin.poses + np.pad(shifts, ((0, 0), (0, 1))))
