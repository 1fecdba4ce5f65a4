"""Natural frequencies and critical speeds: consistent mass with the shapes that the exact elements have at rest."""

from typing import NamedTuple

import numpy as np
import scipy

from drivewright._typing import Floats, Ints
from drivewright.errors import InputError
from drivewright.shafts import beam as beams
from drivewright.shafts.assembly import AXIAL, REGULARISATION, TWIST, regularisation
from drivewright.shafts.beam import FREEDOMS, PLANES, Beam
from drivewright.shafts.equilibrium import ShaftEquilibrium, equilibration, solve_saddle_point
from drivewright.shafts.influence import MAX_REGULARISED_SHARE, REGULARISATION_FACTOR
from drivewright.shafts.sections import area, second_moment

UNHELD = (
    "shaft: at rest its bearings do not resist a small motion, so it has no natural frequencies; give a load, a preload or no clearance"
)
NEGLIGIBLE = 1e-12  # of the greatest 1/w^2: below it is rounding
ROUND = 1e-9  # of a stiffness: what two planes may differ by
POINTS = 8  # over an element: its shapes are cubic on a cylinder
SHARE, WEIGHT = (0.5 * (part + shift) for part, shift in zip(np.polynomial.legendre.leggauss(POINTS), (1.0, 0.0), strict=True))


class Modes(NamedTuple):
    """Natural frequencies [Hz] (m,), rising, and shapes (size, m)."""

    frequencies: Floats
    shapes: Floats

    def select(self, chosen: slice | Ints) -> "Modes":
        """Some of them."""
        return Modes(self.frequencies[chosen], self.shapes[:, chosen])


class CriticalSpeeds(NamedTuple):
    """Speeds [rad/s] at which the unbalance meets a natural frequency, whirling with the shaft or against it."""

    forward: Floats
    backward: Floats


def element_shapes(beam: Beam) -> tuple[Floats, Floats]:
    """Deflection (n, p, 4) and slope (n, p, 4) at p places in every piece by unit displacements (w1, t1, w2, t2) of its ends."""
    length = beam.pieces[:, 0]
    forces = np.linalg.solve(beam.flexibility, beams.strain_matrix(length))  # (n, 2, 4) at the end
    x = length[:, None] * SHARE
    part = beam.pieces[:, None, :].repeat(POINTS, axis=1)
    part[:, :, 0], part[:, :, 2] = x, part[:, :, 1] + (part[:, :, 2] - part[:, :, 1]) * SHARE
    flexibility, _ = beams.clamped_flexibility(part.reshape(-1, 4), beam.shaft)
    flexibility = flexibility.reshape(*x.shape, 2, 2)
    force = forces[:, None, 0, :].repeat(POINTS, axis=1)
    moment = force * (length[:, None] - x)[:, :, None] + forces[:, None, 1, :]
    bent = np.einsum("npab,bnpk->anpk", flexibility, np.stack([force, moment]))
    start = np.eye(4)
    return bent[0] + start[0] + x[:, :, None] * start[1], bent[1] + start[1]


def mass_matrices(beam: Beam, rotary: bool = True) -> tuple[Floats, Floats]:
    """(M (6n, 6n), G (6n, 6n)): consistent mass of the shaft with its stations, and polar moments of inertia that couple the tilts.

    At the speed s of the shaft the gyroscopic moments are  s G q',  G skew.
    """
    whole, gyroscopic = np.zeros((beam.size,) * 2), np.zeros((beam.size,) * 2)
    deflection, slope = element_shapes(beam)
    length, start, end, bore = beam.pieces.T[:, :, None]
    diameter, density = start + (end - start) * SHARE, beam.shaft.density
    per_length = density * area(diameter, bore) * WEIGHT * length
    diametral = density * second_moment(diameter, bore) * WEIGHT * length
    lateral = np.einsum("np,npi,npj->nij", per_length, deflection, deflection)
    turning = np.einsum("np,npi,npj->nij", diametral, slope, slope)
    rods = np.array([[1 - SHARE, SHARE]])[0]
    for e in range(len(beam.pieces)):
        places = [beams.element_freedoms(e, plane) for plane in (0, 1)]
        for at, sign in places:
            whole[np.ix_(at, at)] += sign[:, None] * (lateral[e] + rotary * turning[e]) * sign
        _couple(gyroscopic, places, 2 * turning[e] * rotary)
        for freedom, spread in ((2, per_length[e]), (5, 2 * diametral[e])):
            at = FREEDOMS * e + freedom + np.array([0, FREEDOMS])
            whole[np.ix_(at, at)] += np.einsum("p,ip,jp->ij", spread, rods, rods)
    _add_stations(beam, whole, gyroscopic)
    return whole, gyroscopic


