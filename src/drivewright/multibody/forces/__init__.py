"""Forces between bodies, and on them: a file each, with its description, its record and its kernel."""

from drivewright.multibody.forces.bushing import Bushing
from drivewright.multibody.forces.contact import Dry, Friction, Lubricated
from drivewright.multibody.forces.element import ForceElement
from drivewright.multibody.forces.load import AppliedForce, AppliedTorque, LoadCurve
from drivewright.multibody.forces.rotational_spring import RotationalSpring
from drivewright.multibody.forces.spring import PointSpring

__all__ = [
    "Bushing",
    "Dry",
    "AppliedForce",
    "ForceElement",
    "Friction",
    "LoadCurve",
    "Lubricated",
    "RotationalSpring",
    "PointSpring",
    "AppliedTorque",
]
