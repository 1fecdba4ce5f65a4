"""Meshing of rocker-joint chains: printed values, closed forms, tangency of cutter and flank, what the offset changes and what not."""

import mpmath
import numpy as np
import pytest

from drivewright.chains import meshing as m
from drivewright.chains.link import chordal_rise, design_link, seat_height, seat_support
from drivewright.chains.tooth import base_half_angle, cut_tooth, matching_cutter, modification_for

pytestmark = pytest.mark.analytical

MM = 1e-3
P, Z1, Z2 = 9.525 * MM, 35, 37
GROUPS = {  # r: (A, e, pp2'', delta_p2, arcsin(e/r)) of the published table and of 40-digit arithmetic [mm, deg]
    1.0: (11.525, 0.258794173407, 9.5618221876874, 2.3842028199e-3, 14.9985),
    1.1: (11.725, 0.263285178585, 9.5618635621398, 2.4255772723e-3, 13.8482),
    1.2: (11.925, 0.267776183764, 9.5619049365922, 2.4669517247e-3, 12.8939),
    1.3: (12.125, 0.272267188942, 9.5619463110446, 2.5083261771e-3, 12.0893),
    1.4: (12.325, 0.276758194121, 9.5619876854970, 2.5497006295e-3, 11.4016),
    1.5: (12.525, 0.281249199299, 9.5620290599494, 2.5910750819e-3, 10.8069),
    1.6: (12.725, 0.285740204478, 9.5620704344018, 2.6324495343e-3, 10.2875),
}
ANGLE = np.deg2rad(30)


@pytest.mark.parametrize("radius", GROUPS)
def test_groups_of_the_paper(radius):
    hole, offset, seated, deviation, peak = GROUPS[radius]
    r = radius * MM
    e = m.matching_offset(P, r, Z1)
    assert m.hole_pitch(P, r) == pytest.approx(hole * MM, rel=1e-14)
    assert e == pytest.approx(offset * MM, rel=1e-11)
    assert m.seated_pitch(m.hole_pitch(P, r), r, e, Z2) == pytest.approx(seated * MM, rel=1e-13)
    assert m.pitch_deviation(P, r, e, Z2) == pytest.approx(deviation * MM, rel=1e-10)
    assert np.degrees(np.arcsin(e / r)) == pytest.approx(peak, abs=5e-5)
    assert abs(m.pitch_deviation(P, r, e, Z1)) < 1e-17


def test_constants_of_the_paper():
    assert m.reference_deviation(P, Z1, Z2) == pytest.approx(4.0618538598e-6, rel=1e-10)
    assert m.pitch_constant(Z1, Z2) == pytest.approx(11.46484882912, rel=1e-12)
    assert m.boundary_radius(P, Z1, Z2) == pytest.approx(5.054799380642 * MM, rel=1e-12)
    assert m.monotone_radius(P, Z1) == pytest.approx(4.78174992 * MM, rel=1e-9)
    assert m.ideal_pitch(P, Z1) == pytest.approx(9.563499838727 * MM, rel=1e-12)
    assert m.ideal_pitch(P, Z1, "rack") == pytest.approx(P * np.tan(np.pi / Z1) / (np.pi / Z1), rel=1e-15)
    assert m.minimax_offset(P, 1.2 * MM, Z1, Z2) == pytest.approx(0.260732346 * MM, rel=1e-9)


def test_stable_forms_against_forty_digits():
    with mpmath.workdps(40):
        p, r, e, z = mpmath.mpf("9.525"), mpmath.mpf("1.3"), mpmath.mpf("0.2"), 4001
        t = mpmath.pi / z
        exact = (p + 2 * r) - 2 * (r - e * mpmath.sin(t)) / mpmath.cos(t) - p / mpmath.cos(t)
        u, v = mpmath.pi / 4000, mpmath.pi / 4001
        k = (mpmath.sin(v) * mpmath.cos(u) - mpmath.sin(u) * mpmath.cos(v)) / (mpmath.cos(u) - mpmath.cos(v))
    assert m.pitch_deviation(9.525, 1.3, 0.2, 4001) == pytest.approx(float(exact), rel=1e-13)
    assert m.pitch_constant(4000, 4001) == pytest.approx(float(k), rel=1e-13)


