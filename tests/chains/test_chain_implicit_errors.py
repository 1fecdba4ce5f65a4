"""What the implicit route refuses, and how it says so."""

from dataclasses import replace

import numpy as np
import pytest

from drivewright.chains.implicit.equilibrium import equilibrium
from drivewright.chains.implicit.simulate import Settings, simulate
from drivewright.chains.link import design_link, seat_support
from drivewright.chains.model import Chain, ChainContact, ChainDrive, Slide, SpeedRamp, Sprocket
from drivewright.chains.tooth import Tooth
from drivewright.errors import InputError, SolverError

pytestmark = pytest.mark.error

PITCH = 9.525e-3


def model(force=75.0, stiffness=1e8, speed=-60.0, torque=0.0):
    joined = design_link(PITCH, 1.2e-3, np.pi / 6, -0.5e-3)
    first, second = (Tooth(z, 0.5 * PITCH * z / np.pi * np.cos(np.pi / 6), seat_support(joined, z)) for z in (9, 10))
    contact = ChainContact(stiffness)
    sprockets = (
        Sprocket(first, contact, angle=0.0, drive=SpeedRamp(speed, speed)),
        Sprocket(second, contact, (7.25 * PITCH, 0.0), mass=0.1, inertia=1e-5, torque=torque, slide=Slide(0.0, force)),
    )
    return ChainDrive(Chain(joined, 24, 2.5e-3, 6e-8, stiffness), sprockets)


@pytest.mark.parametrize(
    "call, says",
    [
        (lambda: equilibrium("drive"), "equilibrium: needs a ChainDrive, got str"),
        (lambda: equilibrium(model(), 0), "positions = 0; it must be a whole number from 1 up"),
        (lambda: equilibrium(model(), 4, teeth=1.5), "teeth = 1.5; it must be a whole number"),
        (lambda: equilibrium(model(force=0.0)), "the slide of sprocket 2 has neither force nor stiffness; give one of them"),
        (lambda: simulate("drive", 1.0), "simulate: needs a ChainDrive, got str"),
        (lambda: simulate(model(), -1.0), "the duration must be finite and above 0 s, got -1"),
        (lambda: simulate(model(), 1.0, Settings(rho=1.2)), "rho = 1.2; the highest frequencies shrink by a factor from 0 to 1"),
        (lambda: simulate(model(), 1.0, Settings(step=0.0)), "step must be above 0, got 0"),
        (lambda: simulate(model(), 1.0, Settings(samples_per_tooth=5)), "5 samples per tooth alias"),
        (lambda: simulate(model(speed=0.0), 1.0), "the driver does not turn"),
        (lambda: simulate(model(), 1.0, Settings(joints=(24,))), "there is no joint 24; the chain has 0 .. 23"),
    ],
)
def test_refusals_say_what_and_how_much(call, says):
    with pytest.raises(InputError) as error:
        call()
    assert says in str(error.value)


def test_no_rest_under_more_torque_than_the_chain_carries():
    """The driven sprocket jumps teeth for ever: the message says how much is unbalanced and what to try."""
    with pytest.raises(SolverError, match=r"position 0 of 4 per tooth .* N remains unbalanced, more than .* slide's force") as error:
        equilibrium(model(torque=500.0), 4)
    assert error.value.partial is None


def test_step_that_does_not_settle():
    with pytest.raises(SolverError, match=r"does not converge at t = .* shorten the step of 0\.00\d+ s") as error:
        simulate(model(torque=300.0), 0.1, Settings(step=4e-4))
    assert len(error.value.partial.t) >= 1


def test_flanks_that_cannot_touch_are_refused():
    base = model()
    with pytest.raises(InputError, match="a seated plate touches at radius"):
        equilibrium(replace(base, sprockets=(replace(base.sprockets[0], tip_radius=1e-3), base.sprockets[1])))
