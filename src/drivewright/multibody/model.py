"""What a planar multibody system consists of: frozen descriptions, independent of any solver."""

from dataclasses import dataclass

from drivewright.multibody.bodies import GROUND, Body, Marker
from drivewright.multibody.curves import Curve, line
from drivewright.multibody.forces import (
    AppliedForce,
    AppliedTorque,
    Bushing,
    Dry,
    ForceElement,
    Friction,
    JointFriction,
    LinearActuator,
    LoadCurve,
    Lubricated,
    PointSpring,
    RotationalSpring,
)
from drivewright.multibody.joints import CamPair, Gear, Ideal, Joint, MasslessLink, PinSlot, Prismatic, Revolute, Rolling

__all__ = [
    "GROUND",
    "Body",
    "Bushing",
    "CamPair",
    "Curve",
    "JointDrive",
    "Dry",
    "AppliedForce",
    "ForceElement",
    "Friction",
    "Gear",
    "Ideal",
    "Joint",
    "JointFriction",
    "LinearActuator",
    "LoadCurve",
    "Lubricated",
    "Marker",
    "MasslessLink",
    "MultibodyModel",
    "PinSlot",
    "Prismatic",
    "Revolute",
    "Rolling",
    "RotationalSpring",
    "PointSpring",
    "AppliedTorque",
    "line",
]


@dataclass(frozen=True)
class JointDrive:
    """Prescribed rotation (revolute) or displacement (prismatic): start + motion(time), the start of a rotation being the bodies' guesses.

    It counts for the joint's first body relative to its second; where the first is the ground, for the second relative to the ground.
    """

    joint: str
    motion: Curve


@dataclass(frozen=True)
class MultibodyModel:
    """A planar multibody system."""

    bodies: tuple[Body, ...]
    joints: tuple[Joint, ...]
    forces: tuple[ForceElement, ...] = ()
    drives: tuple[JointDrive, ...] = ()
    gravity: tuple[float, float] = (0.0, 0.0)
