"""Frequencies, damping and shapes of small motions against closed forms."""

import numpy as np
import pytest

from drivewright.errors import InputError
from drivewright.multibody.assembly import assemble
from drivewright.multibody.linearise import linearise, modes
from drivewright.multibody.model import (
    AppliedTorque,
    Body,
    Bushing,
    Dry,
    Friction,
    JointDrive,
    LoadCurve,
    Marker,
    MasslessLink,
    MultibodyModel,
    PointSpring,
    Prismatic,
    Revolute,
    RotationalSpring,
    line,
)
from drivewright.multibody.simulate import Settings, simulate
from drivewright.multibody.statics import equilibrium

pytestmark = pytest.mark.analytical

G = 9.81
TAU = 2 * np.pi
UP, DOWN = (0.0, 1.0), (0.0, -G)


def found_modes(model, **options):
    return modes(linearise(assemble(model), **options))


def pendulum(angle=-1.4, forces=()):
    rod = Body("rod", 2.0, 0.03, (0.3, 0.0), angle=angle)
    return MultibodyModel((rod,), (Revolute("O", Marker("ground"), Marker("rod")),), forces, gravity=DOWN)


def test_a_point_mass_on_a_thread_swings_with_the_root_of_g_over_l():
    model = MultibodyModel(
        (Body("bob", 0.7, 0.0, (0.4, 0.0), angle=-1.0),), (Revolute("O", Marker("ground"), Marker("bob")),), gravity=DOWN
    )
    assert found_modes(model).frequencies == pytest.approx([np.sqrt(G / 0.4) / TAU], rel=1e-9)


def test_a_physical_pendulum_swings_with_its_inertia_about_the_pivot():
    found = found_modes(pendulum())
    assert found.frequencies == pytest.approx([np.sqrt(2.0 * G * 0.3 / (0.03 + 2.0 * 0.3**2)) / TAU], rel=1e-9)
    assert found.ratios == pytest.approx([0.0], abs=1e-9)
    assert found.eigenvalues.imag > 0


def test_a_damped_pendulum_has_the_damping_ratio_of_the_oscillator():
    inertia, stiffness, damping = 0.03 + 2.0 * 0.3**2, 2.0 * G * 0.3, 0.4
    found = found_modes(pendulum(forces=(RotationalSpring("oil", "rod", damping=damping),)))
    assert found.ratios == pytest.approx([damping / (2 * np.sqrt(stiffness * inertia))], rel=1e-8)
    assert found.frequencies == pytest.approx([np.sqrt(stiffness / inertia) / TAU], rel=1e-8)


def test_an_overdamped_one_creeps_back_with_two_real_roots():
    inertia, stiffness, damping = 0.03 + 2.0 * 0.3**2, 2.0 * G * 0.3, 8.0
    found = found_modes(pendulum(forces=(RotationalSpring("oil", "rod", damping=damping),)))
    assert found.eigenvalues == pytest.approx(np.sort(np.roots([inertia, damping, stiffness]))[::-1], rel=1e-7)
    assert found.ratios == pytest.approx([1.0, 1.0])


def test_a_standing_pendulum_falls_with_a_growing_root():
    found = found_modes(pendulum(np.pi / 2))
    rate = np.sqrt(2.0 * G * 0.3 / (0.03 + 2.0 * 0.3**2))
    assert np.sort(found.eigenvalues.real) == pytest.approx([-rate, rate], rel=1e-8)
    assert sorted(found.ratios) == pytest.approx([-1.0, 1.0])


def test_the_double_pendulum_in_closed_form():
    """Equal point masses on equal threads: w^2 = (2 -+ sqrt(2)) g / l, the lower bob going +-sqrt(2) times as far by angle."""
    length = 0.25
    model = MultibodyModel(
        (Body("upper", 1.3, 0.0, (length, 0.0), angle=-1.2), Body("lower", 1.3, 0.0, (length, 0.0), angle=-1.8)),
        (Revolute("O", Marker("ground"), Marker("upper")), Revolute("A", Marker("upper", length), Marker("lower"))),
        gravity=DOWN,
    )
    found = found_modes(model)
    assert found.frequencies == pytest.approx(np.sqrt(np.array([2 - np.sqrt(2), 2 + np.sqrt(2)]) * G / length) / TAU, rel=1e-9)
    turns = found.bodies[:, 1:, 2]
    assert turns[:, 1] / turns[:, 0] == pytest.approx([np.sqrt(2), -np.sqrt(2)], rel=1e-7)


