"""Where a loaded shaft comes to rest on its supports.

The energy of shaft and supports less the work of the loads is a convex function of the displacements; its minimum is found by
Newton's method with the exact Hessian and a line search.  Springs enter by their compliance C with their forces m as unknowns,

    H v + R' m = load,    R v - C m = given,

so a support may be as stiff as it likes, rigid (C = 0) included.  Linear and rigid supports are one step of the same.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.bearings.response import evaluate_response
from drivewright.errors import InputError, SolverError
from drivewright.shafts.assembly import AXIAL, ShaftSystem, refuse_unbalanced, regularisation, seat_couplings
from drivewright.shafts.beam import FREEDOMS

TOLERANCE = 1e-11  # of the residual over the forces at work
MAX_STEPS = 400  # a few as a rule; hundreds where a contact that carries next to nothing is left slowly
PASSES, EVEN = 20, 3.0  # of the scaling of the system, and how near to 1 is near enough
LEFT = 1e-8  # of the forces at work: what a freedom that nothing holds may seem to carry


class ShaftEquilibrium(NamedTuple):
    """The unknowns v, and of every support in the shaft's axes: reaction on the shaft, displacement, tangent stiffness there.

    `hessian` is that of shaft and laws; springs and rigid supports hold by `multipliers` (c,), the forces m of `ShaftSystem`.
    """

    model: ShaftSystem
    unknowns: Floats
    reactions: Floats  # (supports, 5) [N, N m]
    relative: Floats  # (supports, 5) [m, rad]: of the shaft against the ring, or the seat where there is none
    tangent: Floats  # (supports, 5, 5): springs and law together, without the seat
    contact: Floats  # (supports, 5, 5): that of the law alone
    hessian: Floats
    multipliers: Floats
    steps: int

    @property
    def u(self) -> Floats:
        """Displacements (size,) of all nodes, six each, then of the rings."""
        return self.model.basis @ self.unknowns

    def displacement_at(self, position: float) -> Floats:
        """Displacement (x, y) [m] of the shaft at a node."""
        at = FREEDOMS * self.model.beam.node(position)
        return self.u[at : at + 2]

    def slope_at(self, position: float) -> Floats:
        """Slope (x, y) [rad] of the section at a node: of x by z the rotation about y, of y by z that about x turned round."""
        at = FREEDOMS * self.model.beam.node(position)
        return np.array([self.u[at + 4], -self.u[at + 3]])

    @property
    def axial_displacements(self) -> Floats:
        """Displacements (n,) [m] of the nodes along the axis."""
        return self.u[AXIAL : self.model.beam.size : FREEDOMS]


def solve(model: ShaftSystem, force: Floats) -> ShaftEquilibrium:
    """The `ShaftEquilibrium` under the forces (size,) on nodes and rings; SolverError where it is not found."""
    refuse_unbalanced(model, force)
    load = model.basis.T @ force + seat_couplings(model)
    v, held = _first_guess(model, load)
    change, small = v, regularisation(model)
    for step in range(1, MAX_STEPS + 1):
        change, more = _newton_step(model, v, held, load, small)
        share = _step_length(model, (v, held), (change, more), load)
        v, held = v + share * change, held + share * more
        if not np.all(np.isfinite(v)):
            raise InputError(
                "shaft: the shaft or its bearings are so soft that the displacements overflow; check the units of "
                "stiffnesses, diameters and Young's modulus"
            )
        if _is_balanced(model, v, held, load):
            _refuse_pinned(model, load, held)
            return _equilibrium(model, v, held, step)
        _refuse_runaway(model, v)
    raise SolverError(
        f"shaft: no equilibrium after {MAX_STEPS} steps of Newton's method; the last one moved the shaft by "
        f"{1e3 * np.abs((model.basis @ change)[: model.beam.size]).max():.3g} mm. Check the clearances, and whether "
        "the loads are far more than the bearings carry"
    )


def _refuse_pinned(model, load, multipliers):
    """InputError where what nothing holds would have to carry a force."""
    for freedom, held in zip(model.pinned, multipliers[-len(model.pinned) :], strict=True):
        if abs(held) > LEFT * np.abs(load).max(initial=0):
            what = "axial forces" if freedom == AXIAL else "torques"
            raise InputError(
                f"shaft: the {what} on it do not balance: no support carries the remaining "
                f"{held:.6g} {'N' if freedom == AXIAL else 'N·m'}; "
                "a preload by a spring needs a bearing that holds the shaft against it"
            )


def _refuse_runaway(model, v):
    """InputError where bearings under radial load push the whole shaft, or a ring off it, out along the axis; a shaft may stretch."""
    axial = (model.basis @ v)[AXIAL : model.beam.size : FREEDOMS]
    rings = [mount.rows[AXIAL] @ v for mount in model.mounts if AXIAL in mount.ring_freedoms]
    if max(np.abs(axial).min(), np.abs(rings).max(initial=0)) > 10 * model.beam.shaft.length:
        way = "right" if axial.sum() > 0 else "left"
        raise InputError(
            f"shaft: its bearings push it to the {way}, and none of them takes an axial force to the {way}; "
            "reverse one of two (carries), give more preload, or give a bearing an axial_stiffness"
        )


def _responses(model, v):
    """(mount, force, stiffness) of every law at v."""
    for mount in model.mounts:
        if mount.support.law is not None:
            yield mount, *evaluate_response(mount.support.law, mount.rows @ v - mount.support.offset)[1:]


def _gradient(model, v):
    """Gradient of the energy of shaft and laws."""
    gradient = model.linear @ v
    for mount, force, _ in _responses(model, v):
        gradient += mount.rows.T @ force
    return gradient


def _energy_derivatives(model, v):
    """(gradient, Hessian) of the energy of shaft and laws."""
    gradient, hessian = model.linear @ v, model.linear.copy()
    for mount, force, stiffness in _responses(model, v):
        gradient += mount.rows.T @ force
        hessian += mount.rows.T @ stiffness @ mount.rows
    return gradient, hessian


def _newton_step(model, v, held, load, small):
    """Changes of v and of the forces m to the minimum of the quadratic that touches the energy at v.

    What a law does not resist at the moment is held to where it is by a regularisation, `small`, that leaves the equilibrium alone.
    """
    gradient, hessian = _energy_derivatives(model, v)
    off = gradient - load + model.constraints.T @ held
    apart = model.constraints @ v - model.compliance * held - model.given
    solution = solve_saddle_point(hessian + small, model.constraints, model.compliance, -np.concatenate([off, apart]))
    return solution[: model.size], solution[model.size :]


def solve_saddle_point(hessian: Floats, constraints: Floats, compliance: Floats, right: Floats) -> Floats:
    """(size + c, ...): v and m of  H v + R' m = right,  R v - C m = right below; SolverError where rounding makes that singular."""
    whole = np.block([[hessian, constraints.T], [constraints, -np.diag(compliance)]])
    scale = equilibration(whole, len(hessian))
    right = (right.T * scale).T
    try:
        return (np.linalg.solve(scale[:, None] * whole * scale, right).T * scale).T
    except np.linalg.LinAlgError:
        raise SolverError(
            "shaft: the equations of shaft and bearings are singular to rounding; a rolling bearing, a table or a spring behind a "
            "clearance is too stiff relative to the shaft: check the units of diameters and of "
            "Young's modulus; a spring above 1e15 N/m does not differ from rigid"
        ) from None


