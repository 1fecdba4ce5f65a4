"""Singular positions: free and driven mechanisms go through folds along the smooth branch, whatever the sampling, direction and scale."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import drivewright.multibody as mb
from drivewright.errors import DoesNotAssemble
from drivewright.multibody.chart import chart_offsets
from drivewright.multibody.simulate import convert_state
from drivewright.multibody.singular import look_ahead
from drivewright.multibody.system import no_chart

pytestmark = pytest.mark.property

TURN = 2 * np.pi
G = 9.81


def windows(count, tip_speed=1.0, angle=np.pi / 2):
    """N windows: N + 1 uprights and N couplers of 1 m and 1 kg, the tops moving at `tip_speed` to the right."""
    bodies, joints = [], []
    for k in range(count + 1):
        bodies.append(mb.Body(f"upright{k}", 1.0, 1 / 12, (0.5, 0.0), angle, angular_velocity=-tip_speed))
        joints.append(mb.Revolute(f"foot{k}", mb.Marker(f"upright{k}"), mb.Marker("ground", float(k))))
    for k in range(count):
        bodies.append(mb.Body(f"coupler{k}", 1.0, 1 / 12, (0.5, 0.0), 0.0))
        joints.append(mb.Revolute(f"left{k}", mb.Marker(f"coupler{k}"), mb.Marker(f"upright{k}", 1.0)))
        joints.append(mb.Revolute(f"right{k}", mb.Marker(f"coupler{k}", 1.0), mb.Marker(f"upright{k + 1}", 1.0)))
    return mb.MultibodyModel(tuple(bodies), tuple(joints), gravity=(0.0, -G))


def pendulum(count, duration):
    """Angle from upright of the same as one pendulum: theta'' = g W sin(theta) / M."""
    mass, weight = (count + 1) / 3 + count, (count + 1) / 2 + count
    found = solve_ivp(
        lambda t, y: [y[1], G * weight * np.sin(y[0]) / mass],
        (0, duration),
        [0.0, 1.0],
        rtol=1e-12,
        atol=1e-12,
        method="DOP853",
        dense_output=True,
    )
    return found.sol


def four_bar(frame, crank, coupler, rocker, speed=TURN, start=60.0, size=1.0):
    """A driven four-bar in the assembly whose rocker points most nearly along the crank."""
    frame, crank, coupler, rocker = (size * length for length in (frame, crank, coupler, rocker))
    theta = np.radians(start)
    d = crank * np.exp(1j * theta) - frame
    across = np.arccos((rocker**2 + abs(d) ** 2 - coupler**2) / (2 * rocker * abs(d)))
    e = max((d / abs(d) * np.exp(sign * 1j * across) for sign in (1, -1)), key=lambda e: (e * np.exp(-1j * theta)).real)
    bar = np.angle(frame + rocker * e - crank * np.exp(1j * theta))
    inertia = 1e-3 * size**2
    bodies = (
        mb.Body("crank", 1.0, inertia, (crank / 2, 0.0), theta),
        mb.Body("coupler", 1.0, inertia, (coupler / 2, 0.0), bar),
        mb.Body("rocker", 2.0, inertia, (rocker / 2, 0.0), np.angle(e)),
    )
    joints = (
        mb.Revolute("O2", mb.Marker("crank"), mb.Marker("ground")),
        mb.Revolute("A", mb.Marker("coupler"), mb.Marker("crank", crank)),
        mb.Revolute("B", mb.Marker("coupler", coupler), mb.Marker("rocker", rocker)),
        mb.Revolute("O4", mb.Marker("rocker"), mb.Marker("ground", frame)),
    )
    return mb.MultibodyModel(bodies, joints, drives=(mb.JointDrive("O2", mb.line(0.0, speed)),), gravity=(0.0, -G))


def slider_crank(length=0.1, speed=TURN, start=30.0):
    """Crank and rod of the same length: the slider passes the crank's axis."""
    theta = np.radians(start)
    bodies = (
        mb.Body("crank", 1.0, 1e-3, (length / 2, 0.0), theta),
        mb.Body("rod", 1.0, 1e-3, (length / 2, 0.0), -theta),
        mb.Body("slider", 1.0, 1e-3),
    )
    joints = (
        mb.Revolute("O", mb.Marker("crank"), mb.Marker("ground")),
        mb.Revolute("A", mb.Marker("rod"), mb.Marker("crank", length)),
        mb.Revolute("B", mb.Marker("rod", length), mb.Marker("slider")),
        mb.Prismatic("guide", mb.Marker("slider"), mb.Marker("ground")),
    )
    return mb.MultibodyModel(bodies, joints, drives=(mb.JointDrive("O", mb.line(0.0, speed)),), gravity=(0.0, -G))


