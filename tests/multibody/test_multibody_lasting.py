"""Dry pins that stay in contact: what they lose does not depend on how they touched first, and is never negative."""

from dataclasses import replace

import numpy as np
import pytest

from drivewright._jit import plain
from drivewright.contact.impact import cylinder_force, delivered_restitution, impact_law, impact_law_names, lasting_factor
from drivewright.multibody.analyses.wear import with_wear
from drivewright.multibody.assembly import assemble
from drivewright.multibody.forces import pin_contact
from drivewright.multibody.linearise import linearise, modes
from drivewright.multibody.model import GROUND, Body, Dry, Friction, JointDrive, Marker, MultibodyModel, Prismatic, Revolute, line
from drivewright.multibody.observe import observe
from drivewright.multibody.simulate import Settings, simulate
from drivewright.multibody.statics import Place, displaced, reduced_equations
from drivewright.multibody.system import motion

pytestmark = pytest.mark.property

G = 9.81
CRANK, ROD, SPEED = 0.05, 0.12, 5000 * 2 * np.pi / 60
TURN = 2 * np.pi / SPEED
LASTING = pin_contact.LASTING


def ball(dry, velocity=(0.0, 0.0), gravity=0.0, mass=0.5):
    """A free body with a journal in a bearing of the ground."""
    return assemble(
        MultibodyModel(
            (Body("body", mass, 1e-3, velocity=velocity),), (Revolute("pin", Marker(GROUND), Marker("body"), dry),), gravity=(0.0, -gravity)
        )
    )


def slider_crank(clearance, hysteresis, friction=Friction("none")):
    dry = Dry(clearance, 0.01, 6.6102e10 * np.sqrt(5e-4 / clearance), 1.5, hysteresis, friction=friction)
    return assemble(
        MultibodyModel(
            (Body("crank", 1.0, 1e-4), Body("rod", 0.21, 2.5e-4, (ROD / 2, 0.0)), Body("slider", 0.14, 1e-6)),
            (
                Revolute("O", Marker(GROUND), Marker("crank")),
                Revolute("A", Marker("crank", CRANK), Marker("rod")),
                Revolute("wrist", Marker("rod", ROD), Marker("slider"), dry),
                Prismatic("guide", Marker("slider"), Marker(GROUND)),
            ),
            drives=(JointDrive("O", line(0.0, SPEED)),),
        )
    )


def memory_of(system, y):
    return y[..., system.contacts.memory[0]]


# -------------------------------------------------------------------------------------------------------------- single impacts


@pytest.mark.parametrize("asked", [0.05, 0.3, 0.6, 0.9, 0.99])
@pytest.mark.parametrize("law", impact_law_names())
def test_a_single_impact_delivers_what_its_law_says_to_five_digits(law, asked):
    factor, play = impact_law(law).factor(asked), 5e-4
    assembly = ball(Dry(play, 0.01, 6e12, 1.5, factor), (1.2, -0.9))
    found = simulate(assembly, 1.6 * play / 1.5, Settings(rtol=1e-11))
    _, _, y = found.end
    assert memory_of(assembly.system, y) == 0.0 and len(found.impacts) == 1
    assert np.hypot(*y[4:6]) / 1.5 == pytest.approx(delivered_restitution(factor), rel=1e-5)


@pytest.mark.parametrize("method", ["dopri5", pytest.param("radau", marks=pytest.mark.slow)])
@pytest.mark.parametrize("changes", [{}, {"exponent": 1.0, "stiffness": 1e8}, {"cylinder": True, "stiffness": 1e11, "length": 0.02}])
@pytest.mark.parametrize("factor", [0.15, 1.6, 14.4])
def test_a_lasting_contact_that_is_left_free_bounces_with_the_same_restitution(changes, factor, method):
    """It starts at the wall with a speed, and forgets where from: for every elastic law the same equation of restitution."""
    dry = replace(Dry(5e-4, 0.01, 6e10, 1.5, factor), **changes)
    assembly = ball(dry)
    y = assembly.state.copy()
    y[1], y[4], y[6] = -(5e-4 + 1e-14), -0.8, LASTING  # x, its rate, memory
    found = simulate(assembly, 1e-3, Settings(rtol=1e-10 if method == "dopri5" else 1e-9, method=method), state=y)
    _, _, y = found.end
    assert memory_of(assembly.system, y) == 0.0 and len(found.impacts) == 0
    assert y[4] / 0.8 == pytest.approx(delivered_restitution(factor), rel=2e-5 if method == "dopri5" else 2e-4)


