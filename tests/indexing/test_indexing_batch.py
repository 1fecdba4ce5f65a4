"""Many pin wheels at once beside the exact route, and what must not change a digit."""

import numpy as np
import pytest

from drivewright._jit import plain
from drivewright.indexing import play
from drivewright.indexing.batch import envelope, evaluate_designs, loops, sampled, values
from drivewright.indexing.batch.pin_wheels import PinWheelValues, crank_samples, evaluate_pin_wheels
from drivewright.indexing.motion import TURN, IndexMotion
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.plane import centre_curvature, contact_pressure_angle, find_contacts, index_angles
from drivewright.indexing.play import BACKWARD, FORWARD, find_play
from drivewright.motion import law

pytestmark = pytest.mark.property

SINE = law("modified-sine")
ARCMIN = np.deg2rad(1 / 60)


def exact(drive):
    """The values of one drive by the trimmed profile, but for the curvature, which is taken at the index angles."""
    theta, count = crank_samples(drive.motion.motion_angle)
    index = theta[::10][:count]
    found = [find_contacts(drive, one, reach=1e-5) for one in index]
    pins = [len(set(each.pin[each.intended])) for each in found]
    forward, backward = (contact_pressure_angle(drive, index, direction) for direction in (1, -1))
    loose = [np.max(find_play(drive, theta[::2], direction)) for direction in (FORWARD, BACKWARD)]
    return PinWheelValues(*loose, min(pins), max(pins), np.nanmax(forward), np.nanmax(backward), np.nanmin([forward, backward]), np.nan)


@pytest.mark.parametrize(
    ("name", "pins", "pin", "eccentricity", "ratio", "side"),
    [
        ("modified-sine", 12, 8e-3, 10e-3, 1.0, "inside"),
        ("cycloidal", 12, 5.3e-3, 9.1e-3, 2.4, "inside"),
        ("modified-trapezoid", 12, 9e-3, 10e-3, 3.0, "inside"),  # its lobe tops are just not undercut
        ("simple-harmonic", 9, 11e-3, 12e-3, 1.6, "outside"),
    ],
)
def test_the_exact_route_gives_the_same(name, pins, pin, eccentricity, ratio, side):
    motion = IndexMotion(law(name), pins, TURN * ratio / (1 + ratio))
    quick = PinWheelValues(
        *(column[0] for column in evaluate_pin_wheels(motion.law, pins, 0.12, pin, eccentricity, motion.motion_angle, side))
    )
    trimmed = exact(PinWheel(pins, 0.12, pin, eccentricity, motion, side))
    np.testing.assert_allclose(quick[:2], trimmed[:2], atol=0.02 * ARCMIN)
    assert quick[2:4] == trimmed[2:4]
    np.testing.assert_allclose(quick[4:7], trimmed[4:7], atol=2e-4)


def test_the_angles_are_those_of_the_index_tables():
    for motion_angle in (np.pi, 4.0, TURN):
        theta, count = crank_samples(motion_angle)
        wanted = index_angles(PinWheel(12, 0.12, 8e-3, 0.01, IndexMotion(SINE, 12, motion_angle)))
        np.testing.assert_allclose(theta[::10][:count], wanted[: len(theta[::10][:count])], atol=1e-14)
        assert count == len(wanted) - (motion_angle == TURN)  # a full turn ends where it began
        assert theta[0] == 0 and np.all(np.diff(theta) > 0) and np.max(np.diff(np.append(theta, TURN))) < np.deg2rad(0.46)


def test_sharpest_lobe_of_the_dwell():
    """With pins thinner than the eccentricity the lobe tops are arcs of the radius e of the centre curve; with thicker ones none is."""
    thin, thick = evaluate_pin_wheels(SINE, 12, 0.12, [8e-3, 12e-3], 0.01, np.pi).convex_radius
    assert thin == pytest.approx(0.01, rel=1e-9)
    assert thick > 12e-3


def test_thinner_pins_hold_the_wheel():
    """At 1:1 pins of 5 mm hold both ways, pins of 8 mm leave the 112 arcmin of the reference."""
    loose = evaluate_pin_wheels(SINE, 12, 0.12, [5e-3, 8e-3], 0.01, np.pi)
    for column in (loose.play_forward, loose.play_backward):
        assert column[0] < 0.1 * ARCMIN and column[1] == pytest.approx(111.68 * ARCMIN, rel=1e-3)