def turned(model, turns, samples=None):
    """(run, record) over turns of its drive."""
    duration = turns * TURN / abs(model.drives[0].motion.coefficients[0][1])
    run = mb.simulate(mb.assemble(model), duration, samples=None if samples is None else np.linspace(0.0, duration, samples))
    return run, mb.record(run, {body.name: mb.Marker(body.name) for body in model.bodies})


# -- free motion ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", ["dopri5", "radau"])
@pytest.mark.parametrize("count", [1, 2, 5])
@pytest.mark.parametrize(("rtol", "allowed"), [(1e-8, 1e-2), (1e-10, 1e-3)])
def test_windows_swing_through_their_folds_as_one_pendulum(count, method, rtol, allowed):
    run = mb.simulate(mb.assemble(windows(count)), 10.0, mb.Settings(rtol=rtol, method=method, per_step=2))
    seen = mb.record(run, {f"upright{k}": mb.Marker(f"upright{k}") for k in range(count + 1)})
    theta = np.array([np.pi / 2 - seen.point(f"upright{k}", "angle") for k in range(count + 1)])
    exact = pendulum(count, 10.0)
    assert run.outcome == "complete" and run.end[1] == 10.0
    assert np.max(np.abs(theta - exact(seen.t)[0])) < allowed
    assert np.ptp(seen.energy) < 1e-3
    whole_turns = exact(np.linspace(0, 10, 100001))[0]
    folds = np.count_nonzero(np.diff(np.floor((whole_turns - np.pi / 2) / np.pi)))
    assert len(run.passages) == folds and {p.tangents for p in run.passages} == {2**count}
    assert np.max(np.abs(np.cos(exact([p.time for p in run.passages])[0]))) < allowed
    assert mb.audit(seen).error < 1e-5 and np.all(np.diff(seen.t) > 0)


@pytest.mark.slow
@pytest.mark.parametrize("count", [10, 40])
@pytest.mark.parametrize("method", ["dopri5", "radau"])
def test_many_windows_swing_through_their_folds(count, method):
    test_windows_swing_through_their_folds_as_one_pendulum(count, method, 1e-10, 1e-3)


def test_a_free_mechanism_that_turns_back_before_the_fold_passes_none():
    run = mb.simulate(mb.assemble(windows(2, tip_speed=0.0, angle=-0.05)), 1.5, mb.Settings(rtol=1e-10))
    angle = mb.record(run, {"upright0": mb.Marker("upright0")}).point("upright0", "angle")
    assert run.outcome == "complete" and not run.passages
    assert np.max(angle) < -0.05 + 1e-6 and np.min(angle) < -3.0  # from beside one fold to beside the other


@pytest.mark.parametrize("name", ["rhombus", "kite", "slider"])
def test_driven_mechanisms_left_free_go_through_as_driven_ones(name):
    """Without gravity a mechanism that is let go keeps its energy, and on the way it stands where the driven one stands."""
    model = {"rhombus": four_bar(0.1, 0.1, 0.1, 0.1), "kite": four_bar(0.1, 0.1, 0.15, 0.15), "slider": slider_crank()}[name]
    start = mb.assemble(model)
    rates = {body.name: w for body, w in zip(model.bodies, _rates(start), strict=True)}
    free = replace(
        model,
        drives=(),
        gravity=(0.0, 0.0),
        bodies=tuple(replace(body, angular_velocity=rates[body.name]) if body.name != "slider" else body for body in model.bodies),
    )
    run = mb.simulate(mb.assemble(free), 2.0, mb.Settings(rtol=1e-10))
    seen = mb.record(run, {body.name: mb.Marker(body.name) for body in model.bodies})
    assert len(run.passages) >= 2 and np.ptp(seen.energy) < 1e-8 * seen.energy[0]
    angle = seen.point("crank", "angle")
    assert np.max(np.abs(np.diff(angle))) < 0.5 and abs(angle[-1] - angle[0]) > TURN
    for other, kept in _relations(name, seen).items():
        assert np.max(np.abs(kept)) < 1e-7, other


