"""STEP and STL files: read back, measured, compared with the outlines they came from."""

import re
from collections import Counter

import numpy as np
import pytest
import shapely
from export_cases import BASE, LIFT, assembly, cam, cam_area, lobed, wheel

from drivewright.curves import outline_area
from drivewright.errors import InputError
from drivewright.report.cad import write_step, write_stl
from drivewright.scene import Arc, Bar, Line, Outline, Part, Prism, Spline, circle, place, polygon
from drivewright.solids import cad, facets, outlines
from drivewright.solids.volume import part_volume

pytestmark = [pytest.mark.property, pytest.mark.needs_fe]
HEIGHT = 0.012


def cam_part(**options):
    return Part("cam.main", (Prism(cam(), (circle((0, 0), 0.006),), 0.001, HEIGHT),), **options)


def wheel_with_collinear_lines():
    """A wheel with two bores, and one of its tip lines in three pieces."""
    outline = wheel(teeth=12)
    number = next(i for i, piece in enumerate(outline.pieces) if isinstance(piece, Line))
    a, b = map(np.array, outline.pieces[number])
    cuts = [a, a + (b - a) / 4, a + (b - a) / 2, b]
    lines = [Line(tuple(p), tuple(q)) for p, q in zip(cuts[:-1], cuts[1:], strict=True)]
    pieces = (*outline.pieces[:number], *lines, *outline.pieces[number + 1 :])
    return Prism(Outline(pieces), (circle((0, 0), 0.006), circle((0.02, 0.0), 0.004)), 0.001, 0.006)


def read_step(path):
    from netgen.occ import OCCGeometry

    return OCCGeometry(str(path)).shape


def mesh_volume(shape, size):
    """Volume [m^3] of a CAD shape by integration over a curved mesh."""
    from netgen.occ import OCCGeometry
    from ngsolve import Integrate, Mesh, ngsglobals

    ngsglobals.msg_level = 0
    return Integrate(1, Mesh(OCCGeometry(shape).GenerateMesh(maxh=size)).Curve(3)) * 1e-9


def triangle_volume(points, corners):
    a, b, c = np.moveaxis(points[corners], 1, 0)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def unpaired(corners):
    """Directed edges that no neighbour runs the other way."""
    edges = Counter((int(t[i]), int(t[(i + 1) % 3])) for t in corners for i in range(3))
    return sum(edges[(b, a)] != count for (a, b), count in edges.items())


def test_step_keeps_names_boxes_and_volumes_of_an_assembly(tmp_path):
    parts = assembly()
    write_step(parts, tmp_path / "a.step")
    solids = {solid.name: solid for solid in read_step(tmp_path / "a.step").solids}
    assert sorted(solids) == sorted(part.name for part in parts)
    for part in parts:
        points = np.concatenate([place(p.outline.points(1e-8), part.pose) for p in part.solids if isinstance(p, Prism)])
        low, high = solids[part.name].bounding_box
        found = np.array([[corner[0], corner[1]] for corner in (low, high)])
        assert found == pytest.approx(1e3 * np.array([points.min(axis=0), points.max(axis=0)]), abs=0.01)
    lever = next(part for part in parts if part.name == "lever")
    assert mesh_volume(solids["lever"], 8.0) == pytest.approx(part_volume(lever), rel=2e-4)


@pytest.mark.parametrize("outline, size", [(cam(), 10.0), (wheel(teeth=12), 6.0)], ids=["cam", "wheel"])
def test_step_volume_is_area_times_height(outline, size, tmp_path):
    write_step([Part("part", (Prism(outline, (), 0.0, HEIGHT),), (0.01, 0.02, 0.5))], tmp_path / "p.step")
    solid = read_step(tmp_path / "p.step").solids[0]
    wanted = outline_area(outline) * HEIGHT
    assert mesh_volume(solid, size) == pytest.approx(wanted, rel=2e-5)
    assert max(face.mass for face in solid.faces) == pytest.approx(1e6 * wanted / HEIGHT, rel=1e-7)


def test_area_of_the_cam_face_is_the_integral_of_the_polar_curve():
    top = max(cad.cad_solid(cam_part()).faces, key=lambda face: face.center.z)
    assert top.mass == pytest.approx(1e6 * (cam_area() - np.pi * 0.006**2), rel=1e-8)


