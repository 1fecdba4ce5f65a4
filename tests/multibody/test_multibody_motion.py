"""Motion of the planar multibody kernel against closed forms and textbook equations."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk

from drivewright.multibody.assembly import assemble
from drivewright.multibody.model import (
    GROUND,
    AppliedForce,
    AppliedTorque,
    Body,
    Bushing,
    CamPair,
    Curve,
    Dry,
    Gear,
    Ideal,
    JointDrive,
    LoadCurve,
    Lubricated,
    Marker,
    MultibodyModel,
    PinSlot,
    PointSpring,
    Prismatic,
    Revolute,
    Rolling,
    RotationalSpring,
    line,
)
from drivewright.multibody.observe import Observed, observe
from drivewright.multibody.record import record
from drivewright.multibody.simulate import Settings, simulate

pytestmark = pytest.mark.analytical

G = 9.81


class Seen:
    """What a mechanism does at some times: seen("crank", "angle") -> (m,)."""

    def __init__(self, model, times, rtol=1e-10):
        self.assembly = assemble(model)
        self.run = simulate(self.assembly, times[-1] - times[0], Settings(rtol=rtol, max_step=0.05), samples=times)
        assert self.run.outcome == "complete", self.run.advice
        parts = [observe(s.system, s.t, s.y) for s in self.run.stretches if len(s.t)]
        self.observed = Observed(*(np.concatenate(rows) for rows in zip(*parts, strict=True)))
        np.testing.assert_array_equal(self.observed.t, times)

    def __call__(self, body, field):
        return self.observed.body(self.assembly.names.index(body), field)

    @property
    def torque(self):
        """Of the first drive."""
        return self.observed.drives[:, 0]


def near(found, wanted, size=None, rel=1e-8):
    """Within rel of the largest value wanted, or of `size`."""
    wanted = np.broadcast_to(wanted, np.shape(found))
    np.testing.assert_allclose(found, wanted, rtol=0, atol=rel * (size or np.max(np.abs(wanted))))


def polynomial(*coefficients):
    return Curve(np.array([0.0, 1.0]), np.array([[*coefficients, *[0.0] * (6 - len(coefficients))]]))


def swing(amplitude, omega, t):
    """(angle, rate) of the pendulum q'' = -omega^2 sin q, released at rest at `amplitude`."""
    m = np.sin(amplitude / 2) ** 2
    sn, cn, dn, _ = ellipj(omega * t, m)
    half = np.sqrt(m) * cn / dn
    angle = 2 * np.arcsin(half)
    return angle, -2 * omega * np.sqrt(m) * np.sqrt(1 - m) * sn / dn**2 * np.sqrt(1 - m) / np.sqrt(1 - half**2)


# ------------------------------------------------------------------------------------------------------------ free and pinned


def test_projectile_spins_on_a_parabola():
    body = Body("stone", 2.0, 0.3, centroid=(0.1, -0.2), angle=0.4, velocity=(3.0, 5.0), angular_velocity=-7.0)
    t = np.linspace(0, 0.8, 9)
    seen = Seen(MultibodyModel((body,), (), gravity=(0.7, -G)), t)
    start = seen("stone", "x")[0], seen("stone", "y")[0]
    near(seen("stone", "x") - start[0], 3 * t + 0.35 * t**2)
    near(seen("stone", "y") - start[1], 5 * t - G / 2 * t**2)
    near(seen("stone", "angle"), 0.4 - 7 * t)
    near(seen("stone", "ay"), -G)


@pytest.mark.parametrize("amplitude", [0.3, 2.0, 3.05])
def test_physical_pendulum_follows_elliptic_functions(amplitude):
    mass, inertia, arm = 2.0, 0.03, 0.3
    omega = np.sqrt(mass * G * arm / (inertia + mass * arm**2))
    period = 4 * ellipk(np.sin(amplitude / 2) ** 2) / omega
    t = np.linspace(0, 2 * period, 41)
    body = Body("bob", mass, inertia, centroid=(arm, 0.0), angle=amplitude - np.pi / 2)
    seen = Seen(MultibodyModel((body,), (Revolute("O", Marker(GROUND, 0.4, 0.2), Marker("bob")),), gravity=(0, -G)), t)
    angle, rate = swing(amplitude, omega, t)
    near(seen("bob", "angle") + np.pi / 2, angle, rel=1e-6)
    near(seen("bob", "w"), rate, size=omega, rel=1e-6)
    near(seen("bob", "angle")[[20, 40]], seen("bob", "angle")[0], rel=1e-6)
    near(seen("bob", "x"), 0.4 + arm * np.sin(angle), size=1, rel=1e-6)


def test_double_pendulum_against_the_textbook():
    m1, m2, l1, l2 = 1.3, 0.7, 0.5, 0.8

    def rates(_, y):
        a, b, u, v = y
        d, bottom = a - b, 2 * m1 + m2 - m2 * np.cos(2 * a - 2 * b)
        du = -G * (2 * m1 + m2) * np.sin(a) - m2 * G * np.sin(a - 2 * b) - 2 * np.sin(d) * m2 * (v * v * l2 + u * u * l1 * np.cos(d))
        dv = 2 * np.sin(d) * (u * u * l1 * (m1 + m2) + G * (m1 + m2) * np.cos(a) + v * v * l2 * m2 * np.cos(d))
        return u, v, du / l1 / bottom, dv / l2 / bottom

    t, start = np.linspace(0, 2, 21), (1.4, -0.8, 0.5, 2.0)
    book = solve_ivp(rates, (0, 2), start, method="DOP853", rtol=1e-12, atol=1e-13, t_eval=t).y
    bodies = tuple(
        Body(name, m, 0.0, centroid=(l, 0.0), angle=q - np.pi / 2, angular_velocity=w)
        for name, m, l, q, w in (("upper", m1, l1, start[0], start[2]), ("lower", m2, l2, start[1], start[3]))
    )
    pins = Revolute("O", Marker(GROUND), Marker("upper")), Revolute("A", Marker("upper", l1), Marker("lower"))
    seen = Seen(MultibodyModel(bodies, pins, gravity=(0, -G)), t)
    near(seen("upper", "angle") + np.pi / 2, book[0], rel=1e-7)
    near(seen("lower", "w"), book[3], rel=1e-7)


# ------------------------------------------------------------------------------------------------------------------- springs


def damped(t, stiffness, damping, mass, x0, v0):
    """Displacement of m x'' + c x' + k x = 0, underdamped."""
    decay = damping / (2 * mass)
    omega = np.sqrt(stiffness / mass - decay**2)
    return np.exp(-decay * t) * (x0 * np.cos(omega * t) + (v0 + decay * x0) / omega * np.sin(omega * t))


