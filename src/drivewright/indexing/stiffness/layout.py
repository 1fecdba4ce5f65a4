"""The unknowns of a pin-wheel indexer under load, and how the strain of every part follows from them.

Unknowns: rotation of the output and of the wheel, translation of the wheel; x, y, rotation of every cam; of either split shaft its
rotation at the gear and at every cam, displacement of its axis at the gear, the cams and the two supports, and of the two rings in
their seats.  Rotations are multiplied by half the spacing, so that all are lengths.  A row of complex coefficients gives a vector.
"""

from typing import NamedTuple

import numpy as np

from drivewright.indexing.drivetrain import SIDES
from drivewright.shafts import EULER_BERNOULLI, Shaft, Support

OUT, WHEEL, WHEEL_X = 0, 1, 2
CAMS = 4  # the first unknown of the first cam


class Layout(NamedTuple):
    """Where the unknowns of a drive with so many cams stand."""

    cams: int

    @property
    def of_a_shaft(self):
        return 11 + 3 * self.cams

    @property
    def size(self):
        return CAMS + 3 * self.cams + 2 * self.of_a_shaft

    def cam(self, j):
        """First unknown of cam j: x, y, rotation."""
        return CAMS + 3 * j

    def twist(self, side, station):
        """Rotation of a shaft; station 0 is the gear, j + 1 cam j."""
        return CAMS + 3 * self.cams + side * self.of_a_shaft + station

    def station(self, side, station):
        """First of the two displacements of a shaft's axis at the gear or a cam."""
        return self.twist(side, 0) + 1 + self.cams + 2 * station

    def support(self, side, end):
        """... at the front (0) or rear (1) support."""
        return self.station(side, 1 + self.cams) + 2 * end

    def ring(self, side, end):
        """... of the ring of that support in its seat."""
        return self.support(side, 2) + 2 * end


class Spring(NamedTuple):
    """A linear part: rows (r, size) of its strains and their stiffness (r, r); None is rigid."""

    name: str
    rows: np.ndarray
    stiffness: np.ndarray | None


def vector_row(layout, terms):
    """(2, size): the row of the vector sum of coefficient * unknown for terms (first of two unknowns, complex or real factor)."""
    row = np.zeros((2, layout.size))
    for at, factor in terms:
        row[0, at], row[1, at + 1] = row[0, at] + factor, row[1, at + 1] + factor
    return row


def springs(drive, layout):
    """The linear parts of a drive, each a `Spring`."""
    lever = drive.spacing / 2
    output = np.zeros((1, layout.size))
    output[0, [OUT, WHEEL]] = 1 / lever, -1 / lever
    yield Spring("output", output, None if drive.wheel_torsion is None else np.array([[drive.wheel_torsion]]))
    if drive.wheel is None:
        yield Spring("wheel", vector_row(layout, [(WHEEL_X, 1.0)]), None)
    for side in range(len(SIDES)):
        yield from _mounting(drive, layout, side)
        yield Spring("bending", *_bending(drive.shaft, layout, side))
        yield Spring("torsion", *_torsion(drive.shaft, layout, side, lever))
        if drive.gear is None:
            held = np.zeros((1, layout.size))
            held[0, layout.twist(side, 0)] = 1 / lever
            yield Spring("gear", held, None)


def _mounting(drive, layout, side):
    for end in (0, 1):
        seat = vector_row(layout, [(layout.ring(side, end), 1.0)])
        yield Spring("housing", seat, None if drive.housing is None else drive.housing * np.eye(2))
        if drive.support is None:
            yield Spring("support", support_row(layout, side, end), None)


def support_row(layout, side, end):
    """(2, size): displacement of a shaft against the ring of a support."""
    return vector_row(layout, [(layout.support(side, end), 1.0), (layout.ring(side, end), -1.0)])


def _bending(shaft, layout, side):
    """Stations off the line through the supports: energy 1/2 r' Phi^-1 r in x and in y, Phi on rigid supports."""
    share = np.zeros(1 + layout.cams) if shaft is None else shares(shaft)
    rows = [
        vector_row(layout, [(layout.station(side, k), 1.0), (layout.support(side, 0), part - 1.0), (layout.support(side, 1), -part)])
        for k, part in enumerate(share)
    ]
    # x of all stations, then y of all
    rows = np.concatenate([[row[0] for row in rows], [row[1] for row in rows]])
    return rows, None if shaft is None else np.kron(np.eye(2), bending_stiffness(shaft))


def _torsion(shaft, layout, side, lever):
    rows = np.zeros((layout.cams, layout.size))
    for j in range(layout.cams):
        rows[j, [layout.twist(side, 0), layout.twist(side, j + 1)]] = -1 / lever, 1 / lever
    return rows, None if shaft is None else torsion_stiffness(shaft)


def places(shaft):
    """z of the stations: gear, then the cams."""
    return np.array([shaft.gear, *shaft.cams])


def shares(shaft):
    """Where the stations stand between the supports: 0 at the front one, 1 at the rear one."""
    front, rear = shaft.supports
    return (places(shaft) - front) / (rear - front)


def bending_flexibility(shaft):
    """Phi (1 + n, 1 + n) [m/N] of the stations on rigid supports."""
    from drivewright.shafts import assemble, flexibility, solve

    rigid = (np.inf, np.inf, 0.0, 0.0, 0.0)
    model = assemble(
        _beam(shaft, tuple(Support(name, z, rigid) for name, z in zip(("front", "rear"), shaft.supports, strict=True))), places(shaft)
    )
    return flexibility(solve(model, np.zeros(model.size)), places(shaft), (1.0, 0.0)).delta


def bending_stiffness(shaft):
    """Inverse of Phi; InputError where a station stands on a support, or two at one place."""
    from drivewright.shafts import stiffness

    names = ["gear", *(f"cam {j + 1}" for j in range(len(shaft.cams)))]
    return stiffness(bending_flexibility(shaft), names)


def torsion_flexibility(shaft):
    """(n, n) [rad/(N m)]: rotation of cam j against the gear under a torque at cam k: int dz/GJ of the way that both share."""
    from drivewright.shafts.beam import beam

    found = beam(_beam(shaft, ()), places(shaft))
    softness = np.concatenate([[0.0], np.cumsum(found.flexibility[:, 1, 1] * (1 + shaft.poisson))])  # GJ = EI/(1 + nu)
    at = np.array([softness[found.node(z)] for z in shaft.cams]) - softness[found.node(shaft.gear)]
    shared = np.minimum(np.abs(at)[:, None], np.abs(at))
    return np.where(np.sign(at)[:, None] == np.sign(at), shared, 0.0)


def torsion_stiffness(shaft):
    """Inverse of `torsion_flexibility` [N m/rad]."""
    return np.linalg.inv(torsion_flexibility(shaft))


def _beam(shaft, supports):
    return Shaft(shaft.sections, shaft.modulus, shaft.poisson, 0.0, supports, shear=EULER_BERNOULLI)
