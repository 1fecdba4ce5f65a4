"""CAD of roller-gear cams: closed solids through the exact flanks, volume by a second route, views that agree."""

from collections import Counter

import numpy as np
import pytest
from shapely import Point, Polygon, union_all

from drivewright.errors import InputError
from drivewright.indexing.motion import TURN, index_motion
from drivewright.indexing.roller_gear import (
    axial_section,
    barrel,
    cam_part,
    compute_flanks,
    develop_surface,
    developed_roller_centres,
    globoidal,
    turret_part,
)
from drivewright.report.cad import write_step
from drivewright.scene import Grooved, Part, polygon
from drivewright.solids import cad, facets
from drivewright.solids.volume import part_volume

pytestmark = pytest.mark.property

MOTION = index_motion("modified-sine", 12, 2.0)
HOURGLASS = globoidal(MOTION, 0.08, 0.012, 0.016, 0.125, 0.06, hand="left")
DRUM = barrel(MOTION, 0.09, 0.012, 0.016, 0.05, 0.075)
TWO_STARTS = globoidal(index_motion("modified-sine", 4, 2.0), 0.08, 0.013, 0.018, 0.15, 0.08, pins=8)  # two rollers a step
BOTH = pytest.mark.parametrize("cam", [HOURGLASS, DRUM], ids=["globoidal", "barrel"])
BORE = 0.03


def volume_by_sections(cam, count=24):
    """Pappus: sections through the cam's axis, turned a little each; half of the square of the radius over the length."""
    total = 0.0
    for theta in TURN * np.arange(count) / count:
        for corners in axial_section(cam, theta):
            (y, r), (y1, r1) = corners.T, np.roll(corners, -1, axis=0).T
            total += abs(np.sum((y1 - y) * (r**2 + r * r1 + r1**2) / 6))
    return total * TURN / count - np.pi * (BORE / 2) ** 2 * cam.cam_length


@pytest.mark.needs_fe
@pytest.mark.parametrize(
    "cam",
    [pytest.param(HOURGLASS, marks=pytest.mark.slow), DRUM, pytest.param(TWO_STARTS, marks=pytest.mark.slow)],
    ids=["globoidal", "barrel", "two starts"],
)
def test_the_solid_of_the_cam(cam, tmp_path):
    """One solid; its volume is that of the sections; the exact flanks lie on its faces at the place of the cam in the drive."""
    from netgen.occ import OCCGeometry, Pnt, Vertex

    part = cam_part(cam, BORE)
    write_step([part], tmp_path / "cam.step")
    (solid,) = OCCGeometry(str(tmp_path / "cam.step")).shape.solids
    assert solid.mass * 1e-9 == pytest.approx(volume_by_sections(cam), rel=3e-4)
    found = compute_flanks(cam, np.linspace(0.013, TURN - 0.02, 23), 7)
    points = found.contact.point[found.on_cam]
    rng = np.random.default_rng(1)
    for point in 1e3 * (points[rng.choice(len(points), 10, replace=False)] + [cam.centre_distance, 0, cam.height]):
        assert min(Vertex(Pnt(*point)).Distance(face) for face in solid.faces) < 5e-4


@pytest.mark.needs_fe
@pytest.mark.slow
@BOTH
def test_the_triangles_of_the_cam_close(cam):
    points, corners = facets.surface_triangles(cam_part(cam, BORE), 5e-5)
    edges = Counter((int(t[i]), int(t[(i + 1) % 3])) for t in corners for i in range(3))
    assert all(edges[(b, a)] == count for (a, b), count in edges.items())
    a, b, c = np.moveaxis(points[corners], 1, 0)
    assert np.einsum("ij,ij->", a, np.cross(b, c)) / 6 == pytest.approx(volume_by_sections(cam), rel=3e-3)


@pytest.mark.needs_fe
@BOTH
def test_the_turret_has_all_its_rollers(cam):
    """A roller clear of the disc adds its own volume; twelve of them stand about the disc, and one fills a groove of the cam."""
    solid = cad.cad_solid(turret_part(cam))
    assert len(solid.solids) == 1
    low, high = solid.bounding_box
    reach = 0.088 if cam.kind == "globoidal" else 0.09 + 1.5 * 0.012
    widest = 1e3 * (np.hypot(reach * np.cos(np.pi / 12), 0) + 0.012 * np.sin(np.pi / 12)) if cam.kind == "globoidal" else 1e3 * reach
    assert high[0] == pytest.approx(widest, abs=1e-3) and low[1] == pytest.approx(-widest, abs=1e-3)


@pytest.mark.needs_fe
def test_a_groove_that_misses_the_body_is_refused():
    (body,) = cam_part(DRUM).solids
    far = Part("far", (body._replace(grooves=(body.grooves[0] + [0, 1.0, 0],)),))
    with pytest.raises(InputError, match=r"part 'far': the CAD kernel cut 0 mm³ .* walls that cross or miss the body"):
        cad.cad_solid(far)


@pytest.mark.needs_fe
@pytest.mark.parametrize(
    "change, message",
    [
        ({"section": polygon([(0, -0.001), (0.01, -0.001), (0.01, 0.02), (0, 0.02)])}, "reaches 1 mm below the axis"),
        ({"grooves": (np.zeros((2, 3, 5, 3)),)}, r"groove 0 is an array \(2, 3, 5, 3\)"),
        ({"grooves": (np.full((2, 5, 5, 3), np.nan),)}, "groove 0 has points that are not finite"),
    ],
)
def test_grooved_bodies_are_checked(change, message):
    body = Grooved((0.0, 0.0), 0.0, polygon([(0, 0), (0.01, 0), (0.01, 0.02), (0, 0.02)]), ())
    with pytest.raises(InputError, match=message):
        cad.cad_solid(Part("odd", (body._replace(**change),)))


def test_the_volume_of_a_grooved_body_is_left_to_the_kernel():
    with pytest.raises(InputError, match="needs the CAD kernel"):
        part_volume(cam_part(DRUM))


@BOTH
def test_the_unrolled_rollers_touch_the_unrolled_ribs(cam):
    """Developed view: each roller within the cam leaves no more than the error of unrolling to its ribs, and does not run into them."""
    view = develop_surface(cam, -0.5, 1.5)
    ribs = union_all([Polygon(rib) for rib in view.ribs])
    theta = np.linspace(0.3, 5.0, 17)
    spots = (developed_roller_centres(cam, theta) + np.stack([view.pitch_radius * theta, 0 * theta], -1)).reshape(-1, 2)
    inside = [Point(spot) for spot in spots if abs(spot[1]) < cam.cam_length / 2]
    assert len(inside) > 10
    for spot in inside:
        assert ribs.distance(spot) == pytest.approx(cam.roller_radius, rel=0.06)


@BOTH
def test_the_developed_view_repeats_every_turn(cam):
    from shapely.affinity import translate

    one, two = (union_all([Polygon(rib) for rib in develop_surface(cam, a, a + 1).ribs]) for a in (0.2, 1.2))
    moved = translate(one, TURN * cam.pitch_radius)
    assert moved.symmetric_difference(two).area < 1e-6 * two.area
