"""Compile the kernels of planar systems ahead of time, for `doctor --warm`."""

from drivewright._jit import warmer
from drivewright.multibody.assembly import assemble
from drivewright.multibody.model import Body, Dry, JointDrive, Marker, MultibodyModel, Prismatic, Revolute, line
from drivewright.multibody.record import record
from drivewright.multibody.simulate import simulate


@warmer
def warm_multibody() -> None:
    """A slider-crank with a dry wrist for a hundredth of a turn, and the same one without play."""
    bodies = (Body("crank", 1.0, 1.0), Body("rod", 1.0, 1.0), Body("slider", 1.0, 1.0))
    ends = Marker("rod", 3.0), Marker("slider")
    for wrist in (Revolute("wrist", *ends), Revolute("wrist", *ends, Dry(1e-3, 0.1, 1e6))):
        joints = (
            Revolute("main", Marker("crank"), Marker("ground")),
            Revolute("pin", Marker("crank", 1.0), Marker("rod")),
            wrist,
            Prismatic("guide", Marker("slider"), Marker("ground")),
        )
        ready = assemble(MultibodyModel(bodies, joints, drives=(JointDrive("main", line(0.0, 1.0)),)))
        record(simulate(ready, 0.06), {"slider": Marker("slider")})