def test_step_holds_true_circles_and_few_poles(tmp_path):
    write_step([cam_part()], tmp_path / "c.step")
    text = (tmp_path / "c.step").read_text()
    radii = {round(float(r), 6) for r in re.findall(r"CIRCLE\(\s*'[^']*',\s*#\d+,\s*([\d.E+-]+)\)", text)}
    assert radii == {1e3 * BASE, 1e3 * (BASE + LIFT), 6.0}
    assert "SI_UNIT(.MILLI.,.METRE.)" in text
    assert len(text) < 80_000  # 800 knots in two events would need ten times that


def test_spline_edges_pass_within_a_micrometre_of_every_knot_and_join_the_arcs_smoothly():
    outline = outlines.normalised(cam(), "cam")
    solid = cad.cad_solid(Part("cam", (Prism(outline, (), 0.0, HEIGHT),)))
    bottom = [edge for edge in dict.fromkeys(solid.edges) if abs(edge.center.z) < 1e-6]
    knots = np.concatenate([piece.knots for piece in outline.pieces if isinstance(piece, Spline)])
    lines = shapely.MultiLineString(
        [[(p.x, p.y) for p in map(edge.Value, np.linspace(*edge.parameter_interval, 4001).tolist())] for edge in bottom]
    )
    assert shapely.distance(shapely.points(1e3 * knots[::7]), lines).max() < 1e-4 + 1e-6  # mm: 0.1 micrometres, and the chords
    assert len(bottom) == 4
    for a in bottom:
        b = next(b for b in bottom if np.hypot(b.start.x - a.end.x, b.start.y - a.end.y) < 1e-6)
        assert turn(a, b) < 1e-4


def turn(a, b):
    """Angle between the end of one edge and the start of the next, by differences of near points."""

    def step(edge, end):
        low, high = edge.parameter_interval
        h = 1e-6 * (high - low)
        p, q = (edge.Value(t) for t in ((high - h, high) if end else (low, low + h)))
        return complex(q.x - p.x, q.y - p.y)

    return abs(np.angle(step(b, False) / step(a, True)))


def test_step_bytes_depend_on_the_parts_alone(tmp_path):
    write_step([cam_part()], tmp_path / "c.step")
    first = (tmp_path / "c.step").read_bytes()
    write_step([cam_part(colour="blue")], tmp_path / "c.step")
    assert (tmp_path / "c.step").read_bytes() != first
    write_step([cam_part()], tmp_path / "c.step")
    assert (tmp_path / "c.step").read_bytes() == first
    assert b"Author" not in first and not re.search(rb"20\d\d-\d\d-\d\dT", first)
    assert [path.name for path in tmp_path.iterdir()] == ["c.step"]


def test_step_is_ascii_and_gives_foreign_names_back(tmp_path):
    name = "滚子 'ä'"
    write_step([Part(name, (Prism(circle((0, 0), 0.01), (), 0, 0.01),))], tmp_path / "c.step")
    assert (tmp_path / "c.step").read_bytes().isascii()
    assert read_step(tmp_path / "c.step").solids[0].name == name


def test_file_colours_are_those_of_the_role(tmp_path):
    write_step([cam_part(colour="blue")], tmp_path / "c.step")
    shown = re.search(r"COLOUR_RGB\('',([\d.,E+-]+)\)", (tmp_path / "c.step").read_text()).group(1)
    assert [float(c) for c in shown.split(",")] == pytest.approx(cad.COLOURS["blue"], abs=0.03)


def test_pose_turns_about_the_origin_and_then_shifts():
    plate = Prism(polygon([(0.0, 0.0), (0.03, 0.0), (0.03, 0.01), (0.0, 0.01)]), (), 0.002, 0.004)
    centre = cad.cad_solid(Part("plate", (plate,), (0.1, -0.2, 0.7))).solids[0].center
    assert (centre.x, centre.y) == pytest.approx(1e3 * place([(0.015, 0.005)], (0.1, -0.2, 0.7))[0], rel=1e-9)
    assert centre.z == pytest.approx(4.0)


