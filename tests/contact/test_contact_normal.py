"""Normal forces: what holds for every law, and the free impact against its closed forms; compiled and in plain Python."""

from typing import NamedTuple

import numpy as np
import pytest

from drivewright import contact
from drivewright._jit import kernel, plain
from drivewright.contact.normal import HuntCrossley, KelvinVoigt, Spring, hunt_crossley_chi, normal_force
from drivewright.errors import InputError
from drivewright.numerics.ode import Event, Functions, integrate

pytestmark = pytest.mark.property

LAWS = [Spring(3e6), KelvinVoigt(3e6, 40.0), HuntCrossley(2e9, 1.5, 0.6), HuntCrossley(2e9, 10 / 9, 0.0)]
DEPTHS = np.array([1e-7, 3e-6, 2e-5, 4e-4])


@pytest.mark.parametrize("law", LAWS)
def test_separated_bodies_do_not_feel_each_other(law):
    assert [normal_force(law, gap, rate) for gap in (0.0, 1e-9, 0.1) for rate in (-3.0, 0.0, 3.0)] == [0.0] * 9


@pytest.mark.parametrize("law", LAWS)
def test_never_pulls(law):
    assert all(normal_force(law, -depth, rate) >= 0 for depth in DEPTHS for rate in (-9.0, 0.3, 4.0, 900.0))
    assert type(law) is Spring or law[-1] == 0.0 or normal_force(law, -1e-5, 900.0) == 0.0


@pytest.mark.parametrize("law", LAWS)
def test_force_grows_with_depth_and_with_approach(law):
    assert np.all(np.diff([normal_force(law, -depth, -0.1) for depth in DEPTHS]) > 0)
    against_rate = np.diff([normal_force(law, -1e-5, rate) for rate in (-0.2, -0.1, 0.0, 0.1)])
    assert np.all(against_rate < 0) or law[-1] == 0.0 or type(law) is Spring and np.all(against_rate == 0)


def test_values():
    assert normal_force(Spring(3e6), -2e-5, 7.0) == pytest.approx(60.0, rel=1e-15)
    assert normal_force(KelvinVoigt(3e6, 40.0), -2e-5, -0.5) == pytest.approx(80.0, rel=1e-15)
    assert normal_force(HuntCrossley(2e9, 1.5, 0.6), -4e-4, -0.5) == pytest.approx(2e9 * 8e-6 * 1.3, rel=1e-14)


@pytest.mark.parametrize(
    "law", [(KelvinVoigt(3e6, 40.0), KelvinVoigt(3e3, 40e-3)), (HuntCrossley(2e9, 1.5, 0.6), HuntCrossley(2e9 / 1e3**1.5, 1.5, 0.6e-3))]
)
def test_millimetres_give_the_same_force(law):
    metres, millimetres = law
    assert normal_force(millimetres, -2e-2, -500.0) == pytest.approx(normal_force(metres, -2e-5, -0.5), rel=1e-13)


def impact(law, mass, speed):
    """Speed of separation after a free impact, by integration of m g'' = F."""
    system = Functions(
        lambda t, y: np.array([y[1], normal_force(law, y[0], y[1]) / mass]), lambda t, y: np.array([y[0] if y[1] > 0 else -1.0])
    )
    n = law.n if isinstance(law, HuntCrossley) else 1.0
    time = 10 / speed * ((n + 1) * mass * speed**2 / (2 * law.k)) ** (1 / (n + 1))  # several times the undamped contact
    run = integrate(system, 0, time, [0.0, -speed], 1e-11, [1e-16, 1e-12], watch=[Event(1, terminal=True)], max_step=time / 400)
    assert run.outcome == "event"
    return run.y_end[1]


@pytest.mark.parametrize("chi, speed, n", [(0.02, 0.5, 1.5), (0.3, 2.0, 1.5), (2.0, 1.3, 1.0), (0.1, 0.4, 2.2)])
def test_hunt_crossley_impact_loses_what_the_closed_form_says(chi, speed, n):
    e = impact(HuntCrossley(2e8, n, chi), 0.7, speed) / speed
    x = chi * speed
    assert x * (1 + e) == pytest.approx(np.log((1 + x) / (1 - x * e)), rel=1e-7)
    assert hunt_crossley_chi(e, speed) == pytest.approx(chi, rel=1e-5)


