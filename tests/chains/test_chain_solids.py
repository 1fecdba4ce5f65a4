"""Plates, strands and sprockets as solids: stacked without overlap, volumes of the CAD kernel against areas times heights."""

import numpy as np
import pytest
import shapely

from drivewright.chains.interference import seated_poses
from drivewright.chains.link import Link, design_link
from drivewright.chains.plate import design_plate
from drivewright.chains.plate_holes import HingePin
from drivewright.chains.plate_stack import sheet_heights, strand_parts
from drivewright.chains.sprocket import design_sprocket
from drivewright.curves import outline_area
from drivewright.scene import Part, Prism

pytestmark = pytest.mark.property

P, A = 9.525e-3, np.radians(30)
CHAIN = design_link(P, 1.2e-3, A, 2.6e-3)
PLATE = design_plate(CHAIN)


@pytest.mark.parametrize("lacing", [(1, 2), (2, 1), (2, 2), (4, 3)])
def test_sheets_alternate_about_the_middle(lacing):
    one, two = sheet_heights(PLATE, lacing, play=0.1e-3)
    assert (len(one), len(two)) == lacing
    both = np.sort(np.concatenate([one, two]))
    np.testing.assert_allclose(np.diff(both), PLATE.thickness + 0.1e-3, rtol=1e-12)
    assert both[0] + both[-1] + PLATE.thickness == pytest.approx(0.0, abs=1e-18)
    assert set(np.sign(np.diff(np.isin(both, one).astype(int)))) <= {-1, 1}


def test_strand_has_sheets_and_pins_of_every_link():
    parts = strand_parts(PLATE, seated_poses(CHAIN, 35, range(3)), (1, 2), play=0.05e-3, overhang=0.5e-3)
    assert [len(part.solids) for part in parts] == [3, 4, 3]
    assert parts[1].pose == pytest.approx(seated_poses(CHAIN, 35, [1])[0])
    pin = parts[0].solids[-1]
    assert pin.thickness == pytest.approx(3 * 2e-3 + 2 * 0.05e-3 + 1e-3) and pin.z == pytest.approx(-pin.thickness / 2)
    hinge = design_plate(Link(P, 0.0, A, CHAIN.flank_support), HingePin(1.4e-3))
    assert [len(part.solids) for part in strand_parts(hinge, np.zeros((3, 3)), (1, 2))] == [3, 3, 2]


def test_sheets_in_one_layer_stay_apart_on_the_sprocket():
    poses = seated_poses(CHAIN, 19, [0, 2])
    one, two = (shapely.Polygon(PLATE.outline.transformed(tuple(pose)).points(1e-7)) for pose in poses)
    straight = shapely.Polygon(PLATE.outline.transformed((2 * P, 0.0, 0.0)).points(1e-7))
    assert one.distance(two) > 1e-3 and shapely.Polygon(PLATE.outline.points(1e-7)).distance(straight) > 0.8e-3


@pytest.mark.needs_fe
def test_step_file_of_a_plate_has_its_area_times_its_thickness(tmp_path):
    from netgen.occ import OCCGeometry
    from ngsolve import Integrate, Mesh, ngsglobals

    from drivewright.report.cad import write_step

    ngsglobals.msg_level = 0
    write_step([Part("plate", (Prism(PLATE.outline, PLATE.holes, 0.0, PLATE.thickness),))], tmp_path / "plate.step")
    shape = OCCGeometry(str(tmp_path / "plate.step")).shape
    volume = Integrate(1, Mesh(OCCGeometry(shape).GenerateMesh(maxh=4.0)).Curve(3)) * 1e-9
    assert volume == pytest.approx(PLATE.moments.area * PLATE.thickness, rel=2e-5)


@pytest.mark.slow
@pytest.mark.needs_fe
def test_triangles_of_a_sprocket_enclose_its_area_times_its_width():
    from drivewright.solids import cad

    sprocket = design_sprocket(CHAIN, 13)
    points, corners = cad.cad_triangles(sprocket.part(0.02, 0.006, tolerance=1e-5), 5e-6)
    a, b, c = np.moveaxis(points[corners], 1, 0)
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
    assert volume == pytest.approx((outline_area(sprocket.outline()) - np.pi * 1e-4) * 0.006, rel=2.5e-3)
