"""The multibody twin in Exudyn against references that share nothing with it: closed forms, a loop, two equations for scipy."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from drivewright.errors import InputError
from drivewright.multibody.model import (
    GROUND,
    AppliedForce,
    AppliedTorque,
    Body,
    Curve,
    Dry,
    Friction,
    Gear,
    JointDrive,
    LoadCurve,
    Marker,
    MasslessLink,
    MultibodyModel,
    PinSlot,
    PointSpring,
    Prismatic,
    Revolute,
    RotationalSpring,
    line,
)
from drivewright.oracles.linkage.four_bar_closed_form import COUPLER, COUPLER_TURN, ROCKER, ROCKER_TURN, FourBar, ideal_motion

pytestmark = [pytest.mark.property, pytest.mark.needs_peers]
SPEED = 5000 * 2 * np.pi / 60
TURN = 2 * np.pi / SPEED
CRANK, ROD, ROD_MASS, ROD_INERTIA, SLIDER_MASS = 0.05, 0.12, 0.21, 2.5e-4, 0.14
CLEARANCE, RADIUS, STIFFNESS = 0.5e-3, 0.01, 6.6102e10


def exudyn_model():
    from drivewright.oracles.linkage import exudyn_model

    return exudyn_model


# -- smooth motion -----------------------------------------------------------------------------------------------------------


def test_ideal_four_bar():
    """A third of a turn of the folder's bar, positions and rates of coupler and rocker by the loop."""
    bar = FourBar(np.array([0.484, 0.066, 0.158, 0.424]), np.ones(3), np.ones(2), np.array([0.0, 0.079, 0.243]), np.zeros(4))

    def poses(crank, speed):
        (e2, e3, e4), v, _ = (part[..., 0] for part in ideal_motion(bar, np.array([crank])))
        places = {"crank": 0j, "coupler": 0.066 * e2 + 0.079 * e3, "rocker": 0.484 - 0.243 * e4}
        angles = dict(zip(places, np.angle([e2, e3, -e4]), strict=True))
        rates = {"crank": (0j, 1.0), "coupler": (v[COUPLER], v[COUPLER_TURN].real), "rocker": (v[ROCKER], v[ROCKER_TURN].real)}
        return {
            name: (z.real, z.imag, angles[name], rates[name][0].real * speed, rates[name][0].imag * speed, rates[name][1] * speed)
            for name, z in places.items()
        }

    model = MultibodyModel(
        bodies=(Body("crank", 1.0, 1e-3), Body("coupler", 1.113, 2316e-6, (0.079, 0.0)), Body("rocker", 6.883, 0.0423, (0.243, 0.0))),
        joints=(
            Revolute("O2", Marker(GROUND), Marker("crank")),
            Revolute("A", Marker("crank", 0.066), Marker("coupler")),
            Revolute("B", Marker("coupler", 0.158), Marker("rocker", 0.424)),
            Revolute("O4", Marker("rocker"), Marker(GROUND, 0.484)),
        ),
        drives=(JointDrive("O2", line(0.3, 50.0)),),
        gravity=(0.0, -9.81),
    )
    duration = 2 * np.pi / 3 / 50
    run = exudyn_model().run(model, poses(0.3, 50.0), duration, 1e-5, samples=10)
    assert run.time[-1] == pytest.approx(duration, rel=1e-12) and run.time.size == 11
    for name, expected in poses(0.3 + 2 * np.pi / 3, 50.0).items():
        size = 50.0 * np.array([0.02, 0.02, 1, 1, 1, 50]) / 50
        assert np.abs(run.bodies[name][-1] - expected)[:3] == pytest.approx(np.zeros(3), abs=1e-6 * size[2])
        assert np.abs(run.bodies[name][-1] - expected)[3:] == pytest.approx(np.zeros(3), abs=1e-5 * size[5])


