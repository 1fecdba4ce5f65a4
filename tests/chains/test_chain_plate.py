"""Plates of silent chains: outlines, holes, rolling of the pins, mass, against closed forms and polygons."""

import numpy as np
import pytest
import shapely

from drivewright.chains.interference import sampled
from drivewright.chains.link import Link, design_link, seat_height, seat_support
from drivewright.chains.plate import design_plate, link_mass, mass_per_pitch
from drivewright.chains.plate_holes import HingePin, RockerPins, RoundPins, default_pins, neighbour_center
from drivewright.chains.plate_outline import area_moments, mirrored, outline, rounded
from drivewright.chains.tooth import Tooth
from drivewright.curves import outline_area, perimeter
from drivewright.scene import Arc, Line, circle, place, polygon

pytestmark = pytest.mark.analytical

P, A = 9.525e-3, np.radians(30)
GROUP3 = design_link(P, 1.2e-3, A, 2.6e-3)
CLASSICAL = Link(P + 14.8e-3, 7.4e-3, A, GROUP3.flank_support)
HINGE = Link(P, 0.0, A, GROUP3.flank_support)
LINKS = pytest.mark.parametrize("chain", [GROUP3, CLASSICAL, HINGE], ids=["round", "rocker", "hinge"])
ROLLING = pytest.mark.parametrize("chain", [GROUP3, CLASSICAL, design_link(P, 0.9e-3, A, 2.6e-3)], ids=["round", "rocker", "small"])


def ends(piece):
    """Points and headings (complex) at the two ends of a line or arc."""
    if isinstance(piece, Line):
        a, b = complex(*piece.start), complex(*piece.end)
        return a, b, (b - a) / abs(b - a), (b - a) / abs(b - a)
    unit = np.exp(1j * np.array([piece.start, piece.start + piece.sweep]))
    a, b = complex(*piece.center) + piece.radius * unit
    return a, b, *(1j * unit * np.sign(piece.sweep))


def steps(pieces):
    """Largest gap [m] and largest turn [rad] between neighbouring pieces."""
    at = [ends(piece) for piece in pieces]
    gaps = [abs(a[1] - b[0]) for a, b in zip(at, at[1:] + at[:1], strict=True)]
    turns = [abs(np.angle(b[2] / a[3])) for a, b in zip(at, at[1:] + at[:1], strict=True)]
    return max(gaps), max(turns)


def solid(shape, tolerance=1e-9):
    return shapely.Polygon(shape.points(tolerance))


def neighbour(chain, turn):
    """Pose of the next plate when the joint is turned by `turn`: its left pin centre on `neighbour_center`."""
    x, y = neighbour_center(chain, turn)
    half = 0.5 * chain.hole_pitch
    return x + half * np.cos(turn), y - half * np.sin(turn), -turn


def test_rounded_rectangle_has_the_area_and_perimeter_of_the_book():
    pieces = rounded([(2, 1), (-1, 1), (-1, -1), (2, -1)], [0.3, 0.0, 0.5, 0.25], "abcd", "wxyz")
    lost = 0.3**2 + 0.5**2 + 0.25**2
    assert outline_area(outline(pieces)) == pytest.approx(6 - lost * (1 - np.pi / 4), rel=1e-14)
    assert perimeter(outline(pieces)) == pytest.approx(10 - (0.3 + 0.5 + 0.25) * (2 - np.pi / 2), rel=1e-14)
    assert list(pieces) == ["a", "b", "y", "c", "z", "d", "w"]
    assert pieces["y"].center == pytest.approx((-0.5, -0.5))


def test_edges_used_up_by_their_fillets_are_left_out():
    pieces = rounded([(1, 1), (-1, 1), (-1, -1), (1, -1)], [1.0] * 4, "abcd", "wxyz")
    assert sorted(pieces) == list("wxyz")
    assert area_moments(outline(pieces)).area == pytest.approx(np.pi, rel=1e-14)


def test_moments_of_a_disk_and_of_a_triangle():
    disk = area_moments(circle((0.3, -0.7), 0.2))
    assert disk.area == pytest.approx(np.pi * 0.04, rel=1e-13)
    assert disk.centroid == pytest.approx((0.3, -0.7), rel=1e-13)
    assert disk.polar == pytest.approx(np.pi * (0.2**4 / 2 + 0.04 * (0.09 + 0.49)), rel=1e-13)
    assert disk.central == pytest.approx(np.pi * 0.2**4 / 2, rel=1e-11)
    corners = np.array([(0.2, 0.1), (1.3, 0.4), (0.5, 0.9)])
    triangle = area_moments(polygon(corners))
    center = corners.mean(axis=0)
    assert triangle.centroid == pytest.approx(tuple(center), rel=1e-13)
    assert triangle.central == pytest.approx(triangle.area * np.sum((corners - center) ** 2) / 12, rel=1e-12)


