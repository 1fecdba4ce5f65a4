"""The equilibrium of an `Assembly` under a torque, and the force in every part of it, rigid ones included."""

from typing import NamedTuple

import numpy as np

from drivewright.indexing.stiffness.assembly import RANK, load_of
from drivewright.indexing.stiffness.laws import Rigid
from drivewright.indexing.stiffness.layout import OUT
from drivewright.indexing.stiffness.minimise import FLOOR, ROUNDING, Part, System, held_solve, largest, rest, slope_and_hessian, stacked

USUAL = 1e9  # N/m: stiffness to start from where only pins could yield
HARD = 1e3  # rigid contacts: the method's k, over that of all other parts together
HARDER = 1e3  # ... and the same again for their tangent, where what is left is of second order
RIGIDITY = 1e-6  # least share of the other parts in a usual compliance: below it nothing yields
MOST_ROUNDS = 30
EXACT = 1e-12  # of the load: change of the multipliers of rigid contacts


class Piece(NamedTuple):
    """One part under load: its name, force (p, ...) and movement: the strain without the gap, so that force times movement is work."""

    name: str
    force: np.ndarray
    moved: np.ndarray

    @property
    def flat(self):
        """All components of the force: (p, n)."""
        return stacked(self.force[..., None])[:, :, 0]

    @property
    def work(self):
        """Force times movement [J], (p,)."""
        return np.sum(self.force * self.moved, axis=tuple(range(1, self.force.ndim)))


class State(NamedTuple):
    """q (p, size): displacements; compliance (p,): tangent [rad/(N m)]; parts: `Piece`s, springs first, then groups, as in the assembly."""

    q: np.ndarray
    compliance: np.ndarray
    parts: tuple
    settled: np.ndarray
    yields: np.ndarray  # (p,): whether anything in the way of the torque does
    steps: int


def equilibrium(assembly, torque, touching):
    """The `State` under a torque; touching (p, k): pin contacts without a gap, which are taken as closed to start with."""
    typical = abs(torque) / assembly.lever
    linear = assembly.basis.transpose(0, 2, 1) @ _linear(assembly) @ assembly.basis
    parts = tuple(_part(group, assembly.basis) for group in assembly.groups if group.law is not None)
    system = System(linear, parts, load_of(assembly, torque))
    stiff, start = _start(system, typical, touching)
    if not isinstance(parts[0].law, Rigid):
        return _state(assembly, system, rest(system, start, assembly.lever), torque)
    pins = parts[0]._replace(law=parts[0].law._replace(k=stiff))
    system, found = _unyielding(system._replace(parts=(pins, *parts[1:])), start, assembly.lever)
    return _state(assembly, system, found, torque)


def _start(system, force, touching):
    """(k (p, 1, 1) for rigid pins, y (p, m)): every part at a usual stiffness, and of the pins (the first part) those that touch.

    k follows from the compliance that the pins have beside that of all others, which is to be HARD times theirs.
    """
    pins, *others = system.parts
    usual = system.linear + sum(part.law.secant(force) * _product(part.rows) for part in others)
    rigid = isinstance(pins.law, Rigid)
    k = (np.abs(usual).max(initial=0.0) or USUAL) if rigid else pins.law.secant(force)
    closed = pins._replace(rows=pins.rows * touching[:, :, None, None])
    whole = usual + k * _product(closed.rows)
    y = held_solve(whole, system.load, FLOOR * largest(whole))
    own, total = k * np.sum(closed.moved(y) ** 2, axis=(1, 2)), np.sum(system.load * y, axis=1)
    return (k * HARD * own / np.maximum(total - own, RIGIDITY * total))[:, None, None], y


def _product(rows):
    """(p, m, m): sum of row' row."""
    return stacked(rows).transpose(0, 2, 1) @ stacked(rows)


def _linear(assembly):
    """(size, size): stiffness of all linear parts."""
    size = assembly.layout.size
    return sum((s.rows.T @ s.stiffness @ s.rows for s in assembly.springs if s.stiffness is not None), np.zeros((size, size)))


def _part(group, basis):
    return Part((stacked(group.rows) @ basis).reshape(*group.rows.shape[:3], basis.shape[2]), group.offset, group.law)