def test_spring_damper_and_force_on_a_slide():
    """x'' = (F - k (x - x0) - c x')/m along an axis at 30 degrees, from rest."""
    along = np.exp(1j * np.pi / 6)
    forces = (
        PointSpring("s", Marker("slide", 0.01, 0.0), Marker(GROUND, -along.real, -along.imag), 80.0, 0.9, 1.5),
        AppliedForce("f", Marker("slide"), (along.real, along.imag), LoadCurve(line(3.0, 0.0))),
    )
    model = MultibodyModel(
        (Body("slide", 0.5, 1e-3, (0.01, 0.0)),),
        (Prismatic("guide", Marker("slide", 0.01, 0.0), Marker(GROUND), (along.real, along.imag)),),
        forces,
    )
    run = exudyn_model().run(model, {"slide": (0, 0, 0.2, 0, 0, 0)}, 0.3, 1e-4)
    rest, decay = (3.0 - 80.0 * 0.1) / 80.0, 1.5 / (2 * 0.5)
    omega = np.sqrt(80.0 / 0.5 - decay**2)
    x = rest - rest * np.exp(-decay * run.time) * (np.cos(omega * run.time) + decay / omega * np.sin(omega * run.time))
    assert run.bodies["slide"][:, :2] @ [along.real, along.imag] == pytest.approx(x, abs=1e-7)
    assert np.ptp(run.bodies["slide"][:, 2]) < 1e-12


def test_torque_and_rotational_spring_on_a_pin():
    """J phi'' = T - k (phi - rest) - c phi', from phi = 0.2; the pin holds a body whose centroid lies on it."""
    forces = (
        AppliedTorque("t", "wheel", LoadCurve(line(0.4, 0.0))),
        RotationalSpring("s", "wheel", stiffness=5.0, rest=0.05, damping=0.02),
    )
    model = MultibodyModel((Body("wheel", 1.0, 2e-3),), (Revolute("pin", Marker("wheel"), Marker(GROUND)),), forces)
    run = exudyn_model().run(model, {"wheel": (0, 0, 0.2, 0, 0, 0)}, 0.2, 1e-4)
    rest, decay = 0.05 + 0.4 / 5.0, 0.02 / (2 * 2e-3)
    omega = np.sqrt(5.0 / 2e-3 - decay**2)
    swing, phase = (0.2 - rest) * np.exp(-decay * run.time), omega * run.time
    assert run.bodies["wheel"][:, 2] == pytest.approx(rest + swing * (np.cos(phase) + decay / omega * np.sin(phase)), abs=1e-5)
    assert run.bodies["wheel"][:, 5] == pytest.approx(-swing * (omega + decay**2 / omega) * np.sin(phase), abs=1e-3)


def test_a_pin_in_a_slot_falls_and_turns():
    """Energy is kept and nothing pushes along the slot; the rod's frame is neither at its centroid nor along the rod."""
    slot = PinSlot("slot", Marker("rod", 0.03, 0.04), Marker(GROUND, 0.0, 0.2), (1.0, 0.0))
    model = MultibodyModel((Body("rod", 0.4, 3e-3, (0.09, 0.12)),), (slot,), gravity=(0.0, -9.81))
    lean = np.arctan2(4, 3)
    run = exudyn_model().run(model, {"rod": (0.1, 0.2, -lean, 0, 0, 0)}, 0.2, 1e-4)
    x, y, angle, vx, vy, turning = run.bodies["rod"].T
    assert np.abs(y - 0.2 - 0.1 * np.sin(angle + lean)).max() < 1e-7 and np.abs(x - 0.1).max() < 1e-12
    energy = 0.5 * 0.4 * (vx**2 + vy**2) + 0.5 * 3e-3 * turning**2 + 0.4 * 9.81 * (y - 0.2)
    assert np.abs(energy).max() < 1e-5 and y.min() < 0.15


# -- a single impact ----------------------------------------------------------------------------------------------------------


def bounce(speed, **law):
    """Speed after an impact, over the one before, of a mass on a slide whose pin meets a bearing on the ground."""
    contact = Dry(1e-4, 0.01, law.pop("stiffness", 1e11), **law)
    model = MultibodyModel(
        (Body("block", 0.3, 1e-4),),
        (Prismatic("guide", Marker("block"), Marker(GROUND)), Revolute("pin", Marker(GROUND), Marker("block"), contact)),
    )
    run = exudyn_model().run(model, {"block": (5e-5, 0, 0, speed, 0, 0)}, 1e-4 / speed, 2e-7)
    return -run.bodies["block"][-1, 3] / speed


@pytest.mark.parametrize("speed", [0.05, 0.2])
def test_restitution_of_the_hysteresis(speed):
    """The integral of m v dv = -F dd over an impact:  h (1 + e) = ln((1 + h)/(1 - h e)), slow or fast."""
    hysteresis = 0.45
    e = bounce(speed, hysteresis=hysteresis)
    assert hysteresis * (1 + e) == pytest.approx(np.log((1 + hysteresis) / (1 - hysteresis * e)), rel=2e-3)
    assert bounce(speed) == pytest.approx(1.0, abs=1e-4)


