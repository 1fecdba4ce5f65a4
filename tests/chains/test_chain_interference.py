"""Gaps between plates and sprockets: exact supports against samples, the real outline against polygons, poses turned together."""

from dataclasses import replace

import numpy as np
import pytest
import shapely

from drivewright.chains.interference import (
    flank_gap,
    foot_radius,
    in_sprocket,
    involute_gap,
    overlap_area,
    plate_gaps,
    profile_gap,
    sampled,
    seated_poses,
    seating_speeds,
)
from drivewright.chains.link import Link, chordal_rise, design_link, seat_height
from drivewright.chains.plate import design_plate
from drivewright.chains.sprocket import design_sprocket
from drivewright.chains.tooth import matching_cutter
from drivewright.scene import place

pytestmark = pytest.mark.analytical

P, A = 9.525e-3, np.radians(30)
CHAIN = design_link(P, 1.2e-3, A, 2.6e-3)
CLASSICAL = Link(P + 14.8e-3, 7.4e-3, A, CHAIN.flank_support)
PLATE, SPROCKET = design_plate(CHAIN), design_sprocket(CHAIN, 35)
SIDES = ("left", "right")


def flank_line(plate, side, count=20001):
    """Points along an active flank, crowded about the contact."""
    flank = plate.flank(side)
    return np.linspace(flank.start, flank.end, count)


def arriving(chain, teeth, turn):
    """Pose of the plate after a seated one on the y axis, the joint between them turned by `turn`."""
    half = 0.5 * chain.hole_pitch
    own = np.array([half, seat_height(chain, teeth)])
    other = own + 2 * chain.radius * np.array([-np.cos(turn / 2), np.sin(turn / 2)])
    return np.array([*(other + half * np.array([np.cos(turn), -np.sin(turn)])), -turn])


def strand(chain, teeth, turn, count):
    """Poses of straight plates after a seated one, the first joint turned by `turn`."""
    first = arriving(chain, teeth, turn)
    steps = np.arange(count)[:, None] * chain.pitch * np.array([np.cos(turn), -np.sin(turn), 0.0])
    return first + steps


@pytest.mark.parametrize("degrees", [20.0, 25.0, 27.0, 30.0, 31.5])
@pytest.mark.parametrize("teeth", [35, 37])
def test_seated_flank_touches_at_the_contact_radius_and_nowhere_else(degrees, teeth):
    sprocket = design_sprocket(CHAIN, teeth, matching_cutter(P, A, np.radians(degrees)))
    for side in SIDES:
        center = np.array(PLATE.contact(sprocket.tooth, side))
        flank = PLATE.flank(side)
        along = np.subtract(flank.end, flank.start) / np.hypot(*np.subtract(flank.end, flank.start))
        offsets = np.concatenate([-np.geomspace(1e-8, 1e-3, 50), [0.0], np.geomspace(1e-8, 1e-3, 50)])
        (pose,) = seated_poses(CHAIN, teeth, [0])
        points = in_sprocket(center + offsets[:, None] * along, pose)
        gaps = involute_gap(sprocket, points)
        assert abs(gaps[50]) < 2e-16 + 1e-17 / P and np.all(gaps[np.abs(offsets) > 1e-6] > 0)
        expected = offsets**2 / (2 * sprocket.tooth.curvature_radius)  # a line on a circle
        np.testing.assert_allclose(gaps, expected, atol=1e-16, rtol=6e-2)
        assert foot_radius(sprocket, points)[50] == pytest.approx(sprocket.tooth.contact_radius, rel=1e-14)


@pytest.mark.parametrize("number", [0, 3, -5, 17])
@pytest.mark.parametrize("side", SIDES)
def test_every_seated_flank_has_no_gap(number, side):
    (pose,) = seated_poses(CHAIN, 35, [number], 0.7)
    gap = flank_gap(CHAIN, SPROCKET.tooth, pose, side, 0.7)
    assert gap.gap == pytest.approx(0.0, abs=3e-17)
    assert gap.radius == pytest.approx(SPROCKET.tooth.contact_radius, rel=1e-14)
    assert gap.height == pytest.approx(PLATE.contact(SPROCKET.tooth, side)[1], rel=1e-12)


