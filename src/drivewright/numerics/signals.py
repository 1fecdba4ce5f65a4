"""Sampled signals x(t) with uneven steps: maxima, averages over time, spectra in orders of a period.

Averages are those of the polygon, the straight lines between the samples: exact for it, and for a smooth signal with steps h in
error by at most h^2 max|x''|/8.  Times ascend and may repeat: the first and the last sample of a time are the values on its two sides,
what lies between them counts for nothing, and no parabola or spline is laid across it.
"""

import math

import numpy as np

from drivewright._typing import ArrayLike, Floats, Ints
from drivewright.errors import InputError
from drivewright.numerics.splines import Cubics, cubic_spline


def local_maxima(t: ArrayLike, x: ArrayLike) -> tuple[Floats, Floats]:
    """(times, values) of the inner maxima of x, each at the vertex of the parabola through its three samples.

    t, x (m,).  Exact for a parabola; for a smooth signal with steps up to h the value is off by at most h^3 max|x'''|/(9 sqrt 3).
    Two equal samples side by side are the shoulders of one maximum, more are a plateau, counted once at its middle.  The ends
    never count.  Beside a jump at one time the sample itself counts.  After a sharp rise within a step h the vertex may lie
    (rise) k^2/(4 h (h + k)) above the samples where a step k follows: sample such a rise evenly.
    """
    t, x = _signal(t, x)
    _, times, values = _maxima(t, x[None])
    return times, values


def local_maxima_of_rows(t: ArrayLike, x: ArrayLike) -> tuple[Ints, Floats, Floats]:
    """(rows, times, values) of the `local_maxima` of many signals x (k, m) at the same times t (m,), one row after the other."""
    t, x = np.asarray(t, dtype=float), np.asarray(x, dtype=float)
    if x.shape[1:] == t.shape and t.size >= 3 and np.all(np.isfinite(t)) and np.all(np.isfinite(x)) and np.all(np.diff(t) > 0):
        return _maxima(t, x)
    found = [local_maxima(t, row) for row in x]  # of times that repeat each row keeps its own samples
    rows = np.repeat(np.arange(len(found)), [times.size for times, _ in found])
    return rows, np.concatenate([times for times, _ in found]), np.concatenate([values for _, values in found])


def _maxima(t, x):
    """(rows, times, values) of the inner maxima of signals x (k, m) over ascending times t (m,)."""
    begins = np.ones(x.shape, bool)
    begins[:, 1:] = x[:, 1:] != x[:, :-1]
    length, t, x = t.size, np.broadcast_to(t, x.shape).ravel(), x.ravel()
    first = np.flatnonzero(begins)  # where each run of equal samples begins ...
    last = np.append(first[1:], x.size) - 1  # ... and ends
    level = x[first]
    top = 1 + np.flatnonzero((level[1:-1] > level[:-2]) & (level[1:-1] > level[2:]))
    top = top[(first[top] % length > 0) & (last[top] % length < length - 1)]
    first, last = first[top], last[top]
    before = _vertex(t, x, first - 1, first, first + 1)
    after = before if np.array_equal(first, last) else _vertex(t, x, last - 1, last, last + 1)
    flat = last - first > 1
    plateau = 0.5 * (t[first] + t[last]), x[first]
    times, tops = (np.where(flat, level, 0.5 * (a + b)) for a, b, level in zip(before, after, plateau, strict=True))
    return first // length, times, tops


def _vertex(t, x, i, j, k):
    """(time, value) of the vertex of the parabola through the samples i, j, k, by divided differences about sample j; the sample j
    itself beside a jump, where two of the times are one."""
    h, step = np.stack([t[j] - t[i], t[k] - t[j]]), np.stack([x[j] - x[i], x[k] - x[j]])
    jump = np.any(h == 0, axis=0)
    left, right = step / np.where(jump, 1.0, h)
    curvature = (right - left) / np.where(jump, 1.0, t[k] - t[i])
    slope = (left * h[1] + right * h[0]) / np.where(jump, 1.0, t[k] - t[i])
    safe_curvature = np.where(jump, 1.0, curvature)
    return t[j] - np.where(jump, 0.0, slope / (2 * safe_curvature)), x[j] - np.where(jump, 0.0, slope**2 / (4 * safe_curvature))


