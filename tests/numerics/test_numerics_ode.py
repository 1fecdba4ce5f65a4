"""The integrator against closed forms, against scipy, and compiled against plain Python."""

from typing import NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from drivewright._jit import implements
from drivewright.errors import InputError, SolverError
from drivewright.numerics.ode import Event, Functions, events, integrate, loop, rate
from drivewright.numerics.ode.dense_output import component, polynomial

pytestmark = pytest.mark.analytical

G = 9.81


class Duffing(NamedTuple):
    """x'' = -damping x' - x - cubic x^3 + push cos t; watched for x = level and for v = 0."""

    damping: float
    cubic: float
    push: float
    level: float


@implements(rate, Duffing)
def _(system, t, y, dy):
    dy[0] = y[1]
    dy[1] = -system.damping * y[1] - y[0] - system.cubic * y[0] * y[0] * y[0] + system.push * np.cos(t)


@implements(events, Duffing)
def _(system, t, y, values):
    values[0] = y[0] - system.level
    values[1] = y[1]


def uncompiled(system):
    """The same system as ordinary functions, written once more."""

    def derivative(t, y):
        return np.array([y[1], -system.damping * y[1] - y[0] - system.cubic * y[0] * y[0] * y[0] + system.push * np.cos(t)])

    return Functions(derivative, lambda t, y: np.array([y[0] - system.level, y[1]]))


BOTH = Event(), Event(-1)
HARD = Duffing(0.1, 1.3, 0.8, 0.4)
FREE = Duffing(0.0, 0.0, 0.0, 0.4)
FALL = Functions(lambda t, y: np.array([y[1], -G]), lambda t, y: np.array([y[0]]))


def test_agrees_with_another_method_on_a_nonlinear_problem():
    t = np.linspace(0, 20, 41)
    ours = integrate(HARD, 0, 20, [1.0, -0.2], 1e-12, 1e-13, samples=t, watch=BOTH)
    theirs = solve_ivp(uncompiled(HARD).rate, (0, 20), [1.0, -0.2], "DOP853", t, rtol=1e-13, atol=1e-14)
    np.testing.assert_allclose(ours.y, theirs.y.T, atol=3e-9)
    np.testing.assert_array_equal(ours.t, t)