@pytest.mark.parametrize("side", SIDES)
def test_flank_gap_is_the_least_gap_of_the_flank_s_points(side):
    """Away from the seat: second route by samples."""
    rng = np.random.default_rng(5)
    (seat,) = seated_poses(CHAIN, 35, [2], 0.1)
    for _ in range(20):
        pose = seat + rng.uniform(-1, 1, 3) * (3e-5, 3e-5, 2e-3)
        exact = flank_gap(CHAIN, SPROCKET.tooth, pose, side, 0.1)
        points = in_sprocket(flank_line(PLATE, side), pose, 0.1)
        gaps = involute_gap(SPROCKET, points)
        assert exact.gap == pytest.approx(np.min(gaps), abs=3e-12)
        least = int(np.argmin(gaps))
        assert exact.height == pytest.approx(flank_line(PLATE, side)[least][1], abs=5e-7)
        assert exact.radius == pytest.approx(foot_radius(SPROCKET, points)[least], abs=5e-7)


@pytest.mark.parametrize("side", SIDES)
def test_a_thicker_tooth_takes_its_excess_from_the_gap(side):
    thick = SPROCKET.tooth._replace(support=SPROCKET.tooth.support - 2e-5)
    gap = flank_gap(CHAIN, thick, seated_poses(CHAIN, 35, [4])[0], side)
    assert gap.gap == pytest.approx(-2e-5, rel=1e-10)
    points = in_sprocket(flank_line(PLATE, side), seated_poses(CHAIN, 35, [4])[0])
    assert np.min(involute_gap(replace(SPROCKET, tooth=thick), points)) == pytest.approx(-2e-5, rel=1e-6)


def test_profile_gap_is_the_signed_distance_from_the_outline():
    body = shapely.Polygon(SPROCKET.outline(1e-9).points(1e-9))
    rng = np.random.default_rng(2)
    radius, angle = rng.uniform(0.0455, 0.0525, 300), rng.uniform(0, 2 * np.pi, 300)
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    gaps = profile_gap(SPROCKET, points, 1e-9)
    signed = [body.exterior.distance(q) * (-1 if body.contains(q) else 1) for q in map(shapely.Point, points)]
    np.testing.assert_allclose(gaps, signed, atol=4e-9)
    assert min(gaps) < -1e-4 and max(gaps) > 1e-4


def test_profile_and_involute_agree_beside_a_flank():
    flank = SPROCKET.flank_points(41)[2:-2]
    normal = np.stack([flank[:, 1], -flank[:, 0]], axis=1) / np.hypot(*flank.T)[:, None]
    points = flank + 2e-5 * normal
    exact = involute_gap(SPROCKET, points)
    np.testing.assert_allclose(profile_gap(SPROCKET, points), exact, atol=1.1e-8)
    assert np.all(exact > 1e-5)


@pytest.mark.parametrize("teeth", [35, 37, 19])
@pytest.mark.parametrize(
    "chain",
    [CHAIN, CLASSICAL, design_link(P, 1.6e-3, A, CHAIN.flank_support - 0.5 * (P + 3.2e-3) * np.cos(A))],
    ids=["group 3", "classical", "group 7"],
)
def test_default_plates_seat_without_touching_elsewhere(chain, teeth):
    plate, sprocket = design_plate(chain), design_sprocket(chain, teeth)
    assert min(sprocket.contact_margins) > 0.1e-3
    poses = seated_poses(chain, teeth, [0, 1])
    for pose, found in zip(poses, plate_gaps(plate, sprocket, poses), strict=True):
        assert found.gap == pytest.approx(0.0, abs=6e-8) and found.piece.startswith("flank")
        assert overlap_area(plate, sprocket, pose) < 1e-12
    straight = strand(chain, teeth, 0.9 * 2 * np.pi / teeth, 6)
    assert all(found.gap > 1e-6 for found in plate_gaps(plate, sprocket, straight))
    for side in SIDES:
        touch = flank_gap(chain, sprocket.tooth, poses[0], side)
        low, high = sorted(end[1] for end in plate.flank(side))
        assert low < touch.height < high


