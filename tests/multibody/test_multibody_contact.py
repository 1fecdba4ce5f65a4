"""Pins with dry play in the multibody kernel: impacts, momentum, friction's lever arm, energy, exact restart, convergence, a peer."""

import importlib
from dataclasses import replace

import numpy as np
import pytest

from drivewright.contact.impact import delivered_restitution, impact_law, kelvin_voigt_restitution
from drivewright.multibody.assembly import assemble
from drivewright.multibody.model import (
    GROUND,
    Body,
    Dry,
    Friction,
    Ideal,
    JointDrive,
    Marker,
    MultibodyModel,
    PinSlot,
    Prismatic,
    Revolute,
    line,
)
from drivewright.multibody.observe import observe
from drivewright.multibody.simulate import Settings, simulate

pytestmark = pytest.mark.property

G = 9.81


def run(model, duration, rtol=1e-10, **more):
    """(assembly, run) of a motion that is carried through."""
    assembly = assemble(model)
    found = simulate(assembly, duration, Settings(rtol=rtol), **more)
    assert found.outcome == "complete", found.advice
    return assembly, found


def seen_at(found, t):
    """`Observed` at the end, which is t."""
    system, end, y = found.end
    assert end == pytest.approx(t)
    return observe(system, [end], y[None])


# ------------------------------------------------------------------------------------------------------------------- impacts


def journal(dry, mass=0.5, velocity=(1.2, -0.9)):
    """A free body with a journal in a bearing of the ground."""
    return MultibodyModel(
        (Body("body", mass, 1e-3, velocity=velocity),), (Revolute("pin", Marker(GROUND, 0.3, -0.1), Marker("body"), dry),)
    )


def first_bounce(dry, mass, speed, mass2=None):
    """Normal speed after the first impact over that before."""
    way = np.array([0.8, -0.6])
    if mass2 is None:
        model = journal(dry, mass, tuple(speed * way))
    else:
        model = MultibodyModel(
            (Body("ring", mass2, 1.0, velocity=(0.3, 0.2)), Body("pin", mass, 1.0, velocity=tuple((0.3, 0.2) + speed * way))),
            (Revolute("pin", Marker("ring"), Marker("pin"), dry),),
        )
    _, found = run(model, 1.5 * dry.clearance / speed)  # well before the next wall, if the contact is short
    assembly = found.assembly
    assert len(found.impacts) == 1
    assert found.impacts[0, 0] == pytest.approx(dry.clearance / speed, rel=1e-9)
    assert found.impacts[0, 2] == pytest.approx(speed, rel=1e-9)
    seen = seen_at(found, 1.5 * dry.clearance / speed)
    v = {name: np.array([seen.body(k, "vx")[0], seen.body(k, "vy")[0]]) for k, name in enumerate(assembly.names)}
    last, base = ("body", "ground") if mass2 is None else ("pin", "ring")
    after = v[last] - v[base]
    assert abs(after @ (way[1], -way[0])) < 1e-9 * speed
    if mass2 is not None:
        momentum = mass * v["pin"] + mass2 * v["ring"]
        np.testing.assert_allclose(momentum, (mass + mass2) * np.array([0.3, 0.2]) + mass * speed * way, rtol=1e-9)
    assert seen.pin(0, "depth")[0] < 0
    return -after @ way / speed


LAWS = [
    ("flores-2011", 0.9),
    ("flores-2011", 0.5),
    ("lankarani-nikravesh", 0.7),
    ("hunt-crossley", 0.8),
    ("gonthier", 0.6),
    ("herbert-mcwhannell", 0.9),
    ("elastic", 1.0),
]


@pytest.mark.parametrize("law, asked", LAWS)
@pytest.mark.parametrize("mass, speed, stiffness, clearance, radius", [(0.5, 1.5, 6e10, 5e-4, 0.01), (20.0, 0.2, 1e11, 2e-3, 0.05)])
def test_free_impact_delivers_the_restitution_of_its_law(law, asked, mass, speed, stiffness, clearance, radius):
    factor = impact_law(law).factor(asked)
    dry = Dry(clearance, radius, stiffness, 1.5, factor)
    assert first_bounce(dry, mass, speed) == pytest.approx(delivered_restitution(factor), abs=1e-4)


