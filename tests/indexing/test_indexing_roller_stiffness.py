"""Torsional stiffness of drives whose cams turn: closed forms, energy, the engine of the pin wheels, bisection, geometry."""

from functools import cache

import numpy as np
import pytest

from drivewright.errors import InputError
from drivewright.indexing.drivetrain import PALMGREN_LINE, Drivetrain, pin_contact
from drivewright.indexing.motion import TURN, index_motion
from drivewright.indexing.parallel import ParallelIndexer
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.plane import contacts_at
from drivewright.indexing.roller_gear import barrel, compute_flanks, globoidal
from drivewright.indexing.roller_gear.envelope import rotate_about_y
from drivewright.indexing.stiffness import solve_torsional_stiffness
from drivewright.indexing.stiffness.result import FREE
from drivewright.indexing.stiffness.roller_contacts import RollerContacts, of_flanks, of_plate_cams
from drivewright.indexing.stiffness.roller_drive import RollerDrive, solve_roller_stiffness
from drivewright.indexing.stiffness.roller_loading import LoadedRollers, roller_contacts, solve_rollers, solve_rollers_after_play

pytestmark = pytest.mark.analytical

R, WIDTH, TORQUE = 0.06, 0.012, 80.0
LINE = PALMGREN_LINE * WIDTH ** (8 / 9)


def made(*arms, gaps=None, directions=None, length=WIDTH):
    """Contacts with these levers on a circle of the radius R."""
    count = len(arms)
    normal = np.zeros((count, 3))
    normal[:, 1] = np.sign(arms)
    return RollerContacts(
        np.arange(count),
        np.zeros(count, dtype=int),
        normal if directions is None else np.array(directions, float),
        np.array(arms, float),
        np.zeros(count) if gaps is None else np.array(gaps, float),
        np.full(count, length),
        np.full(count, 100.0),
    )


def solve(drive, contacts, torque=TORQUE, ratio=0.4, model="unilateral"):
    return solve_roller_stiffness(drive, [0.0], [ratio], [contacts], torque, model)


@cache
def parallel(pins=8, stations=8, scale=1.0, ratio=1.0, pin=8e-3):
    return ParallelIndexer(pins, R * scale, pin * scale, 0.09 * scale, index_motion("modified-sine", stations, ratio))


@cache
def hourglass(scale=1.0):
    sizes = {"pin_circle_radius": 0.08, "roller_radius": 0.012, "roller_length": 0.016, "centre_distance": 0.125, "cam_length": 0.06}
    return globoidal(index_motion("modified-sine", 12, 2.0), **{name: scale * size for name, size in sizes.items()})


@cache
def drum():
    return barrel(index_motion("modified-sine", 12, 2.0), 0.09, 0.012, 0.016, 0.05, 0.075)


# -- closed forms -------------------------------------------------------------------------------------------------------------------


def test_one_line_contact_turns_by_its_approach():
    """phi = (T/(h c))^0.9/h."""
    found = solve(RollerDrive(R), made(-0.04))
    assert found.rotation[0] == pytest.approx((TORQUE / 0.04 / LINE) ** 0.9 / 0.04, rel=1e-12)
    assert found.tangent[0] == pytest.approx(found.secant[0] / 0.9, rel=1e-10)
    assert found.pin_forces[0] == pytest.approx([TORQUE / 0.04])


def test_linear_contact_has_k_r_squared():
    """Behind so soft a seat the line yields next to nothing."""
    found = solve(RollerDrive(R, series=1e4), made(-0.04), 0.1)
    assert found.secant[0] == pytest.approx(1e4 * 0.04**2, rel=1e-4)


