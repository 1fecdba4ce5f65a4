"""Implicit motion against the explicit one, its order, balances, and the limits of heavy damping and slow running."""

from dataclasses import replace

import numpy as np
import pytest
from chain_implicit_models import drive, small, with_guides, with_rollers

from drivewright.chains.explicit.measure import ROW
from drivewright.chains.explicit.simulate import Settings as Explicit
from drivewright.chains.explicit.simulate import simulate as explicit
from drivewright.chains.explicit.simulate import tooth_time
from drivewright.chains.implicit.equilibrium import equilibrium
from drivewright.chains.implicit.simulate import Settings, simulate
from drivewright.chains.model import ChainContact, with_sprocket

pytestmark = pytest.mark.analytical

SOFT = {"stiffness": 1e7, "joint": 1e7 / 3, "force": 75.0, "beta": 2e-6}
COUNTS = ("contacts", "open joints", "utilisation")


def damped(model, damping):
    for number, sprocket in enumerate(model.sprockets):
        model = with_sprocket(model, number, contact=ChainContact(sprocket.contact.stiffness, damping), damping=1e-3)
    return model


@pytest.mark.parametrize(
    "make",
    [lambda: damped(small(**SOFT, torque=0.2), 5.0), lambda: with_guides(small(**SOFT)), lambda: with_rollers(**SOFT)],
    ids=["teeth", "guides", "rollers"],
)
def test_motion_is_the_explicit_one(make):
    """All columns of both runs, over half a tooth."""
    model = make()
    duration = 0.5 * tooth_time(model)
    one, other = explicit(model, duration, Explicit(step=1.2e-7, run_in=0.0)), simulate(model, duration, Settings(step=2.5e-7, rho=1.0))
    for name in set(ROW) - set(COUNTS):
        scale = np.max(np.abs(one.column("angular momentum" if name == "turning impulse" else name)))
        assert other.column(name) == pytest.approx(one.column(name), abs=1e-2 * max(scale, 1e-6)), name
    assert other.bodies[..., :4] == pytest.approx(one.bodies[..., :4], abs=2e-3)
    assert other.centre_distance == pytest.approx(one.centre_distance, abs=1e-3 * np.ptp(one.centre_distance))
    assert other.plate == pytest.approx(one.plate, abs=1e-2 * np.max(np.abs(one.plate)))


@pytest.mark.parametrize("rho", [1.0, 0.7])
def test_order_is_two(rho):
    """Error of the centre distance against a far smaller step, over three halvings."""
    model = small(**SOFT)
    between = tooth_time(model) / 24

    def run(steps):
        return simulate(model, 12 * between, Settings(step=1.0001 * between / steps, rho=rho, tolerance=1.0)).centre_distance

    exact, steps = run(4096), np.array([64, 128, 256, 512])
    errors = [np.sqrt(np.mean((run(n) - exact) ** 2)) for n in steps]
    order = -np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert order == pytest.approx(2.0, abs=0.1)


def test_energy_and_momenta_add_up():
    motion = simulate(damped(small(**SOFT, torque=0.2, gravity=(2.0, -9.81)), 5.0), 6e-3, Settings(step=2e-6, rho=1.0))
    assert motion.energy_drift < 1e-4
    assert max(motion.momentum_residual) < 1e-5
    assert motion.column("joint damping")[-1] < -1e-5
    assert motion.column("slide damping")[-1] < -1e-5
    assert motion.outcome == "complete"


def test_high_frequencies_die_as_asked():
    """Undamped joints shaken by the start: rho below 1 takes their energy, rho = 1 keeps it."""
    model = small(**SOFT | {"beta": 0.0})
    kept, lost = (simulate(model, 6e-3, Settings(step=4e-5, rho=rho, tolerance=10.0)).energy_gap[-1] for rho in (1.0, 0.0))
    assert lost < -3 * abs(kept)


def test_heavy_damping_takes_no_small_steps():
    """10 N s/mm on a plate of 2.5 g at 1e8 N/m asks explicit steps of 4e-8 s; here 5e-6 s do, and half of that changes little."""
    model = damped(drive(stiffness=1e8, joint=1e8 / 3), 1e4)
    duration = 0.5 * tooth_time(model)
    one, other = (simulate(model, duration, Settings(step=step)).centre_distance for step in (5e-6, 2.5e-6))
    assert np.ptp(one) > 1e-7
    assert other == pytest.approx(one, abs=0.05 * np.ptp(one))


def test_slow_motion_is_the_equilibrium():
    """A tooth in 0.7 s: masses and dampers count for little."""
    model = small(stiffness=1e8, joint=3e7, force=75.0, speed=-1.0)
    rest = equilibrium(model, 24)
    motion = simulate(model, 2 * tooth_time(model), Settings(step=2e-4, rho=0.0, tolerance=np.inf))
    assert motion.centre_distance[24:48] == pytest.approx(rest.centre_distance, abs=2e-2 * rest.fluctuation)


def test_what_is_prescribed_follows_its_law():
    """Ramp from rest: angle and speed of the driver as the explicit run has them."""
    model = small(**SOFT)
    model = with_sprocket(model, 0, drive=replace(model.sprockets[0].drive, start=-5.0, ramp=2e-3))
    motion = simulate(model, 4e-3, Settings(step=1e-5))
    x = np.minimum(motion.t / 2e-3, 1.0)
    speed = -5.0 - 55.0 * (x - np.sin(2 * np.pi * x) / (2 * np.pi))
    assert motion.body(0, "w") == pytest.approx(speed, abs=1e-9)
    fine = np.linspace(0, motion.t[-1], 20001)
    y = np.minimum(fine / 2e-3, 1.0)
    turned = np.trapezoid(-5.0 - 55.0 * (y - np.sin(2 * np.pi * y) / (2 * np.pi)), fine)
    assert motion.body(0, "psi")[-1] - motion.body(0, "psi")[0] == pytest.approx(turned, abs=1e-8)
