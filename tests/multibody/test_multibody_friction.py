"""Friction of ideal joints against closed forms, an independent balance of every body, and exact properties."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import fsolve

from drivewright._jit import plain
from drivewright.errors import InputError
from drivewright.multibody.analyses.energy_audit import audit
from drivewright.multibody.assembly import assemble
from drivewright.multibody.forces.joint_friction import SLIDE, SLOT, JointFriction
from drivewright.multibody.forces.resting_friction import holding_shares, with_loads
from drivewright.multibody.forces.sliding_friction import joint_rate, unit_force
from drivewright.multibody.model import (
    GROUND,
    AppliedForce,
    AppliedTorque,
    Body,
    Curve,
    JointDrive,
    LoadCurve,
    Marker,
    MultibodyModel,
    PinSlot,
    PointSpring,
    Prismatic,
    Revolute,
    Rolling,
    line,
)
from drivewright.multibody.observe import observe
from drivewright.multibody.observed import FRICTION_FIELDS
from drivewright.multibody.reactions import reactions
from drivewright.multibody.record import record
from drivewright.multibody.simulate import Settings, simulate

pytestmark = pytest.mark.analytical

G = 9.81
DOWN = (0.0, -G)


def rub(coefficient, static=None, **more):
    return JointFriction(coefficient, coefficient if static is None else static, **more)


def run_of(model, duration, **settings):
    run = simulate(assemble(model), duration, Settings(per_step=2, **settings))
    assert run.outcome == "complete", run.advice
    return run, record(run, {body.name: Marker(body.name) for body in model.bodies})


def block(friction, velocity=0.0, axis=(1.0, 0.0), mass=2.0, gravity=DOWN, forces=(), **more):
    start = tuple(velocity * each for each in np.array(axis) / np.hypot(*axis))
    return MultibodyModel(
        (Body("block", mass, 0.1, velocity=start),),
        (Prismatic("guide", Marker("block"), Marker(GROUND), axis, friction, **more),),
        forces=forces,
        gravity=gravity,
    )


# ------------------------------------------------------------------------------------------------------------------ slide


@pytest.mark.parametrize("mass", [0.02, 2.0, 200.0])
def test_a_block_stops_after_half_its_speed_squared_over_mu_g(mass):
    """v^2/(2 mu g), from where it springs back by the presliding displacement."""
    _, found = run_of(block(rub(0.2), 1.0, mass=mass), 1.0)
    assert found.point("block", "x").max() == pytest.approx(1 / (2 * 0.2 * G), rel=1e-7)
    assert found.point("block", "x")[-1] == pytest.approx(1 / (2 * 0.2 * G) - 1e-5, rel=1e-6)
    assert abs(found.point("block", "vx")[-1]) < 1e-8


def test_viscous_friction_goes_with_the_speed():
    """m v' = -m g (mu + c v)."""
    mu, c = 0.1, 0.3
    _, found = run_of(block(rub(mu, viscous=c), 1.0), 0.4)
    wanted = (1 + mu / c) * np.exp(-c * G * found.t) - mu / c
    np.testing.assert_allclose(found.point("block", "vx"), wanted, rtol=1e-7)


@pytest.mark.parametrize("slope", [5.0, 11.0])
def test_a_block_rests_on_a_slope_below_the_angle_of_friction(slope):
    """tan(11.31 deg) = 0.2: it begins in balance, and does not stir."""
    angle = np.radians(slope)
    _, found = run_of(block(rub(0.2), axis=(np.cos(angle), np.sin(angle))), 2.0)
    assert np.max(np.hypot(found.point("block", "x"), found.point("block", "y"))) < 1e-11
    assert np.max(np.hypot(found.point("block", "ax"), found.point("block", "ay"))) < 1e-6
    np.testing.assert_allclose(found.frictions[:, 0, 3], np.tan(angle) / 0.2, rtol=1e-6)


