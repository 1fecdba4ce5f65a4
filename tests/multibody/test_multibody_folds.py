"""Folds beside everything else that moves: more freedoms, pins with play, touching branches, samples, and which states are told."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from test_multibody_singular import TURN, G, folded, four_bar, slider_crank, turned, windows

import drivewright.multibody as mb
from drivewright.errors import DoesNotAssemble
from drivewright.multibody.chart import chart_offsets
from drivewright.multibody.reactions import unbounded_joints
from drivewright.multibody.simulate import states_outside_folds, work_at_state

pytestmark = pytest.mark.property

FRAME, CRANK = 0.15, 0.1


def parallelogram(speed=TURN, **more):
    return four_bar(FRAME, CRANK, FRAME, CRANK, speed, **more)


def sampled(model, times, rtol=1e-10):
    """(run, record) at the times."""
    run = mb.simulate(mb.assemble(model), times[-1], mb.Settings(rtol=rtol), samples=times)
    assert run.outcome == "complete", run.advice
    return run, mb.record(run, {body.name: mb.Marker(body.name) for body in model.bodies})


# -- more than the fold ----------------------------------------------------------------------------------------------------------

DRY = mb.Dry(2e-4, 8e-3, 1e8, 1.5, 0.3, friction=mb.Friction("coulomb", 0.1, 0.01))
BRISTLES = mb.Friction("lugre", 0.2, 0.01, static_coefficient=0.3, bristle_stiffness=1e4, bristle_damping=10.0)
PINS = {"ideal": mb.Ideal(), "dry": DRY, "bristles": replace(DRY, friction=BRISTLES)}


def hung(pin, speed, loop=True, base=None, spin=0.0):
    """A body hung from the coupler of a driven parallelogram; without the loop a second drive keeps the coupler level instead."""
    model = base or parallelogram(speed)
    bob = mb.Body("bob", 0.5, 1e-4, (0.02, 0.0), angle=-0.7, angular_velocity=spin)
    model = replace(
        model, bodies=(*model.bodies, bob), joints=(*model.joints, mb.Revolute("hook", mb.Marker("coupler", 0.06), mb.Marker("bob"), pin))
    )
    if loop:
        return model
    return replace(
        model,
        bodies=tuple(body for body in model.bodies if body.name != "rocker"),
        joints=tuple(joint for joint in model.joints if joint.name not in ("B", "O4")),
        drives=(*model.drives, mb.JointDrive("A", mb.line(0.0, -speed))),
    )


@pytest.mark.parametrize("speed", [TURN, -TURN])
@pytest.mark.parametrize("name", PINS)
def test_what_hangs_from_a_folding_loop_moves_as_without_the_loop(name, speed):
    times = np.linspace(0.0, 1.2, 121)
    run, seen = sampled(hung(PINS[name], speed), times)
    _, twin = sampled(hung(PINS[name], speed, loop=False), times)
    assert len(run.passages) == (2 if speed > 0 else 3) and (len(run.impacts) > 2) == (name != "ideal")
    for field, allowed in (("angle", 1e-6), ("x", 1e-7), ("y", 1e-7), ("w", 1e-4)):
        assert seen.point("bob", field) == pytest.approx(twin.point("bob", field), rel=0, abs=allowed), field
    for passed in run.passages:  # the chart counts from the fold, whatever else is in the state
        assert chart_offsets(passed.system, [passed.time], passed.state[None]) == pytest.approx([0.0], abs=1e-9)


@pytest.mark.parametrize(("name", "spin"), [("ideal", 0.0), ("ideal", 3.0), ("ideal", 40.0), ("dry", 0.0)])
def test_a_start_in_a_fold_does_not_depend_on_what_hangs_from_the_loop(name, spin):
    times = np.linspace(0.0, 0.6, 31)
    (run, seen), (_, twin) = (sampled(hung(PINS[name], TURN, loop, folded(rocker=TURN), spin), times) for loop in (True, False))
    assert len(run.passages) == 1
    assert seen.point("rocker", "angle") == pytest.approx(TURN * times, rel=0, abs=1e-8)
    assert seen.point("bob", "angle") == pytest.approx(twin.point("bob", "angle"), rel=0, abs=1e-6)


def test_a_fold_is_as_wide_as_the_loop_moves_however_fast_a_body_beside_it_spins():
    reach = []
    for spin in (0.0, 2000.0):
        run, seen = sampled(hung(mb.Ideal(), TURN, spin=spin), np.linspace(0.0, 0.4, 41))
        assert seen.point("rocker", "angle") == pytest.approx(np.pi / 3 + TURN * seen.t, rel=0, abs=1e-9)
        assert seen.point("rocker", "alpha") == pytest.approx(np.zeros(41), abs=1e-6)
        reach += [passed.system.chart.reach * passed.system.chart.pace for passed in run.passages]
    assert len(reach) == 2 and reach[1] == pytest.approx(reach[0], rel=1e-9)


def test_charts_count_from_the_fold_whichever_coordinate_is_independent():
    rates = {"crank": TURN, "coupler": 0.0, "rocker": TURN}
    free = replace(
        parallelogram(),
        drives=(),
        gravity=(0.0, 0.0),
        bodies=tuple(replace(body, angular_velocity=rates[body.name]) for body in parallelogram().bodies),
    )
    run = mb.simulate(mb.assemble(free), 1.4, mb.Settings(rtol=1e-10))
    assert [passed.time for passed in run.passages] == pytest.approx([1 / 3, 5 / 6, 4 / 3], abs=1e-6)
    for passed in run.passages:
        ahead = mb.simulate(mb.assemble(free), passed.time + 1e-3, mb.Settings(rtol=1e-10)).end
        assert chart_offsets(passed.system, [passed.time], passed.state[None]) == pytest.approx([0.0], abs=1e-9)
        assert chart_offsets(ahead[0], [ahead[1]], ahead[2][None]) == pytest.approx([1e-3 / ahead[0].chart.pace], rel=1e-3)
    rates["rocker"] = -5 * TURN  # the anti-parallelogram, in which coupler and rocker are faster than the crank
    free = replace(
        free,
        bodies=tuple(
            replace(body, angle=0.0, angular_velocity=rates.get(body.name) if body.name != "coupler" else None) for body in free.bodies
        ),
    )
    system, t, y = mb.simulate(mb.assemble(free), 1e-3, mb.Settings(rtol=1e-10)).end
    assert system.independent[0] != system.stored[0]
    assert chart_offsets(system, [t], y[None]) == pytest.approx([1e-3 / system.chart.pace], rel=1e-2)


def test_a_kite_starts_in_its_fold():
    """Crank and frame on each other, coupler and rocker too: what the coupler's joint does to the loop is zero there, but nowhere else."""
    base = four_bar(0.1, 0.1, 0.15, 0.15)
    model = replace(
        base,
        bodies=tuple(
            replace(body, angle=0.0, angular_velocity=rate * TURN) for body, rate in zip(base.bodies, (1.0, 1 / 6, 5 / 6), strict=True)
        ),
    )
    run, seen = turned(model, 0.9)
    half = TURN * seen.t / 2
    along = 0.1 * np.cos(half) + np.sqrt(0.15**2 - (0.1 * np.sin(half)) ** 2)
    rocker = np.angle(along * np.exp(1j * half) - 0.1)
    assert run.outcome == "complete" and np.max(np.abs(np.sin((seen.point("rocker", "angle") - rocker) / 2))) < 1e-8


