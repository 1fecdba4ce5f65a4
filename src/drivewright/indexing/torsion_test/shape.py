"""The shape of a closed loop: lost motion, backlash, hysteresis, pieces of stiffness.

A loop has two branches, angle over torque: loading (torque rising) below, unloading above.  Their mean is the mid-line.
"""

from typing import NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import Floats
from drivewright.indexing.torsion_test.passes import Passes

FINE = 400  # steps of the torque for areas
LOST_AT = 0.03  # of the rated torque: where lost motion is read
NEAR = 4  # samples at least of which a branch is read at one torque
TRIALS = (33, *[9] * 11)  # places of each breakpoint, search after search
STRAIGHT = 0.002  # of the span of the angle: a mid-line this straight (r.m.s.) has no breakpoints


class LoopShape(NamedTuple):
    """What a loop looks like; nan where the loop does not show it.

    lost_motion [rad]: angle between the mid-line at -3 % and +3 % of the rated torque; backlash [rad]: width of the loop at zero torque;
    hysteresis_energy [J]: area of the loop; hysteresis_loss: area over the work put in, 0 to 1;
    secant [N m/rad]: mid-line from 50 to 100 % of the rated torque; zero [rad]: angle of the mid-line at zero torque.
    """

    lost_motion: float
    backlash: float
    hysteresis_energy: float
    hysteresis_loss: float
    secant: float
    zero: float


class PiecewiseStiffness(NamedTuple):
    """Stiffness k1, k2, k3 [N m/rad] from zero torque on, changing at the torques t1 < t2 [N m]; t1, t2 nan where the line is straight.

    rms [rad] of the fit.
    """

    k1: float
    k2: float
    k3: float
    t1: float
    t2: float
    rms: float


Branch: TypeAlias = tuple[Floats, Floats]  # torque [N m], rising, and angle [rad]


class HysteresisLoop(NamedTuple):
    """The two branches as (torque, angle), torque rising; the torques [low, high] that both reach; the torques (from, to) at which they
    may be read: a turning point that only one branch has counts for the other, too, which is a step further on."""

    loading: Branch
    unloading: Branch
    low: float
    high: float
    readable: tuple[float, float]


def average_loop(passes: Passes, whole: float) -> HysteresisLoop | None:
    """The mean `HysteresisLoop` of some passes, or None with one branch only.  A pass over at least `whole` of the range is its branch;
    where none is so long, its parts together do."""
    loading, unloading = _branch(passes, True, whole), _branch(passes, False, whole)
    if loading is None or unloading is None:
        return None
    low, high = max(loading[0][0], unloading[0][0]), min(loading[0][-1], unloading[0][-1])
    span = np.ptp(passes.torque)
    if high - low <= 0.1 * span:
        return None
    step = max(0.02, 1.1 * sum(passes.span(passes.number == n) for n in range(len(passes.rising))) / passes.torque.size) * span
    ends = passes.torque.min() - 0.02 * span, passes.torque.max() + 0.02 * span
    return HysteresisLoop(loading, unloading, low, high, (max(low - step, ends[0]), min(high + step, ends[1])))


def _branch(passes: Passes, way: bool, whole: float) -> Branch | None:
    """(torque, angle) of a branch, sorted by torque: all samples of its whole passes."""
    numbers = np.flatnonzero(passes.rising == way)
    complete = [n for n in numbers if passes.span(passes.number == n) >= whole] or list(numbers)
    samples = np.isin(passes.number, complete)
    if np.sum(samples) < NEAR:
        return None
    order = np.argsort(passes.torque[samples], kind="stable")
    return passes.torque[samples][order], passes.angle[samples][order]


def measure_shape(loop: HysteresisLoop, rated: float) -> LoopShape:
    """The `LoopShape` of a `HysteresisLoop` for a rated torque [N m]."""
    step = LOST_AT * rated
    widths = [read_branch(branch, 0.0, step) for branch in (loop.unloading, loop.loading)] if _within(loop, 0.0) else [np.nan] * 2
    lost = mid_line(loop, step, step) - mid_line(loop, -step, step) if _within(loop, -step) and _within(loop, step) else np.nan
    energy, put_in = _work(loop)
    return LoopShape(
        lost, widths[0] - widths[1], energy, energy / put_in if put_in > 0 else np.nan, _secant(loop, rated, step), sum(widths) / 2
    )


def _secant(loop, rated, step):
    """Mid-line from half to full rated torque, over the senses that reach so far; nan where none does."""
    turns = [
        sense * (mid_line(loop, sense * rated, step) - mid_line(loop, sense * rated / 2, step))
        for sense in (1, -1)
        if _within(loop, sense * rated) and _within(loop, sense * rated / 2)
    ]
    return float(0.5 * rated / np.mean(turns)) if turns else np.nan


def _within(loop, torque):
    """Whether both branches may be read at a torque."""
    return loop.readable[0] <= torque <= loop.readable[1]


def mid_line(loop: HysteresisLoop, torque: float, reach: float) -> float:
    """Angle of the mid-line at a torque, read from samples within `reach` [N m]."""
    return 0.5 * (read_branch(loop.loading, torque, reach) + read_branch(loop.unloading, torque, reach))