@LINKS
def test_moments_of_a_plate_match_its_polygon(chain):
    plate = design_plate(chain)
    body = shapely.Polygon(plate.outline.points(1e-10), [hole.points(1e-10) for hole in plate.holes])
    points = np.concatenate([shapely.get_coordinates(body.exterior)[:-1]])
    assert len(points) > 1000
    moments = plate.moments
    assert moments.area == pytest.approx(body.area, rel=1e-6)
    assert moments.centroid == pytest.approx((0.0, body.centroid.y), abs=1e-9)
    assert moments.polar == pytest.approx(polygon_polar(body.exterior) - sum(map(polygon_polar, body.interiors)), rel=2e-6)


def polygon_polar(ring):
    """int x^2 + y^2 dA of a polygon by the formula over its edges."""
    x, y = shapely.get_coordinates(ring).T
    cross = x[:-1] * y[1:] - x[1:] * y[:-1]
    square = sum(c[:-1] ** 2 + c[:-1] * c[1:] + c[1:] ** 2 for c in (x, y))
    return abs(np.sum(cross * square)) / 12


@LINKS
def test_every_boundary_is_closed_and_smooth(chain):
    plate = design_plate(chain)
    for pieces in (plate.outline.pieces, *(hole.pieces for hole in plate.holes)):
        gap, turn = steps(pieces)
        assert gap < 1e-16 + 1e-14 * P and turn < 1e-11
    assert outline_area(plate.outline) > 0 and all(outline_area(hole) > 0 for hole in plate.holes)


@LINKS
def test_plate_is_its_own_mirror_image(chain):
    plate = design_plate(chain)
    for pieces in (plate.pieces, {**plate.hole("left"), **{f"{n} r": p for n, p in plate.hole("right").items()}}):
        points = np.concatenate([piece.points(1e-7) for piece in pieces.values()])
        image = shapely.MultiPoint(points * (-1, 1))
        assert max(image.distance(shapely.Point(p)) for p in points[::7]) < 1e-12
    assert mirrored(mirrored(plate.pieces))["flank left"].start == pytest.approx(plate.flank("left").start, abs=1e-17)


def test_flanks_lie_where_the_link_says():
    plate = design_plate(GROUP3)
    for side, sign in (("right", 1), ("left", -1)):
        normal = np.array([sign * np.cos(A), -np.sin(A)])
        for end in (plate.flank(side).start, plate.flank(side).end):
            assert normal @ end == pytest.approx(GROUP3.flank_support, rel=1e-14)
        hole = np.array([sign * 0.5 * GROUP3.hole_pitch, 0.0])
        assert GROUP3.flank_support - normal @ hole == pytest.approx(2.6e-3, rel=1e-14)


def test_inner_flanks_keep_their_gap_from_the_tooth_of_a_rack():
    plate = design_plate(GROUP3, inner_gap=0.4e-3)
    flank, inner = plate.flank("right"), plate.pieces["inner right"]
    rack = shapely.LineString([(P - x, y) for x, y in (flank.start, flank.end)])  # flank mirrored at x = p/2
    assert rack.distance(shapely.Point(*np.mean([inner.start, inner.end], axis=0))) == pytest.approx(0.4e-3, rel=1e-12)


@pytest.mark.parametrize("teeth", [35, 37, 23])
def test_contact_lies_on_the_flank_where_the_involute_touches(teeth):
    plate, base = design_plate(GROUP3), 0.5 * P * teeth * np.cos(A) / np.pi
    tooth = Tooth(teeth, base, seat_support(GROUP3, teeth))
    x, y = plate.contact(tooth, "right")
    assert np.hypot(x, y + seat_height(GROUP3, teeth)) == pytest.approx(tooth.contact_radius, rel=1e-14)
    flank = plate.flank("right")
    assert shapely.LineString([flank.start, flank.end]).distance(shapely.Point(x, y)) < 1e-15
    assert plate.contact(tooth, "left") == (-x, y)


@ROLLING
def test_neighbour_rolls_on_the_own_pin(chain):
    """Velocity of a point of the neighbour = turning about the contact point, clockwise: dz/dt = -i (z - contact)."""
    turn, step = 0.23, 1e-5
    own, r = 0.5 * chain.hole_pitch, chain.radius
    contact = own + r * np.exp(1j * (np.pi - turn / 2))

    def speed(path):
        ahead, behind = path(turn + step), path(turn - step)
        return complex(*(ahead - behind)) / (2 * step)

    center = complex(*neighbour_center(chain, turn))
    assert abs(center - own) == pytest.approx(2 * r, rel=1e-14)
    assert speed(lambda t: neighbour_center(chain, t)) == pytest.approx(-1j * (center - contact), rel=1e-8)
    if isinstance(pins := default_pins(chain), RockerPins):
        rod = complex(*pins.rod_center(chain, turn))
        assert speed(lambda t: pins.rod_center(chain, t)) == pytest.approx(-1j * (rod - contact), rel=1e-7)


