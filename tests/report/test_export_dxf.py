"""DXF files read back with ezdxf: clean, complete, in millimetres, and of the right area."""

import ezdxf
import numpy as np
import pytest
import shapely
from export_cases import BASE, LIFT, cam, cam_area, drawing, wheel
from ezdxf import bbox

from drivewright.report.dxf import write_dxf
from drivewright.scene import Arc, Drawing, Line, Outline, Shape, circle, polygon

pytestmark = pytest.mark.property


def read(path):
    document = ezdxf.readfile(path)
    auditor = document.audit()
    assert not auditor.errors and not auditor.fixes
    return document


def points_of(entity):
    if entity.dxftype() == "LINE":
        return np.array([(p.x, p.y) for p in (entity.dxf.start, entity.dxf.end)])
    if entity.dxftype() == "LWPOLYLINE":
        return np.array(list(entity.vertices()))
    return np.array([(p.x, p.y) for p in entity.flattening(1e-5)])  # not ezdxf.path: its Beziers are 0.03 % off an arc


def ring(document, layer="profile"):
    """Polygon [mm] of the entities of a layer, chained in the order of the file."""
    chains = []
    for entity in document.modelspace().query(f'*[layer=="{layer}"]'):
        points = points_of(entity)
        if chains and np.hypot(*(points[0] - chains[-1][-1])) > np.hypot(*(points[-1] - chains[-1][-1])):
            points = points[::-1]
        assert not chains or np.hypot(*(points[0] - chains[-1][-1])) < 1e-6
        chains.append(points)
    return shapely.Polygon(np.concatenate(chains))


def kinds(document, layer):
    return sorted(entity.dxftype() for entity in document.modelspace().query(f'*[layer=="{layer}"]'))


def test_cam_comes_back_in_millimetres_with_true_arcs_and_its_area(tmp_path):
    write_dxf(drawing(), tmp_path / "c.dxf")
    document = read(tmp_path / "c.dxf")
    assert document.header["$INSUNITS"] == 4 and document.header["$MEASUREMENT"] == 1
    assert kinds(document, "profile") == ["ARC", "ARC", "SPLINE", "SPLINE"]
    assert kinds(document, "hole") == kinds(document, "base") == ["CIRCLE"] and kinds(document, "axis") == ["LINE"]
    radii = sorted(e.dxf.radius for e in document.modelspace().query('ARC[layer=="profile"]'))
    assert radii == pytest.approx([1e3 * BASE, 1e3 * (BASE + LIFT)])
    assert ring(document).area == pytest.approx(1e6 * cam_area(), rel=1e-6)
    hole = document.modelspace().query('CIRCLE[layer=="hole"]').first
    assert (hole.dxf.center.x, hole.dxf.center.y, hole.dxf.radius) == pytest.approx((2.0, -1.0, 6.0))


def test_polyline_option_keeps_the_chord_tolerance_and_holds_no_spline(tmp_path):
    exact = shapely.Polygon(1e3 * cam(knots=5000).points(1e-9))
    sizes = []
    for tolerance in (1e-4, 1e-5):
        write_dxf(drawing(), tmp_path / "c.dxf", tolerance=tolerance, splines=False)
        document = read(tmp_path / "c.dxf")
        assert kinds(document, "profile") == ["ARC", "ARC", "LWPOLYLINE", "LWPOLYLINE"]
        found = ring(document)
        assert found.exterior.hausdorff_distance(exact.exterior) <= 1e3 * tolerance + 1e-4
        sizes.append(sum(len(e) for e in document.modelspace().query("LWPOLYLINE")))
    assert sizes[1] / sizes[0] == pytest.approx(np.sqrt(10), rel=0.3)


def test_splines_pass_the_knots_within_the_tolerance(tmp_path):
    write_dxf(drawing(), tmp_path / "c.dxf", tolerance=1e-6)
    document = read(tmp_path / "c.dxf")
    line = ring(document).exterior
    assert shapely.distance(shapely.points(1e3 * cam().points(1e-9)), line).max() < 1e-3 + 1e-4
    assert all(len(e.control_points) < 40 for e in document.modelspace().query("SPLINE"))


