"""Trimmed profiles of many shapes against an independent route: polygon buffers and half planes by shapely."""

import numpy as np
import pytest
import shapely

from drivewright import curves
from drivewright.errors import SolverError
from drivewright.numerics.jets import cos, exp, sin, variable

pytestmark = pytest.mark.property

PI = np.pi
SEEDS = range(6)
RADIUS = 0.009


def wavy(seed, waves=4, depth=0.2, scale=0.03):
    """A closed centre path in three pieces: a circle with random waves, away from every symmetry."""
    rng = np.random.default_rng(seed)
    size = depth * rng.normal(size=2 * waves) / (1 + np.arange(2 * waves))
    phase = rng.uniform(0, 2 * PI, 2 * waves)

    def at(t):
        t = variable(t)
        return scale * (1 + sum(a * sin((k + 1) * t + p) for k, (a, p) in enumerate(zip(size, phase, strict=True)))) * exp(1j * t)

    cuts = [0.0, 1.7, 3.0, 2 * PI]
    return tuple(curves.Piece(a, b, at, f"{a:.1f}") for a, b in zip(cuts, cuts[1:], strict=False))


def swept(family, count=2000, quadrant=250):
    points = np.concatenate([piece.at(np.linspace(piece.start, piece.stop, count)[:-1]).d0 for piece in family.path])
    return shapely.LinearRing(np.stack([points.real, points.imag], axis=1)).buffer(family.radius, quad_segs=quadrant)


def reference(family):
    """The part (or the hole in it) by polygons: what the buffered path leaves around the origin (or covers)."""
    ring = swept(family)
    if family.material == "outside":
        return shapely.Polygon(ring.exterior)
    (around,) = [shapely.Polygon(hole) for hole in ring.interiors if shapely.Polygon(hole).contains(shapely.Point(0, 0))]
    return around


def polygon(trimmed, tolerance=2e-8):
    return shapely.Polygon(trimmed.outline(tolerance).points(tolerance))


@pytest.mark.parametrize("material", ["inside", "outside"])
@pytest.mark.parametrize("seed", SEEDS)
def test_profile_is_what_the_swept_ring_leaves(seed, material):
    family = curves.CircleFamily(wavy(seed), RADIUS, material)
    left, expected = curves.trim(family), reference(family)
    assert left.area == pytest.approx(expected.area, rel=1e-5)
    assert left.perimeter == pytest.approx(expected.length, rel=1e-4)
    ours = polygon(left)
    assert ours.is_valid and ours.exterior.is_ccw
    assert shapely.hausdorff_distance(ours, expected) < 3e-6
    assert bool(left.corners) == left.undercut


def test_the_seeds_hold_both_kinds():
    undercut = [curves.trim(curves.CircleFamily(wavy(seed), RADIUS)).undercut for seed in SEEDS]
    assert 2 <= sum(undercut) <= 5


@pytest.mark.parametrize("seed", SEEDS)
def test_lost_motion_is_the_gap_to_the_polygon(seed):
    family = curves.CircleFamily(wavy(seed), RADIUS)
    left, expected = curves.trim(family), reference(family)
    t = np.linspace(0, 2 * PI, 200)
    centre = family.path[0].at(t).d0
    gap = shapely.distance(shapely.points(centre.real, centre.imag), expected) - family.radius
    lost = curves.profile_gap(left, t)
    np.testing.assert_allclose(lost, gap, atol=1.5e-6)
    assert curves.largest_profile_gap(left)[1] >= np.max(lost) - 1e-9
    kept = np.ones(len(t), bool)
    for start, stop in left.removed:
        kept &= (t < start) | (t > stop)
    assert np.all(lost[kept] == 0)


def test_corners_are_double_points_and_touch_no_member():
    family = curves.CircleFamily(wavy(3, depth=0.3), 0.006, "outside")
    left = curves.trim(family)
    assert len(left.corners) >= 2
    for corner in left.corners:
        a, b = (complex(curves.envelope_of_circle(family.path[0].at(np.array([t])), 0.006, family.side).d0[0]) for t in corner[:2])
        assert abs(a - b) < 1e-13 and abs(a - corner.point) < 1e-13


