"""Kernels on eight cases in lanes: to the bit what they give case by case; cosine and sine against the mathematics library."""

import subprocess
import sys
from typing import NamedTuple

import numpy as np
import pytest

import drivewright._jit.lanes  # noqa: F401  # tells numba of lanes
from drivewright._jit import by_reference, inner, per_lane, plain
from drivewright._jit.lane_arrays import WIDTH, LaneArray, LaneNumber, in_lanes, put_in_lane, structure, take_from_lane
from drivewright.numerics.lanes import all_lanes, any_lane, opposite, where
from drivewright.numerics.small import ldl_factor, lu_factor, lu_solve
from drivewright.numerics.trigonometry import FAR, cos_sin

pytestmark = pytest.mark.property

RECORD = np.dtype([("kind", np.int64), ("mass", np.float64), ("place", np.float64)])


@inner
def arithmetic(a, b, out):
    """One value an operation: out (14,)."""
    out[0] = a + 2 * b - 3.0
    out[1] = -a * b
    out[2] = a / b
    out[3] = max(a, 0.5) + min(b, a)
    out[4] = abs(a) ** 2
    out[5] = np.sqrt(abs(b)) + np.floor(a) + np.round(b)
    out[6] = where((a < b) & (b > 0.0), a, where((a >= 1.0) | (b == a), b, -1.0))
    out[7] = where(opposite(a != b), 1.0, np.hypot(a, b))
    out[8] = np.arctan2(a, b) + np.tanh(a) + np.exp(-abs(b))
    out[9] += a
    out[10] -= a
    out[11] *= b
    out[12] /= b
    out[13] = branches(a, b)
    if any_lane(a > 1e9):
        out[13] = np.nan
    if all_lanes(a <= 1e9):
        out[13] += 1.0


@per_lane
def branches(a, b):
    """What no lane could decide for the others."""
    total = 0.0
    while total < abs(a):
        total += 0.5 + abs(b)
    return total if a > b else -total


@inner
def reductions(a, out):
    """Whether a is above 0 in any lane, in all, into out (2,)."""
    out[0] = 1.0 if any_lane(a > 0.0) else 0.0
    out[1] = 1.0 if all_lanes(a > 0.0) else 0.0


@pytest.mark.parametrize(("above", "found"), [(0, [0.0, 0.0]), (1, [1.0, 0.0]), (WIDTH - 1, [1.0, 0.0]), (WIDTH, [1.0, 1.0])])
def test_any_and_all(above, found):
    out = np.full(2, 7.0)
    reductions(LaneNumber(np.where(np.arange(WIDTH) < above, 1.0, -1.0)), out)
    assert out.tolist() == found


def several(seed, *shape):
    """Numbers (..., WIDTH) of both signs, with some that are equal."""
    values = np.random.default_rng(seed).normal(0.0, 2.0, (*shape, WIDTH))
    values[..., 0] = 1.0
    return values


@pytest.mark.parametrize("seed", range(5))
def test_lanes_compute_as_numbers_do(seed):
    a, b, found = several(seed), several(seed + 100), LaneArray(np.full((14, WIDTH), 3.0))
    arithmetic(LaneNumber(a), LaneNumber(b), found)
    for lane in range(WIDTH):
        one, uncompiled = np.full(14, 3.0), np.full(14, 3.0)
        arithmetic(a[lane], b[lane], one)
        plain(arithmetic)(a[lane], b[lane], uncompiled)
        np.testing.assert_array_equal(found.values[:, lane], one)
        np.testing.assert_allclose(one, uncompiled, rtol=1e-15)


@inner
def turned(angle, out):
    """(cos, sin) into out (2,)."""
    out[0], out[1] = cos_sin(angle)


