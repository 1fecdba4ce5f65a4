"""Programmes: segments on a cycle, joints, one-sided pieces, tables, other driving angles."""

import dataclasses
import math
import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose

from drivewright.motion import Programme, Segment, compose_motion, law
from drivewright.numerics import jets

pytestmark = pytest.mark.analytical

DEG = math.pi / 180
TURN = 2 * math.pi


def pusher(rise_law="polynomial-345", lift=0.018):
    """Rest to 65 deg, push until 86, dwell until 87, back until 123, rest."""
    return Programme(
        [
            Segment(65 * DEG, "dwell"),
            Segment(21 * DEG, rise_law, lift),
            Segment(DEG, "dwell"),
            Segment(36 * DEG, law(rise_law), -lift),
            Segment(237 * DEG, "dwell"),
        ]
    )


def test_lift_and_derivatives_in_closed_form():
    programme, width = pusher(), 21 * DEG
    w = np.array([0.03, 0.31, 0.5, 0.88])
    motion = programme(65 * DEG + w * width)
    assert_allclose(motion.s, 0.018 * (10 * w**3 - 15 * w**4 + 6 * w**5), rtol=1e-9)
    assert_allclose(motion.v, 0.018 * 30 * w**2 * (1 - w) ** 2 / width, rtol=1e-9)
    assert_allclose(motion.a, 0.018 * 60 * w * (1 - w) * (1 - 2 * w) / width**2, rtol=1e-9, atol=1e-9)
    assert_allclose(motion.j, 0.018 * 60 * (1 - 6 * w + 6 * w**2) / width**3, rtol=1e-9)
    back = programme((87 + 36 * w) * DEG)
    assert_allclose(back.s, 0.018 - motion.s, rtol=1e-9, atol=1e-12)
    assert_allclose(back.v, -motion.v * 21 / 36, rtol=1e-9)


def test_levels_and_dwells():
    programme = pusher()
    assert_allclose(programme.levels, (0, 0, 0.018, 0.018, 0, 0), atol=1e-17)
    assert programme(86.5 * DEG)[1:] == programme(0.3)[1:] == (0, 0, 0)
    assert_allclose((programme(86.5 * DEG).s, programme(300 * DEG).s), (0.018, 0), atol=1e-17)


def test_the_angle_is_taken_modulo_the_cycle():
    programme, theta = pusher(), np.array([66.0, 80.0, 95.0, 350.0]) * DEG
    for turns in (-2, 1, 3):
        for here, there in zip(programme(theta), programme(theta + turns * TURN), strict=True):
            assert_allclose(there, here, rtol=1e-9, atol=1e-12)


def test_another_cycle_scales_the_derivatives():
    short = Programme([Segment(0.3, "cycloidal", 2.0), Segment(0.7, "cycloidal", -2.0)], cycle=1.0)
    long = Programme([Segment(1.5, "cycloidal", 0.5), Segment(3.5, "cycloidal", -0.5)], cycle=5.0)
    x = np.linspace(0, 0.999, 47)
    for order, (a, b) in enumerate(zip(short(x), long(5 * x), strict=True)):
        assert_allclose(b, a * 0.25 / 5**order, rtol=1e-9, atol=1e-10)
    assert_allclose(short(3.4), short(0.4), rtol=1e-12)


def test_pieces_split_the_cycle_at_breaks_and_name_segment_and_phase():
    programme = pusher("parabolic")
    assert_allclose([piece.theta0 / DEG for piece in programme.pieces], (0, 65, 75.5, 86, 87, 105, 123), rtol=1e-12)
    assert [piece.theta1 for piece in programme.pieces] == [*(piece.theta0 for piece in programme.pieces[1:]), TURN]
    assert [piece.segment for piece in programme.pieces] == [0, 1, 1, 2, 3, 3, 4]
    assert [piece.phase for piece in programme.pieces] == ["dwell", "rise", "rise", "dwell", "return", "return", "dwell"]


def test_on_piece_speaks_one_sidedly_at_a_jump_of_acceleration():
    programme, jump = pusher("parabolic"), 4 * 0.018 / (21 * DEG) ** 2
    middle = programme.pieces[1].theta1
    sides = (programme.on_piece(1, middle).a, programme.on_piece(2, middle).a, programme(middle).a)
    assert_allclose(sides, (jump, -jump, -jump), rtol=1e-12)
    assert_allclose(programme.on_piece(0, programme.pieces[0].theta1).a, 0)
    assert_allclose(programme.on_piece(6, TURN).s, 0, atol=1e-17)


def test_on_piece_takes_arrays_of_pieces():
    programme = pusher("modified-trapezoid")
    k = np.array([[1, 2], [5, 9]])
    theta = programme.breaks[k] * 0.4 + programme.breaks[k + 1] * 0.6
    both = programme.on_piece(k, theta)
    assert both.v.shape == k.shape
    assert_allclose([part[1, 0] for part in both], programme.on_piece(5, theta[1, 0]), rtol=1e-13)
    assert_allclose(both, programme(theta), rtol=1e-13)