def seen_from(point, centres, radius, directions=2000):
    """Area around `point` up to the first circle met in each direction (the swept ring of a star-shaped remainder)."""
    area = 0.0
    for angle in np.array_split((np.arange(directions) + 0.5) * 2 * PI / directions, 20):
        arm = (centres - point) * np.exp(-1j * angle)[:, None]
        beside = np.maximum(radius**2 - arm.imag**2, 0.0)
        entry = np.where((np.abs(arm.imag) < radius) & (arm.real > 0), arm.real - np.sqrt(beside), np.inf)
        area += np.sum(0.5 * np.min(entry, axis=1) ** 2) * 2 * PI / directions
    return area


@pytest.mark.parametrize("interior", [0.018 + 0j, -0.019 + 0.001j])
def test_distant_members_cut_the_neck_through(interior):
    """Rollers on both sides of a neck meet in it: the part falls in two, and the lobe around the interior point is returned."""
    lobes = lambda t: (0.02 + 0.012 * cos(2 * variable(t)) + 0.001 * cos(variable(t))) * exp(1j * variable(t))  # noqa: E731
    path = tuple(curves.Piece(a, b, lobes, "lobe") for a, b in [(0.0, 2.0), (2.0, 2 * PI)])
    family = curves.CircleFamily(path, 0.0085)
    left = curves.trim(family, interior)
    expected = seen_from(interior, lobes(np.linspace(0, 2 * PI, 8001)[:-1]).d0, 0.0085)
    assert left.area == pytest.approx(expected, rel=1e-5)
    assert left.corners and polygon(left).contains(shapely.Point(interior.real, interior.imag))
    assert not polygon(left).contains(shapely.Point(-interior.real, interior.imag))


@pytest.mark.parametrize("material", ["inside", "outside"])
def test_of_two_rings_the_nearer_one_counts(material):
    """A path that goes round twice leaves two loops around the axis: the part is in the inner one, or outside the outer one."""
    at = lambda t: (0.03 + 0.012 * cos(0.5 * variable(t))) * exp(1j * variable(t))  # noqa: E731
    left = curves.trim(curves.CircleFamily((curves.Piece(0.1, 0.1 + 4 * PI, at, "twice"),), 0.002, material))
    ring = swept(left.family)
    inner = min(shapely.Polygon(hole).area for hole in ring.interiors if shapely.Polygon(hole).contains(shapely.Point(0, 0)))
    assert left.area == pytest.approx(inner if material == "inside" else shapely.Polygon(ring.exterior).area, rel=1e-5)


def test_lost_motion_under_an_overhang():
    """Where the path turns back above a smooth part of the profile the roller is nearest to that part and not to the corner."""
    at = lambda t: (0.03 + 0.002 * (1 + cos(variable(t)))) * exp(1j * (variable(t) - 1.5 * sin(variable(t))))  # noqa: E731
    left = curves.trim(curves.CircleFamily((curves.Piece(0.1, 0.1 + 2 * PI, at, "overhang"),), 0.002))
    points = np.concatenate([span.piece.at(np.linspace(span.start, span.stop, 40001)).d0 for span in left.spans])
    t = np.linspace(0.1, 0.1 + 2 * PI, 97)
    nearest = np.array([np.min(np.abs(points - centre)) for centre in at(t).d0])
    np.testing.assert_allclose(curves.profile_gap(left, t), nearest - 0.002, atol=3e-9)
    assert nearest.max() > 0.0035


@pytest.mark.parametrize(("size", "waves", "radius"), [(0.012, 3, 0.003), (0.016, 5, 0.002), (0.02, 2, 0.005)])
def test_outward_loops_are_cut_off(size, waves, radius):
    """Loops cross one another and enclose more area, with the other sign, than the path around the axis."""
    at = lambda t: 0.03 * exp(1j * variable(t)) + size * exp(-1j * waves * variable(t))  # noqa: E731
    left = curves.trim(curves.CircleFamily((curves.Piece(0.1, 0.1 + 2 * PI, at, "loops"),), radius))
    expected = seen_from(0.0, at(np.linspace(0, 2 * PI, 8001)[:-1]).d0, radius)
    assert left.area == pytest.approx(expected, rel=5e-5)
    assert len(left.corners) == waves + 1