def equilibration(matrix: Floats, size: int) -> Floats:
    """s (n,) with the largest entry of every row of the symmetric s_i A_ij s_j next to 1: rotations are no lengths, stiff is not soft.

    The first `size` by their diagonal, the constraints below by their rows: a small compliance says nothing of theirs.  Then what is
    left, each pass halving the powers of ten that are off (Ruiz 2001, recalled).
    """
    entries, diagonal = np.abs(matrix), np.abs(np.diag(matrix)).copy()
    diagonal[size:] = 0.0
    scale = 1 / np.sqrt(np.where(diagonal > 0, diagonal, 1.0))
    scale[size:] = 1 / np.maximum((entries[size:, :size] * scale[:size]).max(axis=1), np.sqrt(np.diag(entries)[size:]))
    for _ in range(PASSES):
        rows = scale * (entries * scale).max(axis=1)
        if rows.max() < EVEN and rows.min() > 1 / EVEN:
            break
        scale = scale / np.sqrt(np.where(rows > 0, rows, 1.0))
    return scale


def _first_guess(model, load):
    """(v, m) of the shaft on springs of a usual stiffness in place of the laws."""
    if not model.nonlinear:
        return np.zeros(model.size), np.zeros(len(model.given))
    usual, hessian, pull = np.diag([1e8, 1e8, 1e7, 1e2, 1e2]), model.linear.copy(), load.copy()
    for mount in model.mounts:
        if mount.support.law is not None:
            hessian += mount.rows.T @ usual @ mount.rows
            pull += mount.rows.T @ usual @ mount.support.offset
    solution = solve_saddle_point(hessian, model.constraints, model.compliance, np.concatenate([pull, model.given]))
    return solution[: model.size], solution[model.size :]