def test_restitution_of_the_linear_damper():
    """K d + c d' until the bodies part, where d = 0: e = exp(-pi zeta/sqrt(1 - zeta^2))."""
    mass, stiffness, damping = 0.3, 1e8, 600.0
    zeta = damping / (2 * np.sqrt(mass * stiffness))
    e = bounce(0.05, stiffness=stiffness, exponent=1.0, damping=damping)
    assert e == pytest.approx(np.exp(-np.pi * zeta / np.sqrt(1 - zeta**2)), rel=2e-3)


# -- play in the wrist of the slider-crank ----------------------------------------------------------------------------------------


def slider_crank(hysteresis=0.0, friction=Friction("none"), offset=-1e-4, **contact):  # noqa: B008
    """(model, start) at crank angle 0 with the rates of the ideal mechanism."""
    wrist = Dry(CLEARANCE, RADIUS, STIFFNESS, hysteresis=hysteresis, friction=friction, **contact)
    model = MultibodyModel(
        bodies=(Body("crank", 0.3, 1e-4), Body("rod", ROD_MASS, ROD_INERTIA, (ROD / 2, 0.0)), Body("slider", SLIDER_MASS, 1e-4)),
        joints=(
            Revolute("O", Marker(GROUND), Marker("crank")),
            Revolute("A", Marker("crank", CRANK), Marker("rod")),
            Revolute("wrist", Marker("rod", ROD), Marker("slider"), wrist),
            Prismatic("guide", Marker("slider"), Marker(GROUND)),
        ),
        drives=(JointDrive("O", line(0.0, SPEED)),),
    )
    turning = -CRANK / ROD * SPEED
    start = {
        "crank": (0, 0, 0, 0, 0, SPEED),
        "rod": (CRANK + ROD / 2, 0, 0, 0, (CRANK * SPEED + ROD / 2 * turning), turning),
        "slider": (CRANK + ROD + offset, 0, 0, 0, 0, 0),
    }
    return model, start


def two_equations(duration, hysteresis=0.0, coefficient=0.0, ramp=1.0):
    """(rod angle, slider position) by scipy: the rod about the crank's pin, the slider on its line, each contact by itself."""
    onset = [1.0]

    def wrist(t, y):
        pin, arm = CRANK * np.exp(1j * SPEED * t), ROD * np.exp(1j * y[0])
        return pin, arm, pin + arm - y[1], 1j * SPEED * pin + 1j * y[2] * arm - y[3]

    def rate(t, y):
        pin, arm, e, v = wrist(t, y)
        n, depth = e / abs(e), max(abs(e) - CLEARANCE, 0.0)
        normal = STIFFNESS * depth**1.5 * (1 + hysteresis * (v * n.conjugate()).real / onset[0])
        lever = RADIUS + depth / 2  # Exudyn's contact point lies in the middle of the overlap: 0.5 % of the effect of friction here
        drag = coefficient * normal * np.clip(((v * n.conjugate()).imag - lever * y[2]) / ramp, -1, 1)
        force = -normal * n - 1j * drag * n
        torque = (arm.conjugate() * force).imag + lever * drag + ROD_MASS / 2 * (arm.conjugate() * SPEED**2 * pin).imag
        return [y[2], y[3], torque / (ROD_INERTIA + ROD_MASS * ROD**2 / 4), -force.real / SLIDER_MASS]

    def gap(t, y):
        return abs(wrist(t, y)[2]) - CLEARANCE

    gap.terminal = True
    t, y, touching = 0.0, np.array([0.0, CRANK + ROD - 1e-4, -CRANK / ROD * SPEED, 0.0]), False
    while t < duration:
        gap.direction = -1 if touching else 1
        part = solve_ivp(rate, (t, duration), y, method="DOP853", rtol=1e-10, atol=1e-13, events=gap, max_step=2e-6 if touching else 5e-5)
        t, y = part.t[-1], part.y[:, -1]
        if part.status == 1:
            touching = not touching
            _, _, e, v = wrist(t, y)
            onset[0] = max(1e-4, abs((v * (e / abs(e)).conjugate()).real))
            t, y = t + 1e-12, y + 1e-12 * np.array(rate(t, y))  # off the event that was just met
    return y[:2]


