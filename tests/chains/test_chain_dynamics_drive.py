"""Chain drives in motion against statics, the closed loop of rigid links, and the balance of energy."""

import numpy as np
import pytest

from drivewright.chains.explicit.assembly import start
from drivewright.chains.explicit.simulate import Settings, simulate
from drivewright.chains.explicit.stability import fastest, largest_step
from drivewright.chains.implicit.equilibrium import equilibrium
from drivewright.chains.link import design_link, seat_support
from drivewright.chains.model import Chain, ChainContact, ChainDrive, Slide, SpeedRamp, Sprocket, with_sprocket
from drivewright.chains.tooth import Tooth

pytestmark = pytest.mark.analytical

PITCH, ANGLE = 9.525e-3, np.pi / 6


def drive(radius=1.2e-3, speed=-60.0, stiffness=1e7, force=150.0, thick=0.0, beta=2e-6, damping=400.0, teeth=(9, 10), count=24, **chain):
    joint = design_link(PITCH, radius, ANGLE, 2e-4)
    base = [PITCH * z / (2 * np.pi) * np.cos(ANGLE) for z in teeth]
    tooth = [Tooth(z, rb, seat_support(joint, z) - thick) for z, rb in zip(teeth, base, strict=True)]
    plates = Chain(joint, count, 2.5e-3, 6.4e-8, stiffness / 3, beta, **{"toe": 4e-3} | chain)
    return ChainDrive(
        plates,
        (
            Sprocket(tooth[0], ChainContact(stiffness), drive=SpeedRamp(speed, speed)),
            Sprocket(tooth[1], ChainContact(stiffness), (0.0692, 0.0), mass=0.2, inertia=2e-5, slide=Slide(0.0, force, damping=damping)),
        ),
    )


@pytest.fixture(scope="module")
def slow():
    return simulate(drive(speed=-12.0, stiffness=4e7), 0.3, Settings(settle=0.15, joints=(0, 3, 9, 14), tolerance=2e-3))


def test_the_start_closes_the_loop_with_every_joint_at_its_length():
    model = drive()
    begin = start(model)
    arm, place = 0.5 * model.chain.link.hole_pitch, begin.poses[:, 0] + 1j * begin.poses[:, 1]
    own = np.exp(1j * begin.poses[:, 2])
    ahead = np.append(own[1:], own[0])
    gap = place + arm * own - np.append(place[1:], place[0]) + arm * ahead
    mean = (own + ahead) / np.abs(own + ahead)
    stretch = 2 * model.chain.link.radius - (gap / mean).real
    seated = np.concatenate([plates[:-1] for plates in begin.seated])
    free = np.setdiff1d(np.arange(24), seated)
    assert np.max(np.abs((gap / mean).imag)) < 1e-11
    assert np.max(np.abs(stretch[seated])) < 1e-12
    np.testing.assert_allclose(stretch[free], begin.tension / model.chain.joint_stiffness, rtol=1e-5)


def test_tension_of_a_strand_is_half_the_force_and_the_centrifugal_part():
    for speed in (-12.0, -200.0):
        begin = start(drive(speed=speed))
        velocity = -speed * 9 * PITCH / (2 * np.pi)
        assert begin.tension == pytest.approx(75.0 + 2.5e-3 / PITCH * velocity**2, rel=3e-3)


def test_a_running_strand_carries_half_the_force(slow):
    carried = np.mean(slow.tension[slow.steady], axis=0)
    assert np.max(carried) == pytest.approx(75.0, rel=0.03)


def test_the_balance_of_the_sliding_sprocket(slow):
    # force of the chain on it, on average, is the preload
    assert slow.mean(slow.body(1, "fx")) == pytest.approx(-150.0, rel=0.02)


def test_centre_distance_comes_near_the_rigid_loop(slow):
    rigid = start(drive(stiffness=1e12)).q[1] + 0.0692
    compliance = 75.0 / (4e7 / 3) * 6
    assert slow.mean(slow.centre_distance) == pytest.approx(rigid, abs=3e-4)
    assert slow.mean(slow.centre_distance) > rigid - compliance


@pytest.mark.slow
def test_thicker_teeth_shorten_the_running_centre_distance_as_at_rest():
    # the pitch lets no plate but the first and the last rise by d/sin a: how far the others do is the balance at rest, of another solver
    models = [drive(speed=-12.0, thick=thick) for thick in (0.0, 2e-5)]
    running = [(run := simulate(model, 0.24, Settings(settle=0.12))).mean(run.centre_distance) for model in models]
    thin, thick = (equilibrium(model, 16).mean for model in models)
    assert thick < thin
    assert running[1] - running[0] == pytest.approx(thick - thin, rel=0.1)


def test_sprockets_turn_in_the_ratio_of_their_teeth(slow):
    assert slow.mean(slow.body(1, "w")) == pytest.approx(-12.0 * 9 / 10, rel=1e-2)


def test_energy_balance_with_damping(slow):
    assert slow.outcome == "complete", slow.advice
    assert slow.momentum_residual[0] < 1e-11
    assert slow.momentum_residual[1] < 1e-11


def test_fastest_mode_of_the_joints_bounds_the_exact_one():
    model = drive(radius=0.0)
    chain, n = model.chain, 24
    # straight ring of translation and rotation, small motion: stiffness of every joint by its two plates
    jacobian = np.zeros((2 * n, 3 * n))
    for i in range(n):
        k, a = (i + 1) % n, 0.5 * chain.link.hole_pitch
        jacobian[2 * i, [3 * i, 3 * k]] = 1, -1
        jacobian[2 * i + 1, [3 * i + 1, 3 * k + 1, 3 * i + 2, 3 * k + 2]] = 1, -1, a, a
    mass = np.tile([chain.mass, chain.mass, chain.inertia], n)
    exact = np.linalg.eigvalsh(chain.joint_stiffness * (jacobian / mass) @ jacobian.T)[-1]
    contact = 2 * 1e7 * (1 / chain.mass + (0.5 * chain.link.hole_pitch) ** 2 / chain.inertia)
    assert exact <= fastest(model)[0] - contact
    assert fastest(model)[0] - contact < 2.0 * exact
    assert largest_step(drive(beta=0.0)) == pytest.approx(2 / np.sqrt(fastest(drive(beta=0.0))[0]), rel=1e-12)


def test_a_light_sprocket_is_in_the_fastest_mode():
    """Two contacts k of one plate drive the sprocket too: 2 k (rb^2/I + 1/m) beside what they do to the plate."""
    model = drive()
    base, (light, lighter) = (
        model.sprockets[1].tooth.base_radius,
        ((with_sprocket(model, 1, **change)) for change in ({"inertia": 1e-9, "mass": 1e-3}, {"inertia": 0.5e-9, "mass": 0.5e-3})),
    )
    assert fastest(lighter)[0] - fastest(light)[0] == pytest.approx(2 * 1e7 * (base**2 / 1e-9 + 1 / 1e-3), rel=1e-9)