def _rates(assembly):
    observed = mb.observe(assembly.system, [0.0], assembly.state[None])
    return [observed.bodies[0, assembly.names.index(body.name), 5] for body in assembly.model.bodies]


def _relations(name, seen):
    """What holds on the smooth branch by geometry alone."""
    crank = seen.point("crank", "angle")
    if name == "rhombus":
        return {
            "rocker along the crank": np.sin((seen.point("rocker", "angle") - crank) / 2),
            "coupler level": np.sin(seen.point("coupler", "angle")),
        }
    if name == "slider":
        return {
            "rod against the crank": np.sin(seen.point("rod", "angle") + crank),
            "slider": seen.point("slider", "x") - 0.2 * np.cos(crank),
        }
    return {"kite symmetric about its diagonal": np.sin(seen.point("coupler", "angle") + seen.point("rocker", "angle") - crank)}


# -- driven motion -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("samples", [None, 61, 97, 720, 721])
@pytest.mark.parametrize("speed", [TURN, -TURN])
@pytest.mark.parametrize("size", [1.0, 1e-6, 1e6])
def test_a_parallelogram_stays_one(samples, speed, size):
    run, seen = turned(four_bar(0.15, 0.1, 0.15, 0.1, speed, size=size), 2, samples)
    assert run.outcome == "complete" and len(run.passages) == 4
    angle = np.radians(60) + speed * seen.t
    assert np.max(np.abs(seen.point("rocker", "angle") - angle)) < 1e-8
    assert np.max(np.abs(seen.point("coupler", "angle"))) < 1e-8
    assert np.max(np.abs(seen.point("rocker", "w") - speed)) < 1e-8 * TURN
    assert np.max(np.abs(seen.point("rocker", "alpha"))) < 1e-5 * TURN**2
    # Gravity on crank, coupler and rocker alone works against the drive: both cranks and the coupler rise together.
    arm = size * 0.1 * np.cos(angle)
    assert np.max(np.abs(seen.drives[:, 0] - G * (0.5 + 1.0 + 1.0) * arm)) < 1e-5 * G * 0.25 * size + 1e-9 * (0.1 * TURN * size) ** 2
    assert np.max(np.abs(np.sin([angle[0] + speed * p.time for p in run.passages]))) < 1e-6


@pytest.mark.parametrize("samples", [61, 720])
def test_a_rhombus_and_a_kite_follow_their_geometry(samples):
    for speed in (TURN, -TURN):
        _, rhombus = turned(four_bar(0.1, 0.1, 0.1, 0.1, speed), 2, samples)
        assert np.max(np.abs(rhombus.point("rocker", "angle") - np.radians(60) - speed * rhombus.t)) < 1e-8
        run, kite = turned(four_bar(0.1, 0.1, 0.15, 0.15, speed), 2, samples)
        theta = np.radians(60) + speed * kite.t
        # B lies on the diagonal from O2 through the middle of A and O4, which turns half as fast as the crank.
        half = 0.1 * np.cos(theta / 2)
        far = half + np.sign(half[0]) * np.sqrt(0.15**2 - (0.1 * np.sin(theta / 2)) ** 2)
        rocker = np.angle(far * np.exp(1j * theta / 2) - 0.1)
        assert np.max(np.abs(np.sin((kite.point("rocker", "angle") - rocker) / 2))) < 1e-8
        assert len(run.passages) == 2  # it folds where A meets O4


def test_equal_bars_take_the_slider_through_the_crank_s_axis():
    run, seen = turned(slider_crank(), 2)
    theta = np.radians(30) + TURN * seen.t
    assert len(run.passages) == 4
    assert np.max(np.abs(seen.point("slider", "x") - 0.2 * np.cos(theta))) < 1e-9
    assert np.max(np.abs(seen.point("slider", "ax") + 0.2 * TURN**2 * np.cos(theta))) < 1e-6


