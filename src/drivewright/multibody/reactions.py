"""Forces in the joints, from Newton's and Euler's equations of every body in absolute coordinates.

The motion and the loads are known; what every joint can transmit is written down as unit wrenches from its mechanics, without the
constraint equations and the tree that found the motion:  M a - F - M g = W lambda.  What is left over of these equations is an
independent check of the motion.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.multibody.assembly import Assembly
from drivewright.multibody.bodies import GROUND
from drivewright.multibody.joints.joint import Joint
from drivewright.multibody.observe import Observed
from drivewright.multibody.system import System
from drivewright.multibody.wrenches import ObservedBodies, Reaction, Wrench, cross
from drivewright.numerics.linear import null_space, pseudo_inverse

CHUNK = 2000  # states at a time: bounds the memory
RANK = 1e-10  # singular values below this part of the largest are those of redundant constraints
FOLDED = 1e-6  # ... and in a singular position of those that fold
CARRIED = 1e-6  # part of the largest force that joints may leave over in a singular position


class Reactions(NamedTuple):
    """By name of the joint: `joints` and, of massless links, `tensions` (m,) [N]: below 0 the contact is lost.

    drives (m, drives): torque or force of each drive.  residual (m,): what the equations leave over, as a part of the largest force.
    Where constraints are redundant, the smallest forces (in the root mean square) that do it.
    """

    joints: dict[str, Reaction]
    tensions: dict[str, Floats]
    drives: Floats
    residual: Floats


def reactions(assembly: Assembly, system: System, observed: Observed) -> Reactions:
    """`Reactions` of the observed states of a system of the assembly."""
    parts = [
        observed._replace(**{name: getattr(observed, name)[k : k + CHUNK] for name in observed._fields})
        for k in range(0, len(observed.t), CHUNK)
    ]
    solved = [_solve(assembly, system, part) for part in parts]
    joints = {
        name: Reaction(*(np.concatenate(pieces) for pieces in zip(*(one.joints[name] for one in solved), strict=True)))
        for name in solved[0].joints
    }
    tensions = {name: np.concatenate([one.tensions[name] for one in solved]) for name in solved[0].tensions}
    return Reactions(joints, tensions, *(np.concatenate([getattr(one, name) for one in solved]) for name in ("drives", "residual")))


def unbounded_joints(assembly: Assembly, system: System, observed: Observed) -> tuple[str, ...]:
    """Names of the ideal joints whose forces grow without bound towards one state in a singular position; none where they stay finite.

    There the joints cannot transmit every load.  What is left over of the equations of motion says whether they would have to; which joints
    it is, the forces say with which they could hold one another without any load.
    """
    equations = _equations(assembly, system, observed)
    _, residual = _balance(equations.columns, equations.resultants, FOLDED)
    if residual[0] < CARRIED:
        return ()
    idle = null_space(equations.columns[0], rcond=FOLDED)
    share = np.linalg.norm(idle, axis=1) if idle.shape[1] else np.zeros(equations.columns.shape[2])
    names = [joint.name for joint, group in zip(equations.ideal, equations.groups, strict=True) for _ in group]
    return tuple(dict.fromkeys(name for name, part in zip(names, share[: len(names)], strict=True) if part > 1e-3))


class _Equations(NamedTuple):
    """M a - F - M g = W lambda of observed states: `columns` W, `resultants` the left side; what the unknowns belong to; a length."""

    places: ObservedBodies
    ideal: list[Joint]
    groups: list[list[Wrench]]
    unknowns: list[Wrench]
    length: float
    columns: Floats
    resultants: tuple[Floats, Floats]


def observed_bodies(assembly: Assembly, observed: Observed) -> ObservedBodies:
    """The bodies of an assembly in observed states."""
    bodies = assembly.expanded.bodies
    return ObservedBodies(
        {name: k for k, name in enumerate(assembly.names)},
        {GROUND: (0.0, 0.0)} | {body.name: body.centroid for body in bodies},
        {GROUND: 0.0} | {body.name: body.angle for body in bodies},
        observed,
    )


def _equations(assembly, system, observed):
    expanded, places = assembly.expanded, observed_bodies(assembly, observed)
    ideal = [joint for joint in expanded.joints if joint.is_constraint]
    groups = [joint.wrenches(places) for joint in ideal]
    driven = [drive_wrench(next(j for j in expanded.joints if j.name == drive.joint), places) for drive in expanded.drives]
    unknowns = [wrench for group in groups for wrench in group] + driven
    length = _length(unknowns, places)
    return _Equations(places, ideal, groups, unknowns, length, _columns(unknowns, places, length), _resultants(system, observed, length))


def _solve(assembly, system, observed):
    expanded, equations = assembly.expanded, _equations(assembly, system, observed)
    places, length = equations.places, equations.length
    sizes, residual = _balance(equations.columns, equations.resultants)
    sizes *= [length if wrench.force is None else 1.0 for wrench in equations.unknowns]
    joints, start = {}, 0
    for joint, group in zip(equations.ideal, equations.groups, strict=True):
        joints[joint.name] = joint.reaction(group, sizes[:, start : start + len(group)], places)
        start += len(group)
    elements = [joint.force_element for joint in expanded.joints if joint.force_element]
    for table in ("contacts", "bushings"):
        joints |= {one.name: one.reaction(k, places) for k, one in enumerate(one for one in elements if one.table == table)}
    return Reactions(joints, _tensions(assembly.model, joints, places), sizes[:, start:], residual)


def drive_wrench(joint: Joint, places: ObservedBodies) -> Wrench:
    """The unknown of a drive: it moves the first body against the second, or, where the first is the ground, the second."""
    first, second = joint.bodies
    mover, base = (second, first) if first == GROUND else (first, second)
    return joint.drive_wrench(places, mover, base)


# -------------------------------------------------------------------------------------------------------------- equations


def _length(unknowns, places):
    """A length of the mechanism's size, so that moments and forces can be weighed against each other."""
    arms = [
        np.hypot(*(wrench.point - places.centre(body)).T).max()
        for wrench in unknowns
        if wrench.force is not None
        for body in (wrench.first, wrench.second)
        if body != GROUND
    ]
    return max(arms, default=0.0) or 1.0


