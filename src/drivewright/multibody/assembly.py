"""Assembly: a start pose in which every loop is closed, the split of the coordinates, and start rates.

The start angles of the bodies are guesses.  Driven rotations start exactly there.  Of the others the later bodies give way first, so
that a mechanism stated from its crank on starts with the crank where it was said to be.  Pins with play start concentric.
"""

from dataclasses import dataclass, replace
from functools import partial
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import DoesNotAssemble, InputError
from drivewright.multibody.bodies import GROUND
from drivewright.multibody.compile_model import compile_model, index_of, rows_and_equations
from drivewright.multibody.joints.rows import DISTANCE
from drivewright.multibody.model import MultibodyModel
from drivewright.multibody.partition import evaluate_again, evaluate_at, partition_at, scaled_jacobian, scaled_residuals
from drivewright.multibody.singular import chart_through
from drivewright.multibody.system import RESIDUAL, System, Work, memory_size, scratch
from drivewright.multibody.tree import Tree, build_tree, expand
from drivewright.numerics.linear import null_space

CLOSED = 1e-12  # largest miss of an assembled loop [rad], [lengths of the mechanism]
WEAK = 0.05  # a coordinate that moves the loops less than this part of its own size is no good dependent one
RANK = 1e-9  # rows that depend on one another to this accuracy are redundant
SAME_RATE = 1e-6  # of a rate given: what a body starts with instead is another
WEIGHTLESS = 1e-14  # of the largest kinetic energy of a motion of unit rates: that of one without inertia
MOVES = 1e-6  # of the largest rate: what moves in it
NUDGE = 1e-3  # how far a mechanism is moved to see whether rows depend on one another everywhere [rad], [lengths of the mechanism]


class Start(NamedTuple):
    """Coordinates and their rates at the start."""

    q: Floats
    v: Floats


@dataclass(frozen=True, eq=False)
class Assembly:
    """A system ready to move: `model` as given, `wide` with its massless links as bodies, the tree, the start, and findings."""

    model: MultibodyModel
    expanded: MultibodyModel
    tree: Tree
    system: System
    start: Start
    findings: tuple[str, ...] = ()

    @property
    def freedom(self) -> int:
        """Degrees of freedom that are not driven."""
        return len(self.system.independent)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the bodies in the order of the arrays, the ground first."""
        return (GROUND, *(link.body.name for link in self.tree.links))

    @property
    def state(self) -> Floats:
        """The start as a state for the integrator."""
        return pack(self.system, self.start.q, self.start.v)


def pack(system: System, q: Floats, v: Floats) -> Floats:
    """Coordinates and rates as a state, nothing remembered."""
    return np.concatenate([q[system.stored], v[system.independent], np.zeros(memory_size(system))])


def idealised(model: MultibodyModel) -> MultibodyModel:
    """The same mechanism with every pin ideal."""
    return replace(model, joints=tuple(joint.idealised for joint in model.joints))


def assemble(model: MultibodyModel) -> Assembly:
    """The `Assembly` of a model.  Raises DoesNotAssemble naming the joint that cannot be closed."""
    ideal = idealised(model)
    tree = build_tree(ideal)
    system = compile_model(ideal, tree)
    assembled = _assemble(ideal, ideal, tree, system, _guess(tree, system))
    if ideal == model:
        return assembled
    expanded = expand(model)
    tree = build_tree(expanded)
    system = compile_model(expanded, tree)
    return _assemble(model, expanded, tree, system, _from_poses(tree, system, assembled))


def _assemble(model, expanded, tree, system, q):
    system, work = _close(expanded, tree, system, q)
    q, rows = work.coordinates.q.copy(), len(system.rows)
    system, findings, folded = _without_redundant_rows(expanded, tree, system, work)
    work = work if len(system.rows) == rows else evaluate_at(system, q)
    _refuse_motion_without_inertia(tree, system, work)
    system = partition_at(system, work)
    v, undecided = start_rates(expanded, tree, system, work)
    if folded:
        system = _on_branch(system, q, v, undecided, folded)
    return Assembly(model, expanded, tree, system, Start(q, v), (*findings, *_impossible_rates(tree, evaluate_at(system, q), v)))


# ---------------------------------------------------------------------------------------------------------------- position


def _guess(tree, system):
    """Coordinates as the bodies' start angles have it; slides and free places zero."""
    angles = {GROUND: 0.0} | {link.body.name: link.body.angle for link in tree.links}
    q = np.zeros(tree.size)
    for link in tree.links:
        if link.turn >= 0:
            q[link.turn] = angles[link.body.name] - (angles[link.parent] if link.inherits else 0.0)
    return evaluate_at(system, q).coordinates.q


