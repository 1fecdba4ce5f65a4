"""Turned bodies: volume by four routes, closed surfaces, STEP and STL, and what cannot be turned."""

import re
from collections import Counter

import numpy as np
import pytest

from drivewright.errors import InputError
from drivewright.report.cad import write_step, write_stl
from drivewright.scene import Bar, Part, Prism, Turned, circle, place
from drivewright.solids import cad, facets, turning
from drivewright.solids.volume import part_volume

pytestmark = pytest.mark.property

SPINDLE = ((0.03, 0.02, 0.02, 0.006), (0.02, 0.03, 0.03, 0.006), (0.04, 0.03, 0.018, 0.004), (0.015, 0.018, 0.018, 0.0))
BODIES = {
    "spindle": SPINDLE,
    "cone": ((0.05, 0.01, 0.03, 0.0),),
    "tube": ((0.02, 0.02, 0.02, 0.012), (0.03, 0.02, 0.02, 0.012)),
    "waist": ((0.01, 0.03, 0.03, 0.0), (0.01, 0.03, 0.01, 0.0), (0.01, 0.01, 0.03, 0.005)),
}
POSE = (0.1, -0.05, 0.8)


def part(rings, name="spindle", **options):
    return Part(name, (Turned((0.01, 0.02), 0.005, rings),), POSE, **options)


def triangle_volume(points, corners):
    a, b, c = np.moveaxis(points[corners], 1, 0)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def unpaired(corners):
    edges = Counter((int(t[i]), int(t[(i + 1) % 3])) for t in corners for i in range(3))
    return sum(edges[(b, a)] != count or count != 1 for (a, b), count in edges.items())


@pytest.mark.parametrize("rings", BODIES.values(), ids=BODIES)
def test_surface_is_closed_outward_and_holds_the_volume(rings):
    exact = sum(np.pi * length * ((a * a + a * b + b * b) / 12 - bore**2 / 4) for length, a, b, bore in rings)
    assert part_volume(part(rings)) == pytest.approx(exact, rel=1e-14)
    errors = []
    for tolerance in (4e-5, 1e-5, 1e-6):
        points, corners = facets.surface_triangles(part(rings), tolerance)
        assert unpaired(corners) == 0
        errors.append(exact / triangle_volume(points, corners) - 1)
    largest = max(max(ring[1:3]) for ring in rings) / 2
    assert all(0 < error < 4 / 3 * tolerance / largest * 1.01 for error, tolerance in zip(errors, (4e-5, 1e-5, 1e-6), strict=True))


def test_volume_of_horizontal_sections_is_that_of_the_cones():
    # the same body twice in one part: its union by sections at all heights is the closed form of one
    twice = Part("twice", part(SPINDLE).solids * 2)
    assert part_volume(twice) == pytest.approx(turning.ring_volume(SPINDLE), rel=2e-5)
    crossing = Part("crossing", (Turned((-0.05, 0.0), 0.0, ((0.1, 0.01, 0.01, 0.0),)), Bar((0.0, -0.05), (0.0, 0.05), 0.0, 0.01)))
    steinmetz = 16 / 3 * 0.005**3  # two cylinders at right angles have this in common
    assert part_volume(crossing) == pytest.approx(2 * np.pi * 0.005**2 * 0.1 - steinmetz, rel=1e-5)


def test_the_profile_has_no_idle_corners():
    assert len(turning.half_section([(0.01, 0.02, 0.02, 0.0)] * 5, "x")) == 4
    assert len(turning.half_section([(0.01, 0.02, 0.03, 0.01), (0.01, 0.03, 0.04, 0.01), (0.01, 0.04, 0.04, 0.02)], "x")) == 7
    corners = turning.half_section(SPINDLE, "x")
    area = 0.5 * np.sum(corners[:, 0] * np.roll(corners[:, 1], -1) - corners[:, 1] * np.roll(corners[:, 0], -1))
    assert area == pytest.approx(sum(length * ((a + b) / 2 - bore) / 2 for length, a, b, bore in SPINDLE))


