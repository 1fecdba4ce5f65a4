"""Pins across the pack of plates: closed forms of beams and sections."""

import numpy as np
import pytest

from drivewright.chains.stress.pins import beam, hinge_pin_load, lacing, outline_section, pin_stress, rolling_pin_load, round_section
from drivewright.errors import InputError
from drivewright.scene import Arc, Line, Outline, circle, polygon

pytestmark = pytest.mark.analytical


def test_rolling_pin_of_one_plate_between_two():
    """Plate t in the middle, contact over 3t: M = F/8 (3t - t)."""
    found = beam(*rolling_pin_load(lacing(1, 2, 2e-3), 200.0))
    assert found.moment.max() == pytest.approx(200.0 * (6e-3 - 2e-3) / 8)
    assert found.position[found.moment.argmax()] == pytest.approx(3e-3)
    assert np.abs(found.shear).max() == pytest.approx(200.0 / 3)


def test_the_two_pins_of_a_joint_bend_apart():
    """Plates at -2 and 2 mm pull outside the halves of the contact at -1.5 and 1.5 mm: M = F/2 (1.5 - 2) mm."""
    own, other = (beam(*rolling_pin_load(lacing(*pair, 2e-3), 200.0)) for pair in ((1, 2), (2, 1)))
    assert own.moment.max() > 0
    assert other.moment.min() == pytest.approx(100.0 * -0.5e-3)
    assert other.moment.max() == pytest.approx(0.0, abs=1e-12)


def test_hinge_pin_of_one_plate_between_two():
    """Outer plates pull with F/2 at t, the halves of the middle one at t/4: M = F/2 (t - t/4)."""
    found = beam(*hinge_pin_load(lacing(1, 2, 2e-3), 200.0))
    assert found.moment.max() == pytest.approx(3 * 200.0 * 2e-3 / 8)
    assert np.abs(found.shear).max() == pytest.approx(100.0)


def test_gaps_lengthen_the_arm():
    """A gap g adds F g/2 to the moment of a hinge, and nothing to the shear force."""
    near, far = (beam(*hinge_pin_load(lacing(1, 2, 2e-3, gap), 200.0)) for gap in (0.0, 0.3e-3))
    assert far.moment.max() - near.moment.max() == pytest.approx(100.0 * 0.3e-3)
    assert far.shear.max() == pytest.approx(near.shear.max())


def test_more_plates_bend_less_and_every_beam_is_in_balance():
    moments = []
    for own, other in ((1, 2), (3, 4), (5, 6)):
        for load in (rolling_pin_load, hinge_pin_load):
            breaks, q = load(lacing(own, other, 1.5e-3, 0.1e-3), 300.0)
            found = beam(breaks, q)
            assert abs(found.shear[-1]) < 1e-10
            assert abs(found.moment[-1]) < 1e-12
            assert np.sum(q[q > 0] * np.diff(breaks)[q > 0]) <= 300.0 * (1 + 1e-12)
        moments.append(np.abs(found.moment).max())
    assert np.all(np.diff(moments) < 0)


def test_round_section():
    section, found = round_section(1.2e-3), beam(*rolling_pin_load(lacing(1, 2, 2e-3), 200.0))
    stress = pin_stress(found, section)
    assert stress.bending == pytest.approx(4 * 0.1 / (np.pi * 1.2e-3**3))
    assert stress.shear == pytest.approx(4 / 3 * (200 / 3) / (np.pi * 1.2e-3**2))
    assert stress.mises >= stress.bending


def test_short_stout_pins_shear():
    """At the ends of the middle plate both act: von Mises exceeds bending once the arm is short."""
    stress = pin_stress(beam(*hinge_pin_load(lacing(1, 2, 0.5e-3), 1e3)), round_section(3e-3))
    assert stress.mises == pytest.approx(np.sqrt(3) * stress.shear, rel=0.05)
    assert stress.mises > stress.bending


def test_sections_of_outlines():
    disk, rod = outline_section(circle((3e-3, 1e-3), 1.2e-3)), round_section(1.2e-3)
    assert disk.area == pytest.approx(rod.area, rel=1e-4)
    assert disk.second_moment == pytest.approx(rod.second_moment, rel=3e-4, abs=0)
    assert disk.first_moment.max() == pytest.approx(rod.first_moment.max(), rel=3e-4)
    block = outline_section(polygon([(0, 0), (3e-3, 0), (3e-3, 2e-3), (0, 2e-3)]))
    assert block.second_moment == pytest.approx(2e-3 * 3e-3**3 / 12, rel=1e-6, abs=0)
    assert (block.first_moment / block.width).max() / block.second_moment * block.area == pytest.approx(1.5, rel=1e-3)


def test_rocker_s_segment():
    """Half a disk: I = (pi/8 - 8/(9 pi)) r^4 about its centroid, 4 r/(3 pi) from the flat side."""
    r = 2e-3
    half = outline_section(Outline((Arc((0.0, 0.0), r, -np.pi / 2, np.pi), Line((0.0, r), (0.0, -r)))))
    assert half.second_moment == pytest.approx((np.pi / 8 - 8 / (9 * np.pi)) * r**4, rel=1e-3, abs=0)
    assert -half.offset.min() == pytest.approx(4 * r / (3 * np.pi), rel=1e-3)


def test_messages():
    with pytest.raises(InputError, match="lacing 2 x 2: .* differ by 1, e.g. 1 x 2"):
        lacing(2, 2, 2e-3)
    with pytest.raises(InputError, match="plates -2 mm thick"):
        lacing(1, 2, -2e-3)
    with pytest.raises(InputError, match="has a resultant of 3 N"):
        beam(np.array([0.0, 1.0]), np.array([3.0]))
    with pytest.raises(InputError, match="has a moment of"):
        beam(np.array([0.0, 1.0, 2.0]), np.array([3.0, -3.0]))
    with pytest.raises(InputError, match="radius 0 mm"):
        round_section(0.0)