def test_seated_plate_clears_tip_and_root():
    pieces = {name: piece for name, piece in PLATE.pieces.items() if "flank" not in name}
    _, points = sampled(pieces, 2e-5)
    gaps = profile_gap(SPROCKET, in_sprocket(points, seated_poses(CHAIN, 35, [0])[0]))
    assert np.min(gaps) > 0.05e-3


@pytest.mark.parametrize("crotch, overlaps", [(-1.4e-3, False), (-2.0e-3, True)])
def test_a_deep_crotch_is_found_to_sit_on_the_tip(crotch, overlaps):
    """The tip stands 1.7 mm below the pin line."""
    plate = replace(PLATE, crotch=crotch)
    found = plate_gaps(plate, SPROCKET, seated_poses(CHAIN, 35, [1]))[0]
    area = overlap_area(plate, SPROCKET, seated_poses(CHAIN, 35, [1])[0])
    if overlaps:
        assert found.gap == pytest.approx(-0.3e-3, rel=1e-3) and found.piece == "crotch"
        assert area == pytest.approx(0.3e-3 * SPROCKET.thickness(SPROCKET.tip_radius - 0.3e-3), rel=0.1)
    else:
        assert found.gap > -1e-12 and area == pytest.approx(0.0, abs=1e-13)


def test_sprocket_and_chain_turned_together_keep_their_gaps():
    poses = strand(CHAIN, 35, 0.13, 3)
    turned = np.column_stack([place(poses[:, :2], (0, 0, 1.234)), poses[:, 2] + 1.234])
    for one, other in zip(plate_gaps(PLATE, SPROCKET, poses), plate_gaps(PLATE, SPROCKET, turned, 1.234), strict=True):
        assert other.gap == pytest.approx(one.gap, abs=1e-12) and other.piece == one.piece
    for side in SIDES:
        one, other = flank_gap(CHAIN, SPROCKET.tooth, poses[0], side), flank_gap(CHAIN, SPROCKET.tooth, turned[0], side, 1.234)
        assert other == pytest.approx(one, rel=1e-9)


def test_seated_plates_close_to_the_polygon_of_the_joint():
    """Neighbours stand where the joint turned by the whole pitch angle puts them; the strand's rise belongs to the same h."""
    poses = seated_poses(CHAIN, 35, [0, 1])
    np.testing.assert_allclose(arriving(CHAIN, 35, 2 * np.pi / 35), poses[1], atol=1e-16)
    assert poses[0][1] == seat_height(CHAIN, 35) > 0 and chordal_rise(CHAIN, 35) > 0


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("chain", [CHAIN, CLASSICAL], ids=["new", "classical"])
def test_approach_is_the_rate_of_the_gap(chain, side):
    plate, sprocket = design_plate(chain), design_sprocket(chain, 35)
    phi, step = 2 * np.pi / 35, 1e-6
    before, after = (flank_gap(chain, sprocket.tooth, arriving(chain, 35, phi + d), side).gap for d in (-step, step))
    approach, sliding = seating_speeds(plate, sprocket.tooth, side)
    assert (before - after) / (2 * step) == pytest.approx(approach, rel=1e-7)
    places = [place([plate.contact(sprocket.tooth, side)], arriving(chain, 35, phi + d))[0] for d in (-step, step)]
    speed = (places[1] - places[0]) / (2 * step)
    assert np.hypot(*speed) == pytest.approx(np.hypot(approach, sliding), rel=1e-7)
    flank = np.subtract(*sorted((plate.flank(side).start, plate.flank(side).end), key=lambda end: -end[1]))  # outwards
    outwards = place([flank / np.hypot(*flank)], (0, 0, -phi))[0]
    assert speed @ outwards == pytest.approx(sliding, rel=1e-6)


def test_a_far_plate_has_a_gap_too():
    found = plate_gaps(PLATE, SPROCKET, [(0.3, 0.0, 0.0)])[0]
    assert found.gap == pytest.approx(0.3 - SPROCKET.tip_radius, abs=9.2e-3)
