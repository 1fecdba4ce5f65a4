"""Numbers for a motion with play: peaks and the impact load coefficient beside the ideal mechanism's peak."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.numerics import signals

LARGEST = 5  # peaks of which the coefficient is the mean
BLOCK = 2**17  # samples at a time: what is known of each takes some ten times the space of its value
EVEN = 3.0  # neighbouring steps whose sizes differ by more than this are no place for a parabola


class ImpactLoad(NamedTuple):
    """Of a magnitude in a window, over the ideal peak: mean of the five largest local maxima, the largest, the 95th percentile, the root
    mean square, and the mean and standard deviation of the largest of each turn."""

    coefficient: float
    largest: float
    percentile: float
    rms: float
    turn_mean: float
    turn_spread: float


def peaks(t: Floats, x: Floats) -> tuple[Floats, Floats]:
    """(times, values) of the local maxima of samples (m,), on the parabola through three of them where their steps are alike.

    In a signal with impacts the steps differ by orders of magnitude; there the sample itself counts.
    """
    _, times, values = _peaks_of_rows(t, x[None])
    return times, values


def _peaks_of_rows(t, x):
    """(rows, times, values) of the `peaks` of signals x (k, m)."""
    rows, times, values = signals.local_maxima_of_rows(t, x)
    at = np.clip(np.searchsorted(t, times), 1, len(t) - 2)
    at = np.where(x[rows, at - 1] > x[rows, at], at - 1, at)
    at = np.clip(np.where(x[rows, np.minimum(at + 1, len(t) - 1)] > x[rows, at], at + 1, at), 1, len(t) - 2)
    before, after = t[at] - t[at - 1], t[at + 1] - t[at]
    even = (before < EVEN * after) & (after < EVEN * before)
    return rows, np.where(even, times, t[at]), np.where(even, values, x[rows, at])


def highest(t: Floats, x: Floats) -> Floats:
    """Largest values (k,) of signals x (k, m) over the samples and the vertices between them."""
    top = np.max(x, axis=1)
    if len(t) > 2:
        step = max(1, BLOCK // len(t))
        for first in range(0, len(x), step):
            rows, _, values = _peaks_of_rows(t, x[first : first + step])
            np.maximum.at(top, first + rows, values)
    return top


def largest(t: Floats, x: Floats) -> float:
    """Largest of |x| over the samples and the vertices between them."""
    return float(highest(t, np.abs(x)[None])[0])


def impact_load(t: Floats, x: Floats, ideal_peak: float, period: float | None) -> ImpactLoad:
    """`ImpactLoad` of |x| over the window t; nan where the window has fewer than five peaks, or the ideal mechanism none."""
    size = np.abs(x)
    times, values = peaks(t, size)
    if len(values) < LARGEST or not ideal_peak > 0:
        return ImpactLoad(*[np.nan] * 6)
    turns = np.floor((times - t[0]) / period).astype(int) if period else np.zeros(len(times), int)
    whole = max(int((t[-1] - t[0]) / period + 1e-9), 1) if period else 1
    of_turn = np.array([np.max(values[turns == turn], initial=0.0) for turn in range(whole)])
    statistics = (
        signals.mean_of_largest(values, LARGEST),
        largest(t, x),
        signals.percentile(t, size, 95),
        signals.root_mean_square(t, size),
        np.mean(of_turn),
        np.std(of_turn),
    )
    return ImpactLoad(*(float(value) / ideal_peak for value in statistics))