@pytest.mark.parametrize("speed", [1e-5, 1e-6])
def test_a_touch_slower_than_the_slowest_is_told_and_damped_as_that(speed):
    """F = F_el (1 + h d'/1e-4): as if the factor were smaller in the same proportion."""
    dry = Dry(5e-8, 0.01, 6e10, 1.5, 0.8)
    assembly = assemble(journal(dry, velocity=(speed, 0.0)))
    found = simulate(assembly, 1.5 * dry.clearance / speed, Settings(rtol=1e-11, atol=1e-16))
    assert found.impacts[:, 2] == pytest.approx([1e-4], rel=1e-12)
    after = seen_at(found, 1.5 * dry.clearance / speed).body(1, "vx")[0]
    assert -after / speed == pytest.approx(delivered_restitution(0.8 * speed / 1e-4), rel=1e-6)


def test_bristles_are_relaxed_when_a_pin_touches():
    """What is left of a former contact does not count in the next one."""
    assembly = assemble(pair(Dry(5e-4, 0.01, 6e8, 1.5, 0.5, friction=FRICTIONS[3])))
    ends = []
    for left in (0.0, 3e-5):
        y = assembly.state.copy()
        y[assembly.system.contacts.bristle] = left
        ends.append(simulate(assembly, 3e-3, Settings(rtol=1e-10), state=y))
    assert len(ends[0].impacts) > 0
    np.testing.assert_allclose(ends[1].end[2], ends[0].end[2], rtol=1e-7, atol=1e-9)


@pytest.mark.parametrize(
    "changes",
    [{"exponent": 1.0, "stiffness": 1e10}, {"exponent": 2.2, "stiffness": 1e14}, {"cylinder": True, "stiffness": 1e11, "length": 0.02}],
)
def test_restitution_does_not_depend_on_the_elastic_law(changes):
    dry = replace(Dry(5e-4, 0.01, 1e10, 1.5, 0.8), **changes)
    assert first_bounce(dry, 0.5, 1.5) == pytest.approx(delivered_restitution(0.8), abs=1e-4)


def test_restitution_of_kelvin_voigt():
    dry = Dry(5e-4, 0.01, 1e9, 1.0, damping=6000.0)
    assert first_bounce(dry, 0.5, 1.5) == pytest.approx(kelvin_voigt_restitution(6000.0, 1e9, 0.5), abs=1e-4)


@pytest.mark.parametrize("mass2", [0.2, 3.0])
def test_two_free_bodies_keep_their_momentum_and_bounce_alike(mass2):
    dry = Dry(5e-4, 0.01, 6e10, 1.5, 0.5)
    assert first_bounce(dry, 0.5, 1.5, mass2) == pytest.approx(delivered_restitution(0.5), abs=1e-4)


def pair(dry, spin=(30.0, -80.0)):
    """Two free bodies; the bearing and the journal lie off their centroids."""
    return MultibodyModel(
        (
            Body("ring", 0.8, 2e-3, (0.02, 0.01), angle=0.3, velocity=(0.5, 0.1), angular_velocity=spin[0]),
            Body("shaft", 0.5, 8e-4, (-0.01, 0.015), angle=-1.0, velocity=(-0.4, 0.9), angular_velocity=spin[1]),
        ),
        (Revolute("pin", Marker("ring"), Marker("shaft"), dry),),
    )


FRICTIONS = [
    Friction("none"),
    Friction("coulomb", 0.2, 0.01),
    Friction("ambrosio", 0.2, 0.02, dead_speed=0.001),
    Friction("lugre", 0.2, 0.01, static_coefficient=0.3, bristle_stiffness=1e4, bristle_damping=10.0, viscous=0.01),
]


