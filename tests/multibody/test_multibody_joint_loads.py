"""What joints with friction transmit, against the equations of all bodies; and how radii turn sliding into rotation."""

import dataclasses

import numpy as np
import pytest
from test_multibody_reactions import CASES, body, cam, states

from drivewright.multibody.assembly import assemble
from drivewright.multibody.forces.joint_friction import JointFriction
from drivewright.multibody.model import (
    GROUND,
    AppliedTorque,
    Body,
    JointDrive,
    LoadCurve,
    Marker,
    MultibodyModel,
    PinSlot,
    Prismatic,
    Revolute,
    Rolling,
    line,
)
from drivewright.multibody.observe import observe
from drivewright.multibody.reactions import reactions
from drivewright.multibody.record import record
from drivewright.multibody.simulate import Settings, simulate

pytestmark = pytest.mark.analytical

G = 9.81
DOWN = (0.0, -G)
ARM, GUIDE = 0.012, 0.05
FRICTIONS = {  # what slides has no lever arm: whichever is given does not count
    Revolute: JointFriction(0.1, 0.15, arm=ARM),
    Prismatic: JointFriction(0.1, 0.15, arm=0.5, guide=GUIDE),
    PinSlot: JointFriction(0.1, 0.15, arm=0.5),
    Rolling: JointFriction(1.0, 1.0, arm=ARM),
}


def yoke():
    """A Scotch yoke: the force of the crank's pin in the slot tilts the yoke in its guide."""
    return MultibodyModel(
        (body("crank", angle=1.3), body("yoke", mass=2.0)),
        (
            Revolute("O", Marker(GROUND), Marker("crank")),
            Prismatic("guide", Marker("yoke"), Marker(GROUND, 0.0, 0.02)),
            PinSlot("slot", Marker("crank", 0.1), Marker("yoke", 0.0, 0.03), axis=(0.1, 1.0)),
        ),
        gravity=(0.7, -G),
    )


def guided(model):
    """The same with a slide in place of the first joint, which has to hold every torque."""
    return dataclasses.replace(model, joints=(Prismatic("base", Marker("frame"), Marker(GROUND), (0.8, 0.6)), *model.joints[1:]))


# No clearance, no bushing, and no constraint twice: the forces of every joint have one solution.
REDUNDANT = ("massless link", "bushing", "free body", "rolling on an arm", "rolling in a ring on an arm")
MODELS = {name: model for name, model in CASES.items() if name not in REDUNDANT}
MODELS |= {"scotch yoke": yoke(), "cam and slide on a slide": guided(cam((0.6, 0.8))), "cam and lever on a slide": guided(cam(None))}


def rubbing(model):
    """A model whose pins, slides, slots and wheels all have friction."""
    joints = tuple(dataclasses.replace(each, friction=FRICTIONS[type(each)]) if type(each) in FRICTIONS else each for each in model.joints)
    return dataclasses.replace(model, joints=joints)


def axes_of(assembly, bodies, observed, n):
    """{body: (place of its origin (2,), axes (2, 2))} at the state n."""
    found = {GROUND: (np.zeros(2), np.eye(2))}
    for each in bodies:
        number = assembly.names.index(each.name)
        x, y, angle = (observed.body(number, field)[n] for field in ("x", "y", "angle"))
        axes = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        found[each.name] = np.array([x, y]) - axes @ each.centroid, axes
    return found


def place_of(marker, axes):
    """A marker's place in the world."""
    origin, turned = axes[marker.body]
    return origin + turned @ [marker.x, marker.y]


def load_of(joint, force, moment, axes):
    """Friction at the coefficient 1 of a joint from its force [N] and moment [N m]."""
    if isinstance(joint, Revolute):
        return ARM * np.hypot(*force)
    along = axes[joint.second.body][1] @ (np.array(joint.axis) / np.hypot(*joint.axis))
    if isinstance(joint, Rolling) and joint.track_radius:
        across = place_of(joint.first, axes) - place_of(joint.second, axes)
        return ARM * abs(force @ across) / np.hypot(*across)
    across = abs(along[0] * force[1] - along[1] * force[0])
    if isinstance(joint, Rolling):
        return ARM * across
    return max(across, 2 * abs(moment) / GUIDE) if isinstance(joint, Prismatic) else across