def test_error_follows_the_tolerance():
    theirs = solve_ivp(uncompiled(HARD).rate, (0, 20), [1.0, -0.2], "DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    errors = [np.abs(integrate(HARD, 0, 20, [1.0, -0.2], tol, tol, watch=BOTH).y_end - theirs).max() for tol in (1e-5, 1e-7, 1e-9)]
    assert errors[0] < 1e-2 and errors[1] < errors[0] / 30 and errors[2] < errors[1] / 30


def test_energy_of_an_oscillator():
    run = integrate(FREE, 0, 200, [0.3, 0.9], 1e-10, 1e-12, watch=BOTH)
    energy = run.y[:, 0] ** 2 + run.y[:, 1] ** 2
    assert np.abs(energy / 0.9 - 1).max() < 1e-7
    assert run.outcome == "finished" and run.t[-1] == run.t_end == 200 and run.steps == run.t.size - 1


def test_compiled_equals_uncompiled():
    fast = integrate(HARD, 0, 20, [1.0, -0.2], watch=BOTH)
    slow = integrate(uncompiled(HARD), 0, 20, [1.0, -0.2], watch=BOTH)
    np.testing.assert_allclose(fast.y, slow.y, rtol=1e-11, atol=1e-12)
    np.testing.assert_allclose(fast.t, slow.t, rtol=1e-12)
    assert (fast.steps, fast.rejected) == (slow.steps, slow.rejected)
    np.testing.assert_allclose([e.t for e in fast.events], [e.t for e in slow.events], rtol=1e-12)


def test_batches_change_nothing(monkeypatch):
    whole = integrate(HARD, 0, 20, [1.0, -0.2], samples=np.linspace(0, 20, 333), watch=BOTH)
    monkeypatch.setattr(loop, "_BATCH", 7)
    parts = integrate(HARD, 0, 20, [1.0, -0.2], samples=np.linspace(0, 20, 333), watch=BOTH)
    np.testing.assert_array_equal(parts.y, whole.y)
    assert [(e.t, e.event) for e in parts.events] == [(e.t, e.event) for e in whole.events]
    assert (parts.steps, parts.rejected) == (whole.steps, whole.rejected)


def test_events_of_an_oscillator_by_name_and_direction():
    # x = cos(t + a): x falls or rises through the level, v falls through 0 at each maximum
    run = integrate(FREE, 0, 12, [np.cos(0.2), -np.sin(0.2)], 1e-12, 1e-13, watch=BOTH)
    level = np.arccos(0.4)
    crossings = np.sort(np.concatenate([level + 2 * np.pi * np.arange(3), 2 * np.pi * np.arange(1, 3) - level])) - 0.2
    np.testing.assert_allclose([e.t for e in run.events if e.event == 0], crossings[crossings < 12], atol=1e-9)
    np.testing.assert_allclose([e.t for e in run.events if e.event == 1], 2 * np.pi * np.arange(1, 2) - 0.2, atol=1e-9)
    assert [e.t for e in run.events] == sorted(e.t for e in run.events)
    np.testing.assert_allclose([e.y[0] for e in run.events if e.event == 0], 0.4, atol=1e-12)


def test_a_fall_ends_on_the_ground():
    run = integrate(FALL, 0.5, 9, [2.0, 1.0], samples=np.linspace(0.5, 9, 86), watch=[Event(-1, terminal=True)])
    landing = (1 + np.sqrt(1 + 4 * G)) / G
    assert run.outcome == "event" and run.advice == ""
    assert run.t_end == pytest.approx(0.5 + landing, rel=1e-14)
    np.testing.assert_allclose(run.y_end, [0, 1 - G * landing], atol=1e-13)
    assert run.t[-1] <= run.t_end < run.t[-1] + 0.1
    np.testing.assert_allclose(run.y[:, 0], 2 + (run.t - 0.5) - G / 2 * (run.t - 0.5) ** 2, rtol=1e-12)


def test_a_ball_bounces_and_each_landing_starts_the_next_flight():
    t, y, landings = 0.0, np.array([1.0, 0.0]), []
    for _ in range(6):
        run = integrate(FALL, t, 99, y, watch=[Event(-1, terminal=True)])
        t, y = run.t_end, run.y_end * [1, -0.8]
        landings.append(t)
    fall = np.sqrt(2 / G)
    np.testing.assert_allclose(landings, fall * np.cumsum([1, *2 * 0.8 ** np.arange(1, 6)]), rtol=1e-12)


def test_only_what_happens_before_the_end_is_reported():
    # both fall through zero within the same large step; the second, though later in the list, is first and ends the run
    drop = Functions(lambda t, y: np.array([-1.0]), lambda t, y: np.array([y[0], y[0] - 0.25]))
    run = integrate(drop, 0, 10, [1.0], watch=[Event(), Event(terminal=True)], first_step=2.0)
    assert [e.event for e in run.events] == [1] and run.t_end == pytest.approx(0.75, abs=1e-13)
    both = integrate(drop, 0, 10, [1.0], watch=[Event(), Event()], first_step=2.0)
    np.testing.assert_allclose([(e.t, e.event) for e in both.events], [(0.75, 1), (1.0, 0)], atol=1e-13)


@pytest.mark.parametrize("sign", [1, -1])
def test_an_event_exactly_at_the_end_of_a_step_happens_once(sign):
    ramp = Functions(lambda t, y: np.array([sign]), lambda t, y: np.round(y, 9))
    run = integrate(ramp, 0, 2, [-sign], first_step=1.0, max_step=1.0, watch=[Event(sign)])
    assert 0.0 in np.round(run.y, 9) and [e.t for e in run.events] == pytest.approx([1.0], abs=1e-8)


def test_watching_in_the_wrong_direction_sees_nothing():
    assert integrate(FALL, 0, 2, [1.0, 0.0], watch=[Event(1, terminal=True)]).events == ()


def test_samples_at_both_ends_and_twice():
    t = [0.0, 0.0, 0.7, 2.0]
    run = integrate(FALL, 0, 2, [1.0, 3.0], samples=t)
    np.testing.assert_allclose(run.y[:, 0], 1 + 3 * np.array(t) - G / 2 * np.square(t), rtol=1e-13)


@pytest.mark.parametrize("batch", [7, 500])
def test_max_steps_gives_what_there_is_and_advice(batch, monkeypatch):
    monkeypatch.setattr(loop, "_BATCH", batch)
    run = integrate(FREE, 0, 200, [1.0, 0.0], max_steps=40, watch=BOTH)
    assert run.outcome == "max_steps" and run.steps == 40 and run.t.size == 41 and 0 < run.t_end < 200
    np.testing.assert_allclose(run.y_end, [np.cos(run.t_end), -np.sin(run.t_end)], atol=1e-7)
    with pytest.raises(SolverError, match=r"stopped at t = .*limit of 40 steps is reached. Raise max_steps") as caught:
        run.checked()
    assert caught.value.partial is run


def test_a_finished_run_passes_the_check():
    run = integrate(FALL, 0, 1, [1.0, 0.0])
    assert run.checked() is run


def test_a_singularity_stops_at_min_step():
    # y = 1/(1 - t) leaves every bound at t = 1
    run = integrate(Functions(lambda t, y: y**2), 0, 2, [1.0], min_step=1e-6)
    assert run.outcome == "min_step" and "1.0e-06" in run.advice
    assert 0.99 < run.t_end < 1


@pytest.mark.parametrize("start", [0.5, -0.5])
def test_a_rate_that_is_no_number_is_told_from_a_stiff_one(start):
    run = integrate(Functions(lambda t, y: np.where(t >= 0.5, np.nan, y)), start, 2, [1.0])
    assert run.outcome == "not_finite" and "singular place" in run.advice
    assert run.t_end == pytest.approx(0.5, abs=1e-9) and run.t_end <= 0.5
    assert run.y_end[0] == pytest.approx(np.exp(0.5 - start), rel=1e-6)


def test_the_first_step_is_careful_and_max_step_is_kept():
    steps = np.diff(integrate(HARD, 0, 20, [1.0, -0.2], max_step=0.05, watch=BOTH).t)
    assert steps[0] < 0.02 and steps.max() <= 0.05 * (1 + 1e-12)


def test_events_may_look_at_the_time():
    late = Functions(lambda t, y: np.cos([t]), lambda t, y: np.array([(t - 2.4321) * (1 + y[0] ** 2), y[0] - np.sin(0.7)]))
    run = integrate(late, 0.3, 4, [np.sin(0.3)], 1e-11, 1e-12, watch=[Event(1), Event(1)])
    np.testing.assert_allclose([(e.t, e.event) for e in run.events], [(0.7, 1), (2.4321, 0)], rtol=1e-10)


def test_kernels_and_samples_use_one_interpolant():
    dense = np.random.default_rng(3).normal(size=(5, 2))
    for theta in (0.0, 0.3, 0.77, 1.0):
        assert component(dense, 1, theta) == pytest.approx(polynomial(dense, theta)[1], rel=1e-15)


def test_work_is_counted():
    calls = []
    run = integrate(Functions(lambda t, y: calls.append(t) or uncompiled(HARD).rate(t, y)), 0, 20, [1.0, -0.2], first_step=1.0)
    assert run.rejected > 0 and len(calls) == 1 + 6 * (run.steps + run.rejected)


def test_a_system_beside_its_copy_takes_the_same_steps():
    rate_of_one = uncompiled(HARD).rate
    one = integrate(Functions(rate_of_one), 0, 20, [1.0, -0.2])
    two = integrate(Functions(lambda t, y: np.concatenate([rate_of_one(t, y[:2]), rate_of_one(t, y[2:])])), 0, 20, [1.0, -0.2] * 2)
    np.testing.assert_allclose(two.t, one.t, rtol=1e-6)


@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-10])
def test_step_control_is_as_good_as_that_of_another_code_with_the_same_method(tolerance):
    ours = integrate(HARD, 0, 20, [1.0, -0.2], tolerance, tolerance, watch=BOTH)
    theirs = solve_ivp(uncompiled(HARD).rate, (0, 20), [1.0, -0.2], "RK45", rtol=tolerance, atol=tolerance)
    assert 0.85 < (ours.steps + ours.rejected) / ((theirs.nfev - 2) / 6) < 1.15
    assert ours.rejected < 0.3 * ours.steps


