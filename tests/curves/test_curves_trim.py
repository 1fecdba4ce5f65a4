"""Trimmed profiles against closed forms: circles, a corner rounded by the roller, a swallowtail, flat faces."""

import numpy as np
import pytest
import shapely

from drivewright import curves
from drivewright.curves import crossings
from drivewright.curves.outlines import span_measures
from drivewright.errors import InputError
from drivewright.numerics.jets import constant, cos, exp, sin, variable

pytestmark = pytest.mark.analytical

PI = np.pi


def circle_path(radius, center=0.0, sense=1, shape="arc"):
    return (curves.Piece(0.0, 2 * PI, lambda t: center + radius * exp(sense * 1j * variable(t)), "round", shape),)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize(("material", "radius"), [("inside", 0.024), ("outside", 0.036)])
def test_a_roller_on_a_circle_leaves_a_circle(sense, material, radius):
    left = curves.trim(curves.CircleFamily(circle_path(0.03, 0.004 + 0.001j, sense), 0.006, material))
    assert not left.undercut and not left.corners
    assert left.area == pytest.approx(PI * radius**2, rel=1e-13)
    assert left.perimeter == pytest.approx(2 * PI * radius, rel=1e-13)
    (arc,) = left.outline().pieces
    np.testing.assert_allclose([*arc.center, arc.radius, arc.sweep], [0.004, 0.001, radius, 2 * PI], rtol=1e-9)


@pytest.mark.parametrize("sense", [1, -1])
def test_the_sense_is_that_in_which_the_spans_run(sense):
    left = curves.trim(curves.CircleFamily(circle_path(0.03, 0.004 + 0.001j, sense), 0.006, "inside"))
    assert left.sense == sense


def test_chords_that_may_cross_are_all_whose_boxes_meet():
    """Beside every pair, for curves of 2 to 400 chords, upright and level ones among them; touching boxes meet."""
    rng = np.random.default_rng(5)
    for count in (2, 3, 5, 8, 63, 400):
        z = np.cumsum(rng.normal(size=count + 1) + 1j * rng.normal(size=count + 1))
        z[1] = z[0] + 1.0
        a, b = z[:-1], z[1:]
        found = crossings._overlapping(a, b)
        x, y = (np.sort([part(a), part(b)], axis=0) for part in (np.real, np.imag))
        meet = np.all([(low[:, None] <= high) & (low <= high[:, None]) for low, high in (x, y)], axis=0)
        wanted = np.argwhere(np.triu(meet, 1))
        np.testing.assert_array_equal(sorted(zip(*found, strict=True)), [tuple(pair) for pair in wanted])


def test_measures_of_many_spans_are_the_sum_of_each():
    """A wave cut into stretches of unequal length, beside the closed form of its area, (1/2) sum k |c_k|^2 2 pi, and each by itself."""
    ends = np.array([0.0, 0.01, 0.9, 3.0, 2 * PI])
    piece = curves.Piece(0.0, 2 * PI, lambda t: 0.003 + 0.05 * exp(1j * variable(t)) + 0.006 * exp(-4j * variable(t)))
    spans = [curves.Span(piece, a, b) for a, b in zip(ends[:-1], ends[1:], strict=True)]
    area, length = span_measures(spans)
    assert area == pytest.approx(PI * (0.05**2 - 4 * 0.006**2), rel=1e-12)
    each = np.sum([span_measures([span]) for span in spans], axis=0)
    np.testing.assert_allclose([area, length], each, rtol=1e-12)
    back = [curves.Span(piece, span.stop, span.start) for span in reversed(spans)]
    np.testing.assert_allclose(span_measures(back), [-area, length], rtol=1e-12)


def square_path(half):
    """Counter-clockwise square, parameter 0..4."""
    corners = half * np.array([1 - 1j, 1 + 1j, -1 + 1j, -1 - 1j])
    sides = [lambda t, k=k: corners[k] + (corners[(k + 1) % 4] - corners[k]) * (variable(t) - k) for k in range(4)]
    return tuple(curves.Piece(float(k), k + 1.0, side, f"side {k}", "line") for k, side in enumerate(sides))


