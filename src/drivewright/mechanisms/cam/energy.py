"""Energy audit of the drive over one turn: work of the cam shaft against springs, loads, damping and the motion of the follower."""

import numpy as np

from drivewright.mechanisms.cam.build import CamModel
from drivewright.multibody.analyses.energy_audit import audit_answer, audit_of_powers
from drivewright.result import Answer, Answers

MEANING = {"drive": "the cam shaft", "spring": "the spring", "load": "the steady force", "damping": "the damping"}
LIMIT = 1e-6  # largest gap over the energy exchanged
ROWS = 1000


def energy(model: CamModel, done: Answers) -> Answer:
    """Work of cam shaft, spring, steady force and damping over a turn against the kinetic energy of the follower.

    Where a follower closed by force leaves the cam, the torque of its programme is missing and the audit does not close.
    """
    piece, angle = model.cycle.samples()
    place, lift = model.cycle.at(piece, angle)
    load, speed, moved = model.load, model.speed, model.path.travel(lift)
    torque, travel, velocity = model.torque(place, lift).d0, moved.d0, moved.d1 * speed
    elastic = load.stiffness * travel + load.preload + (model.surge.force(place).d0 if model.surge else 0.0)
    powers = [torque * speed, -elastic * velocity, -load.force * velocity, -load.damping * velocity**2]
    kinetic = 0.5 * load.mass * velocity**2 + 0.5 * model.path.inertia * (lift.d1 * speed) ** 2
    audit = audit_of_powers(angle / speed, np.stack(np.broadcast_arrays(*powers), axis=1), kinetic, kinetic, drives=0)
    return audit_answer(audit, MEANING, LIMIT, ROWS)
