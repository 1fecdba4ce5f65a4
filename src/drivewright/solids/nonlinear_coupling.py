"""The equilibrium of substructures on springs with laws of their own: contacts that only press, bearings, flanks with play.

The displacements of all bodies are u = G q + H' a, q loads and a rigid motions; with the energies V of the springs' strains d = B u that
rest beyond the offsets o, the potential

    P(q, a) = 1/2 q'G q + sum V(d - o) - p'u

is convex.  Newton's method: every law is its tangent K about its present strain, a spring of compliance 1/K and offset d - s/K, along the
principal axes of K where it has several strains; the linear springs of `coupling` do the rest.  A contact that is open has no tangent and
resists a change of its strain by a trifle, which no result depends on.  Along a step the slope of P is followed until half of it is lost.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple, Protocol

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import SolverError
from drivewright.numerics.line_search import convex_step_length
from drivewright.solids.coupling import BodyLoad, BodyName, CoupledSolution, InterfaceSpring, StrainSystem, StrainTerm, strain_system
from drivewright.solids.substructures import Substructure

STEP_LIMIT, ROUND_LIMIT = 100, 30
SETTLED = 1e-10  # of the largest force: how far a law and its spring may differ
DAMPING = 1e-2  # of a usual stiffness, times the residual over the largest force
FLOOR = 1e-9  # of a usual stiffness: what nothing resists stays where it is
HARD = 1e3  # stiffness of the method of multipliers over that of all other parts
EXACT = 1e-11  # of the largest force: change of the multipliers


class InterfaceLaw(Protocol):
    """Answers strains (c,) [m] with the energy [J], the force (c,) [N], its gradient, and the tangent (c, c) [N/m]."""

    def __call__(self, strain: Floats) -> tuple[Floats, Floats, Floats]: ...


class NonlinearSpring(NamedTuple):
    """A spring with a law between interfaces, of one strain or several: rows of terms ((body, functional, factor), ...) each.

    law: of the strains less `offset` (c,) [m], None for a rigid contact of one strain that only presses; usual [N/m]: a usual stiffness to
    start from, 0 for what is open at first; `group` says what it stands for.
    """

    group: str
    rows: tuple[tuple[StrainTerm, ...], ...]
    law: InterfaceLaw | None
    usual: float
    offset: tuple[float, ...]


class NonlinearSolution(NamedTuple):
    """`coupled`: forces and strains of the linear springs, then of every strain of the others in their order; energy [J] stored in bodies
    and springs; steps of Newton's method."""

    coupled: CoupledSolution
    energy: float
    steps: int


class _Multiplier(NamedTuple):
    """F = max(m + k d, 0), with multipliers m that a loop moves to where d = 0."""

    m: float
    k: float

    def __call__(self, strain: Floats) -> tuple[Floats, Floats, Floats]:
        force = np.maximum(self.m + self.k * strain, 0.0)
        return (force[0] ** 2 - self.m**2) / (2 * self.k), force, np.diag(np.where(force > 0, self.k, 0.0))


class _Problem(NamedTuple):
    """The strains of linear springs, then of laws; compliance, offset of the linear ones, of every law its columns."""

    system: StrainSystem
    springs: Sequence[InterfaceSpring]
    laws: Sequence[NonlinearSpring]
    compliance: Floats
    offset: Floats
    columns: Sequence[slice]


class _Tangents(NamedTuple):
    """Of all strains: energy [J], forces (S,), and of the laws the tangents, one (c, c) each."""

    energy: float
    forces: Floats
    stiffness: list[Floats]


def solve_nonlinear(
    bodies: Mapping[BodyName, Substructure], springs: Sequence[InterfaceSpring], laws: Sequence[NonlinearSpring], load: BodyLoad
) -> NonlinearSolution:
    """`NonlinearSolution` of {name: Substructure}, linear springs, springs with laws and a load (body, functional, force) [N].

    DoesNotAssemble where no spring holds a body at all; SolverError where it does not settle, as where all contacts in the way of the load
    open.
    """
    problem = _problem(bodies, springs, laws, load)
    forces, motions = _start(problem)
    rigid = [n for n, each in enumerate(laws) if each.law is None]
    if not rigid:
        forces, motions, steps = _minimised(problem, forces, motions)
    else:
        problem, forces, motions, steps = _with_multipliers(problem, rigid, forces, motions)
    found = _evaluated(problem, forces, problem.system.strains(forces, motions))
    coupled = problem.system.solution(found.forces, motions)
    stored = 0.5 * float(coupled.loads @ problem.system.whole_flexibility @ coupled.loads)
    return NonlinearSolution(coupled, found.energy + stored, steps)


def _problem(
    bodies: Mapping[BodyName, Substructure], springs: Sequence[InterfaceSpring], laws: Sequence[NonlinearSpring], load: BodyLoad
) -> _Problem:
    terms = [spring.terms for spring in springs] + [row for each in laws for row in each.rows]
    ends = len(springs) + np.cumsum([0, *(len(each.rows) for each in laws)])
    columns = [slice(int(low), int(high)) for low, high in zip(ends[:-1], ends[1:], strict=True)]
    compliance, offset = (np.array([getattr(spring, key) for spring in springs], dtype=float) for key in ("compliance", "offset"))
    return _Problem(strain_system(bodies, terms, load), springs, laws, compliance, offset, columns)


def _start(problem: _Problem) -> tuple[Floats, Floats]:
    """Every law as a spring of its usual stiffness, a rigid contact as a rigid spring; what is open at first all but absent."""
    usual, compliance, offset = _usual(problem), [problem.compliance], [problem.offset]
    for each in problem.laws:
        closed = each.usual > 0
        soft = 1 / each.usual if closed else 1 / (DAMPING * usual)
        compliance.append(np.full(len(each.rows), 0.0 if closed and each.law is None else soft))
        offset.append(np.array(each.offset) if closed else np.zeros(len(each.rows)))
    return problem.system.solve(np.concatenate(compliance), np.concatenate(offset))