def _from_poses(tree, system, assembled):
    """Coordinates in which the bodies are where another assembly of the same mechanism has them."""
    other = evaluate_at(assembled.system, assembled.start.q)
    number = {name: k for k, name in enumerate(assembled.names)}
    q = np.zeros(tree.size)
    angles, records = {GROUND: 0.0}, {link.body.name: system.bodies[k] for k, link in enumerate(tree.links, start=1)}
    for link in tree.links:
        k = number.get(link.body.name)
        angles[link.body.name] = link.body.angle if k is None else other.poses.angle[k]
        if link.turn >= 0:
            q[link.turn] = angles[link.body.name] - (angles[link.parent] if link.inherits else 0.0)
        if link.slide >= 0:
            q[link.slide] = _slide(records[link.body.name], other, k, number[link.parent])
        if link.free >= 0:
            q[link.free : link.free + 2] = (other.poses.x[k], other.poses.y[k]) if k is not None else (0.0, 0.0)
    return evaluate_at(system, q).coordinates.q


def _slide(body, work, i, p):
    """Displacement along a slide between two placed bodies."""

    def world(k, x, y):
        return np.array([poses.c[k] * x - poses.s[k] * y, poses.s[k] * x + poses.c[k] * y])

    poses = work.poses
    between = np.array([poses.x[i] - poses.x[p], poses.y[i] - poses.y[p]]) + world(i, body.bx, body.by) - world(p, body.ax, body.ay)
    return float(between @ (world(p, body.ex, body.ey) - world(i, body.fx, body.fy)))


def _close(expanded, tree, system, q):
    """(system with the constants of gears and rolling wheels, `Work` at the closed coordinates)."""
    phase = np.isnan(system.rows.constant)
    loops = system._replace(rows=system.rows[~phase]) if np.any(phase) else system
    linear = [k for link in tree.links for k in _places(link)]
    links = {link.turn for link in tree.links if link.body.name.startswith("link:")}
    free = [k for k in system.stored if k not in links]
    work = evaluate_at(loops, q)
    if linear:
        q = _step(loops, work, linear)
        evaluate_again(loops, work, q)
    for columns in (_giving_way(expanded, tree, loops, work, free), free, list(system.stored)):
        if _newton(loops, work, q, columns) < CLOSED:
            break
    else:
        raise DoesNotAssemble(_drives_apart(expanded, tree, loops, q, work) or _does_not_close(expanded, loops, work))
    if loops is system:
        return system, work
    rows = system.rows.copy()
    rows.constant[phase] = 0.0
    rows.constant[phase] = evaluate_at(system._replace(rows=rows), work.coordinates.q).row_columns[RESIDUAL, phase]
    system = system._replace(rows=rows)
    return system, evaluate_at(system, work.coordinates.q)


def _places(link):
    """Coordinates of a link that move it without turning it."""
    return [k for k in (link.slide, link.free, link.free + 1 if link.free >= 0 else -1) if k >= 0]


def _step(system, work, columns):
    """Coordinates a Newton step on, on some of them."""
    q = work.coordinates.q.copy()
    if len(system.rows):
        q[columns] -= (
            system.sizes[columns] * np.linalg.lstsq(scaled_jacobian(system, work, columns), scaled_residuals(system, work), rcond=1e-10)[0]
        )
    return q


def _newton(system, work, q, columns, t=0.0):
    """Largest miss of the loops closed from the coordinates q, in `work`, by Newton's method on some coordinates: least change, damped, at
    most half a radian, or half the mechanism's length, a step."""
    evaluate_again(system, work, q, t)
    off, sizes = scaled_residuals(system, work), system.sizes[columns]
    for _ in range(60):
        if np.max(np.abs(off), initial=0.0) < 0.01 * CLOSED or not columns:
            break
        step = np.linalg.lstsq(scaled_jacobian(system, work, columns), off, rcond=1e-12)[0]
        step *= min(1.0, 0.5 / np.max(np.abs(step), initial=1e-300))
        here = work.coordinates.q.copy()
        for _ in range(10):
            trial = here.copy()
            trial[columns] -= step * sizes
            evaluate_again(system, work, trial, t)
            left = scaled_residuals(system, work)
            if np.linalg.norm(left) < np.linalg.norm(off):
                break
            step *= 0.5
        else:
            evaluate_again(system, work, here, t)
            break
        off = left
    return np.max(np.abs(off), initial=0.0)