def masses(count=2, k=(300.0, 170.0, 90.0), m=(1.2, 0.7)):
    bodies = tuple(Body(f"m{n}", m[n], 1.0) for n in range(count))
    guides = tuple(Prismatic(f"g{n}", Marker(f"m{n}"), Marker("ground", 0.5 * (n + 1)), (1.0, 0.0)) for n in range(count))
    ends = [Marker("ground"), *(Marker(f"m{n}") for n in range(count)), Marker("ground", 0.5 * (count + 1))]
    springs = tuple(PointSpring(f"s{n}", ends[n], ends[n + 1], k[n], 0.5) for n in range(count + 1))
    return MultibodyModel(bodies, guides, springs)


def test_a_mass_on_a_spring():
    assert found_modes(masses(1)).frequencies == pytest.approx([np.sqrt(470.0 / 1.2) / TAU], rel=1e-9)


def test_two_masses_between_three_springs():
    linear = linearise(assemble(masses()))
    assert linear.names == ("g0.slide", "g1.slide")
    assert linear.mass == pytest.approx(np.diag([1.2, 0.7]))
    assert linear.stiffness == pytest.approx(np.array([[470.0, -170.0], [-170.0, 260.0]]), rel=1e-9)
    assert linear.damping == pytest.approx(0.0, abs=1e-9)
    squares = np.linalg.eigvals(np.linalg.solve(linear.mass, linear.stiffness))
    found = modes(linear)
    assert found.frequencies == pytest.approx(np.sqrt(np.sort(squares)) / TAU, rel=1e-9)
    for root, shape in zip(found.eigenvalues, found.coordinates, strict=True):
        assert (root**2 * linear.mass + linear.stiffness) @ shape == pytest.approx(0.0, abs=1e-5)
    assert np.max(np.abs(found.coordinates / linear.scale), axis=1) == pytest.approx(1.0)


def test_masses_joined_by_a_spring_alone_have_a_mode_that_goes_nowhere_back():
    model = masses()
    found = found_modes(MultibodyModel(model.bodies, model.joints, model.forces[1:2]))
    assert found.frequencies == pytest.approx([0.0, np.sqrt(170.0 * (1 / 1.2 + 1 / 0.7)) / TAU], rel=1e-8)
    assert found.bodies[0, 1, 0] == pytest.approx(found.bodies[0, 2, 0])
    assert found.bodies[1, 1, 0] / found.bodies[1, 2, 0] == pytest.approx(-0.7 / 1.2)


def test_a_coasting_wheel_in_oil_has_a_standing_and_a_decaying_mode():
    model = MultibodyModel(
        (Body("wheel", 2.0, 0.5),), (Revolute("O", Marker("ground"), Marker("wheel")),), (RotationalSpring("oil", "wheel", damping=0.2),)
    )
    found = found_modes(model)
    assert found.eigenvalues == pytest.approx([0.0, -0.4], abs=1e-9)


def test_a_motor_on_a_falling_torque_curve_damps_and_on_a_rising_one_drives():
    for slope in (-0.3, 0.2):
        motor = AppliedTorque("motor", "wheel", LoadCurve(line(0.0, slope), "speed"))
        model = MultibodyModel((Body("wheel", 2.0, 0.5),), (Revolute("O", Marker("ground"), Marker("wheel")),), (motor,))
        linear = linearise(assemble(model))
        assert linear.damping == pytest.approx(np.array([[-slope]]), rel=1e-8)
        assert modes(linear).eigenvalues[-1] == pytest.approx(slope / 0.5, rel=1e-8)


