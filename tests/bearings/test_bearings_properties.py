"""What must hold of every ball bearing: balance, derivatives, symmetry, scaling, and that every load finds its equilibrium."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from drivewright._jit import plain
from drivewright.bearings import BallBearing, equilibria, equilibrium, evaluate_response, law_of, solve
from drivewright.bearings.newton import MAX_STEPS, centre_ring
from drivewright.units import SI

pytestmark = pytest.mark.property

FREE = np.zeros(5, dtype=bool)
DEEP = BallBearing(balls=9, ball_diameter="8 mm", pitch_diameter="40 mm", radial_clearance="12 um", dynamic_rating="15 kN")
STEEP = BallBearing(
    balls=13,
    ball_diameter="7 mm",
    pitch_diameter="42 mm",
    inner_conformity=0.515,
    outer_conformity=0.525,
    contact_angle="30 deg",
    first_element="11 deg",
    tilt_radius="19 mm",
)
TIGHT = BallBearing(balls=8, ball_diameter="8 mm", pitch_diameter="36 mm", radial_clearance="-9 um", first_element="-20 deg")
BEARINGS = pytest.mark.parametrize("bearing", [DEEP, STEEP, TIGHT], ids=["deep", "steep", "tight"])
LOADS = pytest.mark.parametrize(
    "force",
    [
        (700, 0, 0, 0, 0),
        (0, 0, 900, 0, 0),
        (0, 0, 0, 6, 0),
        (300, -200, 400, 2, -3),
        (-50, 20, -80, 0.1, 0.4),
        (1e-3, 0, 0, 0, 2e-6),
        (5e5, 0, 2e5, 0, 0),
        (0, 0, 0, 0, 0),
    ],
)


def random_bearing(rng):
    """Geometry over four decades of size, from far apart to nearly touching balls, loose and tight, flat and steep."""
    balls, pitch, angle = int(rng.integers(3, 30)), 10 ** rng.uniform(-2.5, 0), rng.choice([0, rng.uniform(0, 1.4)])
    ball, (inner, outer) = pitch * np.sin(np.pi / balls) * rng.uniform(0.3, 0.99), rng.uniform(0.505, 0.56, 2)
    play = rng.choice([0, rng.uniform(0, 0.9), rng.uniform(-0.03, 0)]) * 2 * (inner + outer - 1) * ball * np.cos(angle)
    return BallBearing(
        balls=balls,
        ball_diameter=SI(ball),
        pitch_diameter=SI(pitch),
        inner_conformity=inner,
        outer_conformity=outer,
        radial_clearance=SI(play),
        contact_angle=SI(angle),
        first_element=SI(rng.uniform(-3, 3)),
    )


def random_loads(rng, law, count):
    """Some of the five, from a thousandth of a newton on a bearing of usual size to what would crush it."""
    size = 10 ** rng.uniform(-3, 4, (count, 5)) * rng.choice([1.0, 1e-3], (count, 1))
    return rng.choice([-1.0, 0, 1], (count, 5)) * size * law.groove**2 * 1e9 * [1, 1, 1, law.arm, law.arm]


def test_every_load_finds_its_equilibrium():
    rng, most = np.random.default_rng(4), 0
    for _ in range(40):
        law = law_of(random_bearing(rng))
        forces = random_loads(rng, law, 50)
        places, steps = equilibria(law, forces, FREE)
        assert np.all(steps >= 0)
        most = max(most, steps.max())
        preload = 1e-14 * len(law.cosines) * law.constant * (law.squeeze / law.groove) ** 1.5  # what rounding makes of it
        for force, place in zip(forces, places, strict=True):
            weights = [1, 1, 1, 1 / law.arm, 1 / law.arm]
            miss = np.linalg.norm((evaluate_response(law, place)[1] - force) * weights)
            assert miss <= 1e-8 * np.linalg.norm(force * weights) + preload
    assert most > MAX_STEPS  # some loads were slight enough to be approached from above


@BEARINGS
@LOADS
def test_there_and_back(bearing, force):
    found = solve(bearing, force=force)
    scale = max(np.abs(force).max(), 1e-5 * found.element_loads.sum())
    assert_allclose(found.force, force, atol=1e-10 * scale)
    again = solve(bearing, displacement=found.displacement)
    assert np.array_equal(again.force, found.force) and np.array_equal(again.element_loads, found.element_loads)
    assert again.steps == 0


@BEARINGS
@LOADS
def test_balls_balance_the_load(bearing, force):
    state = solve(bearing, force=force)
    p = bearing.first_element + 2 * np.pi * np.arange(bearing.balls) / bearing.balls
    arm = bearing.tilt_radius or bearing.pitch_diameter / 2
    out, along = state.element_loads * np.cos(state.contact_angles), state.element_loads * np.sin(state.contact_angles)
    total = [out @ np.cos(p), out @ np.sin(p), along.sum(), arm * along @ np.sin(p), -arm * along @ np.cos(p)]
    assert_allclose(total, force, atol=1e-9 * max(state.element_loads.sum(), 1e-9))


@pytest.mark.parametrize("seed", [1, 2, 3, 5, 8])
def test_stiffness_is_the_slope_of_the_force_and_symmetric(seed):
    rng = np.random.default_rng(seed)
    law = law_of(random_bearing(rng))
    place = (rng.normal(size=5) * 0.08 + [0, 0, 0.06, 0, 0]) * law.groove / np.array([1, 1, 1, law.arm, law.arm])
    energy, force, stiffness = evaluate_response(law, place)
    sizes = law.groove / np.array([1, 1, 1, law.arm, law.arm])
    assert energy > 0
    for i in range(5):
        step = np.eye(5)[i] * sizes * 1e-6
        above, below = evaluate_response(law, place + step), evaluate_response(law, place - step)
        assert_allclose((above[0] - below[0]) / (2 * step[i]), force[i], rtol=1e-6, atol=1e-6 * energy / sizes[i])
        slope = (above[1] - below[1]) / (2 * step[i])
        assert_allclose(slope * sizes, stiffness[i] * sizes, atol=1e-5 * np.abs(stiffness[i] * sizes).max())
    assert np.array_equal(stiffness, stiffness.T)
    scaled = stiffness * sizes[:, None] * sizes
    assert np.linalg.eigvalsh(scaled).min() >= -1e-12 * scaled.max()  # the energy is convex


def turned(vector, angle):
    """The five of a load or displacement, turned about z."""
    c, s = np.cos(angle), np.sin(angle)
    pair = np.array([[c, -s], [s, c]])
    return np.concatenate([pair @ vector[:2], vector[2:3], pair @ vector[3:]])


@BEARINGS
def test_a_turn_by_one_ball_moves_the_loads_by_one_place(bearing):
    force, pitch = np.array([300, -200, 400, 2, -3.0]), 2 * np.pi / bearing.balls
    here, there = solve(bearing, force=force), solve(bearing, force=turned(force, pitch))
    assert_allclose(there.element_loads, np.roll(here.element_loads, 1), rtol=1e-8, atol=1e-8)
    assert_allclose(there.displacement, turned(here.displacement, pitch), rtol=1e-8, atol=1e-14)
    assert_allclose(there.contact_angles, np.roll(here.contact_angles, 1), rtol=1e-8)


def test_a_turn_of_bearing_and_load_together():
    force, angle = np.array([300, -200, 400, 2, -3.0]), 0.3
    here = solve(STEEP, force=force)
    there = solve(STEEP.replace(first_element=SI(STEEP.first_element + angle)), force=turned(force, angle))
    assert_allclose(there.element_loads, here.element_loads, rtol=1e-9)
    assert_allclose(there.displacement, turned(here.displacement, angle), rtol=1e-9, atol=1e-15)


def test_first_element_counts_from_x_towards_y():
    """With the first ball on +y a load along y finds it, the fullest."""
    state = solve(DEEP.replace(first_element="90 deg"), force=[0, 500, 0, 0, 0])
    assert np.argmax(state.element_loads) == 0
    assert_allclose(state.element_loads[1:], state.element_loads[:0:-1], rtol=1e-9)


@pytest.mark.parametrize("bearing", [DEEP, STEEP.replace(first_element="0 deg")], ids=["deep", "steep"])
def test_mirror_images(bearing):
    force, mirror = np.array([300, -200, 400, 2, -3.0]), np.array([1, -1, 1, -1, 1])  # y to -y
    here, there = solve(bearing, force=force), solve(bearing, force=mirror * force)
    assert_allclose(there.displacement, mirror * here.displacement, rtol=1e-9, atol=1e-15)
    assert_allclose(there.element_loads, np.roll(here.element_loads[::-1], 1), rtol=1e-8, atol=1e-9)
    other = np.array([1, 1, -1, -1, -1])  # z to -z, about the middle between the shoulders
    there, middle = solve(bearing, force=other * force), np.array([0, 0, -2 * law_of(bearing).axial, 0, 0])
    assert_allclose(there.displacement, other * here.displacement + middle, rtol=1e-8, atol=1e-13)


def test_a_moment_acts_by_the_right_hand():
    """About +x it presses the balls on +y towards +z; about +y those on -x."""
    assert solve(STEEP, displacement=[0, 0, 0, 1e-3, 0]).element_loads @ np.sin(STEEP.first_element + np.arange(13) * 2 * np.pi / 13) > 0
    assert solve(STEEP, displacement=[0, 0, 0, 0, 1e-3]).element_loads @ np.cos(STEEP.first_element + np.arange(13) * 2 * np.pi / 13) < 0


@BEARINGS
def test_a_larger_bearing_under_as_many_times_the_area(bearing):
    """All lengths times s, loads times s^2, moments times s^3: the same pressures and angles, displacements times s."""
    s, force = 3.7, np.array([300, -200, 400, 2, -3.0])
    lengths = {
        name: SI(s * value)
        for name in ("ball_diameter", "pitch_diameter", "radial_clearance", "tilt_radius")
        if (value := getattr(bearing, name)) is not None
    }
    large = solve(bearing.replace(**lengths), force=force * [s**2, s**2, s**2, s**3, s**3])
    small = solve(bearing, force=force)
    assert_allclose(large.pressures, small.pressures, rtol=1e-8, atol=1e3)
    assert_allclose(large.contact_angles, small.contact_angles, rtol=1e-8)
    assert_allclose(large.displacement, small.displacement * [s, s, s, 1, 1], rtol=1e-8, atol=1e-14)


def test_a_softer_material_under_as_much_less_load():
    """E and the loads divided by ten: the same displacements."""
    force = np.array([300, -200, 400, 2, -3.0])
    assert_allclose(
        solve(STEEP.replace(youngs_modulus="21 GPa"), force=force / 10).displacement,
        solve(STEEP, force=force).displacement,
        rtol=1e-9,
        atol=1e-16,
    )


@BEARINGS
def test_the_equilibrium_does_not_depend_on_the_start(bearing):
    force, rng = [300, -200, 400, 2, -3.0], np.random.default_rng(7)
    wanted = solve(bearing, force=force).displacement
    for _ in range(5):
        start = rng.normal(size=5) * [1e-3, 1e-3, 1e-3, 0.05, 0.05]
        assert_allclose(solve(bearing, force=force, start=start).displacement, wanted, rtol=1e-8, atol=1e-13)


@BEARINGS
def test_held_freedoms_find_their_reaction(bearing):
    state = solve(bearing, force=[0, 250, 300, 0, 0], held=("x", "tilt_x", "tilt_y"))
    assert not state.displacement[[0, 3, 4]].any()
    assert_allclose(state.force[[1, 2]], [250, 300], rtol=1e-9)
    assert np.abs(state.force[3]) > 1e-3
    free = solve(bearing, force=state.force)
    assert_allclose(free.displacement, state.displacement, rtol=1e-7, atol=1e-12)


def test_no_load_moves_nothing():
    for bearing in (DEEP, STEEP, TIGHT):
        assert_allclose(solve(bearing, force=np.zeros(5)).displacement, 0, atol=1e-16)


def test_many_loads_at_once_are_the_loads_one_by_one():
    law, forces = law_of(DEEP), random_loads(np.random.default_rng(2), law_of(DEEP), 20)
    places, steps = equilibria(law, forces, FREE)
    for force, place, count in zip(forces, places, steps, strict=True):
        state = solve(DEEP, force=force)
        assert np.array_equal(state.displacement, place) and state.steps == count


def test_uncompiled_is_compiled():
    law, force = law_of(STEEP), np.array([300, -200, 400, 2, -3.0])
    compiled, steps = equilibrium(law, force, FREE, np.zeros(5))
    uncompiled, count = plain(equilibrium)(law, force, FREE, np.zeros(5))
    assert count == steps
    assert_allclose(uncompiled, compiled, rtol=1e-12)
    for each in (centre_ring, plain(centre_ring)):
        start = np.zeros(5)
        each(law_of(DEEP), np.array([1.0, 0, 0, 0, 0]), FREE, start)
        assert start[2] == -law_of(DEEP).axial


def test_results_and_bearings_are_frozen_and_equal_bearings_share_their_law():
    state = solve(DEEP, force=[100, 0, 0, 0, 0])
    with pytest.raises(AttributeError):
        state.force = None
    assert law_of(DEEP.replace()) is law_of(DEEP)
