"""Tuples of arrays by reference, and kernels of which only what Python calls is compiled."""

import subprocess
import sys
from typing import Any, NamedTuple

import numpy as np
import pytest

from drivewright._jit import by_reference, generic, implements, inner, kernel, plain
from drivewright.numerics.ode import integrate

pytestmark = pytest.mark.interface

POINT = np.dtype([("number", np.int64), ("x", float), ("y", float)])


class Scale(NamedTuple):
    factor: float
    offset: float


@by_reference
class Table(NamedTuple):
    values: np.ndarray
    matrix: np.ndarray
    points: Any
    scale: Scale
    number: int
    squared: bool


@by_reference
class Pair(NamedTuple):
    first: Table
    second: Table
    weight: float


def table(seed, squared=False):
    draw = np.random.default_rng(seed)
    points = np.zeros(4, POINT).view(np.recarray)
    points.number, points.x, points.y = np.arange(4), draw.random(4), draw.random(4)
    return Table(draw.random(5), draw.random((3, 8))[:, ::2], points, Scale(1.5, -0.2), 3, squared)


@generic
def total_of(thing, power) -> float:
    """A number of a thing."""
    return 0.0


@implements(total_of, Table)
def _(thing, power):
    return sum_of(thing) ** power


@implements(total_of, Pair)
def _(thing, power):
    return thing.weight * (total_of(thing.first, power) - total_of(thing.second, power))


@inner
def sum_of(table):
    total = table.scale.offset
    for i in range(table.values.size):
        total += table.scale.factor * table.values[i]
    for i in range(table.matrix.shape[0]):
        for j in range(table.matrix.shape[1]):
            total -= (i - j) * table.matrix[i, j]
    for k in range(table.points.size):
        point = table.points[k]
        total += point.number * point.x - point.y
    return total * total if table.squared else total + table.number


@kernel
def total(thing, power):
    return total_of(thing, power)


@inner
def fill(pair, out):
    for i in range(out.size):
        pair.first.values[i] = out[i]
        pair.first.points[0].x += pair.second.values[i]


@kernel
def refuse(table):
    return checked(table.number)


@kernel
def checked(count):
    if count > 2:
        raise ValueError("too many")
    return count


@kernel
def values_of(table):
    return table.values


def contiguous(table):
    return table._replace(matrix=np.ascontiguousarray(table.matrix))


THINGS = [table(1), table(2, True), Pair(table(1), table(2, True), 0.3), Pair(contiguous(table(1)), table(2), 0.3)]


@pytest.mark.parametrize("thing", THINGS)
def test_a_kernel_reads_what_plain_python_reads(thing):
    assert total(thing, 2.0) == pytest.approx(plain(total)(thing, 2.0), rel=1e-14)


def test_what_a_kernel_writes_is_in_the_arrays():
    pair, again = Pair(table(1), table(2), 1.0), Pair(table(1), table(2), 1.0)
    fill(pair, np.arange(5.0))
    plain(fill)(again, np.arange(5.0))
    assert np.array_equal(pair.first.values, np.arange(5.0))
    assert pair.first.points.x.tolist() == again.first.points.x.tolist()


def test_a_call_keeps_no_array():
    thing = table(1)
    counts = [sys.getrefcount(each) for each in thing[:3]]
    for _ in range(100):
        total(thing, 1.0)
    assert [sys.getrefcount(each) for each in thing[:3]] == counts


def test_an_array_that_comes_back_is_the_one_that_went_in():
    thing = table(1)
    assert values_of(thing) is thing.values


def test_an_error_in_a_kernel_below_is_raised_with_its_words():
    for _ in range(2):
        with pytest.raises(ValueError, match="too many"):
            refuse(table(1))
    assert refuse(table(1)._replace(number=2)) == 2


def test_tuples_of_other_arrays_are_another_type():
    flat = table(1)._replace(matrix=np.zeros((3, 0)))
    assert total(flat, 1.0) == pytest.approx(plain(total)(flat, 1.0), rel=1e-14)
    with pytest.raises(Exception, match=r"(?s)getitem|index"):
        total(table(1)._replace(matrix=np.zeros(3)), 1.0)


def test_python_calls_a_kernel_that_kernels_call_too():
    assert sum_of(table(3)) == pytest.approx(total(table(3), 1.0), rel=1e-14)


KERNELS = """
from drivewright._jit import inner, kernel

@inner
def lowest(x):
    if x < 0.0:
        raise ValueError("below zero")
    return 2.0 * x

@kernel
def middle(x):
    return lowest(x) + 1.0

@kernel
def highest(x):
    return middle(x) + lowest(x)
"""
USE = """
import pathlib, platformdirs
platformdirs.user_cache_path = lambda *a, **k: pathlib.Path("cache")
import some_kernels as k
print(k.highest(2.0), sum(k.highest.stats.cache_hits.values()))
try:
    k.highest(-1.0)
except ValueError as error:
    print(error)
"""


def test_only_what_python_calls_is_on_the_disk_and_it_comes_back_whole(tmp_path):
    (tmp_path / "some_kernels.py").write_text(KERNELS)
    said = []
    for _ in range(2):
        done = subprocess.run([sys.executable, "-c", USE], cwd=tmp_path, capture_output=True, text=True, timeout=120, check=True)
        said.append(done.stdout.split("\n")[:2])
    assert said == [["9.0 0", "below zero"], ["9.0 1", "below zero"]]
    assert len(list((tmp_path / "cache").rglob("*.kernel"))) == 1


def test_a_system_of_equations_by_reference():
    @by_reference
    class Oscillators(NamedTuple):
        stiffness: np.ndarray

    from drivewright.numerics.ode import rate

    @implements(rate, Oscillators)
    def _(system, t, y, dy):
        n = system.stiffness.size
        for i in range(n):
            dy[i], dy[n + i] = y[n + i], -system.stiffness[i] * y[i]

    end = integrate(Oscillators(np.array([1.0, 4.0])), 0.0, 1.0, [1.0, 1.0, 0.0, 0.0], rtol=1e-10, atol=1e-12).y_end
    assert end[:2] == pytest.approx(np.cos([1.0, 2.0]), abs=1e-9)