@pytest.mark.parametrize("size", [1e-9, 1.0, 100.0, 0.99 * FAR, 1e9])
def test_cosine_and_sine(size):
    angles = np.random.default_rng(3).uniform(-size, size, (200, WIDTH))
    angles[0] = [0.0, np.pi / 4, -np.pi / 4, np.pi / 2, -np.pi, 3 * np.pi / 2, 2 * np.pi, -7 * np.pi / 4]
    worst = 0.0
    for row in angles:
        found = LaneArray(np.empty((2, WIDTH)))
        turned(LaneNumber(row), found)
        for lane, angle in enumerate(row):
            one = np.empty(2)
            turned(float(angle), one)
            np.testing.assert_array_equal(found.values[:, lane], one)
        exact = np.cos(row.astype(np.longdouble)), np.sin(row.astype(np.longdouble))
        worst = max(worst, float(np.abs(found.values - np.array(exact)).max()))
    assert worst < 2e-16


def test_an_angle_far_out_in_one_lane_leaves_the_others_alone():
    near, mixed = np.linspace(-3.0, 3.0, WIDTH), np.linspace(-3.0, 3.0, WIDTH)
    mixed[5] = 1e7
    found = [LaneArray(np.empty((2, WIDTH))) for _ in range(2)]
    turned(LaneNumber(near), found[0])
    turned(LaneNumber(mixed), found[1])
    kept = np.arange(WIDTH) != 5
    np.testing.assert_array_equal(found[0].values[:, kept], found[1].values[:, kept])
    assert found[1].values[:, 5] == pytest.approx([np.cos(1e7), np.sin(1e7)], abs=1e-15)


# ---------------------------------------------------------------------------------------------------------- systems of equations


@inner
def solved(a, pivots, b, out):
    """Whether a (n, n) is regular, into out (1,); b (n,) becomes the solution."""
    regular = lu_factor(a, pivots)
    lu_solve(a, pivots, b)
    out[0] = where(regular, 1.0, 0.0)


@pytest.mark.parametrize("n", [1, 2, 3, 5])
def test_each_lane_exchanges_rows_of_its_own(n):
    rng = np.random.default_rng(n)
    a, b = rng.normal(size=(n, n, WIDTH)), rng.normal(size=(n, WIDTH))
    for lane in range(WIDTH):
        a[..., lane] = a[rng.permutation(n)][..., lane]
    factors, x, pivots, regular = LaneArray(a.copy()), LaneArray(b.copy()), LaneArray(np.zeros((n, WIDTH))), LaneArray(np.zeros((1, WIDTH)))
    solved(factors, pivots, x, regular)
    for lane in range(WIDTH):
        one = [np.ascontiguousarray(a[..., lane]), np.zeros(n), b[:, lane].copy(), np.zeros(1)]
        solved(*one)
        np.testing.assert_array_equal(factors.values[..., lane], one[0])
        np.testing.assert_array_equal(x.values[:, lane], one[2])
        np.testing.assert_allclose(a[..., lane] @ x.values[:, lane], b[:, lane], rtol=1e-9, atol=1e-12)
    assert np.all(regular.values == 1.0)


def test_a_singular_lane_is_told_and_spoils_no_other():
    a = np.random.default_rng(8).normal(size=(3, 3, WIDTH))
    a[2, :, 4] = 2.0 * a[0, :, 4] + np.array([0.0, 3e-16, -2e-16])  # to rounding
    x, regular = LaneArray(np.ones((3, WIDTH))), LaneArray(np.zeros((1, WIDTH)))
    solved(LaneArray(a.copy()), LaneArray(np.zeros((3, WIDTH))), x, regular)
    assert regular.values[0].tolist() == [1.0] * 4 + [0.0] + [1.0] * 3
    for lane in set(range(WIDTH)) - {4}:
        np.testing.assert_allclose(a[..., lane] @ x.values[:, lane], 1.0, rtol=1e-9)


