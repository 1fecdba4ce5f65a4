"""The stiff integrator against closed forms, scipy and DOPRI5; compiled against plain Python; its Jacobians and linear systems."""

import signal
import threading
from functools import partial
from typing import NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk

from drivewright._jit import implements, plain
from drivewright.errors import InputError, SolverError
from drivewright.numerics.ode import Event, Functions, events, integrate, jacobian, loop, rate, switch
from drivewright.numerics.ode.dense_output import polynomial
from drivewright.numerics.ode.method import ERROR, StepControl
from drivewright.numerics.ode.methods import radau
from drivewright.numerics.ode.system import FiniteDifferences, with_jacobian

pytestmark = pytest.mark.analytical

integrate_radau = partial(integrate, method="radau")

G = 9.81


class VanDerPol(NamedTuple):
    """x' = v, v' = mu ((1 - x^2) v - x); watched for x = level and x = -1.5, where it can be set back, and for nothing."""

    mu: float
    level: float
    back: float


@implements(rate, VanDerPol)
def _(system, t, y, dy):
    dy[0] = y[1]
    dy[1] = system.mu * ((1.0 - y[0] * y[0]) * y[1] - y[0])


@implements(events, VanDerPol)
def _(system, t, y, values):
    values[0] = y[0] - system.level
    values[1] = y[0] + 1.5
    values[2] = 1.0


@implements(switch, VanDerPol)
def _(system, index, t, y):
    y[0], y[1] = system.back, 0.0


def uncompiled(system):
    """The same system as ordinary functions, written once more."""
    return Functions(
        lambda t, y: np.array([y[1], system.mu * ((1.0 - y[0] * y[0]) * y[1] - y[0])]),
        lambda t, y: np.array([y[0] - system.level, y[0] + 1.5, 1.0]),
        lambda index, t, y: np.array([system.back, 0.0]),
    )


class Stated(NamedTuple):
    """Van der Pol's equation with its Jacobian; `wrong` spoils it."""

    mu: float
    wrong: float


@implements(rate, Stated)
def _(system, t, y, dy):
    dy[0] = y[1]
    dy[1] = system.mu * ((1.0 - y[0] * y[0]) * y[1] - y[0])


@implements(events, Stated)
def _(system, t, y, values):
    values[0] = y[0]


@implements(jacobian, Stated)
def _(system, t, y, J):
    J[0, 1] = 1.0
    J[1, 0] = -system.mu * (2.0 * y[0] * y[1] + 1.0)
    J[1, 1] = system.mu * (1.0 - y[0] * y[0]) * system.wrong


STIFF, MILD = VanDerPol(1e6, 0.3, 1.8), VanDerPol(50.0, 0.3, 1.8)
START = [2.0, -0.66]
BOTH = Event(), Event(), Event(switches=True)  # the last never happens: with it all runs use the same kernel
BACK = Event(), Event(-1, switches=True), Event()
TOLERANCE = 1e-6
# The length of a step follows the estimated error to the power -1/4, and this the Jacobian, differenced over a billionth of y:
# rounding, which differs from one processor to the next, is seen in its eighth digit, though the motion keeps fourteen.
STEPS = 1e-4
FALL = Functions(lambda t, y: np.array([y[1], -G]), lambda t, y: np.array([y[0]]), lambda index, t, y: y * [0, -0.8])


def relax(system, *args, **more):
    """One kind of call, so that one kernel is compiled."""
    return integrate_radau(system, *args, **({"watch": BOTH} | more))


# ------------------------------------------------------------------------------------------------------- stiff problems


@pytest.mark.slow
def test_van_der_pol_agrees_with_another_code():
    t = np.array([0.1, 0.7, 0.8, 0.81, 1.3, 2.0])  # x jumps from 1 to -2 just before 0.81
    ours = relax(STIFF, 0, 2, START, 1e-9, 1e-11, samples=t)
    theirs = solve_ivp(uncompiled(STIFF).rate, (0, 2), START, "LSODA", t, rtol=1e-11, atol=1e-13)
    np.testing.assert_allclose(ours.y, theirs.y.T, rtol=1e-6)
    assert ours.outcome == "finished" and ours.steps < 8000


