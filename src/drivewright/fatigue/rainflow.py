"""Rainflow counting: turning points, then pairs of them that close a loop of the hysteresis.  After ASTM E1049, recalled.

A range is a cycle once the next range is not smaller (the three-point rule; in the inside of a history the four-point rule finds the same).
What stays open in a history that happens once counts as half cycles; in a block that is repeated, begun at its largest absolute peak,
nothing stays open.
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import inner, kernel, warmer
from drivewright._typing import ArrayLike, Floats, Ints
from drivewright.errors import InputError


class Cycles(NamedTuple):
    """Rainflow cycles in the order in which they close: range, mean, count (0.5 or 1), samples at which they start and turn."""

    range: Floats
    mean: Floats
    count: Floats  # pyright: ignore[reportIncompatibleMethodOverride]  # the name of the column, not tuple.count
    start: Ints
    end: Ints


@inner
def _bends(x: Floats, first: int, last: int, bends: Ints) -> int:
    """Writes `first` and the samples between it and `last` where x (n,) begins or ends to rise into bends (>= n,); returns their number."""
    bends[0] = first
    count, rising = 1, x[first + 1] > x[first]
    for k in range(first + 1, last):
        ahead = x[k + 1] > x[k]
        bends[count] = k  # always written, and kept by counting on: a branch here would be guessed wrong
        count, rising = count + (ahead != rising), ahead
    return count


@inner
def _first_equal(x, after, k, gate):
    """The first of the samples before k, later than `after`, from which on x (n,) stays within the gate of x[k]."""
    first = k
    while first - 1 > after and abs(x[first - 1] - x[k]) <= gate:
        first -= 1
    return first


@inner
def _keep_reversals(x, gate, turning, points):
    """Number of the points of turning (>= points,), samples of x (n,), that are left when none turns x by less than the gate."""
    count, heading, extreme = 1, 0.0, turning[0]
    level = x[extreme]
    for p in range(1, points):
        k = turning[p]
        rise = heading * (x[k] - level)
        if rise > gate:
            extreme, level = k, x[k]
        elif rise < -gate:
            turning[count] = _first_equal(x, turning[count - 1], extreme, gate)
            count, heading, extreme, level = count + 1, -heading, k, x[k]
        elif heading == 0.0 and abs(x[k] - level) > gate:
            heading, extreme, level = np.copysign(1.0, x[k] - level), k, x[k]
    if heading != 0.0:
        turning[count] = _first_equal(x, turning[count - 1], extreme, gate)
        count += 1
    return count


@inner
def turning_points(x: Floats, first: int, last: int, gate: float, turning: Ints) -> int:
    """Writes the indices of the reversals of x[first..last] larger than `gate`, both ends included; returns their number.

    x (n,) and gate: the signal, both in its unit; turning (>= n,): sample numbers.  Of samples equal within the gate the first is taken.
    """
    if last == first:
        turning[0] = first
        return 1
    points = _bends(x, first, last, turning)
    turning[points] = last
    return _keep_reversals(x, gate, turning, points + 1)


@inner
def pair_cycles(
    x: Floats, turning: Ints, points: int, gate: float, closed: bool, count: Floats, start: Ints, end: Ints, stack: Ints
) -> int:
    """Writes count, start and end of the cycles between the turning points; returns their number.

    x (n,) and gate: the signal, both in its unit; turning, start, end, stack (>= points,): sample numbers; count (>= points,) [-].
    closed: the points are one round of a block that begins and ends at its largest range, so that every cycle closes.
    """
    depth, cycles = 0, 0
    for t in range(points):
        stack[depth] = turning[t]
        depth += 1
        while depth >= 3:
            newest = abs(x[stack[depth - 1]] - x[stack[depth - 2]])
            if newest < abs(x[stack[depth - 2]] - x[stack[depth - 3]]) - gate:
                break
            start[cycles], end[cycles] = stack[depth - 3], stack[depth - 2]
            if depth == 3 and not closed:  # it contains the beginning, before which nothing closed it
                count[cycles] = 0.5
                stack[0], stack[1] = stack[1], stack[2]
                depth = 2
            else:
                count[cycles] = 1.0
                stack[depth - 3] = stack[depth - 1]
                depth -= 2
            cycles += 1
    for k in range(depth - 1):
        start[cycles], end[cycles], count[cycles] = stack[k], stack[k + 1], 0.5
        cycles += 1
    return cycles


@inner
def block_cycles(x: Floats, size: int, gate: float, turning: Ints, count: Floats, start: Ints, end: Ints, stack: Ints) -> int:
    """Number of the closed cycles of a block that is repeated, x (2 size,) holding it twice; start < end < 2 size."""
    bends = _bends(x, 0, size, stack)
    top, bar = 0, abs(x[0]) + gate
    for b in range(1, bends):
        if abs(x[stack[b]]) > bar:
            top, bar = b, abs(x[stack[b]]) + gate
    turning[0] = _first_equal(x, -1, stack[top], gate)
    for b in range(1, bends):
        turning[b] = stack[top + b] if top + b < bends else stack[top + b - bends] + size
    turning[bends] = turning[0] + size
    points = _keep_reversals(x, gate, turning, bends + 1)
    return pair_cycles(x, turning, points, gate, True, count, start, end, stack)


@kernel
def _count_cycles(x, repeating):
    """count, start, end of all cycles; of a repeating block x holds it twice."""
    capacity = len(x) + 2
    turning, stack, start, end = (
        np.empty(capacity, np.int64),
        np.empty(capacity, np.int64),
        np.empty(capacity, np.int64),
        np.empty(capacity, np.int64),
    )
    count = np.empty(capacity)
    if repeating:
        cycles = block_cycles(x, len(x) // 2, 0.0, turning, count, start, end, stack)
    else:
        points = turning_points(x, 0, len(x) - 1, 0.0, turning)
        cycles = pair_cycles(x, turning, points, 0.0, False, count, start, end, stack)
    return count[:cycles], start[:cycles], end[:cycles]


def cycles(history: ArrayLike, repeating: bool = False) -> Cycles:
    """The rainflow `Cycles` of a row of numbers, of any unit.

    Once through: cycles that close count 1, what is left open 0.5.  repeating: the history is one round of a block without end, its
    last sample followed by its first; it is begun at its largest absolute peak and all its cycles close.  A constant has none.
    """
    x = _row(history)
    count, start, end = _count_cycles(np.concatenate([x, x]) if repeating else x, repeating)
    start, end = start % x.size, end % x.size
    return Cycles(np.abs(x[end] - x[start]), x[start] / 2 + x[end] / 2, count, start, end)


def _row(history):
    try:
        x = np.array(history, dtype=float)
    except (TypeError, ValueError):
        raise InputError("cycles: the history must be a row of numbers.") from None
    if x.ndim != 1 or not x.size:
        raise InputError(f"cycles: the history must be one row of at least one number, got the shape {x.shape}; count one signal each.")
    if not np.all(np.isfinite(x)):
        bad = np.flatnonzero(~np.isfinite(x))
        raise InputError(f"cycles: sample {bad[0]} of the history is {x[bad[0]]}; {bad.size} are not finite. Repair or cut them out.")
    return x


@warmer
def warm_rainflow() -> None:
    """Compile for `doctor --warm`."""
    for repeating in (False, True):
        cycles([0.0, 1.0, 0.0], repeating)