@pytest.mark.parametrize("friction", FRICTIONS, ids=lambda f: f.law)
def test_momentum_and_angular_momentum_of_two_free_bodies(friction):
    """Action and reaction at one point: also the moment about any point stays, through many impacts with friction."""
    model = pair(Dry(3e-4, 0.01, 1e9, 1.5, 0.3, friction=friction))
    assembly, found = run(model, 0.02)
    assert len(found.impacts) > 5
    part = found.stretches[-1]
    seen = observe(part.system, part.t, part.y)
    momentum = moment = energy = 0.0
    for k, name in enumerate(assembly.names[1:], start=1):
        body = next(b for b in model.bodies if b.name == name)
        z, v = (seen.body(k, a) + 1j * seen.body(k, b) for a, b in (("x", "y"), ("vx", "vy")))
        momentum = momentum + body.mass * v
        moment = moment + body.mass * (np.conj(z - 0.2 + 0.4j) * v).imag + body.inertia * seen.body(k, "w")
        energy = energy + 0.5 * body.mass * abs(v) ** 2 + 0.5 * body.inertia * seen.body(k, "w") ** 2
    np.testing.assert_allclose(momentum, momentum[0], rtol=0, atol=1e-9)
    np.testing.assert_allclose(moment, moment[0], rtol=0, atol=1e-9)
    if friction.law != "none":
        assert np.abs(seen.pin(0, "friction")).max() > 10
        assert energy[-1] < 0.999 * energy[0]
        work = seen.pin(0, "friction") * seen.pin(0, "slip")
        assert friction.law == "lugre" or work.min() >= 0


def test_elastic_contact_keeps_the_energy_over_a_hundred_impacts():
    assembly, found = run(pair(Dry(3e-4, 0.01, 1e9), (300.0, -200.0)), 0.1, rtol=1e-11)
    assert len(found.impacts) > 100
    part = found.stretches[-1]
    seen = observe(part.system, part.t, part.y)
    energy = 0.0
    for body in assembly.model.bodies:
        k = assembly.names.index(body.name)
        energy = energy + 0.5 * body.mass * (seen.body(k, "vx") ** 2 + seen.body(k, "vy") ** 2)
        energy = energy + 0.5 * body.inertia * seen.body(k, "w") ** 2
    flight = seen.pin(0, "depth") < 0
    assert np.ptp(energy[flight]) < 1e-7 * energy[0]


# ------------------------------------------------------------------------------------------------------- friction's lever arm


RADIUS, PLAY, STIFFNESS, MASS = 0.01, 5e-4, 1e7, 0.8
MU = 0.25


def effective(friction, slip):
    """Force over normal force in steady sliding, from the laws' texts."""
    v = abs(slip)
    if friction.law == "coulomb":
        return friction.coefficient * np.tanh(v / friction.speed)
    if friction.law == "ambrosio":
        return friction.coefficient * np.clip((v - friction.dead_speed) / (friction.speed - friction.dead_speed), 0, 1)
    g = friction.coefficient + (friction.static_coefficient - friction.coefficient) * np.exp(-((v / friction.speed) ** 2))
    return g + friction.viscous * v


STEADY = [
    Friction("coulomb", MU, 0.05),
    Friction("ambrosio", MU, 0.1, dead_speed=0.01),
    Friction("lugre", MU, 0.1, static_coefficient=0.4, bristle_stiffness=1e4, bristle_damping=10.0, viscous=0.5),
]