def test_a_path_whose_other_side_bounds_the_part_is_refused():
    """Inward loops reach into the part with the wrong side of the path: no answer rather than a wrong one."""
    at = lambda t: 0.03 * exp(1j * variable(t)) + 0.010 * exp(5j * variable(t))  # noqa: E731
    with pytest.raises(SolverError, match="the other side of its path bounds the part"):
        curves.trim(curves.CircleFamily((curves.Piece(0.1, 0.1 + 2 * PI, at, "loops"),), 0.003))


@pytest.mark.parametrize("seed", [1, 4, 7])
def test_flat_faces_leave_the_intersection_of_half_planes(seed):
    """Independent route: the polar dual of the intersection of Re(conj(n) z) <= p is the hull of the points n/p."""
    rng = np.random.default_rng(seed)
    size, phase = 0.02 * rng.normal(size=5), rng.uniform(0, 2 * PI, 5)

    def at(t):
        t = variable(t)
        return t + 0.2 * sin(t), 0.03 * (1 + sum(a * sin((k + 2) * t + p) for k, (a, p) in enumerate(zip(size, phase, strict=True))))

    left = curves.trim(curves.LineFamily((curves.Piece(0.0, 2.5, at, "a"), curves.Piece(2.5, 2 * PI, at, "b"))))
    direction, support = at(np.linspace(0, 2 * PI, 20001)[:-1])
    dual = np.exp(1j * direction.d0) / support.d0
    hull = np.array(shapely.MultiPoint(np.stack([dual.real, dual.imag], axis=1)).convex_hull.exterior.coords)[::-1] @ (1, 1j)
    hull = hull if np.sum(np.imag(np.conj(hull[:-1]) * hull[1:])) > 0 else hull[::-1]
    corner = 1j * (hull[1:] - hull[:-1]) / -np.imag(np.conj(hull[:-1]) * hull[1:])  # pole of each edge of the dual
    expected = 0.5 * np.sum(np.imag(np.conj(corner) * np.roll(corner, -1)))
    assert left.area == pytest.approx(expected, rel=1e-5)
    lost = curves.profile_gap(left, np.linspace(0, 2 * PI, 20001)[:-1][::100])
    reach = np.max(np.real(np.conj(np.exp(1j * direction.d0[::100]))[:, None] * corner), axis=1)
    np.testing.assert_allclose(lost, support.d0[::100] - reach, atol=1e-7)
    assert left.undercut


@pytest.mark.parametrize("seed", [0, 5])
@pytest.mark.parametrize("material", ["inside", "outside"])
def test_mirror_rescaling_and_turning_change_nothing(seed, material):
    def moved(change):
        family = curves.CircleFamily(
            tuple(curves.Piece(p.start, p.stop, lambda t, p=p: change(p.at(t)), p.label) for p in wavy(seed)), RADIUS, material
        )
        return curves.trim(family)

    plain = moved(lambda z: z)
    for change in (lambda z: z.conj(), lambda z: np.exp(0.7j) * z):
        other = moved(change)
        assert other.area == pytest.approx(plain.area, rel=1e-12) and other.perimeter == pytest.approx(plain.perimeter, rel=1e-12)
        assert len(other.corners) == len(plain.corners)
    large = tuple(curves.Piece(p.start, p.stop, lambda t, p=p: 1e3 * p.at(t), p.label) for p in wavy(seed))
    big = curves.trim(curves.CircleFamily(large, 1e3 * RADIUS, material))
    assert big.area == pytest.approx(1e6 * plain.area, rel=1e-12)
    np.testing.assert_allclose([c.point for c in big.corners], [1e3 * c.point for c in plain.corners], rtol=1e-10)


def test_a_small_cutter_follows_and_a_growing_one_takes_more():
    areas = [curves.trim(curves.CircleFamily(wavy(2), radius)).area for radius in (1e-4, 1e-3, 3e-3, 6e-3, 9e-3)]
    path = np.concatenate([piece.at(np.linspace(piece.start, piece.stop, 4000)[:-1]).d0 for piece in wavy(2)])
    whole = 0.5 * np.sum(np.imag(np.conj(path) * np.roll(path, -1)))
    assert np.all(np.diff(areas) < 0)
    length = np.sum(np.abs(np.roll(path, -1) - path))
    assert areas[0] == pytest.approx(whole - 1e-4 * length + PI * 1e-8, rel=1e-6)  # Steiner's formula