def test_the_table_of_a_law_is_the_law():
    table = envelope.tabulate_law(SINE)
    for u in (0.0, 0.031, 0.125, 0.444, 0.875, 0.999):
        s, v, a, _ = SINE(u)
        np.testing.assert_allclose(envelope.motion_at(table, 1.0, u), [s, v, a], atol=2e-7)
        np.testing.assert_allclose(envelope.motion_at(table, 1.7, 1.7 * u), [s, v / 1.7, a / 1.7**2], atol=2e-7)
        assert envelope.motion_at(table, 1.0, u)[0] == pytest.approx(s, abs=1e-12)
    assert envelope.motion_at(table, 1.0, 1.3) == (1.0, 0.0, 0.0)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_the_sampled_centres_are_the_path(sense):
    drive = PinWheel(5, 0.1, 8e-3, 0.012, IndexMotion(SINE, 5, 4.0), "inside" if sense > 0 else "outside")
    theta = np.array([0.3, 1.9, 3.7, 4.4])
    path = envelope.sample_pin_path(envelope.PinWheelSizes(5, 0.1, 8e-3, 0.012, 4.0, sense), envelope.tabulate_law(SINE), theta)
    jet = drive.pin_paths(theta)
    for own, wanted in ((path.z, jet.d0), (path.v, jet.d1), (path.a, jet.d2)):
        np.testing.assert_allclose(own.reshape(5, 4).T, wanted, atol=1e-7)
    assert np.all(np.isfinite(centre_curvature(drive, theta)))


def test_only_the_places_that_may_have_the_largest_play_are_looked_at_and_that_changes_nothing():
    """The largest play is that of all places one by one on the same profile, whichever place is looked at first."""
    wheel, table = envelope.PinWheelSizes(12, 0.12, 8e-3, 0.01, 3.3, 1.0), envelope.tabulate_law(SINE)
    theta, count = crank_samples(3.3)
    path, nodes = sampled_profile(wheel, table, theta)
    work = np.empty(play.CAPACITY, complex), np.empty(play.CAPACITY)
    for direction, name in ((FORWARD, "play_forward"), (BACKWARD, "play_backward")):
        free = []
        for j in range(0, len(theta), 2):
            crank = 0.01 * np.exp(1j * theta[j])
            centres = path.z.reshape(12, -1)[:, j] + crank
            free.append(play.free_rotation(nodes, centres, crank, 8e-3, direction, TURN / 12, 5, *work)[0])
        batch = getattr(evaluate_pin_wheels(SINE, 12, 0.12, 8e-3, 0.01, 3.3), name)[0]
        assert max(free) > 30 * ARCMIN and batch == pytest.approx(max(free), abs=1e-9)


def sampled_profile(wheel, table, theta):
    """Path of the centres and nodes of the profile, as `values.evaluate_pin_wheel` makes them."""
    path = envelope.sample_pin_path(wheel, table, theta)
    margin = 1e-5
    cells = envelope.sort_into_cells(path, 0.14, 2e-3)
    exposed = envelope.find_exposed_samples(path, cells, wheel.pin_radius, margin)
    segments = envelope.trace_exposed_segments(wheel, table, path, cells, margin, exposed)
    return path, loops.loop_nodes(segments, loops.find_cam_loop(segments, True))


@pytest.mark.parametrize("width", [5e-4, 3e-3, 0.3])
def test_the_width_of_the_cells_changes_no_sample(width):
    """Beside all samples one by one: a point further inside a pin than the foot is exact is covered, one further outside is not."""
    wheel, table = envelope.PinWheelSizes(5, 0.05, 6e-3, 7e-3, 3.6, 1.0), envelope.tabulate_law(SINE)
    path = envelope.sample_pin_path(wheel, table, crank_samples(3.6)[0])
    exposed = envelope.find_exposed_samples(path, envelope.sort_into_cells(path, 0.06, width), 6e-3, 2e-5)
    heading = path.v / np.abs(path.v)
    for side, out in enumerate((6e-3j, -6e-3j)):
        points = path.z + out * heading
        least = np.min(np.abs(points[:, None] - path.z), axis=1)
        assert not np.any(exposed[side, least < 6e-3 - 1e-7]) and np.all(exposed[side, least > 6e-3 - 1e-10])
        assert 0.1 < np.mean(exposed[side]) < 0.9