def _couple(gyroscopic, places, polar):
    """Gyroscopic moments of an element: about y +I_p s tilt_x' and about x -I_p s tilt_y', on the left side of the equation."""
    (at_x, sign_x), (at_y, sign_y) = places
    block = sign_x[:, None] * polar * sign_y
    gyroscopic[np.ix_(at_x, at_y)] += block
    gyroscopic[np.ix_(at_y, at_x)] -= block.T


def _add_stations(beam, whole, gyroscopic):
    for station in beam.shaft.masses:
        at = FREEDOMS * beam.node(station.position)
        whole[range(at, at + 3), range(at, at + 3)] += station.mass
        whole[range(at + 3, at + 6), range(at + 3, at + 6)] += (station.diametral, station.diametral, station.polar)
        gyroscopic[at + 4, at + 3] -= station.polar
        gyroscopic[at + 3, at + 4] += station.polar


def is_isotropic(equilibrium: ShaftEquilibrium) -> bool:
    """Whether the supports are the same in both planes, which then do not feel each other: by the symmetric part of their stiffness.

    Each stiffness is held against its own kind: one that is stiff along the axis, or against tilting, hides no other.
    """
    for mount, whole in zip(equilibrium.model.mounts, equilibrium.tangent, strict=True):
        tangent = symmetric_part(whole)
        size = np.sqrt(np.maximum(np.diag(tangent), np.diag(REGULARISATION)))
        cross = np.abs(np.where(np.eye(5, dtype=bool), 0.0, tangent))
        if mount.ring_freedoms or np.any(cross > ROUND * np.outer(size, size)):
            return False
        if not np.allclose(size[[0, 3]] ** 2, size[[1, 4]] ** 2, rtol=ROUND, atol=0.0):
            return False
    return True


def symmetric_part(matrix: Floats) -> Floats:
    """(A + A')/2: of a stiffness the part that has an energy; the other, of a cross-coupled support, feeds a whirl or takes from it."""
    return 0.5 * (matrix + matrix.T)


def plane_freedoms(beam: Beam, plane: int = 1) -> Ints:
    """Numbers of the freedoms of a plane: deflection and slope of every node."""
    w, t, _ = PLANES[plane]
    return np.sort(np.concatenate([FREEDOMS * np.arange(len(beam.z)) + w, FREEDOMS * np.arange(len(beam.z)) + t]))


def condense_supports(stiff: Floats, constraints: Floats, compliance: Floats) -> tuple[Floats, Floats]:
    """(basis (n, r), K (r, r)): shapes that the rigid supports allow, and the stiffness of the supported shaft on them.

    Shapes with all supports held, and for every spring the shape P that the shaft takes when it alone gives way: between the two
    there is no stiffness, so K is N'HN beside P'HP + 1/C (Craig & Bampton 1968, recalled).  The latter are scaled to 1 on the diagonal.
    """
    rows = np.abs(constraints).max(axis=1, initial=0) > 0
    constraints, compliance = constraints[rows], compliance[rows]
    scale = equilibration(np.block([[stiff, constraints.T], [constraints, np.zeros((len(constraints),) * 2)]]), len(stiff))[: len(stiff)]
    held = scale[:, None] * _null_space(constraints * scale)
    yields = np.flatnonzero(compliance)
    unit = np.eye(len(stiff) + len(constraints))[:, len(stiff) + yields]
    shapes = solve_saddle_point(stiff, constraints, 0 * compliance, unit)[: len(stiff)]
    own = shapes.T @ stiff @ shapes
    least = np.sqrt(compliance[yields] / (1 + compliance[yields] * np.diag(own)))
    yielding = least[:, None] * own * least + np.diag(1 / (1 + compliance[yields] * np.diag(own)))
    return np.hstack([held, shapes * least]), np.asarray(scipy.linalg.block_diag(held.T @ stiff @ held, yielding))


def _null_space(rows):
    """Orthonormal basis (n, r) of what no row (c, n) sees; rows are linearly independent."""
    rows = rows / np.abs(rows).max(axis=1, keepdims=True)
    return np.linalg.svd(rows)[2][len(rows) :].T if len(rows) else np.eye(rows.shape[1])