@pytest.mark.parametrize("name", MODELS)
def test_what_a_joint_transmits_is_what_the_equations_of_all_bodies_need(name):
    """Forces in a tree with loops, from multipliers and partial velocities, against Newton's and Euler's equations of every body."""
    model = rubbing(MODELS[name])
    assembly = assemble(model)
    t, y = states(assembly)
    y[:, assembly.system.frictions.table["sliding"]] = np.resize([1.0, -1.0], len(y))[:, None]
    observed = observe(assembly.system, t, y)
    found = reactions(assembly, assembly.system, observed)
    assert np.max(found.residual) < 2e-11 and np.all(observed.friction(slice(None), "force") != 0.0)
    rub = [joint for joint in model.joints if getattr(joint, "friction", None)]
    assert observed.frictions.shape[1] == len(rub) > 0
    for n in range(len(observed.t)):
        axes = axes_of(assembly, model.bodies, observed, n)
        for number, joint in enumerate(rub):
            reaction = found.joints[joint.name]
            wanted = load_of(joint, reaction.force[n], reaction.moment[n], axes)
            assert observed.friction(number, "load")[n] == pytest.approx(wanted, rel=1e-8), (joint.name, n)
            transmitted = [observed.friction(number, field)[n] for field in ("normal", "tangential")]
            if isinstance(joint, Revolute):
                assert transmitted == pytest.approx(reaction.force[n].tolist(), rel=1e-8, abs=1e-9 * wanted / ARM), (joint.name, n)
            if isinstance(joint, Prismatic):
                assert transmitted[1] == pytest.approx(2 * reaction.moment[n] / GUIDE, rel=1e-8, abs=1e-9 * wanted), (joint.name, n)


def free(joint, speed, **more):
    """A wheel or a rotor of 3 kg in one joint that rubs, turning freely."""
    return MultibodyModel((Body("wheel", 3.0, 0.02, angular_velocity=-speed, **more),), (joint,), gravity=DOWN)


def course(model, duration):
    run = simulate(assemble(model), duration, Settings(per_step=2))
    assert run.outcome == "complete", run.advice
    return record(run, {"wheel": Marker("wheel")})


def test_a_pin_slides_by_its_radius_times_the_rate():
    """J alpha = m g R (mu + (mu_s - mu) exp(-(R w/v_s)^2) + c R w), from 4 v_s down to below v_s."""
    mu, static, slow, viscous, radius = 0.1, 0.3, 0.02, 0.5, 0.05
    pin = JointFriction(mu, static, slow, viscous, arm=radius)
    found = course(free(Revolute("pin", Marker("wheel"), Marker(GROUND), friction=pin), 1.6), 0.13)
    slip = radius * np.abs(found.point("wheel", "w"))
    assert slip[0] > 3.9 * slow and 0.1 * slow < slip[-1] < slow
    wanted = 3.0 * G * radius * (mu + (static - mu) * np.exp(-((slip / slow) ** 2)) + viscous * slip) / 0.02
    np.testing.assert_allclose(found.point("wheel", "alpha"), wanted, rtol=1e-9)


def test_a_wheel_slides_by_its_rolling_speed():
    """(J + m R^2) alpha = e m g (1 + c v), v = R w."""
    arm, viscous, radius, speed = 2e-3, 0.4, 0.1, 1.5
    resistance = JointFriction(1.0, 1.0, viscous=viscous, arm=arm)
    joint = Rolling("track", Marker("wheel"), Marker(GROUND, 0.0, -radius), radius, friction=resistance)
    found = course(free(joint, speed / radius, velocity=(speed, 0.0)), 0.5)
    wanted = arm * 3.0 * G * (1 + viscous * found.point("wheel", "vx")) / (0.02 + 3.0 * radius**2)
    np.testing.assert_allclose(found.point("wheel", "alpha"), wanted, rtol=1e-9)