def test_sizes_scale():
    small = evaluate_pin_wheels(SINE, 12, 0.12, 7e-3, 0.01, 3.5)
    large = evaluate_pin_wheels(SINE, 12, 0.30, 17.5e-3, 0.025, 3.5)
    np.testing.assert_allclose(np.ravel(small[:2]), np.ravel(large[:2]), atol=1e-6)
    np.testing.assert_array_equal(small[2:4], large[2:4])
    np.testing.assert_allclose(small[4:7], large[4:7], atol=1e-6)
    np.testing.assert_allclose(2.5 * small.convex_radius, large.convex_radius, rtol=1e-6)


def test_workers_change_no_digit_and_impossible_designs_are_rows_of_nan():
    pin = np.array([6e-3, 0.2, 7e-3, np.nan, 9e-3] * 4)
    one, many = (evaluate_pin_wheels(SINE, 12, 0.12, pin, 0.01, np.pi, workers=workers) for workers in (1, 3))
    np.testing.assert_array_equal(one, many)
    assert list(np.isfinite(one.contacts_minimum)[:5]) == [True, False, True, False, True]


def test_designs_of_several_laws_are_those_of_each_law():
    c, pin, angle = np.array([0.25, 0.35, 0.25, 0.9]), np.array([8e-3, 7e-3, 7e-3, 7e-3]), np.array([3.0, 3.5, 4.0, 3.0])
    found = evaluate_designs("scca", {"b": 0.25, "c": c, "d": 0.75 - c}, 12, 0.12, pin, 0.01, angle)
    for k in range(3):
        one = law("scca", b=0.25, c=c[k], d=0.75 - c[k])
        alone = evaluate_pin_wheels(one, 12, 0.12, pin[k], 0.01, angle[k])
        np.testing.assert_array_equal([column[k] for column in found.wheels], np.ravel(alone))
        factors = TURN / 12 * np.array([one.peaks().Vm / angle[k], one.peaks().Am / angle[k] ** 2])
        np.testing.assert_allclose([found.velocity_factor[k], found.acceleration_factor[k]], factors, rtol=1e-12)
    assert np.all(np.isnan(np.concatenate([[column[3] for column in found.wheels], [found.motion_angle[3], found.velocity_factor[3]]])))
    for pins, measures in ((12, (0.12, 40e-3, 0.01, 3.0)), (12, (0.12, 8e-3, 0.01, -3.0)), (12, (0.12, 8e-3, 0.01, 7.0))):
        impossible = evaluate_designs("modified-sine", {}, pins, *measures)
        assert np.all(np.isnan(np.concatenate([*impossible.wheels, *impossible[1:]])))
    quick = evaluate_designs("modified-sine", {}, 12, 0.12, pin, 0.01, angle, factors=False)
    assert np.all(np.isnan(quick.velocity_factor)) and np.array_equal(quick.motion_angle, angle)


def test_the_kernels_give_the_same_uncompiled():
    wheel, table = envelope.PinWheelSizes(3, 0.1, 0.012, 0.018, 4.0, 1.0), envelope.tabulate_law(SINE)
    theta = np.concatenate([np.linspace(0, 4.0, 41)[:-1], np.linspace(4.0, TURN, 25)[:-1]])
    seen = []
    for evaluate in (values.evaluate_pin_wheel, plain(values.evaluate_pin_wheel)):
        row = np.full(values.VALUES, np.nan)
        with np.errstate(divide="ignore", invalid="ignore"):
            evaluate(wheel, table, theta, 8, 6, 16, row)
        seen.append(row)
    assert np.all(np.isfinite(seen[0]))
    np.testing.assert_allclose(*seen, rtol=1e-9)


def test_a_sample_is_moved_to_its_foot():
    """The least distance of a point from the centre curve near a sample, by second order, beside a thousandth of the step."""
    wheel, table = envelope.PinWheelSizes(12, 0.12, 8e-3, 0.01, np.pi, 1.0), envelope.tabulate_law(SINE)
    theta, _ = crank_samples(np.pi)
    path = envelope.sample_pin_path(wheel, table, theta)
    for k in (120, 4 * len(theta) + 77, 700):
        j, turn = k % len(theta), k // len(theta)
        point = path.z[k] + 9e-3 * np.exp(0.7j) * path.v[k] / abs(path.v[k])
        near = [abs(envelope.pin_centre_at(wheel, table, one, turn)[0] - point) for one in np.linspace(theta[j - 1], theta[j + 1], 2001)]
        moved = np.sqrt(envelope._foot_distance_squared(path, point - path.z[k], k))
        assert moved == pytest.approx(min(near), abs=1e-8)
        assert abs(point - path.z[k]) - moved > 1e-7