def test_every_piece_of_a_toothed_wheel_is_there(tmp_path):
    outline = wheel()
    write_dxf(Drawing("wheel", "Wheel", (Shape("profile", outline),)), tmp_path / "w.dxf")
    document = read(tmp_path / "w.dxf")
    assert kinds(document, "profile") == ["LINE"] * 60 + ["SPLINE"] * 60
    assert ring(document).area == pytest.approx(1e6 * shapely.Polygon(outline.points()).area, rel=1e-4)


def test_notes_name_the_part_its_thickness_and_its_overall_size(tmp_path):
    triangle = polygon([(-0.01, 0.002), (0.0234567, 0.002), (0.0234567, 0.052)])
    plate = Drawing("plate", "Plate", (Shape("profile", triangle), Shape("pitch", circle((0, 0), 0.08))), 0.0045)
    write_dxf(plate, tmp_path / "p.dxf")
    document = read(tmp_path / "p.dxf")
    assert document.modelspace().query('TEXT[layer=="notes"]').first.dxf.text == "Plate, thickness 4.5 mm"
    dimensions = document.modelspace().query('DIMENSION[layer=="notes"]')
    shown = [e.plain_text() for d in dimensions for e in d.virtual_entities() if e.dxftype() == "MTEXT"]
    assert sorted(map(float, shown)) == [33.457, 50.0]
    assert sorted(d.get_measurement() for d in dimensions) == pytest.approx([33.4567, 50.0])


def test_second_drawing_stands_clear_of_the_first_and_the_first_keeps_its_origin(tmp_path):
    second = Drawing("plate", "Plate", (Shape("body", circle((-1.0, 0.0), 0.01)),))
    write_dxf([drawing(), second], tmp_path / "two.dxf")
    document = read(tmp_path / "two.dxf")
    first_box, second_box = (bbox.extents(document.modelspace().query(f'*[layer=="{layer}"]')) for layer in ("axis", "body"))
    assert second_box.extmin.x > first_box.extmax.x + 5 and second_box.size.x == pytest.approx(20.0, rel=1e-3)
    assert document.modelspace().query('CIRCLE[layer=="base"]').first.dxf.center.x == 0.0
    feet = sorted(d.dxf.defpoint2.x for d in document.modelspace().query("DIMENSION"))  # where the measured lengths begin
    assert feet[:2] == pytest.approx([ring(document).bounds[0]] * 2) and feet[2:] == pytest.approx([second_box.extmin.x] * 2, rel=1e-3)


def test_a_sampled_curve_is_one_polyline_and_a_plate_stays_lines(tmp_path):
    t = np.linspace(0, 2 * np.pi, 91)[:-1]
    curve = np.stack([0.03 * np.cos(t), 0.02 * np.sin(t)], axis=1)
    write_dxf(Drawing("d", "D", (Shape("pitch", polygon(curve)), Shape("profile", polygon(curve[::15])))), tmp_path / "d.dxf")
    document = read(tmp_path / "d.dxf")
    assert kinds(document, "pitch") == ["LWPOLYLINE"] and kinds(document, "profile") == ["LINE"] * 6
    (line,) = document.modelspace().query("LWPOLYLINE")
    assert len(line) == 91 and tuple(line[0]) == pytest.approx(tuple(line[-1]))
    assert ring(document, "pitch").area == pytest.approx(600 * 45 * np.sin(2 * np.pi / 90), rel=1e-9)


def test_clockwise_arcs_keep_their_side(tmp_path):
    bay = Outline(
        (
            Arc((0.0, 0.0), 0.01, 0.0, -np.pi),
            Line((-0.01, 0.0), (-0.02, 0.03)),
            Line((-0.02, 0.03), (0.02, 0.03)),
            Line((0.02, 0.03), (0.01, 0.0)),
        )
    )
    above = bay._replace(pieces=(bay.pieces[0]._replace(sweep=np.pi), *bay.pieces[1:]))
    for outline, sign in ((bay, 1), (above, -1)):
        write_dxf(Drawing("bay", "Bay", (Shape("profile", outline),)), tmp_path / "b.dxf")
        assert ring(read(tmp_path / "b.dxf")).area == pytest.approx(900 + sign * 50 * np.pi, rel=1e-5)


def test_equal_drawings_give_equal_bytes(tmp_path):
    write_dxf(drawing(), tmp_path / "a.dxf")
    write_dxf(drawing(), tmp_path / "b.dxf")
    assert (tmp_path / "a.dxf").read_bytes() == (tmp_path / "b.dxf").read_bytes()
    assert not ezdxf.options.write_fixed_meta_data_for_testing