def test_small_damping_loses_two_thirds_chi_v():
    losses = [1 - impact(HuntCrossley(2e8, 1.5, chi), 0.7, 0.5) / 0.5 for chi in (0.004, 0.008)]
    np.testing.assert_allclose(losses, [2 / 3 * 0.004 * 0.5, 2 / 3 * 0.008 * 0.5], rtol=4e-3)


def test_kelvin_voigt_impact_leaves_where_the_force_is_gone():
    # Under-damped: the force vanishes at k d = c g' before the spring is relaxed; from there the body flies on.
    k, c, mass = 3e6, 900.0, 0.7
    zeta = c / (2 * np.sqrt(k * mass))
    root = np.sqrt(1 - zeta**2)
    e = np.exp(-zeta / root * np.arctan2(2 * zeta * root, 2 * zeta**2 - 1))
    assert impact(KelvinVoigt(k, c), mass, 1.7) / 1.7 == pytest.approx(e, rel=1e-6)


@pytest.mark.parametrize("e", [1e-3, 0.02, 0.3, 0.7, 0.99, 0.99985, 0.99995, 1.0])
def test_chi_of_every_restitution(e):
    speed = 2.7
    x = hunt_crossley_chi(e, speed) * speed
    assert 1.5 * (1 - e) <= x <= (1 + 1e-15) / e
    if 0.1 <= e <= 0.99:
        assert x * (1 + e) == pytest.approx(np.log((1 + x) / (1 - x * e)), rel=1e-11)
    assert x == pytest.approx(1.5 * (1 - e) * (2 - e), rel=3 * (1 - e) ** 2 + 3e-8) or e < 0.5


@pytest.mark.parametrize("e, speed", [(0.0, 1.0), (1.1, 1.0), (0.5, 0.0)])
def test_impossible_bounces_are_refused(e, speed):
    with pytest.raises(InputError, match="restitution must lie in"):
        hunt_crossley_chi(e, speed)


class Unknown(NamedTuple):
    k: float


def test_an_unknown_law_is_named_with_the_known_ones():
    with pytest.raises(InputError, match="normal_force: no formula for a Unknown; it has one for: (.*)") as refusal:
        normal_force(Unknown(1.0), -1.0, 0.0)
    for known in ("HuntCrossley", "KelvinVoigt", "PowerLaw", "Spring"):  # and those of other packages that were met
        assert known in str(refusal.value)


@kernel
def total(law, gaps, rates):
    result = 0.0
    for i in range(gaps.size):
        result += normal_force(law, gaps[i], rates[i])
    return result


@pytest.mark.parametrize("law", LAWS)
def test_compiled_equals_plain(law):
    rng = np.random.default_rng(5)
    gaps, rates = rng.uniform(-1e-4, 3e-5, 50), rng.uniform(-1, 1, 50)
    assert total(law, gaps, rates) == pytest.approx(plain(total)(law, gaps, rates), rel=1e-15)
    assert total(law, gaps, rates) > 0


@pytest.mark.parametrize("n", [1.0, 10 / 9, 1.5])
def test_the_power_law_of_arrays_is_that_of_kernels(n):
    law, depth, h = contact.PowerLaw(3e9, n), np.array([-2e-6, 1e-7, 4e-6, 3e-5]), 1e-10
    found = contact.power_law_response(law, depth)
    assert found.force == pytest.approx([contact.normal_force(law, -d, 0.0) for d in depth], rel=1e-14)
    up, down = contact.power_law_response(law, depth + h), contact.power_law_response(law, depth - h)
    assert found.force == pytest.approx((up.energy - down.energy) / (2 * h), rel=1e-5)
    assert found.tangent == pytest.approx((up.force - down.force) / (2 * h), rel=1e-5)
    touching = found.force[1:]
    assert contact.power_law_depth(law, touching) == pytest.approx(depth[1:], rel=1e-13)
    assert contact.power_law_secant(law, touching) == pytest.approx(found.secant[1:], rel=1e-13)