def test_the_axis_runs_along_x_from_the_start_and_turns_with_the_pose():
    points, _ = facets.surface_triangles(Part("rod", (Turned((0.01, 0.02), 0.005, ((0.03, 0.02, 0.02, 0.0),)),)), 1e-6)
    assert points.min(axis=0) == pytest.approx([0.01, 0.01, -0.005]) and points.max(axis=0) == pytest.approx([0.04, 0.03, 0.015])
    moved, _ = facets.surface_triangles(part(((0.03, 0.02, 0.02, 0.0),)), 1e-6)
    assert moved[:, :2] == pytest.approx(place(points[:, :2], POSE)) and moved[:, 2] == pytest.approx(points[:, 2])


@pytest.mark.parametrize(
    "rings, message",
    [
        ((), "part 'spindle': a turned body without rings"),
        (((0.0, 0.02, 0.02, 0.0),), "ring 0 has length 0 mm, diameters 20 and 20 mm, bore 0 mm; it must have a positive length"),
        (((0.1, 0.02, 0.02, 0.0), (0.1, 0.02, 0.01, 0.01)), "ring 1 has length 100 mm, diameters 20 and 10 mm, bore 10 mm"),
        (((0.1, 0.02, 0.02, -0.001),), "bore -1 mm; it must have"),
        (((0.1, np.nan, 0.02, 0.0),), "diameters nan and 20 mm"),
        (((0.1, 0.02, 0.02, 0.015), (0.1, 0.012, 0.012, 0.0)), "rings 0 and 1 do not touch: a bore of 15 mm meets a diameter of 12 mm"),
        (((0.1, 0.01, 0.012, 0.0), (0.1, 0.02, 0.02, 0.013)), "rings 0 and 1 do not touch: a bore of 13 mm meets a diameter of 12 mm"),
    ],
)
def test_what_cannot_be_turned_is_refused(rings, message):
    with pytest.raises(InputError, match=re.escape(message)):
        facets.surface_triangles(part(rings))
    with pytest.raises(InputError, match=re.escape(message)):
        part_volume(part(rings))


@pytest.mark.needs_fe
@pytest.mark.parametrize("rings", BODIES.values(), ids=BODIES)
def test_the_cad_kernel_turns_the_same_body(rings):
    solid = cad.cad_solid(part(rings)).solids[0]
    assert solid.mass == pytest.approx(1e9 * part_volume(part(rings)), rel=1e-9) and solid.name == "spindle"
    points, _ = facets.surface_triangles(part(rings), 1e-6)
    low, high = solid.bounding_box
    assert 1e3 * points.min(axis=0) == pytest.approx([low[i] for i in range(3)], abs=2e-3)
    assert 1e3 * points.max(axis=0) == pytest.approx([high[i] for i in range(3)], abs=2e-3)


@pytest.mark.needs_fe
def test_step_and_stl_of_a_shaft_with_a_wheel(tmp_path):
    from netgen.occ import OCCGeometry

    wheel = Part("wheel", (Turned((0.0, 0.0), 0.0, ((0.01, 0.06, 0.06, 0.018),)), Prism(circle((0.005, 0.0), 0.004), (), 0.02, 0.02)))
    parts = (part(SPINDLE, colour="blue"), wheel)
    write_step(parts, tmp_path / "a.step")
    solids = {solid.name: solid for solid in OCCGeometry(str(tmp_path / "a.step")).shape.solids}
    assert set(solids) == {"spindle", "wheel"}
    assert solids["spindle"].mass == pytest.approx(1e9 * part_volume(parts[0]), rel=1e-9)
    assert solids["wheel"].mass == pytest.approx(1e9 * part_volume(wheel), rel=2e-4)
    write_stl(parts[:1], tmp_path / "a.stl")
    content = (tmp_path / "a.stl").read_bytes()
    facet = np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
    found = np.frombuffer(content, facet, int(np.frombuffer(content, "<u4", 1, 80)[0]), 84)
    points, corners = np.unique(found["v"].reshape(-1, 3), axis=0, return_inverse=True)
    assert unpaired(corners.reshape(-1, 3)) == 0
    assert triangle_volume(points.astype(float), corners.reshape(-1, 3)) == pytest.approx(1e9 * part_volume(parts[0]), rel=2e-3)