def test_a_block_slides_down_a_steeper_slope():
    """s = g (sin - mu cos) t^2/2 from the start; 0.3 at rest holds it no better than 0.2 in motion below Stribeck's speed."""
    angle, mu = np.radians(30.0), 0.2
    _, found = run_of(block(rub(mu), axis=(np.cos(angle), np.sin(angle))), 1.0)
    way = np.hypot(found.point("block", "x"), found.point("block", "y"))
    gain = G * (np.sin(angle) - mu * np.cos(angle))
    assert way[-1] == pytest.approx(0.5 * gain, rel=1e-6)
    slid = np.hypot(found.point("block", "ax"), found.point("block", "ay"))[1:]
    np.testing.assert_allclose(slid, gain, rtol=1e-9)


def test_static_friction_holds_until_the_force_exceeds_it():
    """A force that grows by 10 N/s moves 2 kg at mu_s m g/10, and then they gain (mu_s - mu) g and more."""
    mu, static, rate = 0.1, 0.3, 10.0
    push = AppliedForce("push", Marker("block"), (1.0, 0.0), LoadCurve(line(0.0, rate)))
    _, found = run_of(block(rub(mu, static, stribeck_speed=1e-3), forces=(push,)), 0.8)
    breakaway = static * 2.0 * G / rate
    slides = found.t[np.flatnonzero(found.frictions[:, 0, 4])[0]]
    assert slides == pytest.approx(breakaway, rel=2e-3)
    late = found.t > breakaway + 0.1
    np.testing.assert_allclose(found.point("block", "ax")[late], rate * found.t[late] / 2.0 - mu * G, rtol=1e-6)


def test_stick_slip_of_a_block_on_a_belt():
    """Sticking lasts 2 (mu_s - mu) N/(k V), slipping (2 pi - 2 atan((mu_s - mu) N/(V sqrt(k m))))/w: the textbook's oscillator."""
    mass, k, speed, mu, static = 1.0, 400.0, 0.05, 0.15, 0.25
    model = MultibodyModel(
        (Body("belt", 1.0, 0.1), Body("block", mass, 0.1)),
        (
            Prismatic("roll", Marker("belt"), Marker(GROUND)),
            Prismatic("contact", Marker("block"), Marker("belt"), friction=rub(mu, static, stribeck_speed=1e-5, presliding=1e-7)),
        ),
        forces=(PointSpring("spring", Marker("block"), Marker(GROUND, -1.0, 0.0), k, 1.0),),
        drives=(JointDrive("roll", line(0.0, speed)),),
        gravity=DOWN,
    )
    _, found = run_of(model, 3.0)
    sticks = found.frictions[:, 0, 4] == 0.0
    begins = found.t[1:][sticks[1:] & ~sticks[:-1]]
    ends = found.t[1:][~sticks[1:] & sticks[:-1]]
    ends = ends[ends > begins[1]]
    rise = (static - mu) * mass * G
    stick = 2 * rise / (k * speed)
    slip = 2 * (np.pi - np.arctan(rise / (speed * np.sqrt(k * mass)))) / np.sqrt(k / mass)
    assert np.diff(begins)[1:] == pytest.approx(stick + slip, rel=2e-3)
    assert ends[0] - begins[1] == pytest.approx(stick, rel=2e-3)


def drawer(mu, arm=0.1, guide=0.1, load=10.0):
    """A block in a guide, pushed beside its middle against a load in the middle."""
    return MultibodyModel(
        (Body("block", 1.0, 1e-3), Body("pusher", 0.1, 1e-5)),
        (
            Prismatic("guide", Marker("block"), Marker(GROUND), friction=rub(mu, guide=guide)),
            Prismatic("drive", Marker("pusher"), Marker(GROUND, 0, arm)),
            PinSlot("slot", Marker("pusher"), Marker("block", 0, arm), (0.0, 1.0)),
        ),
        (AppliedForce("load", Marker("block"), (-load, 0.0), LoadCurve(line(1.0, 0.0))),),
        (JointDrive("drive", line(0.0, 0.1)),),
    )


