"""Wheels whose steps pass several pins: stations apart from pins, of every kind; where the pins stand in the dwell."""

from functools import cache

import numpy as np
import pytest

from drivewright.errors import InputError
from drivewright.indexing.drawing import pin_centre_curves
from drivewright.indexing.drivetrain import Drivetrain, PowerLawBearing
from drivewright.indexing.motion import TURN, index_motion
from drivewright.indexing.parallel import ParallelIndexer
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.plane import contacts_at, find_contacts
from drivewright.indexing.play import BACKWARD, FORWARD, find_play
from drivewright.indexing.roller_gear import barrel, cam_part, compute_flanks, develop_surface, find_turret_play, globoidal, turret_part
from drivewright.indexing.roller_gear.envelope import rotate_about_y
from drivewright.indexing.roller_gear.solid import groove_walls
from drivewright.indexing.roller_gear.views import developed_roller_centres
from drivewright.indexing.stiffness import solve_torsional_stiffness

pytestmark = pytest.mark.property

HALF = np.array([0.5, 1.9, 2.8, 4.0])


@cache
def parallel(pins=8, stations=4, phase=0.25, ratio=2.0):
    return ParallelIndexer(pins, 0.06, 6e-3, 0.09, index_motion("modified-sine", stations, ratio), phase)


@cache
def wheel(pins=12, stations=6, phase=0.0, side="inside", law="modified-sine", eccentricity=0.01):
    return PinWheel(pins, 0.12, 6e-3, eccentricity, index_motion(law, stations), side, phase)


@cache
def hourglass(pins=12, stations=6, **changes):
    given = {"pin_circle_radius": 0.08, "roller_radius": 9e-3, "roller_length": 0.016, "centre_distance": 0.125, "cam_length": 0.06}
    return globoidal(index_motion("modified-sine", stations, 3.0), **(given | changes), pins=pins)


@cache
def drum(pins=12, stations=6, **changes):
    given = {"pin_circle_radius": 0.09, "roller_radius": 9e-3, "roller_length": 0.016, "cam_radius": 0.05, "cam_length": 0.075}
    return barrel(index_motion("modified-sine", stations, 3.0), **(given | changes), pins=pins)


@pytest.mark.parametrize("drive", [parallel(), wheel(), hourglass(), drum()], ids=lambda drive: type(drive).__name__)
def test_a_turn_of_the_input_moves_the_wheel_by_a_station(drive):
    stations = drive.motion.divisions
    moved = drive.motion(HALF + TURN).d0 - drive.motion(HALF).d0
    np.testing.assert_allclose(moved, TURN / stations, rtol=1e-14)
    assert moved[0] == pytest.approx(2 * TURN / drive.pins)


def polygon(drive):
    from shapely import Polygon

    return Polygon(drive.profile.outline(1e-7).points(1e-7)).buffer(0)


@pytest.mark.parametrize(
    ("whole", "parts"),
    [
        (parallel().levels[0], [parallel(4, 4, 0.125).levels[0], parallel(4, 4, 0.625).levels[0]]),
        (wheel(), [wheel(6, 6), wheel(6, 6, 0.5)]),
        (wheel(12, 4), [wheel(4, 4, k / 3) for k in range(3)]),
        (wheel(12, 6, 0.3), [wheel(6, 6, 0.15), wheel(6, 6, 0.65)]),
    ],
    ids=["parallel", "pin-wheel", "three pins a step", "phase"],
)
def test_the_cam_is_what_the_cams_of_each_kind_of_pin_have_in_common(whole, parts):
    """Every second (third) pin alone makes a wheel with as many pins as stations; the cam of all pins lies within each of theirs."""
    from shapely import intersection_all

    common = intersection_all([polygon(part) for part in parts])
    ours = polygon(whole)
    assert ours.area == pytest.approx(common.area, rel=2e-6)
    assert ours.symmetric_difference(common).area < 2e-6 * ours.area


@pytest.mark.analytical
@pytest.mark.parametrize(("side", "lobes"), [("inside", 18), ("outside", 22)])
def test_a_uniform_wheel_has_two_lobes_less_or_more(side, lobes):
    """Two pins a turn: the difference of teeth of a cycloid drive is two, and the disc comes back to itself after a lobe."""
    drive = wheel(20, 10, 0.0, side, "uniform", 2e-3)
    assert drive.lobes == lobes
    points = drive.profile.outline(1e-7).points(1e-7) @ (1, 1j)
    angle = np.unwrap(np.angle(points))
    order = np.argsort(angle)
    at = np.linspace(angle.min(), angle.max(), 4000)
    radius = np.interp(at, angle[order], np.abs(points)[order], period=TURN)
    onward = np.interp(at + TURN / lobes, angle[order], np.abs(points)[order], period=TURN)
    np.testing.assert_allclose(onward, radius, atol=3e-6)
    assert np.ptp(radius) > 1e-3


