"""A parallel, barrel or globoidal drive under a torque at many input angles: its contacts, and again after its play."""

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np

from drivewright._typing import Floats, Numbers
from drivewright.contact import line_contact
from drivewright.indexing.parallel import ParallelIndexer
from drivewright.indexing.pin_pressure import contact_force_table
from drivewright.indexing.plane import contacts_at
from drivewright.indexing.play import find_play
from drivewright.indexing.roller_gear.design import RollerGear
from drivewright.indexing.roller_gear.flanks import compute_flanks
from drivewright.indexing.stiffness.loading import REACH
from drivewright.indexing.stiffness.result import FREE, WheelStiffness, take_up_play
from drivewright.indexing.stiffness.roller_contacts import RollerContacts, of_flanks, of_plate_cams
from drivewright.indexing.stiffness.roller_drive import RollerDrive, solve_roller_stiffness
from drivewright.result import Table

ALONG = 9  # places along a roller


class LoadedRollers(NamedTuple):
    """A drive, what yields between wheel and input, how contacts carry, and the width [m] of plate cams."""

    drive: ParallelIndexer | RollerGear
    yields: RollerDrive
    model: Literal["unilateral", "bonded"]
    width: float


def roller_contacts(loaded: LoadedRollers, angles: Floats, turned: Numbers = 0.0) -> list[RollerContacts]:
    """Contacts of all cams at the input angles (p,) [rad]; of plate cams also near ones, the wheel off its place by `turned` [rad]."""
    drive = loaded.drive
    if isinstance(drive, RollerGear):
        return of_flanks(compute_flanks(drive, angles, ALONG))
    levels = zip(*(contacts_at(level, angles, REACH, turned) for level in drive.levels), strict=True)
    return [of_plate_cams(each, drive.pins, drive.pin_radius, loaded.width) for each in levels]


def solve_rollers(loaded: LoadedRollers, angles: Floats, torque: float) -> tuple[WheelStiffness, list[RollerContacts]]:
    """(result, contacts) at the input angles (p,) [rad] under a torque [N m], the unloaded wheel in its ideal place."""
    contacts = roller_contacts(loaded, angles)
    return solve_at_roller_contacts(loaded, angles, contacts, torque), contacts


def solve_at_roller_contacts(loaded: LoadedRollers, angles: Floats, contacts: Sequence[RollerContacts], torque: float) -> WheelStiffness:
    """The result with given contacts, one set an angle."""
    return solve_roller_stiffness(loaded.yields, angles, loaded.drive.motion(angles).d1, contacts, torque, loaded.model)


def solve_rollers_after_play(
    loaded: LoadedRollers, angles: Floats, torque: float, first: WheelStiffness, contacts: list[RollerContacts]
) -> tuple[WheelStiffness, list[RollerContacts], Floats]:
    """(result, contacts, play (p,) [rad]): where the wheel of plate cams turns freely in `first`, solved again at its first contact.

    A roller gear that turns freely has lost its flanks to undercut there; what it would touch next is not followed.
    """
    drive = loaded.drive
    turned = np.array([outcome == FREE for outcome in first.outcome])
    if isinstance(drive, RollerGear) or loaded.model == "bonded" or not turned.any():
        return first, contacts, np.zeros(len(angles))
    free = find_play(drive, angles, np.sign(torque))
    play = np.where(turned & np.isfinite(free), free, 0.0)
    touching = roller_contacts(loaded, angles, np.sign(torque) * play)
    return take_up_play(first, solve_at_roller_contacts(loaded, angles, touching, torque)), touching, play


def shared_force_table(angles: Floats, contacts: Sequence[RollerContacts], forces: Sequence[Floats], modulus: float) -> Table:
    """Force and Hertz pressure of every loaded contact, one row each; forces: (k,) [N] a position, effective modulus E* [Pa]."""
    rows = []
    for angle, each, pressed in zip(angles, contacts, forces, strict=True):
        for k in np.flatnonzero(np.nan_to_num(pressed) != 0):
            curvature = each.curvature[k]
            known = pressed[k] > 0 and np.isfinite(curvature) and curvature > 0
            pressure = float(line_contact(pressed[k], each.length[k], 1 / curvature, modulus).pressure) if known else np.nan
            rows.append((angle, each.cam[k], each.roller[k], pressed[k], each.arm[k], each.length[k], pressure))
    return contact_force_table(
        "shared_forces",
        "Roller forces shared by stiffness",
        ("angle", "cam", "pin", "force", "arm", "length", "pressure"),
        rows,
        {"cam": "cam or flank, 0 pushes forward, 1 backward"},
        missing="there is no Hertz pressure at a corner or under tension",
    )