@pytest.mark.parametrize("damping", [0.0, 1.7])
def test_mass_on_a_spring(damping):
    """On a rail at 0.6 rad, stretched by its own weight; the rest length is not that of the start."""
    mass, stiffness, free, slope = 1.5, 240.0, 0.3, 0.6
    rail = np.cos(slope), np.sin(slope)
    model = MultibodyModel(
        (Body("block", mass, 0.01, velocity=(0.4 * rail[0], 0.4 * rail[1])),),
        (Prismatic("rail", Marker("block"), Marker(GROUND), rail),),
        forces=(PointSpring("s", Marker("block"), Marker(GROUND, -0.5 * rail[0], -0.5 * rail[1]), stiffness, free, damping),),
        gravity=(0, -G),
    )
    t = np.linspace(0, 2, 21)
    seen = Seen(model, t)
    rest = free - 0.5 - mass * G * np.sin(slope) / stiffness
    wanted = rest + damped(t, stiffness, damping, mass, -rest, 0.4)
    near(seen("block", "x"), wanted * rail[0])
    near(seen("block", "y"), wanted * rail[1])


@pytest.mark.parametrize("damping", [0.0, 0.05])
def test_two_free_rotors_on_a_rotational_spring(damping):
    j1, j2, stiffness, rest = 0.02, 0.05, 8.0, 0.4
    model = MultibodyModel(
        (Body("one", 1.0, j1, angle=1.0, angular_velocity=3.0), Body("two", 2.0, j2, angular_velocity=-1.0)),
        (),
        forces=(RotationalSpring("s", "one", "two", stiffness, rest, damping),),
    )
    t = np.linspace(0, 1, 21)
    seen = Seen(model, t)
    near(seen("one", "angle") - seen("two", "angle"), rest + damped(t, stiffness, damping, j1 * j2 / (j1 + j2), 1.0 - rest, 4.0))
    near(j1 * seen("one", "w") + j2 * seen("two", "w"), 3 * j1 - j2)


@pytest.mark.parametrize("damping", [0.0, 1.0])
def test_bushing_frequencies(damping):
    mass, inertia, stiffness, twist = 0.8, 0.004, 500.0, 3.0
    joint = Revolute("b", Marker(GROUND, 0.2, 0.1), Marker("block"), Bushing(stiffness, damping, twist, 0.002 * damping))
    model = MultibodyModel((Body("block", mass, inertia, angle=0.3, velocity=(0.5, -0.2), angular_velocity=4.0),), (joint,))
    t = np.linspace(0, 0.7, 21)
    seen = Seen(model, t)
    near(seen("block", "x") - 0.2, damped(t, stiffness, damping, mass, 0, 0.5))
    near(seen("block", "y") - 0.1, damped(t, stiffness, damping, mass, 0, -0.2))
    near(seen("block", "angle") - 0.3, damped(t, twist, 0.002 * damping, inertia, 0, 4.0))


# -------------------------------------------------------------------------------------------------------- wheels and gears