@ROLLING
def test_pins_fit_their_holes_and_touch_each_other_only_at_one_point(chain):
    plate = design_plate(chain)
    left, right = (solid(pin) for pin in plate.own_pins)
    hole = solid(plate.holes[1])
    chords = 2e-11  # [m^2] between the chords of equal arcs: length of the boundary times tolerance
    assert right.difference(hole).area < chords
    for turn in np.linspace(0, plate.pins.turn, 7):
        other = shapely.Polygon(place(plate.own_pins[0].points(1e-9), neighbour(chain, turn)))
        assert other.intersection(right).area < chords and other.distance(right) < 1e-8
        assert other.difference(hole).area < chords
    assert left.centroid.x == pytest.approx(-right.centroid.x, rel=1e-9)


def test_neighbour_has_its_whole_play_from_straight_to_the_largest_turn():
    pins = RoundPins(clearance=1.15, turn=0.4, back_turn=0.02)
    ring = solid(design_plate(GROUP3, pins).holes[1], 1e-10).exterior
    for turn in np.linspace(0.16, 0.4, 5):
        assert ring.distance(shapely.Point(neighbour_center(GROUP3, turn))) == pytest.approx(1.15 * 1.2e-3, rel=1e-6)


@pytest.mark.parametrize("pins", [RoundPins(), RoundPins(1.2, 0.3, 0.05, 0.3)])
def test_joint_stops_where_the_pin_meets_the_slot(pins):
    ring = solid(design_plate(GROUP3, pins).holes[1], 1e-11).exterior
    for limit in pins.limits(GROUP3):
        assert ring.distance(shapely.Point(neighbour_center(GROUP3, limit))) == pytest.approx(1.2e-3, abs=1e-9)
    assert pins.limits(GROUP3)[0] == -pins.back_turn and pins.limits(GROUP3)[1] > pins.turn


def test_rocker_stops_where_its_rod_meets_the_slot_or_its_face_ends():
    pins = RockerPins(1.6e-3, 2.0e-3, 0.15e-3, 0.3)
    slot = pins.hole(CLASSICAL)["slot"]
    back, forward = pins.limits(CLASSICAL)
    edge = 2 * np.arcsin(np.max(np.abs(np.imag([ends(p)[0] for p in pins.pin(CLASSICAL).pieces]))) / 7.4e-3)
    for limit in (back, forward):
        meets = np.hypot(*(pins.rod_center(CLASSICAL, limit) - slot.center)) + 1.6e-3 - slot.radius
        assert abs(meets) < 1e-12 or abs(limit) == pytest.approx(edge, rel=1e-12)
    assert -edge < back < 0 and forward > 0.3
    generous = RockerPins(1.6e-3, 2.0e-3, 0.35e-3, 0.3)
    assert generous.limits(CLASSICAL)[1] == pytest.approx(edge, rel=1e-12)


def test_rocker_is_a_rod_with_a_rolling_face_through_the_pitch_point():
    pins = default_pins(CLASSICAL)
    back, face = pins.pin(CLASSICAL).pieces
    assert steps((back, face))[0] < 1e-17
    assert face.radius == 7.4e-3 and face.center[0] - face.radius == pytest.approx(P / 2, rel=1e-12)
    assert back.center[0] + back.radius == pytest.approx(P / 2 + pins.thickness, rel=1e-14)
    seat = pins.hole(CLASSICAL)["seat"]
    assert (seat.center, seat.radius) == (back.center, back.radius)


def test_large_rolling_radius_needs_rockers_and_no_radius_a_hinge():
    assert isinstance(default_pins(GROUP3), RoundPins)
    assert isinstance(default_pins(CLASSICAL), RockerPins)
    assert default_pins(HINGE) == HingePin(P / 8)
    design_plate(design_link(P, 0.1799 * P, A, 2.6e-3), back=3.6e-3)


@pytest.mark.parametrize("side, facing", [("right", 0.0), ("left", np.pi)])
@LINKS
def test_own_pin_is_seated_outwards(chain, side, facing):
    plate = design_plate(chain)
    seat = plate.seat(side)
    middle = seat.start + 0.5 * seat.sweep
    assert seat.sweep > 0 and abs(np.angle(np.exp(1j * (middle - facing)))) < 0.13
    assert isinstance(seat, Arc) and np.sign(seat.center[0]) == np.cos(facing)