def test_error_follows_the_tolerance():
    theirs = solve_ivp(uncompiled(STIFF).rate, (0, 2), START, "LSODA", rtol=1e-12, atol=1e-14).y[:, -1]
    errors = [np.abs(relax(STIFF, 0, 2, START, tol, tol).y_end - theirs).max() for tol in (1e-3, 1e-5, 1e-7)]
    assert errors[0] < 1e-2 and errors[1] < errors[0] / 10 and errors[2] < 1e-6


def test_far_fewer_steps_than_an_explicit_method():
    stiff = VanDerPol(1e4, 0.3, 1.8)
    explicit = integrate(uncompiled(stiff), 0, 0.2, START, 1e-6, 1e-8)
    implicit = relax(stiff, 0, 0.2, START, 1e-6, 1e-8)
    assert explicit.steps > 1500 and implicit.steps < explicit.steps / 30
    np.testing.assert_allclose(implicit.y_end, explicit.y_end, rtol=1e-6)


def test_about_as_many_steps_as_another_code_with_the_same_method():
    ours = relax(STIFF, 0, 2, START, 1e-6, 1e-8)
    theirs = solve_ivp(uncompiled(STIFF).rate, (0, 2), START, "Radau", rtol=1e-6, atol=1e-8)
    assert 0.8 < ours.steps / (theirs.t.size - 1) < 1.1 and ours.rejected < 0.05 * ours.steps


@pytest.mark.parametrize("decay", [1e2, 1e5, 1e9])
def test_prothero_robinson(decay):
    problem = Functions(lambda t, y: -decay * (y - np.sin(t)) + np.cos(t))
    run = integrate_radau(problem, 0.2, 12, [np.sin(0.2)], 1e-7, 1e-7)
    np.testing.assert_allclose(run.y[:, 0], np.sin(run.t), atol=1e-6)
    assert run.steps < 250


def test_a_layer_in_the_beginning_is_followed_and_left():
    run = integrate_radau(Functions(lambda t, y: -1e6 * (y - np.cos(t))), 0, 3, [3.0], 1e-6, 1e-8)
    # y = (1e12 cos t + 1e6 sin t) / (1e12 + 1) + 2 exp(-1e6 t)
    np.testing.assert_allclose(run.y[:, 0], np.cos(run.t) + 1e-6 * np.sin(run.t) + 2 * np.exp(-1e6 * run.t), atol=1e-6)
    assert run.steps < 300 and np.diff(run.t)[:-1].max() > 1e5 * np.diff(run.t)[0]


def test_a_first_step_across_the_layer_is_not_refused():
    # The result lies on the slow motion though the start does not: the second look at the estimate sees that.
    run = integrate_radau(Functions(lambda t, y: -1e8 * (y - np.cos(t))), 0, 3, [3.0], 1e-5, 1e-6, first_step=1e-2)
    assert run.rejected == 0 and run.y_end[0] == pytest.approx(np.cos(3), abs=1e-5)


def test_a_huge_eigenvalue_is_damped_in_one_step():
    run = integrate_radau(Functions(lambda t, y: -1e13 * y), 0, 1, [1.0], 1e9, 1e9, first_step=1.0)
    assert run.steps == 1 and abs(run.y_end[0]) < 1e-6  # as far as the difference quotient goes


def test_a_stiff_oscillator_beside_a_slow_one():
    # Eigenvalues -3e4 +- 4e4 i and -0.2 +- 3 i, mixed.
    mix = np.array([[1.0, 0.2, -0.5, 0.1], [0.3, 1.0, 0.4, -0.2], [-0.1, 0.6, 1.0, 0.3], [0.2, -0.3, 0.1, 1.0]])
    blocks = np.zeros((4, 4))
    blocks[:2, :2], blocks[2:, 2:] = [[-3e4, -4e4], [4e4, -3e4]], [[-0.2, -3.0], [3.0, -0.2]]
    matrix, start = mix @ blocks @ np.linalg.inv(mix), np.array([0.7, -0.4, 1.1, 0.2])

    def exact(t):
        fast, slow = (np.exp(v * t) * complex(*pair) for v, pair in zip((-3e4 + 4e4j, -0.2 + 3j), start.reshape(2, 2), strict=True))
        return mix @ [fast.real, fast.imag, slow.real, slow.imag]

    run = integrate_radau(Functions(lambda t, y: matrix @ y), 0, 4, mix @ start, 1e-7, 1e-8)
    np.testing.assert_allclose(run.y, [exact(t) for t in run.t], atol=1e-7)
    assert run.steps < 1500


