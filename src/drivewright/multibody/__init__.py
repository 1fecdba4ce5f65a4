"""Planar multibody systems: bodies, joints with and without play, forces and drives; kinematics, statics, dynamics.

slider = Model(bodies, joints, forces, drives, gravity)     # frozen descriptions: see `multibody.model`
ready = assemble(slider)                                    # loops closed, coordinates chosen, start rates
run = simulate(ready, 0.1)                                  # kinematics where the drives leave no freedom, else dynamics
seen = record(run, {"pin": Marker("rod", 0.12, 0.0)})       # motion of points, pins, powers, energy
"""

from drivewright.multibody.analyses.energy_audit import audit
from drivewright.multibody.assembly import Assembly, assemble, idealised
from drivewright.multibody.measures import ImpactLoad, impact_load
from drivewright.multibody.model import (
    GROUND,
    AppliedForce,
    AppliedTorque,
    Body,
    Bushing,
    CamPair,
    Curve,
    Dry,
    Friction,
    Gear,
    Ideal,
    JointDrive,
    LoadCurve,
    Lubricated,
    Marker,
    MasslessLink,
    MultibodyModel,
    PinSlot,
    PointSpring,
    Prismatic,
    Revolute,
    Rolling,
    RotationalSpring,
    line,
)
from drivewright.multibody.observe import observe
from drivewright.multibody.record import Record, record
from drivewright.multibody.simulate import Run, Settings, simulate

__all__ = [
    "GROUND",
    "Assembly",
    "Body",
    "Bushing",
    "CamPair",
    "Curve",
    "JointDrive",
    "Dry",
    "AppliedForce",
    "Friction",
    "Gear",
    "Ideal",
    "ImpactLoad",
    "LoadCurve",
    "Lubricated",
    "Marker",
    "MasslessLink",
    "MultibodyModel",
    "PinSlot",
    "Prismatic",
    "Record",
    "Revolute",
    "Rolling",
    "RotationalSpring",
    "Run",
    "Settings",
    "PointSpring",
    "AppliedTorque",
    "assemble",
    "audit",
    "idealised",
    "impact_load",
    "line",
    "observe",
    "record",
    "simulate",
]
