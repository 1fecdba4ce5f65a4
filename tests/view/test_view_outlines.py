"""Thinned outlines stay within their tolerance of the exact curve, at every size."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from drivewright.scene import Outline, Spline, circle, polygon
from drivewright.view.outlines import simplified_points

pytestmark = pytest.mark.property


def wavy(size, waves):
    angle = np.linspace(0, 2 * np.pi, 1501)
    radius = size * (1 + 0.1 * np.cos(waves * angle))
    return Outline((Spline(np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1), (0, 1), (0, 1)),))


@given(st.floats(1e-3, 10), st.integers(1, 9), st.sampled_from([1e-3, 1e-4]))
def test_a_thinned_curve_stays_close_with_fewer_points(size, waves, part):
    outline, tolerance = wavy(size, waves), part * size
    kept = simplified_points(outline, tolerance)
    ring, exact = shapely.linearrings(kept), shapely.linearrings(outline.points())
    assert shapely.hausdorff_distance(ring, exact) <= 1.01 * tolerance
    assert len(kept) < 0.5 * len(outline.points())


def test_straight_runs_keep_their_corners_only():
    points = [(0, 0), (0.5, 0), (1, 0), (1, 0.3), (1, 1), (0, 1)]
    assert simplified_points(polygon(points), 1e-6) == pytest.approx(np.array([(0, 0), (1, 0), (1, 1), (0, 1)]))


def test_even_the_coarsest_circle_has_an_area():
    assert shapely.area(shapely.polygons(simplified_points(circle((0, 0), 1.0), 0.9))) > 0


def test_points_are_remembered_for_the_same_outline_only():
    first, second = wavy(1.0, 3), wavy(2.0, 3)
    assert simplified_points(first, 1e-3) is simplified_points(first, 1e-3) and not simplified_points(first, 1e-3).flags.writeable
    assert np.ptp(simplified_points(second, 1e-3)[:, 0]) == pytest.approx(2 * np.ptp(simplified_points(first, 1e-3)[:, 0]), rel=5e-3)
    small, large = circle((0, 0), 1.0), circle((0, 0), 1.1)
    assert np.ptp(simplified_points(large, 1e-3)[:, 0]) == pytest.approx(1.1 * np.ptp(simplified_points(small, 1e-3)[:, 0]), rel=5e-3)
    assert len(simplified_points(small, 1e-5)) > 2 * len(simplified_points(small, 1e-3))
