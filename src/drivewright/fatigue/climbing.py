"""Climbing to a plane of greatest damage: from the plane's own instants by tangents, or by simplexes where edges stop that."""

from typing import NamedTuple

import numpy as np

from drivewright._jit import inner
from drivewright._typing import Floats
from drivewright.fatigue.curves import Curve, cycle_damage
from drivewright.fatigue.planes import (
    Block,
    PlaneWorkspace,
    Vector,
    closed_cycle,
    cross,
    cycle_measures,
    plane_damage,
    resolve,
    tensor_weights,
    turn_towards,
)

_NEWTON_STEPS, _FARTHEST = 3, 0.3  # on a tangent; angle of a step at most [rad]
_STANDING = 1e-7  # step that is none [rad]


@inner
def turn_frame(normal: Vector, direction: Vector, first: float, second: float, third: float) -> tuple[Vector, Vector]:
    """(normal, direction) turned in their plane, then the direction about the normal, then the normal about the direction."""
    normal, direction = turn_towards(normal, direction, first), turn_towards(direction, normal, -first)
    direction = turn_towards(direction, cross(normal, direction), second)
    return turn_towards(normal, cross(normal, direction), third), direction


class Hill(NamedTuple):
    """What is climbed: the log damage by three angles from a frame."""

    block: Block
    curve: Curve
    normal: Vector
    direction: Vector


@inner
def _log_damage(hill: Hill, work: PlaneWorkspace, x: float, y: float, z: float) -> float:
    """ln of the damage where the frame is turned by three angles [rad]."""
    normal, direction = turn_frame(hill.normal, hill.direction, x, y, z)
    return np.log(plane_damage(hill.block, hill.curve, normal, direction, work))


@inner
def _evaluate_corner(hill, work, s, row, x, y, z):
    """Writes three angles [rad] and the log damage there into a row of the simplex s (5, 4)."""
    s[row, 0], s[row, 1], s[row, 2], s[row, 3] = x, y, z, _log_damage(hill, work, x, y, z)


@inner
def _reflect(hill, work, s, low, factor):
    """Mirrors the lowest corner of s (5, 4) at the middle of the other three, its distance times factor, in row 4; kept if it is higher."""
    share = (1.0 + factor) / 3.0
    x, y, z = -factor * s[low, 0], -factor * s[low, 1], -factor * s[low, 2]
    for i in range(4):
        if i != low:
            x, y, z = x + share * s[i, 0], y + share * s[i, 1], z + share * s[i, 2]
    _evaluate_corner(hill, work, s, 4, x, y, z)
    kept = s[4, 3] > s[low, 3]
    if kept:
        for c in range(4):
            s[low, c] = s[4, c]
    return kept


@inner
def _shrink(hill, work, s, top):
    """Halves the distances [rad] of all corners of the simplex s (5, 4) from its highest."""
    for i in range(4):
        if i != top:
            x, y, z = 0.5 * (s[i, 0] + s[top, 0]), 0.5 * (s[i, 1] + s[top, 1]), 0.5 * (s[i, 2] + s[top, 2])
            _evaluate_corner(hill, work, s, i, x, y, z)


@inner
def _rank_corners(s):
    """(highest, lowest corner, log damage of the next to the lowest, size [rad]) of a simplex (5, 4): three angles [rad], log damage."""
    top, low = 0, 0
    for i in range(1, 4):
        top, low = i if s[i, 3] > s[top, 3] else top, i if s[i, 3] < s[low, 3] else low
    second, width = np.inf, 0.0
    for i in range(4):
        second = second if i == low else min(second, s[i, 3])
        for c in range(3):
            width = max(width, abs(s[i, c] - s[top, c]))
    return top, low, second, width


