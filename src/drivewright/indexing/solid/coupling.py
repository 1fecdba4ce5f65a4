"""The equilibrium of condensed bodies on linear springs.

With s the forces of the springs, B the rows of their strains in the functionals of all bodies, G and H flexibilities and resultants side by
side, c and o compliances and offsets, p the load and a the rigid motions,

    [c + B G B'   -B H'] [s]   [B G p - o]
    [-H B'         0   ] [a] = [-H p     ]        and the displacements are  u = G (p - B' s) + H' a.
"""

from typing import NamedTuple

import numpy as np

from drivewright.errors import DoesNotAssemble

SINGULAR = 1e-13  # relative: smaller singular values count as 0
FREE = 1e-9  # a rigid motion with so small a part in every strain is held by nothing


class Coupled(NamedTuple):
    """forces (S,) and strains (S,) of the springs; loads (F,) on the functionals of all bodies and their displacements (F,);
    motions: {body: (m,)}."""

    forces: np.ndarray
    strains: np.ndarray
    loads: np.ndarray
    displacements: np.ndarray
    motions: dict


def starts(bodies):
    """{body: first of its functionals} of {body: Condensed}, and their number."""
    sizes = [len(body.flexibility) for body in bodies.values()]
    return dict(zip(bodies, np.concatenate([[0], np.cumsum(sizes)[:-1]]), strict=True)), sum(sizes)


def couple(bodies, springs, load):
    """`Coupled` of {name: Condensed}, `Spring`s and a load (body, functional, force) [N]; DoesNotAssemble where something moves freely."""
    start, size = starts(bodies)
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
    return Coupled(forces, rows @ displacements, loads, displacements, dict(zip(bodies, np.split(motions, ends[:-1]), strict=True)))


def _blocks(bodies, start, size):
    flexibility, resultants = np.zeros((size, size)), []
    for name, body in bodies.items():
        here = slice(start[name], start[name] + len(body.flexibility))
        flexibility[here, here] = body.flexibility
        wide = np.zeros((len(body.resultants), size))
        wide[:, here] = body.resultants
        resultants.append(wide)
    return flexibility, np.concatenate(resultants)


def _solved(rows, flexibility, resultants, springs, applied):
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
    solution = np.linalg.lstsq(matrix, right, rcond=SINGULAR)[0]
    return solution[: len(springs)], scale * solution[len(springs) :] / length[:, 0]


def _refuse_free(held):
    least = np.linalg.svd(held, compute_uv=False)
    if len(held) > held.shape[1] or least[-1] < FREE * least[0]:
        raise DoesNotAssemble("solid check: some body moves freely between its springs; look at the pins that carry and at the supports.")
