"""A pin wheel under a torque at many input angles: its contacts, and again after its play where nothing holds it at first."""

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.drivetrain import Drivetrain
from drivewright.indexing.motion import TURN, IndexMotion
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.plane import contacts_at
from drivewright.indexing.play import find_play
from drivewright.indexing.stiffness.result import FREE, TorsionalStiffness, take_up_play
from drivewright.indexing.stiffness.solve import solve_torsional_stiffness

REACH = 2e-3  # gaps up to this [m] may close under the load


class LoadedWheel(NamedTuple):
    """A pin wheel, what yields between wheel and input, its number of cams, how contacts carry, and whether compiled code solves it."""

    wheel: PinWheel
    train: Drivetrain
    cams: int
    model: Literal["unilateral", "bonded"]
    compiled: bool = False


def solve_loaded(loaded: LoadedWheel, angles: Floats, torque: float) -> tuple[TorsionalStiffness, list[CamContacts]]:
    """(result, contacts) at the input angles (p,) [rad] under a torque [N m], the unloaded wheel in its ideal place."""
    contacts = contacts_at(loaded.wheel, angles, REACH)
    return solve_at_contacts(loaded, angles, contacts, torque), contacts


def solve_at_contacts(loaded: LoadedWheel, angles: Floats, contacts: Sequence[CamContacts], torque: float) -> TorsionalStiffness:
    """The result with given contacts, one set an angle."""
    wheel, train, cams, model, compiled = loaded
    return solve_torsional_stiffness(
        train, angles, contacts, wheel.eccentricity, torque, cams=cams, sense=int(wheel.sense), model=model, compiled=compiled
    )


def solve_after_play(
    loaded: LoadedWheel, angles: Floats, torque: float, first: TorsionalStiffness, contacts: list[CamContacts]
) -> tuple[TorsionalStiffness, list[CamContacts], Floats]:
    """(result, contacts, play (p,) [rad]): where the wheel turns freely in `first`, solved again with the wheel at its first contact."""
    free = find_play(loaded.wheel, angles, np.sign(torque))
    turned = np.array([outcome == FREE for outcome in first.outcome]) & np.isfinite(free)
    play = np.where(turned, free, 0.0)
    if loaded.model == "bonded" or not turned.any():
        return first, contacts, play
    touching = contacts_at(loaded.wheel, angles, REACH, np.sign(torque) * play)
    return take_up_play(first, solve_at_contacts(loaded, angles, touching, torque)), touching, play


def dwell_angles(motion: IndexMotion, step: float) -> Floats:
    """Input angles [rad] inside the dwell, in equal steps of at most `step` [rad]; empty where the dwell is shorter than that."""
    count = int(np.ceil((TURN - motion.motion_angle) / step))
    return np.linspace(motion.motion_angle, TURN, count + 1)[1:-1]
