"""A strand between two sprockets, compiled: where its last pin lies for a direction of the force in it.

Lengths in pitches, directions as angles against the force, points of the plane as complex numbers with the force along the real axis.
n free plates with the directions d_1 .. d_n between two seated ones, d_0 and d_n+1, reach

    W = A sum_1..n u(d_i) - 2 r sum_0..n u(m_i),     m_i = (R1 d_i + R2 d_i+1)/(2 r),  u(b) = exp(i b),

from the last pin seated to the first one seated again; each joint, of the radii R1 = r + k and R2 = r - k, is as good as a bar of the
length 2 r along the weighted mean of its plates.  A straight strand has d_i = 0.  In equilibrium its reach along the force is
stationary, in fact greatest,

    A sin d_i = R2 sin m_i-1 + R1 sin m_i,

which bends it at its ends: a joint turned by 2 t shifts its contact by r sin t where the radii are equal.  Since A > 2 r and the relative
curvature 1/R1 + 1/R2 is positive, that has one solution.
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import inner, kernel
from drivewright._typing import Floats

_STEPS = 40
_STILL = 1e-13  # rad


class Reach(NamedTuple):
    """W, its derivatives by d_0 and d_n+1, and the directions of the first and the last free plate."""

    vector: complex
    by_start: complex
    by_end: complex
    first: float
    last: float


@inner
def reach(A: float, r: float, k: float, bent: bool, count: int, start: float, end: float, work: Floats) -> Reach:
    """The `Reach` of `count` free plates between seated ones with the directions `start` and `end`; work (3, count + 2) is scratch."""
    if bent:
        return _bent(A, r, k, count, start, end, work)
    share = first_share(r, k)
    first, last = np.exp(1j * share * start), np.exp(1j * (1 - share) * end)
    vector = count * A - 2 * r * (count - 1 + first + last)
    return Reach(vector, -1j * (r + k) * first, -1j * (r - k) * last, 0.0, 0.0)


@inner
def first_share(r: float, k: float) -> float:
    """Share of the first plate's angle in the direction of a joint, R1/(2 r)  [-]; a half in a hinge."""
    return 0.5 if r == 0.0 else 0.5 + 0.5 * k / r


@inner
def effective(r: float, k: float) -> float:
    """R1 R2/(R1 + R2), the effective radius of a joint  [pitches]; 0 of a hinge."""
    return 0.0 if r == 0.0 else 0.5 * (r + k) * (r - k) / r


@kernel
def plate_directions(A: float, r: float, k: float, bent: bool, count: int, start: float, end: float) -> Floats:
    """Directions (count,) [rad] of the free plates of a strand against its force."""
    work = np.zeros((3, count + 2))
    reach(A, r, k, bent, count, start, end, work)
    return work[0, 1 : count + 1].copy()


@inner
def pressing(A: float, r: float, k: float, phi: float, seated: float, first: float) -> float:
    """Moment by which a force A^-1 in a strand presses the last seated plate onto its seat  [-]; negative: it lifts the plate.

    A sin d_0 - R2 sin m_-1 - R1 sin m_0 for the force 1: `seated` d_0 and `first` d_1 are the directions of the last seated and the first
    free plate against the force, turned back from it; the plate seated before lies at d_0 + phi.  Seen from the other end of a strand R1
    and R2 change places: k changes its sign.
    """
    share = first_share(r, k)
    before, joint = seated + share * phi, share * seated + (1 - share) * first
    return np.sin(seated) - ((r - k) * np.sin(before) + (r + k) * np.sin(joint)) / A


@inner
def decay(A: float, r: float, k: float) -> float:
    """By which factor the bend of a strand shrinks from plate to plate: the smaller root of R (1 + x^2) = (p + 2 R) x, R the effective
    radius, p = A - 2 r; with equal radii of r (1 + x^2) = 2 (A - r) x."""
    R, p = effective(r, k), A - 2 * r
    return 2 * R / (p + 2 * R + np.sqrt(p * (p + 4 * R)))


@inner
def _bent(A, r, k, count, start, end, work):
    """The `Reach` of plates in equilibrium, by Newton's method from two bends that decay; work (3, count + 2) is scratch."""
    d, diagonal, side = work[0], work[1], work[2]
    shrink = decay(A, r, k)
    d[0], d[count + 1] = start, end
    for i in range(1, count + 1):
        d[i] = start * shrink**i + end * shrink ** (count + 1 - i)
    for _ in range(_STEPS):
        if _newton_step(A, r, k, count, d, diagonal, side) < _STILL:
            return _reached(A, r, k, count, d, diagonal, side)
    return Reach(np.nan + 0j, np.nan + 0j, np.nan + 0j, np.nan, np.nan)


@inner
def _newton_step(A, r, k, count, d, diagonal, side):
    """One Newton step towards equilibrium; its largest part [rad].

    d (count + 2,) [rad]: directions of all plates, the first and the last seated; diagonal, side (count + 2,) [-]: scratch.
    """
    share, right, left = first_share(r, k), r + k, r - k
    bar = share * d[0] + (1 - share) * d[1]
    for i in range(1, count + 1):
        following = share * d[i] + (1 - share) * d[i + 1]
        side[i] = left * np.sin(bar) + right * np.sin(following) - A * np.sin(d[i])
        diagonal[i] = A * np.cos(d[i]) - (1 - share) * left * np.cos(bar) - share * right * np.cos(following)
        bar = following
    _solve(r, k, count, d, diagonal, side)
    largest = 0.0
    for i in range(1, count + 1):
        d[i] += side[i]
        largest = max(largest, abs(side[i]))
    return largest


@inner
def _solve(r, k, count, d, diagonal, side):
    """Overwrite `side` with the solution of the tridiagonal system of the plates' directions; beside the diagonal -R cos m_i.

    d [rad], diagonal [-], side (count + 2,): entries 1 .. count belong to the free plates.
    """
    weight, R = first_share(r, k), effective(r, k)
    for i in range(2, count + 1):
        beside = -R * np.cos(weight * d[i - 1] + (1 - weight) * d[i])
        share = beside / diagonal[i - 1]
        diagonal[i] -= share * beside
        side[i] -= share * side[i - 1]
    side[count] /= diagonal[count]
    for i in range(count - 1, 0, -1):
        side[i] = (side[i] + R * np.cos(weight * d[i] + (1 - weight) * d[i + 1]) * side[i + 1]) / diagonal[i]


@inner
def _reached(A, r, k, count, d, diagonal, side):
    """The `Reach` in equilibrium.  Across the force the free plates move along with the seated ones: one adjoint solution for both ends.

    d (count + 2,) [rad]; diagonal, side (count + 2,): scratch.
    """
    share, R, right, left = first_share(r, k), effective(r, k), r + k, r - k
    opening = np.exp(1j * (share * d[0] + (1 - share) * d[1]))
    vector, bar = -2 * r * opening, opening
    for i in range(1, count + 1):
        plate, following = np.exp(1j * d[i]), np.exp(1j * (share * d[i] + (1 - share) * d[i + 1]))
        vector += A * plate - 2 * r * following
        side[i] = A * plate.real - left * bar.real - right * following.real
        diagonal[i] = A * plate.real - (1 - share) * left * bar.real - share * right * following.real
        bar = following
    _solve(r, k, count, d, diagonal, side)
    by_start = -1j * right * opening + 1j * R * opening.real * side[1]
    by_end = -1j * left * bar + 1j * R * bar.real * side[count]
    return Reach(vector, by_start, by_end, d[1], d[count])