def test_two_rollers_pressed_in_act_both_ways():
    """T = h [F(d0 + h phi) - F(d0 - h phi)]; of linear seats 2 k h^2, half of it once one has come off."""
    pressed = RollerDrive(R, interference=4e-6)
    found = solve(pressed, made(-0.04, 0.04), 20.0)
    forces = [LINE * (4e-6 + sign * 0.04 * found.rotation[0]) ** (10 / 9) for sign in (1, -1)]
    assert 0.04 * (forces[0] - forces[1]) == pytest.approx(20.0, rel=1e-5)
    assert found.pin_forces[0] == pytest.approx(forces, rel=1e-5)
    seats = RollerDrive(R, series=1e4, interference=1e-3)
    assert solve(seats, made(-0.04, 0.04), 0.1).secant[0] == pytest.approx(2e4 * 0.04**2, rel=1e-3)
    apart = solve(seats, made(-0.04, 0.04), 1.0)
    assert apart.pin_forces[0][1] == 0.0
    assert apart.tangent[0] == pytest.approx(1e4 * 0.04**2, rel=1e-3)


def test_rollers_that_stick_share_the_load_of_both_flanks():
    """Two contacts with one law: the force of each is half, the approach 2^-0.9 of that of one."""
    both, one = solve(RollerDrive(R), made(-0.04, 0.04), model="bonded"), solve(RollerDrive(R), made(-0.04))
    assert both.secant[0] == pytest.approx(2**0.9 * one.secant[0], rel=1e-12)
    assert both.pin_forces[0] == pytest.approx([TORQUE / 0.08, -TORQUE / 0.08])


def test_gap_closes_and_shares_the_rest():
    found = solve(RollerDrive(R), made(-0.04, -0.04, gaps=[0.0, 1e-6]))
    phi = found.rotation[0]
    forces = [LINE * max(0.04 * phi - gap, 0.0) ** (10 / 9) for gap in (0.0, 1e-6)]
    assert forces[1] > 0 and 0.04 * sum(forces) == pytest.approx(TORQUE, rel=1e-12)


def test_shafts_and_bearings_are_in_series_with_one_contact():
    """1/K = 1/K_0 + 1/k_out + phi'^2/k_in + (1/k_cam + 1/k_wheel)/h^2 for a force in the wheel's plane."""
    bare, contacts = solve(RollerDrive(R), made(-0.04)), made(-0.04)
    parts = {"output": 3e5, "input": 2e4, "cam": 1e8, "wheel": 2e8}
    found = solve(RollerDrive(R, **parts), contacts)
    added = {"wheel": 1 / 3e5 + 1 / (2e8 * 0.04**2), "input": 0.4**2 / 2e4, "cam": 1 / (1e8 * 0.04**2), "pin": 1 / bare.secant[0]}
    assert 1 / found.secant[0] == pytest.approx(sum(added.values()), rel=1e-10)
    for name, share in added.items():
        assert found.shares[name][0] == pytest.approx(share, rel=1e-9), name


def test_force_across_the_wheel_moves_its_cam_alone():
    """A force out of the wheel's plane: the cam yields along all of it, the wheel's radial bearing along its part in the plane."""
    way = np.array([0.0, -0.6, 0.8])
    bare = solve(RollerDrive(R), made(-0.04, directions=[way]))
    cam, wheel = (solve(RollerDrive(R, **{name: 1e8}), made(-0.04, directions=[way])) for name in ("cam", "wheel"))
    assert 1 / cam.secant[0] - 1 / bare.secant[0] == pytest.approx(1 / (1e8 * 0.04**2), rel=1e-9)
    assert 1 / wheel.secant[0] - 1 / bare.secant[0] == pytest.approx(0.36 / (1e8 * 0.04**2), rel=1e-9)


# -- second routes ------------------------------------------------------------------------------------------------------------------

LOADED = {
    "parallel": LoadedRollers(parallel(), RollerDrive(R), "unilateral", WIDTH),
    "two a step": LoadedRollers(parallel(8, 4, 1.0, 2.0, 6e-3), RollerDrive(R, 3e8), "unilateral", WIDTH),
    "globoidal": LoadedRollers(hourglass(), RollerDrive(0.08), "unilateral", 1.0),
    "barrel": LoadedRollers(drum(), RollerDrive(0.09, 5e8), "unilateral", 1.0),
}


