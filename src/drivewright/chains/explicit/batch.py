"""Many runs: over speed, and over the scatter of manufacturing."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy

from drivewright._typing import ArrayLike, Floats
from drivewright.cases import Outcomes, run
from drivewright.chains.explicit.ensemble import Ensemble, amplitude_of, ensemble, maximum_of, range_of
from drivewright.chains.explicit.signals import Signal
from drivewright.chains.explicit.simulate import Settings, tooth_time
from drivewright.chains.model import ChainDrive, at_speed, with_sprocket
from drivewright.chains.tooth import Tooth
from drivewright.errors import InputError, SolverError
from drivewright.numerics.ensemble import Estimate, mean_of_members

ORDERS = (1.0, 2.0, 3.0)  # of the mesh frequency


@dataclass(frozen=True)
class Level:
    """One drive in numbers, means over revolutions of the chain: driver's speed [rad/s]; mean, peak-to-peak and amplitudes at mesh orders
    of its signal, the centre distance where the driven sprocket slides, the spectrum over frequency [Hz] with half the width of its
    interval; greatest tension [N], friction utilisation; energy drift [1/s]."""

    speed: float
    mean: Estimate
    fluctuation: Estimate
    amplitudes: tuple[Estimate, ...]
    frequency: Floats
    spectrum: Floats
    reach: Floats
    tension: Estimate
    utilisation: Estimate
    energy_drift: float
    signal: Signal


def level(runs: Ensemble, orders: Sequence[float] = ORDERS) -> Level:
    """The `Level` of an ensemble; SolverError, with the level as its partial, where a run is not complete."""
    if not all(np.all(np.isfinite(each.rows)) for each in runs.members):
        raise SolverError(runs.advice)
    first, (mesh, amplitudes), signal = runs.first, runs.mesh_orders, runs.signal.of
    spectrum, reach = mean_of_members(amplitudes)
    found = Level(
        first.model.drive.speed,
        runs.estimate_mean(signal, range_of(signal)),
        runs.estimate(range_of(signal)),
        tuple(runs.estimate(amplitude_of(signal, order)) for order in orders),
        mesh / first.tooth_time,
        spectrum,
        reach,
        runs.estimate(maximum_of(lambda each: np.max(each.tension, axis=1))),
        runs.estimate(maximum_of(lambda each: each.column("utilisation"))),
        runs.energy_drift,
        runs.signal,
    )
    if runs.advice:
        raise SolverError(runs.advice, partial=found)
    return found


def campbell(
    model: ChainDrive,
    speeds: Iterable[float],
    revolutions: int = 2,
    settings: Settings = Settings(),
    members: int = 4,
    workers: int | None = None,
    progress: Callable[[int, int, str], object] | None = None,
) -> Outcomes:
    """`Outcomes` of `Level` at each speed of the driver [rad/s]: a Campbell diagram is `spectrum` over `frequency` and speed.

    Every speed is an ensemble of so many members that last settings.settle [s] and so many revolutions of the chain.
    """
    if revolutions < 1:
        raise InputError(f"campbell: needs 1 revolution of the chain or more to look at, got {revolutions}.")

    def task(speed):
        turned = at_speed(model, speed)
        return level(ensemble(turned, settings.settle + revolutions * revolution_time(turned), settings, members, workers=1))

    return run(task, [float(speed) for speed in speeds], workers, progress)


def revolution_time(model: ChainDrive) -> float:
    """Time of a revolution of the chain at full speed  [s]."""
    return model.chain.count * tooth_time(model)


@dataclass(frozen=True)
class Scatter:
    """Standard deviations of normal scatter: flank position of each sprocket's teeth, hole pitch of every single plate  [m]."""

    tooth_thickness: float = 0.0
    pitch: float = 0.0


@dataclass(frozen=True)
class Spread:
    """Percentiles of mean and fluctuation of the drives' signal over all samples that ran: rows value, low, high (3, k), nan where
    so few samples do not bound them; outcomes of all."""

    percentiles: tuple[float, ...]
    mean: Floats
    fluctuation: Floats
    outcomes: Outcomes


def scattered(model: ChainDrive, scatter: Scatter, seed: int | tuple[int, ...]) -> ChainDrive:
    """The model with one draw of manufacturing scatter; the same seed gives the same drive."""
    random = np.random.default_rng(seed)
    drawn = np.asarray(model.chain.deviations or np.zeros(model.chain.count)) + random.normal(0.0, scatter.pitch, model.chain.count)
    made = replace(model, chain=replace(model.chain, deviations=tuple(drawn)))
    for number, sprocket in enumerate(model.sprockets):
        thicker = random.normal(0.0, scatter.tooth_thickness)
        if isinstance(sprocket.tooth, Tooth):
            made = with_sprocket(made, number, tooth=sprocket.tooth._replace(support=sprocket.tooth.support - thicker))
    return made


def monte_carlo(
    model: ChainDrive,
    scatter: Scatter,
    samples: int,
    duration: float,
    settings: Settings = Settings(),
    percentiles: Sequence[float] = (5, 50, 95),
    seed: int = 0,
    members: int = 1,
    workers: int | None = None,
    progress: Callable[[int, int, str], object] | None = None,
) -> Spread:
    """The `Spread` over so many drives of `scatter`, each an ensemble of so many runs for `duration` [s]."""
    if samples < 2 or min(scatter.tooth_thickness, scatter.pitch) < 0:
        raise InputError(f"monte_carlo: needs 2 samples or more and deviations of 0 or more, got {samples} and {scatter}.")
    outcomes = run(
        lambda each: level(ensemble(scattered(model, scatter, (seed, each)), duration, settings, members, workers=1)),
        range(samples),
        workers,
        progress,
    )
    levels = [row.value for row in outcomes.rows if row.ok]
    if not levels:
        raise SolverError(
            f"monte_carlo: none of {samples} drives completed its run; reason of the first: {outcomes.rows[0].reason}", partial=outcomes
        )
    return Spread(
        tuple(percentiles),
        quantiles([each.mean.value for each in levels], percentiles),
        quantiles([each.fluctuation.value for each in levels], percentiles),
        outcomes,
    )


def quantiles(sample: ArrayLike, percentiles: Sequence[float]) -> Floats:
    """Percentiles of a sample (n,) with their 95 % intervals: rows value, low, high (3, k).

    Low and high are the order statistics that enclose the percentile with 2.5 % left on either side, by the binomial distribution of how
    many of n lie below it, whatever the distribution of the sample; nan where there is no such one.
    """
    ordered, shares = np.sort(np.asarray(sample, float)), np.asarray(percentiles, float) / 100
    count, padded = len(ordered), np.concatenate([[np.nan], np.sort(sample), [np.nan]])
    low = scipy.stats.binom.ppf(0.025, count, shares).astype(int)  # P(fewer than low lie below) <= 2.5 %
    high = scipy.stats.binom.ppf(0.975, count, shares).astype(int) + 1
    return np.stack([np.percentile(ordered, percentiles), padded[low], padded[np.minimum(high, count + 1)]])
