"""Archard's wear on angular bins: nothing is lost, everything lands where the contact was."""

import numpy as np
import pytest

from drivewright._jit import plain
from drivewright.contact import wear
from drivewright.errors import InputError
from drivewright.numerics.quadrature import integrate_pieces

pytestmark = pytest.mark.analytical

K, RADIUS, LENGTH = 3e-14, 0.011, 0.017


def history(m=4000):
    """A contact that runs to and fro, with a flight in between and uneven time steps."""
    time = np.cumsum(np.random.default_rng(4).uniform(0.5, 1.5, m)) * 1e-5
    u = time / time[-1]
    force = np.maximum(300 * np.sin(7 * u) + 80, 0)
    angle = np.where(force > 0, 5.5 + 2.2 * np.sin(5 * u), np.nan)
    return time, angle, force, 0.3 * np.cos(9 * u)


def test_archard():
    assert wear.wear_volume(2e-14, 500.0, 3e4) == pytest.approx(3e-7, rel=1e-15)


@pytest.mark.parametrize("bins", [7, 72, 360])
def test_no_volume_is_lost(bins):
    time, angle, force, slip = history()
    depth = wear.deposit(time, angle, force, slip, K, RADIUS, LENGTH, bins)
    power = force * np.abs(slip)
    total = K * np.sum(0.5 * (power[1:] + power[:-1]) * np.diff(time))
    assert depth.shape == (bins,) and np.all(depth >= 0)
    assert depth.sum() * (2 * np.pi / bins) * RADIUS * LENGTH == pytest.approx(total, rel=1e-12)
    field = np.vectorize(lambda angle: wear.wear_at(depth, angle)[0])
    integral = integrate_pieces(field, (np.arange(bins + 1) - 0.5) * 2 * np.pi / bins, 2)
    assert integral * RADIUS * LENGTH == pytest.approx(total, rel=1e-12)


def test_a_standing_contact_wears_its_two_neighbours():
    time = np.array([0.0, 0.2, 0.5])
    depth = wear.deposit(time, np.full(3, -2 * np.pi / 12 * 0.7), np.full(3, 40.0), [-2.0, 2.0, -2.0], K, RADIUS, LENGTH, 12)
    whole = K * 40 * 2 * 0.5 / (2 * np.pi / 12 * RADIUS * LENGTH)
    assert depth == pytest.approx([0.3 * whole, *[0] * 10, 0.7 * whole], rel=1e-12, abs=1e-30)


def test_a_contact_that_goes_round_evenly_wears_evenly():
    u = np.linspace(0, 1, 7201)
    depth = wear.deposit(3 * u, 2 * np.pi * u + 1.0, np.full(u.size, 50.0), np.full(u.size, -0.4), K, RADIUS, LENGTH, 36)
    assert depth == pytest.approx(K * 50 * 0.4 * 3 / (2 * np.pi * RADIUS * LENGTH), rel=3e-5)


def test_wear_follows_the_force_over_the_angle():
    u = np.linspace(0, 1, 20001)
    angle, bins = 2 * np.pi * u, 180
    depth = wear.deposit(u, angle, 50 + 30 * np.cos(angle - 1), np.full(u.size, 0.4), K, RADIUS, LENGTH, bins)
    node = 2 * np.pi * np.arange(bins) / bins
    assert depth == pytest.approx(K * (50 + 30 * np.cos(node - 1)) * 0.4 / (2 * np.pi * RADIUS * LENGTH), rel=1e-3)


def test_turning_the_bearing_by_whole_bins_turns_the_wear():
    time, angle, force, slip = history()
    depth = wear.deposit(time, angle, force, slip, K, RADIUS, LENGTH, 72)
    turned = wear.deposit(time, angle - 2 * np.pi * 5 / 72 - 4 * np.pi, force, slip, K, RADIUS, LENGTH, 72)
    np.testing.assert_allclose(turned, np.roll(depth, -5), rtol=1e-9, atol=1e-9 * depth.max())


def test_the_jump_over_cycles_is_linear():
    assert wear.extrapolate_wear([1e-6, 2e-6], np.array([1e-9, 0.0]), 2000) == pytest.approx([3e-6, 2e-6], rel=1e-14)


def test_the_wear_over_the_angle_is_periodic_and_smooth():
    """Of a quadratic B-spline: an eighth of each neighbour at a node, the mean half way between two."""
    depths, turn = np.array([1.0, 4.0, 2.0, 0.0]), np.pi / 2
    for angle, depth in ((0, 1.25), (turn / 2, 2.5), (turn, 3.375), (3.5 * turn, 0.5), (-turn / 2, 0.5), (4.5 * turn, 2.5)):
        assert wear.wear_at(depths, angle)[0] == pytest.approx(depth, rel=1e-12)
    for angle in (-0.3, 0.2, turn / 2, 3.0, 5.9):
        assert wear.wear_at(depths, angle) == pytest.approx(plain(wear.wear_at)(depths, angle), rel=1e-14)
        rise = wear.wear_at(depths, angle + 1e-6)[0] - wear.wear_at(depths, angle - 1e-6)[0]
        assert wear.wear_at(depths, angle)[1] == pytest.approx(rise / 2e-6, abs=1e-5)


@pytest.mark.parametrize(
    "change, message",
    [
        ({"slip": np.zeros(2)}, r"rows of the same two or more samples, got the shapes \(3,\), \(3,\), \(3,\), \(2,\)"),
        ({"time": [0.0, 2.0, 1.0]}, "time decreases after 2 s; sort the samples"),
        ({"force": [1.0, -1.0, 0.0]}, "forces must be finite and not below 0"),
        ({"angle": [np.nan, 0.0, 0.0]}, "angles of loaded samples finite"),
        ({"bins": 2}, "2 bins do not tell"),
    ],
)
def test_refusals(change, message):
    given = {
        "time": [0.0, 1.0, 2.0],
        "angle": np.zeros(3),
        "force": np.ones(3),
        "slip": np.ones(3),
        "coefficient": K,
        "radius": RADIUS,
        "length": LENGTH,
        "bins": 9,
    }
    with pytest.raises(InputError, match=message):
        wear.deposit(**(given | change))