def contact_force(approach, length, series):
    """Force of a line contact and a seat in series by bisection."""
    from scipy.optimize import brentq

    if approach <= 0:
        return 0.0
    line = PALMGREN_LINE * length ** (8 / 9)
    if series is None:
        return line * approach ** (10 / 9)
    return brentq(lambda force: (force / line) ** 0.9 + force / series - approach, 0.0, series * approach, xtol=1e-9)


@pytest.mark.parametrize("name", LOADED)
@pytest.mark.parametrize("torque", [TORQUE, -TORQUE])
def test_rotation_is_that_of_bisection(name, torque):
    """Rigid shafts: the turn at which the forces of all contacts balance the torque, found without energy or derivative."""
    from scipy.optimize import brentq

    loaded, angles = LOADED[name], np.array([0.1, 0.9, 1.7, 2.3, 5.5])
    found, contacts = solve_rollers(loaded, angles, torque)
    for here, rotation in zip(contacts, found.rotation, strict=True):

        def missing(phi, here=here):
            forces = [
                contact_force(-arm * phi - gap, length, loaded.yields.series)
                for arm, gap, length in zip(here.arm, here.gap, here.length, strict=True)
            ]
            return np.dot(forces, here.arm) + torque

        wanted = brentq(missing, *sorted((0.0, np.sign(torque) * 1e-2)), xtol=1e-16)
        assert rotation == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize("name", ["parallel", "globoidal"])
def test_torque_is_the_derivative_of_the_stored_energy(name):
    """V = sum 9/19 c d^(19/9) over the contacts; dV/dphi by differences."""
    loaded, small = LOADED[name], 1e-4
    found, contacts = solve_rollers(loaded, np.array([0.8]), TORQUE)
    here = contacts[0]

    def energy(phi):
        depth = np.maximum(-here.arm * phi - here.gap, 0.0)
        return np.sum(9 / 19 * PALMGREN_LINE * here.length ** (8 / 9) * depth ** (19 / 9))

    phi = found.rotation[0]
    assert (energy(phi * (1 + small)) - energy(phi * (1 - small))) / (2 * small * phi) == pytest.approx(TORQUE, rel=1e-6)


@pytest.mark.parametrize("series", [None, 5e8])
@pytest.mark.parametrize("torque", [300.0, -300.0])
def test_engine_of_the_pin_wheels_gives_the_same(series, torque):
    """A pin wheel with one cam on rigid cranks, stated as rollers on a cam whose place and turn are locked."""
    wheel, angles = PinWheel(12, 0.12, 8e-3, 0.01, index_motion("modified-sine", 12)), np.deg2rad([45.0, 60.0, 90.0, 200.0])
    contacts = contacts_at(wheel, angles, 2e-3)
    other = solve_torsional_stiffness(Drivetrain(0.11, pin_contact(0.018, series)), angles, contacts, 0.01, torque, cams=1)
    stated = [of_plate_cams([each], 12, 8e-3, 0.018) for each in contacts]
    ours = solve_roller_stiffness(RollerDrive(0.12, series), angles, wheel.motion(angles).d1, stated, torque)
    np.testing.assert_array_equal(ours.outcome, other.outcome)
    np.testing.assert_allclose(ours.secant, other.secant, rtol=1e-9)
    np.testing.assert_allclose(ours.tangent, other.tangent, rtol=1e-8)
    for one, two in zip(ours.pin_forces, other.pin_forces, strict=True):
        np.testing.assert_allclose(one, two[0], rtol=1e-8, atol=1e-6)


@pytest.mark.property
@pytest.mark.parametrize("interference", [0.0, 2e-6])
def test_mirror_image_of_a_symmetric_step(interference):
    """K(theta, T) = K(theta_h - theta, -T) of a parallel drive."""
    yields = RollerDrive(R, 3e8, 5e8, 2e5, 4e8, 1e6, interference)
    loaded = LoadedRollers(parallel(), yields, "unilateral", WIDTH)
    angles = np.array([0.2, 0.7, 1.3])
    one, _ = solve_rollers(loaded, angles, TORQUE)
    two, _ = solve_rollers(loaded, np.pi - angles, -TORQUE)
    np.testing.assert_allclose(one.secant, two.secant, rtol=1e-7)