def modes(equilibrium: ShaftEquilibrium, count: int) -> tuple[Modes, Modes]:
    """(bending, axial): the lowest `Modes` at rest, distinguished by where most of the mass moves.

    Bending in one plane where the supports are round: every mode comes twice then.  A shaft that nothing holds along its axis has no
    axial modes.
    """
    stiff, inertia, _, chosen = lateral_system(equilibrium)
    candidates = _modes(equilibrium, stiff, inertia, chosen, 2 * count + 2)
    if is_isotropic(equilibrium):
        along = FREEDOMS * np.arange(len(equilibrium.model.beam.z)) + AXIAL
        free = AXIAL in equilibrium.model.pinned
        axial = candidates.select(slice(0, 0)) if free else _modes(equilibrium, stiff, inertia, along, count)
        bending = candidates.select(slice(0, count))
    else:
        along = _axial_share(candidates.shapes, inertia) > 0.5
        bending, axial = candidates.select(np.flatnonzero(~along)[:count]), candidates.select(np.flatnonzero(along)[:count])
    basis = equilibrium.model.basis
    return Modes(bending.frequencies, basis @ bending.shapes), Modes(axial.frequencies, basis @ axial.shapes)


def _modes(equilibrium, stiff, inertia, chosen, count):
    values, vectors = _lowest(stiff, inertia, equilibrium, chosen, count)
    whole = np.zeros((equilibrium.model.size, len(values)))
    whole[chosen] = vectors
    return Modes(np.sqrt(np.maximum(values, 0.0)) / (2 * np.pi), whole)


def _axial_share(shapes, inertia):
    """Part of the kinetic energy along the axis, for each column."""
    moved = inertia @ shapes
    along = np.arange(len(shapes)) % FREEDOMS == AXIAL  # rings, beyond the nodes, have no mass
    parts = (np.conj(shapes) * moved).real
    return np.sum(parts[along], axis=0) / np.sum(parts, axis=0)


def lateral_system(equilibrium: ShaftEquilibrium) -> tuple[Floats, Floats, Floats, Ints]:
    """(K, M, G, numbers of the freedoms) of the vibration across the shaft, K the symmetric part; rings have no mass of their own."""
    model = equilibrium.model
    beam = model.beam
    small, gyro = mass_matrices(beam, beam.shaft.has_rotary_inertia)
    inertia, gyroscopic = np.zeros((model.size,) * 2), np.zeros((model.size,) * 2)
    inertia[: beam.size, : beam.size], gyroscopic[: beam.size, : beam.size] = small, gyro
    inertia, gyroscopic = (model.basis.T @ whole @ model.basis for whole in (inertia, gyroscopic))
    twist = FREEDOMS * np.arange(len(beam.z)) + TWIST
    left_out = np.concatenate([twist, FREEDOMS * np.arange(len(beam.z)) + AXIAL]) if AXIAL in model.pinned else twist
    chosen = plane_freedoms(beam) if is_isotropic(equilibrium) else np.setdiff1d(np.arange(model.size), left_out)
    return symmetric_part(equilibrium.hessian), inertia, gyroscopic, chosen


def _lowest(stiff, inertia, equilibrium, chosen, count):
    """Lowest eigenvalues w^2 of K q = w^2 M q among the chosen freedoms, and vectors; rigid supports hold.

    The regularisation keeps K regular.  What it alone holds has no frequency: along the axis it is left out, across it is an error.
    """
    model = equilibrium.model
    small = (REGULARISATION_FACTOR * regularisation(model))[np.ix_(chosen, chosen)]
    basis, k = condense_supports(stiff[np.ix_(chosen, chosen)] + small, model.constraints[:, chosen], model.compliance)
    # M may be singular (massless rings, no rotary inertia) or indefinite, K is positive
    inverse, vectors = _eigen(basis.T @ inertia[np.ix_(chosen, chosen)] @ basis, k)
    vectors = basis @ vectors  # q'Kq = 1 for each
    held = np.sum(np.conj(vectors) * (small @ vectors), axis=0).real < MAX_REGULARISED_SHARE
    moving = inverse > 1e-9 * inverse[held].max(initial=0)
    nodes = (equilibrium.model.basis[:, chosen] @ vectors)[: equilibrium.model.beam.size].reshape(-1, FREEDOMS, len(inverse))
    sideways = np.sum(np.abs(nodes[:, :2]) ** 2, axis=(0, 1)) > np.sum(np.abs(nodes[:, AXIAL]) ** 2, axis=0)
    if not held.any() or np.any(~held & moving & sideways):
        raise InputError(UNHELD)
    least = NEGLIGIBLE * max(inverse[held].max(), 0.1 * _rounded(basis, inertia[np.ix_(chosen, chosen)], k))
    order = np.argsort(inverse)[::-1]
    order = order[(held & (inverse > least))[order]][:count]
    return 1 / inverse[order], vectors[:, order]


def _rounded(basis, inertia, k):
    """The largest 1/w^2 that a shape could have were the parts of its motion not to cancel: where rounding comes from."""
    parts = np.abs(basis)
    return float(np.max(np.sum(parts * (np.abs(inertia) @ parts), axis=0) / np.diag(k), initial=0.0))


