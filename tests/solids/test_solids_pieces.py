"""Pieces and chains made ready for files, against exact curves; volumes against closed forms."""

import numpy as np
import pytest
import shapely

from drivewright.scene import Arc, Bar, Line, Outline, Part, Prism, Spline, circle, polygon
from drivewright.solids import outlines, pieces
from drivewright.solids.volume import part_volume

pytestmark = pytest.mark.analytical


def spiral(t):
    """Logarithmic spiral, a curve with ever changing curvature."""
    r = 0.02 * np.exp(0.3 * t)
    return np.stack([r * np.cos(t), r * np.sin(t)], axis=-1)


def spiral_tangent(t):
    """Unit tangent: a constant angle to the radius."""
    angle = t + np.arctan2(1.0, 0.3)
    return np.cos(angle), np.sin(angle)


def spline(count=600, a=0.2, b=2.4):
    return Spline(spiral(np.linspace(a, b, count)), spiral_tangent(a), spiral_tangent(b))


FINE = spiral(np.linspace(0.2, 2.4, 20001))


@pytest.mark.parametrize("tolerance", [1e-5, 1e-6, 1e-7, 1e-8])
def test_fit_stays_within_its_tolerance_of_the_exact_curve(tolerance):
    curve = pieces.fit(spline(), tolerance)
    found = curve(np.random.default_rng(1).uniform(curve.t[0], curve.t[-1], 400))
    miss = shapely.distance(shapely.points(found), shapely.LineString(FINE))
    assert miss.max() <= tolerance + 2e-10
    assert len(curve.c) < 60


def test_fit_needs_spans_as_the_fourth_root_of_the_tolerance():
    # halving spans leaves them up to twice too fine, so the count is within a factor of two of the law
    counts = [len(np.unique(pieces.fit(spline(3000), tolerance).t)) - 1 for tolerance in (1e-5, 1e-9)]
    assert 5 <= counts[1] / counts[0] <= 20


def test_fit_keeps_ends_tangents_and_second_derivatives_smooth():
    curve = pieces.fit(spline(), 1e-7)
    ends = curve.t[[0, -1]]
    assert np.abs(curve(ends) - spiral(np.array([0.2, 2.4]))).max() < 1e-15
    for s, t in zip(ends, (0.2, 2.4), strict=True):
        assert np.cross(np.append(curve(s, 1), 0), np.append(spiral_tangent(t), 0))[2] == pytest.approx(0, abs=1e-12)
    inner = np.unique(curve.t)[1:-1]
    jump = curve(inner * (1 + 1e-9), 2) - curve(inner * (1 - 1e-9), 2)
    assert np.abs(jump).max() < 1e-4 * np.abs(curve(inner, 2)).max()


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6])
def test_polyline_is_thrifty_and_within_its_tolerance(tolerance):
    points = pieces.polyline(spline(), tolerance)
    assert shapely.LineString(points).hausdorff_distance(shapely.LineString(FINE)) <= tolerance
    # chords of a circle of the least curvature that occurs would need at least this many
    fewest = np.ptp(np.log(np.hypot(*FINE[[0, -1]].T))) / 0.3 / (2 * np.sqrt(8 * tolerance / 0.02))
    assert fewest * 0.5 < len(points) < 6 * fewest + 4


def test_polyline_refines_sparse_knots():
    sparse = spline(count=12)
    points = pieces.polyline(sparse, 1e-6)
    curve = pieces.interpolant(sparse)
    assert len(points) > 40
    assert shapely.LineString(points).hausdorff_distance(shapely.LineString(curve(np.linspace(0, curve.x[-1], 5001)))) <= 1e-6


def test_reversed_piece_runs_from_end_to_start_with_turned_headings():
    for piece in (Line((0.0, 1.0), (2.0, 3.0)), Arc((1.0, -1.0), 2.0, 0.3, -1.2), spline()):
        back = pieces.reverse(piece)
        assert pieces.start(back) == pytest.approx(pieces.end(piece)) and pieces.end(back) == pytest.approx(pieces.start(piece))
        for ours, theirs in zip(pieces.headings(back), pieces.headings(piece)[::-1], strict=True):
            assert ours == pytest.approx(-theirs)


def test_heading_of_an_arc_is_the_difference_of_near_points():
    arc = Arc((0.1, 0.2), 0.5, 0.4, -2.0)
    near = np.asarray(arc._replace(sweep=-1e-6).points(1e-9))
    assert pieces.headings(arc)[0] == pytest.approx((near[-1] - near[0]) / np.hypot(*(near[-1] - near[0])), abs=1e-6)


def test_joined_drops_waste_closes_tiny_gaps_and_turns_counter_clockwise():
    waste = Spline(np.array([(0.0, 0.0), (0.0, 0.0), (0.0, 1e-3), (0.0, 1e-3), (0.0, 2e-3), (0.0, 2e-3 + 3e-10)]), (0, 1), (0, 1))
    clockwise = Outline(
        (
            waste,
            Line((0.0, 2e-3 + 8e-10), (3e-3, 2e-3)),
            Line((3e-3, 2e-3), (3e-3, 2e-3)),
            Line((3e-3, 2e-3), (3e-3, 0.0)),
            Line((3e-3, 0.0), (0.0, 0.0)),
        )
    )
    outline = outlines.normalised(clockwise, "plate")
    assert len(outline.pieces) == 4
    assert outlines.outline_area(outline) == pytest.approx(6e-6, rel=1e-6)
    for here, there in zip(outline.pieces, (*outline.pieces[1:], outline.pieces[0]), strict=True):
        assert np.array_equal(pieces.end(here), pieces.start(there))
    knots = next(piece.knots for piece in outline.pieces if isinstance(piece, Spline))
    assert len(knots) == 3


