"""Formulas chosen by the type of their first argument, in plain Python and in kernels."""

from typing import NamedTuple

import numpy as np
import pytest

from drivewright._jit import generic, implements, kernel, plain
from drivewright.errors import InputError

pytestmark = pytest.mark.interface


@generic
def area(shape, scale):
    """Area of a shape."""


class Square(NamedTuple):
    side: float


class Disc(NamedTuple):
    radius: float


class Framed(NamedTuple):
    inner: Square
    width: float


@implements(area, Square)
def _(shape, scale):
    return scale * shape.side**2


@implements(area, Disc)
def _(shape, scale):
    return scale * np.pi * squared(shape.radius)


@kernel
def squared(x):
    return x * x


@implements(area, Framed)
def _(shape, scale):
    return scale * (shape.inner.side + 2 * shape.width) ** 2 - area(shape.inner, scale)


@kernel
def sum_of_areas(shape, scales):
    total = 0.0
    for scale in scales:
        total += area(shape, scale)
    return total


@kernel
def one_over(x):
    return 1.0 / x


SCALES = np.array([0.1, 0.7, 1.9])


@pytest.mark.parametrize("shape", [Square(1.3), Disc(0.7), Framed(Square(0.4), 0.3)])
def test_a_kernel_gives_the_numbers_of_plain_python(shape):
    assert sum_of_areas(shape, SCALES) == plain(sum_of_areas)(shape, SCALES) == sum_of_areas.py_func(shape, SCALES)
    assert sum_of_areas(shape, SCALES) == pytest.approx(area(shape, SCALES.sum()), rel=1e-14)


def test_values():
    assert area(Square(3.0), 2.0) == 18.0
    assert area(Framed(Square(1.0), 1.0), 1.0) == 8.0
    assert area(Disc(1.0), 1.0) == np.pi


def test_a_law_that_comes_later_touches_no_kernel():
    class Ring(NamedTuple):
        outer: float
        inner: float

    @implements(area, Ring)
    def _(shape, scale):
        return scale * np.pi * (shape.outer**2 - shape.inner**2)

    assert sum_of_areas(Ring(2.0, 1.0), SCALES) == pytest.approx(3 * np.pi * 2.7, rel=1e-15)


def test_the_generic_keeps_its_name_and_words():
    assert (area.__name__, area.__doc__) == ("area", "Area of a shape.")


def test_plain_runs_without_numba_all_the_way_down():
    deep = plain(kernel(uses_squared))
    assert not hasattr(deep, "py_func") and not hasattr(deep.__globals__["squared"], "py_func")
    assert deep("x" and 3.0) == 10.0


def uses_squared(x):
    return squared(x) + 1.0


def test_division_by_zero_is_infinite_as_in_numpy():
    assert one_over(0.0) == np.inf


def test_kernels_release_the_interpreter_and_keep_strict_arithmetic():
    options = one_over.targetoptions
    assert options["nogil"] and options["error_model"] == "numpy" and not options.get("fastmath") and not options.get("parallel")


def test_an_unknown_type_is_named_with_the_known_ones():
    with pytest.raises(InputError, match="area: no formula for a float; it has one for: Disc, Framed,.*Square"):
        area(3.0, 1.0)


def test_inside_a_kernel_too():
    from numba.core.errors import TypingError

    with pytest.raises(TypingError, match="area: no formula for a float64; it has one for: Disc, Framed"):
        sum_of_areas(3.0, SCALES)


def test_one_formula_per_type():
    with pytest.raises(InputError, match="area: Square already has a formula"):
        implements(area, Square)(lambda shape, scale: 0.0)