@pytest.mark.parametrize("mu", [0.1, 0.3, 0.49])
def test_a_drawer_takes_its_load_over_one_less_two_mu_arms_over_the_guide(mu):
    assembly = assemble(drawer(mu))
    found = record(simulate(assembly, 0.1), {})
    np.testing.assert_allclose(found.drives[:, 0], 10.0 / (1 - 2 * mu * 0.1 / 0.1), rtol=1e-11)


def test_a_drawer_that_locks_names_joint_place_and_share():
    assembly = assemble(drawer(0.625))
    with pytest.raises(InputError) as error:
        record(simulate(assembly, 0.1), {})
    assert "friction locks the mechanism at t = 0 s, drive 'drive' at 0 mm" in str(error.value)
    assert "joint 'guide' is self-locking" in str(error.value)
    assert "up to 80 % of the given friction" in str(error.value)


def pushed_drawer(pusher):
    """The drawer that locks, pushed by a body of this mass under a force instead of a drive."""
    model = drawer(0.625)
    push = AppliedForce("push", Marker("pusher"), (30.0, 0.0), LoadCurve(line(1.0, 0.0)))
    bodies = (dataclasses.replace(model.bodies[0], velocity=(0.2, 0.0)), dataclasses.replace(model.bodies[1], mass=pusher))
    return simulate(assemble(dataclasses.replace(model, bodies=bodies, drives=(), forces=(*model.forces, push))), 0.1)


def test_a_light_pusher_cannot_hold_a_drawer_in_motion():
    """(m_b - m_p/4) a = -P/4 - load: it stops, and stays."""
    run = pushed_drawer(0.1)
    found = record(run, {"block": Marker("block")})
    assert found.point("block", "ax")[0] == pytest.approx(-(30 / 4 + 10) / (1 - 0.1 / 4), rel=1e-9)
    assert abs(found.point("block", "vx")[-1]) < 1e-9


def test_a_heavy_pusher_locks_it_and_the_run_says_where():
    """Where m_p > 4 m_b the drawer's own friction is pressed on by the deceleration that it makes: no force is in balance."""
    run = pushed_drawer(5.0)
    assert run.outcome == "partial"
    assert "joint 'guide' is self-locking" in run.advice


# ---------------------------------------------------------------------------------------------------------- pins, slots, wheels


def test_a_pendulum_loses_two_arms_of_friction_a_swing():
    """By work: each half period the amplitude falls by 2 mu R/l for small swings (mu R m g (a1 + a2) = m g l (a1^2 - a2^2)/2); the force in
    the pin exceeds the weight by parts of the swing squared."""
    mu, radius, length, start = 0.1, 0.01, 0.5, 0.1
    bob = Body("bob", 1.0, 0.0, (length, 0.0), -np.pi / 2 + start)
    model = MultibodyModel((bob,), (Revolute("pin", Marker(GROUND), Marker("bob"), friction=rub(mu, arm=radius)),), gravity=DOWN)
    _, found = run_of(model, 8.0)
    swing = found.point("bob", "angle") + np.pi / 2
    halves = np.split(np.abs(swing), np.flatnonzero(np.diff(np.sign(swing))) + 1)
    heights = [half.max() for half in halves[:6]]
    np.testing.assert_allclose(-np.diff(heights), 2 * mu * radius / length, rtol=0.01)


