"""Followers against closed forms: an eccentric circle under every follower, the pole, the geometry of the normal."""

import numpy as np
import pytest

from drivewright import cams
from drivewright.cams import oscillating, translating
from drivewright.motion import Programme, Segment
from drivewright.numerics.jets import Jet, atan2, cos, exp, sin, sqrt, variable

pytestmark = pytest.mark.analytical

E, RHO, R, C, L = 0.012, 0.03, 0.007, 0.085, 0.062  # eccentricity, radius of the circle, roller, pivot distance, arm
PHASE = 0.7  # away from the symmetric point
THETA = np.linspace(0, 2 * np.pi, 97)


def centre(sense):
    """Centre of the eccentric circle in the machine frame, a jet of the cam angle."""
    return E * exp(1j * (sense * variable(THETA) + PHASE))


def lever_lift(sense, psi_of, rest):
    """(angle, swing) that keeps a lever on the circle."""
    gap = C - centre(sense)
    return variable(THETA), psi_of(gap, sqrt(gap.abs2())) - rest


def angle_of(z):
    return atan2(z.imag, z.real)


def acos(x):
    return atan2(sqrt(1 - x * x), x)


def asin(x):
    return atan2(x, sqrt(1 - x * x))


def translating_roller(sense, offset, side=1):
    e, z = sense * offset, centre(sense)
    height = z.imag + side * sqrt((RHO + R) ** 2 - (e - z.real) * (e - z.real))
    follower = cams.TranslatingRound(0.04, R, offset, sense, side)
    return follower, variable(THETA), height - side * translating.rest_height(0.04, offset)


def oscillating_roller(sense, side=1):
    follower = cams.OscillatingRound(0.04, R, C, L, sense, side)

    def psi(gap, d):
        """Cosine rule in the triangle pivot, centre of the circle, roller; the line of centres itself is turned by arg(C - z)."""
        return acos((d * d + L**2 - (RHO + R) ** 2) / (2 * L * d)) - side * angle_of(gap)

    angle, opening = lever_lift(sense, psi, follower.rest_angle)
    return follower, angle, side * opening


def oscillating_flat(sense, beyond):
    follower = cams.OscillatingFlat(0.035, C, L, beyond, sense)
    return follower, *lever_lift(sense, lambda gap, d: asin((RHO - beyond) / d) - angle_of(gap), follower.rest_angle)


def translating_flat(sense, tilt):
    follower = cams.TranslatingFlat(0.035, tilt, 0.004, sense)
    normal = 1j * np.exp(1j * sense * tilt)
    support = RHO + (centre(sense) * np.conj(normal)).real
    return follower, variable(THETA), (support - 0.035) / np.cos(tilt)


FOLLOWERS = [
    case(sense, *more)
    for sense in (1, -1)
    for case, *more in (
        (translating_roller, 0.0),
        (translating_roller, 0.009),
        (translating_roller, -0.006, -1),
        (oscillating_roller,),
        (oscillating_roller, -1),
        (oscillating_flat, 0.005),
        (oscillating_flat, -0.004),
        (translating_flat, 0.0),
        (translating_flat, 0.12),
    )
]
NAMES = [f"{type(case[0]).__name__}-{number}" for number, case in enumerate(FOLLOWERS)]


@pytest.mark.parametrize("case", FOLLOWERS, ids=NAMES)
def test_an_eccentric_circle_comes_back_as_a_circle(case):
    follower, angle, lift = case
    contact = follower.contact(angle, lift)
    middle, flat = E * np.exp(1j * PHASE), hasattr(follower, "face")
    assert np.allclose(np.abs(contact.point.d0 - middle), RHO, atol=1e-15)
    assert np.allclose(contact.normal, (contact.point.d0 - middle) / RHO, atol=1e-12)
    assert np.allclose(contact.curvature.d0, 1 / RHO, rtol=1e-11)
    assert np.allclose(contact.pitch_curvature.d0, 1 / (RHO if flat else RHO + R), rtol=1e-11)
    assert np.allclose(contact.pitch_curvature.d1, 0, atol=1e-7 / RHO)
    assert np.allclose(np.abs(contact.pitch.d0 - middle), RHO if flat else RHO + R, atol=1e-15)


def velocity(follower, contact, lift, angle):
    """Velocity of the follower's material where its force is counted (round: centre; flat: contact), machine frame, per cam speed."""
    here = (contact.point if hasattr(follower, "face") else contact.pitch).d0 * np.exp(1j * follower.sense * angle.d0)
    if hasattr(follower, "pivot_distance"):
        return -1j * lift.d1 * (here - follower.pivot_distance), here
    return 1j * lift.d1, here


