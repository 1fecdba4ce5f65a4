"""Forces between bodies, and on them: a file each, with its description, its record and its kernel.

actuator           the linear actuator along a line of a body
bushing            the pin in rubber: springs and dampers along both directions and about the pin
contact            the contact of a pin with play: dry, or with a film of oil between journal and bearing
dry_contact        the dry contact of a pin with play from radii, material and restitution, by the name of its normal law
element            what any force tells of itself
joint_friction     dry friction of ideal joints: the description
load               loads from outside
pin_contact        kernels of the contact of a pin with play
resting_friction   the friction with which joints that stick hold a mechanism at rest
rotational_spring  the spring with a damper about the angle between two bodies
sliding_friction   kernels of the friction of ideal joints
spring             the spring with a damper between two points
"""

from drivewright.multibody.forces.actuator import LinearActuator
from drivewright.multibody.forces.bushing import Bushing
from drivewright.multibody.forces.contact import Dry, Friction, Lubricated
from drivewright.multibody.forces.element import ForceElement
from drivewright.multibody.forces.joint_friction import JointFriction
from drivewright.multibody.forces.load import AppliedForce, AppliedTorque, LoadCurve
from drivewright.multibody.forces.rotational_spring import RotationalSpring
from drivewright.multibody.forces.spring import PointSpring

__all__ = [
    "Bushing",
    "Dry",
    "AppliedForce",
    "ForceElement",
    "Friction",
    "JointFriction",
    "LinearActuator",
    "LoadCurve",
    "Lubricated",
    "RotationalSpring",
    "PointSpring",
    "AppliedTorque",
]