def read_branch(branch: Branch, torque: float, reach: float) -> float:
    """Angle of a branch at a torque: the straight line through its samples within `reach`.

    Where these are fewer than 4, the 4 nearest ones: exact on a straight branch however it is sampled.
    """
    x, y = branch
    near = np.abs(x - torque) <= reach
    if np.sum(near) < NEAR or np.ptp(x[near]) < 0.5 * reach:
        near = np.argsort(np.abs(x - torque), kind="stable")[:NEAR]
    middle, mean = np.mean(x[near]), np.mean(y[near])
    spread = np.sum((x[near] - middle) ** 2)
    slope = np.sum((x[near] - middle) * (y[near] - mean)) / spread if spread > 0 else 0.0
    return float(mean + slope * (torque - middle))


def torques(loop: HysteresisLoop) -> Floats:
    """Torques [N m] of a fine walk along a loop, zero among them."""
    places = np.linspace(loop.low, loop.high, FINE + 1)
    return np.union1d(places, [0.0]) if loop.low < 0 < loop.high else places


def _work(loop: HysteresisLoop) -> tuple[float, float]:
    """(area, work put in) [J] of the loop loading - unloading - back: dW = T d(angle), put in where it is positive."""
    t = torques(loop)
    forth, back = (np.interp(t, *branch) for branch in (loop.loading, loop.unloading))
    torque, angle = np.concatenate([t, t[::-1], t[:1]]), np.concatenate([forth, back[::-1], forth[:1]])
    steps = 0.5 * (torque[1:] + torque[:-1]) * np.diff(angle)
    return float(steps.sum()), float(np.sum(np.maximum(steps, 0.0)))


def fold_mid_line(loop: HysteresisLoop) -> Branch | None:
    """(torque, angle) of the mid-line from zero torque on: the mean of both senses where both are there, or None.

    Both turn at zero torque; angle(0) = 0 for two senses by symmetry.
    """
    t, both, most = torques(loop), min(loop.high, -loop.low), max(loop.high, -loop.low)
    line = 0.5 * (np.interp(t, *loop.loading) + np.interp(t, *loop.unloading))
    if both > 0.5 * most:
        size = np.linspace(0.0, both, FINE // 2 + 1)
        return size, 0.5 * (np.interp(size, t, line) - np.interp(-size, t, line))
    if not _within(loop, 0.0):
        return None
    size, sign = np.linspace(0.0, most, FINE // 2 + 1), 1.0 if loop.high > -loop.low else -1.0
    along = np.interp(sign * size, t, line)
    return size, sign * (along - along[0])


def fit_pieces(torque: Floats, angle: Floats) -> PiecewiseStiffness:
    """The `PiecewiseStiffness` of angle (m,) over torque (m,) >= 0 through the origin, by least squares.

    angle = min(T, t1)/k1 + clip(T - t1, 0, t2 - t1)/k2 + max(T - t2, 0)/k3.  For given t1, t2 that is linear; these are searched on a
    grid that closes in on the best pair.
    """
    top, span = float(torque[-1]), float(np.ptp(angle))
    straight = float(torque @ angle / (torque @ torque))
    rms = float(np.sqrt(np.mean((angle - straight * torque) ** 2)))
    if rms <= STRAIGHT * span:
        return PiecewiseStiffness(1 / straight, 1 / straight, 1 / straight, np.nan, np.nan, rms)
    low, high = np.array([0.02, 0.02]) * top, np.array([0.98, 0.98]) * top
    best, misfit, slopes = _best_pair(torque, angle, low, high, TRIALS[0])
    for trials in TRIALS[1:]:
        width = 0.3 * (high - low)
        low, high = np.maximum(best - width, 0.005 * top), np.minimum(best + width, 0.995 * top)
        best, misfit, slopes = _best_pair(torque, angle, low, high, trials)
    with np.errstate(divide="ignore"):
        k1, k2, k3 = (1 / slopes).tolist()
    t1, t2 = best.tolist()
    return PiecewiseStiffness(k1, k2, k3, t1, t2, float(np.sqrt(misfit / torque.size)))


def _best_pair(torque: Floats, angle: Floats, low: Floats, high: Floats, trials: int) -> tuple[Floats, float, Floats]:
    """(t1, t2), sum of squares and compliances of the best pair of a grid."""
    t1, t2 = (grid.ravel() for grid in np.meshgrid(np.linspace(low[0], high[0], trials), np.linspace(low[1], high[1], trials)))
    apart = t2 - t1 >= 0.02 * torque[-1]
    t1, t2 = t1[apart, None], t2[apart, None]
    basis = np.stack([np.minimum(torque, t1), np.clip(torque - t1, 0, t2 - t1), np.maximum(torque - t2, 0)])  # (piece, pair, sample)
    slopes = np.linalg.solve(np.einsum("ips,jps->pij", basis, basis), np.einsum("ips,s->pi", basis, angle)[:, :, None])[:, :, 0]
    misfit = np.sum((angle - np.einsum("ips,pi->ps", basis, slopes)) ** 2, axis=1)
    best = int(np.argmin(misfit))
    return np.array([t1[best, 0], t2[best, 0]]), float(misfit[best]), slopes[best]
