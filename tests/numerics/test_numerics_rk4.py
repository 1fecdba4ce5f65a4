"""The classical method with steps of one size: by hand, its work, its events, and what it refuses."""

from typing import NamedTuple

import numpy as np
import pytest

from drivewright._jit import implements
from drivewright.errors import InputError
from drivewright.numerics.ode import Event, Functions, events, integrate, rate, switch

pytestmark = pytest.mark.analytical


class Ball(NamedTuple):
    """A ball that falls and is thrown back by the ground: height, speed."""

    gravity: float
    restitution: float


@implements(rate, Ball)
def _(system, t, y, dy):
    dy[0] = y[1]
    dy[1] = -system.gravity


@implements(events, Ball)
def _(system, t, y, values):
    values[0] = y[0]


@implements(switch, Ball)
def _(system, index, t, y):
    y[0] = 0.0
    y[1] = -system.restitution * y[1]


def rk4(*arguments, **more):
    return integrate(*arguments, method="rk4", **more)


def test_one_step_by_hand():
    # y' = t y from y(1) = 2 with h = 1/2: k = 2, 3.125, 3.4765625, 5.607421875
    run = rk4(Functions(lambda t, y: t * y), 1.0, 1.5, [2.0], max_step=0.5)
    assert run.steps == 1 and run.y_end[0] == pytest.approx(2 + (2 + 2 * 3.125 + 2 * 3.4765625 + 5.607421875) / 12, rel=1e-15)


@pytest.mark.parametrize("rtol", [1e-2, 1e-12])
def test_the_steps_are_of_one_size_whatever_the_tolerance(rtol):
    calls = []
    run = rk4(Functions(lambda t, y: calls.append(t) or -50 * y), 0.0, 1.03, [1.0], rtol, max_step=0.05)
    np.testing.assert_allclose(np.diff(run.t), [0.05] * 20 + [0.03], rtol=1e-9)
    assert run.rejected == 0 and len(calls) == 1 + 4 * run.steps


def test_a_bouncing_ball_is_exact_for_any_step():
    # Parabolas between the bounces: order 4 and a cubic between are exact.  Bounces at t = 1, and e^k * 2 later.
    run = rk4(Ball(8.0, 0.5), 0.0, 2.4, [4.0, 0.0], max_step=0.07, watch=[Event(-1, switches=True)])
    np.testing.assert_allclose(run.crossings.t, [1.0, 2.0], rtol=1e-12)
    np.testing.assert_allclose(run.crossings.y[:, 1], [4.0, 2.0], rtol=1e-12)
    assert run.y_end == pytest.approx([2 * 0.4 - 4 * 0.16, 2 - 3.2], rel=1e-11)
    steps = np.diff(run.t)
    assert steps[np.searchsorted(run.t, 1.0)] == pytest.approx(0.07, rel=1e-9)  # whole again after the bounce


def test_compiled_and_plain_runs_are_equal():
    ball = Ball(9.81, 0.7)
    plain = Functions(
        lambda t, y: np.array([y[1], -ball.gravity]),
        lambda t, y: y[:1].copy(),
        lambda index, t, y: np.array([0.0, -ball.restitution * y[1]]),
    )
    runs = [rk4(each, 0.0, 2.0, [1.0, 0.3], max_step=0.03, watch=[Event(-1, switches=True)]) for each in (ball, plain)]
    np.testing.assert_allclose(runs[0].y, runs[1].y, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("start", [0.5, -0.5])
def test_a_rate_that_is_no_number_ends_the_run(start):
    run = rk4(Functions(lambda t, y: np.where(t >= 0.5, np.nan, y)), start, 2, [1.0], max_step=0.01)
    assert run.outcome == "not_finite" and 0.47 < run.t_end <= 0.5


@pytest.mark.parametrize(
    ("rate", "y0", "limit"), [(lambda t, y: np.array([y[1], -y[0]]), [1.0, 0.0], 8**0.5), (lambda t, y: -y, [1.0], 2.785)]
)
def test_steps_are_stable_up_to_the_stated_limit(rate, y0, limit):
    """The amplification of y' = i w y and y' = -r y by 1 + z + z^2/2 + z^3/6 + z^4/24 is 1 there."""
    below, above = (rk4(Functions(rate), 0.0, 1000 * limit, y0, max_step=share * limit) for share in (0.99, 1.01))
    assert np.linalg.norm(below.y_end) < 1.0 < np.linalg.norm(above.y_end)


def test_a_run_that_grows_without_bound_advises_a_smaller_step():
    with np.errstate(over="ignore", invalid="ignore"):
        run = rk4(Functions(lambda t, y: -(y**3)), 0.0, 100.0, [10.0], max_step=0.5)
    assert run.outcome == "not_finite" and "take a smaller max_step" in run.advice


@pytest.mark.parametrize("more", [{}, {"max_step": 0.0}, {"first_step": 0.1}])
def test_the_step_must_be_given(more):
    with pytest.raises(InputError, match="'rk4' takes steps of one size; give it as max_step"):
        rk4(Ball(9.81, 0.5), 0.0, 1.0, [1.0, 0.0], **more)