def mean_of_largest(values: ArrayLike, count: int) -> float:
    """Mean of the `count` largest of the values (m,); InputError where there are fewer."""
    values = np.asarray(values, dtype=float)
    if not 1 <= count <= values.size:
        raise InputError(f"mean_of_largest: the {count} largest of {values.size} values do not exist; lengthen the run or lower the count.")
    return float(np.mean(np.sort(values)[-count:]))


def time_mean(t: ArrayLike, x: ArrayLike) -> float:
    """Integral of x over the duration, divided by it (trapezoidal rule)."""
    t, x = _signal(t, x)
    return float(np.sum(np.diff(t) * 0.5 * (x[1:] + x[:-1])) / (t[-1] - t[0]))


def root_mean_square(t: ArrayLike, x: ArrayLike) -> float:
    """Square root of the time mean of x^2; from a to b in a straight line that is (a^2 + a b + b^2)/3."""
    t, x = _signal(t, x)
    a, b = x[:-1], x[1:]
    return float(np.sqrt(np.sum(np.diff(t) * (a * a + a * b + b * b) / 3) / (t[-1] - t[0])))


def percentile(t: ArrayLike, x: ArrayLike, q: float) -> float:
    """The level that x stays at or below for q % of the time; 0 gives the least value, 100 the largest."""
    t, x = _signal(t, x)
    if not 0 <= q <= 100:
        raise InputError(f"percentile: q must lie in 0 .. 100, got {q:g}.")
    levels, wanted = np.unique(x), q / 100 * (t[-1] - t[0])
    low, high = -1, levels.size - 1  # up to `low` too little time, up to `high` enough
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if _time_below(t, x, levels[middle])[1] >= wanted else (middle, high)
    if low < 0:
        return float(levels[0])
    start, end = _time_below(t, x, levels[low])[1], _time_below(t, x, levels[high])[0]
    share = min((wanted - start) / (end - start), 1.0) if end > start else 1.0
    return float(levels[low] + share * (levels[high] - levels[low]))


def _time_below(t, x, level):
    """Time for which the polygon is (below, at or below) the level."""
    h, low, high = np.diff(t), np.minimum(x[:-1], x[1:]), np.maximum(x[:-1], x[1:])
    flat = high == low
    share = np.clip((level - low) / np.where(flat, 1.0, high - low), 0.0, 1.0)
    below = float(np.sum(h * np.where(flat, level > low, share)))
    return below, below + float(np.sum(h[flat & (low == level)]))


def order_spectrum(t: ArrayLike, x: ArrayLike, period: float, orders: ArrayLike) -> Floats:
    """Amplitude of x at each order: of the harmonic with that many oscillations per period; at order 0 the size of the mean.

    t, x (m,) from start to end of a whole number N of periods; orders (k,) multiples of 1/N, so that 1/2 shows a doubled period.
    The samples are joined by a cubic spline, whose averages over even cells are transformed: exact for the spline but for
    oscillations faster than the samples, of which at most 1/15 folds back.  The spline is in error by about
    (5/384) h^4 max|x''''| for steps h: an amplitude by 2e-4 of itself with 33 scattered samples per oscillation, 1e-6 with 133.
    A jump at one time is kept; a rise within a short step, with long steps beside it, makes the spline overshoot: sample it evenly.
    """
    t, x = _signal(t, x)
    turns = _turns(t, period)
    if abs(turns - round(turns)) > 1e-6 or turns < 0.5:
        raise InputError(
            f"order_spectrum: the signal covers {turns:.7g} periods, but must cover a whole number of them. "
            "Cut it there and keep the samples at both ends."
        )
    turns = round(turns)
    bins = _bins(orders, turns, t.size - 1)
    return _amplitudes(_spline(t, x).integrals_to, t[0], t[-1], bins, t.size)


def highest_peaks(frequency: Floats, amplitude: Floats, count: int) -> Floats:
    """Frequencies (count,) of the highest local maxima of amplitudes (n,), highest first; nan where there are fewer."""
    tops = np.flatnonzero((amplitude[1:-1] > amplitude[:-2]) & (amplitude[1:-1] >= amplitude[2:])) + 1
    best = tops[np.argsort(-amplitude[tops])][:count]
    return np.pad(frequency[best], (0, count - len(best)), constant_values=np.nan)


