"""Unbalance response of rigid rotors by closed forms, its limits and symmetries, balance grades, and resonance without damping."""

from typing import get_args

import numpy as np
import pytest
from rotors import CASES, matrix, our_rotor, our_shaft
from test_shafts_whirl import DAMPING, DIAMETRAL, HALF, MASS, POLAR, STIFF, rigid

from drivewright import shafts
from drivewright.errors import InputError
from drivewright.mechanisms.shaft.tables import BalanceGrade
from drivewright.shafts.unbalance import GRADES, Orbits

MOMENT, SPEEDS = 1e-4, np.array([100.0, 577.0, 2000.0])
NO_STIFFNESS = np.zeros((2, 2, 2))


def response(rotor, speeds=SPEEDS, unbalances=None, places=(HALF,), stiffness=None):
    given = [shafts.Unbalance(HALF, MOMENT)] if unbalances is None else unbalances
    return shafts.unbalance_response(rotor, given, speeds, places, NO_STIFFNESS if stiffness is None else np.array([stiffness] * 2))


@pytest.mark.analytical
def test_a_rigid_rotor_goes_round_on_a_circle():
    """z = U s^2/(2k - m s^2 + 2 i c s), each bearing with half of the force."""
    found = response(rigid(damping=matrix(DAMPING)), stiffness=matrix(STIFF))
    z = MOMENT * SPEEDS**2 / (2 * STIFF - MASS * SPEEDS**2 + 2j * DAMPING * SPEEDS)
    assert found.amplitude[:, 0] == pytest.approx(np.abs(z), rel=1e-7)
    assert found.lag[:, 0] == pytest.approx(-np.angle(z), rel=1e-6)
    assert np.all(np.abs(found.backward) < 1e-12 * np.abs(found.forward))
    force = np.abs((STIFF + 1j * DAMPING * SPEEDS) * z)
    assert found.support_forces == pytest.approx(np.stack([force, force], axis=1), rel=1e-7)


@pytest.mark.parametrize("rounding", [-1e-17, 0.0, 1e-17])
def test_a_lag_of_rounding_is_no_turn(rounding):
    none = np.zeros((1, 1))
    found = Orbits(np.ones(1), np.array([[1e-6 * (1 + 1j * rounding)]]), none.astype(complex), none, np.ones(1))
    assert found.lag[0, 0] == 0


@pytest.mark.analytical
def test_cross_coupling_shifts_the_response():
    """z = U s^2/(2k - m s^2 + 2 i c s - 2 i q), q the force along x of a displacement along y."""
    cross = 3e5
    found = response(rigid(matrix(STIFF, cross=cross), matrix(DAMPING)))
    z = MOMENT * SPEEDS**2 / (2 * STIFF - MASS * SPEEDS**2 + 2j * DAMPING * SPEEDS - 2j * cross)
    assert found.forward[:, 0] == pytest.approx(z, rel=1e-6)


@pytest.mark.analytical
def test_two_stiffnesses_make_an_ellipse():
    """x and y each on their own; above one critical speed and below the other the orbit goes round against the shaft."""
    rotor = rigid(matrix(STIFF, 0.5 * STIFF), matrix(DAMPING, 0.5 * DAMPING))
    found = response(rotor, stiffness=matrix(STIFF, 0.5 * STIFF))
    x = MOMENT * SPEEDS**2 / (2 * STIFF - MASS * SPEEDS**2 + 2j * DAMPING * SPEEDS)
    y = -1j * MOMENT * SPEEDS**2 / (STIFF - MASS * SPEEDS**2 + 1j * DAMPING * SPEEDS)
    assert found.forward[:, 0] == pytest.approx(0.5 * (x + 1j * y), rel=1e-6)
    assert found.backward[:, 0] == pytest.approx(0.5 * np.conj(x - 1j * y), rel=1e-6)
    assert found.amplitude[:, 0] == pytest.approx(0.5 * (np.abs(x + 1j * y) + np.abs(x - 1j * y)), rel=1e-7)
    at = 500.0  # between sqrt(k/m) = 408 and sqrt(2k/m) = 577 rad/s
    between = response(rotor, [at])
    assert abs(between.backward[0, 0]) > abs(between.forward[0, 0])
    fx, fy = ((k + 1j * c * SPEEDS) * each for k, c, each in ((STIFF, DAMPING, x), (0.5 * STIFF, 0.5 * DAMPING, y)))
    force = 0.5 * (np.abs(fx + 1j * fy) + np.abs(fx - 1j * fy))
    assert found.support_forces[:, 0] == pytest.approx(force, rel=1e-6)


@pytest.mark.analytical
def test_a_couple_of_unbalances_swings_on_a_cone():
    """Two at half a turn, 2 b apart: the angle is U s^2 2 b/(2 k a^2 - (I_d - I_p) s^2), opposite displacements at the two bearings."""
    b = HALF / 2
    couple = [shafts.Unbalance(HALF - b, MOMENT, np.pi), shafts.Unbalance(HALF + b, MOMENT)]
    found = response(rigid(), unbalances=couple, places=(0.0, HALF, 2 * HALF))
    angle = MOMENT * SPEEDS**2 * 2 * b / (2 * STIFF * HALF**2 - (DIAMETRAL - POLAR) * SPEEDS**2)
    assert found.forward[:, 2] == pytest.approx(HALF * angle, rel=1e-6)
    assert found.forward[:, 0] == pytest.approx(-HALF * angle, rel=1e-6)
    assert np.all(found.amplitude[:, 1] < 1e-9 * found.amplitude[:, 0])


