"""Many runs: over speed, and over the scatter of manufacturing."""

from dataclasses import dataclass, replace

import numpy as np

from drivewright.cases import Outcomes, run
from drivewright.chains.dynamics.model import Model, at_speed, with_sprocket
from drivewright.chains.dynamics.simulate import Settings, simulate, tooth_time
from drivewright.chains.tooth import Tooth
from drivewright.errors import InputError, SolverError


@dataclass(frozen=True)
class Level:
    """One run in numbers: driver's speed [rad/s], mean, fluctuation and amplitudes at mesh orders (k,) of the centre distance [m], its
    spectrum over frequency [Hz], largest tension [N], friction utilisation, energy drift."""

    speed: float
    mean: float
    fluctuation: float
    amplitudes: np.ndarray
    frequency: np.ndarray
    spectrum: np.ndarray
    tension: float
    utilisation: float
    energy_drift: float


def level(motion, orders=(1.0, 2.0, 3.0)):
    """The `Level` of a run; SolverError, with the level as its partial, where the run is not complete."""
    distance, steady = motion.centre_distance, motion.steady
    if not np.all(np.isfinite(motion.rows)):
        raise SolverError(motion.advice)
    mesh, amplitude = motion.spectrum(distance)
    time = (motion.t[steady][-1] - motion.t[steady][0]) / motion.teeth
    found = Level(
        motion.model.sprockets[motion.model.driver].drive.speed, motion.mean(distance), motion.fluctuation(distance),
        motion.orders(distance, orders), mesh / time, amplitude, float(np.max(motion.tension[steady])),
        float(np.max(motion.column("utilisation")[steady])), motion.energy_drift)
    if motion.advice:
        raise SolverError(motion.advice, partial=found)
    return found


def campbell(model, speeds, teeth=40, settle=20, settings=Settings(), workers=None, progress=None) -> Outcomes:
    """`Outcomes` of `Level` at each speed of the driver [rad/s]: a Campbell diagram is `spectrum` over `frequency` and speed.

    Every run lasts settle + teeth teeth of the driver, but settles for settings.settle [s] at least.
    """
    if settle < 0 or teeth < 1:
        raise InputError(f"campbell: needs 1 tooth to look at and 0 or more to settle, got {teeth} and {settle}.")

    def task(speed):
        turned = at_speed(model, speed)
        time = tooth_time(turned)
        quiet = max(settle * time, settings.settle)
        return level(simulate(turned, quiet + teeth * time, replace(settings, settle=quiet)))

    return run(task, [float(speed) for speed in speeds], workers, progress)


@dataclass(frozen=True)
class Scatter:
    """Standard deviations of normal scatter: flank position of each sprocket's teeth, hole pitch of every single plate  [m]."""

    tooth_thickness: float = 0.0
    pitch: float = 0.0


@dataclass(frozen=True)
class Spread:
    """Percentiles of mean and fluctuation of the centre distance  [m] over all samples that ran; outcomes of all."""

    percentiles: tuple
    mean: np.ndarray
    fluctuation: np.ndarray
    outcomes: Outcomes


def scattered(model, scatter, seed) -> Model:
    """The model with one draw of manufacturing scatter; the same seed gives the same drive."""
    random = np.random.default_rng(seed)
    drawn = np.asarray(model.chain.deviations or np.zeros(model.chain.count)) + random.normal(0.0, scatter.pitch, model.chain.count)
    made = replace(model, chain=replace(model.chain, deviations=tuple(drawn)))
    for number, sprocket in enumerate(model.sprockets):
        thicker = random.normal(0.0, scatter.tooth_thickness)
        if isinstance(sprocket.tooth, Tooth):
            made = with_sprocket(made, number, tooth=sprocket.tooth._replace(support=sprocket.tooth.support - thicker))
    return made


def monte_carlo(model, scatter, samples, duration, settings=Settings(), percentiles=(5, 50, 95), seed=0, workers=None, progress=None):
    """The `Spread` over so many drives of `scatter`, each run for `duration` [s]."""
    if samples < 2 or min(scatter.tooth_thickness, scatter.pitch) < 0:
        raise InputError(f"monte_carlo: needs 2 samples or more and deviations of 0 or more, got {samples} and {scatter}.")
    outcomes = run(lambda each: level(simulate(scattered(model, scatter, (seed, each)), duration, settings)),
                   range(samples), workers, progress)
    levels = [row.value for row in outcomes.rows if row.ok]
    if not levels:
        raise SolverError(f"monte_carlo: none of {samples} drives ran through; the first said: {outcomes.rows[0].reason}", partial=outcomes)
    return Spread(tuple(percentiles), np.percentile([each.mean for each in levels], percentiles),
                  np.percentile([each.fluctuation for each in levels], percentiles), outcomes)
