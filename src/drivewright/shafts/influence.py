"""Flexibility and stiffness at the stations of a shaft, and the contributions of the parts.

delta_ij is the displacement of station i by a unit force at station j, both in one direction across the shaft:
delta_ij = int M_i M_j/EI + int V_i V_j/(kappa G A) + int N_i N_j/EA + sum over the supports of m_i' C m_j + u_i' K u_j (the
principle of virtual work), C and m being compliance and force of a spring, K and u tangent stiffness and displacement of a bearing.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError, SolverError
from drivewright.shafts import beam as beams
from drivewright.shafts.assembly import regularisation
from drivewright.shafts.beam import FREEDOMS
from drivewright.shafts.equilibrium import ShaftEquilibrium, solve_saddle_point

REGULARISATION_FACTOR = (
    1e-2  # of the solver's regularisation under what a law does not resist: it makes the matrix regular and carries nothing
)
ROUNDING = 1e-12
MAX_REGULARISED_SHARE = 1e-3  # part of a flexibility that this regularisation may carry: beyond it the shaft is not held


class Flexibility(NamedTuple):
    """All per unit force [1/N]: delta (s, s) [m/N]; its parts (p, s, s) by `names`; reactions (supports, s) against the load [-].

    support_forces (supports, 5, s): what the shaft exerts on the supports [N/N, N m/N].
    """

    delta: Floats
    names: tuple[str, ...]
    shares: Floats
    reactions: Floats
    support_forces: Floats
    unknowns: Floats  # (size, s): under each unit force

    @property
    def condition(self) -> float:
        """Condition number of delta, which is that of the stiffness too."""
        return float(np.linalg.cond(self.delta))


def flexibility(equilibrium: ShaftEquilibrium, positions: Sequence[float], direction: ArrayLike) -> Flexibility:
    """The `Flexibility` of a shaft at rest for unit forces along `direction` (x, y) at positions.

    InputError where a station is held by nothing: the bearings are unloaded and have no stiffness.
    """
    model, n = equilibrium.model, len(positions)
    unit = np.zeros((model.size, n))
    for column, position in enumerate(positions):
        at = FREEDOMS * model.beam.node(position)
        unit[at : at + 2, column] = direction
    unit = model.basis.T @ unit
    small = REGULARISATION_FACTOR * regularisation(model)
    answer = _solve_unit_loads(equilibrium, small, unit)
    v = answer[: model.size]
    delta = unit.T @ v
    if np.array_equal(equilibrium.hessian, equilibrium.hessian.T):  # not on cross-coupled supports
        delta = 0.5 * (delta + delta.T)
    size = np.abs(delta).max(initial=0)
    with np.errstate(invalid="ignore"):
        carried = np.sum(v * (small @ v), axis=0)
    if not np.all(np.isfinite(delta)) or np.any(carried > MAX_REGULARISED_SHARE * (np.abs(np.diag(delta)) + ROUNDING * size)):
        raise InputError("shaft: at rest its bearings do not resist a small force; give a load, a preload or no clearance")
    names, shares = _shares(equilibrium, v, answer[model.size :])
    pressed = _support_forces(equilibrium, v, answer[model.size :])
    return Flexibility(delta, names, shares, np.einsum("f,pfs->ps", np.asarray(direction, float), pressed[:, :2]), pressed, v)


def _solve_unit_loads(equilibrium, small, unit):
    try:
        with np.errstate(all="ignore"):
            below = np.zeros((len(equilibrium.model.given), unit.shape[1]))
            return solve_saddle_point(
                equilibrium.hessian + small, equilibrium.model.constraints, equilibrium.model.compliance, np.vstack([unit, below])
            )
    except SolverError:
        return np.full((equilibrium.model.size + len(equilibrium.model.given), unit.shape[1]), np.inf)


def _shares(equilibrium, v, held):
    """(names, parts (p, s, s)): bending, shear, tension where there is any, then one for every support."""
    model = equilibrium.model
    bending, shear = np.zeros((2, v.shape[1], v.shape[1]))
    for plane in (0, 1):
        forces = np.array([beams.end_forces(model.beam, plane, column) for column in v.T])  # (s, pieces, 2)
        shear += np.einsum("in,n,jn->ij", forces[:, :, 0], model.beam.slip, forces[:, :, 0])
        bending += np.einsum("ina,nab,jnb->ij", forces, model.beam.flexibility, forces)
    names, parts = ["bending", "shear"], [bending - shear, shear]
    stretched = beams.stretch_energy(model.beam, v)
    if np.abs(stretched).max(initial=0) > ROUNDING * np.abs(bending).max(initial=0):
        names, parts = [*names, "tension"], [*parts, stretched]
    for mount, contact in zip(model.mounts, equilibrium.contact, strict=True):
        felt, own = mount.turn[:, None] * (mount.rows @ v), slice(mount.first, mount.seat.stop)
        names.append(mount.support.name)
        parts.append(felt.T @ contact @ felt + held[own].T @ (model.compliance[own, None] * held[own]))
    return tuple(names), np.array(parts)


def _support_forces(equilibrium, v, held):
    """(supports, 5, s): what the shaft exerts on each support, in the shaft's axes."""
    rows = []
    for mount, contact in zip(equilibrium.model.mounts, equilibrium.contact, strict=True):
        force = contact @ (mount.turn[:, None] * (mount.rows @ v))
        force[mount.sprung] += mount.turn[mount.sprung, None] * held[mount.springs]
        rows.append(force)
    return np.array(rows)


def stiffness(delta: Floats, names: Sequence[str], limit: float = 1e12) -> Floats:
    """K = inv(delta) [N/m]; InputError naming the station that a rigid bearing holds, or two stations at one place."""
    scale = np.sqrt(np.maximum(np.diag(delta), 0.0))
    for name, size in zip(names, scale, strict=True):
        if not size**2 > 1e-9 * scale.max() ** 2:
            raise InputError(f"station {name!r} stands on a rigid bearing: its flexibility is 0 and the stiffness matrix does not exist")
    if np.linalg.cond(delta / np.outer(scale, scale)) > limit:
        raise InputError(
            f"the flexibility at {', '.join(map(repr, names))} is singular: two stations move together "
            "(stand at one place?), so the stiffness matrix does not exist"
        )
    return np.asarray(np.linalg.inv(delta), dtype=float)