@pytest.mark.property
@pytest.mark.parametrize(("make", "radius"), [(parallel, R), (hourglass, 0.08)])
def test_stiffness_grows_with_the_cube_of_the_size(make, radius):
    """Sizes by s, torque by s^3: forces s^2, approaches s, for F ~ L^(8/9) d^(10/9)."""
    size = {"scale": 2.5}
    small, large = (LoadedRollers(make(**each), RollerDrive(radius * s), "unilateral", WIDTH * s) for each, s in (({}, 1.0), (size, 2.5)))
    angles = np.array([0.3, 1.1, 2.0])
    one, _ = solve_rollers(small, angles, TORQUE)
    two, _ = solve_rollers(large, angles, TORQUE * 2.5**3)
    np.testing.assert_allclose(two.secant, one.secant * 2.5**3, rtol=2e-6)


@pytest.mark.property
@pytest.mark.parametrize("interference", [0.0, 3e-6])
@pytest.mark.parametrize("name", LOADED)
def test_shares_add_up_and_forces_balance(name, interference):
    loaded = LOADED[name]
    loaded = loaded._replace(yields=loaded.yields._replace(cam=5e8, wheel=4e8, input=2e5, output=1e6, interference=interference))
    found, contacts = solve_rollers(loaded, np.array([0.1, 1.0, 2.0, 6.0]), TORQUE)
    assert found.carried.all()
    np.testing.assert_allclose(sum(found.shares.values()) * found.secant, 1.0, rtol=1e-6)
    for here, forces in zip(contacts, found.pin_forces, strict=True):
        assert np.dot(forces, here.arm) == pytest.approx(-TORQUE, rel=1e-8)
        assert forces.min() >= 0


def test_slices_along_the_rollers_differ_little_from_their_mean_lever():
    """Each stretch of a contact line with its own lever, the law per length c L^(-1/9): within 0.5 %."""
    from scipy.optimize import brentq

    cam, angles = hourglass(), np.array([0.4, 1.4, 2.6])
    flanks = compute_flanks(cam, angles, 33)
    found, _ = solve_rollers(LOADED["globoidal"], angles, TORQUE)
    length = flanks.integrate_along_lines(np.ones_like(flanks.contact.arm))
    for k, rotation in enumerate(found.rotation):

        def missing(phi, k=k):
            depth = np.maximum(-flanks.contact.arm * phi, 0.0) ** (10 / 9)
            per_length = PALMGREN_LINE * np.maximum(length, 1e-12)[..., None] ** (-1 / 9) * depth
            return np.sum(flanks.integrate_along_lines(per_length * flanks.contact.arm)[:, :, k]) + TORQUE

        assert rotation == pytest.approx(brentq(missing, 0.0, 1e-2, xtol=1e-16), rel=5e-3)


