"""Planar multibody systems: bodies, joints with and without play, forces and drives; kinematics, statics, dynamics.

slider = MultibodyModel(bodies, joints, forces, drives, gravity)    # frozen descriptions
ready = assemble(slider)                                            # loops closed, coordinates chosen, start rates
run = simulate(ready, 0.1)                                  # kinematics where the drives leave no freedom, else dynamics
recorded = record(run, {"pin": Marker("rod", 0.12, 0.0)})       # motion of points, pins, powers, energy

Description
`model`         all frozen descriptions; `bodies`, `joints` and `forces` hold them, a file each; `curves`, `curve_files` motions and loads.
`tree`          which joint carries which body, which close loops.
`compile_model` description -> `system`: arrays of `records` for the kernels; `index` numbers bodies, markers and curves.
`assembly`      a start pose in which every loop is closed, the split of the coordinates (`partition`), start rates.

Motion
`kinematics`    poses, rates and the dependent coordinates; `chart` also across singular positions, `frames` vectors and points of bodies.
`loads`         forces on the bodies, element by element.
`mass_matrix`, `joint_loads`  accelerations in the independent coordinates; what joints transmit, for their friction.
`dynamics`      equations of motion, and the events in them.
`locking`       friction that locks; `drive_positions` says where the drives stand.
`simulate`      motion over time; `continuation` where the drives leave no freedom; `singular`, `passages` singular positions.
`statics`       positions of rest; `linearise` small motions about them; `tolerance` small deviations of points and journals.

Results
`observe`       poses, rates, forces and powers at given states (`observed`); `record` those of a run; `measures` peaks and impact load.
`reactions`     forces in the joints; `wrenches` what joints can transmit.
`analyses`      analyses of a simulated mechanism, as answers with values and tables.
`drawing`, `link_plates`  outlines of bodies and plates for their manufacture.
`warm`          compiles the kernels ahead of time.
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
    JointFriction,
    LinearActuator,
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
    "JointFriction",
    "LinearActuator",
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
