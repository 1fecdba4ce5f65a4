"""Regular or chaotic: the largest Lyapunov exponent of a map, and the period of its orbit."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError, SolverError

_BLOCKS = 16


class Exponent(NamedTuple):
    """Largest Lyapunov exponent: mean growth per cycle of the logarithm of a small separation.

    per_cycle: nats per application of the map; error: its standard error from the spread of 16 block means, itself known to about
    a fifth, which covers neither a transient left in nor a change of attractor; history (cycles,): the mean after 1, 2 ... cycles;
    widest: largest separation met within a cycle, in scales.  Near 1 it is no longer small and the exponent is too low.
    """

    per_cycle: float
    error: float
    history: Floats
    widest: float


def largest_exponent(
    step: Callable[[Floats], ArrayLike],
    state: ArrayLike,
    scales: ArrayLike,
    *,
    cycles: int,
    discard: int,
    rng: np.random.Generator,
    separation: float = 1e-8,
    continuous: ArrayLike | None = None,
) -> Exponent:
    """`Exponent` of the map step(state) -> state, from `cycles` applications after `discard` uncounted ones (Benettin's method).

    state (n,); scales: typical size of each component, (n,) or one for all.  A twin starts at `separation` scales from the state
    in a random direction; after each cycle the logarithm of the growth is taken and the twin is set back to that separation in
    the direction found.  `continuous` (n,) is False for what is memory rather than motion (flags, the data of a contact under
    way): the twin takes it over from the state, and it does not count as separation.
    Growth is known to about 1e-16/separation per cycle.  A twin that falls onto the state is counted as if at the rounding of the
    state and starts in a new direction, so a decay beyond ln(1e-16/separation) per cycle is given by an upper bound.
    Benettin, Galgani, Giorgilli & Strelcyn, Meccanica 15 (1980), recalled.  SolverError, with the history so far as `partial`,
    where the map leaves the finite numbers or grows until the separation drowns in rounding.
    """
    state, scales, free = _prepared(state, scales, continuous, cycles, discard, separation)
    direction, growth, widest = _random_direction(scales, rng), np.empty(cycles), 0.0
    for number in range(-discard, cycles):
        twin = state.copy()
        twin[free] += separation * scales * direction
        start = np.linalg.norm((twin[free] - state[free]) / scales)  # what rounding has made of the separation
        state, twin = np.array(step(state), dtype=float), np.array(step(twin), dtype=float)  # copies: both may be one buffer of step's
        if not (_resolved(state[free], scales, separation) and np.all(np.isfinite(twin[free]))):
            raise _left(growth[: max(number, 0)], number + discard + 1)
        gap = (twin[free] - state[free]) / scales
        size = np.linalg.norm(gap)
        direction = gap / size if size > 0 else _random_direction(scales, rng)
        if number >= 0:
            growth[number] = np.log(max(size, _rounding(state[free], scales)) / start)
            widest = max(widest, float(size))
    history = _running_mean(growth)
    return Exponent(float(history[-1]), _block_error(growth), history, widest)


def _prepared(state, scales, continuous, cycles, discard, separation):
    """Copy of the state, scales of its continuous components, and where these are."""
    state = np.array(state, dtype=float)
    free = np.ones(state.shape, dtype=bool) if continuous is None else np.asarray(continuous, dtype=bool)
    if state.ndim != 1 or free.shape != state.shape or not np.any(free):
        raise InputError(
            f"largest_exponent: the state must be a row with a flag each, one continuous at least; "
            f"got shapes {state.shape} and {free.shape}, {np.count_nonzero(free)} continuous."
        )
    scales = np.broadcast_to(np.asarray(scales, dtype=float), state.shape)[free]
    if not np.all(scales > 0):
        raise InputError(f"largest_exponent: every scale must be above 0, got {np.min(scales):g}; give the typical size of the motion.")
    if cycles < 2 * _BLOCKS or discard < 0:
        raise InputError(f"largest_exponent: the error bar takes {2 * _BLOCKS} cycles or more, got {cycles} (and {discard} to discard).")
    if not (_resolved(state[free], scales, separation) and separation <= 1e-2):
        raise InputError(
            f"largest_exponent: a separation of {separation:g} must be small, at most 0.01, and far above the rounding of the state, "
            f"{_rounding(state[free], scales):.1e} of the scales. Correct the scales, or wrap a large angle."
        )
    return state, scales, free


def _resolved(state, scales, separation):
    """Whether the separation stands well above the rounding of the state; False where that is not finite."""
    return 100 * _rounding(state, scales) < separation


def _rounding(state, scales):
    """Size of the last digit of the largest component, in scales; of 1 at least."""
    return np.finfo(float).eps * max(1.0, np.max(np.abs(state) / scales))


def _random_direction(scales, rng):
    direction = rng.normal(size=scales.size)
    return direction / np.linalg.norm(direction)


def _left(growth, cycles):
    return SolverError(
        f"largest_exponent: after {cycles} cycles the state or its twin is no longer finite, or so large that the separation is "
        "below its rounding error. Start nearer to the attractor, wrap an angle that grows, or correct the scales.",
        partial=_running_mean(growth),
    )


def _running_mean(growth):
    return np.cumsum(growth) / np.arange(1, growth.size + 1)


def _block_error(growth):
    """Standard error of the mean from the means of equally long blocks, the remainder at the front left out."""
    length = growth.size // _BLOCKS
    means = growth[-length * _BLOCKS :].reshape(_BLOCKS, length).mean(axis=1)
    return float(np.std(means, ddof=1) / np.sqrt(_BLOCKS))


def orbit_period(points: ArrayLike, tolerance: ArrayLike) -> int:
    """Number of distinct points that an orbit visits in turn: 1 for a fixed point, 2 after a doubling ...; 0 where it never repeats.

    points (m,) or (m, k): successive states of a map after its transient; tolerance: how far visits of one point may differ, a
    number or one per component (k,).  The period is the least p for which every point lies within tolerance of the one among the
    last p that comes a multiple of p steps later, so that a slow drift is no period.  Each point must be visited three times:
    periods up to m/3 are seen.
    """
    points = np.asarray(points, dtype=float)
    points = points[:, None] if points.ndim == 1 else points
    if points.ndim != 2 or len(points) < 3 or not np.all(np.isfinite(points)) or not np.all(np.asarray(tolerance) > 0):
        raise InputError(f"orbit_period: needs 3 finite points or more and a tolerance above 0, got shape {points.shape} and {tolerance}.")
    backwards = points[::-1]
    for period in range(1, len(points) // 3 + 1):
        last = backwards[np.arange(len(points)) % period]
        if np.all(np.abs(backwards - last) <= tolerance):
            return period
    return 0
