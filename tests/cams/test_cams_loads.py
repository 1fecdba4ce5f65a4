"""Forces, spring, jump speed and vibration against closed forms of a harmonic lift s = h/2 (1 - cos theta) and of a cycloidal rise."""

import numpy as np
import pytest

from drivewright import cams
from drivewright.errors import InputError
from drivewright.motion import Programme, Segment
from drivewright.numerics.ode import Functions, integrate

pytestmark = pytest.mark.analytical

H, MASS, K, P, F, DAMPING = 0.024, 0.7, 3000.0, 25.0, 8.0, 9.0
HARMONIC = cams.Cycle(Programme((Segment(np.pi, "simple-harmonic", H), Segment(np.pi, "simple-harmonic", -H))).function)
LOAD = cams.FollowerLoad(MASS, 0.0, K, P, F)


def least_force(load, speed):
    return HARMONIC.minimum(lambda _, lift: cams.follower_force(lift, load, speed)).value


@pytest.mark.parametrize("speed", [20.0, 65.0, 120.0])
def test_least_force_of_a_harmonic_lift(speed):
    """Q = h/2 (m w^2 - k) cos theta + c w h/2 sin theta + k h/2 + P + F."""
    load = LOAD._replace(damping=DAMPING)
    swing = H / 2 * np.hypot(MASS * speed**2 - K, DAMPING * speed)
    assert least_force(load, speed) == pytest.approx(K * H / 2 + P + F - swing, rel=1e-12)


def test_needed_preload():
    speed = 110.0
    needed = cams.needed_preload(HARMONIC, cams.LoadPath(1.0), LOAD, speed)
    assert needed == pytest.approx(H / 2 * (MASS * speed**2 - K) - K * H / 2 - F, rel=1e-12)
    assert least_force(LOAD._replace(preload=needed), speed) == pytest.approx(0, abs=1e-10)
    assert cams.needed_preload(HARMONIC, cams.LoadPath(1.0), LOAD, 10.0) == 0.0


def test_needed_stiffness():
    speed = 110.0
    needed = cams.needed_stiffness(HARMONIC, cams.LoadPath(1.0), LOAD, speed)
    assert needed == pytest.approx((MASS * speed**2 * H / 2 - P - F) / H, rel=1e-12)
    damped = LOAD._replace(damping=DAMPING)
    needed = cams.needed_stiffness(HARMONIC, cams.LoadPath(1.0), damped, speed)
    assert least_force(damped._replace(stiffness=needed), speed) == pytest.approx(0, abs=1e-9)
    assert cams.needed_stiffness(HARMONIC, cams.LoadPath(1.0), LOAD, 10.0) == 0.0
    assert cams.needed_stiffness(HARMONIC, cams.LoadPath(1.0), LOAD._replace(preload=0.0, force=-5.0), 10.0) == np.inf


def test_travel_of_a_lever_counts_at_its_arm():
    swing = cams.Cycle(Programme((Segment(np.pi, "simple-harmonic", 0.4), Segment(np.pi, "simple-harmonic", -0.4))).function)
    load, speed = LOAD._replace(damping=DAMPING), 100.0
    for function in (cams.needed_preload, cams.needed_stiffness):
        at_arm, direct = (function(*each, load, speed) for each in ((swing, cams.LoadPath(H / 0.4)), (HARMONIC, cams.LoadPath(1.0))))
        assert at_arm == pytest.approx(direct, rel=1e-12)
    assert cams.jump(swing, cams.LoadPath(H / 0.4), load).speed == pytest.approx(
        cams.jump(HARMONIC, cams.LoadPath(1.0), load).speed, rel=1e-12
    )


def test_jump_speed():
    assert cams.jump(HARMONIC, cams.LoadPath(1.0), LOAD).speed == pytest.approx(np.sqrt((P + F + K * H) * 2 / (MASS * H)), rel=1e-12)
    # With damping (K h/2 + P + F)^2 = (h/2)^2 ((m w^2 - k)^2 + c^2 w^2), a quadratic in w^2.
    static = (K * H / 2 + P + F) / (H / 2)
    squares = np.roots([MASS**2, DAMPING**2 - 2 * MASS * K, K**2 - static**2])
    assert cams.jump(HARMONIC, cams.LoadPath(1.0), LOAD._replace(damping=DAMPING)).speed == pytest.approx(np.sqrt(squares.max()), rel=1e-12)


