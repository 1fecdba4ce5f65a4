"""What a multibody run of the cam pair gives."""

from typing import NamedTuple

from drivewright._typing import Floats


class MultibodyRun(NamedTuple):
    """Carrier angle since the start of the push [rad], swing of the lever [rad], travel of the rod [m], over one turn."""

    angle: Floats
    swing: Floats
    travel: Floats