@pytest.mark.parametrize("friction", STEADY, ids=lambda f: f.law)
@pytest.mark.parametrize("spin", [6.0, -6.0, 60.0])
@pytest.mark.parametrize("turning", ["journal", "ring"])
def test_spinning_body_rolls_up_the_wall_to_the_friction_angle(friction, spin, turning):
    """In balance there: no acceleration, and the drive's torque is mu N times the radius of contact of the body that turns.

    A journal that turns counter-clockwise climbs on the left of the bearing's bottom, a ring hung on a journal goes to the right.
    """
    ends = (Marker(GROUND), Marker("body")) if turning == "journal" else (Marker("body"), Marker(GROUND))
    dry = Dry(PLAY, RADIUS, STIFFNESS, friction=friction)
    model = MultibodyModel(
        (Body("body", MASS, 1e-4),), (Revolute("pin", *ends, dry),), drives=(JointDrive("pin", line(0.0, spin)),), gravity=(0, -G)
    )
    assembly = assemble(model)
    side, mu, depth = (-1 if turning == "journal" else 1) * np.sign(spin), 0.0, 0.0
    for _ in range(60):  # slip, coefficient and depth hang together
        arm = RADIUS - (PLAY + depth) if turning == "journal" else RADIUS
        mu = effective(friction, spin * arm)
        normal = MASS * G / np.sqrt(1 + mu**2)
        depth = (normal / STIFFNESS) ** (2 / 3)
    angle = np.arctan(mu)
    y = assembly.state.copy()
    y[:2] = (PLAY + depth) * np.array([side * np.sin(angle), -np.cos(angle)])
    contact = assembly.system.contacts[0]
    y[contact.memory] = 1.0
    if friction.law == "lugre":
        slip = (1 if turning == "journal" else -1) * spin * arm  # wall against journal
        y[contact.bristle] = np.sign(slip) * (mu - friction.viscous * abs(slip)) / friction.bristle_stiffness
    seen = observe(assembly.system, [0.0], y[None])
    assert np.hypot(seen.body(1, "ax")[0], seen.body(1, "ay")[0]) < 1e-7 * G
    assert seen.drives[0, 0] == pytest.approx(np.sign(spin) * mu * normal * arm, rel=1e-7)
    assert seen.powers[0, 2] == pytest.approx(-mu * normal * arm * abs(spin), rel=1e-7)


@pytest.mark.parametrize("friction", [STEADY[0], STEADY[1]], ids=lambda f: f.law)
def test_spinning_journal_is_braked_on_the_radius_of_contact(friction):
    """The journal's centre runs in a vertical slot: J w' = -mu N r while it slides fast."""
    inertia = 2e-4
    dry = Dry(PLAY, RADIUS, STIFFNESS, friction=friction)
    model = MultibodyModel(
        (Body("body", MASS, inertia, angular_velocity=200.0),),
        (PinSlot("slot", Marker("body"), Marker(GROUND), (0.0, 1.0)), Revolute("pin", Marker(GROUND), Marker("body"), dry)),
        gravity=(0, -G),
    )
    assembly = assemble(model)
    depth = (MASS * G / STIFFNESS) ** (2 / 3)
    y = assembly.state.copy()
    link = assembly.tree.link("body")
    y[list(assembly.system.stored).index(link.slide)] = -PLAY - depth
    y[assembly.system.contacts[0].memory] = 1.0
    found = simulate(assembly, 0.5, Settings(rtol=1e-10), state=y)
    seen = seen_at(found, 0.5)
    assert seen.body(1, "w")[0] == pytest.approx(200 - MU * MASS * G * (RADIUS - PLAY - depth) / inertia * 0.5, rel=1e-8)


# ---------------------------------------------------------------------------------------------------------- the integration


CRANK, ROD, SPEED = 0.05, 0.12, 5000 * 2 * np.pi / 60
TURN = 2 * np.pi / SPEED


def slider_crank(friction=Friction("none"), clearance=0.5e-3, hysteresis=0.3):
    """The field's benchmark: the play is in the wrist."""
    dry = Dry(clearance, 0.01, 6.6102e10, 1.5, hysteresis, friction=friction) if clearance else Ideal()
    return MultibodyModel(
        (Body("crank", 1.0, 1e-4), Body("rod", 0.21, 2.5e-4, (ROD / 2, 0.0)), Body("slider", 0.14, 1e-6)),
        (
            Revolute("O", Marker(GROUND), Marker("crank")),
            Revolute("A", Marker("crank", CRANK), Marker("rod")),
            Revolute("wrist", Marker("rod", ROD), Marker("slider"), dry),
            Prismatic("guide", Marker("slider"), Marker(GROUND)),
        ),
        drives=(JointDrive("O", line(0.0, SPEED)),),
    )


LUGRE = FRICTIONS[3]


