"""Cams: follower kinematics, pressure angle, curvature, profile, closure, forces and vibration; plain numbers, no spec."""

from drivewright.cams import oscillating, translating
from drivewright.cams.closure import Breadth, breadth, crossovers, opposite_contact, play
from drivewright.cams.cycle import Cycle, Extreme
from drivewright.cams.followers import Contact, OscillatingFlat, OscillatingRound, TranslatingFlat, TranslatingRound, curvature, flat_radius
from drivewright.cams.loads import Load, drive_torque, follower_force, jump_speed, needed_preload, needed_stiffness, normal_force
from drivewright.cams.profile import Sinking, family, path, sinking, spans
from drivewright.cams.sizing import face_ends, least_base_radius
from drivewright.cams.vibration import STIFFEST, Response, acceleration, amplitude, peak, periodic, propagator, transient

__all__ = [
    "Breadth",
    "Contact",
    "Cycle",
    "Extreme",
    "Load",
    "OscillatingFlat",
    "OscillatingRound",
    "Response",
    "STIFFEST",
    "Sinking",
    "TranslatingFlat",
    "TranslatingRound",
    "acceleration",
    "amplitude",
    "breadth",
    "crossovers",
    "curvature",
    "drive_torque",
    "face_ends",
    "family",
    "flat_radius",
    "follower_force",
    "jump_speed",
    "least_base_radius",
    "needed_preload",
    "needed_stiffness",
    "normal_force",
    "opposite_contact",
    "oscillating",
    "path",
    "peak",
    "periodic",
    "play",
    "propagator",
    "sinking",
    "spans",
    "transient",
    "translating",
]