def test_jump_speed_at_its_ends():
    assert cams.jump(HARMONIC, cams.LoadPath(1.0), LOAD._replace(mass=0.0)).speed == np.inf
    assert cams.jump(HARMONIC, cams.LoadPath(1.0), LOAD._replace(preload=0.0, force=0.0)).speed == 0.0
    parabolic = cams.Cycle(Programme((Segment(np.pi, "parabolic", H), Segment(np.pi, "parabolic", -H))).function)
    # s'' = -4h/pi^2 from half the rise on: contact is first lost there, at s = h/2.
    expected = np.sqrt((P + F + K * H / 2) / (MASS * 4 * H / np.pi**2))
    assert cams.jump(parabolic, cams.LoadPath(1.0), LOAD).speed == pytest.approx(expected, rel=1e-9)


FOLLOWERS = [
    cams.TranslatingRound(0.045, 0.008, 0.006),
    cams.TranslatingRound(0.045, 0.008, 0.006, sense=-1),
    cams.TranslatingRound(0.06, 0.008, 0.004, side=-1),
    cams.TranslatingFlat(0.05, 0.15, sense=-1),
    cams.OscillatingRound(0.045, 0.008, 0.085, 0.06),
    cams.OscillatingRound(0.045, 0.008, 0.085, 0.06, sense=-1),
    cams.OscillatingRound(0.06, 0.008, 0.085, 0.06, side=-1),
    cams.OscillatingFlat(0.05, 0.09, 0.06, 0.004),
    cams.OscillatingFlat(0.05, 0.09, 0.06, 0.004, sense=-1),
]
SURFACES = [(f, {}) for f in FOLLOWERS] + [(FOLLOWERS[0], {"flank": -1}), (FOLLOWERS[5], {"flank": -1})]


@pytest.mark.parametrize(("follower", "how"), SURFACES, ids=range(len(SURFACES)))
def test_power_in_is_power_out(follower, how):
    """Torque of the normal forces about the cam's centre = force along the travel times dx/dtheta."""
    rise = 0.25 if hasattr(follower, "pivot_distance") else 0.012
    programme = Programme((Segment(1.5, "modified-sine", rise), Segment(2.0, "polynomial-345", -rise), Segment(2 * np.pi - 3.5, "dwell")))
    cycle = cams.Cycle(programme.function)
    angle, lift = cycle.at(*cycle.samples())
    contact, travel = follower.contact(angle, lift, **how), follower.reach * lift
    required = cams.follower_force(travel, LOAD, 40.0)
    normal = cams.cam_normal_force(required, contact).d0
    moment = follower.sense * normal * np.imag(np.conj(contact.point.d0) * contact.normal)
    torque = cams.drive_torque(travel, required).d0
    assert np.max(np.abs(torque)) > 0.1
    assert np.allclose(moment, torque, atol=1e-12)


def test_work_of_a_turn_without_damping_is_nothing():
    nodes, weights = np.polynomial.legendre.leggauss(40)
    for damping, work in ((0.0, 0.0), (DAMPING, DAMPING * 50.0 * np.pi * (H / 2) ** 2)):
        total = 0.0
        for piece in (0, 1):
            at = np.pi * (piece + 0.5 + 0.5 * nodes)
            _, lift = HARMONIC.at(np.full(at.shape, piece), at)
            required = cams.follower_force(lift, LOAD._replace(damping=damping), 50.0)
            total += np.sum(0.5 * np.pi * weights * cams.drive_torque(lift, required).d0)
        assert total == pytest.approx(work, abs=1e-12)


def test_crossovers_and_play():
    free = LOAD._replace(stiffness=0.0, preload=0.0, force=0.0)
    assert cams.crossovers(HARMONIC, lambda _, lift: cams.follower_force(lift, free, 30.0)) == 2
    assert cams.crossovers(HARMONIC, lambda _, lift: cams.follower_force(lift, LOAD, 30.0)) == 0
    follower = cams.TranslatingRound(0.045, 0.008)
    steepest = HARMONIC.maximum(lambda angle, lift: follower.contact(angle, lift).pressure_angle).value
    assert cams.play(HARMONIC, follower.contact, 5e-5) == pytest.approx(5e-5 / np.cos(steepest), rel=1e-12)