def test_joints_of_a_smooth_programme_report_the_jerk_only():
    joints = pusher().joints()
    jerk_up, jerk_down = 60 * 0.018 / (21 * DEG) ** 3, 60 * 0.018 / (36 * DEG) ** 3
    assert_allclose([joint.angle / DEG for joint in joints], (0, 65, 86, 87, 123), rtol=1e-12)
    assert all(joint[1:4] == (0, 0, 0) for joint in joints)
    assert_allclose([joint.dj for joint in joints], (0, jerk_up, -jerk_up, -jerk_down, jerk_down), rtol=1e-10)
    assert pusher().continuity == 2


def test_joints_report_jumps_of_acceleration_and_velocity_where_they_are():
    joints = pusher("parabolic").joints()
    up, down = 4 * 0.018 / (21 * DEG) ** 2, 4 * 0.018 / (36 * DEG) ** 2
    assert_allclose([joint.da for joint in joints], (0, up, up, -down, -down), rtol=1e-12)
    assert all(joint.dv == 0 for joint in joints)
    joints = pusher("uniform").joints()
    assert_allclose([joint.dv for joint in joints], np.array([0, 1 / 21, -1 / 21, -1 / 36, 1 / 36]) * 0.018 / DEG, rtol=1e-12)


def test_the_wrap_around_is_a_joint_too():
    """Harmonic up in 140 deg and down in 220, no dwell: a jumps by pi^2 h/2 (1/b1^2 - 1/b2^2) at both ends."""
    h, up, down = 0.01, 140 * DEG, 220 * DEG
    joints = Programme([Segment(up, "simple-harmonic", h), Segment(down, "simple-harmonic", -h)]).joints()
    jump = math.pi**2 * h / 2 * (1 / up**2 - 1 / down**2)
    assert_allclose([joint.da for joint in joints], (jump, jump), rtol=1e-12)
    assert [joint.dv for joint in joints] == [0, 0]


def test_a_small_jump_is_no_rounding():
    up, down = 180.001 * DEG, 179.999 * DEG
    joints = Programme([Segment(up, "simple-harmonic", 0.01), Segment(down, "simple-harmonic", -0.01)]).joints()
    assert_allclose([joint.da for joint in joints], math.pi**2 * 0.005 * (1 / up**2 - 1 / down**2), rtol=1e-9)


def test_angles_that_fill_the_cycle_but_for_rounding():
    programme = Programme([Segment(2.0, "cycloidal", 0.01), Segment(2.0, "cycloidal", -0.01), Segment(TURN - 4 - 1e-10, "dwell")])
    assert programme.pieces[-1].theta1 == TURN == programme.starts[-1]
    assert all(joint.ds == 0 for joint in programme.joints())


def test_harmonic_up_and_down_in_equal_angles_is_an_eccentric_without_any_joint():
    programme = Programme([Segment(math.pi, "simple-harmonic", 0.02), Segment(math.pi, "simple-harmonic", -0.02)])
    theta = np.linspace(0, TURN, 37)
    s, v, a, j = programme(theta)
    assert_allclose(s, 0.01 * (1 - np.cos(theta)), atol=1e-16)
    assert_allclose((v, a, j), 0.01 * np.array([np.sin(theta), np.cos(theta), -np.sin(theta)]), atol=1e-15)
    assert all(joint[1:] == (0, 0, 0, 0) for joint in programme.joints()) and programme.continuity == 6


def test_a_table_over_the_whole_cycle_is_periodic_and_absolute():
    angle = np.linspace(0, TURN, 121)
    programme = Programme([Segment(TURN, law("table", angle=angle, lift=0.03 + 0.01 * np.sin(angle + 0.7)))])
    theta = np.array([0.0, 0.013, 1.7, 4.4, TURN - 1e-9])
    assert_allclose(programme(theta).s, 0.03 + 0.01 * np.sin(theta + 0.7), atol=1e-12)
    assert_allclose(programme(theta).j, -0.01 * np.cos(theta + 0.7), atol=1e-6)
    assert programme.joints()[0][1:] == (0, 0, 0, 0) and programme.continuity == 4
    assert {piece.phase for piece in programme.pieces} == {"rise", "return"}
    top = 0.5 * math.pi - 0.7
    assert all(piece.phase == "rise" for piece in programme.pieces if piece.theta1 < top - 0.06)


def test_a_fine_table_is_as_smooth_as_its_spline():
    """Lifts are known to 1e-16; four derivatives over steps of a quarter degree magnify that 1e12-fold, which is no jump."""
    angle = np.linspace(0, TURN, 1441)
    lift = 0.03 + 0.01 * np.sin(angle + 0.7)
    lift[-1] += 1e-12  # the same row but for rounding
    table = law("table", angle=angle, lift=lift)
    assert table.continuity == 4
    assert_allclose(table.peaks()[:3], 0.01 * TURN ** np.arange(1, 4), rtol=1e-3)


