"""Cams: follower kinematics, pressure angle, curvature, profile, closure, forces and vibration; plain numbers, no spec.

`translating`, `oscillating`  pitch curve and pressure angle of the two kinds of follower
`followers`          a follower with its face: from lift to contact
`refusals`           which of many designs is refused first, and its numbers; nan for what a design lacks
`cycle`              one turn in smooth pieces; extremes of any quantity
`profile`            family of the face in the cam frame, overtravel
`finished`           the trimmed profile, its size, inspection table
`sizing`             least radii of curvature and base radius, length of a flat face
`track`              a surface of a cam and what runs on it, with the tables of its geometry
`closure`            yoke, groove, conjugate cam
`loads`, `pressure`  forces, torque, spring; Hertz pressure
`film`               the oil film between cam and follower
`spring_surge`       the waves in a spring with mass
`valve`              the second arm of a rocker and the valve that it drives
`vibration`          the follower train as one mass on a damped spring
`conjugate`          a lever between conjugate cams whose pivot is carried around them: profiles, pressure angles, forces
`conjugate_tables`   the same over the driving angle as tables, with the quasi-static loads
`clearance`          the same with clearance: contact, flight, impact
`oscillating_batch`  kernels for many designs at once
`follower_shapes`    the follower as shapes, for scene and solids
`cam_shapes`         the cam itself as shapes and solids
"""

from drivewright.cams import oscillating, translating
from drivewright.cams.closure import Breadth, breadth, crossovers, opposite_contact, play
from drivewright.cams.conjugate import ConjugateCam, ConjugatePair
from drivewright.cams.cycle import Cycle, Extreme
from drivewright.cams.film import cam_film, entrainment, reversals
from drivewright.cams.finished import (
    FinishedProfile,
    display_profile,
    finished_profile,
    inspection_table,
    is_star_shaped,
    min_hollow_radius,
    pitch_outline,
    polar_radii,
    profile_radii,
)
from drivewright.cams.follower_shapes import FollowerShapes
from drivewright.cams.followers import (
    CamContact,
    ContactAt,
    OscillatingFlat,
    OscillatingRound,
    TranslatingFlat,
    TranslatingRound,
    curvature,
    flat_radius,
)
from drivewright.cams.loads import (
    FollowerLoad,
    Jump,
    LoadPath,
    cam_normal_force,
    drive_torque,
    follower_force,
    jump,
    needed_preload,
    needed_stiffness,
)
from drivewright.cams.pressure import (
    contact_pressure,
    pair_modulus,
    peak_contact_pressure,
    pressure_check,
    relative_curvature,
    roller_pressure,
)
from drivewright.cams.profile import FlatFollower, Follower, Overtravel, RoundFollower, family, overtravel, path, spans
from drivewright.cams.refusals import first_refused, nan_unless
from drivewright.cams.sizing import face_ends, min_base_radius, min_flat_radius, min_pitch_radius
from drivewright.cams.spring_surge import COARSE, Harmonics, PeriodicSurge, SurgingSpring, jump_with_surge, lift_harmonics
from drivewright.cams.track import CamTrack
from drivewright.cams.valve import ArcArm, GuidedArm, GuidedLift
from drivewright.cams.vibration import (
    STIFFEST,
    Response,
    free_amplitude,
    mass_acceleration,
    periodic_response,
    propagator,
    response_peak,
    transient_response,
    vibration_table,
)

__all__ = [
    "ArcArm",
    "Breadth",
    "COARSE",
    "CamContact",
    "CamTrack",
    "ConjugateCam",
    "ConjugatePair",
    "ContactAt",
    "Cycle",
    "Extreme",
    "FinishedProfile",
    "FlatFollower",
    "Follower",
    "FollowerLoad",
    "FollowerShapes",
    "GuidedArm",
    "GuidedLift",
    "Harmonics",
    "Jump",
    "LoadPath",
    "OscillatingFlat",
    "OscillatingRound",
    "Overtravel",
    "PeriodicSurge",
    "Response",
    "RoundFollower",
    "STIFFEST",
    "SurgingSpring",
    "TranslatingFlat",
    "TranslatingRound",
    "breadth",
    "cam_normal_force",
    "contact_pressure",
    "crossovers",
    "curvature",
    "display_profile",
    "drive_torque",
    "entrainment",
    "face_ends",
    "family",
    "cam_film",
    "finished_profile",
    "first_refused",
    "flat_radius",
    "follower_force",
    "free_amplitude",
    "inspection_table",
    "is_star_shaped",
    "jump",
    "jump_with_surge",
    "lift_harmonics",
    "mass_acceleration",
    "min_base_radius",
    "min_flat_radius",
    "min_hollow_radius",
    "min_pitch_radius",
    "nan_unless",
    "needed_preload",
    "needed_stiffness",
    "opposite_contact",
    "oscillating",
    "overtravel",
    "pair_modulus",
    "path",
    "peak_contact_pressure",
    "periodic_response",
    "pitch_outline",
    "play",
    "polar_radii",
    "pressure_check",
    "profile_radii",
    "propagator",
    "relative_curvature",
    "response_peak",
    "reversals",
    "roller_pressure",
    "spans",
    "transient_response",
    "translating",
    "vibration_table",
]