def test_the_pin_of_a_slot_rubs_by_the_force_across():
    """A driven pin pushes a slider through a slot at 45 degrees: F = P (cos + mu sin)/(sin - mu cos) by the wedge."""
    mu, angle, load = 0.2, np.radians(45.0), 10.0
    model = MultibodyModel(
        (Body("slider", 1.0, 1e-3), Body("pin", 0.1, 1e-5)),
        (
            Prismatic("up", Marker("slider"), Marker(GROUND), (0.0, 1.0)),
            Prismatic("drive", Marker("pin"), Marker(GROUND)),
            PinSlot("slot", Marker("pin"), Marker("slider"), (np.cos(angle), -np.sin(angle)), rub(mu)),
        ),
        (AppliedForce("load", Marker("slider"), (0.0, -load), LoadCurve(line(1.0, 0.0))),),
        (JointDrive("drive", line(0.0, 0.1)),),
    )
    found = record(simulate(assemble(model), 0.1), {})
    c, s = np.cos(angle), np.sin(angle)
    np.testing.assert_allclose(np.abs(found.drives[:, 0]), load * (s + mu * c) / (c - mu * s), rtol=1e-10)


def wheel(friction, slope=0.0, speed=0.0, radius=0.1, mass=3.0, inertia=0.02):
    axis = (np.cos(slope), np.sin(slope))
    normal = (-axis[1], axis[0])
    body = Body("wheel", mass, inertia, velocity=(speed * axis[0], speed * axis[1]), angular_velocity=-speed / radius)
    return MultibodyModel(
        (body,),
        (Rolling("track", Marker("wheel"), Marker(GROUND, -radius * normal[0], -radius * normal[1]), radius, axis, friction=friction),),
        gravity=DOWN,
    )


def test_a_wheel_rolls_out_under_its_resistance():
    """(m R^2 + J) a = e m g R."""
    arm, radius, mass, inertia = 2e-3, 0.1, 3.0, 0.02
    _, found = run_of(wheel(rub(1.0, arm=arm), speed=1.0), 2.0)
    gain = arm * mass * G * radius / (mass * radius**2 + inertia)
    np.testing.assert_allclose(found.point("wheel", "vx"), 1.0 - gain * found.t, rtol=1e-7)
    np.testing.assert_allclose(found.frictions[:, 0, 5], mass * G, rtol=1e-9)


def test_a_wheel_down_a_slope_holds_on_by_its_inertia():
    """T/N = tan(slope) J/(J + m R^2), N = m g cos(slope)."""
    slope, radius, mass, inertia = np.radians(20.0), 0.1, 3.0, 0.02
    _, found = run_of(wheel(rub(1.0, arm=0.0), slope), 0.5)
    normal, tangential = found.frictions[:, 0, 5], found.frictions[:, 0, 6]
    np.testing.assert_allclose(normal, mass * G * np.cos(slope), rtol=1e-9)
    np.testing.assert_allclose(np.abs(tangential) / normal, np.tan(slope) * inertia / (inertia + mass * radius**2), rtol=1e-8)


# ------------------------------------------------------------------------------------------------------------------ linkages


def slider_crank(mu, torque=LoadCurve(line(1.0, -0.002), "speed"), order=(0, 1, 2, 3), angle=0.3, speed=0.0, guide=0.04):
    """Crank 50 mm, rod 120 mm under a torque; the rod's start angle follows."""
    bodies = (
        Body("crank", 0.3, 1e-4, (0.025, 0.0), angle, angular_velocity=speed),
        Body("rod", 0.21, 2.5e-4, (0.06, 0.0), -np.arcsin(5 / 12 * np.sin(angle))),
        Body("slider", 0.14, 1e-4),
    )
    pin, slide = (rub(mu, arm=0.01), rub(mu, guide=guide)) if mu else (None, None)
    joints = (
        Revolute("main", Marker(GROUND), Marker("crank"), friction=pin),
        Revolute("pin", Marker("crank", 0.05), Marker("rod"), friction=pin),
        Revolute("wrist", Marker("rod", 0.12), Marker("slider", 0.005, 0.002), friction=pin),
        Prismatic("guide", Marker("slider", 0.0, -0.003), Marker(GROUND, 0.0, -0.005), friction=slide),
    )
    return MultibodyModel(bodies, tuple(joints[k] for k in order), (AppliedTorque("m", "crank", torque),), (), DOWN)