def _step_length(model, state, change, load):
    """Share of a step, 1 or less: where the energy along it, a convex function, has lost half of its steepness.

    The springs' part of the slope is m . C dm, which no stiffness magnifies.
    """
    if not model.nonlinear:
        return 1.0
    (v, held), (dv, dm) = state, change

    def slope(share):
        return (_gradient(model, v + share * dv) - load) @ dv + (held + share * dm) @ (model.compliance * dm)

    steepness = slope(0.0)
    if steepness >= 0:
        return 1.0
    low, low_slope, share = 0.0, steepness, 1.0
    high, high_slope = 1.0, None
    for _ in range(40):
        here = slope(share)
        if abs(here) <= 0.5 * abs(steepness) or (here < 0 and share == 1.0):
            return share
        if here < 0:
            low, low_slope = share, here
        else:
            high, high_slope = share, here
        share = low + (high - low) * np.clip(low_slope / (low_slope - high_slope), 0.1, 0.9)
    return share


def _is_balanced(model, v, held, load):
    """Whether the forces balance, to rounding of the largest of them; moments are weighed by the length of the shaft."""
    weigh = np.ones(model.size)
    weigh[: model.beam.size].reshape(-1, FREEDOMS)[:, 3:] = 1 / model.beam.shaft.length
    pull, hessian = _energy_derivatives(model, v)
    springs = model.constraints.T @ held
    left = np.abs(weigh * (pull - load + springs)).max()
    size = np.abs(weigh * load).max(initial=0) + np.abs(weigh * springs).max(initial=0)
    rounding = np.finfo(float).eps * np.abs(weigh * (np.abs(hessian) @ np.abs(v))).max(initial=0)
    return left <= max(TOLERANCE * size, 16 * rounding, 1e-12)


def _equilibrium(model, v, held, steps):
    reactions, relative, tangent, contact = [], [], [], []
    for mount in model.mounts:
        support, sprung = mount.support, mount.sprung
        own, force, law = mount.rows @ v - support.offset, np.zeros(5), np.zeros((5, 5))
        if support.law is not None:
            _, force, law = evaluate_response(support.law, own)
        force, law = force + mount.coupling @ own, law + mount.coupling
        force[sprung] += held[mount.springs]
        own[sprung] = model.compliance[mount.springs] * held[mount.springs]
        law = mount.turn[:, None] * law * mount.turn
        reactions.append(-mount.turn * force)
        relative.append(mount.turn * own)
        tangent.append(np.diag(support.stiffness) + law)
        contact.append(law)
    hessian = _energy_derivatives(model, v)[1]
    return ShaftEquilibrium(model, v, np.array(reactions), np.array(relative), np.array(tangent), np.array(contact), hessian, held, steps)
