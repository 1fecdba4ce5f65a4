"""Rainflow counting: the example of ASTM E1049, and a second route that takes out the smallest range first."""

from collections import Counter

import numpy as np
import pytest

from drivewright._jit import kernel, plain
from drivewright.fatigue import cycles, rainflow

pytestmark = pytest.mark.analytical

EXAMPLE = [-2, 1, -3, 5, -1, 3, -4, 4, -2]


def tally(found):
    total = Counter()
    for size, count in zip(found.range, found.count, strict=True):
        total[round(size, 9)] += count
    return dict(total)


def test_the_example_of_the_standard():
    found = cycles(EXAMPLE)
    assert tally(found) == {3: 0.5, 4: 1.5, 6: 0.5, 8: 1.0, 9: 0.5}
    whole = found.count == 1
    assert (found.start[whole], found.end[whole], found.mean[whole]) == (4, 5, 1.0)


def test_the_example_as_a_block():
    found = cycles(EXAMPLE[:-1], repeating=True)
    assert tally(found) == {3: 1, 4: 1, 7: 1, 9: 1}
    assert sorted(zip(found.range, found.mean, strict=True)) == [(3, -0.5), (4, 1), (7, 0.5), (9, 0.5)]
    assert [(a, b) for size, a, b in zip(found.range, found.start, found.end, strict=True) if size == 9] == [(3, 6)]


def reversals(x):
    """Values at which a row turns, and its ends."""
    kept = [x[0]]
    for value in x[1:]:
        if value != kept[-1]:
            if len(kept) > 1 and (value - kept[-1]) * (kept[-1] - kept[-2]) > 0:
                kept.pop()
            kept.append(value)
    return kept


def smallest_first(x, repeating):
    """Pairs of neighbours whose range is the smallest of all are always a loop: take out one after the other; what is left are halves."""
    if repeating:
        top = int(np.argmax(np.abs(x)))
        x = [*x[top:], *x[: top + 1]]
    points, found = reversals(x), []
    while len(points) > 3:
        sizes = np.abs(np.diff(points))
        inside = [k for k in range(1, len(sizes) - 1) if sizes[k] <= min(sizes[k - 1], sizes[k + 1])]
        if not inside:
            break
        k = min(inside, key=lambda k: sizes[k])
        found.append((sizes[k], (points[k] + points[k + 1]) / 2, 1.0))
        del points[k : k + 2]
    rest = [(abs(b - a), (a + b) / 2, 0.5) for a, b in zip(points[:-1], points[1:], strict=True)]
    if repeating and rest:
        assert len(rest) == 2 and rest[0][0] == rest[1][0]
        rest = [(*rest[0][:2], 1.0)]
    return sorted(found + rest)


@pytest.mark.parametrize("repeating", [False, True])
def test_against_the_second_route(repeating):
    rng = np.random.default_rng(8)
    for size in (1, 2, 3, 7, 20, 61, 200):
        for _ in range(20):
            x = rng.normal(size=size)
            found = cycles(x, repeating)
            ours, other = sorted(zip(found.range, found.mean, found.count, strict=True)), smallest_first(x, repeating)
            assert len(ours) == len(other) and np.ravel(ours) == pytest.approx(np.ravel(other), abs=1e-12)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_of_equal_samples_the_first_turns(sense):
    found = cycles(sense * np.array([0.0, 3.0, 3.0, -1.0, -1.0, 2.0, 2.0, -4.0, -4.0]), repeating=True)
    assert sorted(zip(found.range, found.start, found.end, strict=True)) == [(3.0, 3, 5), (7.0, 7, 1)]


@pytest.mark.parametrize(("gate", "turns"), [(0.0, [0, 1, 2, 3, 4, 6]), (0.3, [0, 1, 4, 6])])
def test_reversals_below_the_gate_are_none(gate, turns):
    x, turning = np.array([0.0, 4.0, 3.9, 4.1, 1.0, 1.5, 5.0]), np.empty(9, np.int64)
    assert turning[: turns_of(x, gate, turning)].tolist() == turns


@kernel
def turns_of(x, gate, turning):
    return rainflow.turning_points(x, 0, len(x) - 1, gate, turning)


def test_kernels_run_uncompiled():
    x = np.random.default_rng(2).normal(size=40)
    for repeating, row in ((False, x), (True, np.concatenate([x, x]))):
        for ours, other in zip(rainflow._count_cycles(row, repeating), plain(rainflow._count_cycles)(row, repeating), strict=True):
            assert np.array_equal(ours, other)
