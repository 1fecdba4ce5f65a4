"""Wheel and locking disc: walls, undercut, clearance, play, against polygons and constructions of their own."""

import numpy as np
import pytest
import shapely

from drivewright.chains.plate_outline import area_moments
from drivewright.indexing.geneva.locking import dwell_play, locking_clearance
from drivewright.indexing.geneva.shapes import GenevaShape
from drivewright.indexing.geneva.step import GenevaStep

pytestmark = pytest.mark.property

C = 0.1


def shape(slots=5, pin=0.006, locking=None, **changes):
    step = GenevaStep(slots, C, C * float(np.sin(np.pi / slots)))
    sizes = {
        "slot_clearance": 4e-5,
        "end_clearance": 1e-3,
        "outer_radius": float(np.hypot(C * np.cos(np.pi / slots), pin)),
        "locking_radius": step.crank_radius - 3 * pin if locking is None else locking,
        "locking_clearance": 5e-5,
        "relief": 1e-3,
    } | changes
    return GenevaShape(step, pin, **sizes)


def polygon(outline):
    return shapely.Polygon(outline.points(1e-7))


def disc(centre, radius):
    return shapely.Point(centre.real, centre.imag).buffer(radius, quad_segs=512)


@pytest.mark.parametrize("made", [shape(3, 0.004), shape(4), shape(5), shape(8), shape(18, 0.002), shape(4, 0.008, 0.0655)])
def test_outlines_are_closed_and_simple(made):
    for outline in (made.wheel_outline, made.disc_outline):
        body = polygon(outline)
        assert body.is_valid and body.exterior.is_ccw
        assert area_moments(outline).area == pytest.approx(body.area, rel=1e-4)
    assert polygon(made.wheel_outline).area < np.pi * made.outer_radius**2


@pytest.mark.parametrize("made", [shape(4), shape(7), shape(4, 0.008, 0.0655)])
def test_the_wheel_is_a_disc_with_slots_and_arcs_cut_out(made):
    body = disc(0j, made.outer_radius)
    for k in range(made.step.slots):
        along = np.exp(2j * np.pi * k / made.step.slots)
        ends = [(z.real, z.imag) for z in (made.slot_end * along, 0.2 * along)]
        body = body.difference(shapely.LineString(ends).buffer(made.slot_width / 2, quad_segs=512))
        body = body.difference(disc(C * along * np.exp(1j * np.pi / made.step.slots), made.arc_radius))
    largest = max(getattr(body, "geoms", [body]), key=lambda part: part.area)
    assert polygon(made.wheel_outline).symmetric_difference(largest).area < 2e-5 * largest.area


def test_walls_are_distances_of_the_parts():
    made = shape(5)
    slots = [
        shapely.LineString([(z.real, z.imag) for z in (made.slot_end * a, 0.2 * a)]).buffer(made.slot_width / 2, quad_segs=512)
        for a in np.exp(2j * np.pi * np.arange(2) / 5)
    ]
    assert made.slot_wall == pytest.approx(slots[0].distance(slots[1]), abs=1e-7)
    assert made.mouth_wall == pytest.approx(slots[0].distance(disc(C * np.exp(1j * np.pi / 5), made.arc_radius)), abs=1e-7)
    assert made.slot_bottom == pytest.approx(slots[0].distance(shapely.Point(0, 0)), abs=1e-7)


def test_the_pin_keeps_its_clearance_from_the_bottom_of_the_slot():
    made = shape(5, end_clearance=2e-3)
    deepest = C - made.step.crank_radius - made.pin_radius
    assert deepest - made.slot_bottom == pytest.approx(2e-3, rel=1e-12)
    assert made.slot_length == pytest.approx(made.outer_radius - made.slot_bottom, rel=1e-12)


@pytest.mark.parametrize("slots", [3, 4, 8])
def test_a_relief_without_allowance_leaves_the_round_part_at_right_angles(slots):
    made = shape(slots, 0.003, relief=0.0)
    relief = made.disc_relief
    assert relief.center[0] ** 2 == pytest.approx(made.locking_radius**2 + relief.radius**2, rel=1e-9)
    assert relief.center[0] - relief.radius == pytest.approx(made.relief_depth, rel=1e-9)


def test_an_undercut_slot_is_shorter_by_what_the_arc_takes():
    """The arc of a large disc reaches over the side of the slot, which ends where the arc cuts it."""
    made, whole = shape(4, 0.008, 0.0655), shape(4, 0.008)
    assert made.mouth_wall < 0 < whole.mouth_wall and whole.undercut == 0
    side = shapely.LineString([(made.slot_end, made.slot_width / 2), (0.2, made.slot_width / 2)])
    left = side.intersection(disc(0j, made.outer_radius)).difference(disc(C * np.exp(1j * np.pi / 4), made.arc_radius))
    ends = max(getattr(left, "geoms", [left]), key=lambda part: part.length)
    assert made.side_end == pytest.approx(max(x for x, _ in ends.coords), abs=1e-6)
    assert made.undercut == pytest.approx(np.sqrt(made.outer_radius**2 - made.slot_width**2 / 4) - made.side_end, rel=1e-12)


@pytest.mark.parametrize("slots", [3, 4, 6, 9, 12])
def test_the_disc_clears_the_wheel_by_its_clearance_at_entry(slots):
    made = shape(slots, 0.002 if slots > 8 else 0.004)
    found = locking_clearance(made)
    assert found.distance[0] == pytest.approx(made.locking_clearance, abs=1e-12)
    assert np.min(found.distance) == pytest.approx(made.locking_clearance, abs=1e-9)


@pytest.mark.parametrize("relief", [1e-3, -8e-3])
def test_the_clearance_is_the_distance_of_polygons(relief):
    """A relief that is too flat overlaps: then it is the depth."""
    made = shape(4, 0.006, relief=relief)
    found, wheel, rim = locking_clearance(made), polygon(made.wheel_outline), polygon(made.disc_outline)
    for theta, distance in list(zip(found.angle, found.distance, strict=True))[:: len(found.angle) // 6]:
        turn = np.pi - float(made.step.pin_direction(theta).d0)
        placed = shapely.affinity.translate(shapely.affinity.rotate(wheel, turn, (0, 0), use_radians=True), C)
        turned = shapely.affinity.rotate(rim, theta, (0, 0), use_radians=True)
        if distance > 0:
            assert distance == pytest.approx(placed.distance(turned), abs=2e-5)
        else:
            assert placed.intersection(turned).area > 0
    assert (np.min(found.distance) < -1e-4) == (relief < 0)


def test_the_play_turns_the_horn_onto_the_disc():
    made = shape(6, 0.004)
    horn = made.horn * np.exp(1j * (np.pi - np.pi / 6))  # the arc looks at the crank
    for side in (-1, 1):
        near = C + (horn if side > 0 else np.conj(horn)) * np.exp(1j * side * dwell_play(made))
        far = C + (horn if side > 0 else np.conj(horn)) * np.exp(-1j * side * dwell_play(made))
        assert min(abs(near), abs(far)) == pytest.approx(made.locking_radius, rel=1e-12)
    assert dwell_play(shape(6, 0.004, locking_clearance=0.0)) == pytest.approx(0.0, abs=1e-9)