def test_a_start_in_a_fold_of_a_loop_with_two_freedoms_is_refused():
    """Its rates do not say what the branch does where only one of them moves on."""
    base = carousel(2.0)
    bodies = tuple(replace(body, angle=0.0, inertia=1e-3) for body in base.bodies)
    with pytest.raises(DoesNotAssemble, match="starts in a singular position"):
        mb.assemble(
            replace(base, drives=(), bodies=tuple(replace(body, angular_velocity=2.0) if body.name == "table" else body for body in bodies))
        )


@pytest.mark.parametrize("name", PINS)
def test_the_energy_balance_closes_over_folds_with_freedoms_and_play(name):
    run = mb.simulate(mb.assemble(hung(PINS[name], TURN)), 1.2, mb.Settings(rtol=1e-10, per_step=2))
    found = mb.audit(mb.record(run, {}))
    assert found.error < 1e-8 and found.power_error < 1e-8
    assert (found.works[-1, 2] < -1e-4) == (name != "ideal")


def carousel(turn):
    """A free parallelogram whose frame is a driven turntable about the crank's axis: where it folds depends on crank and time."""
    base = parallelogram()
    rates = {"crank": 9.0, "coupler": turn, "rocker": 9.0}
    return replace(
        base,
        gravity=(0.0, 0.0),
        bodies=(mb.Body("table"), *(replace(body, angular_velocity=rates[body.name]) for body in base.bodies)),
        joints=(
            mb.Revolute("T", mb.Marker("table"), mb.Marker("ground")),
            *base.joints[:3],
            mb.Revolute("O4", mb.Marker("rocker"), mb.Marker("table", FRAME)),
        ),
        drives=(mb.JointDrive("T", mb.line(0.0, turn)),),
    )


