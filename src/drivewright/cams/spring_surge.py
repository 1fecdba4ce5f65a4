"""Surge of a coil spring: an elastic rod with distributed mass, one end fixed, the other driven periodically.

    m u_tt = k l^2 u_xx,   u(0, t) = 0,   u(l, t) = y(t)          rate k [N/m], mass m [kg] of the active coils

Relative to the straight line y x/l the rod swings in the modes sin(n pi x/l) with the natural frequencies

    w_n = n pi sqrt(k/m)         all multiples of the first one, and one damping ratio zeta

and the force at the driven end is, harmonic by harmonic of y = sum Y e^{i w t},  x = w/w_1,

    F/Y = k (1 - 2 S),     S = sum_n x^2/(n^2 + 2 i zeta x n - x^2)

a sum in closed form, by partial fractions and the digamma function psi: with the roots r1, r2 = x (-i zeta +- sqrt(1 - zeta^2)) of n,

    S = x^2 (psi(1 - r2) - psi(1 - r1))/(r1 - r2)

Without damping F/Y = k pi x cot(pi x); for slow motion k - w^2 m/3, the rule of one third of the mass.
Derived here; the modes are those of a rod clamped at both ends (Rayleigh, The Theory of Sound, longitudinal vibrations; recalled).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import ArrayLike, Complexes, Floats, Numbers
from drivewright.cams.cycle import Extreme
from drivewright.cams.loads import Jump
from drivewright.numerics.jets import Jet, compose

SAMPLES = 8192  # places of the turn at which the motion of the driven end is known
COARSE = 2048  # the same while a speed is searched
FINEST = 5e-4  # step of the speeds that are looked through, over the speed
TURN = 2 * np.pi

Least: TypeAlias = Callable[[float], Extreme]  # of a speed [rad/s]: least force [N] over the turn, and where


@dataclass(frozen=True)
class SurgingSpring:
    """A coil spring: rate [N/m], mass of the active coils [kg], damping ratio of its modes."""

    stiffness: float
    mass: float
    damping: float

    @property
    def frequency(self) -> float:
        """First natural frequency w_1 = pi sqrt(k/m) [rad/s], both ends held."""
        return np.pi * np.sqrt(self.stiffness / self.mass)

    def surge_factor(self, frequency: ArrayLike) -> Complexes:
        """-2 S: complex force of surge over k y at circular frequencies [rad/s], beside the static force k y."""
        x = np.atleast_1d(np.asarray(frequency, dtype=float)) / self.frequency
        return -2 * _sum_of_modes(x, self.damping)


def _sum_of_modes(x, damping):
    """S(x), 0 at x = 0."""
    from scipy.special import digamma

    moving = np.where(x == 0, 1.0, x)
    turn = np.sqrt(1 - damping**2)
    first, second = moving * (turn - 1j * damping), moving * (-turn - 1j * damping)
    total = moving**2 * (digamma(1 - second) - digamma(1 - first)) / (first - second)
    return np.where(x == 0, 0.0, total)


class Harmonics(NamedTuple):
    """Complex amplitudes (n,) of a periodic quantity, sum Re(amplitude[h] e^{i h theta}), h = 0, 1, ..."""

    amplitude: Complexes

    def at(self, angle: Numbers) -> Jet:
        """Value and derivatives by the angle at angles (...)."""
        order = np.arange(len(self.amplitude))
        wave = np.exp(1j * np.asarray(angle, dtype=float)[..., None] * order)
        return Jet(*(np.real(wave @ (self.amplitude * (1j * order) ** power)) for power in range(4)))

    def sampled(self, count: int, derivative: int = 0) -> Floats:
        """The derivative of an order at `count` equal steps over the turn, from angle 0."""
        order = np.arange(len(self.amplitude))
        spectrum = np.zeros(count // 2 + 1, dtype=complex)
        spectrum[: len(order)] = self.amplitude * (1j * order) ** derivative * np.where(order == 0, 1.0, 0.5) * count
        return np.fft.irfft(spectrum, count)


def harmonics_of(samples: Floats, kept: int) -> Harmonics:
    """The first harmonics of samples at equal steps over a turn."""
    spectrum = np.fft.rfft(samples)[:kept] / len(samples)
    return Harmonics(np.where(np.arange(len(spectrum)) == 0, 1.0, 2.0) * spectrum)


def lift_harmonics(motion: Callable[[Floats], Floats], samples: int = SAMPLES) -> Harmonics:
    """`Harmonics` of a motion(angle) [m] over a turn, as many as an eighth of the samples."""
    return harmonics_of(motion(TURN * np.arange(samples) / samples), samples // 8)


@dataclass(frozen=True, eq=False)
class PeriodicSurge:
    """The surge of a spring whose driven end moves with the harmonics `lift` [m] at a speed [rad/s] of the cam."""

    spring: SurgingSpring
    lift: Harmonics
    speed: float

    @property
    def samples(self) -> int:
        """Places of the turn at which the force is kept."""
        return 8 * len(self.lift.amplitude)

    @cached_property
    def harmonics(self) -> Harmonics:
        """Harmonics of the force of surge [N]."""
        amplitude = self.lift.amplitude
        factor = self.spring.surge_factor(self.speed * np.arange(len(amplitude), dtype=float))
        return Harmonics(self.spring.stiffness * factor * amplitude)

    def sampled(self) -> Floats:
        """Force of surge [N] at the samples, at equal steps from angle 0."""
        return self.harmonics.sampled(self.samples)

    @cached_property
    def _nodes(self) -> Jet:
        """The force and its derivatives at the samples, with the end of the turn."""
        parts = (self.harmonics.sampled(self.samples, order) for order in range(4))
        return Jet(*(np.append(values, values[0]) for values in parts))

    def force(self, angle: Jet) -> Jet:
        """Force of surge [N] on the driven end, pressing it back where positive; between the samples by their derivatives."""
        step = TURN / self.samples
        place = np.mod(angle.d0, TURN) / step
        left = np.minimum(np.round(place).astype(int), self.samples)
        t, node = (place - left) * step, self._nodes
        f0, f1, f2, f3 = (part[left] for part in node)
        outer = Jet(f0 + t * (f1 + t * (f2 / 2 + t * f3 / 6)), f1 + t * (f2 + t * f3 / 2), f2 + t * f3, f3)
        return compose(outer, angle)

    def nearest_harmonic(self) -> tuple[int, float]:
        """(harmonic h of the motion that lies nearest to the first natural frequency, h speed/w_1)."""
        harmonic = max(1, round(self.spring.frequency / self.speed))
        return harmonic, harmonic * self.speed / self.spring.frequency


def jump_with_surge(screen: Least, least: Least, slowest: float, fastest: float, damping: float) -> Jump:
    """The `Jump` between two speeds [rad/s], by a scan from below and bisection; inf where the contact holds.

    least(speed): the least force over the turn [N] and where; screen(speed): the same, quickly.  Resonances of the spring make it go up and
    down with the speed, each over a part 2 zeta of its own speed: the steps are a quarter of that.
    """
    step = max(0.5 * damping, FINEST)
    speeds = slowest * (1 + step) ** np.arange(int(np.ceil(np.log(fastest / slowest) / np.log1p(step))) + 1)
    low = 0.0
    for speed in speeds:
        if screen(float(speed)).value < 0:
            return _bisected(least, low, float(speed))
        low = float(speed)
    return Jump(np.inf, np.nan)


def _bisected(least, low, high):
    """The jump between a speed at which the contact holds and one at which it opens."""
    for _ in range(36):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if least(middle).value < 0 else (middle, high)
    return Jump(high, least(high).angle)
