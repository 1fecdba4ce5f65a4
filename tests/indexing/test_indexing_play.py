"""Play of the pin wheel: the sheet's numbers, the mirror theorem, and a test of penetration of its own with shapely."""

from functools import cache

import numpy as np
import pytest
import shapely

from drivewright.curves.touching import touches
from drivewright.indexing import play
from drivewright.indexing.motion import index_motion
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.plane import find_contacts
from drivewright.indexing.play import BACKWARD, FORWARD, find_play

pytestmark = pytest.mark.property

ARCMIN = np.deg2rad(1 / 60)


@cache
def wheel(pin_radius=8e-3, law="modified-sine", ratio=1.0, scale=1.0, side="inside"):
    return PinWheel(12, 0.12 * scale, pin_radius * scale, 0.01 * scale, index_motion(law, 12, ratio), side)


@cache
def cam(drive):
    points = np.concatenate([span.piece.at(np.linspace(span.start, span.stop, 3000)).d0 for span in drive.profile.spans])
    return shapely.Polygon(np.stack([points.real, points.imag], axis=1))


def depth(drive, theta, turned):
    """How deep the pins are in the cam when the wheel is off its place [m], by shapely."""
    centres = drive.pin_centres(theta).d0 * np.exp(1j * turned) - drive.crank_vector(theta).d0
    return drive.pin_radius - np.min(shapely.distance(cam(drive), shapely.points(np.stack([centres.real, centres.imag], axis=1))))


@pytest.mark.parametrize(("angle", "arcmin"), [(9.0, 80.6), (13.5, 111.68), (18.0, 75.0), (27.0, 21.5)])
def test_play_of_the_sheet(angle, arcmin):
    assert find_play(wheel(), np.deg2rad(angle), FORWARD)[0] / ARCMIN == pytest.approx(arcmin, abs=0.7 if angle != 13.5 else 0.02)
    assert find_play(wheel(), np.deg2rad(angle), BACKWARD)[0] < 1e-6


def test_nothing_is_loose_where_pins_press_from_both_sides():
    theta = np.deg2rad([40.0, 61.0, 90.0, 119.0, 140.0, 200.0, 270.0, 350.0])
    for direction in (FORWARD, BACKWARD):
        np.testing.assert_allclose(find_play(wheel(), theta, direction), 0, atol=1e-6)


def test_forward_is_the_mirror_image_of_backward():
    """For a symmetric law forward(theta) = backward(theta_h - theta) where theta_h is a whole number of pitches."""
    for drive in (wheel(), wheel(9e-3, "modified-sine", 2.0)):
        theta = np.linspace(0.02, 0.98, 29) * drive.motion.motion_angle
        forward, backward = find_play(drive, theta, FORWARD), find_play(drive, drive.motion.motion_angle - theta, BACKWARD)
        assert np.max(forward) > 5 * ARCMIN
        np.testing.assert_allclose(forward, backward, atol=1e-9)


def test_play_is_an_angle_and_knows_no_unit_of_length():
    theta = np.deg2rad([11.0, 14.0, 23.0])
    np.testing.assert_allclose(find_play(wheel(), theta, FORWARD), find_play(wheel(scale=2.5), theta, FORWARD), rtol=1e-6)


@pytest.mark.parametrize(
    ("angle", "direction"), [(9.0, 1), (13.5, 1), (20.0, 1), (27.0, 1), (158.0, -1), (150.0, -1), (60.0, 1), (250.0, -1)]
)
def test_nothing_penetrates_before_and_something_does_just_after(angle, direction):
    drive, theta = wheel(), np.deg2rad(angle)
    free = find_play(drive, theta, direction)[0]
    before = [depth(drive, theta, direction * turned) for turned in np.linspace(0, free, 25)]
    assert max(before) < 2e-7
    assert depth(drive, theta, direction * (free + 0.5 * ARCMIN)) > 5e-7