def _eigen(m, k):
    """(1/w^2, vectors with q'Kq = 1)."""
    try:
        return scipy.linalg.eigh(m, k)
    except np.linalg.LinAlgError:
        raise InputError(UNHELD) from None


def critical_speeds(equilibrium: ShaftEquilibrium, count: int) -> CriticalSpeeds:
    """The lowest `CriticalSpeeds`: the gyroscopic moments s G q' of a whirl at the speed s act like a mass.

    Round supports: K z = s^2 (M -+ P) z for z = x + iy, P the polar moments of inertia.  Others: q = phi e^(i s t) in space,
    K phi = s^2 (M - i G) phi; a whirl that is a line counts as one with the shaft.
    """
    stiff, inertia, gyroscopic, chosen = lateral_system(equilibrium)
    if is_isotropic(equilibrium):
        polar = polar_moments(equilibrium, gyroscopic)
        x = plane_freedoms(equilibrium.model.beam, 0)
        return CriticalSpeeds(*(np.sqrt(_lowest(stiff, inertia - way * polar, equilibrium, x, count)[0]) for way in (1, -1)))
    squares, vectors = _lowest(stiff, inertia - 1j * gyroscopic, equilibrium, chosen, 4 * count)
    whole = np.zeros((equilibrium.model.size, len(squares)), complex)
    whole[chosen] = vectors
    nodes = (equilibrium.model.basis @ whole)[: equilibrium.model.beam.size].reshape(-1, FREEDOMS, len(squares))
    lateral, across = _axial_share(whole, inertia) < 0.5, np.sum(np.abs(nodes[:, :2]) ** 2, axis=(0, 1))
    backward = np.sum(np.conj(nodes[:, 0]) * nodes[:, 1], axis=0).imag > 1e-9 * across
    return CriticalSpeeds(*(np.sqrt(squares[lateral & (backward == way)][:count]) for way in (False, True)))


def lowest_excited(equilibrium: ShaftEquilibrium, critical: CriticalSpeeds) -> float | None:
    """The lowest critical speed [rad/s] that an unbalance excites; None where there is none.

    The unbalance turns with the shaft: on round supports it does no work on a whirl against it, on others it does.
    """
    speeds = critical.forward if is_isotropic(equilibrium) else np.concatenate([critical.forward, critical.backward])
    return float(speeds.min()) if len(speeds) else None


def polar_moments(equilibrium: ShaftEquilibrium, gyroscopic: Floats) -> Floats:
    """P of z = x + iy among the freedoms of the plane of x: the gyroscopic moments couple it with that of y."""
    x, y = (plane_freedoms(equilibrium.model.beam, plane) for plane in (0, 1))
    polar = np.zeros_like(gyroscopic)
    polar[np.ix_(x, x)] = gyroscopic[np.ix_(x, y)] * np.where(np.isin(y % FREEDOMS, 3), -1.0, 1.0)  # tilt_x is the slope in y turned round
    return polar


def torsional_modes(equilibrium: ShaftEquilibrium, count: int) -> Modes:
    """The lowest torsional `Modes` of the free shaft, with the moments of inertia of its stations.

    The turning of the whole shaft is taken out, M - m m'/I with I = sum of all inertia, so a massless shaft with inertias on it is
    no special case: as many modes as inertias, less one.
    """
    beam = equilibrium.model.beam
    chosen = FREEDOMS * np.arange(len(beam.z)) + TWIST
    carried = beams.displacement_basis(beam)[np.ix_(chosen, chosen)]
    inertia = carried.T @ mass_matrices(beam)[0][np.ix_(chosen, chosen)] @ carried
    stiff, whole = beams.stiffness(beam)[np.ix_(chosen, chosen)][1:, 1:], np.zeros((equilibrium.model.size, 0))
    if not inertia[0, 0] > 0:
        return Modes(np.zeros(0), whole)
    mixed = inertia[0, 1:] / inertia[0, 0]
    inverse, vectors = scipy.linalg.eigh(inertia[1:, 1:] - np.outer(mixed, inertia[0, 1:]), stiff)
    lowest = np.argsort(inverse)[::-1][:count]
    lowest = lowest[inverse[lowest] > NEGLIGIBLE * (np.diag(inertia)[1:] / np.diag(stiff)).sum()]
    whole = np.zeros((equilibrium.model.size, len(lowest)))
    whole[chosen] = carried @ np.vstack([-mixed @ vectors[:, lowest], vectors[:, lowest]])
    return Modes(1 / np.sqrt(inverse[lowest]) / (2 * np.pi), whole)
