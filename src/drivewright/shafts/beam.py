"""The shaft as a beam in space: exact two-node elements that bend, shear, stretch and twist, and what is known between the nodes.

An element is stated by its flexibility, so cones are as exact as cylinders.  In one plane, with deflection w, slope t of the
section, the element's start clamped and the force F and moment M at its end, M(x) = F (L - x) + M:

    w2 - w1 - L t1 = F (int (L-x)^2/EI + int 1/(kappa G A)) + M int (L-x)/EI,    t2 - t1 = F int (L-x)/EI + M int 1/EI.

Plane x: w = x, t = tilt_y.  Plane y: w = y, t = -tilt_x.
"""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats, Ints
from drivewright.errors import InputError
from drivewright.shafts.model import Shaft, Support
from drivewright.shafts.sections import NODES, WEIGHTS, area, compliance_integrals_of, second_moment

FREEDOMS = 6  # a node: x, y, z, rotations about x, y, z
PLANES = ((0, 4, 1.0), (1, 3, -1.0))  # (deflection, rotation, its sign as a slope)
ALL_NUMBERS = 1e250  # beyond it, and below its inverse, there is no room left to compute with
BAND = 4  # elements over the width of a support
POINT = 1e-6  # of the shaft's length: what is narrower is a point, for nodes so near are one


class Beam(NamedTuple):
    """Nodes z (n,), pieces (n-1, 4) of (length, start, end, bore) between them, and the shaft they belong to."""

    shaft: Shaft
    z: Floats
    pieces: Floats
    flexibility: Floats  # (n-1, 2, 2) of the clamped piece; [0, 0] with shear
    slip: Floats  # (n-1,) the part of shear in it

    @property
    def size(self) -> int:
        """Number of freedoms: six a node."""
        return FREEDOMS * len(self.z)

    def node(self, position: float) -> int:
        """Number of the node at a position."""
        return int(np.argmin(np.abs(self.z - position)))


def beam(shaft: Shaft, places: Iterable[float] = ()) -> Beam:
    """The `Beam` of a shaft with nodes at every step, support, station and at the further `places`; InputError where it overflows."""
    z = _nodes(shaft, places)
    pieces = _pieces(shaft, z[:-1], z[1:])
    with np.errstate(all="ignore"):
        flexibility, slip = clamped_flexibility(pieces, shaft)
        wrong = ~np.all((flexibility < ALL_NUMBERS) & (flexibility > 1 / ALL_NUMBERS), axis=(1, 2))
    if wrong.any():
        first = int(np.argmax(wrong))
        left, right, diameter = 1e3 * z[first], 1e3 * z[first + 1], 1e3 * pieces[first, 1]
        raise InputError(
            f"shaft: from {left:.6g} to {right:.6g} mm, with a diameter of {diameter:.6g} mm, the flexibility overflows; "
            "check the units of diameters, bores and Young's modulus"
        )
    return Beam(shaft, z, pieces, flexibility, slip)


def _nodes(shaft, places):
    widths = [width_places(shaft, support) for support in shaft.supports]
    wanted = np.concatenate([shaft.ends, [s.position for s in (*shaft.supports, *shaft.masses)], *widths, np.asarray(places, float)])
    near = 1e-9 * shaft.length
    if wanted.min() < -near or wanted.max() > shaft.length + near:
        off = wanted.min() if wanted.min() < -near else wanted.max()
        raise InputError(
            f"shaft: a place at {1e3 * off:.6g} mm lies outside the shaft, which runs from 0 to {1e3 * shaft.length:.6g} mm; "
            "move it, or make the shaft longer"
        )
    z = np.unique(np.clip(wanted, 0.0, shaft.length))
    return z[np.concatenate([[True], np.diff(z) > near])]


def width_places(shaft: Shaft, support: Support) -> Floats:
    """Places (m,) [m] of the ends and divisions of a support's width; none where it is a point."""
    middle, half = support.position, support.width / 2
    return np.linspace(middle - half, middle + half, BAND + 1) if support.width > POINT * shaft.length else np.zeros(0)


def _pieces(shaft, left, right):
    """(n, 4) pieces between places that have no step between them."""
    ends, table = shaft.ends, np.array([section[:4] for section in shaft.sections], float)
    at = np.clip(np.searchsorted(ends, 0.5 * (left + right)) - 1, 0, len(table) - 1)
    length, start, end, bore = table[at].T
    share = [(place - ends[at]) / length for place in (left, right)]
    first, last = (np.where(start == end, start, start + (end - start) * s) for s in share)
    return np.stack([right - left, first, last, bore], axis=1)


def clamped_flexibility(pieces: Floats, shaft: Shaft) -> tuple[Floats, Floats]:
    """(flexibility (n, 2, 2) of clamped pieces for force and moment at the end, its part of shear (n,))."""
    zero, first, second, slip = compliance_integrals_of(pieces, shaft.modulus, shaft.poisson, shaft.shear).T
    length = pieces[:, 0]
    force, mixed = length**2 * zero - 2 * length * first + second + slip, length * zero - first
    return np.moveaxis(np.array([[force, mixed], [mixed, zero]]), -1, 0), slip