@pytest.mark.parametrize("turn", [2.0, -3.0, 14.0])
def test_a_free_parallelogram_on_a_turntable_is_a_pendulum_in_its_field(turn):
    """I phi'' = -C turn^2 sin(phi - turn t), of the crank: I about the pins, C = m2 r c2 + m3 c3 f of coupler and rocker."""
    times = np.linspace(0.0, 1.5, 151)
    run, seen = sampled(carousel(turn), times)
    inertia = 2e-3 + 1.0 * 0.05**2 + 1.0 * CRANK**2 + 2.0 * 0.05**2
    field = 1.0 * CRANK * 0.075 + 2.0 * 0.05 * FRAME
    exact = solve_ivp(
        lambda t, y: [y[1], -field * turn**2 / inertia * np.sin(y[0] - turn * t)],
        (0.0, 1.5),
        [np.pi / 3, 9.0],
        method="DOP853",
        rtol=1e-12,
        atol=1e-12,
        dense_output=True,
    ).sol
    assert (
        len(run.passages)
        == np.count_nonzero(np.diff(np.floor((exact(np.linspace(0, 1.5, 100001))[0] - turn * np.linspace(0, 1.5, 100001)) / np.pi)))
        > 0
    )
    assert seen.point("crank", "angle") == pytest.approx(exact(times)[0], rel=0, abs=1e-6)
    assert seen.point("rocker", "angle") == pytest.approx(exact(times)[0], rel=0, abs=1e-6)
    assert seen.point("coupler", "angle") == pytest.approx(turn * times, rel=0, abs=1e-6)
    for passed in run.passages:
        assert np.sin(exact(passed.time)[0] - turn * passed.time) == pytest.approx(0.0, abs=1e-6)
        for delay in (-1e-4, 1e-4):  # on the way: beyond the fold later, with the speed of the fastest coordinate
            y = passed.state.copy()
            y[: len(passed.system.stored)] += delay * _rates(passed)[passed.system.stored]
            offset = chart_offsets(passed.system, [passed.time + delay], y[None])[0]
            assert offset == pytest.approx(delay / passed.system.chart.pace, rel=1e-2)


def _rates(passed):
    return work_at_state(passed.system, passed.time, passed.state).coordinates.v


CROSSING = {"parallelogram": parallelogram(), "kite": four_bar(0.1, 0.1, 0.15, 0.15), "slider": slider_crank()}


@pytest.mark.parametrize("method", ["dopri5", "radau"])
@pytest.mark.parametrize("excess", [0.1, 1e-3, -1e-2])
def test_a_drive_that_cannot_pass_is_told_with_a_freedom_left_too(excess, method):
    """A coupler too long for the fold at 0 deg, or too short for that at 180 deg: there coupler and rocker are in line."""
    base = four_bar(FRAME, CRANK, FRAME * (1 + excess), CRANK)
    run = mb.simulate(mb.assemble(hung(mb.Ideal(), TURN, base=base)), 1.0, mb.Settings(method=method))
    apart = FRAME * (1 + excess) + np.copysign(CRANK, -excess)
    angle = np.arccos((FRAME**2 + CRANK**2 - apart**2) / (2 * FRAME * CRANK))
    limit = (angle if excess < 0 else TURN - angle) / TURN - 1 / 6
    assert run.outcome == "partial" and run.end[1] == pytest.approx(limit, abs=1e-6) and not run.passages
    told = f"{np.degrees(angle if excess < 0 else TURN - angle):.2f}°"
    assert f"cannot go on beyond t = {run.end[1]:.6g} s of 1 s, drive 'O2' at {told}" in run.advice and "does not close there" in run.advice