def test_corners_of_the_path_are_sharp_inside_and_round_outside():
    """The disc on a square path leaves the smaller square inside and the rounded square outside."""
    half, radius = 0.02, 0.003
    inside = curves.trim(curves.CircleFamily(square_path(half), radius))
    assert inside.area == pytest.approx((2 * (half - radius)) ** 2, rel=1e-12)
    assert len(inside.corners) == 4 and len(inside.outline().pieces) == 4
    np.testing.assert_allclose(sorted(abs(corner.point) for corner in inside.corners), np.sqrt(2) * (half - radius), rtol=1e-12)
    outside = curves.trim(curves.CircleFamily(square_path(half), radius, "outside"))
    assert outside.area == pytest.approx(4 * half**2 + 8 * half * radius + PI * radius**2, rel=1e-12)
    assert outside.perimeter == pytest.approx(8 * half + 2 * PI * radius, rel=1e-12)
    assert inside.undercut and not outside.undercut
    assert [type(piece).__name__ for piece in outside.outline().pieces] == ["Line", "Arc"] * 4


def test_lost_motion_at_a_square_corner():
    """With its centre at the corner of the path the roller is sqrt(2) r from the corner that is left: lost (sqrt(2) - 1) r."""
    half, radius = 0.02, 0.003
    left = curves.trim(curves.CircleFamily(square_path(half), radius))
    lost = curves.profile_gap(left, np.array([1.0, 1.0 - 1e-9, 0.5, 0.05]))
    along = 0.05 * 2 * half  # distance of the planned centre from the corner of the path
    corner = (np.sqrt(2) - 1) * radius
    np.testing.assert_allclose(lost, [corner, corner, 0, np.hypot(radius, radius - along) - radius], rtol=1e-6, atol=1e-12)
    place, most = curves.largest_profile_gap(left)
    assert most == pytest.approx((np.sqrt(2) - 1) * radius, rel=1e-9)


def test_the_largest_lost_motion_is_found_off_the_samples():
    """A rectangle, started in the middle of a side, whose sides take equal parameter steps: its corners lie off every sample."""
    a, b, radius = 0.03, 0.011, 0.003
    corners = np.array([-1j * b, a - 1j * b, a + 1j * b, -a + 1j * b, -a - 1j * b])
    sides = tuple(
        curves.Piece(
            float(k), k + 1.0, lambda t, k=k: corners[k] + (corners[(k + 1) % 5] - corners[k]) * (variable(t) - k), f"side {k}", "line"
        )
        for k in range(5)
    )
    place, most = curves.largest_profile_gap(curves.trim(curves.CircleFamily(sides, radius)))
    assert most == pytest.approx((np.sqrt(2) - 1) * radius, rel=1e-3)
    assert min(abs(place - corner) for corner in range(5)) < 1e-4


def ellipse_path(a, b):
    return (curves.Piece(0.0, 2 * PI, lambda t: a * cos(variable(t)) + 1j * b * sin(variable(t)), "ellipse"),)


def test_undercut_of_an_ellipse_begins_at_its_least_radius_of_curvature():
    """Least radius b^2/a = 0.018 m: a roller just under it leaves the whole profile, one just over cuts two tips off on the x axis."""
    a, b = 0.05, 0.03
    assert not curves.trim(curves.CircleFamily(ellipse_path(a, b), 0.0179)).undercut
    for radius in (0.0181, 0.019, 0.024):
        left = curves.trim(curves.CircleFamily(ellipse_path(a, b), radius))
        assert len(left.corners) == 2
        # z = a cos t + i b sin t minus r (b cos t + i a sin t)/w is on the axis where w = sqrt(b^2 cos^2 + a^2 sin^2) = r a/b
        c2 = ((radius * a) ** 2 / b**2 - a**2) / (b**2 - a**2)
        x = np.sqrt(c2) * (a - b**2 / a)
        np.testing.assert_allclose(sorted(corner.point.real for corner in left.corners), [-x, x], rtol=1e-10)
        np.testing.assert_allclose([corner.point.imag for corner in left.corners], 0, atol=1e-15)


