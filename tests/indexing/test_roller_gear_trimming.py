"""Trimming, contact map, play and loads of roller-gear cams against brute force and closed forms."""

import dataclasses

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from drivewright.contact import hertz
from drivewright.indexing.motion import TURN, index_motion
from drivewright.indexing.roller_gear import (
    FLANKS,
    axial_section,
    barrel,
    compute_flanks,
    compute_roller_loads,
    find_trim_edges,
    find_turret_play,
    flank_contact,
    globoidal,
)
from drivewright.indexing.roller_gear.trimming import TrimmingTest, tabulate_motion

pytestmark = pytest.mark.analytical

MOTION = index_motion("modified-sine", 12, 2.0)
SHARP = index_motion("cycloidal", 12, 0.5)
HOURGLASS = globoidal(MOTION, 0.08, 0.012, 0.016, 0.125, 0.06)
DRUM = barrel(MOTION, 0.09, 0.012, 0.016, 0.05, 0.075, centre_distance=0.088, hand="left")
THICK = globoidal(SHARP, 0.08, 0.0165, 0.022, 0.115, 0.075)  # undercut by steep motion, ribs cut away by the next roller
THICK_DRUM = barrel(SHARP, 0.09, 0.0205, 0.02, 0.05, 0.08)
GOOD = pytest.mark.parametrize("cam", [HOURGLASS, DRUM], ids=["globoidal", "barrel"])
BAD = pytest.mark.parametrize("cam", [THICK, THICK_DRUM], ids=["globoidal", "barrel"])


def brute_gap(cam, points, count=2400):
    """Least gap of points to all N rollers at `count` angles of the cam, by rotations of scipy and projections."""
    least = np.full(len(points), np.inf)
    direction = np.array([1.0, 0, 0]) if cam.kind == "globoidal" else np.array([0, 0, 1.0])
    for theta in np.arange(count) * TURN / count:
        seen = Rotation.from_euler("y", cam.hand_sign * theta).apply(points) + [cam.centre_distance, 0, cam.height]
        phi = cam.motion(theta).d0 + cam.motion.pitch * cam.phase
        for turn in phi + cam.motion.pitch * np.arange(-3, 3):
            local = Rotation.from_euler("z", -turn).apply(seen) - [cam.pin_circle_radius, 0, 0]
            along = local @ direction
            away = np.linalg.norm(local - along[:, None] * direction, axis=1)
            least = np.minimum(least, np.maximum(away - cam.roller_radius, np.abs(along) - cam.roller_length / 2))
    return least


def test_the_table_of_the_motion_is_exact():
    ends, cells = tabulate_motion(MOTION)
    h = 0.37 * np.diff(ends)
    phi = sum(cells[:, k] * h**k for k in range(6))
    np.testing.assert_allclose(phi, MOTION(ends[:-1] + h).d0, atol=1e-11)
    for segment in MOTION.segments:
        assert np.min(np.abs(ends - segment.stop)) < 1e-12


@GOOD
def test_a_sound_cam_keeps_all_its_flanks(cam):
    found = compute_flanks(cam)
    assert found.undercut == 0
    inside = cam.in_blank(found.contact.point) >= -1e-12
    assert 0.1 < inside.mean() < 0.9 and np.array_equal(inside, found.on_cam)
    rng = np.random.default_rng(3)
    points = found.contact.point[found.on_cam]
    assert brute_gap(cam, points[rng.choice(len(points), 60, replace=False)], 700).min() > -1e-9


@GOOD
def test_the_dip_of_a_points_own_roller_is_found_to_its_bottom(cam):
    """At any angle, also between the knots of the table: depth 0, for a point a little inside the roller's path its depth."""
    rng = np.random.default_rng(11)
    travel = rng.uniform(TURN * min(cam.rollers), TURN * (max(cam.rollers) + 1), 400)
    found = flank_contact(cam, travel, rng.uniform(-0.4, 0.4, 400) * cam.roller_length, rng.choice(FLANKS, 400))
    inside = cam.in_blank(found.point) > 0
    points, normals = found.point[inside], found.normal[inside]
    np.testing.assert_allclose(TrimmingTest(cam).minimum_gaps(points), 0, atol=1e-11)
    np.testing.assert_allclose(TrimmingTest(cam).minimum_gaps(points + 1e-6 * normals), 1e-6, rtol=1e-3)
    assert len(points) > 100


def test_trimming_does_not_depend_on_the_unit_of_length():
    big = globoidal(SHARP, 80.0, 16.5, 22.0, 115.0, 75.0)
    one, two = (compute_flanks(cam, np.linspace(0, TURN, 41), 5) for cam in (THICK, big))
    assert np.array_equal(one.on_cam, two.on_cam)
    np.testing.assert_allclose(one.active_fraction, two.active_fraction, atol=1e-4)


