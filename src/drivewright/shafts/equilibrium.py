"""Where a loaded shaft comes to rest on its supports.

The energy of shaft and supports less the work of the loads is a convex function of the displacements; its minimum is found by
Newton's method with the exact Hessian and a line search.  Linear and rigid supports are one step of the same.
"""

from typing import NamedTuple

import numpy as np

from drivewright.bearings.response import respond
from drivewright.errors import InputError, SolverError
from drivewright.shafts.assembly import AXIAL, Model, floor, refuse_unbalanced
from drivewright.shafts.beam import FREEDOMS

TOLERANCE = 1e-11  # of the residual over the forces at work
MAX_STEPS = 400  # a few as a rule; hundreds where a contact that carries next to nothing is left slowly
LEFT = 1e-8  # of the forces at work: what a freedom that nothing holds may seem to carry


class Equilibrium(NamedTuple):
    """The unknowns v, and of every support in the shaft's axes: reaction on the shaft, displacement, tangent stiffness there.

    `hessian` is that of all unknowns; the rigid supports hold by `multipliers` (c,).
    """

    model: Model
    unknowns: np.ndarray
    reactions: np.ndarray  # (supports, 5) [N, N m]
    relative: np.ndarray  # (supports, 5) [m, rad]: of the shaft against the ring, or the seat where there is none
    tangent: np.ndarray  # (supports, 5, 5): springs and law together, without the seat
    hessian: np.ndarray
    multipliers: np.ndarray
    steps: int

    @property
    def u(self):
        """Displacements (size,) of all nodes, six each, then of the rings."""
        return self.model.basis @ self.unknowns


def solve(model, force):
    """The `Equilibrium` under the forces (size,) on nodes and rings; SolverError where it is not found."""
    refuse_unbalanced(model, force)
    load = model.basis.T @ force
    v = _first_guess(model, load)
    for step in range(1, MAX_STEPS + 1):
        gradient, hessian = _pull(model, v)
        change, multipliers = _newton_step(model, v, gradient - load, hessian)
        v = v + _length(model, v, change, gradient - load, load) * change
        if _at_rest(model, v, load, multipliers):
            _refuse_pinned(model, load, multipliers)
            return _equilibrium(model, v, multipliers, step)
        _refuse_runaway(model, v)
    raise SolverError(f"shaft: no equilibrium after {MAX_STEPS} steps of Newton's method; the last one moved the shaft by "
                      f"{1e3 * np.abs((model.basis @ change)[: model.beam.size]).max():.3g} mm. Look at clearances, and for loads far "
                      "beyond the bearings")


def _refuse_pinned(model, load, multipliers):
    """InputError where what nothing holds would have to carry a force."""
    for freedom, held in zip(model.pinned, multipliers[-len(model.pinned) :], strict=True):
        if abs(held) > LEFT * np.abs(load).max(initial=0):
            what = "axial forces" if freedom == AXIAL else "torques"
            raise InputError(
                f"shaft: the {what} on it do not balance: {held:.6g} {'N' if freedom == AXIAL else 'N m'} are left that nothing "
                "takes; a preload by a spring needs a bearing that holds the shaft against it"
            )


def _refuse_runaway(model, v):
    """InputError where bearings under radial load push the shaft, or a ring, out along its axis."""
    axial = (model.basis @ v)[AXIAL : model.beam.size : FREEDOMS]
    rings = [v[at] for mount in model.mounts for at, freedom in zip(mount.ring, mount.ring_freedoms, strict=True) if freedom == AXIAL]
    if max(np.abs(axial).max(), np.abs(rings).max(initial=0)) > 10 * model.beam.shaft.length:
        way = "right" if axial.sum() > 0 else "left"
        raise InputError(f"shaft: its bearings push it to the {way}, and none of them takes an axial force to the {way}; "
                         "turn one of two round (carries), give more preload, or give a bearing an axial_stiffness")


def _pull(model, v):
    """(gradient, Hessian) of the energy of shaft, springs, seats and laws."""
    gradient, hessian = model.linear @ v - model.rest, model.linear.copy()
    for mount in model.mounts:
        if mount.support.law is not None:
            _, force, stiffness = respond(mount.support.law, mount.rows @ v - mount.support.offset)
            gradient += mount.rows.T @ force
            hessian += mount.rows.T @ stiffness @ mount.rows
    return gradient, hessian


