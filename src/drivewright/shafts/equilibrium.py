"""Where a loaded shaft comes to rest on its supports.

The energy of shaft and supports less the work of the loads is a convex function of the displacements; its minimum is found by
Newton's method with the exact Hessian and a line search.  Linear and rigid supports are one step of the same.
"""

from typing import NamedTuple

import numpy as np

from drivewright.bearings.response import respond
from drivewright.errors import InputError, SolverError
from drivewright.shafts import beam as beams
from drivewright.shafts.beam import FREEDOMS

MIRROR = np.array([1.0, 1.0, -1.0, -1.0, -1.0])
SHAFT_FREEDOMS = (0, 1, 2, 3, 4)  # of a node, that a support feels: x, y, z, rotations about x and y
AXIAL, TWIST = 2, 5
TOLERANCE = 1e-11  # of the residual over the forces at work
FLOOR = np.diag([1.0, 1.0, 1.0, 1e-4, 1e-4])  # N/m, N m/rad, against the last step: a ring that nothing holds stays where it is
MAX_STEPS = 100


class Mount(NamedTuple):
    """A support in the unknowns: rows (5, size) of the displacement that its springs and its law feel, in its own axes."""

    support: object
    rows: np.ndarray
    ring: np.ndarray  # unknowns of the ring on a seat that yields (at most 5), in the order of `ring_freedoms`
    ring_freedoms: tuple

    @property
    def turn(self):
        """Signs (5,) from the support's axes to the shaft's."""
        return MIRROR if self.support.mirrored else np.ones(5)


class Model(NamedTuple):
    """Beam and mounts; unknowns: nodes, then rings.  Shaft, springs and seats pull with the forces linear u - rest.

    The combinations `rigid` (c, size) of the unknowns have the values `given` (c,).
    """

    beam: object
    mounts: tuple
    linear: np.ndarray
    rest: np.ndarray
    rigid: np.ndarray
    given: np.ndarray

    @property
    def size(self):
        return len(self.linear)

    @property
    def nonlinear(self):
        return any(mount.support.law is not None for mount in self.mounts)


class Equilibrium(NamedTuple):
    """The unknowns u, and of every support in the shaft's axes: reaction on the shaft, displacement, tangent stiffness there.

    `hessian` is that of all unknowns; the rigid supports hold by `multipliers` (c,).
    """

    model: Model
    u: np.ndarray
    reactions: np.ndarray  # (supports, 5) [N, N m]
    relative: np.ndarray  # (supports, 5) [m, rad]: of the shaft against its seat
    tangent: np.ndarray  # (supports, 5, 5): springs and law together, without the seat
    hessian: np.ndarray
    multipliers: np.ndarray
    steps: int


def assemble(shaft, places=()):
    """The `Model` of a shaft with nodes also at `places`; InputError where the supports leave it free to move sideways."""
    found = beams.beam(shaft, places)
    refuse_mechanism(shaft)
    size = found.size + sum(len(_yielding(support)) for support in shaft.supports)
    linear, rest = np.zeros((size, size)), np.zeros(size)
    linear[: found.size, : found.size] = beams.stiffness(found)
    mounts, rigid, given, start = [], [], [], found.size
    for support in shaft.supports:
        mount = _mount(found, support, size, start)
        start += len(mount.ring)
        mounts.append(mount)
        for row, stiff, value in zip(mount.rows, support.stiffness, support.offset, strict=True):
            if np.isinf(stiff):
                rigid.append(row)
                given.append(value)
            else:
                linear += stiff * np.outer(row, row)
                rest += stiff * value * row
        linear[mount.ring, mount.ring] += [support.seat[i] for i in mount.ring_freedoms]
    free = not any(carries_axially(support, way) for support in shaft.supports for way in (1, -1))
    for freedom in (AXIAL, TWIST) if free else (TWIST,):
        rigid.append(np.eye(1, size, freedom)[0])
        given.append(0.0)
    return Model(found, tuple(mounts), linear, rest, np.array(rigid), np.array(given))


def _yielding(support):
    """The freedoms of its ring: where the seat yields, unless it slides freely under a bearing that does not resist either."""
    return tuple(i for i in range(5) if np.isfinite(support.seat[i]) and (support.seat[i] > 0 or _holds(support, i)))


def _holds(support, freedom):
    if support.stiffness[freedom] > 0:
        return True
    far = 1e-3 if freedom <= AXIAL else 0.05
    return support.law is not None and any(_resists(support.law, freedom, way * far) for way in (1, -1))