@inner
def nelder_mead(
    block: Block, curve: Curve, normal: Vector, direction: Vector, size: float, finest: float, work: PlaneWorkspace, s: Floats
) -> tuple[float, Vector, Vector]:
    """(log damage, normal, direction) on the hill that starts here: simplex of Nelder and Mead, s (5, 4), from a size to `finest` [rad].

    The hills have edges, where one cycle or one extreme takes over from another; methods with slopes or fixed axes get stuck on them.
    """
    hill = Hill(block, curve, normal, direction)
    for i in range(4):
        _evaluate_corner(hill, work, s, i, size * (i == 1), size * (i == 2), size * (i == 3))
    for _ in range(400):
        top, low, second, width = _rank_corners(s)
        if width < finest or s[top, 3] == np.inf:
            break
        highest = s[top, 3]
        kept = _reflect(hill, work, s, low, 1.0)
        if kept and s[4, 3] > highest:
            _reflect(hill, work, s, low, -2.0)
        elif not (kept and s[4, 3] > second) and not _reflect(hill, work, s, low, -0.5):
            _shrink(hill, work, s, top)
    top = _rank_corners(s)[0]
    normal, direction = turn_frame(normal, direction, s[top, 0], s[top, 1], s[top, 2])
    return s[top, 3], normal, direction


# -------------------------------------------------------------------------------------------------- climbing by tangents


@inner
def _add_sample(total, t, k, weight):
    """Adds sample k of a block, counted on beyond its end, of t (6, n) [- or Pa], times a weight, to total (6,)."""
    k %= t.shape[1]
    for c in range(6):
        total[c] += weight * t[c, k]


@inner
def _add_extreme(total, t, signal, cycle, value, weight):
    """Adds the tensor t (6, n), times a weight, to total (6,) at the instant of a `ClosedCycle` when the signal has an extreme value."""
    for k in range(cycle.first, cycle.close):
        if signal[k] == value:
            _add_sample(total, t, k, weight)
            return
    _add_sample(total, t, cycle.close - 1, weight * (1.0 - cycle.part))
    _add_sample(total, t, cycle.close, weight * cycle.part)


@inner
def tangent(block: Block, curve: Curve, normal: Vector, direction: Vector, work: PlaneWorkspace, d: Floats) -> float:
    """Damage of a frame; writes the tensors A and G [-] of its tangent n.A.d + n.G.n/2 into d (2, 6).

    The instants of turning points and extremes, and where between two samples a cycle closes, are those of the frame.  Planes of equal
    damage of a cycle are p + k mean = constant, k = elastic (2N)^b; the weight of each cycle is the slope of its damage by p.
    """
    damage = 0.0
    for c in range(6):
        d[0, c] = d[1, c] = 0.0
    for number in range(resolve(block, normal, direction, work)):
        cycle = closed_cycle(work, number, block.gate)
        parts = cycle_measures(work, cycle)
        mean = 0.5 * (parts.most + parts.least)
        each = cycle_damage(curve, parts.shear + 0.5 * (parts.highest - parts.lowest), mean)
        damage += each
        if 0.0 < each < np.inf:
            life = 2.0 / each
            factor, plastic = curve.elastic * life**curve.b, curve.plastic * life**curve.c
            weight = -each / (curve.b * factor * (curve.strength - mean) + curve.c * plastic)
            _add_cycle(block, work, cycle, parts, weight, factor, d)
    return damage


@inner
def _add_cycle(block, work, cycle, parts, weight, factor, d):
    """Adds a `ClosedCycle` with its `CycleMeasures` to the tangent d (2, 6) [-], weight [-] and factor k [1/Pa] being its own."""
    sense = weight if work.shear[cycle.first] > work.shear[cycle.turn] else -weight
    _add_sample(d[0], block.strain, cycle.first, sense)
    _add_sample(d[0], block.strain, cycle.turn, -sense)
    _add_extreme(d[1], block.strain, work.normal, cycle, parts.highest, weight)
    _add_extreme(d[1], block.strain, work.normal, cycle, parts.lowest, -weight)
    _add_extreme(d[1], block.stress, work.stress, cycle, parts.most, weight * factor)
    _add_extreme(d[1], block.stress, work.stress, cycle, parts.least, weight * factor)


@inner
def _component(t, a, b):
    """a.t.b of a symmetric tensor t (6,), in its unit."""
    w = tensor_weights(a, b)
    return w[0] * t[0] + w[1] * t[1] + w[2] * t[2] + w[3] * t[3] + w[4] * t[4] + w[5] * t[5]


