"""The running chain beside Exudyn's, from the same start after the run-in: centre distance, forces of both strands, a strand's frequency.

Contacts make neighbouring motions part, so means are compared over no more than a tooth.  The strand is plucked, and its first frequency
fitted to up to two of its periods: a strand's slow motion is the same whichever teeth chatter.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, NamedTuple, Protocol

import numpy as np
from scipy.optimize import minimize_scalar

from drivewright._typing import Floats
from drivewright.chains.explicit.assembly import Start
from drivewright.chains.explicit.simulate import Settings, chain_shapes, running_start, simulate, tooth_time
from drivewright.chains.explicit.stability import largest_step, safe_step
from drivewright.chains.model import ChainDrive
from drivewright.chains.standards import pitch_diameter, strand_frequency
from drivewright.errors import MissingExtra
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.chain_drive import chain_drive
from drivewright.numerics.signals import time_mean
from drivewright.oracles.silent_chain.chain_forces import unknown
from drivewright.registry import LeftOut, Row

SAMPLES = 48  # of a window
OURS, THEIRS = (0.4, 0.2, 0.1), (0.4, 0.2)  # steps of ours and of Exudyn's Runge-Kutta method, over the largest stable step of ours
MOST_STEPS = 6000  # of the longer ones of these
PLUCKED, VERLET = (0.8, 0.4, 0.2), 0.8  # the same for the plucked strand; Verlet's method is stable as long as ours
PERIODS, SWING, SHAPES = 2.0, 0.05, 200  # of the strand's motion, its amplitude in pitches, samples
LONGEST = 100_000  # steps of the strand's motion, a quarter of a millisecond each; left out where they hold no period
NEAR = 0.5  # of a pitch off its line that a plate of the strand may be
TIMES = 10  # what an answer changes with the step, times this, is allowed: a few steps make a sample, and contacts amplify any difference
MEANS = "Exudyn: bodies and Runge-Kutta steps of its own; tolerance: ten times the change of both results with their steps"
RUNNING, FREQUENCY = "the running chain in Exudyn", "first frequency of the tight strand"
STRAND = "Exudyn: plucked strand, Verlet steps; tolerance: ten times the change of our result with its step"


class Engine(Protocol):
    """`exudyn_model`, or what runs a chain in its place."""

    def run(self, model: ChainDrive, begin: Start, duration: float, step: float, samples: int, solver: str = "RK44", /) -> Any:
        """Its `Run`."""
        ...


def rows(model: ChainModel) -> Iterator[Row | LeftOut]:
    """All rows, or why there are none."""
    if missing := missing_in_exudyn(chain_drive(model)):
        yield LeftOut(RUNNING, f"the Exudyn model does not support {missing}")
        return
    try:
        twin = route()
    except MissingExtra as error:
        yield LeftOut(RUNNING, str(error), error.extra)
        return
    yield from exudyn_rows(twin, model)


def missing_in_exudyn(system: ChainDrive) -> str:
    """What of a drive Exudyn's twin cannot represent; empty where nothing is missing."""
    return unknown(system) or ("more than two sprockets" if len(system.sprockets) > 2 else "")


def route() -> Engine:
    """Exudyn's twin; MissingExtra where Exudyn is not installed."""
    try:
        from drivewright.oracles.silent_chain import exudyn_model
    except ImportError as error:
        raise MissingExtra("the running chain in Exudyn", "peers", error) from None
    return exudyn_model


def exudyn_rows(twin: Engine, model: ChainModel) -> Iterator[Row | LeftOut]:
    """All rows, from the chain after its run-in."""
    system = chain_drive(model)
    begin = running_start(system, Settings(safe_step(system)))
    yield from means(twin, system, begin)
    strand = strand_of(system, begin, tight=True)
    string = float(strand_frequency(model.strands.tension, system.chain.line_density, strand.length, model.strands.speed))
    periods = min(PERIODS, LONGEST * VERLET * largest_step(system) * string)
    if periods < 1.0:
        yield LeftOut(FREQUENCY, f"a period of the strand takes more than {LONGEST} steps")
        return
    ours, theirs = frequencies(twin, system, begin, strand, string, periods)
    yield FREQUENCY, ours[-1], theirs, "Hz", TIMES * float(np.ptp(ours)), STRAND


# -- means over a tooth --------------------------------------------------------------------------------------------------------


def means(twin: Engine, system: ChainDrive, begin: Start) -> Iterator[Row]:
    """Centre distance, and the forces in the middle of both strands, over a tooth or as much of it as `MOST_STEPS` take."""
    largest, tooth = largest_step(system), tooth_time(system)
    windows = max(1, int(np.ceil(tooth / (MOST_STEPS * THEIRS[0] * largest))))
    joints = tuple(strand_of(system, begin, tight).middle(begin) for tight in (True, False))
    ours = np.array([_our_means(system, begin, share * largest, joints, windows) for share in OURS])
    other = np.array([_their_means(twin, system, begin, share * largest, joints, tooth / windows) for share in THEIRS])
    allowed = TIMES * (np.ptp(ours, axis=0) + np.ptp(other, axis=0))
    allowed[1:] = allowed[1:].max()  # the two strands are alike
    where = "mean over a tooth" if windows == 1 else f"mean over 1/{windows} tooth"
    names = (("centre distance", "m"), ("force of the tight strand", "N"), ("force of the slack strand", "N"))
    for k, (name, unit) in enumerate(names):
        if k or system.sprockets[1].slide:
            yield f"{name}, {where}", float(ours[-1, k]), float(other[-1, k]), unit, float(allowed[k]), MEANS