def planetary(sun_teeth, planet_teeth, forces=(), drives=()):
    """Ring fixed; the planet's pin 0.1 m from the axis."""
    ring = sun_teeth + 2 * planet_teeth
    return MultibodyModel(
        (Body("sun", 1.0, 0.003), Body("arm", 0.5, 0.002), Body("planet", 0.4, 0.0005)),
        (
            Revolute("S", Marker(GROUND), Marker("sun")),
            Revolute("C", Marker(GROUND), Marker("arm")),
            Revolute("P", Marker("arm", 0.1), Marker("planet")),
            Gear("sp", "sun", "planet", -sun_teeth / planet_teeth, "arm"),
            Gear("pr", "planet", GROUND, planet_teeth / ring, "arm"),
        ),
        forces,
        drives,
    )


def test_planetary_train_obeys_willis():
    seen = Seen(planetary(18, 27, drives=(JointDrive("S", line(0.0, 12.0)),)), np.linspace(0, 1, 5))
    arm = 12.0 * 18 / (18 + 72)
    near(seen("arm", "w"), arm)
    near(seen("planet", "w"), arm - 18 / 27 * (12.0 - arm))
    near(seen("arm", "angle"), arm * seen.observed.t)


def test_planetary_train_runs_up_with_its_reduced_inertia():
    seen = Seen(planetary(18, 27, forces=(AppliedTorque("m", "sun", LoadCurve(line(0.25, 0.0))),)), np.linspace(0, 1, 5))
    arm = 18 / 90
    planet = arm - 18 / 27 * (1 - arm)
    near(seen("sun", "alpha"), 0.25 / (0.003 + arm**2 * (0.002 + 0.4 * 0.1**2) + planet**2 * 0.0005))


def test_disc_rolls_down_an_incline():
    mass, radius, slope = 3.0, 0.2, -0.5
    axis = np.cos(slope), np.sin(slope)
    wheel = Body("disc", mass, 0.5 * mass * radius**2)
    model = MultibodyModel((wheel,), (Rolling("road", Marker("disc"), Marker(GROUND, 1.0, 2.0), radius, axis),), gravity=(0, -G))
    t = np.linspace(0, 1.5, 7)
    seen = Seen(model, t)
    way = np.hypot(seen("disc", "x") - seen("disc", "x")[0], seen("disc", "y") - seen("disc", "y")[0])
    near(way, 2 / 3 * G * np.sin(0.5) * t**2 / 2)
    near(seen("disc", "angle"), -way / radius)
    above = (seen("disc", "y") - 2.0) * axis[0] - (seen("disc", "x") - 1.0) * axis[1]
    near(above, radius)


def test_pinion_drives_a_rack():
    """The rack runs along its own axis at 30 deg, below the pinion; the torque is what its mass asks for."""
    radius, axis = 0.05, (np.cos(0.52), np.sin(0.52))
    model = MultibodyModel(
        (Body("pinion", 1.0, 0.001), Body("rack", 2.0, 0.01)),
        (
            Revolute("O", Marker(GROUND), Marker("pinion")),
            Prismatic("guide", Marker("rack"), Marker(GROUND, radius * axis[1], -radius * axis[0]), axis),
            Rolling("mesh", Marker("pinion"), Marker("rack"), radius, axis),
        ),
        drives=(JointDrive("O", polynomial(0.0, 2.0, 1.5)),),
        gravity=(0, -G),
    )
    t = np.linspace(0, 1, 6)
    seen = Seen(model, t)
    near(seen("rack", "vx"), radius * (2 + 3 * t) * axis[0])
    near(seen("rack", "vy"), radius * (2 + 3 * t) * axis[1])
    near(seen.torque, 0.001 * 3 + radius * 2.0 * (radius * 3 + G * axis[1]))


@pytest.mark.parametrize("track", [-0.5, 0.3])
def test_disc_rolls_on_a_circle_like_a_pendulum(track):
    """3/2 m d^2 phi'' = -m g d sin phi below in a ring; on a cylinder, turned over, with the gravity turned over as well."""
    radius, mass, phi = 0.1, 2.0, 1.1
    apart = abs(radius + track)
    sense = np.sign(radius + track)
    model = MultibodyModel(
        (Body("arm", 0.0, 0.0, angle=phi - np.pi / 2), Body("disc", mass, 0.5 * mass * radius**2, angle=0.2)),
        (
            Revolute("O", Marker(GROUND), Marker("arm")),
            Revolute("A", Marker("arm", apart), Marker("disc")),
            Rolling("track", Marker("disc"), Marker(GROUND), radius, track_radius=track),
        ),
        gravity=(0, -G),
    )
    t = np.linspace(0, 3, 31)
    seen = Seen(model, t)
    assert "track" in seen.assembly.findings[0]  # the arm holds the distance already
    angle, rate = swing(phi, np.sqrt(2 * G / (3 * apart)), t)
    near(seen("arm", "angle") + np.pi / 2, angle, rel=1e-7)
    near(seen("disc", "w"), sense * apart / radius * rate, rel=1e-7)
    near(seen("disc", "angle") - 0.2, sense * apart / radius * (angle - phi), rel=1e-7)