@inner
def newton_step(t: Floats, n: Vector, d: Vector, farthest: float) -> tuple[float, float, float]:
    """Three angles [rad] of `turn_frame`, each below `farthest`, to the top of n.A.d + n.G.n/2, A and G [-] being t (2, 6): Newton.

    The second derivatives are reduced until they are those of a top and the step is short enough.
    """
    b = cross(n, d)
    nd, dd, nn, nb, bd, bb = _components(t[0], n, d, b)
    gnd, gdd, gnn, gnb, gbd, gbb = _components(t[1], n, d, b)
    x, y, z = dd - nn + gnd, nb, bd + gnb
    xx, yy, zz = 4.0 * nd - gdd + gnn, nd, nd - gbb + gnn
    xy, xz, yz = -bd, nb - gbd, dd - bb + gnd
    size = abs(nd) + abs(gnn) + abs(gdd) + abs(gbb)
    shift = 0.0
    for _ in range(12):
        p, q, r = xx + shift, yy + shift, zz + shift
        minor = p * q - xy * xy
        whole = r * minor + xy * yz * xz - q * xz * xz + xz * xy * yz - p * yz * yz
        if p > 0.0 and minor > 0.0 and whole > 0.0:
            first = ((q * r - yz * yz) * x + (yz * xz - xy * r) * y + (xy * yz - q * xz) * z) / whole
            second = ((yz * xz - xy * r) * x + (p * r - xz * xz) * y + (xy * xz - p * yz) * z) / whole
            third = ((xy * yz - q * xz) * x + (xy * xz - p * yz) * y + minor * z) / whole
            if max(abs(first), abs(second), abs(third)) < farthest:
                return first, second, third
        shift = max(2.0 * shift, 0.02 * size)
    return 0.0, 0.0, 0.0


@inner
def _components(t, n, d, b):
    """n.t.d, d.t.d, n.t.n, n.t.b, b.t.d and b.t.b of a symmetric tensor t (6,), in its unit."""
    return _component(t, n, d), _component(t, d, d), _component(t, n, n), _component(t, n, b), _component(t, b, d), _component(t, b, b)


@inner
def climb_tangents(
    block: Block, curve: Curve, normal: Vector, direction: Vector, steps: int, least: float, work: PlaneWorkspace, t: Floats
) -> tuple[bool, float, Vector, Vector]:
    """(whether tangents lead to the top, log damage, normal, direction) from a frame; t (2, 2, 6) [-] is overwritten.

    Damage grows with measures that are greatest values over instants.  With the instants of one plane, and the slopes there instead of the
    convex damage, it is less on every other plane, but for mean stresses and cycles that pair up differently; so the top of this tangent
    is a better plane, most often.  Where it is not, the next step is shorter.  Ends after `steps`, or when one gains less than `least`.
    """
    height, farthest = np.log(tangent(block, curve, normal, direction, work, t[0])), _FARTHEST
    for _ in range(steps):
        if not np.isfinite(height):
            break
        size, n, d = _top_of_tangent(t[0], normal, direction, farthest)
        if size < _STANDING:
            return farthest == _FARTHEST, height, normal, direction
        reached = np.log(tangent(block, curve, n, d, work, t[1]))
        if not reached > height:
            farthest = 0.25 * min(size, farthest)
            continue
        gain, height, normal, direction = reached - height, reached, n, d
        _copy(t[1], t[0])
        if gain < least:
            return farthest == _FARTHEST, height, normal, direction
        farthest = _FARTHEST
    return False, height, normal, direction


@inner
def _top_of_tangent(t, normal, direction, farthest):
    """(greatest angle of a step, normal, direction) after a few steps of Newton's method on the tangent t (2, 6) [-]."""
    size = 0.0
    for _ in range(_NEWTON_STEPS):
        x, y, z = newton_step(t, normal, direction, farthest)
        size = max(size, abs(x), abs(y), abs(z))
        normal, direction = turn_frame(normal, direction, x, y, z)
    return size, normal, direction


@inner
def _copy(source, target):
    """Writes one tangent (2, 6) [-] over another."""
    for i in range(2):
        for c in range(6):
            target[i, c] = source[i, c]