def _usual(problem: _Problem) -> float:
    """Largest usual stiffness [N/m] of all springs."""
    linear = 1 / problem.compliance[problem.compliance > 0]
    return float(max([*linear, *(each.usual for each in problem.laws)], default=0.0)) or 1.0


def _evaluated(problem: _Problem, forces: Floats, strains: Floats) -> _Tangents:
    """Laws at their strains; a rigid spring has the force that it has."""
    count = len(problem.springs)
    yields = problem.compliance > 0
    away = strains[:count] - problem.offset
    linear = np.where(yields, away / np.where(yields, problem.compliance, 1.0), forces[:count])
    energy, found, stiffness = 0.5 * float(linear[yields] @ away[yields]), [linear], []
    for each, column in zip(problem.laws, problem.columns, strict=True):
        assert each.law is not None  # rigid contacts have got their multipliers
        stored, force, tangent = each.law(strains[column] - each.offset)
        energy += float(stored)
        found.append(np.asarray(force, float))
        stiffness.append(np.asarray(tangent, float))
    return _Tangents(energy, np.concatenate(found), stiffness)


def _minimised(problem: _Problem, forces: Floats, motions: Floats) -> tuple[Floats, Floats, int]:
    """(forces, motions, steps) in equilibrium by Newton's method, with a last step after it has settled."""
    usual, left = _usual(problem), np.inf
    for step in range(STEP_LIMIT):
        strains = problem.system.strains(forces, motions)
        found = _evaluated(problem, forces, strains)
        largest = max(np.abs(found.forces).max(initial=0.0), np.abs(problem.system.applied).max())
        left = np.abs(found.forces - forces).max(initial=0.0) / largest
        new = _newton_step(problem, found, strains, usual * max(DAMPING * min(left, 1.0), FLOOR))
        if left <= SETTLED:
            return *new, step
        change = new[0] - forces, new[1] - motions
        share = _length(problem, forces, motions, change)
        forces, motions = forces + share * change[0], motions + share * change[1]
    raise SolverError(_unsettled(problem, forces, motions, left))


def _unsettled(problem: _Problem, forces: Floats, motions: Floats, left: float) -> str:
    found = problem.system.solution(forces, motions)
    far = {body: np.abs(found.displacements[at]).max(initial=0.0) for body, at in problem.system.places.items()}
    body = max(far, key=lambda name: far[name])
    return (
        f"assembly: no equilibrium after {STEP_LIMIT} steps: the forces of the contacts are off by {left:.2g} of the largest one, and body "
        f"{' '.join(map(str, body))!r} has moved by {1e3 * far[body]:.3g} mm. Look for a body that only an open contact holds, for "
        "clearances, and for a load far beyond what the springs carry."
    )


def _newton_step(problem: _Problem, found: _Tangents, strains: Floats, damping: float) -> tuple[Floats, Floats]:
    """(forces, motions) with every law as its tangent along the principal axes of it."""
    count = len(problem.springs)
    turn, compliance, offset = np.eye(len(strains)), np.empty(len(strains)), np.empty(len(strains))
    compliance[:count], offset[:count] = problem.compliance, problem.offset
    for column, tangent in zip(problem.columns, found.stiffness, strict=True):
        sizes, axes = np.linalg.eigh(tangent)
        sizes = np.maximum(sizes, 0.0) + damping
        turn[column, column] = axes.T
        compliance[column] = 1 / sizes
        offset[column] = axes.T @ strains[column] - axes.T @ found.forces[column] / sizes
    return problem.system.solve(compliance, offset, turn)


def _length(problem: _Problem, forces: Floats, motions: Floats, change: tuple[Floats, Floats]) -> float:
    """Share of the step, 1 or less, at which the potential along it has lost half of its slope.

    dP = s'A ds + f'dd - (H p)'da with dd = -A ds + held' da.
    """
    system, (ds, da) = problem.system, change
    dd, start = system.held.T @ da - system.flexibility @ ds, system.strains(forces, motions)

    def slope(share: Floats) -> Floats:
        s = forces + share[0] * ds
        law = _evaluated(problem, s, start + share[0] * dd).forces
        return np.array([s @ system.flexibility @ ds + law @ dd - system.load @ da])

    return float(convex_step_length(slope)[0])


def _with_multipliers(problem: _Problem, rigid: Sequence[int], forces: Floats, motions: Floats) -> tuple[_Problem, Floats, Floats, int]:
    """Rigid contacts by the method of multipliers: the force of a round becomes the multiplier, until it does not change."""
    strains = problem.system.strains(forces, motions)
    largest, moved = np.abs(forces).max(), np.abs(strains).max()
    stiff = HARD * largest / moved if moved > 0 else HARD * _usual(problem)
    at, total = np.array([problem.columns[n].start for n in rigid]), 0
    multipliers = np.maximum(forces[at], 0.0)
    for _ in range(ROUND_LIMIT):
        laws = list(problem.laws)
        for n, m in zip(rigid, multipliers, strict=True):
            laws[n] = laws[n]._replace(law=_Multiplier(float(m), stiff))
        problem = problem._replace(laws=laws)
        forces, motions, steps = _minimised(problem, forces, motions)
        total, change, multipliers = total + steps, np.abs(forces[at] - multipliers).max(), forces[at]
        if change <= EXACT * np.abs(forces).max():
            break
    return problem, forces, motions, total