def test_the_first_step_is_a_hundredth_of_the_time_in_which_y_changes():
    grows = Functions(lambda t, y: y * np.array([-0.5, 3.0]))
    first = np.diff(integrate(grows, 0, 1, [3.0, 0.1], 1e-6, 1e-30).t)[0]
    assert first == pytest.approx(0.01 * np.sqrt(2 / (0.25 + 9)), rel=1e-12)
    from_rest = integrate(Functions(lambda t, y: np.ones(1)), 1, 5, [0.0])
    assert np.diff(from_rest.t)[:2] == pytest.approx([4e-6, 2e-5], rel=1e-9)  # and at most five times the one before


def test_rescaling_time_and_length_changes_nothing():
    metres = integrate(FALL, 0, 2, [1.0, 3.0], 1e-6, [1e-9, 1e-8], watch=[Event(-1)])
    falls = Functions(lambda t, y: np.array([y[1], -G * 1e3 / 1e6]), FALL.events)  # mm, ms
    millimetres = integrate(falls, 0, 2e3, [1e3, 3.0], 1e-6, [1e-6, 1e-8], watch=[Event(-1)])
    np.testing.assert_allclose(millimetres.t, 1e3 * metres.t, rtol=1e-12)
    assert millimetres.events[0].t == pytest.approx(1e3 * metres.events[0].t, rel=1e-12)