def test_disc_rolls_in_a_ring_without_an_arm():
    """The centre starts beside the ring's; the assembly finds the track, the energy of the rolling disc stays."""
    radius, track, mass = 0.1, -0.5, 2.0
    model = MultibodyModel(
        (Body("disc", mass, 0.5 * mass * radius**2),),
        (Rolling("track", Marker("disc"), Marker(GROUND, -0.3, 0.2), radius, track_radius=track),),
        gravity=(0, -G),
    )
    seen = Seen(model, np.linspace(0, 2, 21))
    dx, dy = seen("disc", "x") + 0.3, seen("disc", "y") - 0.2
    near(np.hypot(dx, dy), 0.4)
    phi = np.arctan2(dx[0], -dy[0])
    angle, _ = swing(phi, np.sqrt(2 * G / (3 * 0.4)), seen.observed.t)
    near(np.arctan2(dx, -dy), angle, rel=1e-7)


def test_hypocycloid_of_two_to_one_is_a_straight_line():
    """Cardan's circles: a rim point of a wheel in a ring of twice its radius runs on a diameter, many turns long."""
    radius = 0.1
    model = MultibodyModel(
        (Body("arm", 1.0, 0.01), Body("disc", 1.0, 0.01)),
        (
            Revolute("O", Marker(GROUND), Marker("arm")),
            Revolute("A", Marker("arm", radius), Marker("disc")),
            Rolling("track", Marker("disc"), Marker(GROUND), radius, track_radius=-2 * radius),
        ),
        drives=(JointDrive("O", line(0.0, 2 * np.pi)),),
    )
    seen = Seen(model, np.linspace(0, 3, 40))
    angle = seen("disc", "angle")
    near(seen("disc", "y") + radius * np.sin(angle), 0.0, size=radius)
    near(seen("disc", "x") + radius * np.cos(angle), 2 * radius * np.cos(2 * np.pi * seen.observed.t))


# ---------------------------------------------------------------------------------------------------------------------- cams


LIFT = polynomial(0.02, 0.004, 0.003, -0.002, 0.0007, -0.0001)


def lift(x):
    c = np.polynomial.Polynomial(LIFT.coefficients[0])
    return c(x), c.deriv()(x), c.deriv(2)(x)


@pytest.mark.parametrize("axis", [(1.0, 0.0), (0.6, 0.8)])
def test_cam_with_a_sliding_follower(axis):
    mass, inertia, stiffness = 0.7, 0.002, 900.0
    model = MultibodyModel(
        (Body("cam", 1.0, inertia, angle=0.3), Body("follower", mass, 0.01)),
        (
            Revolute("O", Marker(GROUND), Marker("cam")),
            Prismatic("guide", Marker("follower"), Marker(GROUND, 0.1, 0.05), axis),
            CamPair("pair", "cam", Marker("follower"), LIFT, origin=(0.1, 0.05), axis=axis),
        ),
        forces=(PointSpring("s", Marker("follower"), Marker(GROUND, 0.1 - axis[0], 0.05 - axis[1]), stiffness, 0.9),),
        drives=(JointDrive("O", polynomial(0.0, 4.0, 3.0)),),
        gravity=(0, -G),
    )
    t = np.linspace(0, 0.4, 9)
    seen = Seen(model, t)
    s, slope, bend = lift(0.3 + 4 * t + 3 * t**2)
    w = 4 + 6 * t
    acceleration = bend * w**2 + slope * 6
    near(seen("follower", "x"), 0.1 + axis[0] * s)
    near(seen("follower", "vy"), axis[1] * slope * w, size=0.1)
    near(seen("follower", "ax"), axis[0] * acceleration)
    near(seen.torque, inertia * 6 + slope * (mass * (acceleration + G * axis[1]) + stiffness * (1 + s - 0.9)))


def test_cam_with_a_swinging_follower_on_a_turning_carrier():
    """Cam and rocker sit on an arm that turns as well: all counts relative to it."""
    model = MultibodyModel(
        (Body("arm", 1.0, 0.01), Body("cam", 1.0, 0.002, angle=0.3), Body("rocker", 0.7, 0.005, centroid=(0.05, 0.0), angle=0.8)),
        (
            Revolute("O", Marker(GROUND), Marker("arm")),
            Revolute("C", Marker("arm", 0.1), Marker("cam")),
            Revolute("R", Marker("arm", 0.2, 0.05), Marker("rocker")),
            CamPair("pair", "cam", Marker("rocker"), LIFT, carrier="arm"),
        ),
        drives=(JointDrive("O", line(0.0, 2.5)), JointDrive("C", line(0.0, 4.0))),
    )
    t = np.linspace(0, 0.4, 9)
    seen = Seen(model, t)
    sense = np.sign(seen("cam", "w")[0] - 2.5)
    s, slope, bend = lift(0.3 + sense * 4 * t)
    start = lift(0.3)[0]
    near(seen("cam", "w") - 2.5, sense * 4.0)
    near(seen("rocker", "w"), 2.5 + sense * 4 * slope)
    near(seen("rocker", "alpha"), 16 * bend)
    near(seen("rocker", "angle") - 2.5 * t - seen("rocker", "angle")[0], s - start, size=0.01)