@pytest.mark.parametrize("order", [(0, 1, 2, 3), (3, 2, 1, 0), (1, 3, 0, 2), (2, 0, 3, 1)])
def test_friction_is_that_of_the_joints_forces_by_another_route(order):
    """Whichever joints hang bodies in the tree and whichever close the loop: forces from all bodies' equations in absolute coordinates."""
    assembly = assemble(slider_crank(0.2, order=order))
    run, slid = simulate(assembly, 0.1), set()
    for stretch in run.stretches:
        observed = observe(stretch.system, stretch.t, stretch.y)
        forces = reactions(assembly, stretch.system, observed)
        assert forces.residual.max() < 1e-12
        for number, k in enumerate(order):
            joint = forces.joints[("main", "pin", "wrist", "guide")[k]]
            wanted = 0.01 * np.hypot(*joint.force.T)
            if k == 3:
                wanted = np.maximum(np.abs(joint.force[:, 1]), 2 * np.abs(joint.moment) / 0.04)
            np.testing.assert_allclose(observed.friction(number, "load"), wanted, rtol=1e-9, atol=1e-12 * wanted.max())
            sliding, friction = observed.friction(number, "sliding"), observed.friction(number, "force")
            moves = sliding != 0
            np.testing.assert_allclose(friction[moves], -0.2 * sliding[moves] * wanted[moves], rtol=1e-9, atol=1e-12 * wanted.max())
            assert np.all(np.abs(friction) <= 0.2 * wanted * (1 + 1e-6) + 1e-12 * wanted.max())
            slid.update(sliding.tolist())
    assert slid == {-1.0, 0.0, 1.0}


@pytest.mark.property
def test_friction_only_takes_and_the_energy_balances():
    run, found = run_of(slider_crank(0.2), 0.3)
    power = found.powers[:, 3]
    assert power.max() <= 1e-6 * np.abs(power).max()
    assert audit(found).error < 1e-5


@pytest.mark.property
def test_without_coefficient_the_motion_is_the_ideal_one():
    _, plain = run_of(slider_crank(0.0), 0.1)
    _, found = run_of(slider_crank(1e-12), 0.1)
    assert found.point("crank", "angle")[-1] == pytest.approx(plain.point("crank", "angle")[-1], rel=1e-7)


@pytest.mark.property
@pytest.mark.parametrize(("length", "mass", "time"), [(1000.0, 1.0, 1.0), (1.0, 50.0, 1.0), (1.0, 1.0, 0.01)])
def test_units_do_not_matter(length, mass, time):
    """Angles of a drawer-like slider-crank in other units of length, mass and time."""

    def scaled(x):
        return JointFriction(
            x.coefficient,
            x.static_coefficient,
            x.stribeck_speed * length / time,
            x.viscous * time / length,
            x.presliding * length,
            x.arm * length,
            x.guide * length,
        )

    base = slider_crank(0.15)
    bodies = tuple(
        dataclasses.replace(
            body,
            mass=body.mass * mass,
            inertia=body.inertia * mass * length**2,
            centroid=tuple(length * x for x in body.centroid),
            angular_velocity=0.0,
        )
        for body in base.bodies
    )

    def moved(marker):
        return Marker(marker.body, marker.x * length, marker.y * length)

    joints = tuple(
        dataclasses.replace(joint, first=moved(joint.first), second=moved(joint.second), friction=scaled(joint.friction))
        for joint in base.joints
    )
    force = mass * length / time**2
    torque = AppliedTorque("m", "crank", LoadCurve(line(force * length, -0.002 * force * length * time), "speed"))
    other = MultibodyModel(bodies, joints, (torque,), (), (0.0, -G * length / time**2))
    settings = {"rtol": 1e-9}
    _, one = run_of(base, 0.05, **settings)
    run = simulate(assemble(other), 0.05 * time, Settings(per_step=2, rtol=1e-9, atol=1e-12))
    two = record(run, {"crank": Marker("crank")})
    assert two.point("crank", "angle")[-1] == pytest.approx(one.point("crank", "angle")[-1], rel=1e-5)