@pytest.mark.parametrize("case", FOLLOWERS, ids=NAMES)
def test_pressure_angle_is_the_angle_between_normal_and_path(case):
    follower, angle, lift = case
    contact = follower.contact(angle, lift)
    normal = contact.normal * np.exp(1j * follower.sense * angle.d0)
    moving = np.abs(lift.d1) > 1e-3
    speed, _ = velocity(follower, contact, lift, angle)
    path = getattr(follower, "side", 1) * speed[moving] / lift.d1[moving]  # out of the cam
    signed = follower.sense * np.angle(normal[moving] / path)
    assert np.allclose(contact.pressure_angle.d0[moving], signed, atol=1e-12)


@pytest.mark.parametrize("case", FOLLOWERS, ids=NAMES)
def test_leverage_is_normal_travel_over_travel(case):
    follower, angle, lift = case
    contact = follower.contact(angle, lift)
    speed, _ = velocity(follower, contact, lift, angle)
    normal = contact.normal * np.exp(1j * follower.sense * angle.d0)
    assert np.allclose(contact.leverage.d0 * follower.reach * lift.d1, (speed * np.conj(normal)).real, atol=1e-15)


@pytest.mark.parametrize("case", FOLLOWERS, ids=NAMES)
def test_sliding_is_relative_turning_times_distance_from_the_pole(case):
    follower, angle, lift = case
    contact, sense = follower.contact(angle, lift), follower.sense
    point = contact.point.d0 * np.exp(1j * sense * angle.d0)
    if hasattr(follower, "pivot_distance"):  # w1 x = w2 (x - C) with w1 = sense, w2 = -f
        turn, pole = sense + lift.d1, lift.d1 * C / (sense + lift.d1)
    else:
        turn, pole = sense, sense * lift.d1
    assert np.allclose(np.abs(contact.sliding.d0), np.abs(turn * (point - pole)), atol=1e-15)


@pytest.mark.parametrize("case", FOLLOWERS, ids=NAMES)
def test_slopes_agree_with_the_values(case):
    follower, angle, lift = case
    contact = follower.contact(angle, lift)
    for jet in (contact.pressure_angle, contact.leverage, contact.point, contact.sliding, contact.rolling):
        # A smooth periodic function: the derivative of its Fourier series is exact to rounding.
        value, slope = (np.broadcast_to(part, THETA.shape)[:-1] for part in (jet.d0, jet.d1))
        wave = np.fft.fftfreq(len(value), 1 / len(value))
        assert np.allclose(np.fft.ifft(1j * wave * np.fft.fft(value)), slope, atol=1e-9)


def test_turning_against_the_lever_is_not_the_mirror_image():
    """A lever keeps its place when the cam turns the other way; the angle at a standstill changes its sign."""
    swing = Jet(*(np.full(3, value) for value in (0.2, 0.0, 0.0, 0.0)))
    one, other = (cams.OscillatingRound(0.04, R, C, L, sense).contact(variable(np.zeros(3)), swing).pressure_angle.d0 for sense in (1, -1))
    psi = oscillating.rest_angle(0.04, C, L) + 0.2
    assert np.allclose(np.tan(one), (L - C * np.cos(psi)) / (C * np.sin(psi)), atol=1e-14)
    assert np.allclose(one, -other, atol=1e-15)


@pytest.mark.parametrize("sense", [1, -1])
def test_two_rollers_on_one_lever_keep_their_distance(sense):
    main, back = cams.OscillatingRound(0.04, R, C, L, sense), cams.OscillatingRound(0.058, R, C, 0.05, sense, side=-1)
    angle = variable(THETA)
    swing = 0.1 + 0.1 * sin(angle + 0.3) + 0.03 * cos(2 * angle)
    apart = np.abs(main.pitch(angle, swing).d0 - back.pitch(angle, swing).d0)
    between = main.rest_angle + back.rest_angle
    assert np.allclose(apart, np.sqrt(L**2 + 0.05**2 - 2 * L * 0.05 * np.cos(between)), atol=1e-15)


def test_two_rollers_on_one_slide_keep_their_distance():
    angle = variable(THETA)
    lift = 0.01 + 0.008 * sin(angle + 0.3)
    main, back = cams.TranslatingRound(0.04, R, 0.005), cams.TranslatingRound(0.06, R, -0.008, side=-1)
    apart = main.pitch(angle, lift).d0 - back.pitch(angle, lift).d0
    height = np.sqrt(0.04**2 - 0.005**2) + np.sqrt(0.06**2 - 0.008**2)
    assert np.allclose(apart * np.exp(1j * THETA), 0.013 + 1j * height, atol=1e-15)