def test_the_smallest_swallowtail_is_found():
    """3e-5 beyond the limit the tail is shorter than the usual chord; the corner is exact all the same."""
    a, b = 0.05, 0.03
    radius = b**2 / a * (1 + 3e-5)
    left = curves.trim(curves.CircleFamily((curves.Piece(0.1, 0.1 + 2 * PI, ellipse_path(a, b)[0].at, "ellipse"),), radius))
    assert len(left.corners) == 2
    c2 = ((radius * a) ** 2 / b**2 - a**2) / (b**2 - a**2)
    for corner in left.corners:
        assert abs(np.cos(corner.leaves)) == pytest.approx(np.sqrt(c2), rel=1e-9)
        assert abs(np.cos(corner.resumes)) == pytest.approx(np.sqrt(c2), rel=1e-9)


def test_a_crossing_at_a_joint_counts_once():
    """The path is cut exactly where its envelope crosses itself."""
    a, b, radius = 0.05, 0.03, 0.021
    cut = np.arccos(np.sqrt(((radius * a) ** 2 / b**2 - a**2) / (b**2 - a**2)))
    at = ellipse_path(a, b)[0].at
    whole = curves.trim(curves.CircleFamily(ellipse_path(a, b), radius))
    for ends in ([-cut, cut, 2 * PI - cut], [-cut, 2.0, 2 * PI - cut], [cut, PI - cut, PI + cut, 2 * PI + cut]):
        pieces = tuple(curves.Piece(low, high, at, f"{low:.2f}") for low, high in zip(ends, ends[1:], strict=False))
        left = curves.trim(curves.CircleFamily(pieces, radius))
        assert len(left.crossings) == 2 and len(left.corners) == 2
        assert left.area == pytest.approx(whole.area, rel=1e-12)


def test_an_interval_is_not_lost_for_a_tail_too_small_to_see():
    """Beside the cut tip at t = 0 an invisible tail sits in the middle of the one surviving interval."""
    a, b, c = 0.05, 0.03, -2e-4
    at = lambda t: a * cos(variable(t)) + 1j * b * sin(variable(t)) + c * exp(2j * variable(t))  # noqa: E731
    least = 1 / curves.curvature(at(np.array([PI])))[0]
    for excess in np.geomspace(1e-7, 1e-6, 12):
        left = curves.trim(curves.CircleFamily((curves.Piece(0.0, 2 * PI, at, "egg"),), least * (1 + excess)))
        assert any(abs(corner.point - corner.point.real) < 1e-12 and corner.point.real > 0 for corner in left.corners)


def test_a_tail_below_the_resolution_is_none():
    a, b = 0.05, 0.03
    left = curves.trim(curves.CircleFamily((curves.Piece(0.1, 0.1 + 2 * PI, ellipse_path(a, b)[0].at, "ellipse"),), b**2 / a * (1 + 1e-7)))
    assert not left.crossings and not left.undercut


@pytest.mark.parametrize("tip", [0.012, 0.0149])
def test_measures_follow_a_very_sharp_place(tip):
    """Outer parallel of a path whose three tips turn within a few degrees: area A + L r + pi r^2, length L + 2 pi r (Steiner)."""
    big, radius = 0.03, 0.005
    at = lambda t: big * exp(1j * variable(t)) + tip * exp(-2j * variable(t))  # noqa: E731
    left = curves.trim(curves.CircleFamily((curves.Piece(0.1, 0.1 + 2 * PI, at, "tips"),), radius, "outside"))
    length = np.sum(np.abs(at(np.linspace(0, 2 * PI, 200001)[:-1]).d1)) * 2 * PI / 200000  # trapezoidal: spectral accuracy
    area = PI * (big**2 - 2 * tip**2)
    assert left.area == pytest.approx(area + length * radius + PI * radius**2, rel=1e-11)
    assert left.perimeter == pytest.approx(length + 2 * PI * radius, rel=1e-11)
    outline = left.outline(1e-6)
    assert curves.outline_area(outline) == pytest.approx(left.area, rel=2e-7)


def flat(support, shape="smooth"):
    return (curves.Piece(0.0, 2 * PI, lambda t: (variable(t), support(variable(t))), "flat", shape),)


def test_a_flat_face_round_an_eccentric_circle():
    left = curves.trim(curves.LineFamily(flat(lambda beta: 0.03 + 0.01 * cos(beta))))
    assert not left.undercut
    assert left.area == pytest.approx(PI * 0.03**2, rel=1e-13)


