"""Places where a circle comes nearest to a closed profile: circles, corners and arcs in closed form, and brute force."""

import numpy as np
import pytest

from drivewright import curves
from drivewright._jit import plain
from drivewright.curves import touching
from drivewright.numerics.jets import exp, variable

pytestmark = pytest.mark.analytical

PI = np.pi


def smooth(z, start, stop, shape="smooth"):
    return curves.Span(curves.Piece(start, stop, z, "", shape), start, stop)


def square(half):
    corners = half * np.array([1 - 1j, 1 + 1j, -1 + 1j, -1 - 1j])
    return tuple(
        smooth(lambda t, a=a, b=b: a + (b - a) * variable(t), 0.0, 1.0, "line") for a, b in zip(corners, np.roll(corners, -1), strict=True)
    )


def wave():
    """Five lobes about a point off the origin."""
    return (smooth(lambda t: 0.003 + 0.05 * exp(1j * variable(t)) + 0.006 * exp(-4j * variable(t)), 0.0, 2 * PI),)


@pytest.mark.parametrize("sense", [1, -1])
def test_a_round_profile_is_touched_on_the_line_through_its_centre(sense):
    nodes = touching.nodes_of((smooth(lambda t: 0.002j + 0.03 * exp(sense * 1j * variable(t)), 0.0, 2 * PI, "arc"),))
    outside = 0.002j + 0.041 * np.exp(1j * np.array([0.3, 2.2, -1.9]))
    found = touching.touches(nodes, outside, 0.01, 2e-3)
    assert list(found.centre) == [0, 1, 2]
    np.testing.assert_allclose(found.gap, 1e-3, atol=1e-9)
    np.testing.assert_allclose(found.point, 0.002j + 0.03 / 0.041 * (outside - 0.002j), atol=1e-9)
    np.testing.assert_allclose(found.curvature, sense / 0.03, rtol=1e-4)


def test_only_places_within_reach_are_told():
    nodes = touching.nodes_of((smooth(lambda t: 0.03 * exp(1j * variable(t)), 0.0, 2 * PI, "arc"),))
    assert len(touching.touches(nodes, [0.041 + 0j], 0.01, 0.99e-3).gap) == 0
    assert len(touching.touches(nodes, [0.041 + 0j], 0.01, 1.01e-3).gap) == 1


def test_a_corner_is_a_place_of_its_own():
    """Beyond the corner of a square the corner itself is nearest, with no finite curvature; before a side its foot."""
    nodes = touching.nodes_of(square(0.02))
    found = touching.touches(nodes, [0.023 + 0.024j, 0.024 - 0.0031j], 0.004, 1.1e-3)
    assert list(found.centre) == [0, 1]
    np.testing.assert_allclose(found.point, [0.02 + 0.02j, 0.02 - 0.0031j], atol=1e-12)
    np.testing.assert_allclose(found.gap, [0.005 - 0.004, 0.0], atol=1e-12)
    assert np.isinf(found.curvature[0]) and found.curvature[1] == 0


def test_inside_a_corner_both_sides_touch_and_the_corner_does_not():
    found = touching.touches(touching.nodes_of(square(0.02)), [0.015 + 0.014j], 0.006, 1e-3)
    np.testing.assert_allclose(sorted(found.gap), [-0.001, 0.0], atol=1e-12)
    np.testing.assert_allclose(sorted(found.point, key=np.real), [0.015 + 0.02j, 0.02 + 0.014j], atol=1e-12)


@pytest.mark.parametrize("ahead", range(8))
def test_the_chord_at_which_a_profile_begins_changes_nothing(ahead):
    """Beside a corner, inside and outside of it, wherever the corner stands among the chords of a run."""
    nodes = touching.nodes_of(square(0.02))
    turned = [np.roll(part, ahead) for part in nodes[:4]]
    turned = touching.Nodes(*turned, *touching.bounding_circles(*turned[:2]))
    for centre, count in ((0.019 + 0.0192j, 2), (0.021 + 0.0213j, 1), (0.021 + 0.0193j, 1), (0.0195 + 0.022j, 1)):
        here, there = (touching.touches(each, [centre], 0.0, 3e-3) for each in (nodes, turned))
        assert len(here.point) == len(there.point) == count
        np.testing.assert_allclose(np.sort(there.point), np.sort(here.point), atol=1e-15)


@pytest.mark.parametrize("tolerance", [1e-7, 2e-10])
def test_no_more_nodes_than_the_tolerance_wants(tolerance):
    """With unit tangents times the chord the cubic on an arc of the angle w leaves it in the middle by 2 R sin(w/4)^4."""
    nodes = touching.nodes_of((smooth(lambda t: 0.03 * exp(1j * variable(t)), 0.0, 2 * PI, "arc"),), tolerance)
    off = 2 * 0.03 * np.sin(PI / len(nodes.a) / 2) ** 4
    assert off < tolerance < 16 * off