def test_equal_tooth_numbers():
    assert m.reference_deviation(8.0, 40, 40) == 0
    assert m.boundary_radius(8.0, 40, 40) == pytest.approx(4.0124, abs=5e-5)
    assert m.boundary_radius(8.0, 40, 40) == pytest.approx(m.monotone_radius(8.0, 40), rel=1e-14)


def test_deviation_is_proportional_to_the_hole_pitch():
    c1, c2 = np.cos(np.pi / Z1), np.cos(np.pi / Z2)
    factor = 1 - np.tan(np.pi / (2 * Z1)) * m.pitch_constant(Z1, Z2)
    assert factor == pytest.approx(0.4851130454, rel=1e-10)
    for r in (0.3 * MM, 7.4 * MM):
        e = m.matching_offset(P, r, Z1)
        assert e == pytest.approx(0.5 * (P + 2 * r) * np.tan(np.pi / (2 * Z1)), rel=1e-13)
        assert m.pitch_deviation(P, r, e, Z2) == pytest.approx((P + 2 * r) * (c2 - c1) * factor / (c1 * c2), rel=1e-11)
    slope = 2 * (c2 - c1) * factor / (c1 * c2)
    assert slope == pytest.approx(4.1374452e-4, rel=1e-7)
    rise = m.pitch_deviation(P, 2 * MM, m.matching_offset(P, 2 * MM, Z1), Z2) - m.pitch_deviation(P, MM, m.matching_offset(P, MM, Z1), Z2)
    assert rise / MM == pytest.approx(slope, rel=1e-9)


def test_at_the_boundary_radius_the_chain_deviates_by_the_reference():
    r = m.boundary_radius(P, Z1, Z2)
    e = m.matching_offset(P, r, Z1)
    assert m.pitch_deviation(P, r, e, Z2) == pytest.approx(m.reference_deviation(P, Z1, Z2), rel=1e-11)
    assert e / r == pytest.approx(1 / m.pitch_constant(Z1, Z2), rel=1e-12)


def test_at_the_monotone_radius_the_pitch_peaks_at_the_seat():
    r, t = m.monotone_radius(P, Z1), np.pi / Z1
    e, step = m.matching_offset(P, r, Z1), 1e-4
    A = m.hole_pitch(P, r)
    low, high = (m.equivalent_pitch(A, r, e, t + d, 0.0) for d in (-step, step))
    assert abs(high - low) / (2 * step) < 1e-6 * r
    assert m.equivalent_pitch(A, r, e, t, 0.0) > max(low, high)


@pytest.mark.parametrize("ideal", m.IDEALS)
def test_offsets_by_rule(ideal):
    for r in (0.4 * MM, 1.5 * MM):
        assert abs(m.pitch_deviation(P, r, m.matching_offset(P, r, Z2, ideal), Z2, ideal)) < 1e-17
        e = m.minimax_offset(P, r, Z1, Z2, ideal)
        one, two = (m.pitch_deviation(P, r, e, z, ideal) for z in (Z1, Z2))
        assert one == pytest.approx(-two, rel=1e-9) and abs(one) > 1e-7
        seated = m.seated_pitch(m.hole_pitch(P, r), r, e, Z1)
        assert one == pytest.approx(seated - m.ideal_pitch(P, Z1, ideal), rel=1e-8)


# ------------------------------------------------------------------------------------------------------------- cutter and tooth


def sprocket(z, half_angle, e=None, r=1.2 * MM, reference="pitch_line"):
    e = m.matching_offset(P, r, Z1) if e is None else e
    seated = m.seated_pitch(m.hole_pitch(P, r), r, e, z)
    f = m.seated_apothem(m.standard_apothem(2.6 * MM, r, e, ANGLE, reference), P, seated, ANGLE)
    cutter = matching_cutter(P, ANGLE, np.deg2rad(half_angle))
    return seated, f, cutter, m.modification(f, seated, z, ANGLE, *cutter)


