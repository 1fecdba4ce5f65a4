"""Measures and parallel outlines of outlines against closed forms."""

import numpy as np
import pytest
import shapely

from drivewright import curves
from drivewright.errors import InputError
from drivewright.numerics.jets import cos, exp, sin, variable
from drivewright.scene import Arc, Line, Outline, circle, polygon

pytestmark = pytest.mark.analytical

PI = np.pi


def ellipse(a=0.05, b=0.03):
    piece = curves.Piece(0.0, 2 * PI, lambda t: a * cos(variable(t)) + 1j * b * sin(variable(t)), "ellipse")
    return curves.outline_of_spans([curves.Span(piece, 0.0, 2.2), curves.Span(piece, 2.2, 2 * PI)], 1e-6)


def slot(length=0.04, radius=0.01):
    """A rounded bar: two lines and two true half circles."""
    return Outline(
        (
            Line((0, -radius), (length, -radius)),
            Arc((length, 0), radius, -PI / 2, PI),
            Line((length, radius), (0, radius)),
            Arc((0, 0), radius, PI / 2, PI),
        )
    )


def test_area_and_length_of_true_arcs_and_lines():
    assert curves.outline_area(slot()) == pytest.approx(0.04 * 0.02 + PI * 1e-4, rel=1e-14)
    assert curves.perimeter(slot()) == pytest.approx(0.08 + 2 * PI * 0.01, rel=1e-14)
    assert curves.outline_area(circle((0.3, -0.2), 0.05)) == pytest.approx(PI * 0.0025, rel=1e-13)
    assert curves.outline_area(polygon([(0, 0), (0, 1), (2, 0)])) == -1.0


def test_splines_are_measured_between_their_knots():
    """Area and length to the power four of the knot distance, far better than the chords."""
    outline = ellipse()
    assert curves.outline_area(outline) == pytest.approx(PI * 0.05 * 0.03, rel=1e-9)
    assert curves.perimeter(outline) == pytest.approx(0.25526998863398124, rel=1e-9)  # 4 a E(m), m = 1 - b^2/a^2
    assert abs(shapely.Polygon(outline.points()).area / (PI * 0.05 * 0.03) - 1) > 1e-7


@pytest.mark.parametrize("distance", [0.004, -0.004])
def test_offset_of_arcs_and_lines_stays_true(distance):
    path = curves.offset_outline(slot(), distance)
    assert [type(piece) for piece in path.pieces] == [Line, Arc, Line, Arc]
    radius = 0.01 + distance
    assert curves.outline_area(path) == pytest.approx(0.04 * 2 * radius + PI * radius**2, rel=1e-13)
    np.testing.assert_allclose(path.pieces[0], [(0, -radius), (0.04, -radius)], atol=1e-15)


@pytest.mark.parametrize("distance", [0.006, -0.006])
def test_offset_of_a_spline_follows_steiner(distance):
    """Area A + L d + pi d^2 and length L + 2 pi d of a parallel to a convex curve."""
    path = curves.offset_outline(ellipse(), distance)
    area, length = PI * 0.05 * 0.03, 0.25526998863398124
    assert curves.outline_area(path) == pytest.approx(area + length * distance + PI * distance**2, rel=1e-7)
    assert curves.perimeter(path) == pytest.approx(length + 2 * PI * distance, rel=1e-7)


def test_outer_corners_are_rounded_and_the_sense_of_the_outline_does_not_matter():
    square = [(0, 0), (0.02, 0), (0.02, 0.02), (0, 0.02)]
    for corners in (square, square[::-1]):
        path = curves.offset_outline(polygon(corners), 0.005)
        assert abs(curves.outline_area(path)) == pytest.approx(0.02**2 + 4 * 0.02 * 0.005 + PI * 0.005**2, rel=1e-13)
        assert sum(isinstance(piece, Arc) for piece in path.pieces) == 4


def test_cam_profile_with_a_sharp_corner():
    """An undercut profile keeps its corner: the tool path goes round it by an arc of the cutter's radius."""
    piece = curves.Piece(0.0, 2 * PI, lambda t: 0.05 * cos(variable(t)) + 0.03j * sin(variable(t)), "ellipse")
    outline = curves.trim(curves.CircleFamily((piece,), 0.022)).outline(1e-7)
    path = curves.offset_outline(outline, 0.004)
    arcs = [piece for piece in path.pieces if isinstance(piece, Arc)]
    assert len(arcs) == 2 and all(arc.radius == 0.004 for arc in arcs)
    turn = sum(arc.sweep for arc in arcs)
    area, length = curves.outline_area(outline), curves.perimeter(outline)
    assert 0 < turn < 2 * PI
    assert curves.outline_area(path) == pytest.approx(area + length * 0.004 + PI * 0.004**2, rel=1e-6)


def test_too_large_a_cutter_is_refused_with_place_and_radius():
    with pytest.raises(InputError, match=r"concave towards the cutter with radius 18 mm; a cutter of radius 19 mm cannot"):
        curves.offset_outline(ellipse(), -0.019)
    with pytest.raises(InputError, match=r"at \(50, .*\) mm .* concave towards the cutter with radius 10 mm; a cutter of radius 10 mm"):
        curves.offset_outline(slot(), -0.01)
    notch = polygon([(0, 0), (0.02, 0), (0.01, 0.01), (0.02, 0.02), (0, 0.02)])
    with pytest.raises(InputError, match=r"at \(10, 10\) mm .* concave towards the cutter with radius 0 mm; a cutter of radius 1 mm"):
        curves.offset_outline(notch, 1e-3)


def test_a_narrow_place_is_refused_though_every_radius_is_large_enough():
    """Inside a dumbbell with ends of radius 12.8 mm and a neck 16 mm wide a cutter of 9 mm gets stuck, one of 7.9 mm passes."""
    at = lambda t: (0.02 + 0.012 * cos(2 * variable(t))) * exp(1j * variable(t))  # noqa: E731
    outline = curves.outline_of_spans([curves.Span(curves.Piece(0.0, 2 * PI, at, "dumbbell"), 0.0, 2 * PI)], 1e-6)
    with pytest.raises(InputError, match=r"9 mm with its centre at .* cuts 2 mm into another part .* The place is 16 mm wide"):
        curves.offset_outline(outline, -0.009)
    assert curves.outline_area(curves.offset_outline(outline, -0.0079)) < curves.outline_area(outline)