def test_joined_moves_the_neighbour_of_an_arc_and_never_the_arc():
    arc = Arc((0.0, 0.0), 0.01, 0.0, np.pi)
    outline = outlines.normalised(Outline((arc, Line((-0.01, 7e-10), (0.01, -6e-10)))), "half disc")
    assert outline.pieces[0] == arc
    assert pieces.start(outline.pieces[1]) == pytest.approx((-0.01, 0.0), abs=1e-17)
    assert pieces.end(outline.pieces[1]) == pytest.approx((0.01, 0.0), abs=1e-17)


def test_a_line_that_snapping_draws_together_is_dropped():
    upper, lower = Arc((0.0, 0.0), 0.01, 0.0, np.pi), Arc((0.0, 0.0), 0.01, np.pi, np.pi)
    outline = outlines.normalised(Outline((upper, Line((-0.01, 5e-10), (-0.01, -6e-10)), lower)), "disc")
    assert outline.pieces == (upper, lower)


def test_an_open_outline_stays_open_and_keeps_its_direction():
    path = polygon([(0.0, 0.0), (0.0, 0.02), (0.03, 0.02)], closed=False)
    assert outlines.normalised(path, "path") == path
    assert outlines.piece_ends(path).tolist() == [[0.0, 0.0], [0.0, 0.02], [0.03, 0.02]]
    assert outlines.polyline(path, 1e-6).tolist() == outlines.piece_ends(path).tolist()


def test_full_circle_is_cut_in_two_and_recognised():
    ring = outlines.normalised(Outline((Arc((0.01, 0.02), 0.005, 0.7, -2 * np.pi),)), "ring")
    assert [piece.sweep for piece in ring.pieces] == pytest.approx([np.pi, np.pi])
    assert outlines.full_circle(ring).radius == 0.005
    assert outlines.full_circle(outlines.normalised(Outline((Arc((0, 0), 1.0, 0.0, np.pi), Line((-1, 0), (1, 0)))), "half")) is None
    lens = Outline((Arc((0.0, -1.0), np.sqrt(2.0), np.pi / 4, np.pi / 2), Arc((0.0, 1.0), np.sqrt(2.0), -3 * np.pi / 4, np.pi / 2)))
    assert outlines.full_circle(outlines.normalised(lens, "lens")) is None


def test_closed_spline_is_cut_in_two_smooth_halves():
    t = np.linspace(0, 2 * np.pi, 401)
    ring = Spline(np.stack([0.03 * np.cos(t), 0.02 * np.sin(t)], axis=1), (0, 1), (0, 1))
    first, second = outlines.normalised(Outline((ring,)), "ring").pieces
    assert first.end_tangent == second.start_tangent == pytest.approx((0, -1), abs=1e-7)
    assert outlines.outline_area(Outline((first, second))) == pytest.approx(np.pi * 0.03 * 0.02, rel=1e-8)


def part(*solids):
    return Part("part", solids, (0.1, 0.2, 0.3))


def test_volume_of_a_ring():
    ring = part(Prism(circle((0.01, 0.0), 0.02), (circle((0.012, 0.0), 0.006),), 0.003, 0.007))
    assert part_volume(ring) == pytest.approx(np.pi * (0.02**2 - 0.006**2) * 0.007, rel=2e-6)


def test_volume_counts_overlap_of_prisms_once():
    # two cylinders a distance d apart share a lens over 4 mm of height
    r, d = 0.02, 0.015
    lens = 2 * r**2 * np.arccos(d / (2 * r)) - d / 2 * np.sqrt(4 * r**2 - d**2)
    both = part(Prism(circle((0, 0), r), (), 0.0, 0.010), Prism(circle((d, 0), r), (), 0.006, 0.009))
    assert part_volume(both) == pytest.approx(np.pi * r**2 * 0.019 - lens * 0.004, rel=2e-6)


def test_volume_leaves_out_the_gap_between_stacked_prisms():
    square = polygon([(0, 0), (0.01, 0), (0.01, 0.02), (0, 0.02)])
    stack = part(Prism(square, (), 0.0, 0.001), Prism(square, (), 0.004, 0.002))
    assert part_volume(stack) == pytest.approx(0.01 * 0.02 * 0.003, rel=1e-12)


def test_volume_of_a_bar_through_a_block_and_of_crossed_bars():
    r, length = 0.004, 0.05
    bar = Bar((0.0, 0.0), (length, 0.0), 0.005, 2 * r)
    assert part_volume(part(bar)) == pytest.approx(np.pi * r**2 * length, rel=1e-9)
    block = Prism(polygon([(0.01, -0.01), (0.03, -0.01), (0.03, 0.01), (0.01, 0.01)]), (), 0.0, 0.010)
    assert part_volume(part(bar, block)) == pytest.approx(0.02 * 0.02 * 0.01 + np.pi * r**2 * (length - 0.02), rel=1e-6)
    crossed = part(bar, Bar((0.02, -0.03), (0.02, 0.03), 0.005, 2 * r))  # Steinmetz: they share 16 r^3 / 3
    assert part_volume(crossed) == pytest.approx(np.pi * r**2 * 0.11 - 16 * r**3 / 3, rel=1e-6)