def _giving_way(expanded, tree, system, work, free):
    """As many coordinates as there are rows to close, those of the later bodies first, each able to move what the others cannot."""
    order = {body.name: k for k, body in enumerate(expanded.bodies)}
    links = sorted(tree.links, key=lambda link: -order[link.body.name])
    ranked = [k for link in links for k in _places(link)] + [link.turn for link in links]
    jacobian = scaled_jacobian(system, work, range(len(system.sizes)))
    chosen, basis = [], np.zeros((len(system.rows), 0))
    for k in (k for k in ranked if k in free):
        column = jacobian[:, k]
        rest = column - basis @ (basis.T @ column)
        if np.linalg.norm(rest) > max(WEAK * np.linalg.norm(column), 1e-12):
            chosen.append(k)
            basis = np.column_stack([basis, rest / np.linalg.norm(rest)])
    return chosen


def _drives_apart(expanded, tree, system, q, work):
    """Why several drives do not start together, where the loops close with the first of them alone; else None."""
    first, others = system.driven[:1], list(system.driven[1:])
    columns = sorted([*system.stored, *(driven.coordinate for driven in others)])
    freed = system._replace(driven=first, stored=np.array(columns, dtype=np.int64))
    alone = evaluate_at(freed, work.coordinates.q)
    if not others or _newton(freed, alone, q.copy(), columns) >= CLOSED:
        return None
    names = [drive.joint for drive in expanded.drives]
    turning = {link.turn for link in tree.links}
    places = []
    for name, driven in zip(names[1:], others, strict=True):
        off = alone.coordinates.q[driven.coordinate] - work.coordinates.q[driven.coordinate]
        if abs(off) > CLOSED * system.sizes[driven.coordinate]:
            how = f"{np.degrees(off):.4g}°" if driven.coordinate in turning else f"{1e3 * off:.4g} mm"
            places.append(f"joint {name!r} is {how} away from the start of its drive")
    return (
        f"the drives of joints {' and '.join(map(repr, names))} conflict at the start: with {names[0]!r} at the start of its drive, "
        f"{', '.join(places)}. Choose start positions in which the loops close, or drive fewer joints"
    )


def _does_not_close(expanded, system, work):
    worst = int(np.argmax(np.abs(scaled_residuals(system, work))))
    row = system.rows[worst]
    joint = expanded.joints[row.joint]
    pair = [k for k in range(len(system.rows)) if system.rows[k].joint == row.joint]
    miss = np.linalg.norm(work.row_columns[0][pair])
    bodies = " and ".join(repr(name) for name in dict.fromkeys(joint.bodies))
    how = f"{1e3 * miss:.4g} mm" if row.ex or row.ey or row.kind == DISTANCE else f"{np.degrees(miss):.4g}°"
    return (
        f"joint {joint.name!r} does not close: a gap of {how} remains between bodies {bodies} at best. Check the lengths and axes, or "
        "give start angles closer to the intended assembly"
    )


# ------------------------------------------------------------------------------------------------------ redundancy and split


def _without_redundant_rows(expanded, tree, system, work):
    """(system without rows that others imply, a finding for each joint concerned, the joint whose rows others imply only at the start)."""
    kept = _independent_rows(scaled_jacobian(system, work, system.stored))
    if len(kept) == len(system.rows):
        return system, (), None
    again = _independent_rows(scaled_jacobian(system, _nudged(system, work), system.stored))
    if len(again) > len(kept):
        folded = expanded.joints[system.rows[next(k for k in again if k not in kept)].joint].name
        return system._replace(rows=system.rows[again]), (), folded
    dropped = [k for k in range(len(system.rows)) if k not in kept]
    names = list(dict.fromkeys(expanded.joints[system.rows[k].joint].name for k in dropped))
    whole = scaled_jacobian(system, work, range(len(system.sizes)))
    for k in dropped:
        if np.linalg.matrix_rank(whole[[*kept, k]], RANK) > np.linalg.matrix_rank(whole[kept], RANK):
            raise DoesNotAssemble(_held_fast(expanded, system, whole, [*kept, k], expanded.joints[system.rows[k].joint].name))
    findings = tuple(
        f"joint '{name}' repeats a constraint of the joints before it; with rigid bodies its share of the forces is not determined"
        for name in names
    )
    return system._replace(rows=system.rows[kept]), findings, None


