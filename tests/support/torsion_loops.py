"""Made-up torsion tests: loops whose stiffness, play and hysteresis are known."""

import numpy as np

from drivewright.indexing.torsion_test import Readings


def parallelogram(k=2e5, h=1e-3, top=1000.0, samples=41, cycles=1, start=0):
    """Branches angle = T/k -+ h over -top ... top, evenly spaced torques, begun `start` samples into the loop; half width h in angle."""
    up = np.linspace(-top, top, samples)
    torque = np.tile(np.concatenate([up, up[::-1]]), cycles)
    shift = np.tile(np.repeat([-h, h], samples), cycles)
    return Readings(np.roll(torque, -start), np.roll(torque / k + shift, -start))


def whole_loop_of(k, h, top, samples):
    """Slope of T on angle of that parallelogram: k/(1 + h^2 k^2/var T), var T = top^2 (N + 1)/(3 (N - 1)) for N even steps."""
    return k / (1 + (h * k) ** 2 / (top**2 * (samples + 1) / (3 * (samples - 1))))


def there_and_back(top=1000.0, samples=40, cycles=1):
    """Torques 0 -> top -> -top -> 0, each cycle 4 * samples long, ending one step before 0."""
    quarter = np.linspace(0, top, samples, endpoint=False)
    return np.tile(np.concatenate([quarter, top - quarter, -quarter, quarter - top]), cycles)


def first_order(rng, size, rho, spread):
    """Errors e_t = rho e_(t-1) + white, of a spread, stationary."""
    errors = rng.normal(0, spread, size)
    errors[1:] *= np.sqrt(1 - rho**2)
    for sample in range(1, size):
        errors[sample] += rho * errors[sample - 1]
    return errors
