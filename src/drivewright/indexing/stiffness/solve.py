"""Torsional stiffness of a pin-wheel indexer over its positions: loaded parts, rotation of the wheel, share of each part."""

from collections.abc import Sequence
from typing import Literal

import numpy as np

from drivewright._typing import ArrayLike, Bools, Floats
from drivewright.errors import InputError
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.drivetrain import Drivetrain, refuse_invalid
from drivewright.indexing.stiffness.assembly import assemble_drivetrain, pad_contacts
from drivewright.indexing.stiffness.equilibrium import solve_equilibrium
from drivewright.indexing.stiffness.result import TorsionalStiffness, collect_result

CONTACT_GAP = 1e-6  # m: a smaller gap counts as none
LEAST_ARM = 1e-6  # of the pin's distance: a smaller arm turns nothing


def solve_torsional_stiffness(
    drive: Drivetrain,
    theta: ArrayLike,
    contacts: Sequence[CamContacts],
    eccentricity: float,
    torque: float,
    *,
    cams: int = 2,
    sense: float = 1,
    model: Literal["unilateral", "bonded"] = "unilateral",
    compiled: bool = False,
) -> TorsionalStiffness:
    """The `TorsionalStiffness` of a `Drivetrain` under a torque [N m] on the wheel, positive along +phi.

    theta (p,) [rad]; contacts: `CamContacts` of cam 0, one a position, of the unloaded wheel, or of the wheel turned by its play;
    sense: +1 the cam's centre runs at eccentricity exp(i theta), -1 at exp(-i theta).
    model: "unilateral" - contacts press, also those whose gap closes; "bonded" - the intended ones without a gap stick, no others.
    compiled: solve in compiled code where all laws are; the same to the solver's tolerance, and worth its compilation for many designs.
    """
    angles = np.atleast_1d(np.asarray(theta, dtype=float))
    _check(drive, angles, contacts, torque, cams, model)
    bonded = model == "bonded"
    kept, carries = _who_carries(contacts, torque, bonded)
    here = np.flatnonzero(carries)
    pins = pad_contacts([contacts[int(i)] for i in here], [kept[int(i)] for i in here])
    centres = (eccentricity * np.exp(1j * sense * angles[here])).astype(np.complex128)
    assembly = assemble_drivetrain(drive, cams, centres, pins, bonded)
    state = solve_equilibrium(assembly, torque, np.tile(pins.gap < CONTACT_GAP, cams), compiled)
    return collect_result(drive, angles, torque, model, kept, assembly, state, here, cams)


def _check(drive: Drivetrain, theta: Floats, contacts: Sequence[CamContacts], torque: float, cams: int, model: str) -> None:
    refuse_invalid(drive, cams)
    if not (np.isfinite(torque) and torque != 0):
        raise InputError(f"torsional stiffness: the torque must be finite and not 0, got {torque} N·m; without load there is no secant.")
    if len(contacts) != len(theta):
        raise InputError(f"torsional stiffness: {len(theta)} positions need as many sets of contacts, got {len(contacts)}.")
    if model not in ("unilateral", "bonded"):
        raise InputError(f'torsional stiffness: no model {model!r}; it is "unilateral" (contacts only press) or "bonded" (they also pull).')


def _who_carries(contacts: Sequence[CamContacts], torque: float, bonded: bool) -> tuple[list[Bools], Bools]:
    """(which contacts take part, one mask a position; whether a contact without a gap holds the wheel there against the torque (p,)).

    What holds the cams holds both ways.
    """
    if not contacts:
        return [], np.zeros(0, dtype=bool)
    gap, arm, centre, intended = (
        np.concatenate([getattr(each, name) for each in contacts]) for name in ("gap", "arm", "centre", "intended")
    )
    counts = np.array([len(each.gap) for each in contacts])
    touching = gap < CONTACT_GAP
    kept = touching & intended if bonded else np.isfinite(gap)
    lever = np.abs(arm) if bonded else -np.sign(torque) * arm
    holding = kept & touching & (lever > LEAST_ARM * np.abs(centre))
    carries = np.bincount(np.repeat(np.arange(len(counts)), counts), holding, len(counts)) > 0
    return np.split(kept, np.cumsum(counts)[:-1]), carries