@pytest.mark.parametrize("drive", [parallel().levels[0], parallel().levels[1], wheel(12, 6)])
def test_contacts_are_on_pins_that_the_profile_table_names(drive):
    """The pin at a place of the profile is the one that touches it at that input angle."""
    t = np.concatenate([np.linspace(span.start, span.stop, 5)[1:-1] for span in drive.profile.spans if span.piece.source is not None])
    point = np.concatenate(
        [span.piece.at(np.linspace(span.start, span.stop, 5)[1:-1]).d0 for span in drive.profile.spans if span.piece.source is not None]
    )
    angle, pin = drive.pin_that_cuts(t)
    centre = drive.pin_paths(angle).d0[np.arange(len(pin)), pin.astype(int) % drive.pins]
    np.testing.assert_allclose(np.abs(point - centre), drive.pin_radius, rtol=1e-9)


def test_wheel_stands_after_a_step_as_before_it():
    """Contacts one turn on are those of the turn before, two pins further."""
    level = parallel().levels[0]
    here, later = find_contacts(level, 1.1), find_contacts(level, 1.1 + TURN)
    assert set((here.pin - 2) % 8) == set(later.pin % 8)
    np.testing.assert_allclose(np.sort(here.arm), np.sort(later.arm), atol=1e-12)


@pytest.mark.parametrize("direction", [FORWARD, BACKWARD])
def test_parallel_drive_of_two_rollers_a_step_has_no_play(direction):
    assert np.max(find_play(parallel(), np.linspace(0, TURN, 73), direction)) < 1e-9


def least_gap(cam, points, steps=2400):
    """Least distance [m] of points of the cam from the skin of any roller, by placing all of them at many angles."""
    theta = np.linspace(0, TURN, steps, endpoint=False)
    at = rotate_about_y(points[None], cam.hand_sign * theta[:, None]) + (cam.centre_distance, 0.0, cam.height)
    least = np.full(len(points), np.inf)
    for roller in range(cam.pins):
        psi = cam.motion(theta).d0 + TURN / cam.pins * (cam.phase + roller)
        local = (at[..., 0] + 1j * at[..., 1]) * np.exp(-1j * psi)[:, None] - cam.pin_circle_radius
        flat = cam.kind == "globoidal"
        u, across, height = (local.real, local.imag, at[..., 2]) if flat else (at[..., 2], local.imag, local.real)
        gap = np.where(np.abs(u) <= cam.roller_length / 2 * (1 + 1e-9), np.hypot(across, height) - cam.roller_radius, np.inf)
        least = np.fmin(least, gap.min(axis=0))
    return least