def test_a_lane_that_is_not_definite_is_nan_alone():
    a = np.repeat(np.array([[4.0, 1.0], [1.0, 3.0]])[..., None], WIDTH, axis=-1)
    a[0, 0, 2] = -1.0
    factors = LaneArray(a)
    ldl_factor(factors)
    assert np.flatnonzero(np.isnan(factors.values[0, 0])).tolist() == [2]


# ----------------------------------------------------------------------------------------------------------------- tables and tuples


@by_reference
class Machine(NamedTuple):
    """A table, an array, a number, and integers that all cases share."""

    bodies: np.recarray
    forces: np.ndarray
    gravity: float
    order: np.ndarray


@inner
def weights(machine, out):
    """Moment of the bodies' weights, row by row of the table, into machine.forces (bodies, 2) and out (3,)."""
    row = machine.forces[0]
    for n in range(machine.bodies.size):
        body = machine.bodies[machine.order[n]]
        machine.forces[n, 0] = body.mass * machine.gravity
        machine.forces[n, 1] = machine.forces[n, 0] * body.place
        body.place += 1.0 if body.kind == 1 else 0.0
        out[0] += machine.forces[n, 1]
    out[1] = row[1] + machine.forces.shape[0] + len(machine.forces)
    out[2] = of_one(machine)


@per_lane
def of_one(machine):
    """The largest force of a case, by branches."""
    largest = -np.inf
    for n in range(machine.forces.shape[0]):
        if machine.forces[n, 0] > largest and machine.bodies[n].kind >= 0:
            largest = machine.forces[n, 0]
    machine.forces[0, 0] = largest
    return largest


def machine(seed):
    """A case; the integers are the same in all."""
    rng, bodies = np.random.default_rng(seed), np.zeros(3, RECORD).view(np.recarray)
    bodies.kind, bodies.mass, bodies.place = [1, 0, 1], rng.normal(size=3), rng.normal(size=3)
    return Machine(bodies, np.zeros((3, 2)), float(rng.normal()), np.array([2, 0, 1]))


def test_tables_and_tuples_hold_a_case_in_each_lane():
    cases = [machine(seed) for seed in range(WIDTH)]
    laned, found = in_lanes(cases[0]), LaneArray(np.zeros((3, WIDTH)))
    for lane, case in enumerate(cases):
        put_in_lane(laned, lane, case)
    weights(laned, found)
    for lane, case in enumerate(cases):
        one = np.zeros(3)
        weights(case, one)
        np.testing.assert_array_equal(found.values[:, lane], one)
        np.testing.assert_array_equal(laned.bodies.values["place"][:, lane], case.bodies.place)
        back = np.zeros((3, 2))
        take_from_lane((laned.forces,), lane, (back,))
        np.testing.assert_array_equal(back, case.forces)


def test_structure_is_what_cases_must_share():
    first, second = machine(0), machine(1)
    assert structure(first) == structure(second)
    second.bodies.kind[1] = 1
    assert structure(first) != structure(second)
    assert structure(first) != structure(first._replace(order=np.array([0, 1, 2])))
    assert structure(first) != structure(first._replace(forces=np.zeros((3, 3))))


def test_what_stands_in_two_places_stays_one():
    case = machine(0)
    one, other = in_lanes((case, case))
    assert one is other


ALONE = """
import sys
import numpy as np
from drivewright._jit import kernel, per_lane

@per_lane
def half(x):
    return 0.5 * x

@kernel
def length(x, n):
    total = 0.0
    for _ in range(n):
        total = np.hypot(total, x)
    total = half(total)
    for _ in range(n):
        total = np.hypot(total, x)
    return total

print(length(4.0, 9), "drivewright._jit.lanes" in sys.modules)
"""


def test_who_has_no_lanes_does_not_tell_numba_of_them():
    """Told while a kernel is being compiled, numba would take one function for two."""
    done = subprocess.run([sys.executable, "-c", ALONE], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    found, lanes = done.stdout.split()
    assert float(found) == pytest.approx(np.hypot(6.0, 12.0), rel=1e-14) and lanes == "False"