@pytest.mark.property
def test_far_above_all_critical_speeds_the_centre_of_mass_stands_still():
    found = response(rigid(damping=matrix(DAMPING)), [1e5])
    assert found.forward[0, 0] == pytest.approx(-MOMENT / MASS, rel=1e-3)
    assert found.lag[0, 0] == pytest.approx(np.pi, rel=1e-2)


@pytest.mark.property
def test_responses_add_and_turn_with_the_unbalance():
    case = CASES["skewed"]
    rotor = our_rotor(case, places=[0.5, 1.0])[1]
    one, other = [shafts.Unbalance(0.5, 2e-4, 0.3)], [shafts.Unbalance(1.0, 1e-4, -1.1)]
    found = [response(rotor, SPEEDS, each, (0.5, 1.0)) for each in (one, other, [*one, *other])]
    assert found[2].forward == pytest.approx(found[0].forward + found[1].forward, rel=1e-9)
    assert found[2].backward == pytest.approx(found[0].backward + found[1].backward, rel=1e-9)
    turned = response(rotor, SPEEDS, [shafts.Unbalance(0.5, 2e-4, 1.3)], (0.5, 1.0))
    assert turned.forward == pytest.approx(found[0].forward * np.exp(1j), rel=1e-9)
    assert turned.amplitude == pytest.approx(found[0].amplitude, rel=1e-9)


@pytest.mark.property
@pytest.mark.parametrize("name", ["isotropic", "skewed"])
def test_few_modes_are_enough(name):
    case = CASES[name]
    few, many = (response(our_rotor(case, kept=kept)[1], case["speeds"], [shafts.Unbalance(0.5, 1e-3)], (0.5, 1.0)) for kept in (12, 60))
    assert few.amplitude == pytest.approx(many.amplitude, rel=1e-4)


@pytest.mark.property
def test_the_response_has_its_peak_at_the_damped_critical_speed():
    """Of a lightly damped rotor, to the square of the damping ratio."""
    rotor = rigid(damping=matrix(20.0))
    diagram = shafts.campbell(rotor, np.linspace(0, 800, 17), 2)
    critical = next(each for each in shafts.damped_critical_speeds(rotor, diagram) if each.forward)
    speeds = critical.speed * np.linspace(0.999, 1.001, 401)
    found = response(rotor, speeds)
    assert speeds[np.argmax(found.amplitude[:, 0])] == pytest.approx(critical.speed, rel=3e-5)
    static = MOMENT * critical.speed**2 / (2 * STIFF)
    assert found.amplitude.max() / static == pytest.approx(0.5 / critical.damping_ratio, rel=1e-3)


@pytest.mark.error
def test_resonance_without_damping_is_told_and_not_divided_by():
    rotor = rigid()
    critical = next(
        each for each in shafts.damped_critical_speeds(rotor, shafts.campbell(rotor, np.linspace(0, 700, 15), 1)) if each.forward
    )
    found = response(rotor, [critical.speed, 0.9 * critical.speed])
    assert found.resonant.tolist() == [True, False]
    assert response(rigid(damping=matrix(DAMPING)), [critical.speed]).resonant.tolist() == [False]


@pytest.mark.analytical
def test_permissible_unbalance_by_the_grade():
    """G 2.5 at 3000 rpm is an eccentricity of 7.96 um of the whole rotor."""
    shaft, speed = our_shaft(CASES["isotropic"]), 100 * np.pi
    masses = [station.mass for station in shaft.stations]
    whole = sum(masses) + 7810 * np.pi / 4 * 0.05**2 * 1.5
    found = shafts.permissible_unbalances(shaft, "G 2.5", speed)
    assert sum(u.moment for u in found) == pytest.approx(whole * 2.5e-3 / speed, rel=1e-12)
    assert [u.moment for u in found] == pytest.approx([whole * 2.5e-3 / speed * m / sum(masses) for m in masses])
    assert [u.position for u in found] == [0.5, 1.0]
    assert shafts.balance_quality(shaft, found, speed) == pytest.approx(2.5e-3, rel=1e-12)
    assert 2.5e-3 / speed == pytest.approx(7.96e-6, rel=1e-3)
    with pytest.raises(InputError, match="no station and no gear has a mass"):
        shafts.permissible_unbalances(shaft._replace(stations=()), "G 2.5", speed)


@pytest.mark.interface
def test_grades_are_those_of_the_standard():
    """Each some 2.5 times the one before, from 0.4 to 4000 mm/s."""
    printed = (0.4, 1, 2.5, 6.3, 16, 40, 100, 250, 630, 1600, 4000)
    assert [f"G {grade:g}" for grade in printed] == list(GRADES)
    assert list(GRADES.values()) == pytest.approx([1e-3 * grade for grade in printed], rel=1e-12)
    assert list(GRADES) == list(get_args(BalanceGrade))


@pytest.mark.analytical
def test_mass_of_a_hollow_cone():
    cone = shafts.Section(0.3, 0.08, 0.05, 0.02)
    shaft = our_shaft(CASES["isotropic"])._replace(sections=(cone,), density=1000.0)
    frustum = np.pi * 0.3 / 12 * (0.08**2 + 0.08 * 0.05 + 0.05**2)
    assert shafts.shaft_mass(shaft) == pytest.approx(1000 * (frustum - np.pi / 4 * 0.02**2 * 0.3), rel=1e-12)
