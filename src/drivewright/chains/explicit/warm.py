"""Compile the kernel of chain drives ahead of time, for `doctor --warm`."""

import numpy as np

from drivewright._jit import warmer
from drivewright.chains.explicit.simulate import simulate
from drivewright.chains.link import design_link, seat_support
from drivewright.chains.model import LINEAR, Chain, ChainContact, ChainDrive, Slide, SpeedRamp, Sprocket
from drivewright.chains.tooth import Tooth


def small_drive(law: str = LINEAR) -> ChainDrive:
    """A chain of 24 links on two sprockets of 10 teeth, its contacts of the named law."""
    joint = design_link(9.525e-3, 1.2e-3, np.pi / 6, 2e-4)
    tooth = Tooth(10, 9.525e-3 * 10 / (2 * np.pi) * np.cos(np.pi / 6), seat_support(joint, 10))
    contact = ChainContact(1e7, law=law)
    sprockets = (
        Sprocket(tooth, contact, drive=SpeedRamp(-100.0, -100.0)),
        Sprocket(tooth, contact, (0.0667, 0.0), mass=0.2, inertia=2e-5, slide=Slide(0.0, 150.0)),
    )
    return ChainDrive(Chain(joint, 24, 2.5e-3, 6.4e-8, 3e6), sprockets)


@warmer
def warm_chain_dynamics() -> None:
    """A small drive for a few steps; every drive runs on the same kernel."""
    simulate(small_drive(), 1e-4)