def test_group_three_and_its_cutters():
    seated, f, cutter, x = sprocket(35, 30)
    assert f == pytest.approx(3.756447657234 * MM, rel=1e-12)
    assert x == pytest.approx(-1.105074529736, rel=1e-11)
    assert m.positioning_diameter(seated, 35) == pytest.approx(106.6886832989 * MM, rel=1e-12)
    assert m.positioning_diameter(sprocket(37, 30)[0], 37) == pytest.approx(112.750435724 * MM, rel=1e-11)
    assert cut_tooth(35, cutter, x, ANGLE).contact_radius == pytest.approx(49.59688789127 * MM, rel=1e-12)
    printed = {
        (35, 25): -0.475936,
        (37, 25): -0.4206063388,
        (35, 20): 0.114870,
        (37, 20): 0.227164,
        (35, 27): -0.721021,
        (37, 27): -0.686696,
        (35, 31.5): -1.305890,
        (37, 31.5): -1.317714,
    }
    for (z, angle), expected in printed.items():
        assert sprocket(z, angle)[3] == pytest.approx(expected, abs=6e-7)
    assert matching_cutter(P, ANGLE, np.deg2rad(25)).pitch == pytest.approx(9.10164525676 * MM, rel=1e-11)


@pytest.mark.parametrize("z", (35, 37))
def test_the_tooth_is_the_same_for_all_cutters_of_one_base_pitch(z):
    teeth = [cut_tooth(z, c, x, ANGLE) for _, _, c, x in (sprocket(z, angle) for angle in (30, 25, 20, 27, 31.5))]
    for tooth in teeth[1:]:
        assert tooth.base_radius == pytest.approx(teeth[0].base_radius, rel=1e-14)
        assert tooth.support == pytest.approx(teeth[0].support, rel=1e-12)
    for angle in (20, 30):
        _, _, cutter, x = sprocket(z, angle)
        inv = np.tan(cutter.half_angle) - cutter.half_angle
        half = (np.pi / 2 + 2 * x * np.tan(cutter.half_angle)) / z + inv
        assert base_half_angle(teeth[0], ANGLE) == pytest.approx(half, rel=1e-11)


def involute_gap(z, half_angle):
    """Signed distance of points of the real involute from the seated plate's flank line: positive is clear of the plate."""
    _, _, cutter, x = sprocket(z, half_angle)
    tooth, plate = cut_tooth(z, cutter, x, ANGLE), design_link(P, 1.2 * MM, ANGLE, 2.6 * MM)
    n = np.array([np.cos(ANGLE), -np.sin(ANGLE)])
    # involute from the base circle: tooth z clockwise by 2 pi/z, its near flank half a base thickness before its centre line
    start = 2 * np.pi / z - base_half_angle(tooth, ANGLE)  # clockwise from the plate's centre line
    roll = np.linspace(0, 0.7, 20001)
    turn = start + roll
    points = tooth.base_radius * np.stack([np.sin(turn) - roll * np.cos(turn), np.cos(turn) + roll * np.sin(turn)], axis=1)
    line = plate.flank_support + n @ (0, seat_height(plate, z))
    return points @ n - line, np.hypot(*points.T), tooth


@pytest.mark.parametrize("z", (35, 37))
@pytest.mark.parametrize("half_angle", (30, 25, 20, 27, 31.5))
def test_cut_tooth_touches_the_seated_flank_and_nowhere_cuts_it(z, half_angle):
    gap, radius, tooth = involute_gap(z, half_angle)
    assert np.min(gap) > -1e-14
    assert np.min(gap) < 1e-10
    assert radius[np.argmin(gap)] == pytest.approx(tooth.contact_radius, abs=1e-6)