def test_energy_and_period_of_an_undamped_pendulum():
    pendulum = Functions(lambda t, y: np.array([y[1], -np.sin(y[0])]))
    run = integrate_radau(pendulum, 0, 30, [2.5, 0.0], 1e-8, 1e-9)
    energy = run.y[:, 1] ** 2 / 2 - np.cos(run.y[:, 0])
    assert np.abs(energy - energy[0]).max() < 1e-8
    m = np.sin(1.25) ** 2
    exact = 2 * np.arcsin(np.sin(1.25) * ellipj(ellipk(m) - run.t, m)[0])
    np.testing.assert_allclose(run.y[:, 0], exact, atol=2e-8)


# ------------------------------------------------------------------------------------- dense output, events, switches


def test_samples_are_as_accurate_as_the_tolerance_asks():
    t = np.linspace(0.5, 20, 400)
    problem = Functions(lambda t, y: np.array([-300 * (y[0] - np.sin(t)) + np.cos(t), y[0]]))
    run = integrate_radau(problem, 0.5, 20, [np.sin(0.5), -np.cos(0.5)], 1e-7, 1e-7, samples=t)
    np.testing.assert_array_equal(run.t, t)
    assert run.steps < t.size
    np.testing.assert_allclose(run.y, np.stack([np.sin(t), -np.cos(t)], axis=1), atol=1e-6)


def test_events_are_found_by_name_direction_and_time():
    swing = Functions(lambda t, y: np.array([y[1], -y[0]]), lambda t, y: np.array([y[0] - 0.4, y[1]]))
    run = integrate_radau(swing, 0, 12, [np.cos(0.2), -np.sin(0.2)], 1e-10, 1e-11, watch=[Event(), Event(-1)])
    level = np.arccos(0.4)
    crossings = np.sort(np.concatenate([level + 2 * np.pi * np.arange(3), 2 * np.pi * np.arange(1, 3) - level])) - 0.2
    np.testing.assert_allclose([e.t for e in run.events if e.event == 0], crossings[crossings < 12], atol=1e-8)
    np.testing.assert_allclose([e.t for e in run.events if e.event == 1], [2 * np.pi - 0.2], atol=1e-8)
    assert [e.t for e in run.events] == sorted(e.t for e in run.events)


def test_a_fall_ends_on_the_ground():
    run = integrate_radau(FALL, 0.5, 9, [2.0, 1.0], samples=np.linspace(0.5, 9, 86), watch=[Event(-1, terminal=True)])
    landing = (1 + np.sqrt(1 + 4 * G)) / G
    assert run.outcome == "event" and run.advice == ""
    assert run.t_end == pytest.approx(0.5 + landing, rel=1e-12)
    np.testing.assert_allclose(run.y_end, [0, 1 - G * landing], atol=1e-11)
    assert run.t[-1] <= run.t_end < run.t[-1] + 0.1
    np.testing.assert_allclose(run.y[:, 0], 2 + (run.t - 0.5) - G / 2 * (run.t - 0.5) ** 2, rtol=1e-11)


def test_a_ball_bounces_within_one_run():
    fall = np.sqrt(2 / G)
    landings = fall * np.cumsum([1, *2 * 0.8 ** np.arange(1, 6)])
    run = integrate_radau(FALL, 0, landings[-1] + 0.01, [1.0, 0.0], watch=[Event(-1, switches=True)])
    np.testing.assert_allclose([e.t for e in run.events], landings, rtol=1e-10)
    np.testing.assert_allclose([e.y[1] for e in run.events], G * fall * 0.8 ** np.arange(1, 7), rtol=1e-9)
    assert run.outcome == "finished"


def test_a_switch_at_the_very_end():
    ramp = Functions(lambda t, y: np.ones(1), lambda t, y: np.array([t - 1]), lambda index, t, y: y + 7)
    run = integrate_radau(ramp, 0, 1, [-1.0], watch=[Event(1, switches=True)])
    assert run.outcome == "finished" and run.t_end == 1.0 and run.y_end[0] == pytest.approx(7, abs=1e-12)