@pytest.mark.parametrize("method", ["dopri5", "radau"])
def test_two_pins_that_touch_at_the_same_moment_both_hold(method):
    dry = Dry(5e-4, 0.01, 6e10, 1.5, 0.5)
    assembly = assemble(
        MultibodyModel(
            (Body("plate", 0.5, 1e-3, velocity=(1.5, 0.0)),),
            (
                Revolute("up", Marker(GROUND, 0, 0.1), Marker("plate", 0, 0.1), dry),
                Revolute("down", Marker(GROUND, 0, -0.1), Marker("plate", 0, -0.1), dry),
            ),
        )
    )
    found = simulate(assembly, 1.5 * 5e-4 / 1.5, Settings(rtol=1e-10, method=method))
    assert found.end[2][4] == pytest.approx(-1.5 * delivered_restitution(0.5), rel=1e-4)
    assert sorted(found.impacts[:, 1]) == [0, 1]


# ------------------------------------------------------------------------------------------------------------ lasting contact


@pytest.mark.parametrize("exponent, stiffness", [(1.0, 1e8), (1.5, 6e10), (2.2, 1e14)])
@pytest.mark.parametrize("factor", [0.1, 1.6])
def test_damping_of_small_oscillations_under_a_load(exponent, stiffness, factor):
    """z sqrt((n + 1)/(2 n)), whatever the mass and the load; z = h_w/2 is that of a linear contact of the same restitution."""
    for mass, gravity in ((0.5, G), (20.0, 300.0)):
        assembly = ball(Dry(5e-4, 0.01, stiffness, exponent, factor), gravity=gravity, mass=mass)
        found = modes(linearise(assembly))
        depth = (mass * gravity / stiffness) ** (1 / exponent)
        stiff = np.argmin(np.abs(2 * np.pi * found.frequencies - np.sqrt(exponent * gravity / depth)))
        assert 2 * np.pi * found.frequencies[stiff] == pytest.approx(np.sqrt(exponent * gravity / depth), rel=1e-4)
        assert found.ratios[stiff] == pytest.approx(lasting_factor(factor) / 2 * np.sqrt((exponent + 1) / (2 * exponent)), rel=1e-5)


@pytest.mark.parametrize("clearance, method", [(1e-5, "dopri5"), (1e-5, "radau"), (2e-5, "dopri5")])
def test_the_late_motion_forgets_the_first_touch(clearance, method):
    """The pin never leaves the wall again; the approach speed that it starts with would once have been kept for ever."""
    assembly, turns = slider_crank(clearance, 0.1778), 6 if method == "dopri5" else 3
    settings = Settings(rtol=1e-8, method=method, max_steps=200_000)
    system, t, y = simulate(assembly, 3 * TURN, settings, samples=np.empty(0)).end
    assert memory_of(system, y) == LASTING
    ends = []
    for memory in (LASTING, 1e-2, 1.0, 100.0):
        y[system.contacts.memory[0]] = memory
        found = simulate(replace(assembly, system=system), turns * TURN, settings, state=y, start=t, samples=np.empty(0))
        ends.append(found.end[2])
        assert memory_of(system, found.end[2]) == LASTING
    scale = np.ptp(ends, axis=0) / (np.abs(ends[0]) + 1e-3 * SPEED * CRANK)
    assert np.max(scale[:-1]) < 2e-6


@pytest.mark.parametrize("factor", [0.1778, 1.6, 14.4])
@pytest.mark.parametrize("clearance", [2e-5, 1e-4])
def test_a_contact_loses_energy_always_and_never_pulls(clearance, factor):
    """Its force against its elastic force, times the rate of the depth: at every recorded state, in impacts and in lasting contact."""
    assembly = slider_crank(clearance, factor)
    found = simulate(assembly, 2 * TURN, Settings(rtol=1e-8, per_step=3))
    stiffness, lost, seen = 6.6102e10 * np.sqrt(5e-4 / clearance), [], set()
    for part in found.stretches:
        pins, memory = observe(part.system, part.t, part.y), memory_of(part.system, part.y)
        depth, normal = pins.pin(0, "depth"), pins.pin(0, "normal")
        slider, rod = (
            np.stack([pins.body(k, f) for f in ("x", "y", "vx", "vy", "angle", "w")]) for k in map(assembly.names.index, ("slider", "rod"))
        )
        reach = ROD / 2 * np.exp(1j * rod[4])
        away = rod[0] + 1j * rod[1] + reach - slider[0] - 1j * slider[1]
        apart = rod[2] + 1j * rod[3] + 1j * rod[5] * reach - slider[2] - 1j * slider[3]
        rate = np.real(np.conj(away / np.maximum(abs(away), 1e-12)) * apart)
        elastic = np.where(memory != 0, stiffness * np.maximum(depth, 0) ** 1.5, 0)
        assert np.all(normal >= 0)
        lost.append((normal - elastic) * rate)
        seen |= set(np.sign(memory[depth > 0]))
    lost = np.concatenate(lost)
    assert seen == {-1.0, 1.0}
    assert lost.min() > -1e-9 * lost.max() and lost.max() > 1