@BAD
def test_survivors_are_those_of_brute_force(cam):
    """Random points on both flanks of a cam with undercut: alive exactly where no roller at any angle covers them."""
    rng = np.random.default_rng(5)
    travel = rng.uniform(TURN * min(cam.rollers), TURN * (max(cam.rollers) + 1), 1500)
    found = flank_contact(cam, travel, rng.uniform(-0.5, 0.5, 1500) * cam.roller_length, rng.choice(FLANKS, 1500))
    inside = cam.in_blank(found.point) > 0
    gap = brute_gap(cam, found.point[inside], 1200)
    clear = (gap > -1e-12) | (gap < -2e-6)  # at 1200 angles a graze may be missed
    alive = TrimmingTest(cam).on_cam(found)[inside]
    assert not np.any(alive & (gap < -1e-8))
    assert np.mean(alive[clear] == (gap[clear] > -1e-9)) > 0.99
    assert 0.02 < np.mean(~alive) < 0.9


@BAD
def test_trim_edges_lie_on_the_roller_that_cuts(cam):
    """Where the flank ends inside the blank, a second roller position touches, or the envelope turns singular."""
    found = compute_flanks(cam, np.linspace(0, TURN, 61), 5)
    edges = find_trim_edges(found)
    assert len(edges) > 10
    gap = TrimmingTest(cam).minimum_gaps(edges)
    assert np.all(gap > -1e-7 * cam.roller_radius) and np.all(cam.in_blank(edges) > -1e-9)
    assert found.undercut > 0.02


def test_local_undercut_has_no_opening_left():
    found = compute_flanks(THICK)
    assert found.contact.opening.min() < 0
    assert np.all(found.contact.opening[found.on_cam] > 0)


@GOOD
def test_the_map_names_the_rollers_between_the_ends(cam):
    """In the dwell both rollers beside the rib touch it; forward flank on the roller before it, and so on for every roller in the blank."""
    found = compute_flanks(cam, np.array([5.0]))
    psi = cam.motion.pitch * (1.5 + np.array(cam.rollers))
    for side, flank in enumerate(FLANKS):
        wall = flank_contact(cam, 5.0 + TURN * np.array(cam.rollers)[:, None], found.u, flank).point
        assert np.array_equal(found.contact_map[side][:, 0], np.any(cam.in_blank(wall) > 0, axis=1))
    middle = np.argmin(np.abs(psi - np.pi / 12)), np.argmin(np.abs(psi + np.pi / 12))
    assert found.contact_map[1, middle[1], 0] and found.contact_map[0, middle[0], 0]


def test_part_of_a_line_within_the_blank_is_exact():
    """The rollers stand beside the middle of the drum, so that their lines begin below their feet, on the drum's cylinder."""
    found = compute_flanks(DRUM, np.array([5.0]), 9)
    cut = (found.active_fraction > 0) & (found.active_fraction < 1)
    assert cut.any()
    for flank, roller, _, cell in np.argwhere(cut):
        u = found.u[cell : cell + 2]
        first = found.on_cam[flank, roller, 0, cell]
        length = found.active_fraction[flank, roller, 0, cell] * np.diff(u)[0]
        at = u[0] + length if first else u[1] - length
        edge = flank_contact(DRUM, 5.0 + TURN * DRUM.rollers[roller], at, FLANKS[flank])
        assert DRUM.in_blank(edge.point) == pytest.approx(0, abs=1e-10)


# ------------------------------------------------------------------------------------------------------------------ play


@GOOD
def test_a_sound_cam_has_no_play(cam):
    found = compute_flanks(cam, np.linspace(0, TURN, 31))
    for direction in (1, -1):
        assert np.all(find_turret_play(found, direction) < 1e-9)


def test_play_without_one_flank_has_its_closed_form():
    """With the backward flanks ground away the turret of a barrel at rest turns forward until a roller meets the ring before it.

    R sin(psi - pitch + play) = R sin(psi) - 2 r, for the rings of the rollers at psi = -15 and 15 deg; the nearer one counts.
    """
    found = compute_flanks(DRUM, np.linspace(0, TURN, 361))
    one_sided = dataclasses.replace(found, on_cam=found.on_cam & (FLANKS > 0)[:, None, None, None])
    wanted = [np.arcsin(np.sin(psi) - 2 * 0.012 / 0.09) - psi + np.pi / 6 for psi in (np.pi / 12, -np.pi / 12)]
    assert find_turret_play(one_sided, 1, [5.2])[0] == pytest.approx(min(wanted), rel=1e-3)
    assert find_turret_play(one_sided, -1, found.theta[[290]])[0] < 1e-9
    assert find_turret_play(one_sided, -1, [5.2])[0] < 2e-4  # between the angles of the table
    nothing = dataclasses.replace(found, on_cam=np.zeros_like(found.on_cam))
    assert find_turret_play(nothing, 1, [5.2])[0] == np.inf