def test_a_bushing_carries_a_body_in_three_directions():
    model = MultibodyModel(
        (Body("block", 2.0, 0.08),), (Revolute("mount", Marker("block"), Marker("ground"), Bushing(800.0, 4.0, 5.0, 0.1)),)
    )
    found = found_modes(model)
    assert found.frequencies == pytest.approx(np.sqrt([5.0 / 0.08, 400.0, 400.0]) / TAU, rel=1e-8)
    assert found.ratios == pytest.approx([0.1 / (2 * np.sqrt(5.0 * 0.08)), *[4.0 / (2 * np.sqrt(1600.0))] * 2], rel=1e-7)


def test_a_rod_resting_in_its_bearing_bounces_on_the_slope_of_the_contact_law():
    """Load N = K d^1.5: stiffness 1.5 N / d along the load; and across, it rolls round in the bearing: a pendulum of two links."""
    pin = Dry(1e-3, 0.02, 1e8, 1.5, 0.0)
    model = MultibodyModel(
        (Body("bob", 2.0, 0.01, angle=-np.pi / 2),), (Revolute("pin", Marker("ground"), Marker("bob"), pin),), gravity=DOWN
    )
    found = found_modes(model)
    depth = (2.0 * G / 1e8) ** (2 / 3)
    assert found.frequencies[-1] == pytest.approx(np.sqrt(1.5 * 2.0 * G / depth / 2.0) / TAU, rel=1e-5)
    assert found.frequencies[-2] == pytest.approx(np.sqrt(G / (1e-3 + depth)) / TAU, rel=1e-5)


def test_friction_in_a_loaded_bearing_damps_with_its_slope_at_no_slip():
    """Torque mu N R tanh(R w / v_d): damping mu N R^2 / v_d of a turn about the bearing's centre."""
    pin = Dry(1e-3, 0.02, 1e8, 1.5, 0.0, friction=Friction("coulomb", 0.1, 0.01))
    model = MultibodyModel(
        (Body("rod", 2.0, 0.01, (0.1, 0.0), angle=-np.pi / 2),), (Revolute("pin", Marker("rod"), Marker("ground"), pin),), gravity=DOWN
    )
    linear = linearise(assemble(model))
    turn = np.array([{"rod.angle": 1.0, "rod.x": 0.1, "rod.y": 0.0}[name] for name in linear.names])
    assert turn @ linear.damping @ turn == pytest.approx(0.1 * 2.0 * G * 0.02**2 / 0.01, rel=1e-5)
    lift = np.array([float(name == "rod.y") for name in linear.names])
    assert lift @ linear.damping @ lift == pytest.approx(0.0, abs=1e-6)


def test_a_massless_link_without_damping_is_a_thread_on_which_the_rod_swings():
    """Rod of a point mass at l on a link of length c: one coordinate has no mass of its own, the thread is l + c long."""
    pin = MasslessLink(0.05, angle=-1.3)
    model = MultibodyModel(
        (Body("bob", 2.0, 0.0, (0.2, 0.0), angle=-1.7),), (Revolute("pin", Marker("ground"), Marker("bob"), pin),), gravity=DOWN
    )
    assert found_modes(model).frequencies == pytest.approx([np.sqrt(G / 0.25) / TAU], rel=1e-8)


def test_a_held_drive_leaves_the_rest_to_swing():
    model = MultibodyModel(
        (Body("crank", 1.0, 0.01), Body("bob", 2.0, 0.0, (0.2, 0.0), angle=-1.0)),
        (Revolute("O", Marker("ground"), Marker("crank")), Revolute("A", Marker("crank", 0.3), Marker("bob"))),
        drives=(JointDrive("O", line(0.4, 50.0)),),
        gravity=DOWN,
    )
    assert found_modes(model, time=0.01).frequencies == pytest.approx([np.sqrt(G / 0.2) / TAU], rel=1e-9)


def governor(speed):
    """A bob on a radial spring in a driven slot."""
    return MultibodyModel(
        (Body("table", 1.0, 0.1), Body("bob", 0.5, 0.0)),
        (Revolute("O", Marker("ground"), Marker("table")), Prismatic("slot", Marker("bob"), Marker("table", 0.1))),
        (PointSpring("s", Marker("bob"), Marker("table"), 400.0, 0.1),),
        (JointDrive("O", line(0.0, speed)),),
    )


