"""Elastic bodies condensed to the loads on their interfaces (substructures): flexibility, and resultants on the rigid motions.

A functional of a body is a mean displacement over one of its interfaces in one direction; its unit load is the unit force spread over that
interface.  A rigid body has the same functionals without flexibility.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import SolverError
from drivewright.solids.elastic import MM, FreeBody
from drivewright.solids.engine import EngineObject

BALANCE = 3e-4  # relative difference of resultants to those of the undeformed geometry that is refused
PLANAR, NO_AXIAL, ALL = (0, 1, 5), (0, 1, 3, 4, 5), (0, 1, 2, 3, 4, 5)  # rigid motions: three shifts, three turns
InterfaceName: TypeAlias = tuple[Any, ...]  # what kind of interface, then its numbers: ("seat", 0, 1)


class InterfaceLoad(NamedTuple):
    """What the unit load of a functional does on a rigid body: force (3,) [-], and moment (3,) [m] about the origin of its frame."""

    name: InterfaceName
    force: Floats
    moment: Floats


class Substructure(NamedTuple):
    """A body between n functionals, numbered by their names.

    flexibility (n, n) [m/N]; resultants (m, n): force [-], and moment [m], of the unit loads on the rigid motions that the body makes.
    unknowns: of the mesh, 0 for a rigid body; free, fields: for `FreeBody.surface`, None and () for a rigid one.
    """

    number: Mapping[InterfaceName, int]
    flexibility: Floats
    resultants: Floats
    motions: tuple[int, ...]
    unknowns: int = 0
    free: FreeBody | None = None
    fields: tuple[EngineObject, ...] = ()


def radial_loads(name: InterfaceName, point: ArrayLike) -> Iterator[InterfaceLoad]:
    """The two `InterfaceLoad`s of the mean displacement at a point (x, y, z) [m], along x and along y."""
    for axis in (0, 1):
        along = np.eye(3)[axis]
        yield InterfaceLoad((*name, axis), along, np.cross(np.asarray(point, float), along))


def rigid_substructure(loads: Sequence[InterfaceLoad], motions: tuple[int, ...]) -> Substructure:
    """`Substructure` of a rigid body."""
    resultants = np.array([np.concatenate([load.force, load.moment]) for load in loads]).T[list(motions)]
    return Substructure(_numbered(loads), np.zeros((len(loads), len(loads))), resultants, motions)


def elastic_substructure(
    free: FreeBody, functionals: Sequence[EngineObject], loads: Sequence[InterfaceLoad], motions: tuple[int, ...], what: str
) -> Substructure:
    """`Substructure` of a `FreeBody`; SolverError where the load of a functional is not the one that it should be."""
    response = free.response(functionals, what)
    six = free.basis @ response.resultants
    moments = MM * (free.size * six[3:] + np.cross(free.middle, six[:3].T).T)
    resultants = np.vstack([six[:3], moments])[list(motions)]
    _refuse_unbalanced(resultants, rigid_substructure(loads, motions).resultants, loads, MM * free.size, motions, what)
    return Substructure(_numbered(loads), response.flexibility, resultants, motions, free.unknowns, free, response.fields)


def _numbered(loads: Sequence[InterfaceLoad]) -> dict[InterfaceName, int]:
    return {load.name: n for n, load in enumerate(loads)}


def _refuse_unbalanced(
    actual: Floats, expected: Floats, loads: Sequence[InterfaceLoad], size: float, motions: tuple[int, ...], what: str
) -> None:
    scale = np.where(np.array(motions) < 3, 1.0, size)[:, None]
    off = np.abs((actual - expected) / scale).max(axis=0)
    if off.max() > BALANCE:
        raise SolverError(
            f"solid check: the load {loads[int(off.argmax())].name} on the mesh of {what} is off by {off.max():.2g} of "
            "itself; try a smaller fineness."
        )