@pytest.mark.parametrize(
    ("pins", "pin", "eccentricity", "angle", "side"),
    [
        (12, 8e-3, 10e-3, np.pi, "inside"),
        (5, 6e-3, 7e-3, 3.6, "inside"),
        (9, 11e-3, 12e-3, 4.1, "outside"),
        (12, 3e-4, 10e-3, 4.4, "inside"),
    ],
)
def test_points_where_no_cam_ends_need_not_be_looked_at(pins, pin, eccentricity, angle, side):
    """The profile is the same where all points of the envelope are looked at."""
    wheel = envelope.PinWheelSizes(pins, 0.12, pin, eccentricity, angle, 1.0 if side == "inside" else -1.0)
    table, (theta, _) = envelope.tabulate_law(SINE), crank_samples(angle)
    path, _, nodes = values.sample_cam(wheel, table, theta)
    margin = values._spacing(path) ** 2 / (2 * pin)
    cells = envelope.sort_into_cells(path, 0.12 + eccentricity + margin, 0.25 * pin)
    exposed = envelope.find_exposed_samples(path, cells, pin, margin)
    segments = envelope.trace_exposed_segments(wheel, table, path, cells, margin, exposed)
    for ours, all_of_it in zip(nodes, loops.loop_nodes(segments, loops.find_cam_loop(segments, side == "inside")), strict=True):
        np.testing.assert_array_equal(ours, all_of_it)
    least, most = values._where_the_cam_ends(wheel)
    fewer = envelope.find_exposed_samples(path, cells, pin, margin, least, most)
    assert not np.any(fewer & ~exposed) and (pin < 1e-3 or np.sum(fewer) < 0.95 * np.sum(exposed))


@pytest.mark.parametrize("side", ["inside", "outside"])
def test_a_sampled_wheel_has_the_values_of_many_and_no_play_that_is_not_asked_for(side):
    wheel = PinWheel(9, 0.12, 11e-3, 12e-3, IndexMotion(SINE, 9, 4.0), side)
    many = PinWheelValues(*(column[0] for column in evaluate_pin_wheels(SINE, 9, 0.12, 11e-3, 12e-3, 4.0, side)))
    np.testing.assert_array_equal(sampled(wheel).values(), many)
    without = PinWheelValues(*(column[0] for column in evaluate_pin_wheels(SINE, 9, 0.12, 11e-3, 12e-3, 4.0, side, play=False)))
    np.testing.assert_array_equal(sampled(wheel).values(play=False), without)
    assert np.isnan(without[:2]).all() and np.isfinite(many).all()
    np.testing.assert_array_equal(without[2:], many[2:])


def test_values_that_are_known_are_taken():
    known = PinWheelValues(*np.arange(16.0).reshape(8, 2))
    found = evaluate_designs("modified-sine", {}, 12, 0.12, [8e-3, 40e-3], 0.01, np.pi, wheels=known)
    np.testing.assert_array_equal(np.array(found.wheels)[:, 0], np.arange(0.0, 16.0, 2))
    assert np.isnan(np.array(found.wheels)[:, 1]).all()


def test_segments_that_follow_each_other_meet():
    """Their ends are where a pin is four times as deep in the other's as counts as covered, at most; no step of the samples shows."""
    wheel, table = envelope.PinWheelSizes(12, 0.12, 8e-3, 0.01, np.pi, 1.0), envelope.tabulate_law(SINE)
    path = envelope.sample_pin_path(wheel, table, crank_samples(np.pi)[0])
    margin = values._spacing(path) ** 2 / (2 * 8e-3)
    cells = envelope.sort_into_cells(path, 0.14, 2e-3)
    segments = envelope.trace_exposed_segments(wheel, table, path, cells, margin, envelope.find_exposed_samples(path, cells, 8e-3, margin))
    loop = loops.find_cam_loop(segments, True)
    ends, starts = segments.point[segments.first[loop + 1] - 1], segments.point[segments.first[loop]]
    assert len(loop) == 14 and np.max(np.abs(ends - np.roll(starts, -1))) < 4 * envelope._COVER_DEPTH