def _columns(unknowns, places, length):
    """W (m, 3 bodies, unknowns): forces, and moments over the length, per unit of force, or of torque over the length."""
    columns = np.zeros((len(places.observed.t), len(places.numbers), 3, len(unknowns)))
    for u, wrench in enumerate(unknowns):
        for body, torque in wrench.torques.items():
            columns[:, places.numbers[body], 2, u] += torque if wrench.force is None else torque / length
        if wrench.force is None:
            continue
        for body, sign in ((wrench.first, 1.0), (wrench.second, -1.0)):
            arm = wrench.point - places.centre(body)
            columns[:, places.numbers[body], :2, u] += sign * wrench.force
            columns[:, places.numbers[body], 2, u] += sign * cross(arm, wrench.force) / length
    return columns[:, 1:].reshape(len(columns), 3 * (len(places.numbers) - 1), len(unknowns))


def _resultants(system, observed, length):
    """(M a - F - M g, size of its largest part) of all bodies but the ground."""

    def fields(*names):
        return np.stack([observed.body(slice(1, None), name) for name in names], axis=-1)

    mass, inertia = system.bodies.mass[1:], system.bodies.inertia[1:]
    weights = np.stack([mass, mass, inertia / length], axis=-1)
    inertial, loads = weights * fields("ax", "ay", "alpha"), fields("fx", "fy", "torque") / [1.0, 1.0, length]
    gravity = weights * [system.gravity_x, system.gravity_y, 0.0]
    largest = np.max(np.abs(inertial) + np.abs(loads) + np.abs(gravity), axis=(1, 2), initial=0.0)
    return (inertial - loads - gravity).reshape(len(observed.t), -1), largest


def _balance(columns, resultants, rank=RANK):
    """(sizes of the unknowns, residual): least squares, least norm, corrected once for rounding."""
    resultants, largest = resultants
    inverse = pseudo_inverse(columns, rank)
    sizes = np.einsum("mub,mb->mu", inverse, resultants)
    left = resultants - np.einsum("mbu,mu->mb", columns, sizes)
    sizes += np.einsum("mub,mb->mu", inverse, left)
    left = resultants - np.einsum("mbu,mu->mb", columns, sizes)
    scale = np.maximum(largest, np.max(np.abs(sizes), axis=1, initial=0.0))
    return sizes, np.max(np.abs(left), axis=1, initial=0.0) / np.where(scale > 0, scale, 1.0)


# ---------------------------------------------------------------------------------------------------------------- results


def _tensions(model, joints, places):
    """Pull of every massless link on the first body, along the link."""
    tensions = {}
    for joint in model.joints:
        if joint.massless_link:
            towards = places.rotated(f"link:{joint.name}", (1.0, 0.0))
            tensions[joint.name] = np.sum(joints[joint.name].force * towards, axis=-1)
    return tensions
