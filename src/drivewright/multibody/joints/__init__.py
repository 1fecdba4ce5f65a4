"""Joints: one frozen class a file, with its rows, its role in the spanning tree, its reaction and its drawing.

cam_pair    the cam and its follower
gear        the pair of gears, or the belt
joint       what any joint tells of itself
pin_models  what the play of a pin is taken for
pin_slot    the pin in a slot
prismatic   the prismatic joint
revolute    the pin, without play or with one of the models of its play
rolling     the wheel that rolls without slip
"""

from drivewright.multibody.joints.cam_pair import CamPair
from drivewright.multibody.joints.gear import Gear
from drivewright.multibody.joints.joint import Expansion, Joint, PointJoint, TreeRole
from drivewright.multibody.joints.pin_models import Ideal, MasslessLink, PinModel
from drivewright.multibody.joints.pin_slot import PinSlot
from drivewright.multibody.joints.prismatic import Prismatic
from drivewright.multibody.joints.revolute import Revolute
from drivewright.multibody.joints.rolling import Rolling
from drivewright.multibody.joints.rows import row_terms, row_velocity_product

__all__ = [
    "CamPair",
    "Expansion",
    "Gear",
    "Ideal",
    "Joint",
    "MasslessLink",
    "PinModel",
    "PinSlot",
    "PointJoint",
    "Prismatic",
    "Revolute",
    "Rolling",
    "TreeRole",
    "row_terms",
    "row_velocity_product",
]