@pytest.mark.parametrize("method", ["dopri5", "radau"])
def test_a_bouncing_journal_comes_to_rest(method):
    """Ever smaller bounces, then lasting contact, then stillness: no chattering, and at the depth that carries the weight."""
    assembly = ball(Dry(5e-4, 0.01, 1e8, 1.5, 0.6), gravity=G)
    found = simulate(assembly, 0.5, Settings(rtol=1e-8, method=method))
    assert found.outcome == "complete" and found.steps < 6000
    system, _, y = found.end
    assert memory_of(system, y) == LASTING and len(found.impacts) < 60
    assert -y[list(system.stored).index(assembly.tree.link("body").free + 1)] == pytest.approx(5e-4 + (0.5 * G / 1e8) ** (2 / 3), rel=1e-6)
    assert np.all(np.diff(found.impacts[:, 2]) < 0)


def test_a_slow_touch_under_a_growing_load_is_not_glued():
    """Faster pressed than touched: the force is at most (1 + 2 h) times the elastic one, and continuous at the approach speed."""
    contact = assemble(
        MultibodyModel((Body("body", 0.5, 1e-3),), (Revolute("pin", Marker(GROUND), Marker("body"), Dry(5e-4, 0.01, 1e8, 1.5, 0.8)),))
    ).system.contacts[0]
    normal, elastic = plain(pin_contact.normal_of), 1e8 * 1e-5**1.5
    rates = 1e-4 * np.array([0.5, 1 - 1e-7, 1 + 1e-7, 1.01, 100.0, 1e6])
    factor = [normal(contact, 1e-5, rate, 1e-4, 0.0) / elastic - 1 for rate in rates]
    assert factor[:2] == pytest.approx(0.8 * rates[:2] / 1e-4, rel=1e-9)
    assert factor[2] == pytest.approx(factor[1], rel=1e-6) and factor[3] == pytest.approx(0.8 * 1.01, rel=1e-5)
    assert np.all(np.diff(factor) > 0) and factor[-1] == pytest.approx(1.6, rel=1e-5) and max(factor) < 1.6


def test_a_gap_that_no_force_moves_is_elastic():
    contact = ball(Dry(5e-4, 0.01, 1e8, 1.5, 0.8)).system.contacts[0]
    assert plain(pin_contact.normal_of)(contact, 1e-5, 0.3, LASTING, 0.0) == pytest.approx(1e8 * 1e-5**1.5, rel=1e-12)


def test_the_mass_of_a_lasting_contact_is_that_which_its_force_moves():
    """A pendulum's journal: (J + m l^2)/r^2 at its pin, on which the equivalent damping depends."""
    dry, arm = Dry(5e-4, 0.01, 6e10, 1.5, 0.5), 0.2
    model = MultibodyModel(
        (Body("lever", 1.5, 0.02, (0.1, 0.0)),),
        (Revolute("O", Marker(GROUND), Marker("lever")), Revolute("pin", Marker(GROUND, arm), Marker("lever", arm), dry)),
        gravity=(0.0, -G),
    )
    found = modes(linearise(assemble(model)))
    stiff = np.argmax(found.frequencies)
    assert found.ratios[stiff] == pytest.approx(lasting_factor(0.5) / 2 * np.sqrt(5 / 6), rel=1e-4)


# ------------------------------------------------------------------------------------------- rate and mass of a gap, two routes


def bumps(bins=24):
    angle = 2 * np.pi * np.arange(bins) / bins
    return 1e-5 * (2 + np.sin(3 * angle) + 0.5 * np.cos(angle))


def two_free():
    """Bearing and journal off the centroids of two free bodies that turn."""
    return MultibodyModel(
        (
            Body("ring", 0.8, 2e-3, (0.02, 0.01), angle=0.3, velocity=(0.5, 0.1), angular_velocity=30.0),
            Body("shaft", 0.5, 8e-4, (-0.01, 0.015), angle=-1.0, velocity=(-0.4, 0.9), angular_velocity=-80.0),
        ),
        (Revolute("pin", Marker("ring"), Marker("shaft"), Dry(1e-4, 0.01, 1e9, 1.5, 0.3)),),
    )


def chain():
    """A lever and a rod on it, whose end is a journal in the ground's bearing: a mass matrix that is not diagonal."""
    bodies = (Body("lever", 1.2, 3e-3, (0.04, 0.01), angular_velocity=7.0), Body("rod", 0.7, 2e-3, (0.05, -0.02), angular_velocity=-4.0))
    return MultibodyModel(
        bodies,
        (
            Revolute("O", Marker(GROUND), Marker("lever")),
            Revolute("A", Marker("lever", 0.1), Marker("rod")),
            Revolute("pin", Marker(GROUND, 0.2, 0.01), Marker("rod", 0.1, 0.02), Dry(1e-4, 0.01, 1e9, 1.5, 0.3)),
        ),
    )


