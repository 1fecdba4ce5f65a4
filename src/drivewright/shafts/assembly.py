"""A shaft with its supports as one system of unknowns: what holds it, what carries it along its axis, what loads it."""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from drivewright._jit import formulas_of
from drivewright._typing import Floats, Ints
from drivewright.bearings.newton import measures
from drivewright.bearings.response import evaluate_response
from drivewright.errors import InputError
from drivewright.shafts import beam as beams
from drivewright.shafts.beam import FREEDOMS
from drivewright.shafts.model import Shaft, ShaftLoad, Support

MIRROR = np.array([1.0, 1.0, -1.0, -1.0, -1.0])
AXIAL, TWIST = 2, 5
FAR, TURNED = 1e-3, 0.05  # m, rad
REGULARISATION = np.diag([1.0, 1.0, 1.0, 1e-4, 1e-4])  # N/m, N m/rad


class Mount(NamedTuple):
    """A support in the unknowns: rows (5, size) of the displacement that its springs and its law feel, in its own axes."""

    support: Support
    rows: Floats
    ring: Ints  # unknowns of the ring on a seat that yields (at most 5), in the order of `ring_freedoms`
    ring_freedoms: tuple[int, ...]
    first: int  # number of its first constraint: those of its springs, then those of its seat

    @property
    def sprung(self) -> list[int]:
        """Freedoms that a spring holds, or rigidly."""
        return [i for i in range(5) if self.support.stiffness[i] > 0]

    @property
    def seated(self) -> list[int]:
        """Numbers, within the ring, of the freedoms that a spring of the seat holds."""
        return [n for n, i in enumerate(self.ring_freedoms) if self.support.seat[i] > 0]

    @property
    def springs(self) -> slice:
        """The constraints of its springs."""
        return slice(self.first, self.first + len(self.sprung))

    @property
    def seat(self) -> slice:
        """The constraints of its seat."""
        return slice(self.springs.stop, self.springs.stop + len(self.seated))

    @property
    def coupling(self) -> Floats:
        """(5, 5) [N/m] of the support between x and y."""
        whole = np.zeros((5, 5))
        whole[:2, :2] = self.support.coupling
        return whole

    @property
    def turn(self) -> Floats:
        """Signs (5,) from the support's axes to the shaft's."""
        return MIRROR if self.support.mirrored else np.ones(5)


class ShaftSystem(NamedTuple):
    """Beam and mounts; unknowns v: those of the beam, then rings, whose displacements are basis v.  Shaft and couplings have `linear` v.

    Springs and seats are stated by their compliance, and their forces m (c,) are unknowns too: constraints v - compliance m = given.
    So nothing is large where a support is stiff, and rigid is the compliance 0.
    """

    beam: beams.Beam
    mounts: tuple[Mount, ...]
    basis: Floats
    linear: Floats
    constraints: Floats  # (c, size)
    compliance: Floats  # (c,) m/N, rad/(N m)
    given: Floats  # (c,)
    pinned: tuple[int, ...]  # freedoms (AXIAL, TWIST) of the first node that the last of them hold, for nothing else does: without force

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return len(self.linear)

    @property
    def nonlinear(self) -> bool:
        """Whether a support has a law of its own."""
        return any(mount.support.law is not None for mount in self.mounts)


def assemble(shaft: Shaft, places: Iterable[float] = ()) -> ShaftSystem:
    """The `ShaftSystem` of a shaft with nodes also at `places`; InputError where the supports leave it free to move sideways."""
    beam = beams.beam(shaft, places)
    refuse_mechanism(shaft)
    size = beam.size + sum(len(_ring_freedoms(support)) for support in shaft.supports)
    linear, basis = np.zeros((size, size)), np.eye(size)
    basis[: beam.size, : beam.size] = beams.displacement_basis(beam)
    linear[: beam.size, : beam.size] = beams.stiffness(beam)
    mounts, rows, start = [], [], beam.size
    for support in shaft.supports:
        mounts.append(_mount(beam, support, basis, start, len(rows)))
        start += len(mounts[-1].ring)
        rows += _constraints(mounts[-1])
        linear += mounts[-1].rows.T @ mounts[-1].coupling @ mounts[-1].rows
    free = not any(carries_axially(support, way) for support in shaft.supports for way in (1, -1))
    pinned = (AXIAL, TWIST) if free else (TWIST,)
    rows += [(np.eye(1, size, freedom)[0], 0.0, 0.0) for freedom in pinned]
    constraints, compliance, given = map(np.array, zip(*rows, strict=True))
    return ShaftSystem(beam, tuple(mounts), basis, linear, constraints, compliance, given, pinned)


def _constraints(mount):
    """(row, compliance, given) of every spring of a support, then of its seat."""
    support = mount.support
    springs = [(mount.rows[i], 1 / support.stiffness[i], support.offset[i]) for i in mount.sprung]
    seat = [(np.eye(1, mount.rows.shape[1], mount.ring[n])[0], 1 / support.seat[mount.ring_freedoms[n]], 0.0) for n in mount.seated]
    return springs + seat


def _ring_freedoms(support):
    """The freedoms of its ring: where the seat yields, unless it slides freely under a bearing that does not resist either."""
    return tuple(i for i in range(5) if np.isfinite(support.seat[i]) and (support.seat[i] > 0 or _holds(support, i)))


