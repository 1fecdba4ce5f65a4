"""From a drive train and its contacts at many positions to one batch of convex problems in the unknowns that are free.

All displacements are q = basis y: the parts that are rigid leave the unknowns, so that no number stands for "very stiff".
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Complexes, Floats
from drivewright.indexing.body_compliance import BodyCompliance
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.drivetrain import SIDES, Drivetrain, GearMesh
from drivewright.indexing.stiffness import layout as unknowns
from drivewright.indexing.stiffness.laws import GearFlankLaw, PinContactLaw, RigidContactLaw, StrainLaw, radial_bearing_law
from drivewright.indexing.stiffness.layout import OUT, WHEEL, WHEEL_X, LinearPart, StiffnessLayout
from drivewright.indexing.stiffness.minimise import flatten_rows

RANK = 1e-9  # singular values of the rigid rows, which are of the size of 1, below this count as 0
NO_CONTACT_GAP = 1.0  # m: gap that pads the positions with fewer contacts


class NonlinearGroup(NamedTuple):
    """A non-linear part at all positions: rows (p, k, c, size) of its k strains, offset (p, k, c), and its law; None is rigid."""

    name: str
    rows: Floats
    offset: Floats
    law: StrainLaw | None


class PaddedContacts(NamedTuple):
    """Contacts of cam 0 at p positions, padded to k: complex centre [m] and unit normal; arm, gap [m]; `real`; each (p, k)."""

    centre: Complexes
    normal: Complexes
    arm: Floats
    gap: Floats
    real: Bools


class DrivetrainAssembly(NamedTuple):
    """Linear parts, non-linear groups and basis (p, size, free) of `size` unknowns; lever [m] scales rotations; load: torque/lever on the
    unknown OUT."""

    size: int
    lever: float
    springs: tuple[LinearPart, ...]
    groups: tuple[NonlinearGroup, ...]
    basis: Floats


def pad_contacts(contacts: Sequence[CamContacts], kept: Sequence[Bools]) -> PaddedContacts:
    """`PaddedContacts` of a list of `CamContacts`, one a position, and of masks of those that take part."""
    counts = np.array([np.count_nonzero(mask) for mask in kept], dtype=int)
    real = np.arange(max(1, counts.max(initial=0))) < counts[:, None]

    def table(name, empty):
        whole = np.full(real.shape, empty)
        if len(contacts):
            whole[real] = np.concatenate([getattr(each, name) for each in contacts])[np.concatenate(kept)]
        return whole

    return PaddedContacts(table("centre", 0j), table("normal", 0j), table("arm", 0.0), table("gap", NO_CONTACT_GAP), real)


def assemble_drivetrain(drive: Drivetrain, cams: int, centres: Complexes, pins: PaddedContacts, bonded: bool) -> DrivetrainAssembly:
    """The `DrivetrainAssembly` with the cam's centre at `centres` (p,) complex [m]; bonded: contacts stick, without gap."""
    layout, lever = StiffnessLayout(cams), drive.spacing / 2
    groups = [_pin_group(drive, layout, lever, centres, pins, bonded), _crank_group(drive, layout, lever, centres)]
    groups += list(_bearing_groups(drive, layout, lever, len(centres)))
    springs = tuple(unknowns.linear_parts(drive, layout))
    return DrivetrainAssembly(layout.size, lever, springs, tuple(groups), free_basis(layout.size, springs, groups, len(centres)))


def cam_phases(cams: int) -> Complexes:
    """(n,) complex: exp(2 pi i j/n), by which cam j and its contacts are turned against cam 0."""
    return np.asarray(np.exp(2j * np.pi * np.arange(cams) / cams), dtype=np.complex128)


def _pin_group(
    drive: Drivetrain, layout: StiffnessLayout, lever: float, centres: Complexes, pins: PaddedContacts, bonded: bool
) -> NonlinearGroup:
    """d = f . u_cam + b Im(conj(c - O_b) f) - w arm - f . u_wheel - gap, of cam 0's contacts, then cam 1's ..."""
    p, k = pins.real.shape
    rows = np.zeros((p, layout.cams, k, layout.size))
    about_cam = np.imag(np.conj(pins.centre - centres[:, None]) * pins.normal)
    for j, way in enumerate(cam_phases(layout.cams)):
        at, normal = layout.cam(j), pins.normal * way
        rows[:, j, :, at], rows[:, j, :, at + 1], rows[:, j, :, at + 2] = normal.real, normal.imag, about_cam / lever
        rows[:, j, :, WHEEL_X], rows[:, j, :, WHEEL_X + 1], rows[:, j, :, WHEEL] = -normal.real, -normal.imag, -pins.arm / lever
    rows = rows.reshape(p, layout.cams * k, 1, layout.size) * np.tile(pins.real, layout.cams)[:, :, None, None]
    gap = np.zeros_like(pins.gap) if bonded else pins.gap
    offset = -np.tile(gap, layout.cams)[:, :, None]
    pin = drive.pins
    if drive.bodies is not None and pin is not None and pin.line is not None:
        compliance = _body_compliance(drive.bodies, pins, centres, layout.cams)
        return NonlinearGroup("pin", rows, offset, PinContactLaw(pin, bonded, compliance))
    if pin is None or (pin.line is None and pin.series is None):
        return NonlinearGroup("pin", rows, offset, RigidContactLaw(np.zeros_like(offset), np.zeros(()), bonded))
    return NonlinearGroup("pin", rows, offset, PinContactLaw(pin, bonded))