# -- geometry of the contacts -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("cam", [hourglass(), drum()], ids=["globoidal", "barrel"])
def test_force_has_its_lever_about_the_wheel_and_its_power_at_the_cam(cam):
    """(c x f) along the wheel's axis is the lever; f has no power against the motion, so its moment about the cam's axis is h phi'."""
    angles = np.array([0.5, 1.3, 2.4])
    flanks = compute_flanks(cam, angles, 9)
    centre = np.array([cam.centre_distance, 0.0, cam.height])
    point, outwards = (rotate_about_y(each, cam.hand_sign * angles[:, None]) for each in (flanks.contact.point, flanks.contact.normal))
    about_wheel = np.cross(point + centre, -outwards)[..., 2]
    about_cam = cam.hand_sign * np.cross(point, -outwards)[..., 1]
    length = flanks.integrate_along_lines(np.ones_like(about_wheel))
    for number, here in enumerate(of_flanks(flanks)):
        flank, roller = here.cam, here.roller - cam.rollers[0]
        own = (flank, roller, number)
        np.testing.assert_allclose(here.arm, flanks.integrate_along_lines(about_wheel)[own] / length[own], rtol=1e-10)
        wanted = here.arm * float(cam.motion(angles[number]).d1)
        np.testing.assert_allclose(flanks.integrate_along_lines(about_cam)[own] / length[own], wanted, rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(here.length, length[own], rtol=1e-12)
        mean = -np.stack([flanks.integrate_along_lines(outwards[..., axis])[own] for axis in range(3)], axis=1)
        np.testing.assert_allclose(here.normal, mean / np.linalg.norm(mean, axis=1, keepdims=True), atol=1e-12)
        assert np.all(np.sign(here.arm) == 1 - 2 * flank)


def test_roller_contacts_of_plate_cams_have_the_moment_at_the_cam():
    """The cams turn clockwise: the moment of the force on a cam about its axis, times that turn, is h phi' too."""
    loaded, angles = LOADED["parallel"], np.array([0.8, 1.5])
    for here, angle in zip(roller_contacts(loaded, angles), angles, strict=True):
        levels = [contacts_at(level, [angle], 2e-3)[0] for level in loaded.drive.levels]
        centre = np.concatenate([each.centre for each in levels])
        force = here.normal[:, 0] + 1j * here.normal[:, 1]
        about_cam = np.imag(np.conj(centre - loaded.drive.centre_distance) * force)
        touching = here.gap < 1e-9
        np.testing.assert_allclose(np.imag(np.conj(centre) * force), here.arm, atol=1e-12)
        wanted = -here.arm * float(loaded.drive.motion(angle).d1)
        np.testing.assert_allclose(about_cam[touching], wanted[touching], atol=1e-9)
        assert here.curvature[touching].min() > 0


def test_curvature_of_the_dwell_arc_adds_to_that_of_the_roller():
    """A roller rests on the dwell arc about the cam's axis: 1/r + 1/(distance - r)."""
    loaded = LOADED["parallel"]
    here, level = roller_contacts(loaded, np.array([5.0]))[0], loaded.drive.levels[0]
    centre = level.pin_centres(5.0).d0
    resting = (here.gap < 1e-9) & (here.cam == 0)
    distance = np.abs(centre[here.roller[resting]] - loaded.drive.centre_distance)
    np.testing.assert_allclose(here.curvature[resting], 1 / 8e-3 + 1 / (distance - 8e-3), rtol=1e-9)


# -- where nothing holds, and errors ------------------------------------------------------------------------------------------------


def test_wheel_with_play_is_solved_after_it():
    loaded = LoadedRollers(parallel(8, 4), RollerDrive(R), "unilateral", WIDTH)
    angles = np.deg2rad([27.0, 45.0])
    first, contacts = solve_rollers(loaded, angles, TORQUE)
    assert first.outcome == (FREE, "carried") and np.isnan(first.secant[0])
    after, _, play = solve_rollers_after_play(loaded, angles, TORQUE, first, contacts)
    assert play[0] > 1e-4 and play[1] == 0.0
    assert after.carried.all() and after.secant[1] == first.secant[1]
    assert 1e5 < after.secant[0] < 1e7


@pytest.mark.error
@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"drive": RollerDrive(R, series=-1.0)}, "series = -1 N/m must be above 0; leave it out for a rigid part"),
        ({"drive": RollerDrive(R, interference=-1e-6)}, "interference = -1e-06 m"),
        ({"torque": 0.0}, "the torque must be finite and not 0"),
        ({"model": "welded"}, "no model 'welded'"),
        ({"theta": [0.0, 1.0]}, "2 positions need as many ratios and sets of contacts, got 1 and 1"),
    ],
)
def test_what_cannot_be_solved_is_refused(change, words):
    given = {"drive": RollerDrive(R), "theta": [0.0], "ratio": [0.3], "contacts": [made(-0.04)], "torque": 1.0} | change
    with pytest.raises(InputError, match=words):
        solve_roller_stiffness(**given)


def test_angles_may_be_of_a_whole_turn():
    found, _ = solve_rollers(LOADED["globoidal"], np.linspace(0, TURN, 9), TORQUE)
    assert found.secant[0] == pytest.approx(found.secant[-1], rel=1e-9)