# -- branches that touch ---------------------------------------------------------------------------------------------------------


def touching(speed, bend, driven=True):
    """A cam turns the parallelogram's crank by bend cam^2: it comes to the fold, rests there and turns back."""
    reach = 0.8
    lift = mb.Curve(np.array([-reach, 10.0]), np.array([[0.0, -2 * bend * reach, bend, 0, 0, 0]]))
    base, start = parallelogram(start=np.degrees(bend * reach**2)), -np.copysign(reach, speed)
    return replace(
        base,
        bodies=(mb.Body("cam", 1.0, 1e-3, angle=start, angular_velocity=None if driven else speed), *base.bodies),
        joints=(
            mb.Revolute("C", mb.Marker("cam"), mb.Marker("ground", 0.0, 0.5)),
            *base.joints,
            mb.CamPair("pair", "cam", mb.Marker("crank"), lift),
        ),
        drives=(mb.JointDrive("C", mb.line(0.0, speed)),) if driven else (),
        gravity=(0.0, 0.0),
    )


@pytest.mark.parametrize(("speed", "bend"), [(1.0, 0.5), (-1.0, 0.2), (3.0, 2.0)])
def test_where_branches_touch_the_acceleration_decides(speed, bend):
    """Parallelogram and anti-parallelogram have the same rates there; along both the smallest singular value falls as a square."""
    run, seen = turned(touching(speed, bend), 1.6 / TURN)
    assert seen.point("cam", "angle")[-1] == pytest.approx(np.copysign(0.8, speed), rel=1e-9)
    for name in ("crank", "rocker"):
        assert seen.point(name, "angle") == pytest.approx(bend * seen.point("cam", "angle") ** 2, rel=0, abs=1e-9)
        assert seen.point(name, "alpha") == pytest.approx(np.full(len(seen.t), 2 * bend * speed**2), rel=1e-6)
    (passed,) = run.passages
    assert passed.time == pytest.approx(0.8 / abs(speed), abs=1e-7) and passed.smallest < 1e-9
    assert (passed.tangents, passed.touching) == (2, True)


@pytest.mark.parametrize("turned_by", [0.3, 0.8, 2.0])
def test_what_meets_does_not_depend_on_the_base_of_the_plane(monkeypatch, turned_by):
    """The quadratic form whose zeros are the tangents, in a plane whose base is arbitrary."""
    from scipy.linalg import null_space

    def rotated(matrix, **more):
        found, c, s = null_space(matrix, **more), np.cos(turned_by), np.sin(turned_by)
        return found @ np.array([[c, -s], [s, c]]) if found.shape[1] == 2 else found

    monkeypatch.setattr("drivewright.multibody.passages.null_space", rotated)
    for model, touches in ((touching(1.0, 0.5), True), (parallelogram(), False), (CROSSING["kite"], False)):
        run = mb.simulate(mb.assemble(model), 0.9)
        assert {(passed.tangents, passed.touching) for passed in run.passages} == {(2, touches)}


def test_touching_branches_of_a_free_mechanism_keep_its_energy():
    run, seen = sampled(touching(2.0, 0.5, driven=False), np.linspace(0.0, 0.7, 71))
    assert len(run.passages) == 1 and run.passages[0].touching
    assert np.ptp(seen.energy) < 1e-8 * seen.energy[0]
    assert seen.point("rocker", "angle") == pytest.approx(0.5 * seen.point("cam", "angle") ** 2, rel=0, abs=1e-8)


