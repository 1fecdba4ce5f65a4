"""Cams: follower kinematics, pressure angle, curvature, profile, closure, forces and vibration; plain numbers, no spec."""

from drivewright.cams import oscillating, translating
from drivewright.cams.closure import Breadth, breadth, crossovers, opposite_contact, play
from drivewright.cams.cycle import Cycle, Extreme
from drivewright.cams.followers import (
    CamContact,
    OscillatingFlat,
    OscillatingRound,
    TranslatingFlat,
    TranslatingRound,
    curvature,
    flat_radius,
)
from drivewright.cams.loads import (
    FollowerLoad,
    cam_normal_force,
    drive_torque,
    follower_force,
    jump_speed,
    needed_preload,
    needed_stiffness,
)
from drivewright.cams.profile import FlatFollower, Follower, RoundFollower, Sinking, family, path, sinking, spans
from drivewright.cams.sizing import face_ends, least_base_radius
from drivewright.cams.vibration import STIFFEST, Response, acceleration, amplitude, peak, periodic, propagator, transient

__all__ = [
    "acceleration",
    "amplitude",
    "Breadth",
    "breadth",
    "cam_normal_force",
    "CamContact",
    "crossovers",
    "curvature",
    "Cycle",
    "drive_torque",
    "Extreme",
    "face_ends",
    "family",
    "flat_radius",
    "FlatFollower",
    "Follower",
    "follower_force",
    "FollowerLoad",
    "jump_speed",
    "least_base_radius",
    "needed_preload",
    "needed_stiffness",
    "opposite_contact",
    "oscillating",
    "OscillatingFlat",
    "OscillatingRound",
    "path",
    "peak",
    "periodic",
    "play",
    "propagator",
    "Response",
    "RoundFollower",
    "sinking",
    "Sinking",
    "spans",
    "STIFFEST",
    "transient",
    "translating",
    "TranslatingFlat",
    "TranslatingRound",
]