@pytest.mark.parametrize(
    "call, word",
    [
        (lambda: integrate(FALL, 1, 1, [1.0, 0.0]), "t1 = 1 must lie after t0 = 1"),
        (lambda: integrate(FALL, 0, 1, [np.nan, 0.0]), "finite numbers, got"),
        (lambda: integrate(FALL, 0, 1, [1.0, 0.0], samples=[0.5, 1.5]), r"samples 0.5 .. 1.5 must ascend within \[0, 1\]"),
        (lambda: integrate(FALL, 0, 1, [1.0, 0.0], atol=0.0), "must be above 0; atol is the size"),
        (lambda: integrate((1.0, 2.0), 0, 1, [1.0, 0.0]), "rate: no formula for a tuple; it has one for: .*Functions"),
    ],
)
def test_messages(call, word):
    with pytest.raises(InputError, match=word):
        call()


@pytest.mark.parametrize("per_step", [1, 2, 3])
@pytest.mark.parametrize("limits", [{"max_steps": 0}, {"min_step": 0.5}])
def test_a_run_without_a_single_step_is_its_start(per_step, limits):
    found = integrate(Functions(lambda t, y: -1e6 * y), 0, 1, [1.0, 2.0], per_step=per_step, **limits)
    assert found.advice and found.t.tolist() == [0.0] and found.y.tolist() == [[1.0, 2.0]]


@pytest.mark.parametrize("power", [1, 3, 9])
def test_an_event_is_found_in_few_evaluations_and_on_its_far_side(power):
    seen = []

    def watched(t, y):
        seen.append(t)
        return [np.sign(y[0] - 0.3) * abs(y[0] - 0.3) ** power]

    run = integrate(Functions(lambda t, y: [1.0], watched), 0.0, 1.0, [0.0], samples=[], watch=[Event(terminal=True)], first_step=1.0)
    assert run.outcome == "event"
    assert 0.0 <= run.t_end - 0.3 < 1e-11
    assert len(seen) < (20 if power == 1 else 50)  # bisection takes as many in every case
