"""The three-elliptic-gear planetary train: table of the planet's angle, collinear states, and the geometry of every mesh."""

import numpy as np
import pytest

from drivewright.errors import InputError
from drivewright.gears import EllipticGearPair, GearTrain

pytestmark = pytest.mark.analytical

ECCENTRICITY = np.sqrt(1 - 0.985**2)
TABLE = {
    30: 21.4077,
    60: 47.6488,
    65: 52.6967,
    86: 76.5794,
    87: 77.8338,
    90: 81.6639,
    120: 125.2498,
    123: 130.0510,
    150: 174.3070,
    180: 219.1554,
    210: 254.5432,
    240: 281.7357,
    253: 291.7316,
    270: 303.6895,
    300: 322.8529,
    330: 341.0806,
    360: 360.0,
}


def train(bend=89.0, start="near", semi_major=0.016272):
    pair = EllipticGearPair(ECCENTRICITY, semi_major, start)
    return GearTrain((pair, pair), (np.deg2rad(bend),))


def test_table_of_the_planet():
    t = np.deg2rad(list(TABLE))
    np.testing.assert_allclose(np.rad2deg(train().planet(t).d0), list(TABLE.values()), atol=6e-5)
    assert np.rad2deg(train().phase) == pytest.approx(69.4801, abs=6e-5)
    rotation = np.rad2deg(train().rotation(np.deg2rad([61.4, 65, 86, 213])).d0)
    np.testing.assert_allclose(rotation, [-12.36, -12.30, -9.42, 44.58], atol=6e-3)


@pytest.mark.parametrize(
    ("bend", "start", "expected"),
    [(89, "near", [110.52, 251.36]), (-91, "near", [110.52, 251.36]), (91, "near", [108.635, 249.48]), (-89, "near", [108.635, 249.48])],
)
def test_collinear_states(bend, start, expected):
    """Each assembly has two; (s, -180 deg + s) share them, as the mesh's angle then differs by half a turn."""
    np.testing.assert_allclose(np.rad2deg(train(bend, start).collinear_angles()), expected, atol=5e-3)


@pytest.mark.parametrize("bend", [89, -91, 91, -89])
def test_far_start_is_collinear_elsewhere(bend):
    """theta + s = pi k with tan(theta/2) = tan(t/2)/r for a far start: near 70 and 290 deg."""
    r = (1 - ECCENTRICITY) / (1 + ECCENTRICITY)
    theta = np.deg2rad(np.array([180, 360]) - bend % 180)
    expected = np.rad2deg(2 * np.arctan(r * np.tan(theta / 2))) % 360
    np.testing.assert_allclose(np.rad2deg(train(bend, "far").collinear_angles()), expected, atol=1e-9)
    assert 69 < expected[0] < 72 and 288 < expected[1] < 291


def test_collinear_means_both_ellipses_lie_along_the_arm():
    """At either state the intermediate gear's major axis points along the second arm."""
    own = train()
    turned = own.angles(own.collinear_angles())[1].d0
    np.testing.assert_allclose(np.sin(turned + np.deg2rad(89)), 0, atol=1e-12)


def test_both_conventions_of_zero():
    own = train()
    t = np.linspace(0, 7, 31)
    collinear = own.collinear_angles()[-1]
    assert own.planet(0.0).d0 == 0 and own.planet(collinear, zero=collinear).d0 == 0
    shifted = own.planet(t, zero=collinear)
    np.testing.assert_allclose(own.planet(t).d0 - shifted.d0, own.planet(collinear).d0, rtol=1e-13)
    # the absolute phase is a whole number of turns there: the planet's long radius points at the intermediate axis
    assert (own.planet(collinear).d0 + own.phase) / (2 * np.pi) == pytest.approx(1.0, abs=1e-12)


def test_derivatives_against_a_fine_difference():
    own, t, h = train(), np.linspace(0.3, 6.0, 11), 1e-4
    at = own.planet(t)
    for order in range(3):
        below, above = (list(own.planet(t + way * h))[order] for way in (-1, 1))
        np.testing.assert_allclose(list(at)[order + 1], (above - below) / (2 * h), rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("start", ["near", "far"])
def test_every_mesh_fills_its_arm(start):
    """Four gears on two bends, seen from the carrier: the focal radii along each arm add up to 2 a at every t.

    Directions of the short radii: the sun's turns counter-clockwise from the first arm (reversed for a far start), each driven
    gear's starts on the extension of its incoming arm, and the senses alternate.
    """
    e, a, bends = 0.35, 0.02, (0.7, -1.9)
    pair = EllipticGearPair(e, a, start)
    own = GearTrain((pair, pair, pair), bends)
    t = np.linspace(0, 12, 60)
    arms = np.cumsum([0.0, *bends])
    flip = 0.0 if start == "near" else np.pi
    sense = np.array([1, -1, 1, -1])
    extension = np.array([arms[0], *arms])  # direction in which each gear's reference radius points at its phase 0
    short = [extension[k] + sense[k] * phase.d0 + flip for k, phase in enumerate(own.angles(t))]
    radius = lambda gear, direction: a * (1 - e**2) / (1 + e * np.cos(direction - short[gear]))  # noqa: E731
    for k, arm in enumerate(arms):
        np.testing.assert_allclose(radius(k, arm) + radius(k + 1, arm + np.pi), 2 * a, rtol=1e-13)


def test_world_positions_of_the_axes():
    own = train()
    t = np.array([0.0, 1.1])
    sun, middle, planet = own.axes(t, start=np.deg2rad(7))
    arm = 2 * 0.016272
    np.testing.assert_allclose(sun.d0, 0)
    np.testing.assert_allclose(middle.d0, arm * np.exp(1j * (np.deg2rad(7) - t)), rtol=1e-14)
    np.testing.assert_allclose(planet.d0 - middle.d0, arm * np.exp(1j * (np.deg2rad(96) - t)), rtol=1e-13)
    np.testing.assert_allclose(middle.d1, -1j * middle.d0, rtol=1e-14)


def test_circular_gears_translate_the_planet():
    pair = EllipticGearPair(0.0, 0.02)
    own = GearTrain((pair, pair), (1.2,))
    np.testing.assert_allclose(own.rotation(np.linspace(0, 9, 40)).d0, 0, atol=1e-14)
    single = GearTrain((pair,))
    np.testing.assert_allclose(single.rotation(np.array([0.5])).d0, -1.0)


def test_a_missing_bend_is_named():
    pair = EllipticGearPair(0.1, 0.02)
    with pytest.raises(InputError, match="2 pairs and 0 bends; a train of n pairs has a bend at each"):
        GearTrain((pair, pair))
