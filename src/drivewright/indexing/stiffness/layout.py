"""The unknowns of a pin-wheel indexer under load, and how the strain of every part follows from them.

Unknowns: rotation of the output and of the wheel, translation of the wheel; x, y, rotation of every cam; of either split shaft its
rotation at the gear and at every cam, displacement of its axis at the gear, the cams and the two supports, and of the two rings in
their seats.  Rotations are multiplied by half the spacing, so that all are lengths.  A row of complex coefficients gives a vector.
"""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.indexing.drivetrain import SIDES, Drivetrain, SplitShaft
from drivewright.shafts import Shaft

if TYPE_CHECKING:
    from drivewright.shafts.beam import Beam

OUT, WHEEL, WHEEL_X = 0, 1, 2
CAMS = 4  # the first unknown of the first cam


class StiffnessLayout(NamedTuple):
    """Numbers of the unknowns of a drive with `cams` cams."""

    cams: int

    @property
    def shaft_unknowns(self) -> int:
        """Unknowns of one split shaft."""
        return 11 + 3 * self.cams

    @property
    def size(self) -> int:
        """Number of all unknowns."""
        return CAMS + 3 * self.cams + 2 * self.shaft_unknowns

    def cam(self, j: int) -> int:
        """First unknown of cam j: x, y, rotation."""
        return CAMS + 3 * j

    def twist(self, side: int, station: int) -> int:
        """Rotation of a shaft; station 0 is the gear, j + 1 cam j."""
        return CAMS + 3 * self.cams + side * self.shaft_unknowns + station

    def station(self, side: int, station: int) -> int:
        """First of the two displacements of a shaft's axis at the gear or a cam."""
        return self.twist(side, 0) + 1 + self.cams + 2 * station

    def support(self, side: int, end: int) -> int:
        """... at the front (0) or rear (1) support."""
        return self.station(side, 1 + self.cams) + 2 * end

    def ring(self, side: int, end: int) -> int:
        """... of the ring of that support in its seat."""
        return self.support(side, 2) + 2 * end


class LinearPart(NamedTuple):
    """A linear part: rows (r, size) of its strains and their stiffness (r, r); None is rigid."""

    name: str
    rows: Floats
    stiffness: Floats | None


def vector_rows(layout: StiffnessLayout, terms: Sequence[tuple[int, float]]) -> Floats:
    """(2, size): the row of the vector sum of coefficient * unknown for terms (first of two unknowns, complex or real factor)."""
    row = np.zeros((2, layout.size))
    for at, factor in terms:
        row[0, at], row[1, at + 1] = row[0, at] + factor, row[1, at + 1] + factor
    return row


def linear_parts(drive: Drivetrain, layout: StiffnessLayout) -> Iterator[LinearPart]:
    """The linear parts of a drive, each a `LinearPart`."""
    lever = drive.spacing / 2
    output = np.zeros((1, layout.size))
    output[0, [OUT, WHEEL]] = 1 / lever, -1 / lever
    yield LinearPart("output", output, None if drive.wheel_torsion is None else np.array([[drive.wheel_torsion]]))
    if drive.wheel is None:
        yield LinearPart("wheel", vector_rows(layout, [(WHEEL_X, 1.0)]), None)
    for side in range(len(SIDES)):
        yield from _mounting(drive, layout, side)
        yield LinearPart("bending", *_bending(drive.shaft, layout, side))
        yield LinearPart("torsion", *_torsion(drive.shaft, layout, side, lever))
        if drive.gear is None:
            held = np.zeros((1, layout.size))
            held[0, layout.twist(side, 0)] = 1 / lever
            yield LinearPart("gear", held, None)


def _mounting(drive: Drivetrain, layout: StiffnessLayout, side: int) -> Iterator[LinearPart]:
    for end in (0, 1):
        seat = vector_rows(layout, [(layout.ring(side, end), 1.0)])
        yield LinearPart("housing", seat, None if drive.housing is None else drive.housing * np.eye(2))
        if drive.support is None:
            yield LinearPart("support", support_rows(layout, side, end), None)


def support_rows(layout: StiffnessLayout, side: int, end: int) -> Floats:
    """(2, size): displacement of a shaft against the ring of a support."""
    return vector_rows(layout, [(layout.support(side, end), 1.0), (layout.ring(side, end), -1.0)])