def test_the_wheel_rests_on_a_pin_after_its_play():
    drive, theta = wheel(), np.deg2rad(20.0)
    free = find_play(drive, theta, FORWARD)[0]
    found = find_contacts(drive, theta, reach=1e-4, turned=free)
    stopping = found.arm < 0
    assert np.min(found.gap[stopping]) < 1e-9 and not found.intended.any()


def test_pins_around_the_cam_and_inside_it_have_alike_play():
    theta = np.deg2rad(np.arange(0.0, 360.0, 6.0))
    outer = find_play(wheel(side="outside"), theta, FORWARD)
    assert np.max(outer) > ARCMIN and np.all(outer[theta > np.pi] < 1e-6)


def test_a_uniform_wheel_has_no_play():
    drive = PinWheel(12, 0.12, 8e-3, 4e-3, index_motion("uniform", 12))
    theta = np.deg2rad(np.arange(0.0, 360.0, 7.0))
    for direction in (FORWARD, BACKWARD):
        np.testing.assert_allclose(find_play(drive, theta, direction), 0, atol=0.01 * ARCMIN)


def test_thin_pins_hold_both_ways():
    theta = np.deg2rad(np.arange(0.0, 360.0, 3.0))
    for direction in (FORWARD, BACKWARD):
        assert np.max(find_play(wheel(4.5e-3), theta, direction)) < 0.1 * ARCMIN


@pytest.mark.parametrize("angle", [9.0, 13.5, 17.0, 22.0, 25.0])
@pytest.mark.parametrize("direction", [FORWARD, BACKWARD])
def test_the_pin_asked_first_changes_nothing(direction, angle):
    """And the pin named touches the cam exactly, and is inside it just after, by shapely."""
    drive, theta = wheel(), np.deg2rad(angle if direction == FORWARD else 180.0 - angle)
    centres, crank = drive.pin_centres(theta).d0, complex(drive.crank_vector(theta).d0)
    work = np.empty(play.CAPACITY, complex), np.empty(play.CAPACITY)
    for likely in range(12):
        free, pin = play.free_rotation(drive.nodes, centres, crank, 8e-3, direction, drive.motion.pitch, likely, *work)
        assert free == pytest.approx(find_play(drive, theta, direction)[0], abs=1e-11)
        at = centres[pin] * np.exp(1j * direction * free) - crank
        assert np.min(np.abs(touches(drive.nodes, [at], 8e-3, 1e-6).gap)) < 1e-13
        after = centres[pin] * np.exp(1j * direction * (free + 0.1 * ARCMIN)) - crank
        assert shapely.distance(cam(drive), shapely.Point(after.real, after.imag)) < 8e-3 - 1e-7


def test_no_play_within_less_than_the_play():
    """A pin is inside the cam at every rotation a little beyond the play and at none before it."""
    drive, theta = wheel(), np.deg2rad(20.0)
    centres, crank = drive.pin_centres(theta).d0, complex(drive.crank_vector(theta).d0)
    free = find_play(drive, theta, FORWARD)[0]
    work = np.empty(play.CAPACITY, complex), np.empty(play.CAPACITY)
    for part, inside in ((0.0, False), (0.5, False), (1 - 1e-6, False), (1.0002, False), (1.02, True), (1.05, True)):
        pin = play.pin_within_cam(drive.nodes, centres, crank, 8e-3, FORWARD, part * free, 3, *work)
        assert (pin >= 0) == inside
        assert inside == (depth(drive, theta, part * free) > 5e-7)


def test_nothing_stops_a_wheel_within_less_than_its_play():
    drive, theta = wheel(), np.deg2rad(20.0)
    centres, crank = drive.pin_centres(theta).d0, complex(drive.crank_vector(theta).d0)
    free = find_play(drive, theta, FORWARD)[0]
    work = np.empty(play.CAPACITY, complex), np.empty(play.CAPACITY)
    for limit in (0.3 * free, 0.999 * free):
        assert np.isnan(play.free_rotation(drive.nodes, centres, crank, 8e-3, FORWARD, limit, 0, *work)[0])
    assert play.free_rotation(drive.nodes, centres, crank, 8e-3, FORWARD, 1.001 * free, 0, *work)[0] == pytest.approx(free, abs=1e-11)