def _newton_step(model, v, slope, hessian):
    """(change of v, multipliers) to the minimum of the quadratic that touches the energy at v.

    What a law does not resist at the moment is held to where it is by a trifle that leaves the equilibrium alone.
    """
    found = saddle(hessian + floor(model), model.rigid, np.concatenate([-slope, model.given - model.rigid @ v]))
    return found[: model.size], found[model.size :]


def saddle(hessian, rigid, right):
    """(size + c, ...): v and multipliers m of  H v + R' m = right,  R v = right below;  rows are scaled, for rotations are no lengths."""
    whole = np.block([[hessian, rigid.T], [rigid, np.zeros((len(rigid),) * 2)]])
    size, diagonal = len(hessian), np.abs(np.diag(hessian))
    scale = np.ones(len(whole))
    scale[:size] = 1 / np.sqrt(np.where(diagonal > 0, diagonal, diagonal.max()))
    scale[size:] = 1 / np.maximum(np.abs(rigid * scale[:size]).max(axis=1, initial=0), 1e-300)
    right = (right.T * scale).T
    return (np.linalg.solve(scale[:, None] * whole * scale, right).T * scale).T


def _first_guess(model, load):
    """The shaft on springs of a usual stiffness in place of the laws."""
    if not model.nonlinear:
        return np.zeros(model.size)
    usual, hessian, pull = np.diag([1e8, 1e8, 1e7, 1e2, 1e2]), model.linear.copy(), load + model.rest
    for mount in model.mounts:
        if mount.support.law is not None:
            hessian += mount.rows.T @ usual @ mount.rows
            pull = pull + mount.rows.T @ usual @ mount.support.offset
    return saddle(hessian, model.rigid, np.concatenate([pull, model.given]))[: model.size]


def _length(model, v, change, slope, load):
    """Share of a step, 1 or less: where the energy along it, a convex function, has lost half of its steepness."""
    steepness = slope @ change
    if not model.nonlinear or steepness >= 0:
        return 1.0
    low, low_slope, share = 0.0, steepness, 1.0
    high, high_slope = 1.0, None
    for _ in range(40):
        here = (_pull(model, v + share * change)[0] - load) @ change
        if abs(here) <= 0.5 * abs(steepness) or (here < 0 and share == 1.0):
            return share
        if here < 0:
            low, low_slope = share, here
        else:
            high, high_slope = share, here
        share = low + (high - low) * np.clip(low_slope / (low_slope - high_slope), 0.1, 0.9)
    return share


def _at_rest(model, v, load, multipliers):
    """Whether the forces balance, to rounding of the largest of them; moments are weighed by the length of the shaft."""
    weigh = np.ones(model.size)
    weigh[: model.beam.size].reshape(-1, FREEDOMS)[:, 3:] = 1 / model.beam.shaft.length
    pull, hessian = _pull(model, v)
    left = np.abs(weigh * (pull - load + model.rigid.T @ multipliers)).max()
    size = np.abs(weigh * load).max(initial=0) + np.abs(weigh * model.rest).max(initial=0)
    rounding = np.finfo(float).eps * np.abs(weigh * (np.abs(hessian) @ np.abs(v))).max(initial=0)
    return left <= max(TOLERANCE * size, 16 * rounding, 1e-12)


def _equilibrium(model, v, multipliers, steps):
    relative, tangent, reactions, number = [], [], [], 0
    for mount in model.mounts:
        support = mount.support
        own = mount.rows @ v - support.offset
        stiff = np.array(support.stiffness)
        rigid = np.isinf(stiff)
        springs = np.where(rigid, 0.0, stiff)
        force, stiffness = springs * own, np.diag(stiff)
        if support.law is not None:
            _, extra, slope = respond(support.law, own)
            force, stiffness = force + extra, stiffness + slope
        force[rigid] = multipliers[number : number + rigid.sum()]
        number += rigid.sum()
        reactions.append(-mount.turn * force)
        relative.append(mount.turn * own)
        tangent.append(mount.turn[:, None] * stiffness * mount.turn)
    arrays = (np.array(each) for each in (reactions, relative, tangent))
    return Equilibrium(model, v, *arrays, _pull(model, v)[1], multipliers, steps)