def _mount(found, support, size, start):
    """x, y averaged over the support's width, z and the tilts at its middle; less the ring's where the seat yields."""
    rows, node, freedoms = np.zeros((5, size)), found.node(support.position), _yielding(support)
    rows[range(5), FREEDOMS * node + np.array(SHAFT_FREEDOMS)] = 1.0
    if support.width:
        ends = support.position - support.width / 2, support.position + support.width / 2
        for plane in (0, 1):
            rows[plane, : found.size] = beams.nodal(found, plane, beams.uniform(found, *ends, 1 / support.width))
    rows *= (MIRROR if support.mirrored else np.ones(5))[:, None]
    ring = start + np.arange(len(freedoms))
    rows[list(freedoms), ring] -= 1.0
    return Mount(support, rows, ring, freedoms)


def refuse_mechanism(shaft):
    """InputError unless the supports hold the shaft sideways and against tilting."""
    held = []
    for support in shaft.supports:
        real = support.law is not None
        if real or support.stiffness[1] > 0:
            held.append((1.0, support.position / shaft.length))
        if support.stiffness[3] > 0 or (real and support.seat[3] > 0 and _resists(support.law, 3, 0.05)):
            held.append((0.0, 1.0))
    if np.linalg.matrix_rank(np.array(held).reshape(-1, 2), tol=1e-9) < 2:
        names = ", ".join(repr(support.name) for support in shaft.supports) or "none"
        raise InputError(f"shaft: its bearings ({names}) leave it free to swing: a mechanism, not a beam. "
                         "Give it a second bearing at another place, or a tilt_stiffness to the one it has")


def carries_axially(support, way):
    """Whether a support can take a force on the shaft to the right (way +1) or to the left (-1)."""
    if support.stiffness[AXIAL] > 0:
        return True
    own_way = -way if support.mirrored else way
    return support.law is not None and support.seat[AXIAL] > 0 and _resists(support.law, AXIAL, 1e-3 * own_way)


def _resists(law, freedom, amount):
    """Whether a law resists a large displacement in one freedom alone."""
    displacement = np.zeros(5)
    displacement[freedom] = amount
    return bool(abs(respond(law, displacement)[1][freedom]) > 0)


# -- loads ---------------------------------------------------------------------------------------------------------------------


def work(model, loads):
    """(size,) the forces on the unknowns by point loads, and by the pushes on the rings."""
    total = np.zeros(model.size)
    for load in loads:
        at = FREEDOMS * model.beam.node(load.position)
        total[at : at + FREEDOMS] += (*load.force, *load.moment)
    for mount in model.mounts:
        total[mount.ring] += [mount.support.push[i] for i in mount.ring_freedoms]
    return total


def refuse_unbalanced(model, force):
    """InputError where a load drives what nothing holds: the shaft along its axis, or its turning."""
    nodes = force[: model.beam.size].reshape(-1, FREEDOMS)
    axial, torque = nodes[:, AXIAL].sum(), nodes[:, TWIST].sum()
    way = np.sign(axial)
    if abs(axial) > 1e-9 * np.abs(nodes[:, :3]).sum() and not any(carries_axially(m.support, way) for m in model.mounts):
        raise InputError(f"shaft: an axial force of {axial:.6g} N, and no bearing that takes a force to the "
                         f"{'right' if way > 0 else 'left'}; give a bearing an axial_stiffness, or turn a real one round (carries)")
    if abs(torque) > 1e-9 * np.abs(nodes[:, TWIST]).sum():
        raise InputError(f"shaft: the torques do not balance: their sum is {torque:.6g} N m; add the torque of the driven or driving end")


# -- solution ------------------------------------------------------------------------------------------------------------------


def solve(model, force):
    """The `Equilibrium` under the forces (size,) on the unknowns; SolverError where it is not found."""
    refuse_unbalanced(model, force)
    u = _first_guess(model, force)
    for step in range(1, MAX_STEPS + 1):
        gradient, hessian = _pull(model, u)
        change, multipliers = _newton_step(model, u, gradient - force, hessian)
        u = u + _length(model, u, change, gradient - force, force) * change
        if _at_rest(model, u, force, multipliers):
            return _equilibrium(model, u, multipliers, step)
        _refuse_runaway(model, u)
    raise SolverError(f"shaft: no equilibrium after {MAX_STEPS} steps of Newton's method; the last one moved the shaft by "
                      f"{1e3 * np.abs(change[: model.beam.size]).max():.3g} mm. Look at clearances, and for loads far beyond the bearings")