@pytest.mark.parametrize("name", CROSSING)
def test_branches_that_cross_do_not_touch(name):
    run, _ = turned(CROSSING[name], 1)
    assert run.passages and {(passed.tangents, passed.touching) for passed in run.passages} == {(2, False)}


@pytest.mark.parametrize("rate", [0.5, 0.9, 1.001, 0.0, -4.9, -5.01])
def test_a_start_in_a_fold_with_the_rates_of_neither_branch_is_refused(rate):
    """Those of the parallelogram are 1, of the anti-parallelogram -5 times the crank's."""
    with pytest.raises(DoesNotAssemble, match="fit none of its branches"):
        mb.assemble(folded(rocker=rate * TURN))


# -- when, and how many ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("model", [parallelogram(), replace(windows(1, tip_speed=6.0), gravity=(0.0, 0.0))], ids=["driven", "free"])
def test_samples_are_answered_one_for_one_wherever_charts_begin_and_end(model):
    assembly = mb.assemble(model)
    run = mb.simulate(assembly, 0.8)
    ends, folds = [part.t_end for part in run.stretches], [passed.time for passed in run.passages]
    assert len(ends) > 2 and folds
    times = np.unique([0.0, 0.1, *ends, *folds, *np.nextafter(ends, 0.0), *np.linspace(0.0, 0.8, 7)])
    run, seen = sampled(model, times)
    assert np.array_equal(seen.t, times) and len(run.passages) == len(folds)
    first, second = (seen.point(body.name, "angle") for body in model.bodies if body.name in ("crank", "rocker", "upright0", "upright1"))
    assert first == pytest.approx(second, rel=0, abs=1e-8)


def test_a_sample_at_the_very_end_of_a_chart_is_answered():
    """A later sample changes no step before it, so that the chart ends at the same time again."""
    times = np.array([0.0, 0.1, 0.8])
    run, _ = sampled(parallelogram(), times)
    leave = next(part.t_end for part in run.stretches if len(part.system.chart.offsets))
    run, seen = sampled(parallelogram(), np.insert(times, 2, leave))
    assert leave in [part.t_end for part in run.stretches]
    assert np.array_equal(seen.t, np.insert(times, 2, leave))


@pytest.mark.parametrize("samples", [2, 3, 4, 6])
@pytest.mark.parametrize(("name", "folds"), [("parallelogram", 4), ("kite", 2), ("slider", 4)])
def test_the_branch_does_not_depend_on_how_few_samples_are_asked_for(name, folds, samples):
    model = CROSSING[name]
    run, seen = turned(model, 2, samples)
    _, fine = turned(model, 2, 1 + 60 * (samples - 1))
    assert len(run.passages) == folds and len(seen.t) == samples
    for body in model.bodies:
        assert seen.point(body.name, "angle") == pytest.approx(fine.point(body.name, "angle")[::60], rel=0, abs=1e-7)


@pytest.mark.parametrize(("beyond", "passed"), [(-1e-3, 0), (1e-3, 1)])
def test_a_fold_counts_once_it_is_passed_and_a_run_may_end_in_its_chart(beyond, passed):
    for model, fold in ((parallelogram(), 1 / 3), (folded(rocker=TURN), 0.5), (replace(windows(1), gravity=(0.0, 0.0)), np.pi / 2)):
        for settings in (mb.Settings(), mb.Settings(rtol=1e-11)):
            run = mb.simulate(mb.assemble(model), fold + beyond, settings)
            assert run.end[1] == fold + beyond and run.outcome == "complete"
            assert [each.time for each in run.passages] == pytest.approx([fold] * passed, abs=1e-6)
            assert len(run.stretches[-1].system.chart.offsets)
            x = chart_offsets(run.end[0], [run.end[1]], run.end[2][None])[0] * run.end[0].chart.pace
            assert x == pytest.approx(beyond, rel=1e-3)


