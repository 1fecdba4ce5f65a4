"""Flexibility and stiffness at the stations of a shaft, and who contributes what.

delta_ij is the displacement of station i by a unit force at station j, both in one direction across the shaft:
delta_ij = int M_i M_j/EI + int V_i V_j/(kappa G A) + int N_i N_j/EA + sum over the supports of u_i' K u_j (the principle of
virtual work), K being the tangent stiffness of a support and u its displacement.
"""

from typing import NamedTuple

import numpy as np

from drivewright.errors import InputError
from drivewright.shafts import beam as beams
from drivewright.shafts.beam import FREEDOMS
from drivewright.shafts.equilibrium import floor, saddle

FLOOR = 1e-2  # of the solver's trifle under what a law does not resist: it makes the matrix regular and carries nothing
HELD = 1e-3  # part of a flexibility that this trifle may carry: beyond it the shaft is not held


class Flexibility(NamedTuple):
    """All per unit force [1/N]: delta (s, s) [m/N]; its parts (p, s, s) by `names`; reactions (supports, s) against the load [-]."""

    delta: np.ndarray
    names: tuple
    shares: np.ndarray
    reactions: np.ndarray
    displacement: np.ndarray  # (size, s): all unknowns under each unit force

    @property
    def condition(self):
        """Condition number of delta, which is that of the stiffness too."""
        return float(np.linalg.cond(self.delta))


def flexibility(found, positions, direction):
    """The `Flexibility` of a shaft at rest (`found`, an `Equilibrium`) for unit forces along `direction` (x, y) at positions.

    InputError where a station is held by nothing: the bearings are unloaded and have no stiffness.
    """
    model, n = found.model, len(positions)
    unit = np.zeros((model.size, n))
    for column, position in enumerate(positions):
        at = FREEDOMS * model.beam.node(position)
        unit[at : at + 2, column] = direction
    trifle = FLOOR * floor(model)
    answer = _solved(found, trifle, unit)
    u = answer[: model.size]
    delta = unit.T @ u
    if not np.all(np.isfinite(delta)) or np.any(np.sum(u * (trifle @ u), axis=0) > HELD * np.diag(delta)):
        raise InputError("shaft: at rest its bearings do not resist a small force; give a load, a preload or no clearance")
    delta = 0.5 * (delta + delta.T)
    names, shares = _shares(found, answer)
    return Flexibility(delta, names, shares, _reactions(found, answer, direction), u)


def _solved(found, trifle, unit):
    try:
        with np.errstate(all="ignore"):
            return saddle(found.hessian + trifle, found.model.rigid, np.vstack([unit, np.zeros((len(found.model.given), unit.shape[1]))]))
    except np.linalg.LinAlgError:
        return np.full((found.model.size + len(found.model.given), unit.shape[1]), np.inf)


def _shares(found, answer):
    """(names, parts (p, s, s)): bending, shear, tension where there is any, then one for every support."""
    model, u = found.model, answer[: found.model.size]
    bending, shear = np.zeros((2, u.shape[1], u.shape[1]))
    for plane in (0, 1):
        forces = np.array([beams.end_forces(model.beam, plane, column) for column in u.T])  # (s, pieces, 2)
        shear += np.einsum("in,n,jn->ij", forces[:, :, 0], model.beam.slip, forces[:, :, 0])
        bending += np.einsum("ina,nab,jnb->ij", forces, model.beam.flexibility, forces)
    parts = {"bending": bending - shear, "shear": shear}
    for mount, tangent in zip(model.mounts, found.tangent, strict=True):
        felt = mount.turn[:, None] * (mount.rows @ u)
        finite = np.where(np.isfinite(tangent), tangent, 0.0)
        yielded = u[mount.ring]
        seat = np.array([mount.support.seat[i] for i in mount.ring_freedoms])
        parts[mount.support.name] = felt.T @ finite @ felt + yielded.T @ (seat[:, None] * yielded)
    stretched = beams.stretch_energy(model.beam, u)
    if np.abs(stretched).max(initial=0) > 1e-12 * np.abs(bending).max(initial=0):
        parts["tension"] = stretched
    return tuple(parts), np.array(list(parts.values()))


def _reactions(found, answer, direction):
    """(supports, s): force of each support on the shaft against the unit force."""
    model, u, number = found.model, answer[: found.model.size], 0
    rows = []
    for mount, tangent in zip(model.mounts, found.tangent, strict=True):
        felt = mount.turn[:, None] * (mount.rows @ u)
        rigid = np.isinf(np.diag(tangent))
        force = np.where(np.isfinite(tangent), tangent, 0.0) @ felt
        force[rigid] = answer[model.size + number : model.size + number + rigid.sum()]
        number += rigid.sum()
        rows.append(np.asarray(direction) @ force[:2])
    return np.array(rows)


def stiffness(delta, names, limit=1e12):
    """K = inv(delta) [N/m]; InputError naming the station that a rigid bearing holds, or two stations at one place."""
    scale = np.sqrt(np.maximum(np.diag(delta), 0.0))
    for name, size in zip(names, scale, strict=True):
        if not size**2 > 1e-9 * scale.max() ** 2:
            raise InputError(f"station {name!r} stands on a rigid bearing: its flexibility is 0 and the stiffness matrix does not exist")
    if np.linalg.cond(delta / np.outer(scale, scale)) > limit:
        raise InputError(f"the flexibility at {', '.join(map(repr, names))} is singular: two stations move together "
                         "(stand at one place?), so the stiffness matrix does not exist")
    return np.linalg.inv(delta)