def strain_matrix(length: Floats) -> Floats:
    """T (n, 2, 4): (w2 - w1 - L t1, t2 - t1) of the ends (w1, t1, w2, t2)."""
    one, none = np.ones_like(length), np.zeros_like(length)
    return np.moveaxis(np.array([[-one, -length, one, none], [none, -one, none, one]]), -1, 0)


def element_freedoms(element: int, plane: int) -> tuple[Ints, Floats]:
    """Numbers of the four freedoms of an element in a plane, and their signs."""
    w, t, sign = PLANES[plane]
    at = FREEDOMS * element
    return np.array([at + w, at + t, at + FREEDOMS + w, at + FREEDOMS + t]), np.array([1.0, sign, 1.0, sign])


# -- unknowns ------------------------------------------------------------------------------------------------------------------
# Six of the first node, then six of every piece: how far its end has moved from where its start alone would carry it.  Forces follow
# from these strains without the difference of two nearly equal displacements, however short a piece is.


def displacement_basis(beam: Beam) -> Floats:
    """S (6n, 6n): displacements of all nodes = S v, of the unknowns v."""
    whole = np.zeros((beam.size, beam.size))
    whole[:FREEDOMS, :FREEDOMS] = np.eye(FREEDOMS)
    for element, length in enumerate(beam.pieces[:, 0]):
        at = FREEDOMS * element
        carried = np.eye(FREEDOMS)
        for w, t, sign in PLANES:
            carried[w, t] = sign * length
        whole[at + FREEDOMS : at + 2 * FREEDOMS] = carried @ whole[at : at + FREEDOMS]
        whole[at + FREEDOMS : at + 2 * FREEDOMS, at + FREEDOMS : at + 2 * FREEDOMS] += np.eye(FREEDOMS)
    return whole


def stiffness(beam: Beam) -> Floats:
    """K (6n, 6n) of the shaft without its supports, in the unknowns: a block for every piece, none for the first node."""
    whole = np.zeros((beam.size, beam.size))
    bending = np.linalg.inv(beam.flexibility)
    stretch, twist = _rod_stiffnesses(beam)
    for element in range(len(beam.pieces)):
        at = FREEDOMS * (element + 1)
        for w, t, sign in PLANES:
            signs = np.array([1.0, sign])
            whole[np.ix_((at + w, at + t), (at + w, at + t))] = signs[:, None] * bending[element] * signs
        whole[at + 2, at + 2], whole[at + 5, at + 5] = stretch[element], twist[element]
    return whole


def _rod_stiffnesses(beam):
    """(EA, GI_p) over the length of every piece: 1 / int dx/EA."""
    length, start, end, bore = beam.pieces.T[:, :, None]
    diameter = start + (end - start) * NODES
    e, g = beam.shaft.modulus, 0.5 * beam.shaft.modulus / (1 + beam.shaft.poisson)
    soft = [np.sum(WEIGHTS * length / stiff, axis=1) for stiff in (e * area(diameter, bore), 2 * g * second_moment(diameter, bore))]
    return 1 / soft[0], 1 / soft[1]


def strains(beam: Beam, unknowns: Floats) -> Floats:
    """(n-1, 6): the strains of the pieces among the unknowns."""
    return unknowns[FREEDOMS : beam.size].reshape(-1, FREEDOMS)


def stretch_energy(beam: Beam, unknowns: Floats) -> Floats:
    """(s, s): int N_i N_j/EA over the shaft, for the unknowns (>= 6n, s) of several loads."""
    pulled = unknowns[FREEDOMS + 2 : beam.size : FREEDOMS]
    return pulled.T @ (_rod_stiffnesses(beam)[0][:, None] * pulled)


def tension_and_torque(beam: Beam, unknowns: Floats) -> Floats:
    """(n-1, 2): axial force, positive in tension, and torque in every piece."""
    stretch, twist = _rod_stiffnesses(beam)
    return strains(beam, unknowns)[:, [2, 5]] * np.stack([stretch, twist], axis=1)


# -- distributed loads ---------------------------------------------------------------------------------------------------------
# A load per length over a piece is a + b x + c x^2, its coefficients (..., 3): exact for linear loads and for the weight of a cone.


def load_resultants(coefficients: Floats, length: Floats, x: Floats) -> tuple[Floats, Floats]:
    """(shear force, moment) that the load between x and the end of the piece exerts at x."""
    a, b, c = np.moveaxis(coefficients, -1, 0)
    shear = a * (length - x) + b * (length**2 - x**2) / 2 + c * (length**3 - x**3) / 3
    moment = (
        a * (length - x) ** 2 / 2 + b * (2 * length**3 - 3 * length**2 * x + x**3) / 6 + c * (3 * length**4 - 4 * length**3 * x + x**4) / 12
    )
    return shear, moment


