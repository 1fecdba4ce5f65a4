"""How far along a step: half of the slope gone, on functions whose minimum is known."""

import numpy as np
import pytest

from drivewright.numerics.line_search import convex_step_length

pytestmark = pytest.mark.property


@pytest.mark.parametrize("reach", [0.2, 0.5, 1.0, 1.7, 6.0, 300.0])
def test_half_of_the_slope_of_a_parabola_is_gone(reach):
    """With the minimum at 1/reach; a whole step where that lies ahead of it."""
    (share,) = convex_step_length(lambda at: reach * (reach * at - 1))
    assert 0 < share <= 1
    assert share == 1.0 if reach <= 1 else abs(reach * share - 1) <= 0.5


def test_functions_side_by_side_go_as_each_would_alone():
    power, reach = np.array([1.0, 3.0, 0.4]), np.array([9.0, 70.0, 2.5])
    slope = lambda at, n=slice(None): np.sign(reach[n] * at - 1) * np.abs(reach[n] * at - 1) ** power[n]  # noqa: E731
    together = convex_step_length(slope, 3)
    assert together.tolist() == [convex_step_length(lambda at, n=n: slope(at, [n]))[0] for n in range(3)]
    assert np.all(np.abs(slope(together)) <= 0.5)


def test_a_kink_at_which_a_slope_jumps_is_closed_in():
    """As where a contact opens: the slope changes its sign at 0.123 and is nowhere small."""
    (share,) = convex_step_length(lambda at: np.where(at < 0.123, -1.0, 40.0))
    assert share == pytest.approx(0.123, abs=1e-6)


def test_a_slope_that_rises_from_the_start_takes_the_step_whole_and_divides_by_nothing():
    with np.errstate(all="raise"):
        assert convex_step_length(lambda at: np.array([0.0, 1e-20]) + 0 * at, 2).tolist() == [1.0, 1.0]
