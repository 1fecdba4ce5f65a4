"""Orders of the explicit step where contacts close and open within it, and what damping of the joints' articulation takes."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from drivewright.chains.explicit.ensemble import disturbed
from drivewright.chains.explicit.simulate import Settings, first_start, simulate
from drivewright.chains.explicit.stability import fastest
from drivewright.chains.implicit.simulate import Settings as Implicit
from drivewright.chains.implicit.simulate import simulate as implicit
from drivewright.chains.link import design_link, seat_height, seat_support
from drivewright.chains.model import Chain, ChainContact, ChainDrive, Slide, SpeedRamp, Sprocket
from drivewright.chains.tooth import Tooth
from drivewright.contact import KelvinVoigt, mean_force

pytestmark = pytest.mark.analytical

PITCH, ANGLE = 9.525e-3, np.pi / 6
PHASES = (np.arange(32) + 0.5) / 32  # of a step, at which the contact closes


@pytest.mark.parametrize("rate", [2.0, -2.0])
@pytest.mark.parametrize("depth", [-0.3, -0.09, -0.02, 0.0, 0.05, 0.0999, 0.4])
def test_depth_over_the_step_is_the_mean_along_the_way(depth, rate):
    mean, _, touching = mean_force(KelvinVoigt(1.0, 0.0), depth, rate, 0.1)
    share = mean_force(KelvinVoigt(1.0, 3.0 * np.sign(rate)), depth, rate, 0.1)[1] / (3.0 * abs(rate)) - mean / (3.0 * abs(rate))
    there = sorted(depth + 0.05 * rate * sign for sign in (-1, 1))
    length = there[1] - there[0]
    assert share == pytest.approx(quad(lambda x: float(x > 0), *there, points=[0.0])[0] / length, abs=1e-12)
    assert mean == pytest.approx(quad(lambda x: max(x, 0.0), *there, points=[0.0])[0] / length, abs=1e-12)
    assert touching == (there[1] > 0)


@pytest.mark.parametrize("depth", [-0.1, 0.2])
def test_a_depth_at_rest_is_its_own_mean(depth):
    assert mean_force(KelvinVoigt(1.0, 2.0), depth, 0.0, 0.1) == (max(depth, 0.0), max(depth, 0.0), depth > 0)


def rebound(step, phase, damping=0.0):
    """Rate after one contact of unit mass and stiffness that is met with unit rate, by the leapfrog with predicted rates."""
    x, rate, a = -(5 + phase) * step, 1.0, 0.0
    while not (x <= -3 * step and rate < 0):
        a = -mean_force(KelvinVoigt(1.0, damping), x, rate + 0.5 * step * a, step)[1]
        rate += step * a
        x += step * rate
    return rate


def slope(steps, errors):
    return np.polyfit(np.log(steps), np.log(np.abs(errors)), 1)[0]


def test_a_contact_gives_its_energy_back_to_fourth_order():
    # with the force at the whole step alone: second order, 2e-4 at the smallest of these steps and of either sign by chance
    steps = np.geomspace(0.4, 0.04, 5)
    gained = [np.sqrt(np.mean([(rebound(h, phase) ** 2 - 1) ** 2 for phase in PHASES])) for h in steps]
    assert slope(steps, gained) == pytest.approx(4.0, abs=0.1)
    assert gained[-1] < 1e-6


def test_a_damped_contact_rebounds_to_second_order():
    # a damping force that is on or off for whole steps is of first order
    exact = np.mean([rebound(1e-3, phase, 0.3) for phase in PHASES[::8]])
    steps = np.geomspace(0.2, 0.02, 4)
    missed = [np.sqrt(np.mean([(rebound(h, phase, 0.3) - exact) ** 2 for phase in PHASES])) for h in steps]
    assert slope(steps, missed) == pytest.approx(2.0, abs=0.1)


def drive(damping=0.0, beta=2e-6, slide=300.0, **chain):
    """27 and 29 teeth, 72 links, at 200 rad/s."""
    joint = design_link(PITCH, 1.2e-3, ANGLE, 2.6e-3)
    sprockets = []
    for z in (27, 29):
        tooth, height = Tooth(z, PITCH * z / (2 * np.pi) * np.cos(ANGLE), seat_support(joint, z)), seat_height(joint, z)
        sprockets.append(Sprocket(tooth, ChainContact(1e8, damping), tip_radius=height - 1.9e-3, form_radius=height - 6.2e-3))
    return ChainDrive(
        Chain(joint, 72, 2.5e-3, 6.4e-8, 1e8 / 3, beta, toe=6e-3, crotch=1.4e-3, **chain),
        (
            replace(sprockets[0], drive=SpeedRamp(-200.0, -200.0)),
            replace(sprockets[1], centre=(0.2095, 0.0), mass=0.3, inertia=2e-4, slide=Slide(0.0, 150.0, damping=slide)),
        ),
    )


@pytest.mark.parametrize(("damping", "articulation"), [(0.0, 0.0), (100.0, 2e-5)])
def test_drift_of_a_running_drive_falls_with_the_square_of_the_step(damping, articulation):
    model, steps = drive(damping, articulation_damping=articulation), np.array([1e-6, 5e-7, 2.5e-7, 1e-7])
    drifts = []
    for step in steps:
        run = simulate(model, 0.05, Settings(step=step, tolerance=1.0))
        drifts.append(np.polyfit(run.t, run.energy_gap, 1)[0])
    assert slope(steps, drifts) == pytest.approx(2.0, abs=0.1)


@pytest.mark.slow
def test_without_any_damping_the_drift_falls_with_the_square_of_the_step_once_it_resolves_the_chatter_of_the_flanks():
    model, steps, gaps = drive(beta=0.0), np.array([2e-7, 1e-7, 5e-8]), []
    for step in steps:
        settings = Settings(step=step, tolerance=1e3)
        begin = first_start(model, settings)
        runs = (simulate(model, 0.03, settings, begin=disturbed(begin, (0, member)) if member else begin) for member in range(4))
        gaps.append(np.mean([np.max(np.abs(run.energy_gap)) for run in runs]))
    assert slope(steps, gaps) == pytest.approx(2.0, abs=0.2)


def test_articulation_damping_stills_the_rocking_of_the_plates_and_is_counted():
    free, damped = (simulate(drive(articulation_damping=c), 0.03, Settings(settle=0.01)) for c in (0.0, 2e-5))
    assert np.ptp(damped.centre_distance[damped.steady]) < 0.5 * np.ptp(free.centre_distance[free.steady])
    lost = [-run.column("joint damping")[-1] for run in (free, damped)]
    # four joints at a time turn at the speed of their sprocket: 2 c (w1^2 + w2^2) at least
    assert lost[1] > 0.03 * 2 * 2e-5 * (200.0**2 + (200 * 27 / 29) ** 2)
    assert np.max(np.abs(damped.energy_gap)) < 1e-3 * lost[1]
    assert max(damped.momentum_residual) < 1e-11


@pytest.mark.slow
def test_articulation_is_damped_alike_by_implicit_steps():
    model = drive(articulation_damping=2e-4)
    one, other = simulate(model, 1e-3, Settings(step=2e-7, run_in=0.0)), implicit(model, 1e-3, Implicit(step=5e-7, rho=1.0))
    bare = simulate(replace(model, chain=replace(model.chain, articulation_damping=0.0)), 1e-3, Settings(step=2e-7, run_in=0.0))
    scale = np.ptp(one.column("joint damping"))
    assert other.column("joint damping") == pytest.approx(one.column("joint damping"), abs=1e-2 * scale)
    assert np.ptp(bare.column("joint damping")) < 0.9 * scale
    assert other.centre_distance == pytest.approx(one.centre_distance, abs=1e-2 * np.ptp(one.centre_distance))


def test_articulation_damping_shortens_the_stable_step():
    bare, damped = (fastest(drive(articulation_damping=c)) for c in (0.0, 3e-5))
    assert damped[0] == bare[0]
    assert damped[1] - bare[1] == pytest.approx(4 * 3e-5 / 6.4e-8, rel=1e-9)