def test_seat_of_round_pins_spans_all_but_the_throat():
    pins = RoundPins(rounding=0.0)
    seat = pins.hole(GROUP3)["seat"]
    near = np.arccos((1 + 4 - 1.12**2) / 4)  # where circles of radii 1 and 1.12, 2 apart, meet
    up, low = np.pi - pins.turn / 2, np.pi - 2 * np.arcsin(0.03) + pins.back_turn / 2
    assert seat.start + seat.sweep == pytest.approx(up - near, rel=1e-13)
    assert seat.start + 2 * np.pi == pytest.approx(low + near, rel=1e-13)
    assert "throat upper" not in pins.hole(GROUP3)


def test_walls_of_a_hinged_plate():
    plate = design_plate(HINGE, HingePin(1.5e-3), back=2.2e-3, shoulder_radius=0.0)
    walls = plate.walls()
    assert walls["between holes"] == pytest.approx(P - 3e-3, abs=3e-8)
    assert walls["hole to outline"] == pytest.approx(plate.back - 1.5e-3, abs=3e-8)
    width = (GROUP3.flank_support + plate.toe * np.sin(A)) * 2 / np.cos(A) - P - plate.inner_gap / np.cos(A)
    assert walls["toe"] == pytest.approx(width, rel=1e-12)


def test_a_hole_that_breaks_out_leaves_no_wall():
    assert design_plate(GROUP3, back=1.7e-3, shoulder_radius=1e-3).walls()["hole to outline"] == 0.0


@ROLLING
def test_three_times_the_chain_is_the_same_chain(chain):
    big = Link(3 * chain.hole_pitch, 3 * chain.radius, chain.flank_angle, 3 * chain.flank_support)
    small, large = design_plate(chain), design_plate(big)
    assert large.moments.area == pytest.approx(9 * small.moments.area, rel=1e-12)
    assert large.moments.polar == pytest.approx(81 * small.moments.polar, rel=1e-12)
    assert large.pins.limits(big) == pytest.approx(small.pins.limits(chain), rel=1e-9)
    assert large.walls(3e-8)["hole to outline"] == pytest.approx(3 * small.walls(1e-8)["hole to outline"], rel=1e-6)


def test_mass_of_a_link_is_that_of_its_sheets_and_pins():
    plate, density, length = design_plate(GROUP3), 7850.0, 9e-3
    one, two = (link_mass(plate, n, density, length) for n in (1, 2))
    pins = 2 * np.pi * (1.2e-3) ** 2 * length * density
    sheet = plate.moments.area * plate.thickness * density
    assert (one.mass, two.mass) == pytest.approx((sheet + pins, 2 * sheet + pins), rel=1e-12)
    assert two.height == pytest.approx(2 * sheet * plate.moments.centroid[1] / two.mass, rel=1e-12)
    about_pins = pins * ((0.5 * GROUP3.hole_pitch) ** 2 + 0.5 * (1.2e-3) ** 2)
    about_line = 2 * density * plate.thickness * plate.moments.polar + about_pins
    assert two.inertia == pytest.approx(about_line - two.mass * two.height**2, rel=1e-12)
    assert mass_per_pitch(plate, (1, 2), density, length) == pytest.approx(1.5 * sheet + pins, rel=1e-12)


def test_links_share_a_hinge_pin():
    plate = design_plate(HINGE, HingePin(1.5e-3))
    link_of_two = link_mass(plate, 2, 7850.0, 8e-3).mass
    pin = np.pi * (1.5e-3) ** 2 * 8e-3 * 7850
    assert link_of_two - 2 * plate.moments.area * plate.thickness * 7850 == pytest.approx(pin, rel=1e-10)


def test_drawing_has_profile_and_two_holes():
    plate = design_plate(GROUP3)
    drawing = plate.drawing("p")
    assert drawing.thickness == plate.thickness and len(drawing.on("hole")) == 2
    holes = sum(map(outline_area, drawing.on("hole")))
    assert outline_area(drawing.on("profile")[0]) - holes == pytest.approx(plate.moments.area, rel=1e-13)


def test_samples_along_named_pieces_are_dense_and_on_them():
    plate = design_plate(GROUP3)
    names, points = sampled(plate.pieces, 5e-5)
    step = np.hypot(*np.diff(points, axis=0).T)
    assert np.max(step) <= 5e-5 * (1 + 1e-9) and set(names) == set(plate.pieces)
    on_flank = points[names == "flank right"]
    assert np.ptp(on_flank @ (np.cos(A), -np.sin(A))) < 1e-16
