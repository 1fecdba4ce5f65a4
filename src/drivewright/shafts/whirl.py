"""Whirl of a turning rotor: frequencies and damping at a speed, the Campbell diagram, critical speeds with damping, stability.

An eigenvalue l of  l^2 M + l (C + s G) + K + N = 0  is found by its inverse m = 1/l, for which no mass need be regular:

    m^2 (K + N) + m (C + s G) + M = 0,    the largest |m| are the lowest frequencies and the best determined.

Im l is the damped frequency, -Re l/|l| the damping ratio.  A point on the axis moves on an ellipse, X and Y its complex amplitudes: the
sum of a circle with the shaft of radius |X + iY|/2 and one against it of |X - iY|/2.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Complexes, Floats, Ints
from drivewright.numerics.roots import roots_in_brackets
from drivewright.shafts.rotor import Rotor

LEAST = 1e-3  # of the magnitude of an eigenvalue: with less the motion creeps back and is no vibration
NEGLIGIBLE = 1e-6  # of the largest inverse eigenvalue of a vibration: where there is no mass rounding makes one
LINE = 1e-6  # sense of an ellipse that is a line: neither with the shaft nor against it
NOISE = 1e-9  # damping ratio that is rounding


class WhirlModes(NamedTuple):
    """The lateral modes (m,) of a rotor at a speed [rad/s], by rising frequency.

    frequency [rad/s]: damped; damping_ratio [-]; sense [-]: 1 where all points go round with the shaft, -1 against it, 0 on a line;
    forward: whether the mode counts as one with the shaft; shapes (2, n, m): complex amplitudes of x and y at the nodes.
    """

    speed: float
    frequency: Floats
    damping_ratio: Floats
    sense: Floats
    forward: Bools
    shapes: Complexes

    @property
    def log_decrement(self) -> Floats:
        """(m,) 2 pi zeta/sqrt(1 - zeta^2): how the logarithm of the amplitude falls in one round."""
        return 2 * np.pi * self.damping_ratio / np.sqrt(1 - self.damping_ratio**2)

    def chosen(self, forward: bool) -> Ints:
        """Numbers of the modes with the shaft, or of those against it, by rising frequency."""
        return np.flatnonzero(self.forward == forward)


def whirl_modes(rotor: Rotor, speed: float, count: int) -> WhirlModes:
    """The `WhirlModes` at a speed [rad/s]: the lowest `count` with the shaft and as many against it."""
    return _sorted(rotor, speed, *_eigenpairs(rotor, np.array([speed])), count)


def _eigenpairs(rotor, speeds):
    """(inverse eigenvalues (speeds, 2r), vectors (speeds, r, 2r)) with time in units of the reference."""
    r, unit = len(rotor.mass), rotor.reference
    damping = unit * (rotor.damping + speeds[:, None, None] * rotor.gyroscopic)
    softer = np.linalg.inv(np.eye(r) + rotor.circulatory)
    whole = np.zeros((len(speeds), 2 * r, 2 * r), complex if rotor.whirls else float)
    whole[:, :r, :r], whole[:, :r, r:] = -softer @ damping, -softer @ (unit**2 * rotor.mass)
    whole[:, r:, :r] = np.eye(r)
    inverse, vectors = np.linalg.eig(whole)
    return inverse, vectors[:, r:]


def _sorted(rotor, speed, inverse, vectors, count):
    """The `WhirlModes` among the eigenpairs of one speed."""
    inverse, vectors = inverse[0], vectors[0]
    moves = np.abs(inverse.imag) > LEAST * np.abs(inverse)
    moves &= np.abs(inverse) > NEGLIGIBLE * np.abs(inverse[moves]).max(initial=0.0)
    chosen = np.flatnonzero(moves if rotor.whirls else moves & (inverse.imag < 0))
    chosen = chosen[np.argsort(-np.abs(inverse[chosen]), kind="stable")]
    value, vector = rotor.reference / inverse[chosen], vectors[:, chosen]
    along, whole = (np.sum(np.conj(vector) * (mass @ vector), axis=0).real for mass in (rotor.axial_mass, rotor.mass))
    lateral = along < 0.5 * whole
    value, shapes = value[lateral], (rotor.shapes @ vector)[:, :, lateral]
    shapes = np.where(value.imag < 0, np.conj(shapes), shapes)
    frequency, ratio = np.abs(value.imag), -value.real / np.abs(value)
    order = np.argsort(frequency, kind="stable")
    sense = _sense(shapes)[order]
    forward = _counted(sense)
    kept = np.sort(np.concatenate([np.flatnonzero(forward == way)[:count] for way in (True, False)]))
    own = order[kept]
    damped = np.zeros(len(own)) if rotor.is_conservative else np.where(np.abs(ratio[own]) > NOISE, ratio[own], 0.0)
    return WhirlModes(speed, frequency[own], damped, sense[kept], forward[kept], shapes[:, :, own])


def _sense(shapes):
    """(m,) how much of the motion goes round with the shaft less how much against it."""
    x, y = shapes
    ahead, back = (np.sum(np.abs(x + way * 1j * y) ** 2, axis=0) for way in (1, -1))
    return (ahead - back) / (ahead + back)


def _counted(sense):
    """Whether each mode counts as one with the shaft; of those on a line, by turns, the lower against it: so they part once it turns."""
    forward, on_line = sense > 0, np.abs(sense) < LINE
    forward[on_line] = np.arange(on_line.sum()) % 2 == 1
    return forward


# -- over the speed ------------------------------------------------------------------------------------------------------------


class Campbell(NamedTuple):
    """Whirl over the speeds (k,) [rad/s]: frequency [rad/s], damping ratio and sense (k, m) of branches that go on from speed to speed;
    nan where a branch has no vibration.  Branches rise at the last speed."""

    speeds: Floats
    frequency: Floats
    damping_ratio: Floats
    sense: Floats


def campbell(rotor: Rotor, speeds: Sequence[float] | Floats, count: int) -> Campbell:
    """The `Campbell` diagram at rising speeds [rad/s], its branches the 2 `count` lowest modes at the first speed.

    A branch goes on with the mode that is nearest to where it leads and whose shape is most alike.
    """
    speeds = np.asarray(speeds, float)
    pairs = _eigenpairs(rotor, speeds)
    each = [_sorted(rotor, s, inverse[None], vectors[None], 2 * count) for s, inverse, vectors in zip(speeds, *pairs, strict=True)]
    rows = [np.arange(min(2 * count, len(each[0].frequency)))]
    for before, after in zip(each, each[1:], strict=False):
        rows.append(_continued(rows, before, after))
    table = np.full((3, len(speeds), len(rows[0])), np.nan)
    for k, (modes, row) in enumerate(zip(each, rows, strict=True)):
        on = row >= 0
        table[:, k, on] = np.array([modes.frequency, modes.damping_ratio, modes.sense])[:, row[on]]
    order = np.argsort(np.nan_to_num(table[0, -1], nan=np.inf), kind="stable")
    return Campbell(speeds, *table[:, :, order])


def _continued(rows, before, after):
    """Numbers among the modes `after` for every branch, -1 where it ends: the nearest pair first, then the nearest of the others."""
    row, found = rows[-1], np.full(len(rows[-1]), -1)
    apart = np.abs(np.log(after.frequency / before.frequency[row, None])) + (1 - _likeness(before, after)[row])
    apart[row < 0] = np.inf
    for _ in range(min(np.sum(row >= 0), len(after.frequency))):
        ours, theirs = np.unravel_index(np.argmin(apart), apart.shape)
        found[ours] = theirs
        apart[ours], apart[:, theirs] = np.inf, np.inf
    return found


def _likeness(one, other):
    """(m, m') 1 where two modes have the same shape (modal assurance criterion)."""
    a, b = (np.concatenate(modes.shapes) for modes in (one, other))
    mixed = np.abs(a.conj().T @ b) ** 2
    return mixed / np.outer(np.sum(np.abs(a) ** 2, axis=0), np.sum(np.abs(b) ** 2, axis=0))


class CriticalSpeed(NamedTuple):
    """A speed [rad/s] at which an unbalance meets a damped frequency, with the damping ratio [-] there; `forward` as in `WhirlModes`."""

    speed: float
    damping_ratio: float
    forward: bool


def damped_critical_speeds(rotor: Rotor, diagram: Campbell) -> list[CriticalSpeed]:
    """The `CriticalSpeed`s within a `Campbell` diagram, rising: where a branch crosses the line frequency = speed."""
    found = []
    for branch in range(diagram.frequency.shape[1]):
        above = diagram.frequency[:, branch] - diagram.speeds
        for k in np.flatnonzero((above[:-1] * above[1:] <= 0) & (above[1:] != 0)):
            sense = diagram.sense[k, branch]
            speed, at = _crossing(rotor, diagram, (k, branch), lambda modes, n: modes.frequency[n] - modes.speed)
            found.append(CriticalSpeed(speed, float(at), sense > 0))
    return sorted(found)


def stability_threshold(rotor: Rotor, diagram: Campbell) -> float | None:
    """The least speed [rad/s] of a `Campbell` diagram from which a whirl grows by itself; None where none does."""
    found = []
    for branch in range(diagram.frequency.shape[1]):
        damped = diagram.damping_ratio[:, branch]
        for k in np.flatnonzero((damped[:-1] >= 0) & (damped[1:] < 0))[:1]:
            found.append(_crossing(rotor, diagram, (k, branch), lambda modes, n: modes.damping_ratio[n])[0])
        if damped[0] < 0:
            found.append(float(diagram.speeds[0]))
    return min(found, default=None)


def _crossing(rotor, diagram, where, measure):
    """(speed [rad/s], damping ratio) where a measure of a branch changes its sign between two speeds of the diagram."""
    k, branch = where
    ends, count = diagram.speeds[k : k + 2], diagram.frequency.shape[1]

    def at(speed):
        modes = whirl_modes(rotor, speed, count)
        share = (speed - ends[0]) / (ends[1] - ends[0])
        leads, sense = ((1 - share) * each[k, branch] + share * each[k + 1, branch] for each in (diagram.frequency, diagram.sense))
        return modes, int(np.argmin(np.abs(np.log(modes.frequency / leads)) + np.abs(modes.sense - sense)))

    def measured(speeds):
        return np.array([measure(*at(speed)) for speed in np.atleast_1d(speeds)])

    low, high = ends[:1], ends[1:]
    begins = measured(low)
    speed = float(low[0] if begins[0] == 0 else roots_in_brackets(measured, low, high, begins, measured(high))[0])
    modes, number = at(speed)
    return speed, modes.damping_ratio[number]
