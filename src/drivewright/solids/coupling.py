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

SINGULAR = 1e-13  # relative: smaller singular values count as 0
FREE = 1e-9  # a rigid motion with so small a part in every strain is held by nothing


class InterfaceSpring(NamedTuple):
    """A linear spring between interfaces: terms ((body, functional, factor), ...) of its strain; compliance [m/N], 0 is rigid; offset [m].

    Its force is (strain - offset)/compliance; `group` says what it stands for.
    """

    group: str
    terms: tuple[tuple[BodyName, InterfaceName, float], ...]
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


def solve_coupled(
    bodies: Mapping[BodyName, Substructure], springs: Sequence[InterfaceSpring], load: tuple[BodyName, InterfaceName, float]
) -> CoupledSolution:
    """`CoupledSolution` of {name: Substructure}, `InterfaceSpring`s and a load (body, functional, force) [N]; DoesNotAssemble where
    something moves freely."""
    start, size = functional_offsets(bodies)
    rows = np.zeros((len(springs), size))
    for row, spring in zip(rows, springs, strict=True):
        for body, functional, factor in spring.terms:
            row[start[body] + bodies[body].number[functional]] += factor
    applied = np.zeros(size)
    applied[start[load[0]] + bodies[load[0]].number[load[1]]] = load[2]
    flexibility, resultants = _blocks(bodies, start, size)
    forces, motions = _solved(rows, flexibility, resultants, springs, applied)
    loads = applied - rows.T @ forces
    displacements = flexibility @ loads + resultants.T @ motions
    ends = np.cumsum([len(body.resultants) for body in bodies.values()])
    return CoupledSolution(forces, rows @ displacements, loads, displacements, dict(zip(bodies, np.split(motions, ends[:-1]), strict=True)))


def _blocks(bodies: Mapping[BodyName, Substructure], start: Mapping[BodyName, int], size: int) -> tuple[Floats, Floats]:
    flexibility, resultants = np.zeros((size, size)), []
    for name, body in bodies.items():
        here = slice(start[name], start[name] + len(body.flexibility))
        flexibility[here, here] = body.flexibility
        wide = np.zeros((len(body.resultants), size))
        wide[:, here] = body.resultants
        resultants.append(wide)
    return flexibility, np.concatenate(resultants)


def _solved(
    rows: Floats, flexibility: Floats, resultants: Floats, springs: Sequence[InterfaceSpring], applied: Floats
) -> tuple[Floats, Floats]:
    """(forces, motions); flexibilities are scaled to the size of the resultants first."""
    compliance, offset = (np.array([getattr(spring, key) for spring in springs]) for key in ("compliance", "offset"))
    soft = np.diag(compliance) + rows @ flexibility @ rows.T
    held = resultants @ rows.T
    length = np.linalg.norm(resultants, axis=1, keepdims=True)
    _refuse_free(held / length)
    scale = np.abs(soft).max() or 1.0
    count = len(held)
    matrix = np.block([[soft / scale, -(held / length).T], [-held / length, np.zeros((count, count))]])
    right = np.concatenate([(rows @ flexibility @ applied - offset) / scale, -(resultants / length) @ applied])
    # Rigid parts that hold one another more than once share as they like; the displacements are the same for any share.
    solution = np.asarray(np.linalg.lstsq(matrix, right, rcond=SINGULAR)[0], float)
    return solution[: len(springs)], scale * solution[len(springs) :] / length[:, 0]


def _refuse_free(held: Floats) -> None:
    least = np.linalg.svd(held, compute_uv=False)
    if len(held) > held.shape[1] or least[-1] < FREE * least[0]:
        raise DoesNotAssemble("solid check: some body moves freely between its springs; look at the pins that carry and at the supports.")