def _refuse_runaway(model, u):
    """InputError where bearings under radial load push the shaft out along its axis."""
    axial = u[AXIAL : model.beam.size : FREEDOMS]
    if np.abs(axial).max() > 10 * model.beam.shaft.length:
        way = "right" if axial.sum() > 0 else "left"
        raise InputError(f"shaft: its bearings push it to the {way}, and none of them takes an axial force to the {way}; "
                         "turn one of two round (carries), or give a bearing an axial_stiffness")


def _pull(model, u):
    """(gradient, Hessian) of the energy of shaft, springs, seats and laws."""
    gradient, hessian = model.linear @ u - model.rest, model.linear.copy()
    for mount in model.mounts:
        if mount.support.law is not None:
            _, force, stiffness = respond(mount.support.law, mount.rows @ u - mount.support.offset)
            gradient += mount.rows.T @ force
            hessian += mount.rows.T @ stiffness @ mount.rows
    return gradient, hessian


def _newton_step(model, u, slope, hessian):
    """(change of u, multipliers) to the minimum of the quadratic that touches the energy at u.

    What a law does not resist at the moment is held to where it is by a trifle, `FLOOR`, that leaves the equilibrium alone.
    """
    found = saddle(hessian + floor(model), model.rigid, np.concatenate([-slope, model.given - model.rigid @ u]))
    return found[: model.size], found[model.size :]


def floor(model):
    """(size, size): the trifle `FLOOR` under every law and every ring."""
    total = np.zeros((model.size, model.size))
    for mount in model.mounts:
        if mount.support.law is not None:
            total += mount.rows.T @ FLOOR @ mount.rows
        total[mount.ring, mount.ring] += [FLOOR[i, i] for i in mount.ring_freedoms]
    return total


def saddle(hessian, rigid, right):
    """(size + c, ...): u and multipliers of  H u + R' m = right,  R u = right below;  rows are scaled, for rotations are no lengths."""
    whole = np.block([[hessian, rigid.T], [rigid, np.zeros((len(rigid),) * 2)]])
    scale = 1 / np.sqrt(np.concatenate([np.abs(np.diag(hessian)), np.ones(len(rigid))]))
    size = len(hessian)
    scale[size:] = 1 / np.maximum(np.abs(rigid * scale[:size]).max(axis=1, initial=0), 1e-300)
    right = (right.T * scale).T
    return (np.linalg.solve(scale[:, None] * whole * scale, right).T * scale).T


def _first_guess(model, force):
    """The shaft on springs of a usual stiffness in place of the laws."""
    if not model.nonlinear:
        return np.zeros(model.size)
    usual, hessian, pull = np.diag([1e8, 1e8, 1e7, 1e2, 1e2]), model.linear.copy(), force + model.rest
    for mount in model.mounts:
        if mount.support.law is not None:
            hessian += mount.rows.T @ usual @ mount.rows
            pull = pull + mount.rows.T @ usual @ mount.support.offset
    return saddle(hessian, model.rigid, np.concatenate([pull, model.given]))[: model.size]


def _length(model, u, change, slope, force):
    """Share of a step, 1 or less: where the energy along it, a convex function, has lost most of its steepness."""
    steepness = slope @ change
    if not model.nonlinear or steepness >= 0:
        return 1.0
    share = 1.0
    for _ in range(40):
        here = (_pull(model, u + share * change)[0] - force) @ change
        if here <= 0.5 * abs(steepness):
            return share
        share *= max(0.1, steepness / (steepness - here))
    return share


def _at_rest(model, u, force, multipliers):
    """Whether the forces balance, to rounding of the largest of them; moments are weighed by the length of the shaft."""
    weigh = np.ones(model.size)
    weigh[: model.beam.size].reshape(-1, FREEDOMS)[:, 3:] = 1 / model.beam.shaft.length
    pull, hessian = _pull(model, u)
    rest = np.abs(weigh * (pull - force + model.rigid.T @ multipliers)).max()
    size = np.abs(weigh * force).max(initial=0) + np.abs(weigh * model.rest).max(initial=0)
    rounding = np.finfo(float).eps * np.abs(weigh * (np.abs(hessian) @ np.abs(u))).max(initial=0)
    return rest <= max(TOLERANCE * size, 16 * rounding, 1e-12)


def _equilibrium(model, u, multipliers, steps):
    relative, tangent, reactions, number = [], [], [], 0
    for mount in model.mounts:
        support = mount.support
        own = mount.rows @ u - support.offset
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
    return Equilibrium(model, u, *arrays, _pull(model, u)[1], multipliers, steps)