def test_a_bar_lies_between_its_ends():
    low, high = cad.cad_solid(Part("rod", (Bar((0.01, 0.0), (0.01, 0.05), 0.02, 0.004),))).bounding_box
    assert [low[i] for i in range(3)] == pytest.approx([8.0, 0.0, 18.0], abs=1e-6)
    assert [high[i] for i in range(3)] == pytest.approx([12.0, 50.0, 22.0], abs=1e-6)


def test_sparse_knots_are_refined_until_the_kernels_curve_agrees():
    # a single cubic span: clamped cubics hold it exactly, OpenCASCADE's chord-length curve through its ends alone does not
    arch = Spline(np.array([(0.02, 0.0), (0.0, 0.0)]), (0.0, 1.0), (0.0, -1.0))
    outline = Outline((arch, Line((0.0, 0.0), (0.0, -0.01)), Line((0.0, -0.01), (0.02, -0.01)), Line((0.02, -0.01), (0.02, 0.0))))
    solid = cad.cad_solid(Part("arch", (Prism(outline, (), 0.0, 0.01),)))
    # x = 0.02 (1 - 3 u^2 + 2 u^3), y = 0.02 (u - u^2): the area under the arch is 0.02^2 / 5
    assert max(face.mass for face in solid.faces) == pytest.approx(1e6 * (0.02 * 0.01 + 0.02**2 / 5), rel=1e-5)


def test_plates_side_by_side_become_one_block():
    def block(x):
        return Prism(polygon([(x, 0.0), (x + 0.01, 0.0), (x + 0.01, 0.01), (x, 0.01)]), (), 0.0, 0.01)

    assert len(cad.cad_solid(Part("block", (block(0.0), block(0.01), block(0.02)))).faces) == 6


def test_tiny_gaps_and_tiny_arcs_still_make_a_solid():
    r, tiny = 0.02, 1e-4
    end = (r * np.cos(np.pi + tiny), r * np.sin(np.pi + tiny) + 6e-10)
    arcs = Arc((0.0, 0.0), r, 0.0, np.pi), Arc((0.0, 0.0), r, np.pi, tiny)
    nearly = Outline((*arcs, Line(end, (0.0, -0.01)), Line((0.0, -0.01), (r, -6e-10))))
    wanted = np.pi * r**2 / 2 + r**2 * tiny / 2 + 0.01 * r / 2 + 0.01 * r * np.cos(tiny) / 2
    assert cad.cad_solid(Part("plate", (Prism(nearly, (), 0.0, 0.01),))).mass == pytest.approx(1e7 * wanted, rel=1e-6)


def test_arc_that_is_all_but_straight_makes_a_solid():
    # three points within 1e-10 mm of a line end the whole process in OpenCASCADE
    radius, half = 1e3, 5e-9
    flat = Arc((0.0, 0.01 - radius), radius, np.pi / 2 - half, 2 * half)
    right, left = (tuple(p) for p in flat.points(1e-12)[[0, -1]])
    plate = Outline((flat, Line(left, (-0.02, 0.01)), Line((-0.02, 0.01), (0.0, -0.01)), Line((0.0, -0.01), right)))
    assert cad.cad_solid(Part("plate", (Prism(plate, (), 0.0, 0.01),))).mass == pytest.approx(1e7 * 0.01 * (0.02 + right[0]), rel=1e-4)


@pytest.mark.parametrize("triangles", [cad.cad_triangles, facets.surface_triangles])
def test_clockwise_and_closed_spline_outlines_give_the_same_solid_inside_out_never(triangles):
    for outline in (lobed(), Outline(tuple(reversed_pieces(lobed())))):
        points, corners = triangles(Part("lobes", (Prism(outline, (), 0.0, 0.01),)), 5e-5)
        assert unpaired(corners) == 0
        assert triangle_volume(points, corners) == pytest.approx(np.pi * 0.03**2 * (1 + 0.3**2 / 2) * 0.01, rel=5e-3)


def reversed_pieces(outline):
    from drivewright.solids.pieces import reverse

    return [reverse(piece) for piece in outline.pieces[::-1]]