def test_a_spinning_bob_on_a_spring_is_softened_by_the_centrifugal_force():
    """m (x'' - w^2 x) = -k (x - l0) for the distance x: rest at k l0 / (k - m w^2), stiffness k - m w^2."""
    speed = 20.0
    assembly = assemble(governor(speed))
    state = assembly.state.copy()
    state[0] = 400.0 * 0.1 / (400.0 - 0.5 * speed**2) - 0.1
    linear = linearise(assembly, state, running=True)
    assert linear.stiffness == pytest.approx(np.array([[400.0 - 0.5 * speed**2]]), rel=1e-9)
    assert modes(linearise(assembly)).frequencies == pytest.approx([np.sqrt(400.0 / 0.5) / TAU], rel=1e-9)


def test_a_freely_spinning_slide_has_coriolis_terms():
    """Free table and bob: L = J w^2/2 + m (x'^2 + x^2 w^2)/2 - k (x - l0)^2/2; about a steady spin the bob's frequency is
    w0^2 = (k - m w^2)/m + 4 m x^2 w^2 / (J + m x^2), the table's angle goes along freely."""
    speed, m, k, J = 15.0, 0.5, 400.0, 0.1
    model = governor(speed)
    assembly = assemble(MultibodyModel(model.bodies, model.joints, model.forces))
    x = k * 0.1 / (k - m * speed**2)
    state = assembly.state.copy()
    names = linearise(assembly).names
    state[[names.index("slot.slide"), 2 + names.index("table.angle")]] = x - 0.1, speed
    found = modes(linearise(assembly, state, running=True))
    square = (k - m * speed**2) / m + 4 * m * x**2 * speed**2 / (J + m * x**2)
    assert found.frequencies[-1] == pytest.approx(np.sqrt(square) / TAU, rel=1e-7)


def test_a_mechanism_with_a_loop_swings_in_a_simulation_as_its_linearisation_says():
    bars = (
        Body("left", 0.4, 1e-3, (0.1, 0.01), angle=-1.5),
        Body("plate", 1.0, 0.02, (0.2, -0.03)),
        Body("right", 0.5, 1e-3, (0.12, 0.0), angle=-1.6),
    )
    pins = (
        Revolute("O", Marker("ground"), Marker("left")),
        Revolute("A", Marker("left", 0.2), Marker("plate")),
        Revolute("B", Marker("plate", 0.35), Marker("right", 0.25)),
        Revolute("C", Marker("right"), Marker("ground", 0.4)),
    )
    assembly = assemble(MultibodyModel(bars, pins, gravity=DOWN))
    rest = equilibrium(assembly)
    frequency = modes(linearise(assembly, rest.state)).frequencies[0]
    state = rest.state.copy()
    state[len(assembly.system.stored)] = 1e-4
    run = simulate(assembly, 1 / frequency, Settings(rtol=1e-10), samples=np.array([0.25, 0.5, 1.0]) / frequency, state=state)
    free = np.searchsorted(assembly.system.stored, assembly.system.independent)[0]
    swing = run.stretches[0].y[:, free] - rest.state[free]
    assert swing == pytest.approx(1e-4 / (TAU * frequency) * np.array([1.0, 0.0, 0.0]), abs=1e-4 / (TAU * frequency) * 1e-4)


def test_a_state_out_of_balance_is_refused_with_the_coordinate_and_the_way_out():
    assembly = assemble(pendulum(0.3))
    with pytest.raises(InputError, match=r"not an equilibrium: at coordinate 'rod.angle'.*equilibrium\(\.\.\.\)"):
        linearise(assembly, assembly.state)


def test_a_mechanism_without_freedom_has_no_modes():
    model = pendulum()
    driven = MultibodyModel(model.bodies, model.joints, drives=(JointDrive("O", line(0.0, 1.0)),), gravity=DOWN)
    assert found_modes(driven).frequencies.shape == (0,)