def _held_fast(expanded, system, jacobian, rows, joint):
    """Why these rows do not let the drives move: several drives against each other, or one against the joints.

    Weights c of the rows with c J = 0 for all that is not driven say which driven rates they tie together: c J rate = 0.
    """
    weights = null_space(jacobian[np.ix_(rows, system.stored)].T, rcond=RANK)
    tied = np.max(np.abs(weights.T @ jacobian[np.ix_(rows, system.driven.coordinate)]), axis=0, initial=0.0)
    fighting = [drive.joint for drive, size in zip(expanded.drives, tied, strict=True) if size > 1e-6 * np.max(tied)]
    if len(fighting) > 1:
        return (
            f"the drives of joints {' and '.join(map(repr, fighting))} conflict: the loop through joint {joint!r} leaves them "
            f"{len(fighting) - 1} degree{'s' if len(fighting) > 2 else ''} of freedom for {len(fighting)} prescribed motions. Remove one "
            "drive, or give it a motor instead of a motion"
        )
    return (
        f"the drive cannot move: joint {joint!r} locks the mechanism. "
        "Remove a joint or a drive, or free a direction (pin-slot instead of prismatic)"
    )


def _on_branch(system, q, v, undecided, joint):
    """The system with a chart through the singular position in which it starts, along the branch to which the start rates belong."""
    where = f"the mechanism starts in a singular position, where its loops fold and the motion of joint {joint!r} is not unique"
    remedy = "Start a few degrees away from it, or give the angular velocity of every body that is not driven"
    if undecided or not np.any(v):
        reason = "all start velocities are zero" if not np.any(v) else "the given velocities fit more than one branch"
        raise DoesNotAssemble(f"{where}: {reason}. {remedy}")
    charted = chart_through(system, q, v)
    if charted is None:
        raise DoesNotAssemble(f"{where}, and the given velocities fit none of its branches. {remedy}, as on one of the branches")
    return charted


def _independent_rows(jacobian):
    """Numbers of the rows that do not depend on the rows before them."""
    kept, basis = [], np.zeros((jacobian.shape[1], 0))
    least = 1e-3 * np.max(np.linalg.norm(jacobian, axis=1), initial=0.01)  # a row of mere rounding is none
    for k, row in enumerate(jacobian):
        rest = row - basis @ (basis.T @ row)
        rest -= basis @ (basis.T @ rest)
        if np.linalg.norm(rest) > RANK * max(np.linalg.norm(row), least):
            kept.append(k)
            basis = np.column_stack([basis, rest / np.linalg.norm(rest)])
    return kept


def _nudged(system, work):
    """`Work` of the mechanism moved on a little: its drives, and what is free of them at the moment (in a dead point)."""
    q = work.coordinates.q.copy()
    fastest = np.max(np.abs(work.coordinates.v) / system.sizes, initial=0.0)
    free, moved = null_space(scaled_jacobian(system, work, system.stored)), scratch(system)
    q[system.stored] += NUDGE * system.sizes[system.stored] * np.sum(free, axis=1)
    _newton(system, moved, q, list(system.stored), NUDGE / fastest if fastest > 0 else 0.0)
    return moved


# ------------------------------------------------------------------------------------------------------------------- rates


def start_rates(expanded: MultibodyModel, tree: Tree, system: System, work: Work) -> tuple[Floats, int]:
    """(rates of all coordinates, number of freedoms that these leave) where `work` stands: driven ones as driven, loops closed, then as
    near as possible to the rates given for the bodies, then pins with play and links as if they were ideal, and nothing that moves without
    need."""
    x, free = np.zeros(len(system.sizes)), np.diag(system.sizes)  # changes of all coordinates alike
    for stage in (_driven_rates, _closed_loops, partial(_given_rates, expanded, tree), partial(_concentric, expanded, tree)):
        if not free.shape[1]:
            break
        matrix, wanted = stage(system, work)
        if len(wanted):
            x = x + free @ np.linalg.lstsq(matrix @ free, wanted - matrix @ x, rcond=1e-10)[0]
            free = free @ null_space(matrix @ free, rcond=1e-10)
    return x, free.shape[1]