# --------------------------------------------------------------------------------------------------------------------- slots


def test_scotch_yoke_is_exactly_sinusoidal():
    r, w, mass = 0.07, 9.0, 1.2
    model = MultibodyModel(
        (Body("crank", 1.0, 0.01, angle=0.4), Body("yoke", mass, 0.01)),
        (
            Revolute("O", Marker(GROUND), Marker("crank")),
            Prismatic("guide", Marker("yoke"), Marker(GROUND)),
            PinSlot("slot", Marker("crank", r), Marker("yoke"), (0.0, 1.0)),
        ),
        drives=(JointDrive("O", line(0.0, w)),),
    )
    t = np.linspace(0, 1, 12)
    seen, angle = Seen(model, t), 0.4 + w * t
    near(seen("yoke", "x"), r * np.cos(angle))
    near(seen("yoke", "vx"), -r * w * np.sin(angle))
    near(seen("yoke", "ax"), -r * w**2 * np.cos(angle))
    near(seen.torque, mass * r**2 * w**2 * np.cos(angle) * np.sin(angle))


@pytest.mark.parametrize("pin_first", [True, False])
def test_slotted_rocker(pin_first):
    """The crank's pin in a slot of the rocker, or a pin of the rocker in a slot of the crank: arg(r e^(i theta) - d) in closed form."""
    r, d, w, inertia = 0.06, 0.1, 5.0, 0.03
    if pin_first:  # z: from the rocker's pivot to the crank's pin
        slot, far = PinSlot("slot", Marker("crank", r), Marker("rocker")), d
        start = np.angle(r * np.exp(0.4j) - d)
    else:  # the slot runs through the crank's pivot: the rocker's pin at distance r from its own pivot
        slot, far = PinSlot("slot", Marker("rocker", r), Marker("crank")), d
        start = 2.0
    model = MultibodyModel(
        (Body("crank", 1.0, 0.01, angle=0.4 if pin_first else np.angle(far + r * np.exp(2j))), Body("rocker", 1.0, inertia, angle=start)),
        (Revolute("O", Marker(GROUND), Marker("crank")), Revolute("B", Marker(GROUND, d), Marker("rocker")), slot),
        drives=(JointDrive("O" if pin_first else "B", line(0.0, w)),),
    )
    t = np.linspace(0, 2, 25)
    seen = Seen(model, t)
    turned = (0.4 if pin_first else 2.0) + w * t
    z, dz, ddz = (-d if pin_first else d) + r * np.exp(1j * turned), 1j * r * w * np.exp(1j * turned), -r * w**2 * np.exp(1j * turned)
    led = "rocker" if pin_first else "crank"
    near(np.exp(1j * seen(led, "angle")), z / abs(z))
    near(seen(led, "w"), (dz / z).imag)
    near(seen(led, "alpha"), (ddz / z - (dz / z) ** 2).imag)


# --------------------------------------------------------------------------------------------------- slides between moving bodies


def bead(bead_first, drives=(), rate=None):
    guide = Prismatic("slide", Marker("bead"), Marker("rod", 0.1)) if bead_first else Prismatic("slide", Marker("rod", 0.1), Marker("bead"))
    return MultibodyModel(
        (Body("rod", 1.0, 0.02, angle=0.3, angular_velocity=rate), Body("bead", 0.5, 0.001, angle=0.3)),
        (Revolute("O", Marker(GROUND), Marker("rod")), guide),
        drives=drives,
    )


@pytest.mark.parametrize("bead_first", [True, False])
def test_bead_on_a_turning_rod(bead_first):
    w, t = 3.0, np.linspace(0, 0.8, 9)
    seen = Seen(bead(bead_first, (JointDrive("O", line(0.0, w)),)), t)
    r, v = 0.1 * np.cosh(w * t), 0.1 * w * np.sinh(w * t)
    near(seen("bead", "x"), r * np.cos(0.3 + w * t))
    near(seen("bead", "y"), r * np.sin(0.3 + w * t))
    near(seen.torque, 2 * 0.5 * r * v * w)


