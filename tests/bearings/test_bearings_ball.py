"""Ball bearings against another program's printed results, a maker's table, closed forms and a second statement of the energy."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from drivewright.bearings import BallBearing, evaluate_response, law_of, solve
from drivewright.contact import effective_modulus, point_contact, relative_radii

pytestmark = pytest.mark.analytical

# Inner geometry and expected values stand in a public repository whose names point to a commercial program (second-hand).
OTHER = BallBearing(
    balls=7,
    ball_diameter="11.5 mm",
    pitch_diameter="43.5 mm",
    inner_conformity=0.52,
    outer_conformity=0.53,
    radial_clearance="0 mm",
    contact_angle="0 deg",
    dynamic_rating="23.4 kN",
    youngs_modulus="210 GPa",
    poisson_ratio=0.3,
)
# A 20x32x7 bearing fitted to its catalogue ratings, and numbers computed for it by an earlier program of ours.
SMALL = BallBearing(balls=12, ball_diameter="3.572 mm", pitch_diameter="26 mm", youngs_modulus="206 GPa")
UPRIGHT = ("tilt_x", "tilt_y")


def radial(force):
    return [force, 0, 0, 0, 0]


def axial(force):
    return [0, 0, force, 0, 0]


# --------------------------------------------------------------------------------------------------------- other programs


@pytest.mark.parametrize(
    ("clearance", "force", "freedom", "displacement"),
    [("0 mm", radial(1000), 0, 15.1101e-6), ("0 mm", axial(1000), 2, 133.538e-6), ("10 um", radial(1000), 0, 21.223e-6)],
)
def test_displacement_of_the_other_program(clearance, force, freedom, displacement):
    bearing = OTHER.replace(radial_clearance=clearance)
    assert_allclose(solve(bearing, force=force).displacement[freedom], displacement, rtol=3e-5)


def test_fullest_ball_among_many_is_437_of_the_mean():
    """NSK E728g gives 4.37."""
    many = BallBearing(balls=400, ball_diameter="0.2 mm", pitch_diameter="43.5 mm")
    assert_allclose(solve(many, force=radial(100)).element_loads.max() * 400 / 100, 4.3701, atol=5e-5)


def test_constant_of_both_races():
    assert_allclose(law_of(SMALL).constant, 182771 * 1e3**1.5, rtol=2e-6)


@pytest.mark.parametrize(
    ("force", "displacement", "secant", "tangent"),
    [
        (50, 2.15, 2.33, 3.49),
        (100, 3.41, 2.93, 4.40),
        (200, 5.41, 3.70, 5.545),
        (500, 9.97, 5.02, 7.53),
        (1000, 15.82, 6.32, 9.48),
        (2000, 25.11, 7.96, 11.95),
    ],
)
def test_small_bearing_under_radial_load(force, displacement, secant, tangent):
    state = solve(SMALL, force=radial(force))
    assert_allclose(state.displacement[0] * 1e6, displacement, atol=0.0051)
    assert_allclose(force / state.displacement[0] / 1e7, secant, atol=0.0051)
    assert_allclose(state.stiffness[0, 0] / 1e7, tangent, atol=0.0051)
    assert_allclose(state.stiffness[1, 1] / state.stiffness[0, 0], 0.555, atol=5e-4)


@pytest.mark.parametrize(("force", "tangent"), [(50, 3.31), (100, 4.17), (200, 5.26), (500, 7.16), (1000, 9.06), (2000, 11.47)])
def test_clearance_with_the_ring_held_against_one_shoulder(force, tangent):
    state = solve(SMALL.replace(radial_clearance="12 um"), force=radial(force), held=("z", *UPRIGHT))
    assert_allclose(state.stiffness[0, 0] / 1e7, tangent, atol=0.0051)


@pytest.mark.parametrize(
    ("thrust", "stiffness"), [(0, (7.5, 4.2, 0.32, 391)), (200, (9.6, 10.6, 1.6, 1289)), (500, (13.5, 13.6, 3.4, 2853))]
)
def test_small_bearing_under_both_loads_held_upright(thrust, stiffness):
    diagonal = np.diag(solve(SMALL, force=[500, 0, thrust, 0, 0], held=UPRIGHT).stiffness)
    digits = np.array([0.051, 0.051, 0.0051 if thrust == 0 else 0.051, 0.51])
    assert np.all(np.abs([*diagonal[:3] / 1e7, diagonal[4]] - np.array(stiffness)) <= digits)


@pytest.mark.parametrize(("angle", "stiffness", "released"), [("15 deg", 1.12e8, 1.064e8), ("25 deg", 7.35e7, 5.054e7)])
def test_angular_contact_held_upright(angle, stiffness, released):
    bearing = SMALL.replace(balls=13, ball_diameter="3.5 mm", contact_angle=angle)
    k = solve(bearing, force=[500, 0, 400, 0, 0], held=UPRIGHT).stiffness
    assert_allclose(k[0, 0], stiffness, rtol=1e-3)
    assert_allclose(k[0, 0] - k[0, 2] ** 2 / k[2, 2], released, rtol=1e-3)


# ----------------------------------------------------------------------------------------------------------- closed forms


def energy(bearing, u):
    """The energy stated once more, from the positions of the groove centres in space, for complex displacements."""
    angle, dist = bearing.contact_angle, bearing.groove_distance
    start = np.arccos(np.cos(angle) - bearing.radial_clearance / (2 * dist))
    tilt, total = np.array([[0, 0, u[4]], [0, 0, -u[3]], [-u[4], u[3], 0]]), 0.0
    arm = bearing.tilt_radius or bearing.pitch_diameter / 2
    for p in bearing.first_element + np.arange(bearing.balls) * 2 * np.pi / bearing.balls:
        out, along = np.array([np.cos(p), np.sin(p), 0.0]), np.array([0.0, 0.0, 1.0])
        inner = dist * (np.cos(start) * out + np.sin(start) * along) + np.array(u[:3]) + tilt @ (arm * out)
        overlap = np.sqrt((inner @ out) ** 2 + (inner @ along) ** 2) - dist
        total = total + (0.4 * law_of(bearing).constant * overlap**2.5 if overlap.real > 0 else 0.0)
    return total


LOOSE = BallBearing(
    balls=9,
    ball_diameter="8 mm",
    pitch_diameter="40 mm",
    inner_conformity=0.515,
    outer_conformity=0.525,
    contact_angle="30 deg",
    radial_clearance="15 um",
    first_element="7 deg",
    tilt_radius="18 mm",
)


@pytest.mark.parametrize("displacement", [(2e-5, -1e-5, 1.5e-5, 4e-4, -9e-4), (-3e-5, 4e-6, 2e-5, -1e-3, 1e-3), (2e-4, 0, -3e-4, 0, 2e-3)])
def test_force_and_energy_of_the_groove_centres_in_space(displacement):
    state, step = solve(LOOSE, displacement=displacement), 1e-30
    slopes = [energy(LOOSE, displacement + 1j * step * axis).imag / step for axis in np.eye(5)]
    assert 0 < np.sum(state.element_loads > 0) < 9
    assert_allclose(state.energy, energy(LOOSE, np.array(displacement) + 0j).real, rtol=1e-9)
    assert_allclose(state.force, slopes, rtol=1e-9, atol=1e-9 * np.abs(slopes).max())


def test_radial_load_without_clearance():
    """F = c d^1.5 sum cos^2.5; the sum for twelve balls is 2.74946."""
    total = np.sum(np.maximum(np.cos(np.arange(12) * np.pi / 6), 0) ** 2.5)
    assert_allclose(total, 2.74946, atol=5e-6)
    state = solve(SMALL, force=radial(300))
    assert_allclose(law_of(SMALL).constant * state.displacement[0] ** 1.5 * total, 300, rtol=1e-11)


def test_axial_load_of_an_angular_contact_bearing():
    """Every ball carries F/(Z sin a) at the angle a at which c (A (cos a0/cos a - 1))^1.5 is this load."""
    bearing = SMALL.replace(contact_angle="25 deg")
    state, law = solve(bearing, force=axial(400)), law_of(bearing)
    angle = state.contact_angles
    assert np.all(angle > np.radians(25))
    assert_allclose(state.element_loads, 400 / (12 * np.sin(angle)), rtol=1e-10)
    assert_allclose(law.constant * (law.groove * (np.cos(np.radians(25)) / np.cos(angle) - 1)) ** 1.5, state.element_loads, rtol=1e-9)
    assert_allclose(state.displacement[2], law.groove * (np.cos(np.radians(25)) * np.tan(angle[0]) - np.sin(np.radians(25))), rtol=1e-9)


def test_tangent_of_one_loaded_ball_is_three_halves_of_the_secant():
    state = solve(OTHER.replace(balls=3), displacement=[1e-5, 0, 0, 0, 0])
    assert np.count_nonzero(state.element_loads) == 1
    assert_allclose(state.force[0] / 1e-5, 2 / 3 * state.stiffness[0, 0], rtol=1e-12)


def test_peak_pressure_is_hertz_of_each_race():
    """Radii in the rolling direction are those of the raceway where the ball touches it: (Dpw -+ Dw cos a)/(2 cos a)."""
    bearing = LOOSE.replace(radial_clearance="0 mm")
    state = solve(bearing, force=[300, 100, 500, 0, 0])
    modulus = effective_modulus(210e9, 0.3, 210e9, 0.3)
    for race, radius, groove in ((0, (0.040 / np.cos(np.pi / 6) - 0.008) / 2, 0.515), (1, -(0.040 / np.cos(np.pi / 6) + 0.008) / 2, 0.525)):
        radii = relative_radii((0.004, 0.004), (radius, -groove * 0.008))
        assert_allclose(state.pressures[:, race], point_contact(state.element_loads, radii, modulus).pressure, rtol=1e-9)


def test_deflection_is_the_approach_at_both_races():
    state = solve(OTHER, force=radial(1000))
    modulus, load = effective_modulus(210e9, 0.3, 210e9, 0.3), state.element_loads[0]
    inner = point_contact(load, relative_radii((0.00575, 0.00575), (0.016, -0.52 * 0.0115)), modulus).approach
    outer = point_contact(load, relative_radii((0.00575, 0.00575), (-0.0275, -0.53 * 0.0115)), modulus).approach
    assert_allclose(state.displacement[0], inner + outer, rtol=1e-10)


def test_clearance_is_passed_before_the_first_ball_carries():
    bearing = OTHER.replace(radial_clearance="10 um")
    rest = law_of(bearing).axial
    assert not solve(bearing, displacement=[4.99e-6, 0, -rest, 0, 0]).element_loads.any()
    assert solve(bearing, displacement=[5.01e-6, 0, -rest, 0, 0]).element_loads[0] > 0
    assert_allclose(solve(bearing, force=radial(1)).displacement[2], -rest, rtol=1e-12)
    assert_allclose(rest**2 + (0.05 * 0.0115 - 5e-6) ** 2, (0.05 * 0.0115) ** 2, rtol=1e-12)


def test_preload_of_a_negative_clearance():
    """Every ball is pressed by half of it, radially; the ring stands in the middle without a force."""
    bearing = OTHER.replace(radial_clearance="-20 um")
    state = solve(bearing, force=np.zeros(5))
    assert_allclose(state.element_loads, law_of(OTHER).constant * 1e-5**1.5, rtol=1e-9)
    assert_allclose(state.displacement, 0, atol=1e-15)
    # k = 1.5 c d^0.5 Z/2 plus the part of the tension across, Q/(A + d) 0: v points radially
    assert_allclose(state.stiffness[0, 0], 1.5 * law_of(OTHER).constant * 1e-5**0.5 * 3.5, rtol=1e-9)
    assert_allclose(state.stiffness[2, 2], np.sum(state.element_loads) / (law_of(OTHER).groove + 1e-5), rtol=1e-9)


def test_contact_angle_of_an_unloaded_ball_is_that_of_its_grooves():
    state = solve(SMALL.replace(contact_angle="25 deg"), displacement=[0, 0, -1e-6, 0, 0])
    assert not state.element_loads.any() and not state.pressures.any()
    law = law_of(SMALL.replace(contact_angle="25 deg"))
    assert_allclose(state.contact_angles, np.arctan2(law.axial - 1e-6, law.radial), rtol=1e-12)


def test_reversed_elements_are_counted():
    bearing = SMALL.replace(contact_angle="25 deg")
    assert solve(bearing, force=axial(50)).reversed_elements == 0
    backwards = solve(bearing, force=axial(-50))
    assert backwards.reversed_elements == 12
    assert_allclose(backwards.displacement[2], -2 * law_of(bearing).axial - solve(bearing, force=axial(50)).displacement[2], rtol=1e-10)


def test_response_is_that_of_solve():
    displacement = [1e-5, 2e-6, 3e-5, 1e-4, -2e-4]
    state = solve(LOOSE, displacement=displacement)
    total, force, stiffness = evaluate_response(law_of(LOOSE), displacement)
    assert total == state.energy
    assert np.array_equal(force, state.force) and np.array_equal(stiffness, state.stiffness)


def test_ring_shifted_beyond_its_grooves_frees_the_far_balls():
    state = solve(OTHER, displacement=[2.5 * law_of(OTHER).groove, 0, 0, 0, 0])
    assert np.array_equal(state.element_loads > 0, np.cos(np.arange(7) * 2 * np.pi / 7) > 0)
