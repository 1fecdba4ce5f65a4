"""The equilibrium of an `DrivetrainAssembly` under a torque, and the force in every part of it, rigid ones included."""

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import Bools, Floats
from drivewright.indexing.stiffness.assembly import RANK, DrivetrainAssembly, NonlinearGroup, load_vector
from drivewright.indexing.stiffness.laws import RigidContactLaw, StrainLaw
from drivewright.indexing.stiffness.layout import OUT, LinearPart
from drivewright.indexing.stiffness.minimise import (
    FLOOR,
    ROUNDING,
    ConvexEnergy,
    ConvexTerm,
    EnergyMinimum,
    flatten_rows,
    gradient_and_hessian,
    largest_stiffness,
    minimise_energy,
    solve_regularised,
)

USUAL = 1e9  # N/m: stiffness to start from where only pins could yield
HARD = 1e3  # rigid contacts: the method's k, over that of all other parts together
HARDER = 1e3  # ... and the same again for their tangent, where what is left is of second order
RIGIDITY = 1e-6  # least share of the other parts in a usual compliance: below it nothing yields
ROUND_LIMIT = 30
EXACT = 1e-12  # of the load: change of the multipliers of rigid contacts

Minimiser: TypeAlias = Callable[[ConvexEnergy, Floats, float], EnergyMinimum]  # as `minimise_energy`


class _PartMotion(NamedTuple):
    """A part under load; force None where it is rigid, to be minimum from the balance of all others."""

    name: str
    force: Floats | None
    displacement: Floats


class PartForce(NamedTuple):
    """One part under load: its name, force (p, ...) and movement: the strain without the gap, so that force times movement is work."""

    name: str
    force: Floats
    displacement: Floats

    @property
    def flat(self) -> Floats:
        """All components of the force: (p, n)."""
        return flatten_rows(self.force[..., None])[:, :, 0]

    @property
    def work(self) -> Floats:
        """Force times movement [J], (p,)."""
        return np.sum(self.force * self.displacement, axis=tuple(range(1, self.force.ndim)))


class EquilibriumState(NamedTuple):
    """q (p, size) [m]: displacements; compliance (p,): tangent [rad/(N m)]; parts: springs first, then groups, as in the assembly."""

    q: Floats
    compliance: Floats
    parts: tuple[PartForce, ...]
    converged: Bools
    deforms: Bools  # (p,): whether anything in the way of the torque does
    steps: int


def solve_equilibrium(
    assembly: DrivetrainAssembly, torque: float, touching: Bools, compiled: bool = False, floor: float = 0.0
) -> EquilibriumState:
    """The `EquilibriumState` under a torque; touching (p, k): pin contacts without a gap, which are taken as closed to start with.

    compiled: by Newton's method in compiled code where all laws are, else by NumPy; it pays for many designs.  floor [N]: as in
    `ConvexEnergy`, for NumPy; where contacts are pressed in, their forces balance to rounding of their own size, not of the load's.
    """
    typical = abs(torque) / assembly.lever
    basis = _once(assembly.basis)
    linear = np.broadcast_to(basis.transpose(0, 2, 1) @ _linear(assembly) @ basis, (len(assembly.basis), *basis.shape[2:] * 2))
    parts = tuple(_term(group, group.law, assembly.basis) for group in assembly.groups if group.law is not None)
    system = ConvexEnergy(linear, parts, load_vector(assembly, torque), floor)
    minimise = _minimiser(system) if compiled else minimise_energy
    stiff, start = _start(system, typical, touching)
    law = parts[0].law
    if not isinstance(law, RigidContactLaw):
        return _state(assembly, system, minimise(system, start, assembly.lever), torque)
    system, minimum = _unyielding(system, law._replace(k=stiff), start, assembly.lever, minimise)
    return _state(assembly, system, minimum, torque)


def _minimiser(system: ConvexEnergy) -> Minimiser:
    """In compiled code where all laws are."""
    from drivewright.indexing.stiffness.newton import is_compiled, minimise_by_position

    return minimise_by_position if is_compiled(system) else minimise_energy