def test_seat_from_the_joint_is_the_seat_of_the_published_measures():
    for z in (35, 37):
        seated, f, cutter, x = sprocket(z, 25)
        plate = design_link(P, 1.2 * MM, ANGLE, 2.6 * MM)
        assert m.seat_of(f, seated, z, ANGLE) == pytest.approx(seat_support(plate, z), rel=1e-12)
        assert modification_for(z, cutter, seat_support(plate, z), ANGLE) == pytest.approx(x, rel=1e-11)


@pytest.mark.parametrize("e", (-0.3, 0.0, 0.1, 0.2678, 0.6))
def test_the_offset_moves_only_the_line_it_is_counted_from(e):
    for z in (35, 37):
        seated, f, _, x = sprocket(z, 30, e * MM)
        reference_seated, reference_f, _, reference_x = sprocket(z, 30)
        assert x == pytest.approx(reference_x, rel=1e-12)
        assert m.seat_of(f, seated, z, ANGLE) == pytest.approx(m.seat_of(reference_f, reference_seated, z, ANGLE), rel=1e-12)
        radius = 0.5 * seated / np.tan(np.pi / z)
        assert radius - e * MM == pytest.approx(seat_height(design_link(P, 1.2 * MM, ANGLE, 2.6 * MM), z), rel=1e-13)
    assert z == 37 and seat_height(design_link(P, 1.2 * MM, ANGLE, 2.6 * MM), 35) == pytest.approx(52.861816829169 * MM, rel=1e-13)


def test_the_other_reading_of_the_apothem_cuts_another_tooth():
    r, e = 1.2 * MM, m.matching_offset(P, 1.2 * MM, Z1)
    assert m.standard_apothem(2.6 * MM, r, e, ANGLE) == pytest.approx(3.773118576423 * MM, rel=1e-12)
    less = m.standard_apothem(2.6 * MM, r, e, ANGLE) - m.standard_apothem(2.6 * MM, r, e, ANGLE, "pin")
    assert less == pytest.approx(0.134 * MM, abs=0.0005 * MM)
    seat = [m.seat_of(f, s, 35, ANGLE) for s, f, _, _ in (sprocket(35, 30), sprocket(35, 30, reference="pin"))]
    assert seat[0] - seat[1] == pytest.approx(less, rel=1e-10)


# ------------------------------------------------------------------------------------------------------------------ joint alone


def test_seated_pins_close_to_a_polygon():
    """Own and neighbour's pins of two seated plates are 2 r apart, along their mean direction."""
    plate, z = design_link(P, 1.2 * MM, ANGLE, 2.6 * MM), 11
    t = np.pi / z
    centre = 1j * seat_height(plate, z)
    right = centre + 0.5 * plate.hole_pitch
    left = (centre - 0.5 * plate.hole_pitch) * np.exp(-2j * t)
    assert right - left == pytest.approx(2 * plate.radius * np.exp(-1j * t), abs=1e-17)


def test_chordal_rise_by_the_path_of_the_strand():
    for r, expected in ((1e-9, 0.213884), (1.2, 0.213993), (7.4, 0.214553)):
        plate = design_link(P, r * MM, ANGLE, 2.6 * MM)
        assert chordal_rise(plate, 35) == pytest.approx(expected * MM, abs=6e-10)
        turn = np.linspace(0, 2 * np.pi / 35, 2001)
        height = seat_height(plate, 35) * np.cos(turn) + 0.5 * plate.hole_pitch * np.sin(turn) - 2 * plate.radius * np.sin(turn / 2)
        assert height[1000] - height[0] == pytest.approx(chordal_rise(plate, 35), rel=1e-9)
        assert -1e-12 < np.ptp(height) - chordal_rise(plate, 35) < 3e-6 * chordal_rise(plate, 35)
        assert height[-1] == pytest.approx(height[0], rel=1e-14)
    hinge = design_link(P, 0.0, ANGLE, 2.6 * MM)
    assert chordal_rise(hinge, 35) == pytest.approx(0.5 * P / np.sin(np.pi / 35) * (1 - np.cos(np.pi / 35)), rel=1e-10)
    assert hinge.pitch == P
