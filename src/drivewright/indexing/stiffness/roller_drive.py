"""Torsional stiffness of parallel, barrel and globoidal drives: rollers share the load by the stiffness of their contacts.

Unknowns: rotation of the output and of the wheel, place of the wheel in its plane, place of the cam in space and its rotation; rotations
times the radius of the pin circle, so that all are lengths.  A contact with the force direction f and the lever h is pressed by
    d = f.u_cam + h phi' w_cam - f.u_wheel - h w_wheel - gap + interference :
a turn w of the cam alone moves the wheel by phi' w without a change of any gap.  The input is locked behind the cam's shaft.
Where rollers are pressed in by an interference, rotation and work are counted from the unloaded drive: with the forces F_k under the torque
and the movements d_k from there, sum F_k d_k = T phi, so that the shares of the compliance add up to 1/K as without it.
"""

from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Bools, Floats
from drivewright.errors import InputError
from drivewright.indexing.drivetrain import PALMGREN_LINE
from drivewright.indexing.stiffness.assembly import NO_CONTACT_GAP, DrivetrainAssembly, NonlinearGroup, free_basis
from drivewright.indexing.stiffness.equilibrium import EquilibriumState, solve_equilibrium
from drivewright.indexing.stiffness.laws import ContactLinesLaw
from drivewright.indexing.stiffness.layout import OUT, WHEEL, WHEEL_X, LinearPart
from drivewright.indexing.stiffness.result import WheelStiffness, judge_outcomes, spread_over
from drivewright.indexing.stiffness.roller_contacts import RollerContacts
from drivewright.indexing.stiffness.solve import CONTACT_GAP, LEAST_ARM

CAM, CAM_TURN, SIZE = 4, 7, 8  # first unknown of the cam's place, its rotation, number of all
ROLLER_GROUPS = ("pin", "cam", "input", "wheel")
UNLOADED = 1e-6  # of the torque: the load of the drive that is called unloaded, where rollers are pressed in
SETTLED = 1e-11  # of the load: residual to which forces of rollers that are pressed in can balance


class RollerDrive(NamedTuple):
    """What yields between wheel and input; None is rigid.

    radius [m] of the pin circle; series [N/m]: roller in its seat, behind each contact; cam [N/m]: bearings of the cam's shaft, alike in
    all directions; input [N m/rad]: shaft between cam and locked input; wheel [N/m]: the wheel's bearing, radially; output [N m/rad]:
    between rollers and output; interference [m]: by which rollers and flanks are pressed together.
    """

    radius: float
    series: float | None = None
    cam: float | None = None
    input: float | None = None
    wheel: float | None = None
    output: float | None = None
    interference: float = 0.0


class _Padded(NamedTuple):
    """Contacts at p positions, padded to k: fields as of `RollerContacts` (p, k), normal (p, k, 3); `real`."""

    normal: Floats
    arm: Floats
    gap: Floats
    length: Floats
    real: Bools


def solve_roller_stiffness(
    drive: RollerDrive,
    theta: ArrayLike,
    ratio: ArrayLike,
    contacts: Sequence[RollerContacts],
    torque: float,
    model: Literal["unilateral", "bonded"] = "unilateral",
) -> WheelStiffness:
    """The `WheelStiffness` under a torque [N m] on the wheel, positive along +phi, at the input angles theta (p,) [rad].

    ratio (p,): phi' = dphi/dtheta; contacts: one set a position, of the unloaded wheel or of the wheel turned by its play; pin_forces of
    the result are (k,), one for each.  model: "unilateral" - contacts press, also those whose gap closes; "bonded" - those without a gap
    stick, no others.
    """
    angles, rates = np.atleast_1d(np.asarray(theta, dtype=float)), np.atleast_1d(np.asarray(ratio, dtype=float))
    _refuse(drive, angles, rates, contacts, torque, model)
    bonded = model == "bonded"
    kept = [each.gap < CONTACT_GAP if bonded else np.isfinite(each.gap) for each in contacts]
    here = np.flatnonzero([_carries(each, drive.radius, torque, bonded) for each in contacts])
    pins = _pad([contacts[int(i)] for i in here], [kept[int(i)] for i in here])
    assembly = assemble_roller_drive(drive, rates[here], pins, bonded)
    touching, pressed = pins.real & (pins.gap < CONTACT_GAP), bool(drive.interference) and not bonded
    floor = SETTLED * abs(torque) / drive.radius if pressed else 0.0
    state = solve_equilibrium(assembly, torque, touching, floor=floor)
    moved = _from_unloaded(state, solve_equilibrium(assembly, UNLOADED * torque, touching, floor=floor)) if pressed else state
    return _collect(angles, torque, model, kept, here, moved, drive.radius)