def test_a_run_that_stops_says_when_the_fold_would_come():
    run = mb.simulate(mb.assemble(parallelogram()), 1.0, mb.Settings(singular="stop"))
    assert "at t = 0.333333 s" in run.advice and 0.2 < run.end[1] < 1 / 3
    run = mb.simulate(mb.assemble(replace(windows(1), gravity=(0.0, 0.0))), 3.0, mb.Settings(singular="stop"))
    assert "at t = 1.5708 s" in run.advice and 1.4 < run.end[1] < np.pi / 2


@pytest.mark.parametrize(("rtol", "method"), [(1e-3, "dopri5"), (1e-3, "radau"), (1e-8, "dopri5")])
@pytest.mark.parametrize("angle", [np.pi - 0.3, 0.05, 0.3, 1.07])
def test_no_fold_is_missed_on_the_way_from_rest(angle, rtol, method):
    """N windows are a pendulum, theta'' = -g W cos(theta)/M: it turns between two folds, now slow, now near to one."""
    weight, mass = 3.5, 3.0
    sol = solve_ivp(
        lambda t, y: [y[1], -G * weight / mass * np.cos(y[0])],
        (0.0, 3.0),
        [angle, 0.0],
        method="DOP853",
        rtol=1e-12,
        atol=1e-12,
        dense_output=True,
    ).sol
    t = np.linspace(0.0, 3.0, 100001)
    wanted = t[1:][np.diff(np.floor(sol(t)[0] / np.pi)) != 0]
    run = mb.simulate(mb.assemble(windows(2, tip_speed=0.0, angle=angle)), 3.0, mb.Settings(rtol=rtol, method=method))
    assert [passed.time for passed in run.passages] == pytest.approx(wanted, abs=2e-3 if rtol > 1e-6 else 1e-4)


def test_a_free_mechanism_folds_alike_in_metres_and_micrometres():
    """Lengths and gravity in other units: the same angles at the same times."""

    def in_units(size):
        def marker(m):
            return mb.Marker(m.body, size * m.x, size * m.y)

        base = windows(2)
        joints = tuple(replace(joint, first=marker(joint.first), second=marker(joint.second)) for joint in base.joints)
        bodies = tuple(replace(b, inertia=b.inertia * size**2, centroid=(size * b.centroid[0], 0.0)) for b in base.bodies)
        return replace(base, gravity=(0.0, -G * size), joints=joints, bodies=bodies)

    found = [mb.simulate(mb.assemble(in_units(size)), 4.0, mb.Settings(rtol=1e-10)) for size in (1.0, 1e-6, 1e6)]
    for run in found:
        assert [passed.time for passed in run.passages] == pytest.approx([passed.time for passed in found[0].passages], abs=1e-6)
        assert run.steps == pytest.approx(found[0].steps, rel=0.2)
    assert len(found[0].passages) >= 2


@pytest.mark.parametrize("excess", [1e-3, 1e-5])
def test_a_sharp_bend_is_told_finely_whatever_the_grid(excess):
    """The rocker turns back within a thousandth of a turn; over the rows told, its rates are the slope of its angle, on both sides."""
    run, seen = turned(four_bar(FRAME, CRANK, FRAME, CRANK * (1 + excess)), 1)
    assert not run.passages and run.outcome == "complete"
    angle, w = seen.point("rocker", "angle"), seen.point("rocker", "w")
    assert np.max(np.abs(np.diff(angle) - np.diff(seen.t) * (w[1:] + w[:-1]) / 2)) < 1e-3


# -- states that are told ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["dry", "bristles"])
@pytest.mark.parametrize("model", [parallelogram(), folded(rocker=TURN)], ids=["before", "in the fold"])
def test_a_driven_mechanism_takes_what_its_pins_remember_through_the_folds(model, name):
    """A second pin, with play, beside that of coupler and rocker: its journal stays in the middle."""
    second = mb.Revolute("B2", mb.Marker("coupler", FRAME), mb.Marker("rocker", CRANK), PINS[name])
    assembly = mb.assemble(replace(model, joints=(*model.joints, second)))
    run = mb.simulate(assembly, 1.2)
    assert len(assembly.state) == 3 + (name == "bristles") and len(run.passages) >= 2
    for state in (*(part.y for part in run.stretches), *(part.y_end for part in run.stretches), *(each.state for each in run.passages)):
        assert state.shape[-1] == len(assembly.state) and np.all(state[..., len(assembly.system.stored) :] == 0.0)
    seen = mb.record(run, {"rocker": mb.Marker("rocker")})
    assert seen.point("rocker", "w") == pytest.approx(np.full(len(seen.t), TURN), rel=1e-8)
    assert seen.pins[:, 0, 0] == pytest.approx(np.full(len(seen.t), -DRY.clearance), abs=1e-12) and not np.any(seen.pins[:, 0, 1])