def _start(system: ConvexEnergy, force: float, touching: Bools) -> tuple[Floats, Floats]:
    """(k (p, 1, 1) for rigid pins, y (p, m)): every part at a usual stiffness, and of the pins (the first part) those that touch.

    k follows from the compliance that the pins have beside that of all others, which is to be HARD times theirs.
    """
    pins, *others = system.parts
    yielding = [(part.law, part.rows) for part in others if not isinstance(part.law, RigidContactLaw)]
    usual = system.linear + sum(law.secant(force) * _product(rows) for law, rows in yielding)
    k = (np.abs(usual).max(initial=0.0) or USUAL) if isinstance(pins.law, RigidContactLaw) else pins.law.secant(force)
    closed = pins._replace(rows=pins.rows * touching[:, :, None, None])
    whole = usual + k * _product(closed.rows)
    y = solve_regularised(whole, system.load, FLOOR * largest_stiffness(whole))
    own, total = k * np.sum(closed.displacement(y) ** 2, axis=(1, 2)), np.sum(system.load * y, axis=1)
    return (k * HARD * own / np.maximum(total - own, RIGIDITY * total))[:, None, None], y


def _product(rows: Floats) -> Floats:
    """(p, m, m), or (1, m, m) where the rows are the same everywhere: sum of row' row."""
    flat = flatten_rows(_once(rows))
    return flat.transpose(0, 2, 1) @ flat


def _linear(assembly: DrivetrainAssembly) -> Floats:
    """(size, size): stiffness of all linear parts."""
    size = assembly.size
    return sum((s.rows.T @ s.stiffness @ s.rows for s in assembly.springs if s.stiffness is not None), np.zeros((size, size)))


def _term(group: NonlinearGroup, law: StrainLaw, basis: Floats) -> ConvexTerm:
    """The group as a term of the energy of the free unknowns."""
    rows, way = flatten_rows(_once(group.rows)), _once(basis)
    if len(way) == 1:  # one product of two matrices
        free = (rows.reshape(-1, rows.shape[2]) @ way[0]).reshape(*rows.shape[:2], way.shape[2])
    else:
        free = rows @ way
    shape = (*group.rows.shape[:3], basis.shape[2])
    return ConvexTerm(np.broadcast_to(free.reshape(len(free), *shape[1:]), shape), group.offset, law)


def _once(array: Floats) -> Floats:
    """(1, ...) of what is the same at all positions (p, ...), else the array itself."""
    return array[:1] if array.strides[0] == 0 else array


def _unyielding(
    system: ConvexEnergy, law: RigidContactLaw, start: Floats, bound: float, minimise: Minimiser
) -> tuple[ConvexEnergy, EnergyMinimum]:
    """Method of multipliers (Hestenes, Powell): the force of a round becomes the multiplier, until it does not change."""
    pins, size = system.parts[0], np.abs(system.load).max(initial=0.0)
    y, steps, rounds = start, 0, 0
    while True:
        system = system._replace(parts=(pins._replace(law=law), *system.parts[1:]))
        minimum = minimise(system, y, bound)
        y, steps = minimum.y, steps + minimum.steps
        force = law(pins.strain(y))[1]
        change, noise = np.abs(force - law.multipliers), ROUNDING * law.k * np.abs(y).max(axis=1, initial=0.0)[:, None, None]
        rounds += 1
        if rounds == ROUND_LIMIT or np.all(change <= np.maximum(EXACT * size, noise)):
            return system, minimum._replace(steps=steps)
        law = law._replace(multipliers=force)


# -------------------------------------------------------------------------------------------------------------------- forces


def _state(assembly: DrivetrainAssembly, system: ConvexEnergy, minimum: EnergyMinimum, torque: float) -> EquilibriumState:
    q = (assembly.basis @ minimum.y[:, :, None])[:, :, 0]
    laws = iter([part.law for part in system.parts])
    parts = [_spring_part(spring, q) for spring in assembly.springs]
    parts += [_group_part(group, q, None if group.law is None else next(laws)) for group in assembly.groups]
    rows = [spring.rows for spring in assembly.springs] + [flatten_rows(group.rows) for group in assembly.groups]
    forces = _with_reactions(parts, rows, _load(assembly, torque))
    compliance = _tangent(system, minimum, system.load / torque)
    return EquilibriumState(q, compliance, forces, minimum.converged, _deforms(system, q, torque / assembly.lever), minimum.steps)


