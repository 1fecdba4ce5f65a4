"""Compiling ahead of time."""

from drivewright._jit import warmer
from drivewright.chains.closure.departure import departure
from drivewright.chains.closure.drive import close
from drivewright.chains.closure.model import Drive
from drivewright.chains.closure.positions import plates, states_at
from drivewright.chains.link import design_link


@warmer
def warm_closure() -> None:
    """Compile for `doctor --warm`."""
    joint = design_link(0.01, 0.001, 0.5, 0.0027)
    closure = close(Drive(joint, 11, 13, 40), 4)
    plates(closure, states_at(closure, 0.1))
    departure(joint, 11)