@pytest.mark.parametrize("excess", [1e-2, 1e-4, 1e-6, 1e-8])
def test_where_branches_only_come_near_the_motion_bends(excess):
    """A rocker a little longer than the crank: the crank turns round, the rocker swings back (Grashof), however little it is."""
    for samples in (61, 720):
        run, seen = turned(four_bar(0.15, 0.1, 0.15, 0.1 * (1 + excess)), 1, samples)
        assert not run.passages
        assert seen.point("rocker", "angle")[-1] == pytest.approx(seen.point("rocker", "angle")[0], abs=1e-5)


@pytest.mark.parametrize("excess", [1e-3, 1e-7, -1e-3, -1e-7])
def test_a_drive_that_cannot_pass_is_told(excess):
    with pytest.raises(DoesNotAssemble, match="cannot go on beyond"):
        turned(four_bar(0.15, 0.1, 0.15 * (1 + excess), 0.1), 1)


def test_a_run_may_stop_in_the_first_fold():
    for model in (four_bar(0.15, 0.1, 0.15, 0.1), windows(2)):
        run = mb.simulate(mb.assemble(model), 2.0, mb.Settings(singular="stop"))
        assert run.outcome == "partial" and "singular position at t = " in run.advice and run.end[1] < 0.8


# -- start in a fold -----------------------------------------------------------------------------------------------------------


def folded(**rates):
    """The parallelogram with all bars in line."""
    model = four_bar(0.15, 0.1, 0.15, 0.1, start=1e-3)
    return replace(model, bodies=tuple(replace(body, angle=0.0, angular_velocity=rates.get(body.name)) for body in model.bodies))


def test_a_start_in_a_fold_takes_the_branch_of_its_rates():
    run, seen = turned(folded(rocker=TURN), 1.25)
    assert np.max(np.abs(seen.point("rocker", "angle") - TURN * seen.t)) < 1e-8 and len(run.passages) == 2
    run = mb.simulate(mb.assemble(windows(1, tip_speed=2.0, angle=0.0)), 1.0, mb.Settings(rtol=1e-10))
    first, second = (mb.record(run, {name: mb.Marker(name)}).point(name, "angle") for name in ("upright0", "upright1"))
    assert np.max(np.abs(first - second)) < 1e-8 and first[-1] < -1.0


def test_a_start_in_a_fold_without_a_branch_says_what_helps():
    with pytest.raises(DoesNotAssemble, match="fit more than one branch. Start a few degrees away"):
        mb.assemble(folded())
    with pytest.raises(DoesNotAssemble, match="fit none of its branches"):
        mb.assemble(folded(rocker=0.5 * TURN))
    with pytest.raises(DoesNotAssemble, match="all start velocities are zero"):
        mb.assemble(replace(windows(1, 0.0, 0.0), gravity=(0.0, 0.0)))


def test_the_other_branch_of_a_fold_can_be_chosen_too():
    """The anti-parallelogram: tan(rocker/2) = -(l + r)/(l - r) tan(crank/2), so it leaves the fold five times as fast as the crank."""
    run, seen = turned(folded(rocker=-5 * TURN), 0.45)
    theta = TURN * seen.t
    rocker = 2 * np.arctan2(-5 * np.sin(theta / 2), np.cos(theta / 2))
    assert np.max(np.abs(seen.point("rocker", "angle") - rocker)) < 1e-8
    assert run.outcome == "complete" and seen.point("rocker", "w")[0] == pytest.approx(-5 * TURN, rel=1e-8)


# -- charts --------------------------------------------------------------------------------------------------------------------


def test_a_chart_equals_the_closed_loops_beside_the_fold():
    """Where both hold, interpolated positions, rates and accelerations are those of the loops themselves."""
    run = mb.simulate(mb.assemble(windows(2)), 0.7, mb.Settings(rtol=1e-11))
    system, t, y = run.end
    charted = system if len(system.chart.offsets) else look_ahead(system, t, y).charted[0]
    y = convert_state(system, t, y, charted)
    loops = mb.observe(charted._replace(chart=no_chart(1, len(charted.dependent))), [t], y[None])
    assert np.max(np.abs(mb.observe(charted, [t], y[None]).bodies - loops.bodies)) < 1e-8
    assert -charted.chart.reach < chart_offsets(charted, [t], y[None])[0] < 0.0
