"""World directions of the gears of an elliptic train: along every line of centres the two focal radii make the centre distance."""

import numpy as np
import pytest

from drivewright.gears import EllipticGearPair, GearTrain

pytestmark = pytest.mark.analytical

SEMI_MAJOR, ECCENTRICITY = 0.02, 0.16


def focal_radius(direction, reference):
    """Polar ellipse about a focus; the reference direction is that of the short focal radius."""
    return SEMI_MAJOR * (1 - ECCENTRICITY**2) / (1 + ECCENTRICITY * np.cos(direction - reference))


@pytest.mark.parametrize("bend", [-1.2, 0.4])
def test_the_gears_touch_on_their_lines_of_centres(bend):
    pair = EllipticGearPair(ECCENTRICITY, SEMI_MAJOR)
    train, start, t = GearTrain((pair, pair), (bend,)), 0.3, np.linspace(0, 4 * np.pi, 97)
    sun, intermediate, planet = train.directions(t, start)
    first, second = start - t, start - t + bend
    assert focal_radius(first, sun) + focal_radius(first + np.pi, intermediate) == pytest.approx(2 * SEMI_MAJOR, rel=1e-12)
    assert focal_radius(second, intermediate) + focal_radius(second + np.pi, planet) == pytest.approx(2 * SEMI_MAJOR, rel=1e-12)


def test_the_sun_stands_still_and_the_planet_turns_with_the_train():
    pair = EllipticGearPair(ECCENTRICITY, SEMI_MAJOR)
    train, t = GearTrain((pair, pair), (0.7,)), np.linspace(0, 2 * np.pi, 41)
    sun, _, planet = train.directions(t, 0.3)
    assert np.all(sun == 0.3)
    assert planet - planet[0] == pytest.approx(train.rotation(t).d0, abs=1e-12)
