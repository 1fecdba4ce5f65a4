"""Values and findings about plate cams: walls, profiles that are cut away, directions without contact, positions without stiffness."""

import numpy as np
import pytest

from drivewright.indexing.motion import TURN, IndexMotion, index_motion, motion_table
from drivewright.indexing.pin_pressure import contact_force_table
from drivewright.indexing.pin_wheel import PinWheel, profile_findings, sleeve_findings, wall_thicknesses
from drivewright.indexing.stiffness.loading import dwell_angles
from drivewright.indexing.stiffness.result import CARRIED, FREE, WheelStiffness
from drivewright.indexing.stiffness.values import bearing_load_values, stiffness_findings, stiffness_values
from drivewright.indexing.values import contact_findings, motion_values, play_findings, play_values, pressure_angle_values
from drivewright.motion import law

pytestmark = pytest.mark.analytical


def pin_wheel(eccentricity, name="modified-sine", side="inside"):
    return PinWheel(12, 0.12, 8e-3, eccentricity, index_motion(name, 12), side)


def test_motion_values_are_the_peaks_of_the_law():
    motion = IndexMotion(law("cycloidal"), 8, 3.0)
    values = {name: value.value for name, value in motion_values(motion_table(motion, 3001), 3.0, speed=5.0).items()}
    rate, second = TURN / 8 * 2 / 3.0, TURN / 8 * TURN / 9.0  # Vm = 2, Am = 2 pi
    assert values["motion.velocity_factor"] == pytest.approx(rate, rel=1e-6)
    assert values["motion.acceleration_factor"] == pytest.approx(second, rel=1e-6)
    assert values["motion.peak_speed"] == pytest.approx(5 * rate, rel=1e-6)
    assert values["motion.peak_acceleration"] == pytest.approx(25 * second, rel=1e-6)


def test_walls_lie_between_holes_and_on_the_side_of_the_profile():
    inside, outside = (wall_thicknesses(pin_wheel(0.01, side=side), 0.11, 0.07, (0.101, 0.103)) for side in ("inside", "outside"))
    assert inside == pytest.approx((0.04, 0.011)) and outside == pytest.approx((0.04, -0.083))


def test_what_cuts_the_profile_away_is_said():
    assert [*profile_findings(pin_wheel(0.01))] == []
    (cut,) = profile_findings(pin_wheel(0.008))
    assert cut.startswith("the pin radius of 8 mm is not below the eccentricity of 8 mm")
    assert [*profile_findings(pin_wheel(0.0099, "uniform"))] == []
    (loops,) = profile_findings(pin_wheel(0.0105, "uniform"))
    assert "is 1.05, above 1" in loops


def test_a_sleeve_needs_room_around_the_shaft():
    assert [*sleeve_findings(5e-3, 35e-3, 24.9e-3)] == []
    (finding,) = sleeve_findings(5e-3, 35e-3, 25e-3)
    assert "around a shaft of 25 mm (at most 25 mm)" in finding


def test_directions_without_contact():
    angle, best = np.radians([0.0, 10.0, 20.0]), np.array([[0.3, 0.5, 0.4], [np.nan, 0.2, np.nan]])
    (finding,) = contact_findings(angle, best)
    assert finding.startswith("no contact can push a pin backward at 2 of 3 positions (0, 20°)") and finding.endswith("acts forward")
    values = {name: value.value for name, value in pressure_angle_values(np.array([0.3, 0.5, np.nan]), best).items()}
    assert values == {"pressure_angle.maximum": 0.5, "pressure_angle.forward.maximum": 0.5, "pressure_angle.backward.maximum": 0.2}
    assert pressure_angle_values(np.full(2, np.nan), np.full((2, 2), np.nan)) == {}


def test_play_has_no_maximum_where_nothing_stops_the_wheel():
    angle, rotations = np.radians([0.0, 10.0, 20.0]), {"forward": np.array([0.0, 3e-3, 1e-3]), "backward": np.array([0.0, np.nan, 0.0])}
    values = {name: value.value for name, value in play_values(angle, rotations, 0.12).items()}
    assert values == {"play.forward.maximum": 3e-3, "play.forward.maximum.at": pytest.approx(np.radians(10.0))}
    (finding,) = play_findings(angle, rotations)
    assert finding.startswith("no contact stops the wheel backward at 1 of 3 input angles (10°)")


def wheel_under_torque(outcome, rotation):
    p = len(outcome)
    return WheelStiffness(np.zeros(p), 100.0, "unilateral", outcome, np.array(rotation), np.full(p, np.nan), (), {}, 1)