@pytest.mark.parametrize("model, aside", [(two_free(), 4e-4), (chain(), 4e-3)], ids=["two free", "chain"])
@pytest.mark.parametrize("worn", [False, True])
def test_rate_and_mass_of_a_gap_are_those_of_its_depth(model, aside, worn):
    """b = d(depth)/d(coordinates) by differences of the depth: d' = b . rates and 1/m = b M^-1 b."""
    assembly = with_wear(assemble(model), 0, bumps()) if worn else assemble(model)
    y = assembly.state.copy()
    y[: len(assembly.system.stored)] += aside * np.array([1.0, -0.6, 0.3, -0.2, 0.7, 0.5])[: len(assembly.system.stored)]
    here = Place(assembly.system, motion(assembly.system).work, 0.0, y)

    def depth(shift):
        place = displaced(here, 0.0, shift)
        reduced_equations(place)
        return plain(pin_contact.penetration)(place.system, place.work, 0)

    free = len(assembly.system.independent)
    slope = np.array([(8 * (depth(h) - depth(-h)) - depth(2 * h) + depth(-2 * h)) / 1.2e-5 for h in 1e-6 * np.eye(free)])
    now = reduced_equations(here)
    found, rate, mobility, *_ = plain(pin_contact.gap_motion)(here.system, 0, here.work, LASTING)
    assert found > 1e-5 and np.min(np.abs(slope)) > 1e-4
    assert rate == pytest.approx(slope @ y[len(assembly.system.stored) :][:free], rel=2e-5)
    assert mobility == pytest.approx(slope @ np.linalg.solve(now.mass, slope), rel=2e-5)


@pytest.mark.parametrize("depth", [2e-5, 1.7e-4])
def test_a_lasting_contact_of_a_cylinder_is_damped_by_the_work_to_its_depth(depth):
    """F = F_el (1 + h_w d'/w), m w^2/2 the work of F_el; also where the depth goes on straight beyond Hertz' theory."""
    dry, mass = Dry(5e-4, 0.01, 1e11, 1.5, 0.5, cylinder=True, length=0.02), 0.7
    contact = ball(dry).system.contacts[0]
    path = np.linspace(0, depth**0.25, 4001) ** 4
    forces = np.array([plain(cylinder_force)(d, 5e-4, 0.01, 0.0095, 1e11, 0.02) for d in path])
    speed = np.sqrt(2 / mass * np.sum(0.5 * (forces[1:] + forces[:-1]) * np.diff(path)))
    for rate in (0.3 * speed, -0.4 * speed):
        exact = forces[-1] * (1 + lasting_factor(0.5) * rate / speed)
        assert plain(pin_contact.normal_of)(contact, depth, rate, LASTING, 1 / mass) == pytest.approx(exact, rel=2e-6)


def test_an_impact_takes_as_much_when_it_parts_faster_than_it_touched():
    """What the rate adds is odd in the rate, beyond the approach speed too."""
    contact, normal, elastic = ball(Dry(5e-4, 0.01, 1e8, 1.5, 0.2)).system.contacts[0], plain(pin_contact.normal_of), 1e8 * 1e-5**1.5
    for rate in (0.5, 1.5, 10.0):
        one, other = (normal(contact, 1e-5, way * rate, 1.0, 0.0) / elastic - 1 for way in (1, -1))
        assert one == pytest.approx(-other, rel=1e-12) and 0.09 < one < 0.4


@pytest.mark.parametrize(
    "friction",
    [Friction("coulomb", 0.1, 0.01), Friction("lugre", 0.1, 0.01, static_coefficient=0.15, bristle_stiffness=1e4, bristle_damping=1.0)],
    ids=lambda friction: friction.law,
)
def test_a_cut_in_lasting_contact_goes_on_as_if_uncut(friction):
    assembly = slider_crank(2e-5, 0.1778, friction)
    whole = simulate(assembly, 1.2 * TURN, Settings(rtol=1e-10))
    part = whole.stretches[0]
    cut = part.t[np.flatnonzero(memory_of(part.system, part.y) == LASTING)[-200]]
    system, t, y = simulate(assembly, cut, Settings(rtol=1e-10)).end
    assert memory_of(system, y) == LASTING
    second = simulate(replace(assembly, system=system), 1.2 * TURN - cut, Settings(rtol=1e-10), state=y, start=t)
    np.testing.assert_allclose(second.end[2], whole.end[2], rtol=1e-6, atol=1e-8)