def test_all_local_minima_against_brute_force():
    rng = np.random.default_rng(3)
    centres = rng.uniform(0.0, 0.06, 40) * np.exp(1j * rng.uniform(-PI, PI, 40))
    found = touching.touches(touching.nodes_of(wave()), centres, 0.0, 0.02)
    t = np.linspace(0, 2 * PI, 100_001)[:-1]
    z = 0.003 + 0.05 * np.exp(1j * t) + 0.006 * np.exp(-4j * t)
    for k, centre in enumerate(centres):
        away = np.abs(z - centre)
        least = (away < np.roll(away, 1)) & (away <= np.roll(away, -1)) & (away < 0.02)
        before, at, after = np.roll(away, 1)[least] ** 2, away[least] ** 2, np.roll(away, -1)[least] ** 2
        vertex = at - (after - before) ** 2 / (8 * (after + before - 2 * at))
        np.testing.assert_allclose(np.sort(found.gap[found.centre == k]), np.sort(np.sqrt(vertex)), atol=1e-9)
    assert len(found.gap) > 20


def test_the_curvature_is_that_of_the_curve():
    found = touching.touches(touching.nodes_of(wave()), [0.061 + 0.004j, 0.02 + 0.06j], 0.0, 0.03)
    t = np.linspace(0, 2 * PI, 200_001)
    v, a = 0.05j * np.exp(1j * t) - 0.024j * np.exp(-4j * t), -0.05 * np.exp(1j * t) - 0.096 * np.exp(-4j * t)
    z = 0.003 + 0.05 * np.exp(1j * t) + 0.006 * np.exp(-4j * t)
    for point, curvature in zip(found.point, found.curvature, strict=True):
        k = np.argmin(np.abs(z - point))
        assert curvature == pytest.approx(np.imag(np.conj(v[k]) * a[k]) / abs(v[k]) ** 3, rel=1e-3)


@pytest.mark.parametrize("count", [1, 7, 8, 9, 100, 1025])
def test_the_circles_hold_their_chords_and_each_other(count):
    """Every circle holds the two below it, those of the runs the cubics on their chords, and the first one all."""
    t = np.linspace(0, 2 * PI, count + 1)
    z = 0.003 + 0.05 * np.exp(1j * t) + 0.006 * np.exp(-4j * t)
    a, b = z[:-1], z[1:]
    middle, radius = touching.bounding_circles(a, b)
    runs = len(middle) // 2
    for k in range(count):
        circle = runs + k // 8
        while circle:
            assert max(abs(a[k] - middle[circle]), abs(b[k] - middle[circle])) <= radius[circle] * (1 + 1e-12)
            circle //= 2
    for k in range(1, runs):
        for below in (2 * k, 2 * k + 1):
            if radius[below] >= 0:
                assert abs(middle[below] - middle[k]) + radius[below] <= radius[k] * (1 + 1e-12)
    assert np.sum(radius[runs:] >= 0) == -(-count // 8)


def test_a_longer_profile_is_searched_as_well_as_a_short_one():
    """All places of a wave of thousands of chords within a limit, beside a search that leaves no chord out."""
    nodes = touching.nodes_of(wave(), 1e-13)
    assert len(nodes.a) > 1000
    blind = nodes._replace(middle=np.zeros_like(nodes.middle), radius=np.where(np.isfinite(nodes.radius), 1.0, -np.inf))
    for limit in (1e-3, 0.01, 0.04):
        centres = 0.05 * np.exp(1j * np.linspace(0, 6, 25)) * np.linspace(0.4, 1.2, 25)
        here, there = (touching.touches(each, centres, 0.0, limit) for each in (nodes, blind))
        for own, wanted in zip(here, there, strict=True):
            np.testing.assert_array_equal(own, wanted)


def test_the_kernel_gives_the_same_uncompiled():
    nodes = touching.nodes_of(wave())
    for limit in (0.006, 0.02):
        seen = []
        for search in (touching.nearest, plain(touching.nearest)):
            found, curvature = np.zeros(9, complex), np.zeros(9)
            count = search(nodes, 0.045 + 0.012j, limit, found, curvature)
            seen.append((count, found, curvature))
        assert seen[0][0] == seen[1][0] > 0
        np.testing.assert_allclose(seen[0][1], seen[1][1], rtol=1e-13)
        np.testing.assert_allclose(seen[0][2], seen[1][2], rtol=1e-9)