def clamped_load_displacement(pieces: Floats, coefficients: Floats, shaft: Shaft) -> Floats:
    """(n, 2): deflection and slope at the free end of clamped pieces under a load per length (n, 3)."""
    length, start, end, bore = pieces.T[:, :, None]
    x, weight = length * NODES, length * WEIGHTS
    shear, moment = load_resultants(coefficients[:, None, :], length, x)
    table = np.stack(np.broadcast_arrays(weight, start + (end - start) * NODES, start + (end - start) * NODES, bore), axis=-1)
    zero, _, _, slip = np.moveaxis(
        compliance_integrals_of(table.reshape(-1, 4), shaft.modulus, shaft.poisson, shaft.shear).reshape(*x.shape, 4), -1, 0
    )
    return np.stack([np.sum((length - x) * moment * zero + shear * slip, axis=1), np.sum(moment * zero, axis=1)], axis=1)


def nodal_loads(beam: Beam, plane: int, coefficients: Floats) -> Floats:
    """(6n,) forces and moments on the nodes that do the same as a load per length (n-1, 3) in a plane."""
    length, total = beam.pieces[:, 0], np.zeros(beam.size)
    sag = clamped_load_displacement(beam.pieces, coefficients, beam.shaft)
    shear, moment = load_resultants(coefficients, length, np.zeros_like(length))
    held = np.einsum("nij,ni->nj", strain_matrix(length), np.linalg.solve(beam.flexibility, sag[:, :, None])[:, :, 0])
    held[:, 0] += shear
    held[:, 1] += moment
    for element, four in enumerate(held):
        at, sign = element_freedoms(element, plane)
        total[at] += sign * four
    return total


def uniform_load(beam: Beam, start: float, end: float, value: float = 1.0) -> Floats:
    """Coefficients (n-1, 3) of a constant load per length between two nodes."""
    middle = 0.5 * (beam.z[1:] + beam.z[:-1])
    found_at = (middle > start) & (middle < end)
    return np.stack([np.where(found_at, value, 0.0), np.zeros(len(middle)), np.zeros(len(middle))], axis=1)


def linear_load(beam: Beam, start: float, end: float, first: float, last: float) -> Floats:
    """The same of a load from `first` at `start` to `last` at `end`, both nodes."""
    inside = uniform_load(beam, start, end)[:, 0]
    slope = (last - first) / (end - start)
    return np.stack([inside * (first + slope * (beam.z[:-1] - start)), inside * slope, 0 * inside], axis=1)


def mass_per_length(beam: Beam) -> Floats:
    """Mass per length (n-1, 3): rho A(x), a parabola over a cone."""
    length, start, end, bore = beam.pieces.T
    grow = (end - start) / length
    scale = 0.25 * np.pi * beam.shaft.density
    return scale * np.stack([start**2 - bore**2, 2 * start * grow, grow**2], axis=1)


# -- between the nodes ---------------------------------------------------------------------------------------------------------


class ElasticLine(NamedTuple):
    """Along z (m,), in a plane: deflection, slope of the section, shear force V and bending moment M = EI dt/dz."""

    deflection: Floats
    slope: Floats
    shear: Floats
    moment: Floats


def end_forces(beam: Beam, plane: int, unknowns: Floats, coefficients: Floats | None = None) -> Floats:
    """(n-1, 2): force and moment at the end of every piece."""
    w, t, sign = PLANES[plane]
    bent = strains(beam, unknowns)[:, [w, t]] * (1.0, sign)
    if coefficients is not None:
        bent = bent - clamped_load_displacement(beam.pieces, coefficients, beam.shaft)
    return np.asarray(np.linalg.solve(beam.flexibility, bent[:, :, None])[:, :, 0], dtype=float)


def elastic_line(beam: Beam, plane: int, unknowns: Floats, z: Floats, coefficients: Floats | None = None) -> ElasticLine:
    """The `ElasticLine` at places z: the piece from the node before to z is a clamped piece itself, so this is exact anywhere."""
    w, t, sign = PLANES[plane]
    element = np.clip(np.searchsorted(beam.z, z, side="right") - 1, 0, len(beam.pieces) - 1)
    length, x = beam.pieces[element, 0], z - beam.z[element]
    force, moment = end_forces(beam, plane, unknowns, coefficients)[element].T
    displacement = displacement_basis(beam) @ unknowns[: beam.size]
    load = np.zeros((len(z), 3)) if coefficients is None else coefficients[element]
    carried = load_resultants(load, length, x)
    shear, moment = force + carried[0], moment + force * (length - x) + carried[1]
    part = _pieces(beam.shaft, beam.z[element], np.maximum(z, beam.z[element] + 1e-12 * beam.shaft.length))
    part[:, 0] = x
    flexibility, _ = clamped_flexibility(part, beam.shaft)
    sag = clamped_load_displacement(part, load, beam.shaft)
    first, slope = displacement[FREEDOMS * element + w], sign * displacement[FREEDOMS * element + t]
    return ElasticLine(
        first + slope * x + flexibility[:, 0, 0] * shear + flexibility[:, 0, 1] * moment + sag[:, 0],
        slope + flexibility[:, 1, 0] * shear + flexibility[:, 1, 1] * moment + sag[:, 1],
        shear,
        moment,
    )
