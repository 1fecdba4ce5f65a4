"""The arm of a planet by closed forms: circles where it does not turn, an ellipse and a straight line of Cardan's gears."""

from types import SimpleNamespace

import numpy as np
import pytest

from drivewright.errors import InputError
from drivewright.gears.planet_arm import PlanetArm
from drivewright.numerics.jets import variable

pytestmark = pytest.mark.analytical

ARM, TURN = 0.03, 2 * np.pi


def arm_of(ratio, distance, carrier_angle=0.3, start=0.7, bend=0.0):
    """An arm of a planet that turns by `ratio` times the carrier's angle on it; two carrier arms in line reach 60 mm."""
    return PlanetArm(SimpleNamespace(planet=lambda t: ratio * variable(t)), ARM, carrier_angle, bend, distance, start)


@pytest.mark.parametrize("carrier_angle", [0.3, 2.9, -1.2])
def test_an_arm_that_keeps_its_direction_goes_round_a_circle(carrier_angle):
    """Highest where the carrier stands upright, lowest half a turn further; as high and as wide as twice the carrier."""
    arm = arm_of(1.0, 0.02, carrier_angle)
    assert np.exp(1j * arm.highest) == pytest.approx(np.exp(1j * (carrier_angle - np.pi / 2)))
    assert np.exp(1j * arm.lowest) == pytest.approx(np.exp(1j * (carrier_angle + np.pi / 2)))
    assert 0 <= arm.lowest < TURN and 0 <= arm.highest < TURN
    assert arm.track_height == pytest.approx(4 * ARM) == pytest.approx(arm.track_width)
    assert arm.height(arm.highest) == pytest.approx(4 * ARM) and arm.height(arm.lowest) == pytest.approx(0)


@pytest.mark.parametrize(("carrier_angle", "start"), [(0.3, 0.7), (1.9, 0.4), (-0.8, -0.5)])
@pytest.mark.parametrize("distance", [0.02, 0.045])
def test_an_arm_that_turns_as_fast_the_other_way_draws_an_ellipse(carrier_angle, start, distance):
    """2a e^i(q - t) + d e^i(s + t): half axes 2a + d and |2a - d|, the long one in the direction (q + s) / 2."""
    arm = arm_of(2.0, distance, carrier_angle, start)
    long, short, tilt = 2 * ARM + distance, abs(2 * ARM - distance), (carrier_angle + start) / 2
    assert arm.track_height == pytest.approx(2 * np.hypot(long * np.sin(tilt), short * np.cos(tilt)), rel=1e-9)
    assert arm.track_width == pytest.approx(2 * np.hypot(long * np.cos(tilt), short * np.sin(tilt)), rel=1e-6)
    t = np.linspace(0, TURN, 2001)
    height = arm.height(t)
    assert height.min() >= -1e-12 and height.max() <= arm.track_height + 1e-12
    assert height.min() == pytest.approx(0, abs=1e-6) and height.max() == pytest.approx(arm.track_height, abs=1e-6)


def test_of_several_crests_the_highest_and_of_several_hollows_the_lowest_count():
    """Three of each in a turn, of different heights."""
    arm, t = arm_of(-2.0, 0.05, 0.4, 0.9), np.linspace(0, TURN, 200_001)
    path = 2 * ARM * np.exp(1j * (0.4 - t)) + 0.05 * np.exp(1j * (0.9 - 3 * t))
    angles, heights = arm._extremes
    assert len(angles) == 6 and np.ptp(heights[heights > 0]) > 1e-3 and np.all(np.diff(angles) > 0)
    assert arm.track_height == pytest.approx(np.ptp(path.imag), abs=1e-9) and arm.track_width == pytest.approx(np.ptp(path.real), abs=1e-6)
    assert arm.highest == pytest.approx(t[np.argmax(path.imag)], abs=1e-4) and arm.lowest == pytest.approx(
        t[np.argmin(path.imag)], abs=1e-4
    )


@pytest.mark.parametrize("height", [1.0, -1.0])
def test_a_point_without_a_crest_has_no_lowest_place(height):
    """A point that only rises, as none of a closed train does: there is nothing to open or close at."""
    ever = PlanetArm(SimpleNamespace(planet=lambda t: variable(t)), ARM, 0.3, 0.0, 0.02, 0.7)
    object.__setattr__(ever, "point", lambda t: 1j * height * variable(t))
    with pytest.raises(InputError, match="is constant over the turn"):
        _ = ever.lowest


def test_an_extreme_at_the_seam_of_the_turn_is_one():
    """Start and end of the turn are the same place: its angle is 0, and it is not counted twice."""
    arm = arm_of(1.0, 0.02)

    def point(t):
        t = np.asarray(t)
        return SimpleNamespace(imag=SimpleNamespace(d1=t * (TURN - t) * (t - 3)), d0=1j * np.cos(t))

    object.__setattr__(arm, "point", point)
    angles, _ = arm._extremes
    assert angles == pytest.approx([0, 3]) and arm.highest == 0