def test_a_table_over_part_of_the_cycle_starts_and_ends_at_rest():
    rise, width = law("polynomial-4567"), 100 * DEG
    u = np.linspace(0, 1, 81)
    table = law("table", angle=width * u, lift=0.005 + 0.01 * rise(u).s)
    programme = Programme([Segment(width, table), Segment(60 * DEG, "dwell"), Segment(200 * DEG, "cycloidal", -0.01)])
    assert_allclose(programme.levels, (0.005, 0.015, 0.015, 0.005), rtol=1e-12)
    assert_allclose(programme(0.37 * width).s, 0.005 + 0.01 * rise(0.37).s, rtol=1e-9)
    assert all(joint[1:4] == (0, 0, 0) for joint in programme.joints())


def test_a_table_may_follow_at_the_level_that_is_there():
    table = law("table", angle=np.linspace(0, 2, 30), lift=0.01 * (1 - law("cycloidal")(np.linspace(0, 1, 30)).s))
    programme = Programme([Segment(2.0, "cycloidal", 0.01), Segment(2.0, table), Segment(TURN - 4, "dwell")])
    assert_allclose(programme(3.0).s, 0.005, rtol=1e-6)


def test_a_closed_spline_law_swings_about_the_level():
    u = np.linspace(0, 1, 61)
    swing = law("spline", points=np.column_stack([u, np.cos(TURN * u)]), ends="periodic")
    programme = Programme([Segment(TURN, swing, rise=0.1)])
    assert_allclose(programme(1.0).s, 0.1 * (math.cos(1.0) - 1), rtol=1e-7)
    assert programme.continuity == 4


def test_chain_rule_in_closed_form():
    """theta = t^2 on s = (1 - cos theta)/2."""
    programme = Programme([Segment(math.pi, "simple-harmonic", 1), Segment(math.pi, "simple-harmonic", -1)])
    t = np.array([0.2, 0.9, 1.7, 2.4])
    s, v, a, j = compose_motion(programme, jets.variable(t) ** 2)
    sine, cosine = np.sin(t**2), np.cos(t**2)
    assert_allclose(s, (1 - cosine) / 2, atol=1e-14)
    assert_allclose(v, t * sine, atol=1e-13)
    assert_allclose(a, sine + 2 * t**2 * cosine, atol=1e-12)
    assert_allclose(j, 6 * t * cosine - 4 * t**3 * sine, atol=1e-11)


def elliptic(t):
    """A non-uniform but periodic map: t + 0.3 sin t + 0.1 cos 2t, over the pusher's working range and beyond."""
    t = jets.variable(t)
    return t + 0.3 * jets.sin(t) + 0.1 * jets.cos(2 * t)


def test_driven_by_a_non_uniform_angle_against_differences():
    programme, h = pusher("modified-sine"), 1e-4

    def driven(t):
        return compose_motion(programme, elliptic(t))

    t = np.array([1.02, 1.09, 1.17, 1.33, 1.52])
    here, stencil = driven(t), np.array([1, -8, 8, -1]) / (12 * h)
    around = [driven(t + step * h) for step in (-2, -1, 1, 2)]
    for order in range(3):
        slope = sum(weight * motion[order] for weight, motion in zip(stencil, around, strict=True))
        assert_allclose(here[order + 1], slope, rtol=1e-7, atol=1e-9 * np.max(np.abs(here[order + 1])))


def test_one_piece_driven_keeps_its_side_of_a_jump():
    programme = pusher("parabolic")
    edge = programme.pieces[1].theta1
    jet = jets.Jet(edge, 2.0, 0.5, 0.0)
    left, right = (compose_motion(lambda x, k=k: programme.on_piece(k, x), jet) for k in (1, 2))
    v, a = programme.on_piece(1, edge)[1:3]
    assert_allclose((left.a, right.a), (a * 4 + v * 0.5, -a * 4 + v * 0.5), rtol=1e-12)


def test_a_programme_survives_pickling():
    programme = pusher()
    copy = pickle.loads(pickle.dumps(programme))
    assert dataclasses.replace(copy.segments[0], angle=1.0).angle == 1.0  # still known to be a dwell
    assert copy(1.3) == programme(1.3) and copy.pieces == programme.pieces
    assert Programme([*copy.segments])(1.3) == programme(1.3)
    assert compose_motion(copy, elliptic(1.3)) == compose_motion(programme, elliptic(1.3))


@pytest.mark.parametrize("name", ["polynomial-56789", "modified-trapezoid", "double-harmonic"])
def test_a_return_is_the_rise_upside_down(name):
    programme = Programme([Segment(1.1, name, 0.02), Segment(1.1, name, -0.02), Segment(TURN - 2.2, "dwell")])
    x = np.linspace(0.01, 1.09, 23)
    up, down = programme(x), programme(1.1 + x)
    assert_allclose(up.s + down.s, 0.02, rtol=1e-12)
    for a, b in zip(up[1:], down[1:], strict=True):
        assert_allclose(b, -a, rtol=1e-9, atol=1e-9 * np.max(np.abs(a)))
