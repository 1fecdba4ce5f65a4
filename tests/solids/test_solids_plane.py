"""Plates in plane stress: exact solutions, held to the accuracy of the elements."""

from functools import cache

import numpy as np
import pytest

from drivewright.result import Column
from drivewright.scene import circle, polygon
from drivewright.solids.plane import PlaneBody, field_table, order_error, plane_von_mises
from drivewright.solids.plane_meshing import plane_mesh

pytestmark = [pytest.mark.analytical, pytest.mark.needs_fe]
STEEL = {"thickness": 2e-3, "modulus": 206e9, "poisson": 0.3}


@cache
def body(shape, order=4, **steel):
    """A square with a hole off nothing's middle, a ring, a disk and a bar; lengths in metres."""
    square = polygon([(-5e-3, -4e-3), (6e-3, -4e-3), (6e-3, 5e-3), (-5e-3, 5e-3)])
    hole, fine = circle((0.0, 0.0), 2e-3), {"hole*": 0.7e-3}
    made = {
        "holed": lambda: plane_mesh(square, (hole,), size=1.5e-3, fine=fine),
        "ring": lambda: plane_mesh(circle((0.0, 0.0), 5e-3), (hole,), size=1e-3, fine=fine),
        "disk": lambda: plane_mesh(circle((0.0, 0.0), 5e-3), size=0.7e-3, fine={"outline*": 0.15e-3}),
        "bar": lambda: plane_mesh(polygon([(0, 0), (12e-3, 0), (12e-3, 3e-3), (0, 3e-3)]), size=1.5e-3),
    }
    return PlaneBody(made[shape](), order=order, **{**STEEL, **steel})


def solved(one, traction):
    return one.stress(one.solve(traction[None]))[0]


def on_normals(stress, normals):
    """Traction (n, 2) of stresses (n, 3) on normals."""
    x, y, xy = stress.T
    return np.column_stack([x * normals[:, 0] + xy * normals[:, 1], xy * normals[:, 0] + y * normals[:, 1]])


def kirsch(points, radius, pull, lean):
    """Stress of an endless sheet with a round hole, pulled in the direction `lean`  [rad]."""
    r, turn = np.hypot(*points.T), np.arctan2(points[:, 1], points[:, 0])
    a, t = (radius / r) ** 2, 2 * (turn - lean)
    radial = pull / 2 * (1 - a + (1 - 4 * a + 3 * a**2) * np.cos(t))
    hoop = pull / 2 * (1 + a - (1 + 3 * a**2) * np.cos(t))
    slide = -pull / 2 * (1 + 2 * a - 3 * a**2) * np.sin(t)
    c, s = np.cos(turn), np.sin(turn)
    return np.column_stack(
        [
            radial * c**2 + hoop * s**2 - 2 * slide * s * c,
            radial * s**2 + hoop * c**2 + 2 * slide * s * c,
            (radial - hoop) * s * c + slide * (c**2 - s**2),
        ]
    )


@pytest.mark.parametrize("lean", [0.0, 0.7])
def test_kirsch_s_hole_inside_any_outline(lean):
    one = body("holed", order=5)
    exact = kirsch(one.rim.points, 2e-3, 80e6, lean)
    traction = np.where(one.on("outline:*")[:, None], on_normals(exact, one.rim.normals), 0.0)
    found = solved(one, traction)
    assert np.abs(found - exact).max() < 0.01 * 240e6
    assert plane_von_mises(found).max() == pytest.approx(3 * 80e6, rel=0.005)
    surface = one.surface(one.solve(traction[None]))
    assert np.abs(surface.stress[0] - kirsch(surface.points, 2e-3, 80e6, lean)).max() < 0.02 * 240e6


def test_a_ring_under_pressure():
    """Lame: radial displacement of the bore (p a/E)((b^2 + a^2)/(b^2 - a^2) + nu), hoop stress p (b^2 + a^2)/(b^2 - a^2)."""
    one, a, b, p = body("ring"), 2e-3, 5e-3, 90e6
    inside = one.on("hole0:*")
    fields = one.solve(np.where(inside[:, None], -p * one.rim.normals, 0.0)[None])
    moved = np.sum(one.displacement(fields)[0] * -one.rim.normals, axis=1)[inside]
    ratio = (b**2 + a**2) / (b**2 - a**2)
    assert np.allclose(moved, p * a / 206e9 * (ratio + 0.3), rtol=1e-4)
    stress = one.stress(fields)[0, inside]
    assert np.allclose(stress[:, 0] + stress[:, 1], p * ratio - p, atol=0.005 * p * ratio)


def test_a_ring_spun_up_by_shear():
    """A couple on the bore alone: the rest is angular acceleration, shear q (a/r)^2 (b^4 - r^4)/(b^4 - a^4)."""
    one, a, b, q = body("ring"), 2e-3, 5e-3, 30e6
    along = np.column_stack([-one.rim.normals[:, 1], one.rim.normals[:, 0]])
    traction = np.where(one.on("hole0:*")[:, None], q * along, 0.0)
    force, moment = one.resultant(traction[None])
    assert np.allclose(force, 0, atol=1e-9)
    assert abs(moment[0]) == pytest.approx(2 * np.pi * a**2 * 2e-3 * q, rel=1e-6)
    surface = one.surface(one.solve(traction[None]))
    r = np.hypot(*surface.points.T)
    assert np.allclose(plane_von_mises(surface.stress[0]), np.sqrt(3) * q * (a / r) ** 2 * (b**4 - r**4) / (b**4 - a**4), atol=0.01 * q)