def _our_means(system, begin, step, joints, windows):
    settings = Settings(step, run_in=0.0, samples_per_tooth=SAMPLES * windows, joints=joints)
    motion = simulate(system, tooth_time(system) / windows, settings, begin=begin)
    return [time_mean(motion.t, signal) for signal in (motion.centre_distance, *motion.tension.T)]


def _their_means(twin, system, begin, step, joints, duration):
    run = twin.run(system, begin, duration, step, SAMPLES)
    distance = np.abs(run.centre(system, 1) - run.centre(system, 0))
    return [time_mean(run.time, signal) for signal in (distance, *run.tension[:, joints].T)]


# -- a strand as a string ------------------------------------------------------------------------------------------------------


class Strand(NamedTuple):
    """The straight line of a strand between the pitch circles: its start [m], direction and length [m]."""

    start: complex
    along: complex
    length: float

    def coordinates(self, shapes: Floats) -> tuple[Floats, Floats]:
        """(along from the start, across) [m] of plates (..., 3)."""
        seen = (shapes[..., 0] + 1j * shapes[..., 1] - self.start) / self.along
        return seen.real, seen.imag

    def mode(self, shapes: Floats, near: float) -> Floats:
        """sin(pi s/L) of the plates on the strand, no farther than `near` [m] off it, 0 of the others."""
        s, across = self.coordinates(shapes)
        return np.where((s > 0) & (s < self.length) & (np.abs(across) < near), np.sin(np.pi * s / self.length), 0.0)

    def middle(self, begin: Start) -> int:
        """Number of the joint that comes nearest to the middle."""
        s, across = self.coordinates(begin.poses)
        return int(np.argmin(np.hypot(s - 0.5 * self.length, across)))


def strand_of(system: ChainDrive, begin: Start, tight: bool) -> Strand:
    """The tight strand, below, which runs onto the driver, or the slack one; tangent to both pitch circles."""
    radii = [0.5 * pitch_diameter(system.chain.link.pitch, each.tooth.teeth) for each in system.sprockets]
    centres = [
        complex(*each.centre) + begin.q[n] * (np.exp(1j * each.slide.direction) if each.slide else 0.0)
        for n, each in enumerate(system.sprockets)
    ]
    side, apart = (-1 if tight else 1), centres[1] - centres[0]
    outward = side * 1j * apart / abs(apart) * np.exp(1j * side * np.arcsin((radii[1] - radii[0]) / abs(apart)))
    start, end = (centre + radius * outward for centre, radius in zip(centres, radii, strict=True))
    return Strand(complex(start), complex((end - start) / abs(end - start)), float(abs(end - start)))


def plucked(begin: Start, strand: Strand, rate: float, near: float) -> Start:
    """The start with a velocity across the strand, rate sin(pi s/L)  [m/s]."""
    rates, across = begin.rates.copy(), rate * strand.mode(begin.poses, near) * 1j * strand.along
    s, _ = strand.coordinates(begin.poses)
    rates[:, 0] += across.real
    rates[:, 1] += across.imag
    rates[:, 2] += np.where(across != 0.0, rate * np.pi / strand.length * np.cos(np.pi * s / strand.length), 0.0)
    return replace(begin, rates=rates)


def frequencies(
    twin: Engine, system: ChainDrive, begin: Start, strand: Strand, guess: float, periods: float = PERIODS
) -> tuple[list[float], float]:
    """First frequency of a strand by our runs, one for each of the steps `PLUCKED`, and by Exudyn's  [Hz]."""
    pitch, largest = system.chain.link.pitch, largest_step(system)
    duration, near = periods / guess, NEAR * pitch
    start = plucked(begin, strand, SWING * pitch * 2 * np.pi * guess, near)
    runs = [chain_shapes(system, start, duration, share * largest, SHAPES) for share in PLUCKED]
    run = twin.run(system, start, duration, VERLET * largest, SHAPES, "VelocityVerlet")
    *ours, theirs = (fitted_frequency(t, swing(strand, shapes, near), guess) for t, shapes in (*runs, (run.time, run.plates)))
    return ours, theirs


def swing(strand: Strand, shapes: Floats, near: float) -> Floats:
    """Sum over the plates of y sin(pi s/L), in proportion to the amplitude of the first mode (m,)  [m]."""
    return np.sum(strand.coordinates(shapes)[1] * strand.mode(shapes, near), axis=-1)


def fitted_frequency(t: Floats, signal: Floats, guess: float) -> float:
    """Frequency f [Hz] near a guess at which a + b cos(2 pi f t) + c sin(2 pi f t) meets a signal (m,) best, by least squares."""

    def miss(f):
        columns = np.stack([np.ones_like(t), np.cos(2 * np.pi * f * t), np.sin(2 * np.pi * f * t)], axis=1)
        weights = np.linalg.lstsq(columns, signal, rcond=None)[0]
        return float(np.sum((signal - columns @ weights) ** 2))

    trials = guess * np.linspace(0.6, 1.5, 91)
    best = int(np.clip(np.argmin([miss(f) for f in trials]), 1, len(trials) - 2))
    found: Any = minimize_scalar(miss, bounds=(trials[best - 1], trials[best + 1]), method="bounded", options={"xatol": 1e-9 * guess})
    return float(found.x)