def test_play_of_a_cam_with_undercut_is_where_the_rollers_reach_it():
    """Turned by the play the rollers touch the finished cam, turned by more they cut into it."""
    found = compute_flanks(THICK)
    free = find_turret_play(found, 1)
    worst = int(np.argmax(np.where(np.isfinite(free), free, 0)))
    assert free[worst] > 1e-3
    points = np.concatenate([found.contact.point[found.on_cam], find_trim_edges(found)])
    seen = Rotation.from_euler("y", THICK.hand_sign * found.theta[worst]).apply(points) + [THICK.centre_distance, 0, 0]
    phi = THICK.motion(found.theta[worst]).d0 + THICK.motion.pitch / 2
    depths = []
    for extra in (0.98, 1.02):
        gaps = []
        for turn in phi + extra * free[worst] + THICK.motion.pitch * np.arange(-3, 3):
            local = Rotation.from_euler("z", -turn).apply(seen) - [THICK.pin_circle_radius, 0, 0]
            away = np.hypot(local[:, 1], local[:, 2]) - THICK.roller_radius
            gaps.append(np.where(np.abs(local[:, 0]) < THICK.roller_length / 2, away, 1.0))
        depths.append(np.min(gaps))
    assert depths[0] > -1e-9 > depths[1]


# ----------------------------------------------------------------------------------------------------------------- loads


@GOOD
@pytest.mark.parametrize("torque", [250.0, -250.0])
def test_the_loads_of_the_rollers_balance_the_torque(cam, torque):
    found = compute_flanks(cam, np.linspace(0, TURN, 31), 33)
    loads = compute_roller_loads(found, torque, 115e9)
    side = 1 if torque > 0 else 0
    turning = found.integrate_along_lines(found.contact.arm)[side] * loads.line_load
    np.testing.assert_allclose(turning.sum(axis=0), -torque, rtol=1e-12)
    np.testing.assert_allclose(loads.force.sum(axis=0) * cam.pin_circle_radius * 1.1 >= abs(torque), True)
    assert np.isfinite(loads.pressure_maximum).all()


def test_pressure_of_one_roller_at_rest_has_its_closed_form():
    """A short barrel holds one roller per flank in the dwell: F = T/(R cos(pressure angle)), line on plane of the roller's full length."""
    cam = barrel(MOTION, 0.09, 0.012, 0.016, 0.05, 0.062)
    found = compute_flanks(cam, np.array([5.0]), 41)
    loads = compute_roller_loads(found, 300.0, 115e9)
    (touching,) = np.flatnonzero(loads.force[:, 0])
    force = 300.0 / (0.09 * np.cos(np.pi / 12))
    assert loads.force[touching, 0] == pytest.approx(force, rel=1e-12)
    length = found.integrate_along_lines(np.ones_like(found.contact.arm))[1, touching, 0]
    assert loads.pressure_maximum[0] == pytest.approx(hertz.line_contact(force, length, 0.012, 115e9).pressure, rel=1e-12)
    outer = 0.05 + 0.008  # the line starts where the drum does, the roller standing beside the cam's middle
    assert length == pytest.approx(0.008 - 0.05 + np.sqrt(outer**2 - (0.09 - 0.09 * np.cos(np.pi / 12)) ** 2), rel=1e-6)


def test_pressure_grows_with_the_root_of_the_torque():
    found = compute_flanks(HOURGLASS, np.linspace(0.3, 3, 5))
    one, four = compute_roller_loads(found, 100.0, 115e9), compute_roller_loads(found, 400.0, 115e9)
    np.testing.assert_allclose(2 * one.pressure_maximum, four.pressure_maximum, rtol=1e-12)


def test_nothing_resists_where_nothing_touches():
    found = compute_flanks(HOURGLASS, np.linspace(0, 3, 4))
    nothing = dataclasses.replace(found, on_cam=np.zeros_like(found.on_cam), active_fraction=np.zeros_like(found.active_fraction))
    loads = compute_roller_loads(nothing, 100.0, 115e9)
    assert np.isnan(loads.pressure_maximum).all() and np.isnan(loads.line_load).all()
    assert np.isnan(nothing.pressure_angle_maximum).all()


# ------------------------------------------------------------------------------------------------------------------ views


@GOOD
def test_the_section_is_what_the_rollers_leave(cam):
    """Points of the plane within the section are covered by no roller; points between the section and the blank are covered by one,
    the clearances of floor and mouth aside."""
    from shapely import Polygon, contains_xy, union_all

    theta, half = 2.3, cam.roller_length / 2
    shape = union_all([Polygon(each) for each in axial_section(cam, theta)])
    rng = np.random.default_rng(7)
    y, away = rng.uniform(-0.03, 0.03, 3000), rng.uniform(cam.pitch_radius - 0.9 * half, cam.pitch_radius + 0.7 * half, 3000)
    flat = np.stack([-away, y, 0 * y], -1) if cam.kind == "globoidal" else np.stack([0 * y, y, -away], -1)
    points = Rotation.from_euler("y", -cam.hand_sign * theta).apply(flat)
    inside = cam.in_blank(points) > 0
    gap = TrimmingTest(cam).minimum_gaps(points)
    kept = contains_xy(shape, y, away)
    assert np.count_nonzero(inside & kept) > 300
    assert not np.any(inside & kept & (gap < -3e-5))
    beyond = inside & ~contains_xy(shape.buffer(cam.roller_radius / 8), y, away)
    assert np.count_nonzero(beyond) > 300 and np.all(gap[beyond] < 0)