def _deforms(system: ConvexEnergy, q: Floats, force: float) -> Bools:
    """(p,): with rigid pins the rotation is either that of other parts, HARD times what their k would allow, or next to nothing."""
    law = system.parts[0].law
    return np.abs(q[:, OUT]) > abs(force) / law.k[:, 0, 0] / HARD if isinstance(law, RigidContactLaw) else np.ones(len(q), dtype=bool)


def _spring_part(spring: LinearPart, q: Floats) -> _PartMotion:
    displacement = q @ spring.rows.T
    return _PartMotion(spring.name, None if spring.stiffness is None else displacement @ spring.stiffness, displacement)


def _group_part(group: NonlinearGroup, q: Floats, law: StrainLaw | None) -> _PartMotion:
    displacement = np.einsum("pkcs,ps->pkc", group.rows, q)
    return _PartMotion(group.name, None if law is None else law(displacement + group.offset)[1], displacement)


def _load(assembly: DrivetrainAssembly, torque: float) -> Floats:
    load = np.zeros(assembly.size)
    load[OUT] = torque / assembly.lever
    return load


def _with_reactions(parts: Sequence[_PartMotion], rows: Sequence[Floats], load: Floats) -> tuple[PartForce, ...]:
    """All parts with their forces; those of the rigid ones from the balance of all forces on every unknown.

    Where statics alone leaves them open, the smallest ones: those of parts alike stiff, the limit of which is rigid.
    """
    p = len(parts[0].displacement)
    known = {i: PartForce(part.name, part.force, part.displacement) for i, part in enumerate(parts) if part.force is not None}
    rigid = [i for i in range(len(parts)) if i not in known]
    left = np.broadcast_to(load, (p, len(load))).copy()
    for i, part in known.items():
        left -= (part.flat[:, None] @ rows[i])[:, 0]
    if rigid:
        same = all(rows[i].ndim == 2 for i in rigid)  # at all positions
        held = np.concatenate([rows[i] if same else np.broadcast_to(rows[i], (p, *rows[i].shape[-2:])) for i in rigid], axis=-2)
        force = (np.linalg.pinv(held, rcond=RANK).swapaxes(-1, -2) @ left[:, :, None])[:, :, 0]
        ends = np.cumsum([0, *(rows[i].shape[-2] for i in rigid)])
        for i, start, stop in zip(rigid, ends[:-1], ends[1:], strict=True):
            moved = parts[i].displacement
            known[i] = PartForce(parts[i].name, force[:, start:stop].reshape(moved.shape), moved)
    return tuple(known[i] for i in range(len(parts)))


def _tangent(system: ConvexEnergy, minimum: EnergyMinimum, unit: Floats) -> Floats:
    """(p,) compliance t' H^-1 t [rad/(N m)] of the unit torque t.

    What the stiffness k of rigid pins leaves is taken off with their own share k (R v)^2; the rest is of the order 1/k^2.
    """
    first = system.parts[0]
    if not isinstance(first.law, RigidContactLaw):
        return np.sum(unit * solve_regularised(minimum.hessian, unit, FLOOR * largest_stiffness(minimum.hessian)), axis=1)
    law = first.law
    closed = (first.law(first.strain(minimum.y))[1] > 0) | law.bonded
    harder = RigidContactLaw(np.zeros_like(law.multipliers), HARDER * law.k, True)
    pins = ConvexTerm(first.rows * closed[..., None], np.zeros_like(first.offset), harder)
    others = system._replace(parts=system.parts[1:])
    soft = gradient_and_hessian(others, minimum.y)[1]
    hard = soft + gradient_and_hessian(others._replace(linear=np.zeros_like(soft), parts=(pins,)), minimum.y)[1]
    others_give = largest_stiffness(soft)
    v = solve_regularised(hard, unit, FLOOR * np.where(others_give > 0, others_give, largest_stiffness(hard)))
    return np.sum(unit * v, axis=1) - np.sum(harder.k * pins.displacement(v) ** 2, axis=(1, 2))