@pytest.mark.parametrize("cam", [hourglass(), drum(), hourglass(12, 4), hourglass(phase=0.2), drum(phase=0.8)])
def test_flanks_of_several_starts_touch_rollers_and_none_enters(cam):
    flanks = compute_flanks(cam, np.linspace(0, TURN, 61))
    points = flanks.contact.point[flanks.on_cam]
    gaps = least_gap(cam, points[:: max(1, len(points) // 150)])
    assert gaps.min() > -2e-7 and gaps.max() < 4e-6
    assert flanks.contact_map.any(axis=(0, 1)).all()
    for direction in (FORWARD, BACKWARD):
        assert np.max(find_turret_play(flanks, direction)) < 1e-9


def test_rollers_on_the_far_side_of_the_turret_belong_to_no_flank():
    """Steps of half a turn carry every roller round the turret; what is cut away is counted on the cam's side alone.

    Thin rollers on a wide cam, so that nothing is cut away.
    """
    cam = hourglass(12, 2, roller_radius=4e-3, centre_distance=0.4, cam_length=0.045)
    flanks = compute_flanks(cam, np.linspace(0, TURN, 61))
    assert np.abs(flanks.contact.psi).max() > np.pi / 2
    assert flanks.undercut == 0.0
    assert np.abs(flanks.contact.psi[flanks.on_cam]).max() < 0.5


@pytest.mark.parametrize("cam", [hourglass(), drum()])
def test_each_start_has_a_groove_and_all_rollers_are_on_the_turret(cam):
    solid = cam_part(cam).solids[0]
    assert len(solid.grooves) == cam.starts == 2
    walls = [groove_walls(cam, start) for start in range(2)]
    for wall in walls:
        ends = np.abs(wall[:, [0, -1], :, 1])  # a groove runs from one end of the cam to the other
        assert ends.min() > cam.cam_length / 2
        distance = least_gap(cam, wall[:, 3:-3:7, 2:-2].reshape(-1, 3))
        assert distance.min() > -1e-6
    assert not np.allclose(walls[0][0, 5], walls[1][0, 5], atol=1e-3)
    assert len(turret_part(cam).solids) == 1 + cam.pins


@pytest.mark.parametrize("cam", [hourglass(), hourglass(12, 4), drum()])
def test_unrolled_ribs_lie_between_the_rollers(cam):
    """In the dwell no roller is on a rib, and between neighbours within the cam's length there is one."""
    from shapely import MultiPolygon, Point, Polygon

    unrolled = develop_surface(cam)
    ribs = MultiPolygon([Polygon(rib) for rib in unrolled.ribs]).buffer(0)
    for theta in (5.0, 5.6):
        centres = developed_roller_centres(cam, theta)[:, 0] + (unrolled.pitch_radius * theta, 0.0)
        near = centres[np.abs(centres[:, 1]) < 0.5 * cam.cam_length]
        between = 0.5 * (centres[1:] + centres[:-1])
        between = between[np.abs(between[:, 1]) < 0.4 * cam.cam_length]
        assert len(near) and len(between)
        assert not any(ribs.contains(Point(at)) for at in near)
        assert all(ribs.contains(Point(at)) for at in between)


def test_pin_centres_run_along_one_closed_curve_for_each_pin_of_a_step():
    curves = pin_centre_curves(wheel(12, 4))
    assert len(curves) == 3
    for curve in curves:
        steps = np.abs(np.diff(np.append(curve, curve[:1], axis=0), axis=0)).max()
        assert steps < 0.02  # no jump across the wheel
    assert len(pin_centre_curves(wheel(6, 6))) == 1


@pytest.mark.analytical
@pytest.mark.parametrize("stations", [12, 6, 4])
def test_only_the_crank_bearings_yield(stations):
    """The closed form of bonded pins, K = 2 rp^2/[1/(2k) + 2 (rp - e)^2/(k l^2)], with rp = e/phi' of the longer step."""
    drive, angles, k, spacing = wheel(12, stations), np.radians([30.0, 60.0, 85.0, 130.0]), 4.5e7, 0.11
    found = solve_torsional_stiffness(
        Drivetrain(spacing, crank=PowerLawBearing(k)), angles, contacts_at(drive, angles), 0.01, 500.0, model="bonded"
    )
    reach = 0.01 / drive.motion(angles).d1
    held = found.carried
    assert held.sum() >= 2
    wanted = 2 * reach**2 / (1 / (2 * k) + 2 * (reach - 0.01) ** 2 / (k * spacing**2))
    np.testing.assert_allclose(found.secant[held], wanted[held], rtol=1e-9)


# -- where the pins stand -----------------------------------------------------------------------------------------------------------


@pytest.mark.analytical
def test_phase_places_the_first_rollers():
    drive = parallel(8, 4, 0.4)
    first, second = (np.angle(level.pin_centres(0.0).d0[0]) for level in drive.levels)
    assert first == pytest.approx(0.4 * TURN / 8)
    assert second == pytest.approx(-0.1 * TURN / 8)
    assert np.angle(wheel(12, 6, 0.3).pin_centres(0.0).d0[0]) == pytest.approx(0.3 * TURN / 12)


@pytest.mark.analytical
def test_phase_turns_a_cycloid_disc_and_changes_nothing_else():
    """Of a uniform law the cam is the same, turned: pins at the phase d are those of the phase 0 at another crank angle."""
    areas = [wheel(12, 12, phase, "inside", "uniform", 4e-3).profile.area for phase in (0.0, 0.21, 0.7)]
    np.testing.assert_allclose(areas, areas[0], rtol=1e-12)
    dwell = [wheel(12, 12, phase).profile.area for phase in (0.0, 0.21)]
    assert abs(dwell[1] / dwell[0] - 1) > 1e-5


def test_half_a_pitch_more_changes_the_levels_of_a_parallel_drive():
    near, far = parallel(8, 8, 0.15), parallel(8, 8, 0.65)
    assert near.levels[0].profile.area == pytest.approx(far.levels[1].profile.area, rel=1e-12)


# -- what cannot be -----------------------------------------------------------------------------------------------------------------


@pytest.mark.error
@pytest.mark.parametrize(
    "make", [lambda: wheel(12, 5).profile, lambda: parallel(12, 5).levels[0].profile, lambda: hourglass(12, 5), lambda: drum(12, 5)]
)
def test_stations_that_do_not_divide_the_pins_are_refused(make):
    words = (
        "stations = 5 does not divide pins = 12: a step of 72° would pass 2.4 pins.*Take 10 or 15 pins, or stations from 1, 2, 3, 4, 6, 12"
    )
    with pytest.raises(InputError, match=words):
        make()
