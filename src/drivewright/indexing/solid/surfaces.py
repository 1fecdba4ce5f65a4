"""Surfaces of the solids of an indexer under load, for pictures."""

from collections.abc import Mapping

import numpy as np

from drivewright._typing import Floats
from drivewright.indexing.solid.condensation import Bodies
from drivewright.solids.coupling import BodyName, CoupledSolution, functional_offsets
from drivewright.solids.deformation import DisplacedSurface, with_mirror_images
from drivewright.solids.elastic import MM, superposed_field
from drivewright.solids.substructures import Substructure

MIRROR_IMAGES = (((1, 1, 1), (1, 1, 1)), ((1, 1, -1), (1, 1, -1)))  # the upper half of a cam, and its image in the middle plane
CAM_FACES = "profile|seat.*|bore|side"
SHOWN: dict[str, BodyName] = {"cam": ("cam", 0), "shaft": ("shaft", 0), "wheel": ("wheel",)}
FINE = {"cam": 2, "shaft": 2, "wheel": 1}  # parts of an edge of an element in the picture


def deformed_surfaces(bodies: Bodies, found: Mapping[int, CoupledSolution], count: int) -> dict[str, DisplacedSurface]:
    """{"cam", "shaft", "wheel": `DisplacedSurface`} of the first of the solids, displacements (count, n, 3) [m], nan where not `found`.

    The cam relative to its own middle, the shaft to the housing, in its own turning frame, and the wheel to its output.
    """
    return {name: _deformed(name, bodies, found, count) for name, key in SHOWN.items() if bodies[key].free is not None}


def _deformed(name: str, bodies: Bodies, found: Mapping[int, CoupledSolution], count: int) -> DisplacedSurface:
    key = SHOWN[name]
    body, (start, _) = bodies[key], functional_offsets(bodies)
    free, at = body.free, slice(start[key], start[key] + len(body.flexibility))
    assert free is not None  # a solid has its mesh
    fields = [superposed_field(body.fields, each.loads[at]) for each in found.values()]
    if name == "cam":
        motions = np.zeros((free.basis.shape[1], len(fields)))
        whole = with_mirror_images(free.surface(CAM_FACES, fields, motions, FINE[name]), MIRROR_IMAGES)
    else:
        amounts = np.array([each.motions[key] for each in found.values()])
        if name == "wheel":
            amounts[:, 5] -= [_output_turn(body, each.displacements[at]) for each in found.values()]
        whole = free.surface(".*", fields, _own_motions(body, amounts), FINE[name])
    displacements = np.full((count, len(whole.points), 3), np.nan)
    displacements[list(found)] = whole.displacements
    return whole._replace(displacements=displacements)


def _output_turn(body: Substructure, displacements: Floats) -> float:
    """Rotation [rad] of the wheel's flange about its axis, whose functional is that times a radius."""
    turn = body.number["flange", 5]
    return float(displacements[turn] / body.resultants[5, turn])


def _own_motions(body: Substructure, amounts: Floats) -> Floats:
    """(m, L): shifts of the origin [m] and turns [rad] (L, motions) as rigid motions of the `FreeBody`."""
    free = body.free
    assert free is not None
    six = np.zeros((len(amounts), 6))
    six[:, list(body.motions)] = amounts
    six[:, :3] += MM * np.cross(six[:, 3:], free.middle)
    six[:, 3:] *= MM * free.size
    return np.asarray(free.basis.T @ six.T, dtype=float)
