"""Sprockets and plates of roller chains: smooth joints, seated rollers, limits of the tooth space."""

import numpy as np
import pytest
import shapely

from drivewright.chains.roller_link import design_roller_link
from drivewright.chains.roller_sprocket import RollerSprocket, design_roller_sprocket, roller_plate
from drivewright.curves import outline_area
from drivewright.scene import place

pytestmark = pytest.mark.analytical

P, D1 = 9.525e-3, 6.35e-3
SPACES = pytest.mark.parametrize("space", [0.0, 0.5, 1.0])


def joints(outline):
    """Gap [m] and turn [rad] at every joint of an outline of arcs."""
    unit = [np.exp(1j * np.array([a.start, a.start + a.sweep])) for a in outline.pieces]
    ends = [complex(*a.center) + a.radius * u for a, u in zip(outline.pieces, unit, strict=True)]
    headings = [1j * u * np.sign(a.sweep) for a, u in zip(outline.pieces, unit, strict=True)]
    gaps = [abs(a[1] - b[0]) for a, b in zip(ends, ends[1:] + ends[:1], strict=True)]
    turns = [np.angle(b[0] / a[1]) for a, b in zip(headings, headings[1:] + headings[:1], strict=True)]
    return np.array(gaps), np.array(turns)


@SPACES
@pytest.mark.parametrize("teeth", [11, 17, 38])
def test_arcs_join_and_only_the_tips_have_edges(space, teeth):
    outline = design_roller_sprocket(teeth, P, D1, space).outline()
    gaps, turns = joints(outline)
    assert np.max(gaps) < 1e-16 + 1e-14 * teeth * P
    by_space = np.abs(turns.reshape(teeth, 4))
    assert np.max(by_space[:, :2]) < 1e-12 and np.min(by_space[:, 2:]) > 0.1
    assert len(outline.pieces) == 4 * teeth


@SPACES
def test_rollers_seat_in_the_bottom_of_the_spaces_and_nowhere_inside(space):
    sprocket = design_roller_sprocket(17, P, D1, space)
    body = shapely.Polygon(sprocket.outline().points(1e-9))
    for number in (0, 5):
        roller = shapely.Polygon(sprocket.roller(number).points(1e-9))
        assert body.intersection(roller).area < 3e-11
        center = sprocket.pitch_radius * np.exp(1j * (np.pi / 2 + 2 * np.pi * number / 17))
        assert body.exterior.distance(shapely.Point(center.real, center.imag)) == pytest.approx(0.5 * D1, abs=2e-9)
    one, two = (np.array(sprocket.roller(k).pieces[0].center) for k in (0, 1))
    assert np.hypot(*(one - two)) == pytest.approx(P, rel=1e-13)


def test_flanks_end_on_the_tip_circle_and_the_seat_angle_is_kept():
    sprocket = design_roller_sprocket(17, P, D1, 0.3)
    flank, seat, _, tip = sprocket.outline().pieces[:4]
    top = complex(*flank.center) + flank.radius * np.exp(1j * flank.start)
    assert abs(top) == pytest.approx(sprocket.tip_radius, rel=1e-13)
    assert flank.sweep > 0 and flank.radius == sprocket.flank_radius
    assert seat.sweep == -sprocket.seat_angle and seat.center[1] - seat.radius == pytest.approx(sprocket.root_radius)
    assert tip.radius * tip.sweep == pytest.approx(sprocket.tip_thickness)


def test_numbers_of_the_smallest_and_largest_space():
    """The limits as they are recalled, for d1 = 8 mm where the cube root is 2, z = 20."""
    small, large = (design_roller_sprocket(20, 12.7e-3, 8e-3, space) for space in (0.0, 1.0))
    assert (small.seat_radius, large.seat_radius) == pytest.approx((4.04e-3, 4.04e-3 + 0.138e-3))
    assert np.degrees([small.seat_angle, large.seat_angle]) == pytest.approx([135.5, 115.5])
    assert (small.flank_radius, large.flank_radius) == pytest.approx((21.12e-3, 37.12e-3))
    diameter = 12.7e-3 / np.sin(np.pi / 20)
    assert 2 * small.root_radius == pytest.approx(diameter - 8e-3)
    assert 2 * small.tip_radius == pytest.approx(diameter + 12.7e-3 * 0.92 - 8e-3)


def test_larger_space_leaves_a_thinner_tooth():
    widths = [design_roller_sprocket(20, P, D1, space).tip_thickness for space in (0.0, 0.5, 1.0)]
    areas = [outline_area(design_roller_sprocket(20, P, D1, space).outline()) for space in (0.0, 0.5, 1.0)]
    assert widths == sorted(widths, reverse=True) and areas == sorted(areas, reverse=True) and areas[2] > 0


def test_sprocket_is_its_own_mirror_image():
    body = shapely.Polygon(design_roller_sprocket(17, P, D1, 0.5).outline().points(1e-8))
    points = shapely.get_coordinates(body)
    assert body.symmetric_difference(shapely.Polygon(points * (-1, 1))).area < 1e-12
    assert body.symmetric_difference(shapely.Polygon(place(points, (0, 0, 2 * np.pi / 17)))).area < 1e-12


def test_plate_is_a_smooth_figure_eight():
    outline = roller_plate(P, 4.1e-3, 6e-3)
    gaps, turns = joints(outline)
    assert np.max(gaps) < 1e-17 and np.max(np.abs(turns)) < 1e-13
    body = shapely.Polygon(outline.points(1e-9))
    waist = 2 * (np.sqrt(10.1e-3**2 - (P / 2) ** 2) - 6e-3)
    middle = body.intersection(shapely.LineString([(0, -1), (0, 1)]))
    assert middle.length == pytest.approx(waist, abs=1e-8)
    assert body.bounds == pytest.approx((-P / 2 - 4.1e-3, -4.1e-3, P / 2 + 4.1e-3, 4.1e-3), abs=1e-8)
    assert outline_area(outline) == pytest.approx(body.area, rel=1e-6)


def test_drawing_and_part_have_the_bore():
    sprocket = design_roller_sprocket(17, P, D1)
    assert isinstance(sprocket, RollerSprocket)
    assert len(sprocket.drawing(0.01, 0.005).on("hole")) == 1 and not sprocket.drawing().on("hole")
    (prism,) = sprocket.part(0.01, 0.005).solids
    assert (prism.z, prism.thickness, len(prism.holes)) == (-0.0025, 0.005, 1)


def test_a_roller_link_from_end_to_end_and_across():
    link = design_roller_link(12.7e-3, 8.5e-3, 7.75e-3, 1.6e-3)
    plate, roller = (shape.outline.points(1e-8) for shape in link.shapes)
    assert plate.max(axis=0) == pytest.approx([0.95 * 12.7e-3, 0.45 * 12.7e-3], abs=1e-7)  # a guide touches it at the end's radius
    assert link.end_radius == pytest.approx(plate[:, 1].max(), abs=1e-7)
    assert np.ptp(roller, axis=0) == pytest.approx([8.5e-3, 8.5e-3], abs=1e-7)
    solids = [solid for part in link.parts(np.zeros((2, 3))) for solid in part.solids]
    assert max(each.z + each.thickness for each in solids) - min(each.z for each in solids) == pytest.approx(link.width, rel=1e-12)