def test_a_stiff_system_that_is_set_back_repeats_itself():
    # From x = 1.8, v = 0 it creeps to x = 1, jumps towards -2 and is set back at -1.5.
    run = relax(STIFF, 0, 2, [1.8, 0.0], 1e-8, 1e-10, watch=BACK)
    periods = np.diff([0, *(e.t for e in run.events if e.event == 1)])
    assert len(periods) == 3 and run.outcome == "finished" and [e.event for e in run.events] == [0, 1, 0, 1, 0, 1]
    np.testing.assert_allclose(periods, periods[0], rtol=1e-6)
    # Slow motion x' = x / (1 - x^2): the time from 1.8 to 1 is (1.8^2 - 1) / 2 - ln 1.8; the corner adds O(mu^(-2/3)).
    assert periods[0] == pytest.approx((1.8**2 - 1) / 2 - np.log(1.8), abs=5 * 1e6 ** (-2 / 3))


def test_after_a_switch_it_goes_on_as_if_begun_there():
    whole = relax(MILD, 0, 3, [1.8, 0.0], TOLERANCE, 1e-2 * TOLERANCE, watch=BACK)
    switched = next(e.t for e in whole.events if e.event == 1)
    later = whole.t[whole.t >= switched][:20]
    fresh = relax(MILD, switched, 3, [1.8, 0.0], TOLERANCE, 1e-2 * TOLERANCE, watch=BACK, first_step=later[1] - later[0])
    # A Jacobian, an error or a polynomial that is remembered moves the steps by per cents.
    np.testing.assert_allclose(np.diff(later), np.diff(fresh.t[:20]), rtol=STEPS)


# ------------------------------------------------------------------------------------------------------ plain, batches


def test_compiled_equals_uncompiled():
    t, tight = np.linspace(0, 2, 401), {"rtol": 1e-3 * TOLERANCE, "atol": 1e-3 * TOLERANCE}
    fast, slow = (relax(each, 0, 2, START, TOLERANCE, 1e-2 * TOLERANCE, watch=BACK) for each in (MILD, uncompiled(MILD)))
    assert (fast.steps, fast.rejected) == pytest.approx((slow.steps, slow.rejected), abs=2) and len(fast.events) >= 3
    np.testing.assert_allclose([e.t for e in fast.events], [e.t for e in slow.events], **tight)
    fast, slow = (relax(each, 0, 2, START, TOLERANCE, 1e-2 * TOLERANCE, watch=BACK, samples=t) for each in (MILD, uncompiled(MILD)))
    # Next to a jump a shift in time counts as often as y is steep there: |dy| <= |y'| |dt|.
    steep = 1 + np.abs([uncompiled(MILD).rate(0, y) for y in slow.y])
    assert np.all(np.abs(fast.y - slow.y) <= 1e-3 * TOLERANCE * (steep + np.abs(slow.y)))


def test_compiled_and_uncompiled_take_the_same_steps():
    fast, slow = (relax(each, 0, 0.3, START, TOLERANCE, 1e-2 * TOLERANCE) for each in (MILD, uncompiled(MILD)))
    np.testing.assert_allclose(np.diff(fast.t[:60]), np.diff(slow.t[:60]), rtol=STEPS)


def test_batches_change_nothing(monkeypatch):
    whole = relax(STIFF, 0, 2, START, 1e-6, 1e-8, samples=np.linspace(0, 2, 333))
    monkeypatch.setattr(loop, "_BATCH", 7)
    parts = relax(STIFF, 0, 2, START, 1e-6, 1e-8, samples=np.linspace(0, 2, 333))
    np.testing.assert_array_equal(parts.y, whole.y)
    assert [(e.t, e.event) for e in parts.events] == [(e.t, e.event) for e in whole.events]
    assert (parts.steps, parts.rejected) == (whole.steps, whole.rejected)


