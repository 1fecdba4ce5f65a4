"""Torsional stiffness of a pin-wheel indexer over its positions: who carries, how far the wheel turns, who yields."""

from typing import Literal

import numpy as np

from drivewright.errors import InputError
from drivewright.indexing.drivetrain import check
from drivewright.indexing.stiffness.assembly import assemble, padded
from drivewright.indexing.stiffness.equilibrium import equilibrium
from drivewright.indexing.stiffness.result import collect

TOUCH = 1e-6  # m: a smaller gap counts as none
LEAST_ARM = 1e-6  # of the pin's distance: a smaller arm turns nothing


def solve(drive, theta, contacts, eccentricity, torque, *, cams=2, sense=1, model: Literal["unilateral", "bonded"] = "unilateral"):
    """The `TorsionalStiffness` of a `Drivetrain` under a torque [N m] on the wheel, positive along +phi.

    theta (p,) [rad]; contacts: `Contacts` of cam 0, one a position, of the unloaded wheel, or of the wheel turned by its play;
    sense: +1 the cam's centre runs at eccentricity exp(i theta), -1 at exp(-i theta).
    model: "unilateral" - contacts press, also those whose gap closes; "bonded" - the intended ones without a gap stick, no others.
    """
    theta = np.atleast_1d(np.asarray(theta, dtype=float))
    _check(drive, theta, contacts, torque, cams, model)
    both = model == "bonded"
    kept = [_kept(each, both) for each in contacts]
    carries = np.array([_resists(each, keep, torque, both) for each, keep in zip(contacts, kept, strict=True)], dtype=bool)
    here = np.flatnonzero(carries)
    pins = padded([contacts[i] for i in here], [kept[i] for i in here])
    assembly = assemble(drive, cams, eccentricity * np.exp(1j * sense * theta[here]), pins, both)
    state = equilibrium(assembly, torque, np.tile(pins.gap < TOUCH, cams))
    return collect(drive, theta, torque, model, kept, assembly, state, here)


def _check(drive, theta, contacts, torque, cams, model):
    check(drive, cams)
    if not (np.isfinite(torque) and torque != 0):
        raise InputError(f"torsional stiffness: the torque must be finite and not 0, got {torque} N m; without load there is no secant.")
    if len(contacts) != len(theta):
        raise InputError(f"torsional stiffness: {len(theta)} positions want as many sets of contacts, got {len(contacts)}.")
    if model not in ("unilateral", "bonded"):
        raise InputError(f'torsional stiffness: no model {model!r}; it is "unilateral" (contacts press) or "bonded" (they stick).')


def _kept(contacts, both):
    """Which contacts take part."""
    touching = contacts.gap < TOUCH
    return touching & contacts.intended if both else np.isfinite(contacts.gap)


def _resists(contacts, kept, torque, both):
    """Whether a contact without a gap holds the wheel against the torque; what holds the cams holds both ways."""
    arm = contacts.arm / np.abs(contacts.centre)
    return bool(np.any(kept & (contacts.gap < TOUCH) & ((np.abs(arm) if both else -np.sign(torque) * arm) > LEAST_ARM)))
