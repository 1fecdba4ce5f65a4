"""Chain drives by formula: lengths and layouts against polygons and hulls, what the approximations leave, selection by ratings."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from drivewright.chains import standards as s

pytestmark = pytest.mark.analytical

P = 9.525e-3
DRIVES = [(17, 57, 40.3), (35, 37, 23.0), (61, 19, 31.7), (25, 25, 30.0)]  # z1, z2, C/p


def joints(teeth, phase):
    """Joints of a seated chain of pitch 1."""
    angle = phase + 2 * np.pi * np.arange(teeth) / teeth
    return 0.5 / np.sin(np.pi / teeth) * np.column_stack([np.cos(angle), np.sin(angle)])


def test_joints_on_the_pitch_circle_are_a_pitch_apart():
    for teeth in (7, 18, 53):
        radius = 0.5 * s.pitch_diameter(P, teeth)
        points = radius / np.hypot(*joints(teeth, 0.3)[0]) * joints(teeth, 0.3)
        assert np.hypot(*(points[1] - points[0])) == pytest.approx(P, rel=1e-13)


def polygon_links(teeth1, teeth2, distance, phase1, phase2, strand):
    """Pitches along an actual polygon of pitch 1: each strand straight between the joints nearest to the tangent points."""
    first, second = joints(teeth1, phase1), joints(teeth2, phase2)
    normals = [0.5 * np.pi + strand, -0.5 * np.pi - strand]
    ends = []
    for points in (first, second):
        polar = np.arctan2(points[:, 1], points[:, 0])
        ends.append([int(np.argmin(np.abs((polar - normal + np.pi) % (2 * np.pi) - np.pi))) for normal in normals])
    spans = [np.hypot(*(second[b] + (distance, 0) - first[a])) for a, b in zip(*ends, strict=True)]
    around1 = (ends[0][1] - ends[0][0]) % teeth1  # from the upper to the lower end, through the left
    around2 = (ends[1][0] - ends[1][1]) % teeth2  # from the lower to the upper end, through the right
    return sum(spans) + around1 + around2


@pytest.mark.parametrize(("teeth1", "teeth2", "distance"), DRIVES)
def test_links_are_the_mean_over_all_positions_of_the_polygons(teeth1, teeth2, distance):
    strand = float(s.strand_angle(1.0, teeth1, teeth2, distance))
    share = (np.arange(24) + 0.5) / 24
    # each strand's end takes every place against its tangent point; a prime stride visits the pairs evenly
    phases = [(2 * np.pi / teeth1 * a, 2 * np.pi / teeth2 * share[(7 * k) % 24]) for k, a in enumerate(share)]
    mean = np.mean([polygon_links(teeth1, teeth2, distance, a, b, strand) for a, b in phases])
    assert s.chain_links(1.0, teeth1, teeth2, distance) == pytest.approx(mean, abs=3e-4)


def test_equal_sprockets_take_two_strands_and_a_turn():
    assert s.chain_links(P, 36, 36, 23 * P) == pytest.approx(46 + 36, rel=1e-14)
    assert polygon_links(36, 36, 23.0, 0.5 * np.pi, 0.5 * np.pi, 0.0) == pytest.approx(82, rel=1e-14)


def test_centre_distance_of_forty_digit_arithmetic():
    assert s.centre_distance(P, 35, 37, 82) == pytest.approx(219.05401759653e-3, rel=1e-13)
    assert s.approximate_centre_distance(P, 35, 37, 82) == pytest.approx(219.0540178975e-3, rel=1e-12)


@pytest.mark.parametrize(("teeth1", "teeth2", "ratio"), DRIVES)
def test_centre_distance_inverts_the_number_of_links(teeth1, teeth2, ratio):
    links = s.chain_links(P, teeth1, teeth2, ratio * P)
    assert s.centre_distance(P, teeth1, teeth2, links) == pytest.approx(ratio * P, rel=1e-13)
    assert s.centre_distance(P, teeth2, teeth1, links) == pytest.approx(ratio * P, rel=1e-13)


@pytest.mark.parametrize(("teeth1", "teeth2", "ratio"), DRIVES)
def test_two_sprockets_are_a_loop_of_two_circles(teeth1, teeth2, ratio):
    circles = [(0, 0, 0.5 * s.pitch_diameter(P, teeth1)), (ratio * P, 0, 0.5 * s.pitch_diameter(P, teeth2))]
    loop = s.taut_loop(circles)
    assert loop.wraps == pytest.approx(s.wrap_angles(P, teeth1, teeth2, ratio * P), rel=1e-13)
    assert loop.lengths == pytest.approx(np.full(2, s.strand_length(P, teeth1, teeth2, ratio * P)), rel=1e-13)
    assert loop.links(P, (teeth1, teeth2)) == pytest.approx(s.chain_links(P, teeth1, teeth2, ratio * P), rel=1e-13)
    assert loop.links(P, (0, teeth2)) == pytest.approx(  # a smooth roller carries an arc, not a polygon
        loop.links(P, (teeth1, teeth2)) + loop.wraps[0] * (circles[0][2] / P - teeth1 / (2 * np.pi)), rel=1e-13
    )


def test_what_the_approximate_number_leaves():
    ratios = np.geomspace(40, 400, 9)
    left = np.array([s.chain_links(1.0, 17, 85, c) - s.approximate_links(1.0, 17, 85, c) for c in ratios])
    sine = (85 - 17) / (2 * np.pi * ratios)
    assert left == pytest.approx(ratios * sine**4 / 12, rel=0.03)
    assert np.polyfit(np.log(ratios), np.log(left), 1)[0] == pytest.approx(-3, abs=0.05)
    assert s.approximate_links(P, 21, 21, 0.3) == pytest.approx(s.chain_links(P, 21, 21, 0.3), rel=1e-14)


def test_approximate_distance_inverts_the_approximate_number():
    links = s.approximate_links(P, 17, 85, 40 * P)
    assert s.approximate_centre_distance(P, 17, 85, links) == pytest.approx(40 * P, rel=1e-13)
    assert s.approximate_centre_distance(P, 17, 85, 140) == pytest.approx(s.centre_distance(P, 17, 85, 140), rel=1e-3)


@pytest.mark.parametrize(("teeth1", "teeth2", "links"), [(17, 85, 140), (85, 17, 120), (20, 22, 70)])
def test_distance_factor_is_exact_for_circles_of_whole_circumference(teeth1, teeth2, links):
    distance = s.distance_factor(teeth1, teeth2, links) * (2 * links - teeth1 - teeth2)
    circles = [(0, 0, teeth1 / (2 * np.pi)), (distance, 0, teeth2 / (2 * np.pi))]
    assert s.loop_length(circles) == pytest.approx(links, rel=1e-13)
    assert distance == pytest.approx(s.centre_distance(1.0, teeth1, teeth2, links), rel=1e-4)


def test_distance_factor_as_remembered_from_the_table():
    for q, factor in ((2, 0.24421), (10, 0.24986), (11, 0.24988), (12, 0.24990), (13, 0.24991)):
        assert s.distance_factor(20, 40, 20 + 20 * q) == pytest.approx(factor, abs=1.01e-5)
    assert s.distance_factor(20, 20, 100) == 0.25


def test_even_links():
    assert list(s.even_links(np.array([81.2, 82.0, 82 * (1 + 1e-12), 82.001, 83.0]))) == [82, 82, 82, 84, 84]


def test_least_distance_wraps_as_asked():
    for wrap in (2.0, 2.6):
        distance = s.min_centre_distance(P, 13, 90, least_wrap=wrap)
        assert s.wrap_angles(P, 13, 90, distance)[0] == pytest.approx(wrap, rel=1e-12)
    radii = 0.5 * (s.pitch_diameter(P, 20) + s.pitch_diameter(P, 58))  # up to about 3 : 1 every distance wraps 120 deg
    assert s.min_centre_distance(P, 20, 58) == pytest.approx(radii, rel=1e-14)
    assert s.min_centre_distance(P, 20, 30, (0.3, 0.2)) == pytest.approx(0.25, rel=1e-14)
    assert s.usual_centre_distances(P, 20, 30) == pytest.approx((30 * P, 50 * P))
    assert s.usual_centre_distances(P, 13, 130) == pytest.approx((s.min_centre_distance(P, 13, 130), 50 * P))


INSIDE = [(0.0, 0.0, 0.9), (5.0, -1.0, 0.4), (7.0, 2.5, 1.3), (3.0, 5.0, 0.0), (-1.0, 4.0, 0.6)]
SERPENTINE = [(0.0, 0.0, 0.9, 1), (3.1, 0.6, 0.5, -1), (6.0, -0.3, 0.8, 1), (5.2, 4.0, 0.7, 1), (2.8, 2.9, 0.4, -1), (0.3, 4.4, 0.6, 1)]


def test_a_loop_around_circles_is_their_hull():
    angle = np.linspace(0, 2 * np.pi, 4001)[:-1]
    points = np.concatenate([np.column_stack([x + r * np.cos(angle), y + r * np.sin(angle)]) for x, y, r in INSIDE])
    assert s.loop_length(INSIDE) == pytest.approx(ConvexHull(points).area, rel=1e-6)  # `area` of a plane hull is its perimeter


def outline(loop, points=2000):
    """A closed polygon along the loop, from the ends of its strands alone."""
    pieces = []
    for circle, end, start in zip(loop.circles, np.roll(loop.ends, 1, axis=0), loop.starts, strict=True):
        centre = np.array([circle.x, circle.y])
        first, last = (np.arctan2(*(point - centre)[::-1]) for point in (end, start))
        angle = first + circle.turn * np.linspace(0, (circle.turn * (last - first)) % (2 * np.pi), points)
        pieces.append(centre + circle.radius * np.column_stack([np.cos(angle), np.sin(angle)]))
    return np.concatenate(pieces)


def test_a_serpentine_loop_is_its_polygon():
    loop = s.taut_loop(SERPENTINE)
    points = outline(loop)
    edges = np.roll(points, -1, axis=0) - points
    assert loop.length == pytest.approx(np.sum(np.hypot(*edges.T)), rel=1e-6)
    for circle, start, end, previous in zip(loop.circles, loop.starts, loop.ends, np.roll(loop.ends, 1, axis=0), strict=True):
        before = loop.starts[loop.circles.index(circle) - 1]
        for point, along in ((start, end - start), (previous, previous - before)):
            arm = point - (circle.x, circle.y)
            assert np.hypot(*arm) == pytest.approx(circle.radius, rel=1e-13)
            assert along @ arm == pytest.approx(0, abs=1e-13)
            assert circle.turn * (arm[0] * along[1] - arm[1] * along[0]) > 0  # it runs around the centre in the sense of the turn


def test_two_pulleys_and_an_idler_on_the_back():
    a, h, big, small = 2.0, 0.9, 0.8, 0.5
    touch = np.pi - np.arctan2(h, a) - np.arccos((big + small) / np.hypot(a, h))  # polar angle on the right pulley
    closed = 2 * a + 2 * np.sqrt(a**2 + h**2 - (big + small) ** 2) + 2 * big * (0.5 * np.pi + touch) + 2 * small * (touch - 0.5 * np.pi)
    loop = s.taut_loop([(a, 0, big), (0, h, small, -1), (-a, 0, big)])
    assert loop.length == pytest.approx(closed, rel=1e-13)
    assert loop.wraps == pytest.approx([0.5 * np.pi + touch, 2 * touch - np.pi, 0.5 * np.pi + touch], rel=1e-12)


def test_a_circle_that_moves_does_the_work_of_its_strands():
    step = 1e-5
    loop = s.taut_loop(SERPENTINE)
    along = (loop.ends - loop.starts) / loop.lengths[:, None]
    for number in range(len(SERPENTINE)):
        for axis in range(2):
            moved = [[list(circle) for circle in SERPENTINE] for _ in range(2)]
            moved[0][number][axis] += step
            moved[1][number][axis] -= step
            slope = (s.loop_length(moved[0]) - s.loop_length(moved[1])) / (2 * step)
            assert slope == pytest.approx(along[number - 1, axis] - along[number, axis], abs=1e-8)


def test_a_loop_knows_no_place_scale_or_start():
    length = s.loop_length(SERPENTINE)
    turn = np.exp(0.7j)
    moved = [(*np.array([(2.5 * turn * (x + 1j * y)).real + 3, (2.5 * turn * (x + 1j * y)).imag]), 2.5 * r, t) for x, y, r, t in SERPENTINE]
    assert s.loop_length(moved) == pytest.approx(2.5 * length, rel=1e-13)
    assert s.loop_length(SERPENTINE[2:] + SERPENTINE[:2]) == pytest.approx(length, rel=1e-13)
    assert s.loop_length([(x, -y, r, -t) for x, y, r, t in SERPENTINE]) == pytest.approx(length, rel=1e-13)
    assert s.loop_length([(x, y, r, -t) for x, y, r, t in SERPENTINE[::-1]]) == pytest.approx(length, rel=1e-13)


def test_a_circle_that_is_just_touched_changes_nothing():
    for rounding in (-1e-12, 0.0, 1e-12):  # the last one misses the loop by a hair
        assert s.loop_length([(0, 0, 1), (2, rounding - 0.5, 0.5), (5, 0, 1)]) == pytest.approx(10 + 2 * np.pi, rel=1e-12)


def law(teeth, speed):
    return 12.0 * teeth**1.08 * speed**0.9


TABLE = s.rating_table([11, 17, 25], [2.0, 10.0, 60.0], law(np.array([[11.0], [17.0], [25.0]]), np.array([2.0, 10.0, 60.0])))


def test_ratings_of_a_power_law_are_read_off_exactly():
    for teeth, speed in ((11, 2.0), (13, 7.7), (19, 45.0), (25, 60.0)):
        assert s.rated_power(TABLE, teeth, speed) == pytest.approx(law(teeth, speed), rel=1e-13)


def test_ratings_between_entries_of_any_table():
    table = s.rating_table([20], [1.0, 4.0, 9.0], [100.0, 300.0, 200.0])
    assert [s.rated_power(table, 20, speed) for speed in (1.0, 2.0, 4.0, 6.0, 9.0)] == pytest.approx(
        [100, np.sqrt(100 * 300), 300, np.sqrt(300 * 200), 200], rel=1e-13
    )


def test_the_best_used_chain_comes_first():
    tables = {name: TABLE._replace(powers=scale * TABLE.powers) for name, scale in (("large", 9.0), ("small", 1.0), ("middle", 3.0))}
    tables["slow"] = s.rating_table([11, 25], [0.1, 1.0], np.full((2, 2), 1e6))
    needed = s.design_power(1.5 * law(17, 10.0), 2.0, strand_factor=1.5)
    assert needed == pytest.approx(2 * law(17, 10.0), rel=1e-14)
    found = s.suitable_chains(tables, needed, 17, 10.0)
    assert [name for name, _ in found] == ["middle", "large"]
    assert [use for _, use in found] == pytest.approx([2 / 3, 2 / 9], rel=1e-13)