def test_a_linkage_at_rest_breaks_away_where_its_friction_is_used_up():
    """The crank under a torque that grows slowly from the one that holds the load: it moves where the equilibrium with all joints at their
    limits is passed, which is solved here on its own."""
    mu, rate, angle = 0.3, 0.05, 1.0
    holding, wanted = _torque(0.0, angle), _torque(mu, angle)
    ramp = LoadCurve(Curve(np.array([0.0, 1.0]), np.array([[holding, rate, 0, 0, 0, 0]])), "time")
    load = AppliedForce("load", Marker("slider"), (-20.0, 0.0), LoadCurve(line(1.0, 0.0)))
    model = slider_crank(mu, ramp, angle=angle, guide=0.0)
    model = dataclasses.replace(model, forces=(*model.forces, load), gravity=(0.0, 0.0))
    _, found = run_of(model, 1.1 * (wanted - holding) / rate)
    slides = np.all(found.frictions[:, :, 4] != 0.0, axis=1)
    assert holding + rate * found.t[np.flatnonzero(slides)[0]] == pytest.approx(wanted, rel=5e-3)
    assert wanted > 1.2 * holding


def _torque(mu, angle, radius=0.01, load=20.0):
    """Torque that turns a light slider-crank against a load on its slider, friction of all joints against the motion."""
    tilt = -np.arcsin(5 / 12 * np.sin(angle))
    crank, rod = 0.05 * np.array([np.cos(angle), np.sin(angle)]), 0.12 * np.array([np.cos(tilt), np.sin(tilt)])
    rod_rate = -5 / 12 * np.cos(angle) / np.cos(tilt)  # for one of the crank

    def left(x):
        """Equilibrium of rod, slider and crank under the force (ax, ay) of the crank on the rod, the guide's N and the torque."""
        ax, ay, normal, torque = x
        size = mu * radius * np.hypot(ax, ay)
        at_pin, at_wrist = -size * np.sign(rod_rate - 1.0), -size * np.sign(rod_rate)
        return [
            rod[0] * -ay - rod[1] * -ax + at_pin + at_wrist,
            ax - load + mu * abs(normal),
            ay + normal,
            torque - (crank[0] * ay - crank[1] * ax) - at_pin - size,
        ]

    found, _, code, message = fsolve(left, [load, 0.0, 1.0, 1.0], full_output=True)
    assert code == 1, message
    return found[3]


def test_the_runs_of_an_ensemble_side_by_side_are_those_one_by_one():
    """Eight starts in the lanes of vectors, to the bit."""
    from drivewright import cases

    assembly = assemble(slider_crank(0.2))

    def end(number):
        y = assembly.state.copy()
        y[len(assembly.system.stored)] += 0.1 * number
        return simulate(assembly, 0.02, state=y).end[2]

    together = [row.value for row in cases.run(end, range(4), workers=None).rows]
    for number, found in enumerate(together):
        np.testing.assert_array_equal(found, end(number))


def test_a_unit_force_of_friction_turns_both_bodies_about_their_centroids():
    """Torques of (ux, uy) at the point of the first body, of its opposite there on the second; the rate is their power."""
    rng = np.random.default_rng(4)
    for kind in (SLIDE, SLOT):
        x, y, angle, vx, vy, w = rng.normal(size=(6, 2))
        poses = [SimpleNamespace(x=x[n], y=y[n], c=np.cos(angle[n]), s=np.sin(angle[n]), vx=vx[n], vy=vy[n], w=w[n]) for n in range(2)]
        point, axis = complex(*rng.normal(size=2)), np.exp(1j * rng.normal())
        friction = SimpleNamespace(kind=kind, i=0, j=1, ax=point.real, ay=point.imag, ex=axis.real, ey=axis.imag)
        centres, turned = x + 1j * y, np.exp(1j * angle)
        place, force = centres[0] + turned[0] * point, turned[1] * axis
        torques = [(np.conj(place - centre) * sign * force).imag for centre, sign in zip(centres, (1.0, -1.0), strict=True)]
        work = SimpleNamespace(poses=poses)
        unit = plain(unit_force)(work, friction)
        np.testing.assert_allclose(unit, (force.real, force.imag, *torques), rtol=1e-12)
        rates = [vx[n] + 1j * vy[n] + 1j * w[n] * (place - centres[n]) for n in range(2)]
        wanted = (np.conj(force) * (rates[0] - rates[1])).real
        assert plain(joint_rate)(work, friction, unit) == pytest.approx(wanted, rel=1e-12)