def test_second_face_of_a_yoke():
    """On the other side of the cam at the same moment, pushing down."""
    half = ((2.0, "cycloidal"), (np.pi - 2.0, "dwell"))
    lopsided = Programme(tuple(Segment(width, law, 0.0 if law == "dwell" else sign * 0.01) for sign in (1, -1) for width, law in half))
    cycle, follower = cams.Cycle(lopsided.function), cams.TranslatingFlat(0.05)
    angle, lift = cycle.at(*cycle.samples())
    first, second = follower.contact(angle, lift), cams.opposite_contact(cycle, follower, angle, lift)
    assert np.allclose(second.normal, -first.normal, atol=1e-12)
    turned = np.exp(1j * angle.d0)
    assert np.allclose((second.point.d0 * turned).imag, lift.d0 - 0.01 - 0.05, atol=1e-15)
    assert np.allclose((second.point.d0 * turned).real, lift.d1, atol=1e-15)
    assert np.allclose(second.leverage.d0, -1)


# -- vibration -------------------------------------------------------------------------------------------------------------------


def cycloidal(width):
    back = 2 * np.pi - 1.0 - width
    return cams.Cycle(Programme((Segment(width, "cycloidal", H), Segment(1.0, "dwell"), Segment(back, "cycloidal", -H))).function)


@pytest.mark.parametrize("ratio", [3.3, 7.0, 19.7])
def test_residual_of_a_cycloidal_rise_from_rest(ratio):
    """y'' = A sin(p t): z = -A/(w^2 - p^2) (sin p t - p/w sin w t) in the rise, and a free swing of that state behind it."""
    speed, width = 12.0, 1.4
    w, time = ratio * speed, width / speed
    p = 2 * np.pi / time
    a = 2 * np.pi * H / time**2
    found = cams.transient_response(cycloidal(width), 1.0, speed, w)
    t = found.angle[found.piece == 0] / speed
    assert np.allclose(found.error.d0[found.piece == 0], -a / (w**2 - p**2) * (np.sin(p * t) - p / w * np.sin(w * t)), atol=1e-12 * H)
    residual = cams.free_amplitude(found, w)[found.piece == 1]
    assert np.allclose(residual, 2 * a * p / (w * abs(w**2 - p**2)) * abs(np.sin(w * time / 2)), rtol=1e-9)


@pytest.mark.parametrize(("ratio", "damping"), [(3.3, 0.0), (3.3, 0.1), (0.6, 0.3), (40.2, 0.02)])
def test_steady_vibration_of_a_harmonic_lift(ratio, damping):
    """z = Re(-(h/2) W^2 e^{iWt}/(w^2 - W^2 + 2 i zeta w W))."""
    speed = 12.0
    w = ratio * speed
    found = cams.periodic_response(HARMONIC, 1.0, speed, w, damping)
    expected = -H / 2 * speed**2 * np.exp(1j * found.angle) / (w**2 - speed**2 + 2j * damping * w * speed)
    assert np.allclose(found.error.d0, expected.real, atol=1e-12 * H)
    assert np.allclose(found.error.d1, (1j * speed * expected).real, atol=1e-12 * H * w)


@pytest.mark.parametrize("ratio", [3.3, 40.2])
def test_peaks_between_the_steps(ratio):
    speed, damping = 12.0, 0.05
    w = ratio * speed
    found = cams.periodic_response(HARMONIC, 1.0, speed, w, damping)
    size = H / 2 * speed**2 / abs(w**2 - speed**2 + 2j * damping * w * speed)
    assert cams.response_peak(found, speed, found.error) == pytest.approx(size, rel=1e-9)
    assert np.max(np.abs(found.error.d0)) < size * (1 - 1e-9)
    shock = size * abs(w**2 + 2j * damping * w * speed)
    assert cams.response_peak(found, speed, cams.mass_acceleration(found, w, damping)) == pytest.approx(shock, rel=1e-9)


def test_a_dwell_leaves_a_decaying_swing():
    speed, damping = 12.0, 0.1
    w = 9.0 * speed
    found = cams.transient_response(cycloidal(1.4), 1.0, speed, w, damping)
    rest = found.piece == 1
    left = cams.free_amplitude(found, w, damping)[rest] * np.exp(damping * w * found.angle[rest] / speed)
    assert np.ptp(left) < 1e-9 * left[0]


