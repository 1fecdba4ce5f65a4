"""Friction laws: limits, sign, dissipation, and what LuGre is before and after it slides; compiled and in plain Python."""

import numpy as np
import pytest

from drivewright._jit import plain
from drivewright.contact import friction
from drivewright.numerics.ode import Functions, integrate

pytestmark = pytest.mark.analytical

BRISTLES = (1e5, 0.12, 0.19, 0.02)  # s0, mu, mu_s, v_s
SLIPS = [-3.0, -0.02, -1e-3, 0.0, 4e-4, 0.013, 0.6]


def test_coulomb():
    assert friction.coulomb(0.15, 300.0, 2.0, 0.01) == pytest.approx(45.0, rel=1e-15)
    assert friction.coulomb(0.15, 300.0, -0.013, 0.01) == pytest.approx(-45 * np.tanh(1.3), rel=1e-14)
    assert friction.coulomb(0.15, 300.0, 1e-7, 0.01) == pytest.approx(45e-5, rel=1e-9)


def test_ambrosio():
    law = lambda slip: friction.ambrosio(0.15, 300.0, slip, 0.001, 0.011)  # noqa: E731
    slips = (0.0, 0.001, -0.0009, 0.0035, -0.006, 0.011, -7.0)
    assert [law(slip) for slip in slips] == pytest.approx([0, 0, 0, 11.25, -22.5, 45, -45], rel=1e-12)
    assert friction.ambrosio(0.15, 300.0, 0.2, 0.1, 0.1) == pytest.approx(45.0) and friction.ambrosio(0.15, 300.0, 0.1, 0.1, 0.1) == 0.0


@pytest.mark.parametrize("law", [friction.coulomb, friction.ambrosio])
def test_friction_takes_energy_and_is_odd(law):
    rest = (0.01,) if law is friction.coulomb else (1e-4, 0.01)
    force = [law(0.2, 70.0, slip, *rest) for slip in SLIPS]
    assert all(f * slip >= 0 for f, slip in zip(force, SLIPS, strict=True)) and force[0] < -13.9 and force[3] == 0.0
    assert [law(0.2, 70.0, -slip, *rest) for slip in SLIPS] == [-f for f in force]
    assert [law(0.2, 210.0, slip, *rest) for slip in SLIPS] == pytest.approx([3 * f for f in force], rel=1e-14)


# -------------------------------------------------------------------------------------------------------------- LuGre


def settle(slip, time, start=0.0):
    """The deflection after sliding at a steady slip."""
    system = Functions(lambda t, z: np.array([friction.lugre_rate(z[0], slip, *BRISTLES)]))
    return integrate(system, 0.0, time, [start], 1e-10, 1e-16).y_end[0]


@pytest.mark.parametrize("slip", [-0.3, -0.017, 0.004, 0.05])
def test_lugre_slides_on_the_stribeck_curve(slip):
    z = settle(slip, 40 * 0.19 / BRISTLES[0] / abs(slip))
    rate = friction.lugre_rate(z, slip, *BRISTLES)
    wanted = 250.0 * (np.sign(slip) * (0.12 + 0.07 * np.exp(-((slip / 0.02) ** 2))) + 0.4 * slip)
    assert friction.lugre(z, rate, slip, 250.0, 1e5, 300.0, 0.4) == pytest.approx(wanted, rel=1e-8)


def test_lugre_is_a_spring_before_it_slides():
    way = 1e-9  # far below mu_s/s0 = 1.9e-6 m
    z = settle(1e-6, way / 1e-6)
    assert z == pytest.approx(way * (1 - 0.5 * way * 1e5 / 0.19), rel=1e-6)
    assert friction.lugre(z, 0.0, 0.0, 250.0, 1e5, 300.0, 0.4) == pytest.approx(250 * 1e5 * z, rel=1e-14)


def test_lugre_at_onset_has_the_bristles_damping():
    assert friction.lugre_rate(0.0, 0.03, *BRISTLES) == 0.03
    assert friction.lugre(0.0, 0.03, 0.03, 250.0, 1e5, 300.0, 0.4) == pytest.approx(250 * 300.4 * 0.03, rel=1e-14)


def test_lugre_never_bends_farther_than_it_holds():
    most = 0.19 / 1e5
    for slip in SLIPS:
        assert friction.lugre_rate(most, slip, *BRISTLES) <= 0 or slip == 0
        assert friction.lugre_rate(-most, slip, *BRISTLES) >= 0 or slip == 0


def test_lugre_over_a_cycle_takes_energy():
    speed = lambda t: 0.02 * np.cos(40 * t)  # noqa: E731
    parts = (1e5, 30.0, 0.4)

    def rates(t, y):
        rate = friction.lugre_rate(y[0], speed(t), *BRISTLES)
        return np.array([rate, friction.lugre(y[0], rate, speed(t), 250.0, *parts) * speed(t)])

    period = 2 * np.pi / 40
    run = integrate(Functions(rates), 0.0, 2 * period, [0.0, 0.0], 1e-8, [1e-12, 1e-9], samples=[period, 2 * period])
    (first, work), (second, total) = run.y
    assert second == pytest.approx(first, rel=1e-5)
    assert 250 * 0.12 * 4 * 0.02 / 40 < total - work < 250 * (0.19 + 0.4 * 0.02) * 4 * 0.02 / 40


def test_compiled_equals_plain():
    for slip in (-0.02, 3e-4, 0.5):
        for law, given in (
            (friction.coulomb, (0.2, 70.0, slip, 0.01)),
            (friction.ambrosio, (0.2, 70.0, slip, 1e-4, 0.3)),
            (friction.lugre_rate, (4e-7, slip, *BRISTLES)),
            (friction.lugre, (4e-7, 0.1, slip, 70.0, 1e5, 30.0, 0.4)),
        ):
            assert law(*given) == pytest.approx(plain(law)(*given), rel=1e-14)