def _bending(shaft: SplitShaft | None, layout: StiffnessLayout, side: int) -> tuple[Floats, Floats | None]:
    """Stations off the line through the supports: energy 1/2 r' Phi^-1 r in x and in y, Phi on rigid supports."""
    share = np.zeros(1 + layout.cams) if shaft is None else support_fractions(shaft)
    rows = [
        vector_rows(layout, [(layout.station(side, k), 1.0), (layout.support(side, 0), part - 1.0), (layout.support(side, 1), -part)])
        for k, part in enumerate(share)
    ]
    # x of all stations, then y of all
    rows = np.concatenate([[row[0] for row in rows], [row[1] for row in rows]])
    return rows, None if shaft is None else np.asarray(np.kron(np.eye(2), bending_stiffness(shaft)), dtype=float)


def _torsion(shaft: SplitShaft | None, layout: StiffnessLayout, side: int, lever: float) -> tuple[Floats, Floats | None]:
    rows = np.zeros((layout.cams, layout.size))
    for j in range(layout.cams):
        rows[j, [layout.twist(side, 0), layout.twist(side, j + 1)]] = -1 / lever, 1 / lever
    return rows, None if shaft is None else torsion_stiffness(shaft)


def station_positions(shaft: SplitShaft) -> Floats:
    """z of the stations: gear, then the cams."""
    return np.array([shaft.gear, *shaft.cams])


def support_fractions(shaft: SplitShaft) -> Floats:
    """Where the stations stand between the supports: 0 at the front one, 1 at the rear one."""
    front, rear = shaft.supports
    return (station_positions(shaft) - front) / (rear - front)


def bending_flexibility(shaft: SplitShaft) -> Floats:
    """Phi (1 + n, 1 + n) [m/N] of the stations on rigid supports: int M_i M_j/EI dz of the moments under a unit force at either station.

    M_i = <z - a_i> - (1 - t) <z - front> - t <z - rear>, <x> = max(x, 0), t: where the station a_i stands between the supports.
    """
    found, share = _beam_of(shaft), support_fractions(shaft)
    front, rear = (np.maximum(found.z - place, 0.0)[:, None] for place in shaft.supports)
    moment = np.maximum(found.z[:, None] - station_positions(shaft), 0.0) - (1 - share) * front - share * rear  # (nodes, stations)
    ends = np.stack([-np.diff(moment, axis=0) / found.pieces[:, :1], moment[1:]], axis=1)  # shear force and moment at the end of each piece
    return np.einsum("nai,nab,nbj->ij", ends, found.flexibility, ends)


@lru_cache(maxsize=16)
def bending_stiffness(shaft: SplitShaft) -> Floats:
    """Inverse of Phi, kept, as both shafts have it under every load.

    InputError where a station stands on a support, or two at one place.
    """
    from drivewright.shafts import stiffness

    names = ["gear", *(f"cam {j + 1}" for j in range(len(shaft.cams)))]
    found = stiffness(bending_flexibility(shaft), names)
    found.setflags(write=False)
    return found


def torsion_flexibility(shaft: SplitShaft) -> Floats:
    """(n, n) [rad/(N m)]: rotation of cam j against the gear under a torque at cam k: int dz/GJ of the way that both share."""
    found = _beam_of(shaft)
    softness = np.concatenate([[0.0], np.cumsum(found.flexibility[:, 1, 1] * (1 + shaft.poisson))])  # GJ = EI/(1 + nu)
    at = np.array([softness[found.node(z)] for z in shaft.cams]) - softness[found.node(shaft.gear)]
    shared = np.minimum(np.abs(at)[:, None], np.abs(at))
    return np.where(np.sign(at)[:, None] == np.sign(at), shared, 0.0)


@lru_cache(maxsize=16)
def torsion_stiffness(shaft: SplitShaft) -> Floats:
    """Inverse of `torsion_flexibility` [N m/rad], kept as `bending_stiffness` is."""
    found = np.asarray(np.linalg.inv(torsion_flexibility(shaft)), dtype=float)
    found.setflags(write=False)
    return found


@lru_cache(maxsize=16)
def _beam_of(shaft: SplitShaft) -> "Beam":
    """The `shafts.beam.Beam` of a split shaft, a node at its supports and stations."""
    from drivewright.shafts.beam import beam

    return beam(
        Shaft(shaft.sections, shaft.modulus, shaft.poisson, 0.0, (), shear=shaft.shear), (*shaft.supports, *station_positions(shaft))
    )