def _refuse_motion_without_inertia(tree, system, work):
    """InputError where bodies can move, drives standing still and loops closed, in a way in which nothing that moves has an inertia."""
    fixed = np.concatenate([_driven_rates(system, work)[0], _closed_loops(system, work)[0]]) * system.sizes
    free = system.sizes[:, None] * null_space(fixed, rcond=1e-10)
    if not free.shape[1]:
        return
    ways = [getattr(work.partial_velocities, name) @ free for name in ("x", "y", "t")]
    inertias = (system.bodies.mass, system.bodies.mass, system.bodies.inertia)
    energies, directions = np.linalg.eigh(sum(way.T * inertia @ way for way, inertia in zip(ways, inertias, strict=True)))
    if energies[0] > WEIGHTLESS * energies[-1]:
        return
    moves = np.hypot(np.hypot(ways[0] @ directions[:, 0], ways[1] @ directions[:, 0]), system.length * (ways[2] @ directions[:, 0]))[1:]
    names = [link.body.name for link, move in zip(tree.links, moves, strict=True) if move > MOVES * np.max(moves)]
    raise InputError(
        f"bod{'ies' if len(names) > 1 else 'y'} {' and '.join(map(repr, names))} can move with neither mass nor inertia, so the "
        "acceleration is undetermined: give a mass (and an inertia for rotation about the centroid), a drive, or a joint that fixes it"
    )


def _driven_rates(system, work):
    """Rows (matrix, right-hand side) for the rates of all coordinates: the driven ones are given."""
    driven = system.driven.coordinate
    return np.eye(len(system.sizes))[driven], work.coordinates.v[driven]


def _closed_loops(system, work):
    """Rows that keep the loops closed."""
    return work.constraint_jacobian / system.rows.extent[:, None], np.zeros(len(system.rows))


def _given_rates(expanded, tree, system, work):
    """Rows for the rates given for the bodies."""
    rows, wanted = [], []
    for k, link in enumerate(tree.links, start=1):
        if link.body.velocity is not None:
            rows += [work.partial_velocities.x[k] / system.length, work.partial_velocities.y[k] / system.length]
            wanted += [v / system.length for v in link.body.velocity]
        if link.body.angular_velocity is not None:
            rows.append(work.partial_velocities.t[k])
            wanted.append(link.body.angular_velocity)
    return np.array(rows).reshape(-1, len(work.coordinates)), np.array(wanted)


def _impossible_rates(tree, work, v):
    """A finding on every body whose rates given are not those with which it starts, as joints and drives do not allow them."""
    for k, link in enumerate(tree.links, start=1):
        body, partial_velocities = link.body, work.partial_velocities
        if body.velocity is not None:
            found = np.array([partial_velocities.x[k] @ v, partial_velocities.y[k] @ v])
            if np.max(np.abs(found - body.velocity)) > SAME_RATE * max(np.max(np.abs(body.velocity)), np.max(np.abs(found))):
                given, left = (f"({1e3 * x:.4g}, {1e3 * y:.4g}) mm/s" for x, y in (body.velocity, found))
                yield f"body {body.name!r} cannot start with the velocity {given}: joints and drives allow {left}"
        if body.angular_velocity is not None:
            found = float(partial_velocities.t[k] @ v)
            if abs(found - body.angular_velocity) > SAME_RATE * max(abs(body.angular_velocity), abs(found)):
                yield (
                    f"body {body.name!r} cannot start with the angular velocity {body.angular_velocity:.4g} rad/s: joints and drives "
                    f"allow {found:.4g} rad/s"
                )


def _concentric(expanded, tree, system, work):
    """Rows that hold pins with play together, and massless links still."""
    index, q = index_of(expanded, tree), work.coordinates.q
    rows, _ = rows_and_equations([row for joint in expanded.joints if not joint.is_constraint for row in joint.constraint_rows(index)])
    links = np.eye(len(q))[[link.turn for link in tree.links if link.body.name.startswith("link:")]].reshape(-1, len(q))
    jacobian = np.concatenate([evaluate_at(system._replace(rows=rows), q).constraint_jacobian / system.length, links])
    return jacobian, np.zeros(len(jacobian))
