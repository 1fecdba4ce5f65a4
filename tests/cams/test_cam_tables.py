"""Tables of a cam's surfaces against closed forms: sliding of a flat face, undercut of both walls of a groove, travel with vibration."""

from functools import partial

import numpy as np
import pytest

from drivewright import cams, motion
from drivewright.cams.clearance import mass_deviation, mass_deviation_rate
from drivewright.cams.track import CamTrack

pytestmark = pytest.mark.analytical

LIFT = 0.010


@pytest.fixture(scope="module")
def programme():
    law = motion.law("cycloidal")
    return motion.Programme((motion.Segment(np.pi, law, LIFT), motion.Segment(np.pi, law, -LIFT)))


@pytest.fixture(scope="module")
def cycle(programme):
    return cams.Cycle(programme.function)


def column(table, name):
    return next(each.data for each in table.columns if each.name == name)


def test_a_flat_face_slides_at_the_cam_speed_times_the_height_of_the_contact(cycle):
    """The cam's point in contact moves along the face with omega times its height above the axis, base radius and lift."""
    speed, follower = 12.0, cams.TranslatingFlat(0.030, 0.0, 0.0, 1)
    track = CamTrack("cam", "", follower, follower.contact)
    piece, angle = cycle.samples()
    table = track.contact_table(cycle, np.zeros(len(angle)), speed, rolls=False)
    height = 0.030 + cycle.at(piece, angle)[1].d0
    assert column(table, "surface_speed") == pytest.approx(speed * height, rel=1e-12)


def test_the_walls_of_a_groove_undercut_on_opposite_sides(cycle):
    """Where the inner wall of a groove tends to a cusp the outer one is hollow: their ratios differ in sign only."""
    follower = cams.TranslatingRound(0.040, 0.008, 0.0, 1)
    inner = CamTrack("cam", "", follower, follower.contact)
    outer = CamTrack("outer wall", "outer.", follower, partial(follower.contact, flank=-1), flank=-1)
    ratios = [column(track.undercut_table(cycle), "ratio") for track in (inner, outer)]
    assert ratios[1] == pytest.approx(-ratios[0], abs=1e-12)
    assert np.max(ratios[0]) == pytest.approx(0.008 / cams.min_pitch_radius(cycle, follower.contact, 1).value, rel=1e-4)


@pytest.mark.parametrize(("base", "reason"), [(0.060, ""), (0.050, "the profile is undercut")])
def test_a_flat_face_on_an_undercut_cam_has_no_pressure(base, reason):
    """A rise h over 1 rad has s'' = -2 pi h sin(2 pi theta): near theta = 3/4 the base radius must exceed 2 pi h less the lift there."""
    law = motion.law("cycloidal")
    steep = (motion.Segment(1.0, law, LIFT), motion.Segment(1.0, law, -LIFT), motion.Segment(2 * np.pi - 2, "dwell"))
    cycle = cams.Cycle(motion.Programme(steep).function)
    assert 0.050 < (2 * np.pi - 0.91) * LIFT < 0.060
    follower = cams.TranslatingFlat(base, 0.0, 0.0, 1)
    assert CamTrack("cam", "", follower, follower.contact).without_pressure(cycle) == reason


def test_a_stiff_train_travels_as_planned_times_the_reach(cycle):
    """At a natural frequency far above the cam's speed the error vanishes: both travels are the reach times the lift."""
    reach, speed, frequency = 2.5, 10.0, 2e4
    response = cams.periodic_response(cycle, reach, speed, frequency, 0.05)
    table = cams.vibration_table(cycle, response, reach, cams.mass_acceleration(response, frequency, 0.05))
    lift = cycle.at(response.piece, response.angle)[1].d0
    assert column(table, "travel") == pytest.approx(reach * lift, abs=1e-12)
    assert column(table, "actual") == pytest.approx(reach * lift, abs=1e-6 * LIFT)
    assert np.max(np.abs(column(table, "actual") - column(table, "travel") - column(table, "error"))) < 1e-15


def test_the_rate_of_the_mass_ahead_is_the_derivative_of_its_deviation():
    time, step = np.linspace(0.0, 1.0, 11), 1e-6

    def swing(t):
        return 0.3 * np.sin(3 * t)

    def ahead(t):
        return 0.02 * np.cos(5 * t)

    def deviation(t):
        return mass_deviation(0.05, swing(t), ahead(t))

    rate = mass_deviation_rate(0.05, swing(time), 0.9 * np.cos(3 * time), ahead(time), -0.1 * np.sin(5 * time))
    assert rate == pytest.approx((deviation(time + step) - deviation(time - step)) / (2 * step), abs=1e-9)