def test_it_can_be_interrupted():
    relax(MILD, 0, 1e-3, START, samples=[0.0])  # compiled: a signal within LLVM's calls is lost
    timer = threading.Timer(0.3, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        relax(MILD, 0, 1e7, START, max_steps=10**9, samples=[0.0])
    timer.join()


def test_rescaling_time_and_length_changes_nothing():
    metres = integrate_radau(FALL, 0, 2, [1.0, 3.0], 1e-6, [1e-9, 1e-8])
    falls = Functions(lambda t, y: np.array([y[1], -G * 1e3 / 1e6]))  # mm, ms
    millimetres = integrate_radau(falls, 0, 2e3, [1e3, 3.0], 1e-6, [1e-6, 1e-8])
    np.testing.assert_allclose(millimetres.t, 1e3 * metres.t, rtol=1e-9)


def test_several_points_per_step():
    coarse = relax(STIFF, 0, 0.5, START, 1e-6, 1e-8)
    fine = relax(STIFF, 0, 0.5, START, 1e-6, 1e-8, per_step=3)
    np.testing.assert_array_equal(fine.t[::3], coarse.t)
    np.testing.assert_allclose(fine.y[1::3], relax(STIFF, 0, 0.5, START, 1e-6, 1e-8, samples=fine.t[1::3]).y, rtol=1e-12)


# -------------------------------------------------------------------------------------------------------------- guards


def test_max_steps_gives_what_there_is_and_advice():
    run = relax(STIFF, 0, 2, START, max_steps=40)
    assert run.outcome == "max_steps" and run.steps == 40 and run.t.size == 41 and 0 < run.t_end < 2
    with pytest.raises(SolverError, match=r"stopped at t = .*limit of 40 steps is reached. Raise max_steps") as caught:
        run.checked()
    assert caught.value.partial is run


def test_max_step_and_first_step_are_kept():
    steps = np.diff(integrate_radau(FALL, 0, 2, [1.0, 3.0], max_step=0.07, first_step=3e-3).t)
    assert steps[0] == pytest.approx(3e-3) and steps.max() == pytest.approx(0.07, rel=1e-9) and 28 < steps.size < 34


def test_a_singularity_stops_at_min_step():
    run = integrate_radau(Functions(lambda t, y: y**2), 0, 2, [1.0], min_step=1e-6)  # y = 1 / (1 - t)
    assert run.outcome == "min_step" and "1.0e-06" in run.advice
    assert 0.99 < run.t_end < 1


@pytest.mark.parametrize("start", [0.5, -0.5])
def test_a_rate_that_is_no_number_is_told_from_a_stiff_one(start):
    run = integrate_radau(Functions(lambda t, y: np.where(t >= 0.5, np.nan, y)), start, 2, [1.0])
    assert run.outcome == "not_finite" and "singular place" in run.advice
    assert run.t_end == pytest.approx(0.5, abs=1e-9) and run.t_end <= 0.5
    assert run.y_end[0] == pytest.approx(np.exp(0.5 - start), rel=1e-6)


@pytest.mark.parametrize(
    "call, word",
    [
        (lambda: integrate_radau(FALL, 1, 1, [1.0, 0.0]), "t1 = 1 must lie after t0 = 1"),
        (lambda: integrate_radau(FALL, 0, 1, [1.0, 0.0], atol=0.0), "must be above 0; atol is the size"),
        (lambda: integrate_radau((1.0, 2.0), 0, 1, [1.0, 0.0]), "rate: no formula for a tuple; it has one for: .*Functions"),
    ],
)
def test_messages(call, word):
    with pytest.raises(InputError, match=word):
        call()


# ---------------------------------------------------------------------------------------------------- what serves again


def clock_after(h, error, iterations=3, again=False, contraction=0.5, old=(0.0, 0.0)):
    """(growth, clock, history) after a step that was tried."""
    clock, history = np.array([0.0, h, 1.0]), np.array([h, radau.FRESH, contraction, 1.0, *old])
    return plain(radau._growth)(error, iterations, h, again, clock, history), clock, history


def test_the_step_follows_the_error_and_its_trend():
    assert clock_after(0.1, 0.5)[0] == pytest.approx(0.9 * 15 / 17 * 0.5**-0.25)
    assert clock_after(0.1, 7.0)[0] == pytest.approx(0.9 * 15 / 17 * 7**-0.25)
    # The error has risen from 0.1 to 0.5 while the step doubled: (0.5 / 0.1)^(1/4) / 2 more than a constant one would allow.
    assert clock_after(0.2, 0.5, old=(0.1, 0.1))[0] == pytest.approx(0.9 * 15 / 17 * 0.5**-0.25)
    assert clock_after(0.1, 0.5, old=(0.1, 0.1))[0] == pytest.approx(0.9 * (0.1 / 0.25) ** 0.25)
    assert clock_after(0.1, 1e-9)[0] == 8 and clock_after(0.1, 1e9)[0] == 0.2
    assert clock_after(0.1, 1e-9, again=True)[0] == 1
    growth, clock, history = clock_after(0.3, 0.5)
    assert [clock[ERROR], *history[[radau.OLD_STEP, radau.OLD_ERROR]]] == [0.5, 0.3, 0.5]


def test_failures_of_newtons_method():
    growth, clock, history = clock_after(0.1, np.nan, iterations=0)
    assert growth == 0.5 and np.isfinite(clock[ERROR])
    growth, clock, history = clock_after(0.1, np.nan, iterations=-1)
    assert growth == 0.1 and np.isnan(clock[ERROR])


def test_what_serves_again():
    growth, clock, history = clock_after(0.1, 0.3, contraction=1e-4)
    assert growth == 1 and history[radau.JACOBIAN] == radau.OLD  # else 1.07, for which the factors would be made anew
    growth, clock, history = clock_after(0.1, 0.1, contraction=1e-4)
    assert growth > 1.2 and history[radau.JACOBIAN] == radau.OLD
    growth, clock, history = clock_after(0.1, 0.3, contraction=0.1)
    assert 1 < growth < 1.2 and history[radau.JACOBIAN] == radau.MISSING


def prepared(system, y, h=0.01):
    control, work = StepControl(1.0, 1e-6, np.full(2, 1e-8), np.inf, 0.0), radau.METHOD.workspace(2)
    work.J[:] = 99.0
    rate(system, 0.0, y, work.f)
    plain(radau._prepare)(work, system, control, 0.0, h, y)
    return work, control


def test_a_new_jacobian_brings_new_factors():
    system, h, y = Stated(3.0, 1.0), 0.01, np.array([0.4, -0.7])
    work, control = prepared(system, np.array([2.0, 1.0]))
    work.history[radau.JACOBIAN] = radau.MISSING
    plain(radau._prepare)(work, system, control, 0.0, h, y)
    J = np.array([[0, 1], [-3 * (2 * 0.4 * -0.7 + 1), 3 * (1 - 0.16)]])
    np.testing.assert_allclose(work.J, J, rtol=1e-15)
    b = np.array([0.3, -1.2])
    x = b.copy()
    plain(radau._solve)(work.real, work.real_pivots, x)
    np.testing.assert_allclose((radau._REAL / h * np.eye(2) - J) @ x, b, rtol=1e-12)


def test_an_old_jacobian_is_renewed_before_the_step_is_given_up():
    system, y = Stated(1e5, 1.0), np.array([2.0, -0.66])
    work, control = prepared(system, y)
    work.J[:] = [[1e4, 3.0], [5.0, 1e6]]
    work.history[[radau.JACOBIAN, radau.FACTORED_STEP, radau.OLD_STEP]] = radau.OLD, 0.0, 0.0
    clock = np.array([0.0, 1e-6, 1.0])
    assert plain(radau._try_step)(work, system, control, clock, 0.0, 1e-6, False, y, np.empty(2))
    np.testing.assert_allclose(work.J[0], [0, 1], atol=0)


def test_the_first_guess_is_the_last_polynomial_continued():
    work = radau.METHOD.workspace(1)
    work.history[radau.OLD_STEP] = 0.2
    dense = np.array([0.3, -0.7, 1.9, 0.4, 0.0])[:, None]
    work.dense[:] = dense
    y = polynomial(dense, 1.0)
    plain(radau._predict)(work, 0.05, y)
    expected = [polynomial(dense, 1 + c * 0.05 / 0.2)[0] - y[0] for c in radau._C]
    np.testing.assert_allclose(work.z[:, 0], expected, rtol=1e-13)
    np.testing.assert_allclose(radau._T @ work.w[:, 0], expected, rtol=1e-12)


def test_a_system_beside_its_copy_takes_the_same_steps():
    one = integrate_radau(uncompiled(MILD), 0, 2, START, 1e-6, 1e-8)
    both = Functions(lambda t, y: np.concatenate([uncompiled(MILD).rate(t, y[:2]), uncompiled(MILD).rate(t, y[2:])]))
    np.testing.assert_allclose(integrate_radau(both, 0, 2, START * 2, 1e-6, 1e-8).t, one.t, rtol=1e-6)


# ------------------------------------------------------------------------------------------ Jacobians, linear systems


@pytest.mark.slow
def test_a_stated_jacobian_serves_and_a_wrong_one_costs_work_but_no_accuracy():
    theirs = relax(VanDerPol(1e4, 0.3, 1.8), 0, 0.6, START, 1e-6, 1e-8)
    right = integrate_radau(Stated(1e4, 1.0), 0, 0.6, START, 1e-6, 1e-8, watch=[Event()])
    wrong = integrate_radau(Stated(1e4, 1.3), 0, 0.6, START, 1e-6, 1e-8, watch=[Event()])
    assert abs(right.steps - theirs.steps) <= 3 and wrong.steps + wrong.rejected > 1.2 * right.steps
    np.testing.assert_allclose(right.y_end, theirs.y_end, rtol=1e-7)
    np.testing.assert_allclose(wrong.y_end, theirs.y_end, rtol=1e-6)


def test_the_jacobian_and_its_factors_serve_for_many_steps():
    calls = []
    run = integrate_radau(Functions(lambda t, y: calls.append(1) or np.array([-50.0, -2e4]) * (y - np.cos(t))), 0, 5, [1.0, 1.0])
    # Linear: an iteration (3 calls), sometimes two, and a closing call per step; a Jacobian (3 calls) in each would be seen.
    assert run.steps > 100 and len(calls) < 5.4 * (run.steps + run.rejected)


def contact(t, y):
    """Revolved angle of 100 turns against a bearing with 1e-6 m of play, at a radius of 0.05 m: F = k depth^1.5."""
    depth = 0.05 * (y[0] - 628.3) + y[1]
    return np.array([y[2], y[3], -5e8 * depth**1.5, -1e10 * depth**1.5])


@pytest.mark.parametrize("rtol, atol", [(1e-6, 1e-10), (1e-8, 1e-10), (1e-8, 1e-12), (1e-10, 1e-12)])
def test_differences_see_a_contact_of_a_micrometre_after_a_hundred_turns(rtol, atol):
    y = np.array([628.3 + 6e-6, 4e-7, 300.0, 0.02])
    depth = 0.05 * (y[0] - 628.3) + y[1]
    slope = 1.5 * np.sqrt(depth) * np.array([[0.05 * 5e8, 5e8], [0.05 * 1e10, 1e10]])
    J = np.zeros((4, 4))
    jacobian(with_jacobian(Functions(contact), rtol, np.full(4, atol)), 0.0, y, J)
    np.testing.assert_allclose(J[2:, :2], -slope, rtol=0.02)
    np.testing.assert_allclose(J[:2], np.eye(4)[2:], atol=1e-5)


def test_differences_keep_clear_of_rounding_and_bends():
    def error(rtol, atol):
        y, J = np.array([0.3, -1.1]), np.zeros((2, 2))
        bent = Functions(lambda t, y: np.array([np.sin(y[0]) * y[1], np.exp(y[0] * y[1])]))
        jacobian(with_jacobian(bent, rtol, np.full(2, atol)), 0.0, y, J)
        e = np.exp(-0.33)
        return np.abs(J - [[-1.1 * np.cos(0.3), np.sin(0.3)], [-1.1 * e, 0.3 * e]]).max()

    assert error(1e-3, 1e-6) < 1e-6 and error(1e-8, 1e-10) < 1e-6 and error(1e-13, 1e-15) < 1e-3


def test_a_system_keeps_its_own_jacobian():
    assert with_jacobian(Stated(1.0, 1.0), 1e-6, np.ones(2)) == Stated(1.0, 1.0)
    assert isinstance(with_jacobian(MILD, 1e-6, np.ones(2)), FiniteDifferences)


@pytest.mark.parametrize("n, kind", [(1, float), (2, complex), (7, float), (20, complex)])
def test_linear_systems(n, kind):
    rng = np.random.default_rng(n)
    a = rng.normal(size=(n, n)).astype(kind)
    if kind is complex:
        a += 1j * rng.normal(size=(n, n))
    if n > 1:
        a[0, 0] = 0.0  # asks for an exchange of rows
    x = rng.normal(size=n).astype(kind)
    for factor, solve in ((radau._factor, radau._solve), (plain(radau._factor), plain(radau._solve))):
        factors, pivots, b = a.copy(), np.empty(n, dtype=int), a @ x
        factor(factors, pivots)
        solve(factors, pivots, b)
        np.testing.assert_allclose(b, x, rtol=1e-11, atol=1e-12)
