"""Wear of a journal bearing by Archard's law, on angular bins of the bearing's wall.

Node k of n bins is at the angle 2 pi k/n on the bearing.  `deposit` shares what is worn off linearly between the two nodes next to the
contact; the depth over the angle, `wear_at`, is a quadratic B-spline over the bins, whose integral is their sum: no volume is lost.
The journal keeps its shape.
"""

import numpy as np

from drivewright._jit import inner
from drivewright._typing import Floats, Numbers
from drivewright.errors import InputError


def wear_volume(coefficient: Numbers, force: Numbers, sliding: Numbers) -> Numbers:
    """V = k F s  [m^3]: k [m^3/(N m)] the specific wear rate, F [N], s [m] the length of sliding.

    Archard, J. Applied Physics 24 (1953), recalled; there k is a pure number over the hardness.
    """
    return coefficient * np.asarray(force) * sliding


def deposit(
    time: Floats, angle: Floats, force: Floats, slip: Floats, coefficient: float, radius: float, length: float, bins: int
) -> Floats:
    """Wear depth (bins,) [m] of one cycle from its history: depth = k/(R dphi L) * integral of F |v| dt at each place.

    time [s] ascending, angle [rad] of the contact in the bearing's frame, normal force [N] (0 where there is no contact, the angle is
    then ignored), slip [m/s]: arrays (m,).  Bearing radius R and length L [m].  Trapezoidal in time.
    """
    time, angle, force, slip = (np.asarray(each, dtype=float) for each in (time, angle, force, slip))
    _check_history(time, angle, force, slip, bins)
    share = 0.5 * (np.diff(time, prepend=time[0]) + np.diff(time, append=time[-1]))  # trapezoidal weights
    touching = force > 0
    removed = wear_volume(coefficient, force[touching], (np.abs(slip) * share)[touching])
    place = np.mod(angle[touching], 2 * np.pi) * bins / (2 * np.pi)
    node, part = np.floor(place).astype(int), place % 1.0
    volume = np.bincount(node % bins, removed * (1 - part), bins) + np.bincount((node + 1) % bins, removed * part, bins)
    return volume * bins / (2 * np.pi * radius * length)


def _check_history(time, angle, force, slip, bins):
    if not (time.ndim == 1 and time.shape == angle.shape == force.shape == slip.shape and time.size >= 2):
        raise InputError(
            f"wear: time, angle, force and slip must be rows of the same two or more samples, got the shapes "
            f"{time.shape}, {angle.shape}, {force.shape}, {slip.shape}."
        )
    if np.any(np.diff(time) < 0):
        raise InputError(f"wear: time decreases after {time[np.argmax(np.diff(time) < 0)]:g} s; sort the samples.")
    if not (np.all(force >= 0) and np.all(np.isfinite(force)) and np.all(np.isfinite(slip)) and np.all(np.isfinite(angle[force > 0]))):
        raise InputError(
            "wear: forces must be finite and not below 0, slip and the angles of loaded samples finite; use 0 N where the bodies are apart."
        )
    if bins < 3:
        raise InputError(f"wear: {bins} bins do not tell one side of the bearing from the other; take at least 3, better 72 or more.")


def extrapolate_wear(depths: Floats, depth_per_cycle: Floats, cycles: float) -> Numbers:
    """The depths after `cycles` more cycles that each take off `depth_per_cycle` [m]: the jump over cycles that are all alike."""
    return np.asarray(depths) + cycles * np.asarray(depth_per_cycle)


@inner
def wear_at(depths: Floats, angle: float) -> tuple[float, float]:
    """(wear depth [m], its slope by the angle [m/rad]) at the angle [rad] on the bearing; depths (bins,) [m], one or more.

    A quadratic B-spline over the bins: its slope has no jumps in which a journal would rattle.
    """
    bins = depths.size
    place = angle * bins / (2 * np.pi)
    node = np.floor(place + 0.5)
    u, k = place - node, int(node) % bins
    before, here, after = depths[k - 1], depths[k], depths[(k + 1) % bins]  # k - 1 may be -1: the last one
    depth = 0.5 * (0.5 - u) ** 2 * before + (0.75 - u * u) * here + 0.5 * (0.5 + u) ** 2 * after
    slope = (u - 0.5) * before - 2 * u * here + (u + 0.5) * after
    return depth, slope * bins / (2 * np.pi)
