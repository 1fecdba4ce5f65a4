"""What holds for every closed chain: joints, equilibrium, seats, periods, mirrors, scales."""

import numpy as np
import pytest

from drivewright import _jit
from drivewright.chains.closure import Drive, close, departure, phase_map, phased, plates, states_at, tracking
from drivewright.chains.closure.measures import measure
from drivewright.chains.closure.start import layout_of
from drivewright.chains.link import design_link, seat_height

pytestmark = pytest.mark.property


def chain(radius, scale=1.0):
    return design_link(9.525e-3 * scale, radius * 1e-3 * scale, np.pi / 6, 2.6e-3 * scale)


DRIVES = [
    Drive(chain(1.2), 35, 37, 82), Drive(chain(7.4), 35, 37, 82), Drive(chain(1.2), 35, 37, 81, "straight"),
    Drive(chain(3.0), 38, 19, 80), Drive(chain(2.0), 11, 11, 31), Drive(chain(7.4), 36, 36, 83), Drive(chain(7.4), 36, 36, 84, "straight"),
    Drive(chain(14.0), 23, 17, 65), Drive(chain(0.0), 9, 60, 83),
]  # fmt: skip
every_drive = pytest.mark.parametrize("drive", DRIVES, ids=lambda d: f"{d.link.radius * 1e3:.3g}-{d[1]}-{d[2]}-{d[3]}-{d.strands}")
BENT = [drive for drive in DRIVES if drive.strands == "equilibrium"]


