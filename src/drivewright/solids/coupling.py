"""The equilibrium of substructures on linear springs.

With s the forces of the springs, B the rows of their strains in the functionals of all bodies, G and H flexibilities and resultants side by
side, c and o compliances and offsets, p the load and a the rigid motions,

    [c + B G B'   -B H'] [s]   [B G p - o]
    [-H B'         0   ] [a] = [-H p     ]        and the displacements are  u = G (p - B' s) + H' a.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import DoesNotAssemble
from drivewright.solids.substructures import InterfaceName, Substructure

BodyName: TypeAlias = tuple[Any, ...]  # what kind of body, then its numbers: ("cam", 0)
StrainTerm: TypeAlias = tuple[BodyName, InterfaceName, float]  # body, functional, factor
BodyLoad: TypeAlias = tuple[BodyName, InterfaceName, float]  # body, functional, force [N]

SINGULAR = 1e-13  # relative: smaller singular values count as 0
FREE = 1e-9  # a rigid motion with so small a part in every strain is held by nothing
SMALL = 1e-12  # of the largest flexibility: a spring between rigid bodies
MOTIONS = ("shift along x", "shift along y", "shift along z", "turn about x", "turn about y", "turn about z")


class InterfaceSpring(NamedTuple):
    """A linear spring between interfaces: terms ((body, functional, factor), ...) of its strain; compliance [m/N], 0 is rigid; offset [m].

    Its force is (strain - offset)/compliance; `group` says what it stands for.
    """

    group: str
    terms: tuple[StrainTerm, ...]
    compliance: float
    offset: float = 0.0


class CoupledSolution(NamedTuple):
    """forces (S,) [N] and strains (S,) [m] of the springs; loads (F,) [N] on the functionals of all bodies and their
    displacements (F,) [m]; motions: {body: (m,)}."""

    forces: Floats
    strains: Floats
    loads: Floats
    displacements: Floats
    motions: dict[BodyName, Floats]


def functional_offsets(bodies: Mapping[BodyName, Substructure]) -> tuple[dict[BodyName, int], int]:
    """{body: first of its functionals} of {body: Substructure}, and their number."""
    sizes = [len(body.flexibility) for body in bodies.values()]
    return dict(zip(bodies, np.concatenate([[0], np.cumsum(sizes)[:-1]]), strict=True)), sum(sizes)


def solve_coupled(bodies: Mapping[BodyName, Substructure], springs: Sequence[InterfaceSpring], load: BodyLoad) -> CoupledSolution:
    """`CoupledSolution` of {name: Substructure}, `InterfaceSpring`s and a load (body, functional, force) [N]; DoesNotAssemble where
    something moves freely."""
    system = strain_system(bodies, [spring.terms for spring in springs], load)
    compliance, offset = (np.array([getattr(spring, key) for spring in springs]) for key in ("compliance", "offset"))
    return system.solution(*system.solve(compliance, offset))


class StrainSystem(NamedTuple):
    """Bodies as the strains of S springs between them: d = pushed - flexibility s + held' a, in balance where held s = load.

    rows (S, F): of the strains in the functionals; applied (F,) [N]: load on them; flexibility (S, S) = B G B', held (m, S) = H B',
    pushed (S,) = B G p, load (m,) = H p.  whole_flexibility (F, F), resultants (m, F): of all bodies side by side.
    """

    bodies: Mapping[BodyName, Substructure]
    rows: Floats
    applied: Floats
    flexibility: Floats
    held: Floats
    pushed: Floats
    load: Floats
    whole_flexibility: Floats
    resultants: Floats

    @property
    def places(self) -> dict[BodyName, slice]:
        """{body: where its functionals stand}."""
        start, _ = functional_offsets(self.bodies)
        return {body: slice(start[body], start[body] + len(part.flexibility)) for body, part in self.bodies.items()}

    def strains(self, forces: Floats, motions: Floats) -> Floats:
        """(S,) [m]."""
        return self.pushed - self.flexibility @ forces + self.held.T @ motions

    def solve(self, compliance: Floats, offset: Floats, turn: Floats | None = None) -> tuple[Floats, Floats]:
        """(forces (S,), motions (m,)) of springs with compliances [m/N] and offsets [m], DoesNotAssemble where something moves freely.

        turn (S', S): springs are combinations of the strains, as along the principal axes of a bearing; forces are those of the strains.
        Flexibilities are brought to 1 on the diagonal first, so that soft springs do not cost the stiff ones their digits.
        """
        turn = np.eye(len(self.rows)) if turn is None else turn
        soft, held = np.diag(compliance) + turn @ self.flexibility @ turn.T, self.held @ turn.T
        self.refuse_free(held)
        own = np.diagonal(soft)
        some = own > SMALL * own.max(initial=0.0)
        scale = 1 / np.sqrt(np.where(some, own, np.median(own[some]) if some.any() else 1.0))
        soft, held = scale[:, None] * soft * scale, held * scale
        length = np.linalg.norm(held, axis=1)
        held, count = held / length[:, None], len(held)
        matrix = np.block([[soft, -held.T], [-held, np.zeros((count, count))]])
        right = np.concatenate([scale * (turn @ self.pushed - offset), -self.load / length])
        # Rigid parts that hold one another more than once share as they like; the displacements are the same for any share.
        found = np.asarray(np.linalg.lstsq(matrix, right, rcond=SINGULAR)[0], float)
        return turn.T @ (scale * found[: len(scale)]), found[len(scale) :] / length

    def solution(self, forces: Floats, motions: Floats) -> CoupledSolution:
        """The `CoupledSolution` of forces (S,) and rigid motions (m,)."""
        loads = self.applied - self.rows.T @ forces
        displacements = self.whole_flexibility @ loads + self.resultants.T @ motions
        ends = np.cumsum([len(body.resultants) for body in self.bodies.values()])
        split = dict(zip(self.bodies, np.split(motions, ends[:-1]), strict=True))
        return CoupledSolution(forces, self.rows @ displacements, loads, displacements, split)

    def refuse_free(self, held: Floats) -> None:
        """DoesNotAssemble where springs with the resultants `held` (m, S) leave a rigid motion free; it names the body."""
        each = held / np.linalg.norm(self.resultants, axis=1, keepdims=True)
        motions, sizes, _ = np.linalg.svd(each)
        sizes = np.concatenate([sizes, np.zeros(len(motions) - len(sizes))])
        if len(sizes) and sizes[-1] <= FREE * sizes[0]:
            names = [(body, MOTIONS[k]) for body, part in self.bodies.items() for k in part.motions]
            body, motion = names[int(np.abs(motions[:, -1]).argmax())]
            loose = int(np.sum(sizes <= FREE * sizes[0]))
            raise DoesNotAssemble(
                f"assembly: body {' '.join(map(str, body))!r} moves freely ({motion}; {loose} of {len(sizes)} rigid motions are held by "
                "nothing). Give it a support, or a contact that presses in that direction."
            )


def strain_system(bodies: Mapping[BodyName, Substructure], terms: Sequence[Sequence[StrainTerm]], load: BodyLoad) -> StrainSystem:
    """The `StrainSystem` of {name: Substructure}, strains, each of terms (body, functional, factor), and a load."""
    start, size = functional_offsets(bodies)
    rows, applied = np.zeros((len(terms), size)), np.zeros(size)
    for row, strain in zip(rows, terms, strict=True):
        for body, functional, factor in strain:
            row[start[body] + bodies[body].number[functional]] += factor
    applied[start[load[0]] + bodies[load[0]].number[load[1]]] = load[2]
    flexibility, resultants = _blocks(bodies, start, size)
    seen = rows @ flexibility
    return StrainSystem(
        bodies, rows, applied, seen @ rows.T, resultants @ rows.T, seen @ applied, resultants @ applied, flexibility, resultants
    )


def _blocks(bodies: Mapping[BodyName, Substructure], start: Mapping[BodyName, int], size: int) -> tuple[Floats, Floats]:
    flexibility, resultants = np.zeros((size, size)), []
    for name, body in bodies.items():
        here = slice(start[name], start[name] + len(body.flexibility))
        flexibility[here, here] = body.flexibility
        wide = np.zeros((len(body.resultants), size))
        wide[:, here] = body.resultants
        resultants.append(wide)
    return flexibility, np.concatenate(resultants)