def test_a_flat_face_cuts_where_its_support_bends_too_little():
    """p = R + e cos 2 beta has rho = p + p'' = R - 3 e cos 2 beta < 0 for R < 3 e; the lines +-beta then meet in a tip on the x axis.

    y = p sin beta + p' cos beta = sin beta (R - e - 2 e cos^2 beta) = 0 there, and x = p cos beta - p' sin beta.
    """
    R, e = 0.03, 0.012
    left = curves.trim(curves.LineFamily(flat(lambda beta: R + e * cos(2 * beta))))
    assert len(left.corners) == 2
    c = np.sqrt((R - e) / (2 * e))
    x = (R + e * (2 * c**2 - 1)) * c + 4 * e * c * (1 - c**2)
    np.testing.assert_allclose(sorted(corner.point.real for corner in left.corners), [-x, x], rtol=1e-11)
    beta = np.array([0.0, 0.1])
    np.testing.assert_allclose(curves.profile_gap(left, beta), R + e * np.cos(2 * beta) - x * np.cos(beta), rtol=1e-9)
    assert curves.profile_gap(left, np.array([1.2]))[0] == 0


def test_a_jump_of_velocity_of_a_flat_face_gives_a_straight_piece():
    """Support 1 + 0.2|sin b| (scaled): the velocity jumps up at 0 and pi, where the face leaves straight pieces of length 0.4."""
    up = curves.Piece(0.0, PI, lambda b: (variable(b), 1 + 0.2 * sin(variable(b))), "up")
    down = curves.Piece(PI, 2 * PI, lambda b: (variable(b), 1 - 0.2 * sin(variable(b))), "down")
    left = curves.trim(curves.LineFamily((up, down)))
    assert left.area == pytest.approx(PI + 2 * 0.4, rel=1e-12)
    assert left.perimeter == pytest.approx(2 * PI + 0.8, rel=1e-12)
    assert [type(piece).__name__ for piece in left.outline(1e-4).pieces] == ["Spline", "Line"] * 2


def test_knots_keep_the_chord_tolerance():
    left = curves.trim(curves.CircleFamily(ellipse_path(0.05, 0.03), 0.006))
    for tolerance in (1e-4, 1e-6):
        (spline,) = left.outline(tolerance).pieces
        knots = spline.knots @ (1, 1j)
        middle = 0.5 * (knots[1:] + knots[:-1])
        exact = left.spans[0].piece.at(np.linspace(0, 2 * PI, 30001)).d0
        curve = shapely.LineString(np.stack([exact.real, exact.imag], axis=1))
        sagitta = shapely.distance(shapely.points(middle.real, middle.imag), curve)
        assert 0.3 * tolerance < np.max(sagitta) < tolerance


def test_messages_name_place_and_remedy():
    with pytest.raises(InputError, match="4 mm over the interior point .* Enlarge the base circle"):
        curves.trim(curves.CircleFamily(circle_path(0.006), 0.01))
    with pytest.raises(InputError, match=r"'a' ends at t = 3 and piece 'b' starts at t = 3, 1 mm apart"):
        jump = (
            curves.Piece(0.0, 3.0, lambda t: 0.03 * exp(1j * variable(t)), "a"),
            curves.Piece(3.0, 2 * PI, lambda t: 0.031 * exp(1j * variable(t)), "b"),
        )
        curves.trim(curves.CircleFamily(jump, 0.005))
    with pytest.raises(InputError, match="radius = -0.001 m; it must be positive"):
        curves.CircleFamily(circle_path(0.03), -1e-3)
    with pytest.raises(InputError, match="'nowhere'; it is 'inside' or 'outside'"):
        curves.CircleFamily(circle_path(0.03), 1e-3, "nowhere")
    with pytest.raises(InputError, match="'a' runs from 0 to 1 and the next starts at 2"):
        curves.CircleFamily((curves.Piece(0.0, 1.0, constant, "a"), curves.Piece(2.0, 3.0, constant, "b")), 1e-3)
    with pytest.raises(InputError, match="flagged as an arc but leaves the circle"):
        ellipse = ellipse_path(0.05, 0.04)[0]
        curves.trim(curves.CircleFamily((curves.Piece(0.0, 2 * PI, ellipse.at, "dwell", "arc"),), 0.003)).outline()