def spectrogram(t: ArrayLike, x: ArrayLike, period: float, orders: ArrayLike, turns: int = 1) -> tuple[Floats, Floats]:
    """(times, amplitudes): `order_spectrum` of windows of `turns` whole periods, each one period later; times of their middles.

    t, x (m,) over any time, the rest behind the last whole period is left out; orders (k,) multiples of 1/turns;
    amplitudes (windows, k).  A window has sharp ends: what does not repeat within it spreads over the orders.
    """
    t, x = _signal(t, x)
    count = int(_turns(t, period) + 1e-6) - turns + 1
    if turns < 1 or count < 1:
        raise InputError(f"spectrogram: no window of {turns} periods fits into a signal of {_turns(t, period):.4g}; lengthen the run.")
    samples = int(t.size * turns * period / (t[-1] - t[0]))
    bins, integral = _bins(orders, turns, samples), _spline(t, x).integrals_to
    start = t[0] + period * np.arange(count)
    rows = [_amplitudes(integral, a, min(a + turns * period, t[-1]), bins, samples) for a in start]
    return start + 0.5 * turns * period, np.array(rows)


def _turns(t, period):
    if not period > 0:
        raise InputError(f"spectrum: the period must be above 0, got {period:g}.")
    return (t[-1] - t[0]) / period


def _spline(t, x):
    """The cubic spline through the samples, begun anew at every jump."""
    ends = np.flatnonzero(np.diff(t) == 0) + 1  # a piece begins where the time before it is the same
    pieces = [cubic_spline(a, b) for a, b in zip(np.split(t, ends), np.split(x, ends), strict=True) if a.size > 1]
    return Cubics(np.unique(t), np.concatenate([piece.coefficients for piece in pieces], axis=1))


def _bins(orders, turns, samples):
    """Oscillations of each order within the window of so many turns."""
    orders = np.atleast_1d(np.asarray(orders, dtype=float))
    bins = np.round(orders * turns)
    if np.any(np.abs(orders * turns - bins) > 1e-6) or np.any(bins < 0):
        worst = orders[np.argmax(np.abs(orders * turns - bins) + (bins < 0))]
        raise InputError(f"spectrum: order {worst:g} is no multiple of 1/{turns}, the resolution of {turns} periods; lengthen the window.")
    if 2 * np.max(bins) >= samples:
        raise InputError(
            f"spectrum: order {np.max(orders):g} oscillates {np.max(bins):.0f} times among {samples} samples; "
            "it takes more than 2 samples each, better 20. Sample more finely."
        )
    return bins.astype(int)


def _amplitudes(integral, start, end, bins, samples):
    """Amplitudes over [start, end] from averages over even cells, whose own damping sin(c)/c, c = pi bin/cells, is taken out."""
    cells = 2 ** math.ceil(math.log2(max(2 * samples, 16 * int(np.max(bins)))))
    edges = np.linspace(start, end, cells + 1)
    averages = np.diff(integral(edges)) * cells / (end - start)
    transform = np.abs(np.fft.rfft(averages))[bins] / cells / np.sinc(bins / cells)
    return np.where(bins == 0, transform, 2 * transform)


def _signal(t, x):
    """t and x as floats, of each time its two sides at most; InputError unless they are finite, of one length, and t ascends over some
    time."""
    t, x = np.asarray(t, dtype=float), np.asarray(x, dtype=float)
    if t.ndim != 1 or x.shape != t.shape or t.size < 3:
        raise InputError(f"signal: t and x must be rows of one length, 3 samples or more; got shapes {t.shape} and {x.shape}.")
    if not (np.all(np.isfinite(t)) and np.all(np.isfinite(x))):
        bad = int(np.argmin(np.isfinite(t) & np.isfinite(x)))
        raise InputError(f"signal: sample {bad} is not finite (t = {t[bad]:g}, x = {x[bad]:g}); cut the run before it.")
    step = np.diff(t)
    if np.any(step < 0) or t[-1] == t[0]:
        bad = int(np.argmax(step < 0))
        raise InputError(f"signal: t must increase, but t[{bad + 1}] = {t[bad + 1]:g} follows {t[bad]:g}; sort the samples.")
    return _sides(t, x, step) if np.any(step == 0) else (t, x)


def _sides(t, x, step):
    """The first and the last sample of every time; the one where both are equal."""
    first, last = np.append(True, step > 0), np.append(step > 0, True)
    before = np.maximum.accumulate(np.where(first, np.arange(t.size), 0))  # where the time of each sample begins
    keep = first | (last & (x != x[before]))
    return t[keep], x[keep]