def _unyielding(system, start, bound):
    """Method of multipliers (Hestenes, Powell): the force found becomes the multiplier, until it does not change."""
    first, size = system.parts[0], np.abs(system.load).max(initial=0.0)
    y, steps = start, 0
    for _ in range(MOST_ROUNDS):
        system = system._replace(parts=(first, *system.parts[1:]))
        found = rest(system, y, bound)
        y, steps = found.y, steps + found.steps
        force = first.law(first.strain(y))[1]
        change, noise = np.abs(force - first.law.multipliers), ROUNDING * first.law.k * np.abs(y).max(axis=1, initial=0.0)[:, None, None]
        if np.all(change <= np.maximum(EXACT * size, noise)):
            break
        first = first._replace(law=first.law._replace(multipliers=force))
    return system, found._replace(steps=steps)


# -------------------------------------------------------------------------------------------------------------------- forces


def _state(assembly, system, found, torque):
    q = (assembly.basis @ found.y[:, :, None])[:, :, 0]
    laws = iter([part.law for part in system.parts])
    parts = [_spring_part(spring, q) for spring in assembly.springs]
    parts += [_group_part(group, q, None if group.law is None else next(laws)) for group in assembly.groups]
    rows = [spring.rows for spring in assembly.springs] + [stacked(group.rows) for group in assembly.groups]
    _add_reactions(parts, rows, _load(assembly, torque))
    compliance = _tangent(system, found, system.load / torque)
    return State(q, compliance, tuple(parts), found.settled, _yields(system, q, torque / assembly.lever), found.steps)


def _yields(system, q, force):
    """(p,): with rigid pins the rotation is either that of other parts, HARD times what their k would allow, or next to nothing."""
    law = system.parts[0].law
    return np.abs(q[:, OUT]) > abs(force) / law.k[:, 0, 0] / HARD if isinstance(law, Rigid) else np.ones(len(q), dtype=bool)


def _spring_part(spring, q):
    moved = q @ spring.rows.T
    return Piece(spring.name, None if spring.stiffness is None else moved @ spring.stiffness, moved)


def _group_part(group, q, law):
    moved = np.einsum("pkcs,ps->pkc", group.rows, q)
    return Piece(group.name, None if law is None else law(moved + group.offset)[1], moved)


def _load(assembly, torque):
    load = np.zeros(assembly.layout.size)
    load[OUT] = torque / assembly.lever
    return load


def _add_reactions(parts, rows, load):
    """Forces of the rigid parts, from the balance of all forces on every unknown.

    Where statics alone leaves them open, the smallest ones: those of parts alike stiff, the limit of which is rigid.
    """
    p = len(parts[0].moved)
    rigid = [i for i, part in enumerate(parts) if part.force is None]
    left = np.broadcast_to(load, (p, len(load))).copy()
    for part, row in zip(parts, rows, strict=True):
        if part.force is not None:
            left -= (part.flat[:, None] @ row)[:, 0]
    if not rigid:
        return
    same = all(rows[i].ndim == 2 for i in rigid)  # at all positions
    held = np.concatenate([rows[i] if same else np.broadcast_to(rows[i], (p, *rows[i].shape[-2:])) for i in rigid], axis=-2)
    force = (np.linalg.pinv(held, rcond=RANK).swapaxes(-1, -2) @ left[:, :, None])[:, :, 0]
    at = 0
    for i in rigid:
        count = rows[i].shape[-2]
        parts[i] = parts[i]._replace(force=force[:, at : at + count].reshape(parts[i].moved.shape))
        at += count


def _tangent(system, found, unit):
    """(p,) compliance t' H^-1 t [rad/(N m)] of the unit torque t.

    What the stiffness k of rigid pins leaves is taken off with their own share k (R v)^2; the rest is of the order 1/k^2.
    """
    first = system.parts[0]
    if not isinstance(first.law, Rigid):
        return np.sum(unit * held_solve(found.hessian, unit, FLOOR * largest(found.hessian)), axis=1)
    law = first.law
    closed = (first.law(first.strain(found.y))[1] > 0) | law.both
    pins = Part(first.rows * closed[..., None], np.zeros_like(first.offset), Rigid(np.zeros_like(law.multipliers), HARDER * law.k, True))
    others = system._replace(parts=system.parts[1:])
    soft = slope_and_hessian(others, found.y)[1]
    hard = soft + slope_and_hessian(others._replace(linear=np.zeros_like(soft), parts=(pins,)), found.y)[1]
    others_give = largest(soft)
    v = held_solve(hard, unit, FLOOR * np.where(others_give > 0, others_give, largest(hard)))
    return np.sum(unit * v, axis=1) - np.sum(pins.law.k * pins.moved(v) ** 2, axis=(1, 2))