def test_acceleration_of_the_mass_is_that_of_its_path():
    speed, damping = 12.0, 0.1
    cycle = cycloidal(1.4)
    found = cams.periodic_response(cycle, 0.5, speed, 4.0 * speed, damping)
    planned = 0.5 * speed**2 * cycle.at(found.piece, found.angle)[1].d2
    assert np.allclose(cams.mass_acceleration(found, 4.0 * speed, damping).d0, found.error.d2 + planned, atol=1e-12)


def test_strong_damping_jumps_on_the_way_down():
    """Without mass c w s' + k s + P + F = 0 is linear in w: the least of -(k s + P + F)/(c s') over the return."""
    load = cams.FollowerLoad(0.0, DAMPING, K, P, F)
    theta = np.linspace(np.pi, 2 * np.pi, 200001)[1:-1]
    static, slope = K * H / 2 * (1 - np.cos(theta)) + P + F, H / 2 * np.sin(theta)
    assert cams.jump(HARMONIC, cams.LoadPath(1.0), load).speed == pytest.approx(np.min(-static / (DAMPING * slope)), rel=1e-9)


def test_quick_swings_are_peaked_between_coarse_steps():
    """A free swing behind a rise: its envelope is reached although a step is half a radian of it."""
    speed, w = 12.0, 19.7 * 12.0
    found = cams.transient_response(cycloidal(1.4), 1.0, speed, w)
    rest = found.piece == 1
    swing = cams.Response(found.angle[rest], found.piece[rest], found.error[rest])
    assert cams.response_peak(swing, speed, swing.error) == pytest.approx(cams.free_amplitude(found, w)[rest][0], rel=1e-6)


def test_a_jump_of_velocity_is_an_impulse():
    """Up and down at constant speed v: from rest z = -(2 v/w) sin(w t), then +2v more at the top."""
    tent = cams.Cycle(Programme((Segment(np.pi, "constant-velocity", H), Segment(np.pi, "constant-velocity", -H))).function)
    speed, w = 5.0, 31.0
    found = cams.transient_response(tent, 1.0, speed, w)
    rising = found.piece == 0
    kick = 2 * H / np.pi * speed
    assert np.allclose(found.error.d0[rising], -kick / w * np.sin(w * found.angle[rising] / speed), atol=1e-13)
    assert found.error.d1[~rising][0] - found.error.d1[rising][-1] == pytest.approx(kick, rel=1e-12)


def test_steady_state_against_an_adaptive_integrator():
    """Four turns of a well damped follower from rest, by the other route, end in the periodic state."""
    programme = Programme(
        (Segment(1.2, "modified-trapezoid", H), Segment(1.1, "dwell"), Segment(1.5, "parabolic", -H), Segment(2 * np.pi - 3.8, "dwell"))
    )
    cycle, speed, w, damping = cams.Cycle(programme.function), 10.0, 85.0, 0.15
    state = np.zeros(2)
    for _ in range(4):
        for piece, (start, stop) in enumerate(zip(cycle.motion.breaks[:-1], cycle.motion.breaks[1:], strict=True)):

            def slope(t, y, piece=piece):
                forcing = -(speed**2) * cycle.motion.on_piece(piece, t * speed).a
                return np.array([y[1], -2 * damping * w * y[1] - w**2 * y[0] + forcing])

            state = integrate(Functions(slope), start / speed, stop / speed, state, rtol=1e-8, atol=1e-12).y[-1]
    found = cams.periodic_response(cycle, 1.0, speed, w, damping)
    error = found.error
    assert state == pytest.approx([error.d0[-1], error.d1[-1]], rel=1e-5)
    assert (error.d0[0], error.d1[0]) == pytest.approx((error.d0[-1], error.d1[-1]), rel=1e-9)


def test_propagator_is_a_group():
    one, two = (cams.propagator(t, 30.0, 0.2) for t in (0.01, 0.02))
    assert np.allclose(one @ one, two, atol=1e-14)
    assert np.linalg.det(one) == pytest.approx(np.exp(-2 * 0.2 * 30 * 0.01), rel=1e-13)


@pytest.mark.parametrize(
    ("speed", "frequency", "damping", "word"),
    [(10.0, 50.0, 0.0, "resonance"), (10.0, 50.0, 1.0, "damping_ratio"), (0.0, 50.0, 0.1, "speed"), (1.0, 1e5, 0.1, "rigid")],
)
def test_vibration_refuses(speed, frequency, damping, word):
    with pytest.raises(InputError, match=word):
        cams.periodic_response(HARMONIC, 1.0, speed, frequency, damping)