def test_a_linkage_at_rest_stands_still_below_its_break_away_torque():
    """Half way from the torque that holds the load to that which moves it; the four joints share what is held."""
    holding, wanted = _torque(0.0, 1.0), _torque(0.3, 1.0)
    model = slider_crank(0.3, LoadCurve(line(0.5 * (holding + wanted), 0.0)), angle=1.0, guide=0.0)
    load = AppliedForce("load", Marker("slider"), (-20.0, 0.0), LoadCurve(line(1.0, 0.0)))
    run, found = run_of(dataclasses.replace(model, forces=(*model.forces, load), gravity=(0.0, 0.0)), 0.05)
    assert np.ptp(found.point("crank", "angle")) < 1e-12
    shares = found.frictions[0, :, FRICTION_FIELDS.index("share")]
    assert np.all(shares > 1e-4) and np.all(shares < 1.0)
    system = run.end[0]
    piece = system.curves.first[system.torques.curve[0]]
    assert with_loads(system, 3.0).pieces.c0[piece] == pytest.approx(3.0 * system.pieces.c0[piece], rel=1e-12)


def test_what_cannot_hold_slides_from_the_start_as_if_it_had_never_stuck():
    slope = np.radians(30.0)
    _, found = run_of(block(rub(0.3), axis=(np.cos(slope), np.sin(slope))), 0.2)
    wanted = -G * (np.sin(slope) - 0.3 * np.cos(slope))
    np.testing.assert_allclose(np.cos(slope) * found.point("block", "ax") + np.sin(slope) * found.point("block", "ay"), wanted, rtol=1e-6)


def tilted(guide, force=10.0, arm=0.2, mu=0.2, **more):
    """A block in a guide without gravity, pushed beside its middle."""
    push = AppliedForce("push", Marker("block", 0.0, arm), (force, 0.0), LoadCurve(line(1.0, 0.0)))
    return block(rub(mu, guide=guide), gravity=(0.0, 0.0), forces=(push,), **more)


def test_a_tilted_block_moves_only_where_its_guide_is_longer_than_two_mu_arms():
    """Both ends press with F a/L, so that a = F (1 - 2 mu a/L)/m, and whatever the force nothing moves where 2 mu a > L."""
    _, found = run_of(tilted(0.1), 0.2)
    np.testing.assert_allclose(found.point("block", "ax"), 10.0 * (1 - 2 * 0.2 * 0.2 / 0.1) / 2.0, rtol=1e-6)
    for force in (10.0, 1000.0):
        run, found = run_of(tilted(0.07, force), 0.2)
        assert np.max(np.abs(found.point("block", "ax"))) < 1e-9 * force
        shares = [holding_shares(with_loads(run.end[0], factor), *run.end[1:])[0] for factor in (1.0, 2.0)]
        np.testing.assert_allclose(shares, 0.07 / (2 * 0.2 * 0.2), rtol=1e-9)
    run, _ = run_of(block(rub(0.3), forces=(AppliedForce("push", Marker("block"), (2.0, 0.0), LoadCurve(line(1.0, 0.0))),)), 0.1)
    shares = [holding_shares(with_loads(run.end[0], factor), *run.end[1:])[0] for factor in (1.0, 2.0)]
    np.testing.assert_allclose(shares, [2.0 / (0.3 * 2.0 * G), 4.0 / (0.3 * 2.0 * G)], rtol=1e-9)