def _body_compliance(bodies: BodyCompliance, pins: PaddedContacts, centres: Complexes, cams: int) -> Floats:
    """(p, cams k, 1) [m/N]: what cams and pins yield at every contact, cam 0's first; of padding anything above 0."""
    p, k = pins.real.shape
    seen, found = pins.centre - centres[:, None], np.full((p, cams, k), np.inf)
    for j in range(cams):
        found[:, j][pins.real] = bodies.at(j, seen[pins.real], pins.centre[pins.real], pins.normal[pins.real], pins.gap[pins.real])
    return np.where(np.isfinite(found), found, np.nanmin(found, initial=1.0)).reshape(p, cams * k, 1)


def _crank_group(drive: Drivetrain, layout: StiffnessLayout, lever: float, centres: Complexes) -> NonlinearGroup:
    """d = u_cam + i b (hole - O_b) - u_s - i t O_b: hole of the cam against crank pin, of shaft 0 with every cam, then of shaft 1."""
    rows = np.zeros((len(centres), 2, layout.cams, layout.size), dtype=np.complex128)
    for side, sign in enumerate(SIDES):
        for j, way in enumerate(cam_phases(layout.cams)):
            cam, station = layout.cam(j), layout.station(side, j + 1)
            rows[:, side, j, [cam, cam + 1, cam + 2]] = 1.0, 1j, 1j * sign  # a hole is `lever` from the cam's centre
            rows[:, side, j, [station, station + 1]] = -1.0, -1j
            rows[:, side, j, layout.twist(side, j + 1)] = -1j * centres * way / lever
    return _vectors("crank", rows, None if drive.crank is None else radial_bearing_law(drive.crank))


def _vectors(name: str, rows: Complexes, law: StrainLaw | None) -> NonlinearGroup:
    """The `NonlinearGroup` of complex rows (p, ..., size)."""
    flat = flatten_rows(rows)
    real = np.stack([flat.real, flat.imag], axis=2)
    return NonlinearGroup(name, real, np.zeros(real.shape[:3]), law)


def _bearing_groups(drive: Drivetrain, layout: StiffnessLayout, lever: float, p: int) -> Iterator[NonlinearGroup]:
    if drive.support is not None:
        rows = np.array([unknowns.support_rows(layout, side, end) for side in (0, 1) for end in (0, 1)])
        yield _same("support", rows, np.zeros((4, 2)), radial_bearing_law(drive.support), p)
    if drive.gear is not None:
        rows = np.array([row for side in (0, 1) for row in _flanks(drive.gear, layout, lever, side)])
        yield _same("gear", rows, np.full((4, 1), -drive.gear.backlash / 2), GearFlankLaw(drive.gear.stiffness), p)
    if drive.wheel is not None:
        rows = unknowns.vector_rows(layout, [(WHEEL_X, 1.0)])[None]
        yield _same("wheel", rows, np.zeros((1, 2)), radial_bearing_law(drive.wheel), p)


def _same(name: str, rows: Floats, offset: Floats, law: StrainLaw, p: int) -> NonlinearGroup:
    """A `NonlinearGroup` whose rows are the same at all positions."""
    return NonlinearGroup(name, np.broadcast_to(rows, (p, *rows.shape)), np.broadcast_to(offset, (p, *offset.shape)), law)


def flank_directions(gear: GearMesh, side: int) -> Complexes:
    """(2,) complex: force of the input gear on a split gear at its two flanks: around the axis by the pressure angle, and outwards."""
    outward, angle = SIDES[side], gear.pressure_angle
    return outward * np.array([np.sin(angle) + 1j * np.cos(angle), np.sin(angle) - 1j * np.cos(angle)], dtype=np.complex128)


def _flanks(gear: GearMesh, layout: StiffnessLayout, lever: float, side: int) -> Floats:
    """(2, 1, size): a flank is pressed where the split gear's tooth, a pitch radius inwards, moves against the force."""
    rows = np.zeros((2, 1, layout.size))
    at = layout.station(side, 0)
    for row, force in zip(rows[:, 0], flank_directions(gear, side), strict=True):
        row[[at, at + 1]] = -force.real, -force.imag
        row[layout.twist(side, 0)] = -np.imag(np.conj(-SIDES[side] * gear.pitch_radius) * force) / lever
    return rows


def free_basis(size: int, springs: Sequence[LinearPart], groups: Sequence[NonlinearGroup], p: int) -> Floats:
    """(p, size, free): all displacements that leave what is rigid alone."""
    constant = [spring.rows for spring in springs if spring.stiffness is None]
    basis = _null_space(np.concatenate(constant)) if constant else np.eye(size)
    rigid = [flatten_rows(group.rows) for group in groups if group.law is None]
    if not rigid:
        return np.broadcast_to(basis, (p, *basis.shape))
    _, sizes, directions = np.linalg.svd(np.concatenate(rigid, axis=1) @ basis)
    held = np.zeros(directions.shape[:2], dtype=bool)
    held[:, : sizes.shape[1]] = sizes > RANK
    # Where the rank differs between positions, a direction that is held becomes a column of 0.
    return basis @ np.where(held[:, :, None], 0.0, directions).transpose(0, 2, 1)


def _null_space(rows: Floats) -> Floats:
    """(size, free) of rows, each first scaled to 1; what is one unknown alone drops out exactly."""
    rows = rows / np.linalg.norm(rows, axis=1, keepdims=True)
    _, sizes, directions = np.linalg.svd(rows)
    return directions[np.sum(sizes > RANK) :].T


def load_vector(assembly: DrivetrainAssembly, torque: float) -> Floats:
    """(p, free): the output's torque on the free unknowns."""
    return torque / assembly.lever * assembly.basis[:, OUT]
