"""Equilibria of a batch of elastic systems: Newton's method with a line search on the convex energy, all positions at once.

The energy of y is 1/2 y' A y + sum V_k(R_k y + o_k) - f'y: linear parts A, and laws V_k of strains that depend linearly on y.
"""

from typing import Any, NamedTuple, TypeVar

import numpy as np

from drivewright._typing import Bools, Floats
from drivewright.indexing.stiffness.laws import StrainLaw
from drivewright.numerics.line_search import convex_step_length

DType = TypeVar("DType", bound=np.dtype[Any])
TOLERANCE = 1e-13  # of the residual over the load
ROUNDING = 32 * np.finfo(float).eps
STEP_LIMIT = 200
FLOOR = 1e-13  # of the largest stiffness, under what nothing resists
REGULARISATION = (
    1e-2  # of a usual stiffness, times the residual over the load: far from rest no step runs away, near it all stays quadratic
)


def flatten_rows(rows: np.ndarray[Any, DType]) -> np.ndarray[Any, DType]:
    """(p, n, m): rows (p, ..., m) one below the other, also where p is 0."""
    return rows.reshape(len(rows), int(np.prod(rows.shape[1:-1])), rows.shape[-1])


class ConvexTerm(NamedTuple):
    """Strains rows (p, k, c, m) y + offset (p, k, c) [m], and the law of their force."""

    rows: Floats
    offset: Floats
    law: StrainLaw

    def strain(self, y: Floats) -> Floats:
        """(p, k, c)."""
        return self.displacement(y) + self.offset

    def displacement(self, y: Floats) -> Floats:
        """The part of the strains that follows y: (p, k, c)."""
        return (flatten_rows(self.rows) @ y[:, :, None]).reshape(self.rows.shape[:3])


class ConvexEnergy(NamedTuple):
    """linear (p, m, m) [N/m], non-linear parts, load (p, m) [N]; floor [N]: residual below which a position has settled in any case."""

    linear: Floats
    parts: tuple[ConvexTerm, ...]
    load: Floats
    floor: float = 0.0


class EnergyMinimum(NamedTuple):
    """y (p, m) [m], Hessian there (p, m, m) [N/m], whether Newton's method converged (p,), steps."""

    y: Floats
    hessian: Floats
    converged: Bools
    steps: int


def total_energy(system: ConvexEnergy, y: Floats) -> Floats:
    """(p,) of the elastic parts less the work of the load."""
    total = 0.5 * np.einsum("pi,pij,pj->p", y, system.linear, y) - np.sum(system.load * y, axis=1)
    return total + sum(part.law(part.strain(y))[0].sum(axis=1) for part in system.parts)


def gradient_and_hessian(system: ConvexEnergy, y: Floats) -> tuple[Floats, Floats]:
    """Gradient (p, m) and Hessian (p, m, m) of the energy."""
    gradient, hessian = (system.linear @ y[:, :, None])[:, :, 0] - system.load, system.linear.copy()
    for part in system.parts:
        _, force, stiffness = part.law(part.strain(y))
        across = flatten_rows(part.rows).transpose(0, 2, 1)
        gradient += (across @ flatten_rows(force[..., None]))[:, :, 0]
        hessian += across @ flatten_rows(stiffness @ part.rows)
    return gradient, hessian


def minimise_energy(system: ConvexEnergy, start: Floats, bound: float) -> EnergyMinimum:
    """The `EnergyMinimum` from `start` (p, m), a usual answer; positions that do not settle, or leave |y| < bound, keep their last y."""
    y, scale = start.copy(), np.abs(system.load).max(axis=1)
    regularisation = REGULARISATION / np.abs(start).max(axis=1)
    step = 0
    while True:
        gradient, hessian = gradient_and_hessian(system, y)
        left = np.abs(gradient).max(axis=1)
        noise = ROUNDING * (np.abs(hessian) @ np.abs(y)[:, :, None])[:, :, 0].max(axis=1)
        converged = left <= np.maximum(np.maximum(TOLERANCE * scale, noise), system.floor)
        out_of_bounds = np.abs(y).max(axis=1) > bound
        if step == STEP_LIMIT or (converged | out_of_bounds).all():
            return EnergyMinimum(_polished(y, gradient, hessian, converged), hessian, converged, step)
        change = -solve_regularised(hessian, gradient, FLOOR * largest_stiffness(hessian) + regularisation * np.minimum(left, scale))
        change[converged | out_of_bounds] = 0.0
        y, step = y + _length(system, y, change)[:, None] * change, step + 1


def _polished(y, gradient, hessian, converged):
    """One full step more: the bound on rounding that ended the search is a wide one."""
    return y - converged[:, None] * solve_regularised(hessian, gradient, FLOOR * largest_stiffness(hessian))


def solve_regularised(hessian: Floats, right: Floats, floor: Floats) -> Floats:
    """H^-1 right (p, m), with a stiffness floor (p,) [N/m] on every unknown, so that what nothing resists stays where it is."""
    regular = hessian + floor[:, None, None] * np.eye(right.shape[1])
    return np.asarray(np.linalg.solve(regular, right[:, :, None])[:, :, 0], dtype=float)


def largest_stiffness(hessian: Floats) -> Floats:
    """(p,): the largest stiffness on the diagonal."""
    return np.asarray(np.abs(np.diagonal(hessian, axis1=1, axis2=2)).max(axis=1), dtype=float)


def _length(system: ConvexEnergy, y: Floats, change: Floats) -> Floats:
    """(p,): share of the step, 1 or less, at which the energy along it has lost half of its slope; only the strains are followed."""
    strains = [(part.law, part.strain(y), part.displacement(change)) for part in system.parts]
    pull = (system.linear @ change[:, :, None])[:, :, 0]
    bent, base = np.sum(pull * change, axis=1), np.sum(pull * y, axis=1) - np.sum(system.load * change, axis=1)

    def slope(share: Floats) -> Floats:
        strained = sum(np.sum(law(d + share[:, None, None] * v)[1] * v, axis=(1, 2)) for law, d, v in strains)
        return base + share * bent + strained

    return convex_step_length(slope, len(y))
