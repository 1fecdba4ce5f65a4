"""Contacts of the cams of a parallel, barrel or globoidal drive with its rollers, as line contacts in space.

Frame: x from the wheel's axis towards the cam's, z along the wheel's axis.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.roller_gear.envelope import rotate_about_y
from drivewright.indexing.roller_gear.flanks import CamFlanks


class RollerContacts(NamedTuple):
    """Contacts and near contacts of all cams with the rollers at one input angle; arrays over the k contacts.

    roller: its number; cam: number of the cam, or of the flank (0 pushes forward, 1 backward); normal (k, 3): unit, direction of the force
    of the cam on the roller; arm [m]: a force F turns the wheel with F arm, forward where positive; gap [m]; length [m] of the contact
    line; curvature [1/m]: relative curvature of roller and cam across the line, where it is sharpest.
    """

    roller: Ints
    cam: Ints
    normal: Floats
    arm: Floats
    gap: Floats
    length: Floats
    curvature: Floats


def of_plate_cams(levels: Sequence[CamContacts], pins: int, pin_radius: float, width: float) -> RollerContacts:
    """Contacts of plate cams at one input angle, one `CamContacts` a cam, on rollers of `pin_radius` along the `width` [m] of each cam;
    rollers of the second level count on from the `pins` of the first."""
    direction = np.concatenate([each.normal for each in levels])
    count = [len(each.pin) for each in levels]
    return RollerContacts(
        np.concatenate([each.pin + pins * number for number, each in enumerate(levels)]),
        np.repeat(np.arange(len(levels)), count),
        np.stack([direction.real, direction.imag, np.zeros(len(direction))], axis=1),
        np.concatenate([each.arm for each in levels]),
        np.concatenate([each.gap for each in levels]),
        np.full(len(direction), width),
        1 / pin_radius + np.concatenate([each.curvature for each in levels]),
    )


def of_flanks(flanks: CamFlanks) -> list[RollerContacts]:
    """Contacts at every angle of the flanks of a roller-gear cam: one of each roller on each flank where a piece of its line is left.

    Arm and normal are means along that piece, and its middle is where the force acts.
    """
    contact, length = flanks.contact, flanks.integrate_along_lines(np.ones_like(flanks.contact.arm))
    live = length > 0
    with np.errstate(divide="ignore", invalid="ignore"):
        arm = flanks.integrate_along_lines(contact.arm) / length
    back = flanks.cam.hand_sign * flanks.theta[:, None]
    outwards = rotate_about_y(contact.normal, back)  # out of the roller, in the frame of the drive
    normal = -np.stack([flanks.integrate_along_lines(outwards[..., axis]) for axis in range(3)], axis=-1)
    curvature = np.max(np.where(flanks.on_cam, contact.relative_curvature, -np.inf), axis=-1)
    return [_at_angle(flanks, number, live, arm, normal, length, curvature) for number in range(len(flanks.theta))]


def _at_angle(
    flanks: CamFlanks, number: int, live: Bools, arm: Floats, normal: Floats, length: Floats, curvature: Floats
) -> RollerContacts:
    flank, roller = np.nonzero(live[:, :, number])
    own = normal[flank, roller, number]
    return RollerContacts(
        np.array(flanks.cam.rollers, dtype=np.int64)[roller],
        flank,
        own / np.linalg.norm(own, axis=1, keepdims=True),
        arm[flank, roller, number],
        np.zeros(len(flank)),
        length[flank, roller, number],
        np.where(np.isfinite(curvature[flank, roller, number]), curvature[flank, roller, number], np.nan),
    )
