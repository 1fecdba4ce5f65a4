"""Equilibrium against potential energy and closed forms; torques that hold a mechanism against virtual work."""

import numpy as np
import pytest
from scipy.optimize import minimize

from drivewright.errors import InputError, SolverError
from drivewright.multibody.assembly import assemble
from drivewright.multibody.model import (
    AppliedForce,
    AppliedTorque,
    Body,
    Curve,
    Dry,
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
from drivewright.multibody.observe import observe
from drivewright.multibody.reactions import reactions
from drivewright.multibody.simulate import work_at_state
from drivewright.multibody.statics import balance, equilibrium, place_at_rest, reduced_equations

pytestmark = pytest.mark.analytical

G = (0.0, -9.81)
CRANK, COUPLER, ROCKER, BASE = 0.1, 0.3, 0.2, 0.35


def pendulum(angle, gravity=G):
    return MultibodyModel(
        (Body("rod", 2.0, 0.03, (0.3, 0.0), angle=angle),), (Revolute("O", Marker("ground"), Marker("rod")),), gravity=gravity
    )


def four_bar(stiffness=400.0):
    return MultibodyModel(
        (
            Body("crank", 0.5, 1e-3, (0.05, 0.0), angle=0.3),
            Body("coupler", 1.0, 0.01, (0.15, 0.05), angle=0.4),
            Body("rocker", 0.8, 5e-3, (0.1, 0.0), angle=1.9),
        ),
        (
            Revolute("O", Marker("ground"), Marker("crank")),
            Revolute("A", Marker("crank", CRANK), Marker("coupler")),
            Revolute("B", Marker("coupler", COUPLER), Marker("rocker", ROCKER)),
            Revolute("C", Marker("rocker"), Marker("ground", BASE)),
        ),
        (
            PointSpring("s", Marker("coupler", 0.1, 0.12), Marker("ground", -0.1, 0.3), stiffness, 0.15, 30.0),
            RotationalSpring("t", "rocker", "crank", 0.7, 1.0),
        ),
        gravity=G,
    )


def energy_of_four_bar(theta, stiffness):
    """Potential energy over the crank's angle, the loop closed by trigonometry."""
    a = CRANK * np.exp(1j * theta)
    diagonal = BASE - a
    d = abs(diagonal)
    at_a = np.arccos((COUPLER**2 + d**2 - ROCKER**2) / (2 * COUPLER * d))
    coupler = np.angle(diagonal) + at_a
    b = a + COUPLER * np.exp(1j * coupler)
    rocker = np.angle(b - BASE)
    heights = 0.5 * (0.5 * a).imag + 1.0 * (a + (0.15 + 0.05j) * np.exp(1j * coupler)).imag + 0.8 * (0.5 * (b - BASE)).imag
    hook = a + (0.1 + 0.12j) * np.exp(1j * coupler)
    stretch = abs(hook - (-0.1 + 0.3j)) - 0.15
    return 9.81 * heights + 0.5 * stiffness * stretch**2 + 0.5 * 0.7 * (rocker - theta - 1.0) ** 2


def angles_of(assembly, state, time=0.0):
    at = place_at_rest(assembly, state, time)
    work = work_at_state(at.system, time, at.y)
    return {name: work.poses.angle[k] for k, name in enumerate(assembly.names)}


@pytest.mark.parametrize("start", [-3.0, -0.1, 0.9, 1.4])
def test_a_pendulum_comes_to_rest_hanging(start):
    assembly = assemble(pendulum(start))
    found = equilibrium(assembly)
    assert np.exp(1j * angles_of(assembly, found.state)["rod"]) == pytest.approx(-1j, abs=1e-9)
    assert found.stable
    assert found.residual < 1e-10


def test_near_to_it_an_unstable_equilibrium_is_found_and_called_so():
    assembly = assemble(pendulum(np.pi / 2 + 0.03))
    found = equilibrium(assembly)
    assert angles_of(assembly, found.state)["rod"] == pytest.approx(np.pi / 2, abs=1e-9)
    assert not found.stable


def test_the_direction_of_gravity_turns_the_equilibrium():
    assembly = assemble(pendulum(0.4, gravity=(3.0, -4.0)))
    assert angles_of(assembly, equilibrium(assembly).state)["rod"] == pytest.approx(np.arctan2(-4.0, 3.0), abs=1e-10)


@pytest.mark.parametrize("stiffness", [40.0, 400.0, 4e4])
def test_a_spring_loaded_four_bar_rests_where_its_energy_is_least(stiffness):
    assembly = assemble(four_bar(stiffness))
    found = equilibrium(assembly)
    theta = angles_of(assembly, found.state)["crank"]
    least = minimize(
        lambda x: energy_of_four_bar(x[0], stiffness),
        [theta + 0.05],
        method="Nelder-Mead",
        options={"xatol": 1e-9, "fatol": 1e-13 * stiffness},
    )
    assert theta == pytest.approx(least.x[0], abs=2e-6)
    assert abs(theta - 0.3) > 0.05
    assert found.stable


def test_the_generalised_force_is_minus_the_slope_of_the_energy():
    assembly = assemble(four_bar())
    here = place_at_rest(assembly, None, 0.0)
    found = reduced_equations(here)
    angle = angles_of(assembly, None)["crank"]
    slope = (energy_of_four_bar(angle + 1e-5, 400.0) - energy_of_four_bar(angle - 1e-5, 400.0)) / 2e-5
    turning = found.motions[assembly.names.index("crank"), 2, 0]
    assert found.force[0] / turning == pytest.approx(-slope, rel=1e-7)


def test_a_lever_balances_where_the_lever_arms_of_the_weights_agree():
    """Neutral: it rests in any position, which is no stable rest; half a gram more on one side and it sinks."""

    def lever(second):
        return MultibodyModel(
            (Body("beam", 0.0, 0.01, angle=0.2),),
            (Revolute("O", Marker("ground"), Marker("beam")),),
            (
                AppliedForce("left", Marker("beam", -0.2), (0.0, -1.0), LoadCurve(line(30.0, 0.0))),
                AppliedForce("right", Marker("beam", 0.6), (0.0, -1.0), LoadCurve(line(second, 0.0))),
            ),
        )

    assembly = assemble(lever(10.0))
    found = equilibrium(assembly)
    assert angles_of(assembly, found.state)["beam"] == pytest.approx(0.2, abs=1e-12)
    assert not found.stable
    assembly = assemble(lever(10.005))
    assert np.exp(1j * angles_of(assembly, equilibrium(assembly).state)["beam"]) == pytest.approx(-1j, abs=1e-8)


def test_a_weight_stretches_its_springs_in_series_and_side_by_side():
    guides = (
        Prismatic("u", Marker("upper"), Marker("ground"), (0.0, 1.0)),
        Prismatic("l", Marker("lower"), Marker("ground", 0.0, -0.6), (0.0, 1.0)),
    )
    springs = (
        PointSpring("a", Marker("upper"), Marker("ground", 0.0, 2.0), 300.0, 1.0),
        PointSpring("b", Marker("upper"), Marker("ground", 0.0, 2.0), 200.0, 1.0),
        PointSpring("c", Marker("lower"), Marker("upper"), 100.0, 0.5),
    )
    assembly = assemble(MultibodyModel((Body("upper", 1.0, 1.0), Body("lower", 2.0, 1.0)), guides, springs, gravity=(0.0, -10.0)))
    found = equilibrium(assembly)
    place = place_at_rest(assembly, found.state, 0.0)
    heights = work_at_state(place.system, 0.0, place.y).poses.y
    upper, lower = heights[assembly.names.index("upper")], heights[assembly.names.index("lower")]
    assert upper == pytest.approx(2.0 - 1.0 - 30.0 / 500.0, abs=1e-9)
    assert upper - lower == pytest.approx(0.5 + 20.0 / 100.0, abs=1e-9)
    assert found.stable


def test_a_block_settles_into_the_wall_of_its_bearing_until_it_carries_the_weight():
    pin = Dry(1e-3, 0.02, 1e8, 1.5, 0.4)
    assembly = assemble(
        MultibodyModel(
            (Body("rod", 2.0, 0.01, (0.1, 0.0), angle=-1.2),),
            (Revolute("pin", Marker("ground"), Marker("rod"), pin),),
            gravity=(0.0, -10.0),
        )
    )
    found = equilibrium(assembly)
    seen = observe(assembly.system, np.zeros(1), found.state[None])
    assert seen.pin(0, "normal") == pytest.approx([20.0], rel=1e-6)
    assert seen.pin(0, "depth") == pytest.approx([(20.0 / 1e8) ** (2 / 3)], rel=1e-6)
    assert seen.body(1, "angle") == pytest.approx([-np.pi / 2], abs=1e-6)


def test_a_massless_link_hangs_along_its_force():
    pin = MasslessLink(1e-3, damping=0.1, angle=0.5)
    assembly = assemble(
        MultibodyModel(
            (Body("rod", 2.0, 0.01, (0.1, 0.0), angle=-1.2),), (Revolute("pin", Marker("ground"), Marker("rod"), pin),), gravity=(3.0, -4.0)
        )
    )
    found = equilibrium(assembly)
    angles = angles_of(assembly, found.state)
    assert [angles["link:pin"], angles["rod"]] == pytest.approx([np.arctan2(-4.0, 3.0)] * 2, abs=1e-8)
    tension = reactions(assembly, assembly.system, observe(assembly.system, np.zeros(1), found.state[None])).tensions["pin"]
    assert tension == pytest.approx([10.0], rel=1e-7)


def slider_crank(curve=line(0.7, 3.0)):
    return MultibodyModel(
        (Body("crank", 0.5, 1e-3, (0.04, 0.01)), Body("rod", 0.8, 2e-3, (0.1, -0.02), angle=-0.2), Body("slider", 1.5, 1e-3)),
        (
            Revolute("O", Marker("ground"), Marker("crank")),
            Revolute("A", Marker("crank", 0.1), Marker("rod")),
            Revolute("B", Marker("rod", 0.35), Marker("slider")),
            Prismatic("guide", Marker("slider"), Marker("ground", 0.0, 0.02)),
        ),
        (AppliedForce("gas", Marker("slider"), (-1.0, 0.0), LoadCurve(line(200.0, 0.0))),),
        (JointDrive("O", curve),),
        gravity=(0.5, -9.81),
    )


def work_of_slider_crank(angle):
    """Potential of the weights and of the gas force over the crank's angle."""
    a = 0.1 * np.exp(1j * angle)
    rod = np.arcsin((0.02 - a.imag) / 0.35)
    slider = a.real + 0.35 * np.cos(rod) + 0.02j
    centroids = ((0.5, (0.04 + 0.01j) * np.exp(1j * angle)), (0.8, a + (0.1 - 0.02j) * np.exp(1j * rod)), (1.5, slider))
    return 200.0 * slider.real - sum(m * (0.5 * z.real - 9.81 * z.imag) for m, z in centroids)


@pytest.mark.parametrize("time", [0.0, 0.3, 1.9])
def test_the_torque_that_holds_a_slider_crank_is_that_of_virtual_work(time):
    """The slope of the potential by differences of the sixth order."""
    angle, h = 0.7 + 3.0 * time, 1e-2
    work = [work_of_slider_crank(angle + k * h) for k in (-3, -2, -1, 1, 2, 3)]
    slope = np.dot([-1, 9, -45, 45, -9, 1], work) / (60 * h)
    assert balance(assemble(slider_crank()), time=time) == pytest.approx([slope], rel=1e-8)


def test_the_gas_torque_of_a_slider_crank_in_closed_form():
    """T = F r sin(a + b) / cos(b), sin(b) = r sin(a) / l with the guide through the crank's centre."""
    model = slider_crank()
    model = MultibodyModel(
        tuple(Body(b.name, angle=b.angle, inertia=1e-3) for b in model.bodies),
        (*model.joints[:3], Prismatic("guide", Marker("slider"), Marker("ground"))),
        model.forces,
        model.drives,
    )
    lean = np.arcsin(0.1 * np.sin(0.7) / 0.35)
    assert balance(assemble(model)) == pytest.approx([-200.0 * 0.1 * np.sin(0.7 + lean) / np.cos(lean)], rel=1e-10)


def test_what_is_free_finds_its_equilibrium_while_the_drive_is_held():
    model = MultibodyModel(
        (Body("crank", 1.0, 0.01, angle=0.4), Body("rod", 2.0, 0.01, (0.2, 0.0), angle=0.1)),
        (Revolute("O", Marker("ground"), Marker("crank")), Revolute("A", Marker("crank", 0.3), Marker("rod"))),
        drives=(JointDrive("O", line(0.0, 5.0)),),
        gravity=(0.0, -10.0),
    )
    assembly = assemble(model)
    found = equilibrium(assembly, time=0.1)
    angles = angles_of(assembly, found.state, 0.1)
    assert angles["crank"] == pytest.approx(0.9)
    assert np.exp(1j * angles["rod"]) == pytest.approx(-1j, abs=1e-9)
    assert balance(assembly, time=0.1) == pytest.approx([2.0 * 10.0 * 0.3 * np.cos(0.9)], rel=1e-9)


def test_two_drives_share_a_load_by_their_places():
    """An arm on an arm, both driven: the outer one carries its own weight's moment, the inner one that of both."""
    model = MultibodyModel(
        (Body("upper", 1.0, 0.01, (0.2, 0.0)), Body("fore", 2.0, 0.01, (0.1, 0.0))),
        (Revolute("shoulder", Marker("ground"), Marker("upper")), Revolute("elbow", Marker("fore"), Marker("upper", 0.4))),
        drives=(JointDrive("elbow", line(0.5, 1.0)), JointDrive("shoulder", line(0.3, 2.0))),
        gravity=(0.0, -10.0),
    )
    elbow = 2.0 * 10.0 * 0.1 * np.cos(0.8)
    shoulder = elbow + 1.0 * 10.0 * 0.2 * np.cos(0.3) + 2.0 * 10.0 * 0.4 * np.cos(0.3)
    assert balance(assemble(model)) == pytest.approx([elbow, shoulder], rel=1e-10)


def test_rates_of_the_state_do_not_count():
    assembly = assemble(pendulum(0.4))
    moving = assembly.state.copy()
    moving[-1] = 50.0
    assert equilibrium(assembly, moving).state == pytest.approx(equilibrium(assembly).state, abs=1e-12)


def test_a_load_that_drives_on_for_ever_has_no_equilibrium_and_the_message_says_where():
    assembly = assemble(
        MultibodyModel(
            (Body("rod", 2.0, 0.03),),
            (Revolute("O", Marker("ground"), Marker("rod")),),
            (AppliedTorque("motor", "rod", LoadCurve(line(3.0, 0.0))),),
        )
    )
    with pytest.raises(SolverError, match=r"no equilibrium.*'rod.angle'.*rad.*add a spring") as caught:
        equilibrium(assembly)
    assert caught.value.partial.shape == assembly.state.shape


def test_a_mechanism_without_a_drive_is_asked_for_its_equilibrium_instead():
    with pytest.raises(InputError, match="no drive.*equilibrium"):
        balance(assemble(pendulum(0.1)))


def test_a_torque_over_the_angle_finds_the_crossing_of_two_curves():
    bend = Curve(np.array([0.0, 1.0]), np.array([[3.0, -4.0, 0.5, 0.0, 0.0, 0.0]]))
    assembly = assemble(
        MultibodyModel(
            (Body("rod", 2.0, 0.03, angle=0.2),),
            (Revolute("O", Marker("ground"), Marker("rod")),),
            (AppliedTorque("motor", "rod", LoadCurve(bend, "angle")),),
        )
    )
    assert angles_of(assembly, equilibrium(assembly).state)["rod"] == pytest.approx(4.0 - np.sqrt(10.0), abs=1e-9)