def test_stl_is_closed_outward_and_has_the_volume_of_the_parts(tmp_path):
    parts = assembly()[1:]
    write_stl(parts, tmp_path / "a.stl")
    content = (tmp_path / "a.stl").read_bytes()
    count = int(np.frombuffer(content, "<u4", 1, 80)[0])
    facets = np.frombuffer(content, np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")]), count, 84)
    assert len(content) == 84 + 50 * count and not content.startswith(b"solid")
    vertices, corners = np.unique(facets["v"].reshape(-1, 3), axis=0, return_inverse=True)
    corners = corners.reshape(-1, 3)
    assert unpaired(corners) == 0
    total = triangle_volume(vertices.astype(float), corners) * 1e-9
    assert total == pytest.approx(sum(map(part_volume, parts)), rel=1e-3)
    normal = np.cross(*(np.diff(facets["v"].astype(float), axis=1).transpose(1, 0, 2)))
    assert np.einsum("ij,ij->i", normal, facets["n"]).min() > 0
    assert np.linalg.norm(facets["n"], axis=1) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize(
    "solid",
    [cam_part().solids[0], wheel_with_collinear_lines(), Bar((0.01, 0.02), (0.04, -0.01), 0.003, 0.005)],
    ids=["cam", "wheel", "bar"],
)
def test_direct_facets_agree_with_the_kernel_and_are_closed(solid):
    part = Part("part", (solid,), (0.1, -0.05, 0.8))
    points, corners = facets.surface_triangles(part, 1e-6)
    assert unpaired(corners) == 0
    assert triangle_volume(points, corners) == pytest.approx(part_volume(part), rel=2e-3)
    low, high = cad.cad_solid(part).bounding_box
    assert 1e3 * points.min(axis=0) == pytest.approx([low[i] for i in range(3)], abs=0.01)
    assert 1e3 * points.max(axis=0) == pytest.approx([high[i] for i in range(3)], abs=0.01)


@pytest.mark.parametrize("triangles", [cad.cad_triangles, facets.surface_triangles])
def test_stl_error_falls_in_proportion_to_its_tolerance(triangles):
    part = Part("disc", (Prism(circle((0, 0), 0.02), (), 0.0, 0.005),))
    exact = np.pi * 0.02**2 * 0.005
    errors = [1 - triangle_volume(*triangles(part, tolerance)) / exact for tolerance in (8e-5, 2e-5, 5e-6)]
    assert all(2.5 < a / b < 6.5 for a, b in zip(errors[:-1], errors[1:], strict=True))
    assert errors[0] < 8e-5 / 0.02 * 4 / 3 * 1.5


def stepped(length, step=0.01):
    """A bar of 80 mm on one of 40 mm: two prisms, so that the kernel's mesher has to cover them."""
    return Part("bar", (Prism(circle((0.0, 0.0), 0.04), (), 0.0, step), Prism(circle((0.0, 0.0), 0.02), (), step, length - step)))


def test_a_surface_of_too_many_triangles_is_refused_before_it_is_made():
    with pytest.raises(InputError, match=r"triangles of the surface of part 'bar' are more than the 2.5e\+05 that fit .*export STEP"):
        cad.cad_triangles(stepped(100.0))
    with pytest.raises(InputError, match=r"part 'bar' is 1e\+06 mm long and 80 mm thick: .* beyond a ratio of 10000; export STEP"):
        cad.cad_triangles(stepped(1000.0))


def test_triangles_are_counted_before_they_are_made(monkeypatch):
    """The count is that of equal sides: it grows as area over tolerance, and the mesh has about as many."""
    counts = []
    monkeypatch.setattr(cad, "counted", lambda count, *rest: counts.append(float(count)))
    meshes = [len(cad.cad_triangles(stepped(length), tolerance)[1]) for length, tolerance in ((0.2, 1.6e-4), (0.4, 1.6e-4), (0.4, 8e-5))]
    assert counts[1] - counts[0] == pytest.approx(2 * np.pi * 0.02 * 0.2 / (np.sqrt(3) / 4 * 8 * 0.02 * 1.6e-4), rel=1e-3)
    assert counts[2] == pytest.approx(2 * counts[1], rel=1e-6)
    assert all(0.5 * count < mesh < 4 * count for mesh, count in zip(meshes, counts, strict=True))
