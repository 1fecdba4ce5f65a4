"""Prisms on one another as one closed surface, without a CAD kernel."""

from collections import Counter

import numpy as np
import pytest

from drivewright.errors import InputError
from drivewright.scene import Bar, Part, Prism, circle, rectangle
from drivewright.solids import facets
from drivewright.solids.stacked import stacked_triangles

pytestmark = pytest.mark.property
PLATE, HOLE = rectangle((0.0, 0.0), 0.04, 0.02), circle((0.005, 0.0), 0.004)
CASES = {  # prisms, volume of their union [m³]
    "on one another": (
        [Prism(PLATE, (), 0.0, 0.003), Prism(rectangle((0.0, 0.0), 0.01, 0.01), (), 0.003, 0.005)],
        8e-4 * 3e-3 + 1e-4 * 5e-3,
    ),
    "into one another": (
        [Prism(PLATE, (), 0.0, 0.004), Prism(rectangle((0.02, 0.0), 0.02, 0.02), (), 0.002, 0.004)],
        8e-4 * 4e-3 + 4e-4 * 2e-3 + 2e-4 * 2e-3,
    ),
    "the same again": ([Prism(PLATE, (), 0.0, 0.004)] * 2, 8e-4 * 4e-3),
    "apart": ([Prism(PLATE, (), 0.0, 0.001), Prism(PLATE, (), 0.002, 0.001)], 8e-4 * 2e-3),
    "a bridge over a gap": (
        [Prism(rectangle((x, 0.0), 0.01, 0.01), (), 0.0, 0.003) for x in (0.0, 0.02)]
        + [Prism(rectangle((0.01, 0.0), 0.03, 0.01), (), 0.003, 0.001)],
        2 * 1e-4 * 3e-3 + 3e-4 * 1e-3,
    ),
}


def volume(points, corners):
    a, b, c = np.moveaxis(points[corners], 1, 0)
    return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6


def is_closed(corners):
    """Whether every side of a triangle is one of another too, the other way round."""
    sides = Counter((int(t[i]), int(t[(i + 1) % 3])) for t in corners for i in range(3))
    return all(sides[b, a] == count for (a, b), count in sides.items())


@pytest.mark.parametrize("name", CASES)
def test_the_surface_is_closed_and_holds_the_volume_of_the_union(name):
    prisms, wanted = CASES[name]
    points, corners = stacked_triangles(prisms, "part", 1e-5)
    assert is_closed(corners) and volume(points, corners) == pytest.approx(wanted, rel=1e-9)
    shift = points - points.mean(axis=0) + [0.3, -0.2, 0.1]  # a surface with gaps has another volume elsewhere
    assert volume(shift, corners) == pytest.approx(wanted, rel=1e-9)


def test_a_hole_goes_through_its_own_prism_alone():
    pin = Prism(HOLE, (), 0.0, 0.002)
    bare = Prism(PLATE, (HOLE,), 0.0, 0.004)
    area = np.pi * 0.004**2
    points, corners = stacked_triangles([bare], "part", 1e-6)
    assert is_closed(corners) and volume(points, corners) == pytest.approx((8e-4 - area) * 4e-3, rel=1e-3)
    points, corners = stacked_triangles([bare, pin], "part", 1e-6)
    assert is_closed(corners) and volume(points, corners) == pytest.approx((8e-4 - area) * 4e-3 + area * 2e-3, rel=1e-3)


def test_round_outlines_keep_to_the_tolerance():
    part = Part(
        "disc", (Prism(circle((0.0, 0.0), 0.02), (), 0.0, 0.002), Prism(circle((0.0, 0.0), 0.01), (), 0.002, 0.003)), (0.1, 0.2, 0.3)
    )
    for tolerance in (1e-4, 1e-5):
        points, _ = facets.viewed_triangles(part, tolerance)
        radius = np.hypot(*(points[:, :2] - [0.1, 0.2]).T)
        assert set(np.round(radius[points[:, 2] > 0.0025], 9)) == {0.01}
        count = np.sum((np.abs(radius - 0.02) < 1e-9) & (points[:, 2] == 0))
        assert 0.02 * (1 - np.cos(np.pi / count)) < 2 * tolerance


@pytest.mark.needs_fe
def test_it_is_the_surface_of_the_cad_kernel():
    part = Part("cam", (Prism(circle((0.0, 0.0), 0.02), (HOLE,), 0.0, 0.004), Prism(circle((0.0, 0.0), 0.012), (HOLE,), 0.004, 0.006)))
    ours, theirs = facets.viewed_triangles(part, 1e-6), facets.surface_triangles(part, 1e-6)
    assert volume(*ours) == pytest.approx(volume(*theirs), rel=2e-4)
    assert np.allclose(ours[0].min(axis=0), theirs[0].min(axis=0), atol=1e-6) and np.allclose(
        ours[0].max(axis=0), theirs[0].max(axis=0), atol=1e-6
    )


def test_other_parts_go_on_as_before_and_what_is_wrong_is_named():
    bar = Part("rod", (Bar((0.0, 0.0), (0.1, 0.0), 0.0, 0.01),))
    assert all(np.array_equal(a, b) for a, b in zip(facets.viewed_triangles(bar, 1e-5), facets.surface_triangles(bar, 1e-5), strict=True))
    with pytest.raises(InputError, match="plate.*hole 0"):
        facets.viewed_triangles(Part("plate", (Prism(PLATE, (circle((1.0, 0.0), 0.01),), 0.0, 0.001),)), 1e-5)