@pytest.mark.parametrize("radius", [0.05, 0.2])
def test_a_pin_that_holds_gives_way_by_its_presliding_displacement_over_its_radius(radius):
    """Under a torque M that grows slowly it turns by M/(mu_s m g R) d/R."""
    static, give, rate = 0.3, 1e-5, 0.5
    pin = JointFriction(static, static, presliding=give, arm=radius)
    model = free(Revolute("pin", Marker("wheel"), Marker(GROUND), friction=pin), 0.0)
    found = course(dataclasses.replace(model, forces=(AppliedTorque("ramp", "wheel", LoadCurve(line(0.0, rate))),)), 0.5)
    wanted = rate * found.t[-1] / (static * 3.0 * G * radius) * give / radius
    assert found.point("wheel", "angle")[-1] == pytest.approx(wanted, rel=0.02)


@pytest.mark.parametrize(("speed", "share"), [(0.0, 0.0), (2e-4, 1.0), (-2e-4, -1.0), (5e-6, 0.5)])
def test_a_driven_joint_slides_from_a_thousandth_of_stribecks_speed_on(speed, share):
    """A drive takes mu_s m g the way that it goes, at v_s/50 as well; nothing at rest."""
    slide = JointFriction(0.3, 0.3, stribeck_speed=0.01)
    block = MultibodyModel(
        (Body("wheel", 3.0, 0.1),),
        (Prismatic("guide", Marker("wheel"), Marker(GROUND), friction=slide),),
        drives=(JointDrive("guide", line(0.0, speed)),),
        gravity=DOWN,
    )
    found = record(simulate(assemble(block), 0.01), {})
    np.testing.assert_allclose(found.drives[:, 0], share * 0.3 * 3.0 * G, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("sliding", [-1.0, 0.0, 1.0])
def test_the_force_of_friction_in_every_state_of_a_joint(sliding):
    """-m g mu_s (u + tau v/d) - m g c v where it sticks; -+ m g (mu(v) + c |v|) where it slides its way, -+ m g mu_s the other way."""
    mu, static, slow, viscous, give, deflection, relaxation = 0.1, 0.3, 0.02, 0.4, 1e-5, 0.35, 2e-4
    slide = JointFriction(mu, static, slow, viscous, give)
    guide = Prismatic("guide", Marker("block"), Marker(GROUND), friction=slide)
    system = assemble(MultibodyModel((Body("block", 3.0, 0.1),), (guide,), gravity=DOWN)).system
    (table,) = system.frictions.table
    v = np.array([-0.03, -1e-4, 0.0, 1e-4, 0.03])
    y = np.zeros((len(v), 5))
    y[:, 1], y[:, table["sliding"]], y[:, table["deflection"]], y[:, table["relaxation"]] = v, sliding, deflection, relaxation
    observed = observe(system, np.zeros(len(v)), y)
    moving = mu + (static - mu) * np.exp(-((v / slow) ** 2)) + viscous * np.abs(v)
    wanted = (
        sliding * np.where(sliding * v >= 0, moving, static) if sliding else static * (deflection + relaxation * v / give) + viscous * v
    )
    np.testing.assert_allclose(observed.friction(0, "rate"), v, atol=1e-15)
    np.testing.assert_allclose(observed.friction(0, "force"), -3.0 * G * wanted, rtol=1e-12)
    np.testing.assert_allclose(observed.friction(0, "share"), np.abs(wanted) / static, rtol=1e-12)


def test_a_block_that_stops_springs_back_with_critical_damping():
    """d (1 + w s) exp(-w s) are left of its presliding displacement s after the stop, w^2 = mu_s g/d, and it never goes forward again."""
    mu, give, speed = 0.2, 1e-4, 0.05
    guide = Prismatic("guide", Marker("wheel"), Marker(GROUND), friction=JointFriction(mu, mu, presliding=give))
    found = course(MultibodyModel((Body("wheel", 3.0, 0.1, velocity=(speed, 0.0)),), (guide,), gravity=DOWN), 0.1)
    frequency, stop = np.sqrt(mu * G / give), speed / (mu * G)
    after = found.t > stop + 1e-6
    since = frequency * (found.t[after] - stop)
    assert since[-1] > 8 and after.sum() > 10
    left = found.point("wheel", "x")[after] - (speed**2 / (2 * mu * G) - give)
    np.testing.assert_allclose(left, give * (1 + since) * np.exp(-since), atol=2e-3 * give)
    assert np.max(found.point("wheel", "vx")[after]) < 1e-6