def miss(duration, step, hysteresis=0.0, coefficient=0.0, ramp=1.0):
    """(rod angle [rad], slider position [m]) of Exudyn less those of the two equations."""
    friction = Friction("ambrosio", coefficient, ramp)
    run = exudyn_model().run(*slider_crank(hysteresis, friction), duration, step, samples=4)
    return np.array([run.bodies["rod"][-1, 2], run.bodies["slider"][-1, 0]]) - two_equations(duration, hysteresis, coefficient, ramp)


def test_elastic_impacts_converge_to_the_two_equations():
    """Three impacts in a tenth of a turn: second order in the step, as the trapezoidal rule and a force without jump promise."""
    coarse, fine = (np.abs(miss(0.1 * TURN, step)) for step in (1e-6, 2.5e-7))
    assert coarse[1] < 1e-7 and fine[1] < 1e-8 and np.all(fine < coarse / 8)


def test_hysteresis_is_that_of_the_speed_at_onset():
    without = two_equations(0.1 * TURN)
    with_loss = two_equations(0.1 * TURN, 0.15)
    assert np.abs(miss(0.1 * TURN, 2e-7, 0.15))[1] < 1e-6 < 0.01 * abs(with_loss - without)[1]


def test_friction_has_its_arm():
    without, slid = (two_equations(0.06 * TURN, coefficient=mu) for mu in (0.0, 0.2))
    assert np.all(np.abs(miss(0.06 * TURN, 2e-7, coefficient=0.2)) < 1e-3 * np.abs(slid - without))


# -- what the twin cannot say ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"offset": 0.0}, r"'wrist' starts 0 m off centre with a clearance of 0.0005 m"),
        ({"offset": -6e-4}, r"'wrist' starts 0.0006 m off centre .* half the clearance"),
        ({"hysteresis": 1.6}, r"'wrist' has a hysteresis of 1.6; .* below 1.5"),
        ({"cylinder": True}, r"'wrist' has the cylinder law"),
        ({"friction": Friction("coulomb", 0.1)}, r"'wrist' has friction 'coulomb' with a dead speed of 0 m/s.*'ambrosio'"),
        ({"friction": Friction("ambrosio", 0.1, dead_speed=1e-3)}, r"'wrist' has friction 'ambrosio' with a dead speed of 0.001 m/s"),
    ],
)
def test_contacts_that_exudyn_does_not_have(changes, message):
    with pytest.raises(InputError, match=message):
        exudyn_model().run(*slider_crank(**changes), 1e-4, 1e-6)


def test_the_distance_off_centre_knows_how_bodies_stand():
    bodies = (Body("a", 1.0, 1.0, (0.0, 0.02)), Body("b", 1.0, 1.0))
    pin = Revolute("pin", Marker("a", 0.1, 0.02), Marker("b", 0.0, 0.1), Dry(1e-4, 0.01, 1e9))
    with pytest.raises(InputError, match=r"'pin' starts 0\.002 m off centre"):
        exudyn_model().run(MultibodyModel(bodies, (pin,)), {"a": (0, 0, np.pi / 2, 0, 0, 0), "b": (0.002, 0, 0, 0, 0, 0)}, 1e-3, 1e-4)


@pytest.mark.parametrize(
    ("part", "message"),
    [
        ({"joints": (Revolute("pin", Marker("a"), Marker(GROUND), MasslessLink(1e-4)),)}, r"joint 'pin' is a MasslessLink"),
        ({"joints": (Gear("mesh", "a", "b", -2.0),)}, r"does not support Gear \('mesh'\)"),
        ({"forces": (AppliedTorque("motor", "a", LoadCurve(line(1.0, 2.0), "speed")),)}, r"'motor' is not constant"),
        (
            {
                "joints": (Revolute("pin", Marker("a"), Marker(GROUND)),),
                "drives": (JointDrive("pin", Curve(np.array([0.0, 1.0]), np.array([[0.0, 1, 1, 0, 0, 0]]))),),
            },
            r"drive of 'pin' does not turn",
        ),
    ],
)
def test_elements_that_the_twin_does_not_have(part, message):
    model = MultibodyModel(**{"bodies": (Body("a", 1.0, 1.0), Body("b", 1.0, 1.0)), "joints": (), **part})
    with pytest.raises(InputError, match=message):
        exudyn_model().run(model, {"a": (0,) * 6, "b": (0,) * 6}, 1e-3, 1e-4)