@pytest.mark.parametrize("model", [parallelogram(), parallelogram(-TURN), hung(mb.Ideal(), TURN)], ids=["forth", "back", "hung"])
def test_clear_states_leave_out_the_middle_of_folds_and_nothing_else(model):
    run = mb.simulate(mb.assemble(model), 1.2, mb.Settings(rtol=1e-9))
    folds, wanted, left_out = np.array([passed.time for passed in run.passages]), [], 0
    for part in run.stretches:
        away, chart = np.min(np.abs(part.t[:, None] - folds), axis=1), part.system.chart
        clear = away > 0.2 * chart.reach * chart.pace if len(chart.offsets) else np.full(len(part.t), True)
        wanted.append(part.t[clear])
        left_out += len(part.t) - len(wanted[-1])
    told = np.concatenate([t for _, t, _ in states_outside_folds(run)])
    assert np.array_equal(told, np.concatenate(wanted)) and left_out >= len(folds)
    assert np.array_equal(np.concatenate([t for _, t, _ in states_outside_folds(run, start=0.4)]), told[told >= 0.4])
    for most in (1, 3, 7, 100, len(told) - 1, len(told)):
        thinned = np.concatenate([t for _, t, _ in states_outside_folds(run, most=most)])
        assert most / 2 <= len(thinned) <= most
        assert np.array_equal(thinned, told[:: -(-len(told) // most)])
    for system, t, y in states_outside_folds(run, most=20):  # each with its own states
        angle = mb.observe(system, t, y).bodies[:, run.assembly.names.index("rocker"), 2]
        assert angle == pytest.approx(np.pi / 3 + model.drives[0].motion.coefficients[0][1] * t, rel=0, abs=1e-8)


# -- forces in the fold --------------------------------------------------------------------------------------------------------------


def unbounded(model):
    """For each fold in a turn, the joints that cannot carry their load there."""
    run, _ = turned(model, 1)
    return [unbounded_joints(run.assembly, each.system, mb.observe(each.system, [each.time], each.state[None])) for each in run.passages]


ALL = ("O2", "A", "B", "O4")
# About O4, with the bars along x: the rocker's weight at half its length and half of the coupler's at its end.
HELD = 2.0 * G * CRANK / 2 + 0.5 * G * CRANK


@pytest.mark.parametrize("size", [1.0, 1e-5, 1e5])
@pytest.mark.parametrize(
    ("part", "wanted"), [(0.0, [ALL, ALL]), (1.0, [(), ALL]), (-1.0, [ALL, ()]), (1.001, [ALL, ALL]), (0.999, [ALL, ALL])]
)
def test_bars_in_line_carry_what_turns_the_rocker_only_where_it_is_balanced(part, wanted, size):
    """A torque on the rocker that holds its weight where the bars point to the left, or, reversed, to the right."""
    hold = mb.AppliedTorque("hold", "rocker", mb.LoadCurve(mb.line(-part * HELD * size**2, 0.0)))
    assert unbounded(replace(parallelogram(size=size), forces=(hold,), gravity=(0.0, -G * size))) == wanted


def test_a_load_along_the_bars_is_carried_in_the_fold():
    assert unbounded(replace(parallelogram(), gravity=(-G, 0.0))) == [(), ()]


def test_a_joint_beside_the_loop_stays_bounded_in_its_fold():
    run, _ = sampled(hung(mb.Ideal(), TURN), np.linspace(0.0, 1.0, 3))
    for passed in run.passages:
        assert unbounded_joints(run.assembly, passed.system, mb.observe(passed.system, [passed.time], passed.state[None])) == ALL