def test_a_bar_pushed_at_one_end_only():
    """It flies: the stress falls linearly to the free end, exactly."""
    one = body("bar")
    traction = np.where(one.on("outline:1")[:, None], [5e6, 0.0], 0.0)
    found = solved(one, traction)
    assert np.allclose(found[:, 0], 5e6 * one.rim.points[:, 0] / 12e-3, atol=1.0)
    assert np.allclose(found[:, 1:], 0, atol=1.0)


def test_a_disk_between_two_opposite_forces():
    """In the middle 2 F/(pi D t) across and -6 F/(pi D t) along the forces, for narrow ones."""
    one = body("disk")
    pressed = np.abs(np.abs(one.rim.points[:, 1]) - 5e-3) < 5e-3 * (1 - np.cos(np.radians(3.0)))
    traction = np.where(pressed[:, None], [0.0, -1.0] * np.sign(one.rim.points[:, 1:]), 0.0)
    traction *= 400.0 / np.abs(np.sum(one.rim.lengths * traction[:, 1] * (one.rim.points[:, 1] > 0)) * 2e-3)
    surface = one.surface(one.solve(traction[None]))
    middle = surface.stress[0, np.hypot(*surface.points.T).argmin()]
    unit = 400.0 / (np.pi * 10e-3 * 2e-3)
    assert middle[0] == pytest.approx(2 * unit, rel=0.03)
    assert middle[1] == pytest.approx(-6 * unit, rel=0.03)


def pulled(one):
    """Tension of the square along x."""
    return np.where(one.on("outline:1")[:, None], [40e6, 0.0], 0.0) + np.where(one.on("outline:3")[:, None], [-40e6, 0.0], 0.0)


def test_stress_scales_with_the_load_and_not_with_sheet_or_modulus():
    one, other = body("holed"), body("holed", thickness=5e-3, modulus=70e9)
    traction = pulled(one)
    assert np.allclose(solved(one, 3 * traction), 3 * solved(one, traction), rtol=1e-9, atol=1.0)
    assert np.allclose(solved(other, traction), solved(one, traction), rtol=1e-6, atol=10.0)
    moved, softer = (each.displacement(each.solve(traction[None])) for each in (one, other))
    assert np.allclose(softer * 70, moved * 206, rtol=1e-6, atol=1e-13)


def test_several_loads_at_once_are_those_alone():
    one = body("holed")
    loads = np.array([pulled(one), np.where(one.on("hole0:1")[:, None], -one.rim.normals * 1e6, 0.0)])
    together = one.stress(one.solve(loads))
    assert np.allclose(together[1], solved(one, loads[1]), rtol=1e-9, atol=1e-3)


def test_work_is_reciprocal():
    """Betti: each load on the displacement of the other, though one of them is not in balance."""
    one = body("holed")
    loads = np.array([pulled(one), np.where(one.on("hole0:1")[:, None], -one.rim.normals * 1e6, 0.0)])
    moved = one.displacement(one.solve(loads))
    work = 2e-3 * np.einsum("n,ink,jnk->ij", one.rim.lengths, loads, moved)
    assert work[0, 1] == pytest.approx(work[1, 0], rel=1e-9)


def test_the_rim_is_the_outline():
    one = body("holed")
    inside = one.on("hole0:*")
    assert one.rim.lengths[inside].sum() == pytest.approx(4e-3 * np.pi, rel=1e-6)
    assert one.rim.lengths[one.on("outline:0")].sum() == pytest.approx(11e-3, rel=1e-12)
    assert np.allclose(one.rim.normals[inside], -one.rim.points[inside] / 2e-3, atol=1e-3)
    assert np.allclose(one.rim.normals[one.on("outline:2")], [0, 1], atol=1e-12)
    assert np.allclose((one.rim.lengths[:, None] * one.rim.normals).sum(axis=0), 0, atol=1e-15)


def test_the_error_of_the_order_is_seen_and_shrinks():
    crude, good = body("holed", order=2), body("holed", order=4)
    first, second = (order_error(one, pulled(one)[None])[0] for one in (crude, good))
    truth = plane_von_mises(solved(body("holed", order=8), pulled(crude)))
    first_true, second_true = (np.abs(plane_von_mises(solved(one, pulled(one))) - truth).max() / truth.max() for one in (crude, good))
    assert first == pytest.approx(first_true, rel=0.1)
    assert second == pytest.approx(second_true, rel=0.25)
    assert second < first / 5


def test_the_picture_s_triangles_fill_the_plate():
    one = body("holed")
    surface = one.surface(one.solve(pulled(one)[None]))
    table = field_table("stress", "stress", surface, (Column("mises", "Pa", "von Mises", plane_von_mises(surface.stress[0])),))
    x, y, size = (table[name].data.reshape(-1, 3) for name in ("x", "y", "mises"))
    areas = ((x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0])) / 2
    assert areas.min() > 0
    assert areas.sum() == pytest.approx(99e-6 - np.pi * 4e-6, rel=5e-3)
    assert size.max() == pytest.approx(plane_von_mises(solved(one, pulled(one))).max(), rel=0.02)


def test_mises():
    assert plane_von_mises([[5.0, 0, 0], [0, -5.0, 0], [0, 0, 5.0], [5.0, 5.0, 0], [5.0, -5.0, 0]]) == pytest.approx(
        [5, 5, 5 * np.sqrt(3), 5, 5 * np.sqrt(3)]
    )