def assemble_roller_drive(drive: RollerDrive, ratio: Floats, pins: _Padded, bonded: bool) -> DrivetrainAssembly:
    """Linear parts, contacts and free unknowns at p positions with the ratios phi' (p,)."""
    p, k = pins.real.shape
    rows = np.zeros((p, k, 1, SIZE))
    lever = pins.arm / drive.radius
    rows[:, :, 0, CAM : CAM + 3], rows[:, :, 0, CAM_TURN] = pins.normal, lever * ratio[:, None]
    rows[:, :, 0, WHEEL_X : WHEEL_X + 2], rows[:, :, 0, WHEEL] = -pins.normal[..., :2], -lever
    rows *= pins.real[:, :, None, None]
    pressed = 0.0 if bonded else drive.interference
    offset = np.where(pins.real & bonded, 0.0, pressed - pins.gap)[..., None]
    line = PALMGREN_LINE * pins.length ** (8 / 9)
    law = ContactLinesLaw(line[..., None], 0.0 if drive.series is None else 1 / drive.series, bonded)
    group, springs = NonlinearGroup("pin", rows, offset, law), tuple(_springs(drive))
    return DrivetrainAssembly(SIZE, drive.radius, springs, (group,), free_basis(SIZE, springs, [group], p))


def _springs(drive: RollerDrive) -> Iterator[LinearPart]:
    unit, radius = np.eye(SIZE), drive.radius
    yield LinearPart("output", (unit[OUT] - unit[WHEEL])[None] / radius, _diagonal(drive.output, 1))
    yield LinearPart("wheel", unit[WHEEL_X : WHEEL_X + 2], _diagonal(drive.wheel, 2))
    yield LinearPart("cam", unit[CAM : CAM + 3], _diagonal(drive.cam, 3))
    yield LinearPart("input", unit[CAM_TURN][None] / radius, _diagonal(drive.input, 1))


def _diagonal(stiffness: float | None, size: int) -> Floats | None:
    return None if stiffness is None else stiffness * np.eye(size)


def _carries(contacts: RollerContacts, radius: float, torque: float, bonded: bool) -> bool:
    """Whether a contact without a gap holds the wheel against the torque."""
    lever = np.abs(contacts.arm) if bonded else -np.sign(torque) * contacts.arm
    return bool(np.any((contacts.gap < CONTACT_GAP) & (lever > LEAST_ARM * radius)))


def _pad(contacts: Sequence[RollerContacts], kept: Sequence[Bools]) -> _Padded:
    counts = np.array([np.count_nonzero(mask) for mask in kept], dtype=int)
    real = np.arange(max(1, counts.max(initial=0))) < counts[:, None]

    def table(name: str, empty: float, *shape: int) -> Floats:
        whole = np.full((*real.shape, *shape), empty)
        if len(contacts):
            whole[real] = np.concatenate([getattr(each, name)[mask] for each, mask in zip(contacts, kept, strict=True)])
        return whole

    return _Padded(table("normal", 0.0, 3), table("arm", 0.0), table("gap", NO_CONTACT_GAP), table("length", 1.0), real)


def _from_unloaded(state: EquilibriumState, rest: EquilibriumState) -> EquilibriumState:
    """The state with displacements counted from another."""
    parts = tuple(
        loaded._replace(displacement=loaded.displacement - free.displacement) for loaded, free in zip(state.parts, rest.parts, strict=True)
    )
    return state._replace(q=state.q - rest.q, parts=parts, converged=state.converged & rest.converged, steps=state.steps + rest.steps)


def _collect(theta, torque, model, kept, here, state, radius):
    """The `WheelStiffness` at all positions from the state of those that may carry (`here`)."""
    rotation = state.q[:, OUT] / radius
    outcome = judge_outcomes(len(theta), here, state, rotation, radius)
    good = outcome == "carried"
    spread = spread_over(len(theta), good, here)
    shares = {name: np.zeros(len(here)) for name in ROLLER_GROUPS}
    for part in state.parts:
        shares["wheel" if part.name == "output" else part.name] += part.work / torque**2
    forces = [np.full(len(mask), np.nan) for mask in kept]
    pressed = next(part for part in state.parts if part.name == "pin").flat
    for row, i in enumerate(here):
        if good[i]:
            forces[i][:] = 0.0
            forces[i][kept[i]] = pressed[row, : np.count_nonzero(kept[i])]
    tangent = spread(1 / np.where(good[here], state.compliance, np.nan))
    spreaded = {name: spread(share) for name, share in shares.items()}
    return WheelStiffness(theta, torque, model, tuple(outcome), spread(rotation), tangent, tuple(forces), spreaded, state.steps)


def _refuse(drive: RollerDrive, theta: Floats, ratio: Floats, contacts: Sequence[RollerContacts], torque: float, model: str) -> None:
    for name, value, unit in zip(drive._fields, drive, ("m", "N/m", "N/m", "N m/rad", "N/m", "N m/rad", "m"), strict=True):
        if value is not None and not (value > 0 or (name == "interference" and value == 0)):
            raise InputError(f"roller drive: {name} = {value:g} {unit} must be above 0; leave it out for a rigid part.")
    if not (np.isfinite(torque) and torque != 0):
        raise InputError(f"torsional stiffness: the torque must be finite and not 0, got {torque} N·m; without load there is no secant.")
    if not len(theta) == len(ratio) == len(contacts):
        raise InputError(
            f"torsional stiffness: {len(theta)} positions need as many ratios and sets of contacts, got {len(ratio)} and {len(contacts)}."
        )
    if model not in ("unilateral", "bonded"):
        raise InputError(f'torsional stiffness: no model {model!r}; it is "unilateral" (contacts only press) or "bonded" (they also pull).')