def _holds(support, freedom):
    return support.stiffness[freedom] > 0 or any(_resists(support, freedom, way) for way in (1, -1))


def _mount(beam, support, basis, start, first):
    """x, y averaged over the support's width, z and the tilts at its middle; less the ring's where the seat yields."""
    rows, node, freedoms = np.zeros((5, len(basis))), beam.node(support.position), _ring_freedoms(support)
    rows[range(5), FREEDOMS * node + np.arange(5)] = 1.0  # of six: nothing here depends on the rotation
    if support.width > beams.POINT * beam.shaft.length:
        ends = support.position - support.width / 2, support.position + support.width / 2
        even = beams.uniform_load(beam, *ends)
        even /= even[:, 0] @ beam.pieces[:, 0]
        for plane in (0, 1):
            rows[plane, : beam.size] = beams.nodal_loads(beam, plane, even)
    rows *= (MIRROR if support.mirrored else np.ones(5))[:, None]
    ring = start + np.arange(len(freedoms))
    rows[list(freedoms), ring] -= 1.0
    return Mount(support, rows @ basis, ring, freedoms, first)


def refuse_mechanism(shaft: Shaft) -> None:
    """InputError unless the supports hold the shaft sideways and against tilting."""
    held = []
    for support in shaft.supports:
        real = support.law is not None
        if real or support.stiffness[1] > 0:
            held.append((1.0, support.position / shaft.length))
        if support.seat[3] > 0 and _holds(support, 3):
            held.append((0.0, 1.0))
    if np.linalg.matrix_rank(np.array(held).reshape(-1, 2), tol=1e-9) < 2:
        names = ", ".join(repr(support.name) for support in shaft.supports) or "none"
        raise InputError(
            f"shaft: its bearings ({names}) leave it free to swing: a mechanism, not a beam. "
            "Give it a second bearing at another place, or a tilt_stiffness to the one it has"
        )


def carries_axially(support: Support, way: float) -> bool:
    """Whether a support can take a force on the shaft to the right (way +1) or to the left (-1)."""
    if support.stiffness[AXIAL] > 0:
        return support.seat[AXIAL] > 0
    return support.seat[AXIAL] > 0 and _resists(support, AXIAL, -way if support.mirrored else way)


def _resists(support, freedom, way):
    """Whether a support's law resists a displacement in one freedom alone, far beyond any clearance."""
    if support.law is None:
        return False
    displacement = np.zeros(5)
    displacement[freedom] = way * (FAR if freedom <= AXIAL else TURNED)
    if type(support.law) in formulas_of(measures):
        sizes = measures(support.law)
        play = 2 * abs(sizes.centre) + sizes.length
        displacement[freedom] += way * (play if freedom <= AXIAL else play / sizes.arm)
    return bool(abs(evaluate_response(support.law, displacement)[1][freedom]) > 0)


# -- loads ---------------------------------------------------------------------------------------------------------------------


def nodal_forces(model: ShaftSystem, loads: Iterable[ShaftLoad]) -> Floats:
    """(size,) the forces on nodes and rings by point loads, and by the pushes on the rings."""
    total = np.zeros(model.size)
    for load in loads:
        at = FREEDOMS * model.beam.node(load.position)
        total[at : at + FREEDOMS] += (*load.force, *load.moment)
    for mount in model.mounts:
        total[mount.ring] += [mount.support.push[i] for i in mount.ring_freedoms]
    return total


def seat_couplings(model: ShaftSystem) -> Floats:
    """(size,) the forces on the unknowns by couplings whose seat is off the axis."""
    return sum((mount.rows.T @ mount.coupling @ mount.support.offset for mount in model.mounts), np.zeros(model.size))


def refuse_unbalanced(model: ShaftSystem, force: Floats) -> None:
    """InputError where a load drives what nothing holds: the shaft along its axis, or its turning."""
    nodes = force[: model.beam.size].reshape(-1, FREEDOMS)
    axial, torque = nodes[:, AXIAL].sum(), nodes[:, TWIST].sum()
    way = np.sign(axial)
    if abs(axial) > 1e-9 * np.abs(nodes[:, :3]).sum() and not any(carries_axially(m.support, way) for m in model.mounts):
        raise InputError(
            f"shaft: an axial force of {axial:.6g} N, and no bearing that takes a force to the "
            f"{'right' if way > 0 else 'left'}; give a bearing an axial_stiffness, or reverse a rolling bearing (carries)"
        )
    if abs(torque) > 1e-9 * np.abs(nodes[:, TWIST]).sum():
        raise InputError(f"shaft: the torques do not balance: their sum is {torque:.6g} N·m; add the torque of the driven or driving end")


# -- regularisation --------------------------------------------------------------------------------------------------------------


def regularisation(model: ShaftSystem) -> Floats:
    """(size, size): `REGULARISATION` under every law and every ring, next to no stiffness."""
    total = np.zeros((model.size, model.size))
    for mount in model.mounts:
        if mount.support.law is not None:
            total += mount.rows.T @ REGULARISATION @ mount.rows
        total[mount.ring, mount.ring] += [REGULARISATION[i, i] for i in mount.ring_freedoms]
    return total