def frames(closure, angles):
    """At each angle: state, complex places and directions of the plates, from the one that leaves the driver around to it again."""
    states = states_at(closure, np.asarray(angles))
    for k, poses in enumerate(plates(closure, states)):
        state = type(states)(*(part[k] for part in states))
        place, direction = poses[:, 0] + 1j * poses[:, 1], poses[:, 2]
        order = closure.drive.driver_teeth // 2 - state.seats[0] + np.arange(closure.drive.links + 1)
        around = 2 * np.pi * (order // closure.drive.links)
        yield state, place[order % closure.drive.links], direction[order % closure.drive.links] - around


def seated_on(drive, state, place):
    """Which plates lie at the height of the seats of the driver, and of the driven sprocket."""
    heights = seat_height(drive.link, drive.driver_teeth), seat_height(drive.link, drive.driven_teeth)
    return np.abs(np.abs(place) - heights[0]) < 1e-12, np.abs(np.abs(place - state.centre_distance) - heights[1]) < 1e-12


@every_drive
def test_every_joint_closes_and_turns_between_straight_and_seated(drive):
    for _, place, direction in frames(close(drive), np.linspace(-0.3, 0.5, 7)):
        half = 0.5 * drive.link.hole_pitch * np.exp(1j * direction)
        joint = 2 * drive.link.radius * np.exp(0.5j * (direction[:-1] + direction[1:]))
        assert np.abs(place[:-1] + half[:-1] - joint - place[1:] + half[1:]).max() < 2e-14
        turned = -np.diff(direction)
        assert turned.sum() == pytest.approx(2 * np.pi, abs=1e-12)
        assert turned.min() > -1e-12
        assert turned.max() < 2 * np.pi / min(drive.driver_teeth, drive.driven_teeth) + 1e-12


@every_drive
def test_seated_plates_lie_on_their_teeth_and_no_plate_below(drive):
    for state, place, direction in frames(close(drive), [0.013, 0.7, -2.0]):
        on = seated_on(drive, state, place[:-1])
        for each, centre, teeth, psi, tooth in (
            (on[0], 0.0, drive.driver_teeth, state.driver_angle, state.seats[0]),
            (on[1], state.centre_distance, drive.driven_teeth, state.driven_angle, state.seats[1]),
        ):
            from_centre, phi = place[:-1] - centre, 2 * np.pi / teeth
            assert np.abs(from_centre).min() > seat_height(drive.link, teeth) - 1e-12
            polar = np.unwrap(direction[:-1][each]) + 0.5 * np.pi
            np.testing.assert_allclose(np.exp(1j * polar), from_centre[each] / np.abs(from_centre[each]), atol=1e-11)
            np.testing.assert_allclose(np.exp(1j * (polar[0] - psi - tooth * phi)), 1, atol=1e-11)
        assert tuple(each.sum() for each in on) == tuple(state.seated)


@pytest.mark.parametrize("drive", BENT, ids=str)
def test_in_equilibrium_one_line_of_force_runs_through_all_contacts_of_a_strand(drive):
    for state, place, direction in frames(close(drive), [0.011, 0.146]):
        touch = place[:-1] + 0.5 * drive.link.hole_pitch * np.exp(1j * direction[:-1])
        touch -= drive.link.radius * np.exp(0.5j * (direction[:-1] + direction[1:]))
        on_2 = np.flatnonzero(seated_on(drive, state, place)[1])
        on_1 = np.flatnonzero(seated_on(drive, state, place)[0])
        lower = slice(on_2[-1], on_1[on_1 > on_2[-1]][0])
        for line, angle in ((touch[: on_2[0]], state.strand_angle[0]), (touch[lower], state.strand_angle[1])):
            assert len(line) > 3
            assert np.abs(((line - line[0]) * np.exp(-1j * angle)).imag).max() < 1e-13


@every_drive
def test_a_tooth_later_everything_comes_back(drive):
    found = close(drive)
    states, phi = found.states, 2 * np.pi / drive.driver_teeth
    assert states.driver_angle[-1] == pytest.approx(phi, rel=1e-15)
    assert states.centre_distance[-1] == pytest.approx(states.centre_distance[0], rel=1e-13)
    assert states.driven_angle[-1] - states.driven_angle[0] == pytest.approx(2 * np.pi / drive.driven_teeth, abs=1e-13)
    assert found.transmission_error[-1] == pytest.approx(found.transmission_error[0], abs=1e-13)
    later = states_at(found, np.array([0.3, 2.1]) * phi + 7 * phi)
    now = states_at(found, np.array([0.3, 2.1]) * phi)
    np.testing.assert_allclose(later.centre_distance, now.centre_distance, rtol=1e-13)
    np.testing.assert_allclose(later.driven_angle - now.driven_angle, 14 * np.pi / drive.driven_teeth, atol=1e-12)
    np.testing.assert_array_equal(now.seats - later.seats, 7)
    np.testing.assert_allclose(now.wrap.sum(axis=1), 2 * np.pi)
    assert now.wrap[0, int(drive.driven_teeth > drive.driver_teeth)] >= np.pi - 1e-3  # the larger sprocket is held by more than half


def test_a_plate_keeps_its_row_while_the_driver_turns():
    found = close(DRIVES[0])
    path = plates(found, states_at(found, np.linspace(0, 0.5, 400)))
    moved = np.diff(path, axis=0)
    assert np.abs(moved[..., :2]).max() < 1.05 * 0.5 / 399 * 0.0562  # as fast as the pins on the driver, and no plate jumps
    tooth = found.drive.driver_teeth // 2
    np.testing.assert_allclose(path[:, 0, 2] + 0.5 * np.pi + 2 * np.pi, tooth * 2 * np.pi / 35 + np.linspace(0, 0.5, 400), atol=1e-12)


@every_drive
def test_slopes_are_those_of_the_motion(drive):
    found = close(drive, 8)
    at = 0.5 * (found.driver_angle[:-1] + found.driver_angle[1:])
    wide = np.diff(found.driver_angle) > 1e-4
    ahead, behind = states_at(found, at[wide] + 1e-5), states_at(found, at[wide] - 1e-5)
    middle = close(drive, 8 * 16)
    for values, slope in ((ahead.driven_angle - behind.driven_angle, 0), (ahead.centre_distance - behind.centre_distance, 1)):
        known = [np.interp(at[wide], middle.driver_angle, each[:, slope]) for each in (middle.after, middle.before)]
        lower, upper = np.minimum(*known), np.maximum(*known)
        slack = 1e-2 * np.ptp(middle.after[:, slope]) + 1e-10
        assert np.all(values / 2e-5 > lower - slack)
        assert np.all(values / 2e-5 < upper + slack)


@every_drive
def test_measures_are_those_of_a_dense_sampling(drive):
    found = close(drive)
    angle = np.linspace(0, 2 * np.pi / drive.driver_teeth, 3001)
    dense = states_at(found, angle)
    error = dense.driven_angle - drive.driver_teeth / drive.driven_teeth * angle
    size = max(np.ptp(dense.centre_distance), 1e-12)
    assert found.mean == pytest.approx(np.mean(0.5 * (dense.centre_distance[1:] + dense.centre_distance[:-1])), abs=1e-5 * size)
    assert found.fluctuation == pytest.approx(size, rel=1e-4, abs=1e-13)
    assert found.transmission_ripple == pytest.approx(np.ptp(error), rel=1e-4, abs=1e-11)
    offset = np.mean(0.5 * (error[1:] + error[:-1]))
    own = found.states.driven_angle - drive.driver_teeth / drive.driven_teeth * found.driver_angle
    np.testing.assert_allclose(found.transmission_error, own - offset, atol=1e-5 * max(np.ptp(error), 1e-9))


@every_drive
def test_a_smooth_strand_seats_without_a_jump_and_a_bent_one_without_a_kink(drive):
    found = close(drive)
    assert found.event.sum() >= 2
    jump = np.abs(found.after - found.before)
    assert jump[~found.event].max() < 1e-15
    if drive.strands == "equilibrium":  # the reach of a strand is stationary, so a plate that joins it changes no slope
        assert jump.max() < 1e-10
    elif drive.link.radius > 0:
        assert jump[found.event, 1].max() > 1e-9


def test_from_the_other_sprocket_the_same_positions_are_seen():
    """The drive turned by half a turn, so that the driven sprocket lies at the origin."""
    for drive in (DRIVES[0], DRIVES[3], DRIVES[2]):
        here, there = close(drive), close(drive._replace(driver_teeth=drive.driven_teeth, driven_teeth=drive.driver_teeth))
        states = states_at(here, np.array([0.02, 0.11]))
        seen = states_at(there, states.driven_angle + np.pi)
        np.testing.assert_allclose(seen.centre_distance, states.centre_distance, rtol=1e-13)
        turned = (seen.driven_angle - states.driver_angle - np.pi) / (2 * np.pi / drive.driver_teeth)
        np.testing.assert_allclose(turned, np.round(turned), atol=1e-10)
        assert there.fluctuation == pytest.approx(here.fluctuation, rel=1e-8)


@every_drive
def test_upside_down_is_backwards(drive):
    found, angle = close(drive), np.array([0.017, 0.06, 0.123])
    one, other = states_at(found, angle), states_at(found, -angle)
    np.testing.assert_allclose(one.centre_distance, other.centre_distance, rtol=1e-13)
    np.testing.assert_allclose(one.strand_angle.sum(axis=1), -np.pi - (np.pi + other.strand_angle.sum(axis=1)), atol=1e-11)
    teeth = (one.driven_angle + other.driven_angle) / (2 * np.pi / drive.driven_teeth)
    np.testing.assert_allclose(teeth, np.round(teeth), atol=1e-9)


def test_lengths_scale():
    small, large = close(Drive(chain(1.2), 35, 37, 83)), close(Drive(chain(1.2, 7.0), 35, 37, 83))
    np.testing.assert_allclose(large.centre_distance, 7 * small.centre_distance, rtol=1e-13)
    np.testing.assert_allclose(large.states.driven_angle, small.states.driven_angle, atol=1e-13)
    assert (large.mean, large.fluctuation) == pytest.approx((7 * small.mean, 7 * small.fluctuation), rel=1e-7)
    assert large.transmission_ripple == pytest.approx(small.transmission_ripple, rel=1e-9)
    one, other = departure(chain(1.2), 17), departure(chain(1.2, 7.0), 17)
    assert (other.rise, other.slip, other.seating) == pytest.approx((7 * one.rise, 7 * one.slip, one.seating), rel=1e-9)


def test_an_elongated_chain_pushes_the_shafts_apart_by_its_own_pitches():
    """All lengths in its own pitches, r too: a scale.  Worn pins and stretched plates differ by r over p alone."""
    joint, stretch = chain(0.0), 1.01
    long = joint._replace(hole_pitch=joint.hole_pitch * stretch)
    assert close(Drive(long, 35, 37, 82)).mean == pytest.approx(stretch * close(Drive(joint, 35, 37, 82)).mean, rel=1e-13)
    rolling = chain(1.2)
    worn = close(Drive(rolling._replace(radius=rolling.radius - 5e-6), 35, 37, 82)).mean
    stretched = close(Drive(rolling._replace(hole_pitch=rolling.hole_pitch + 1e-5), 35, 37, 82)).mean
    assert worn == pytest.approx(stretched, abs=2e-7)
    assert worn - close(Drive(rolling, 35, 37, 82)).mean == pytest.approx(1e-5 * 219.054 / 9.525, rel=1e-3)


@pytest.mark.parametrize("drive", [DRIVES[0], DRIVES[2]], ids=str)
def test_two_chains_half_a_pitch_apart(drive):
    found = close(drive)
    alone, both = phased(found, 0.0), phased(found)
    assert (alone.mean, alone.fluctuation, alone.transmission_ripple) == pytest.approx(
        (found.mean, found.fluctuation, found.transmission_ripple), rel=5e-6
    )
    assert both.mean == pytest.approx(found.mean, abs=1e-6 * found.fluctuation)
    assert both.fluctuation < 0.4 * found.fluctuation
    each = states_at(found, both.driver_angle[::9]), states_at(found, both.driver_angle[::9] + np.pi / drive.driver_teeth)
    np.testing.assert_allclose(both.centre_distance[::9], 0.5 * (each[0].centre_distance + each[1].centre_distance), rtol=1e-14)
    third = phased(found, 0.3)
    assert third.fluctuation == pytest.approx(phased(found, 0.7).fluctuation, rel=1e-5)
    dense = np.interp(np.linspace(0, 2 * np.pi / drive.driver_teeth, 2000), third.driver_angle, third.transmission_error)
    assert np.mean(dense) == pytest.approx(0, abs=2e-3 * third.transmission_ripple)
    assert np.ptp(dense) == pytest.approx(third.transmission_ripple, rel=1e-2)


def test_a_cubic_is_measured_exactly():
    x = np.array([-1.0, 0.2, 0.9, 1.7])
    y, slope = x**3 - x + 2, 3 * x**2 - 1
    mean, low, high = measure(x, y, slope, slope)
    area = (1.7**4 - 1) / 4 - (1.7**2 - 1) / 2 + 2 * 2.7
    assert (mean, low, high) == pytest.approx((area / 2.7, 2 - 2 / 27**0.5, 1.7**3 + 0.3), rel=1e-14)
    kinked = measure(np.array([0.0, 1.0, 2.0]), np.array([0.0, 1.0, 0.0]), np.array([9.0, 1.0, -1.0]), np.array([1.0, -1.0, 9.0]))
    assert kinked == pytest.approx((0.5, 0.0, 1.0), abs=1e-15)


def test_plain_python_gives_the_same_numbers():
    for strands in ("equilibrium", "straight"):
        drive = Drive(chain(7.4), 11, 13, 26, strands)
        tracks = []
        for follow in (tracking.follow, _jit.plain(tracking.follow)):
            layout, seats, x = layout_of(drive)
            tracks.append(follow(layout, seats, x, np.linspace(0, layout.phi_1, 5)))
        count = tracks[0].length[0]
        assert tracks[1].length[0] == count
        np.testing.assert_allclose(tracks[1].x[:count], tracks[0].x[:count], rtol=1e-12, atol=1e-12)
        np.testing.assert_array_equal(tracks[1].seats[:count], tracks[0].seats[:count])


def test_a_map_is_its_drives_one_by_one():
    said = []
    drives = [*DRIVES[:3], Drive(chain(1.2), 37, 37, 38)]
    rows = phase_map(drives, 12, workers=2, progress=lambda done, total, what: said.append((done, total))).rows
    assert said[-1] == (4, 4)
    assert [row.case for row in rows] == drives
    for row in rows[:3]:
        assert row.value.fluctuation == close(row.case, 12).fluctuation
    assert "38 links around 37 and 37 teeth leave" in rows[3].reason
    assert rows[3].value is None