def test_stiffness_is_that_of_the_positions_that_carry():
    angle = np.radians([0.0, 10.0, 20.0, 30.0])
    found = wheel_under_torque((CARRIED, FREE, CARRIED, FREE), [1e-3, np.nan, 2e-3, np.nan])
    values = {name: value.value for name, value in stiffness_values(angle, found).items()}
    assert values == {
        "stiffness.undefined_fraction": 0.5,
        "stiffness.mean": pytest.approx(75e3),
        "stiffness.minimum": pytest.approx(50e3),
        "stiffness.minimum.at": pytest.approx(np.radians(20.0)),
        "stiffness.maximum": pytest.approx(100e3),
        "stiffness.range": pytest.approx(50e3),
    }
    after = wheel_under_torque((CARRIED, CARRIED, CARRIED, FREE), [1e-3, 1e-3, 2e-3, np.nan])
    (finding,) = stiffness_findings(angle, found, after)
    assert finding.startswith("no stiffness at 2 of 4 input angles (10, 30°) against 100 N·m")
    assert "At 1 of them a contact carries it after the play" in finding


def test_loads_without_a_rating_have_no_life():
    forces = {"crank.left": np.array([3 + 4j, np.nan, 1j]), "crank.right": np.array([-6.0 + 0j, np.nan, 1.0])}
    assert {name: value.value for name, value in bearing_load_values("crank", forces).items()} == {"crank.max_load": 6.0}


def test_dwell_angles_lie_inside_the_dwell_in_equal_steps():
    angles = dwell_angles(IndexMotion(law("modified-sine"), 12, 4.0), 0.25)
    assert (
        len(angles) == 9 and angles[0] == pytest.approx(4.0 + (TURN - 4.0) / 10) and angles[-1] == pytest.approx(TURN - (TURN - 4.0) / 10)
    )
    assert all(len(dwell_angles(IndexMotion(law("modified-sine"), 12, angle), 0.25)) == 0 for angle in (TURN - 0.2, TURN))


def test_segments_by_number_are_those_of_the_law_and_a_dwell():
    """An array of numbers gives what each number gives alone: the law's own pieces, and rest at the level reached."""
    motion, turn = IndexMotion(law("modified-sine"), 12, 4.0), np.array([0.0, 3.0, 5.0, 2.0, 7.0])
    middles = np.array([0.5 * (segment.start + segment.stop) for segment in motion.segments])
    numbers = np.arange(len(middles))
    jet = motion.on_segment(numbers, middles, turn[: len(middles)])
    for k, number in enumerate(numbers):
        np.testing.assert_allclose([part[k] for part in jet], [float(part) for part in motion.on_segment(int(number), middles[k], turn[k])])
    s, v, a, j = motion.law(middles[:-1] / 4.0)
    np.testing.assert_allclose(jet.d0, motion.pitch * (turn[: len(middles)] + [*s, 1.0]), rtol=1e-14)
    for part, d, k in ((jet.d1, v, 1), (jet.d2, a, 2), (jet.d3, j, 3)):
        np.testing.assert_allclose(part, motion.pitch * np.array([*d, 0.0]) / 4.0**k, rtol=1e-13, atol=1e-15)


def test_a_segment_is_one_sided_at_its_ends():
    """Beyond its ends a segment stays at them: before the dwell phi is that of the law's last piece, after its start that of rest."""
    motion = IndexMotion(law("modified-trapezoid"), 12, 4.0)
    last = len(motion.segments) - 2
    jet = motion.on_segment(np.array([last, last + 1]), np.array([4.0, 4.0]))
    np.testing.assert_allclose(jet.d0, motion.pitch, rtol=1e-14)
    np.testing.assert_allclose(jet.d1, 0, atol=1e-12)
    assert abs(jet.d3[0]) > 1e-3 and jet.d3[1] == 0


def test_a_table_of_forces_has_the_columns_that_it_is_given():
    rows = [(0.1, 2.0, 30.0, 0.05, 4e8), (0.2, 3.0, 40.0, 0.06, np.nan)]
    columns = ("angle", "pin", "force", "arm", "pressure")
    table = contact_force_table("forces", "Forces", columns, rows, {"pin": "pin of the wheel"}, missing="a corner")
    assert [(c.name, c.unit) for c in table.columns] == [("angle", "rad"), ("pin", "-"), ("force", "N"), ("arm", "m"), ("pressure", "Pa")]
    assert [c.meaning for c in table.columns][:3] == ["input angle", "pin of the wheel", "force on the roller"]
    np.testing.assert_array_equal([c.data for c in table.columns], np.transpose(rows))
    assert (table.name, table.title, table.missing) == ("forces", "Forces", "a corner")
    assert all(len(c.data) == 0 for c in contact_force_table("forces", "Forces", columns, []).columns)