@pytest.mark.parametrize("orbit", [1, -1])
@pytest.mark.parametrize("side", [1, -1])
def test_general_form_of_a_pivot_that_orbits_the_cam(orbit, side):
    """B = -i C e^{iq} + i L e^{iw}, w = q - side psi; |L (1 - sense f) - C cos psi|/(C sin psi), f by |q|."""
    t = variable(THETA)
    q = orbit * (t + 0.2 * sin(t))
    swing = 0.1 + 0.1 * cos(t + 0.4)
    psi = 0.9 + side * swing
    pitch = oscillating.pitch_curve(q - np.pi / 2, psi, C, L, side)
    assert np.allclose(pitch.d0, -1j * C * np.exp(1j * q.d0) + 1j * L * np.exp(1j * (q.d0 - side * psi.d0)), atol=1e-15)
    f = swing.d1 / np.abs(q.d1)
    tangent = np.abs(L * (1 - orbit * f) - C * np.cos(psi.d0)) / (C * np.sin(psi.d0))
    pressure = oscillating.pressure_angle(q - np.pi / 2, psi, C, L, side).d0
    assert np.allclose(np.tan(np.abs(pressure)), tangent, atol=1e-13)
    # Positive where it opposes a growing psi: the normal out of the cam leans against the pivot's orbit.
    outward = -1j * orbit * pitch.d1 / np.abs(pitch.d1)
    along = 1j * side * np.exp(1j * (q.d0 - np.pi / 2)) * np.exp(-1j * side * psi.d0)
    assert np.allclose(pressure, -orbit * np.angle(outward / along), atol=1e-12)


def test_curvature_sign_and_offset():
    angle = variable(THETA)
    circle = 0.03 * exp(1j * angle)
    assert np.allclose(cams.curvature(circle).d0, 1 / 0.03)
    assert np.allclose(cams.curvature(circle.conj(), -1).d0, 1 / 0.03)


@pytest.mark.parametrize(("prime", "arm"), [(0.04, 0.062), (0.05, 0.062), (0.04, 0.055), (0.0231, 0.062), (0.1469, 0.062)])
def test_rest_angle_closes_the_triangle(prime, arm):
    psi = oscillating.rest_angle(prime, C, arm)
    assert abs(C - arm * np.exp(-1j * psi)) == pytest.approx(prime, rel=1e-13)


# -- a turn in pieces ------------------------------------------------------------------------------------------------------------


def test_extremes_are_one_sided_and_exact():
    """Parabolic: s'' jumps from +4h/b^2 to -4h/b^2 in the middle of the rise; its extremes stand at one side of a joint."""
    b = np.radians(100)
    programme = Programme((Segment(b, "parabolic", 0.01), Segment(2 * np.pi - 2 * b, "dwell"), Segment(b, "parabolic", -0.01)))
    cycle = cams.Cycle(programme.function)
    highest = cycle.maximum(lambda _, lift: Jet(lift.d2, lift.d3, lift.d3, lift.d3))
    assert highest.value == pytest.approx(0.04 / b**2, rel=1e-12)
    assert highest.angle == 0.0
    assert highest.piece == 0


def test_extreme_inside_a_piece_is_found_to_rounding():
    b = 1.3
    programme = Programme((Segment(b, "cycloidal", 0.01), Segment(2 * np.pi - 2 * b, "dwell"), Segment(b, "cycloidal", -0.01)))
    cycle = cams.Cycle(programme.function)
    steepest = cycle.maximum(lambda _, lift: Jet(lift.d1, lift.d2, lift.d3, lift.d3))
    assert steepest.angle == pytest.approx(b / 2, abs=1e-12)
    assert steepest.value == pytest.approx(0.02 / b, rel=1e-14)
    lowest = cycle.minimum(lambda _, lift: Jet(lift.d1, lift.d2, lift.d3, lift.d3))
    assert lowest.angle == pytest.approx(2 * np.pi - b / 2, abs=1e-12)


def test_lift_later_in_the_turn():
    b = 1.3
    programme = Programme((Segment(b, "cycloidal", 0.01), Segment(2 * np.pi - 2 * b, "dwell"), Segment(b, "cycloidal", -0.01)))
    angle = variable(np.array([0.2, 5.5]))
    later = cams.Cycle(programme.function).after(1.0, angle)
    assert np.allclose(later.d0, programme(np.array([1.2, 6.5 - 2 * np.pi])).s, atol=1e-16)
    assert np.allclose(later.d1, programme(np.array([1.2, 6.5 - 2 * np.pi])).v, atol=1e-15)


def test_restricted_to_some_pieces():
    b = 1.3
    programme = Programme((Segment(b, "cycloidal", 0.01), Segment(2 * np.pi - 2 * b, "dwell"), Segment(b, "cycloidal", -0.01)))
    cycle = cams.Cycle(programme.function, chosen=(1,))
    found = cycle.maximum(lambda _, lift: lift)
    assert (found.value, found.angle) == (pytest.approx(0.01), b)