@pytest.mark.parametrize("bead_first", [True, False])
def test_bead_flies_out_on_a_free_rod(bead_first):
    """Angular momentum and energy of both stay."""
    seen = Seen(bead(bead_first, rate=5.0), np.linspace(0, 0.8, 9))
    r2 = seen("bead", "x") ** 2 + seen("bead", "y") ** 2
    near((0.021 + 0.5 * r2) * seen("rod", "w"), (0.021 + 0.5 * 0.01) * 5.0)
    energy = 0.5 * 0.021 * seen("rod", "w") ** 2 + 0.25 * (seen("bead", "vx") ** 2 + seen("bead", "vy") ** 2)
    near(energy, energy[0])
    assert r2[-1] > 4 * r2[0]


@pytest.mark.parametrize("piston_first", [True, False])
def test_driven_cylinder_lifts_a_boom(piston_first):
    """Law of cosines; the cylinder's force by virtual work."""
    a, b, mass, length = 0.6, 0.4, 5.0, np.sqrt(0.6**2 + 0.4**2 - 2 * 0.6 * 0.4 * np.cos(1.0))
    lean = np.angle(b * np.exp(1j) - a)
    ends = (Marker("piston"), Marker("cylinder", length)) if piston_first else (Marker("cylinder"), Marker("piston", -length))
    guide = Prismatic("guide", *ends)
    speed = 0.05 if piston_first else -0.05
    model = MultibodyModel(
        (
            Body("boom", mass, 0.1, centroid=(0.5, 0.0), angle=1.0),
            Body("cylinder", 0.0, 0.0, angle=lean),
            Body("piston", 0.0, 0.0, angle=lean),
        ),
        (
            Revolute("O", Marker(GROUND), Marker("boom")),
            Revolute("C", Marker(GROUND, a), Marker("cylinder")),
            guide,
            Revolute("P", Marker("boom", b), Marker("piston")),
        ),
        drives=(JointDrive("guide", line(0.0, speed)),),
        gravity=(0, -G),
    )
    t = np.linspace(0, 2, 11)
    seen = Seen(model, t)
    reach = length + 0.05 * t
    angle = np.arccos((a**2 + b**2 - reach**2) / (2 * a * b))
    slope = reach / (a * b * np.sin(angle))  # d(angle)/d(reach)
    bend = 1 / (a * b * np.sin(angle)) - slope**2 / np.tan(angle)
    near(seen("boom", "angle"), angle)
    near(seen("boom", "w"), slope * 0.05)
    near(seen("boom", "alpha"), bend * 0.05**2)
    torque = (0.1 + mass * 0.25) * bend * 0.05**2 + mass * G * 0.5 * np.cos(angle)
    near(seen.torque, np.sign(speed) * torque * slope)


@pytest.mark.parametrize("ground_first", [True, False])
def test_driven_slide_against_the_ground(ground_first):
    """The displacement counts for the body that moves, whichever end of the joint it is, and the drive's force with it."""
    ends = (Marker(GROUND, 0.1, 0.2), Marker("block")) if ground_first else (Marker("block"), Marker(GROUND, 0.1, 0.2))
    model = MultibodyModel(
        (Body("block", 2.0, 0.1),), (Prismatic("guide", *ends, (0.6, 0.8)),), drives=(JointDrive("guide", polynomial(0.03, 0.5, 1.0)),)
    )
    t = np.linspace(0, 1, 5)
    seen = Seen(model, t)
    near(seen("block", "x"), 0.1 + 0.6 * (0.03 + 0.5 * t + t**2))
    near(seen("block", "vy"), 0.8 * (0.5 + 2 * t))
    near(seen.torque, 2.0 * 2.0)


# -------------------------------------------------------------------------------------------------------------------- drives


@pytest.mark.parametrize("forward", [True, False])
def test_arm_with_two_driven_joints(forward):
    """The elbow's drive counts for the joint's first body relative to its second."""
    ends = (Marker("fore"), Marker("upper", 0.3)) if forward else (Marker("upper", 0.3), Marker("fore"))
    model = MultibodyModel(
        (Body("upper", 1.0, 0.01, centroid=(0.1, 0), angle=0.2), Body("fore", 0.8, 0.005, centroid=(0.15, 0), angle=0.9)),
        (Revolute("shoulder", Marker(GROUND), Marker("upper")), Revolute("elbow", *ends)),
        drives=(JointDrive("shoulder", line(0.0, 2.0)), JointDrive("elbow", line(0.0, 3.0))),
    )
    t = np.linspace(0, 1, 6)
    seen = Seen(model, t)
    rate = 2.0 + (3.0 if forward else -3.0)
    near(seen("fore", "angle"), 0.9 + rate * t)
    tip = 0.3 * np.exp(1j * (0.2 + 2 * t)) + 0.15 * np.exp(1j * (0.9 + rate * t))
    near(seen("fore", "x") + 1j * seen("fore", "y"), tip)
    pull = 0.3 * 4 * np.exp(1j * (0.2 + 2 * t)) + 0.15 * rate**2 * np.exp(1j * (0.9 + rate * t))
    near(-seen("fore", "ax") - 1j * seen("fore", "ay"), pull)
    arm = 0.15 * np.exp(1j * (0.9 + rate * t))
    near(seen.observed.drives[:, 1], (1 if forward else -1) * 0.8 * (np.conj(arm) * -pull).imag)