@pytest.mark.parametrize("friction", [Friction("none"), FRICTIONS[1]], ids=lambda f: f.law)
def test_error_shrinks_with_the_tolerance(friction):
    model = slider_crank(friction)
    best = run(model, 0.2 * TURN, 1e-13)[1].end[2]
    tolerances = np.geomspace(1e-7, 1e-11, 9)
    errors = [np.abs(run(model, 0.2 * TURN, rtol)[1].end[2] - best)[:2].max() for rtol in tolerances]
    assert max(errors) < 1e-5
    assert np.polyfit(np.log(tolerances), np.log(errors), 1)[0] == pytest.approx(1.0, abs=0.35)


@pytest.mark.parametrize("friction", [Friction("none"), LUGRE], ids=lambda f: f.law)
@pytest.mark.parametrize("inside", [True, False])
def test_cut_run_goes_on_as_if_uncut(friction, inside):
    """The state carries all there is: speeds of approach and bristles as well."""
    assembly, whole = run(slider_crank(friction), 0.2 * TURN, 1e-11)
    part = whole.stretches[0]
    depth = observe(part.system, part.t, part.y).pin(0, "depth")
    ends = np.flatnonzero((depth > 0) == inside)
    cut = part.t[ends[len(ends) // 2]]
    first = simulate(assembly, cut, Settings(rtol=1e-11))
    system, t, y = first.end
    assert (y[system.contacts[0].memory] > 0) == inside
    second = simulate(replace(assembly, system=system), 0.2 * TURN - cut, Settings(rtol=1e-11), state=y, start=t)
    np.testing.assert_allclose(second.end[2], whole.end[2], rtol=1e-7, atol=1e-9)
    assert len(first.impacts) + len(second.impacts) == len(whole.impacts) > 2


def test_step_limit_gives_what_there_is():
    found = simulate(assemble(slider_crank()), TURN, Settings(max_steps=300))
    assert found.outcome == "partial"
    assert found.steps == 300
    assert "limit of 300 steps" in found.advice
    assert 0 < found.end[1] < TURN
    assert len(found.stretches[0].t) > 250


@pytest.mark.parametrize("per_step", [1, 2])
def test_a_run_ends_where_its_states_fill_the_memory_of_a_run(per_step, monkeypatch):
    monkeypatch.setattr(importlib.import_module("drivewright.multibody.simulate"), "MOST_KEPT", 300)
    assembly = assemble(slider_crank())
    found = simulate(assembly, TURN, Settings(per_step=per_step))
    assert found.outcome == "partial" and "memory limit" in found.advice and "reduce turns" in found.advice
    assert sum(len(part.t) for part in found.stretches) <= 301 and found.steps == 300 // per_step
    assert simulate(assembly, TURN, samples=np.array([TURN])).outcome == "complete"  # only what is kept fills it


def test_two_pins_that_touch_at_the_same_moment():
    """A plate with two equal journals flies straight into two equal bearings: both hold, and it comes back."""
    dry = Dry(5e-4, 0.01, 6e10, 1.5, 0.5)
    model = MultibodyModel(
        (Body("plate", 0.5, 1e-3, velocity=(1.5, 0.0)),),
        (
            Revolute("up", Marker(GROUND, 0, 0.1), Marker("plate", 0, 0.1), dry),
            Revolute("down", Marker(GROUND, 0, -0.1), Marker("plate", 0, -0.1), dry),
        ),
    )
    _, found = run(model, 1.5 * 5e-4 / 1.5)
    seen = seen_at(found, 1.5 * 5e-4 / 1.5)
    assert seen.body(1, "vx")[0] == pytest.approx(-1.5 * delivered_restitution(0.5), rel=1e-4)
    assert sorted(found.impacts[:, 1]) == [0, 1]


def test_start_inside_the_wall_is_held():
    """A state that begins in contact, without a memory of how: the wall pushes back."""
    assembly = assemble(replace(journal(Dry(5e-4, 0.01, 1e8), velocity=(0.0, 0.0)), gravity=(0, -G)))
    y = assembly.state.copy()
    height = assembly.tree.link("body").free + 1
    y[height] -= 5.1e-4
    found = simulate(assembly, 0.1, Settings(rtol=1e-9), state=y)
    assert np.abs(found.stretches[0].y[:, height] + 0.1).max() < 6e-4


def test_second_bearing_of_a_driven_shaft():
    """No freedom, and yet a pin with play: it stays in the middle."""
    model = MultibodyModel(
        (Body("shaft", 1.0, 0.1),),
        (Revolute("A", Marker(GROUND), Marker("shaft")), Revolute("B", Marker(GROUND), Marker("shaft"), Dry(5e-4, 0.01, 1e8))),
        drives=(JointDrive("A", line(0.0, 2.0)),),
    )
    found = simulate(assemble(model), 1.0, samples=np.linspace(0, 1, 5))
    part = found.stretches[0]
    seen = observe(part.system, part.t, part.y)
    np.testing.assert_allclose(seen.body(1, "angle"), 2 * seen.t, atol=1e-15)
    np.testing.assert_allclose(seen.pin(0, "depth"), -5e-4, atol=1e-15)
    np.testing.assert_array_equal(part.y, 0.0)


def test_loaded_pin_approaches_the_ideal_one_in_first_order():
    """A lever that rests in its dry pin, the stiffness scaled so that the depth is a part of the play: the sag over a decade."""
    sags, plays = [], np.array([3e-5, 1e-4, 3e-4])
    for play in plays:
        stiffness = 5.0 / (0.1 * play) ** 1.5
        dry = Dry(play, 0.01, stiffness, damping=60.0 * np.sqrt(1e-4 / play))
        model = MultibodyModel(
            (Body("lever", 1.0, 0.01, (0.15, 0.0)), Body("prop", 1.0, 0.01)),
            (
                Revolute("O", Marker(GROUND), Marker("lever")),
                Revolute("P", Marker(GROUND, 0.3), Marker("prop")),
                Revolute("pin", Marker("prop"), Marker("lever", 0.3), dry),
            ),
            drives=(JointDrive("P", line(0.0, 0.3)),),
            gravity=(0, -G),
        )
        assembly, found = run(model, 0.5, 1e-8)
        sags.append(-seen_at(found, 0.5).body(assembly.names.index("lever"), "angle")[0])
    assert np.polyfit(np.log(plays), np.log(sags), 1)[0] == pytest.approx(1.0, abs=0.1)
    assert sags[1] * 0.3 == pytest.approx(1.1e-4, rel=0.05)


@pytest.mark.needs_peers
def test_exudyn_comes_nearer_with_its_step():
    """0.1 and 0.2 turn from the slider 0.1 mm off the bearing's centre."""
    from drivewright.oracles.linkage import exudyn_model

    model = slider_crank(hysteresis=0.15)
    assembly = assemble(model)
    y = assembly.state.copy()
    y[list(assembly.system.stored).index(assembly.tree.link("slider").slide)] -= 1e-4
    start = observe(assembly.system, [0.0], y[None]).bodies[0]
    poses = {name: tuple(start[k, :6]) for k, name in enumerate(assembly.names) if k}
    for part, bound in ((0.1, 1e-5), (0.2, 6e-5)):
        found = simulate(assembly, part * TURN, Settings(rtol=1e-10), state=y)
        mine = seen_at(found, part * TURN).body(assembly.names.index("slider"), "x")[0]
        misses = [abs(exudyn_model.run(model, poses, part * TURN, step).bodies["slider"][-1, 0] - mine) for step in (1e-6, 2e-7)]
        assert misses[1] < 0.4 * misses[0] < bound


@pytest.mark.slow  # its kernel is one of its own
def test_steps_of_one_size_meet_the_adaptive_run():
    """The first bounces of a journal in a bearing, by rk4 and by dopri5."""
    dry = Dry(1e-4, 0.02, 5e8, hysteresis=impact_law("flores-2011").factor(0.8))
    ready = assemble(journal(dry))
    runs = [simulate(ready, 1e-3, settings) for settings in (Settings(rtol=1e-11), Settings(method="rk4", max_step=1e-7))]
    assert [run.outcome for run in runs] == ["complete"] * 2 and len(runs[0].impacts) == len(runs[1].impacts) > 0
    np.testing.assert_allclose(runs[1].end[2], runs[0].end[2], rtol=1e-6, atol=1e-9)
