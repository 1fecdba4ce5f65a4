"""How the compliances of a piece of shaft follow its length and its two diameters.

They are integrals over the piece of what it yields to a bending moment, e = 1/EI, to a shear force, s = 1/(kappa G A), and to a pull,
1/EA, times powers of the distance y to its end.  With the diameters held a piece of another length is the same in another scale, so each
is a power of the length; by a diameter D they are differentiated under the integral,  de = -e dlnI/dD dD,  ds = -s dln(kappa A)/dD dD.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.shafts.beam import Beam
from drivewright.shafts.sections import NODES, WEIGHTS, area, log_slopes, second_moment, shear_area

LENGTH, START, END = range(3)  # what a piece is changed by: its length, the diameter at its start, that at its end


class Compliances(NamedTuple):
    """Of pieces clamped at their start, (..., n) leading: flexibility (2, 2) for force and moment at the end [m/N, 1/N; 1/N, 1/(N m)],
    deflection and slope (2,) there under a load of 1 N/m [m, 1], elongation by a pull of 1 N () [m/N]."""

    flexibility: Floats
    sag: Floats
    elongation: Floats


def piece_slopes(beam: Beam) -> tuple[Compliances, Compliances]:
    """(compliances (n, ...), their derivatives (3, n, ...) by length [1/m], by the diameters at start and end [1/m])."""
    length, start, end, bore = beam.pieces.T[:, :, None]
    shaft, diameter, part = beam.shaft, start + (end - start) * NODES, WEIGHTS * length
    bend, pull = (part / (shaft.modulus * size(diameter, bore)) for size in (second_moment, area))
    slip = part * (1 + shaft.poisson) * 2 / shaft.modulus / shear_area(diameter, bore, shaft.poisson, shaft.shear)
    y, none = length * (1 - NODES), np.zeros_like(bend)
    bent, slid = _summed(y, bend, none, none), _summed(y, none, slip, pull)
    by_second_moment, by_shear_area, by_area = log_slopes(diameter, bore, shaft.poisson, shaft.shear)
    by_length = Compliances(
        (np.array([[3, 2], [2, 1]]) * bent.flexibility + slid.flexibility) / length[:, :, None],
        ([4, 3] * bent.sag + [2, 0] * slid.sag) / length,
        slid.elongation / length[:, 0],
    )
    by_diameters = (
        _summed(y, -share * by_second_moment * bend, -share * by_shear_area * slip, -share * by_area * pull) for share in (1 - NODES, NODES)
    )
    together = Compliances(*(one + two for one, two in zip(bent, slid, strict=True)))
    return together, Compliances(*(np.stack(each) for each in zip(by_length, *by_diameters, strict=True)))


def _summed(y, bend, slip, pull):
    """`Compliances` (n, ...) from what the points (n, p) of the pieces yield, y from the end."""
    twice, once, none = (np.sum(y**power * bend, axis=1) for power in (2, 1, 0))
    flexibility = np.moveaxis(np.array([[twice + np.sum(slip, axis=1), once], [once, none]]), -1, 0)
    sag = np.stack([np.sum(y**3 / 2 * bend + y * slip, axis=1), twice / 2], axis=1)
    return Compliances(flexibility, sag, np.sum(pull, axis=1))