def test_driven_joint_between_two_free_bodies_keeps_the_angular_momentum():
    """Both on one axle that floats: the drive only parts them."""
    model = MultibodyModel(
        (Body("one", 1.0, 0.03), Body("two", 2.0, 0.01)),
        (Revolute("axle", Marker("one"), Marker("two")),),
        drives=(JointDrive("axle", polynomial(0.0, 2.0, 1.0)),),
    )
    t = np.linspace(0, 1, 6)
    seen = Seen(model, t)
    near(seen("one", "w") - seen("two", "w"), 2 + 2 * t)
    spin = 0.03 * seen("one", "w") + 0.01 * seen("two", "w")
    near(spin, spin[0], size=0.03)
    near(seen.torque, 2.0 * 0.03 * 0.01 / 0.04)


def test_profile_drive():
    """Dwell, rise by 3-4-5 and dwell, as pieces; the torque is the inertia's alone."""
    rise = 2.0 * np.array([0, 0, 0, 10 / 0.5**3, -15 / 0.5**4, 6 / 0.5**5])
    profile = Curve(np.array([0.0, 0.3, 0.8, 1.0]), np.array([[0.0] * 6, rise, [2.0] + [0.0] * 5]))
    model = MultibodyModel(
        (Body("rotor", 1.0, 0.04, angle=0.1),), (Revolute("O", Marker(GROUND), Marker("rotor")),), drives=(JointDrive("O", profile),)
    )
    t = np.array([0.0, 0.2, 0.4, 0.55, 0.7, 0.9, 1.2])
    seen = Seen(model, t)
    u = np.clip((t - 0.3) / 0.5, 0, 1)
    near(seen("rotor", "angle"), 0.1 + 2 * u**3 * (10 - 15 * u + 6 * u**2))
    near(seen("rotor", "w"), 2 * 30 * u**2 * (1 - u) ** 2 / 0.5)
    near(seen.torque, 0.04 * 2 * 60 * u * (1 - u) * (1 - 2 * u) / 0.25, size=1.0)


def test_periodic_curve_repeats():
    """A torque over the angle of period 1 rad, triangle-shaped, integrated to its energy."""
    saw = Curve(np.array([0.0, 0.5, 1.0]), np.array([[0.0, 2.0, 0, 0, 0, 0], [1.0, -2.0, 0, 0, 0, 0]]), period=1.0)
    model = MultibodyModel(
        (Body("rotor", 1.0, 0.04, angle=-3.0, angular_velocity=6.0),),
        (Revolute("O", Marker(GROUND), Marker("rotor")),),
        forces=(AppliedTorque("m", "rotor", LoadCurve(saw, "angle")),),
    )
    seen = Seen(model, np.linspace(0, 1.5, 40))
    q = seen("rotor", "angle")
    u = q - np.floor(q)
    work = 0.5 * np.floor(q) + np.where(u < 0.5, u**2, 0.5 - (1 - u) ** 2)
    near(0.02 * (seen("rotor", "w") ** 2 - 36), work - work[0], rel=1e-6)
    assert q[-1] > 3


# -------------------------------------------------------------------------------------------------------------------- loads


def rotor(load, **more):
    return MultibodyModel(
        (Body("rotor", 1.0, 0.05, **more),), (Revolute("O", Marker(GROUND), Marker("rotor")),), forces=(AppliedTorque("m", "rotor", load),)
    )


def test_torque_over_time():
    t = np.linspace(0, 2, 9)
    seen = Seen(rotor(LoadCurve(polynomial(0.2, -0.3, 0.0, 0.4))), t)
    near(seen("rotor", "w"), (0.2 * t - 0.15 * t**2 + 0.1 * t**4) / 0.05)


def test_torque_over_angle_is_a_spring():
    t = np.linspace(0, 2, 9)
    near(Seen(rotor(LoadCurve(line(0.0, -0.8), "angle"), angle=0.7), t)("rotor", "angle"), 0.7 * np.cos(4 * t))


def test_motor_runs_up_along_its_curve():
    """J w' = T0 (1 - w/w0)."""
    t = np.linspace(0, 2, 9)
    seen = Seen(rotor(LoadCurve(line(0.6, -0.6 / 30), "speed")), t)
    near(seen("rotor", "w"), 30 * (1 - np.exp(-t * 0.6 / 30 / 0.05)))


def test_torque_between_two_bodies():
    """A motor between two rotors sees their relative speed, and turns both."""
    model = MultibodyModel(
        (Body("stator", 1.0, 0.2), Body("rotor", 1.0, 0.05)),
        (Revolute("axle", Marker("stator"), Marker("rotor")),),
        forces=(AppliedTorque("m", "rotor", LoadCurve(line(0.6, -0.6 / 30), "speed"), on="stator"),),
    )
    t = np.linspace(0, 2, 9)
    seen = Seen(model, t)
    near(seen("rotor", "w") - seen("stator", "w"), 30 * (1 - np.exp(-t * 0.6 / 30 / 0.04)))
    near(0.05 * seen("rotor", "w") + 0.2 * seen("stator", "w"), 0.0, size=1.0)


def test_follower_force_turns_with_the_body_and_a_fixed_one_does_not():
    t = np.linspace(0, 1.5, 16)
    stone = Body("stone", 2.0, 0.3, angle=0.4, angular_velocity=3.0)
    for follows in (True, False):
        seen = Seen(
            MultibodyModel((stone,), (), forces=(AppliedForce("f", Marker("stone"), (3.0, 1.0), LoadCurve(line(1.0, 0.5)), follows),)), t
        )
        wanted = (1 + 0.5 * t) * (3 + 1j) / 2.0 * (np.exp(1j * (0.4 + 3 * t)) if follows else 1.0)
        near(seen("stone", "ax") + 1j * seen("stone", "ay"), wanted)
        near(seen("stone", "w"), 3.0)


def test_follower_force_on_a_lever_is_a_constant_torque_and_a_fixed_one_a_pendulum():
    """The lever's centroid is not where the force is."""

    def lever(follows, direction):
        return MultibodyModel(
            (Body("lever", 1.0, 0.05, centroid=(0.1, 0.05), angle=1.2),),
            (Revolute("O", Marker(GROUND), Marker("lever")),),
            forces=(AppliedForce("f", Marker("lever", 0.4), direction, LoadCurve(line(1.0, 0.0)), follows),),
        )

    t, about = np.linspace(0, 2, 11), 0.05 + 0.1**2 + 0.05**2
    near(Seen(lever(True, (0.0, 0.3)), t)("lever", "w"), 0.12 / about * t)
    near(Seen(lever(False, (0.3, 0.0)), t)("lever", "angle"), swing(1.2, np.sqrt(0.12 / about), t)[0])


def test_a_pin_with_play_between_two_moving_bodies_is_driven():
    """Two bars in line on a dry pin of little play, the second turned against the first: as on an ideal pin, but for the play."""

    def arm(pin):
        bodies = (Body("one", 1.0, 0.02, (0.1, 0.0)), Body("two", 0.5, 0.01, (0.05, 0.0), angle=0.4))
        joints = (Revolute("hub", Marker("one"), Marker(GROUND)), Revolute("elbow", Marker("two"), Marker("one", 0.2), pin))
        drives = (JointDrive("hub", line(0.0, 3.0)), JointDrive("elbow", line(0.0, 2.0)))
        return record(
            simulate(assemble(MultibodyModel(bodies, joints, drives=drives)), 0.2, samples=np.array([0.2])), {"two": Marker("two")}
        )

    ideal, loose = arm(Ideal()), arm(Dry(1e-5, 0.01, 1e8, damping=300.0, exponent=1.0))
    assert loose.point("two", "angle")[-1] == pytest.approx(0.4 + 3.0 * 0.2 + 2.0 * 0.2, rel=1e-9)
    assert loose.point("two", "w")[-1] == pytest.approx(5.0, rel=1e-9)
    for field in ("x", "y"):
        assert loose.point("two", field)[-1] == pytest.approx(ideal.point("two", field)[-1], abs=2e-5)


@pytest.mark.parametrize("form", ["long", "short", "reynolds"])
def test_an_oil_film_brakes_its_journal(form):
    """A journal that turns in the middle of its bearing runs down by Petroff's torque; bearing and journal keep their sum."""
    viscosity, length, radius, clearance, inertia, spin = 0.04, 0.02, 0.01, 5e-5, 1e-4, 100.0
    oil = Lubricated(Dry(clearance, radius, 1e10, length=length), viscosity, form)
    bodies = (Body("bush", 50.0, 2e-4), Body("journal", 0.5, inertia, angular_velocity=spin))
    seen = Seen(MultibodyModel(bodies, (Revolute("pin", Marker("bush"), Marker("journal"), oil),)), np.linspace(0, 0.05, 6))
    drag = 2 * np.pi * viscosity * length * radius**3 / clearance
    near(seen("journal", "w") - seen("bush", "w"), spin * np.exp(-drag * (1 / inertia + 1 / 2e-4) * np.linspace(0, 0.05, 6)), rel=1e-6)
    near(inertia * seen("journal", "w") + 2e-4 * seen("bush", "w"), inertia * spin, rel=1e-9)
