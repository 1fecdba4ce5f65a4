"""How a long strand leaves one sprocket: seating angle, chordal rise, and what the strand runs ahead and behind.

The strand's force has a fixed direction; the sprocket turns under it.  d: direction of the last seated plate against the force.
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import inner, kernel
from drivewright.chains.closure.drive import LEAST_TEETH, refuse_count, refuse_joint, refuse_strands
from drivewright.chains.closure.measures import measure
from drivewright.chains.closure.strand import decay, pressing, reach
from drivewright.chains.link import Link, seat_height, seat_shift

_NODES, _HALVINGS = 129, 60
_STRAIGHT = 1e-17  # of its first bend is left at the end of a strand that counts as long


class Departure(NamedTuple):
    """seating: where the plate after the last seated one comes to sit, or leaves, the last one's centre from the strand's normal [rad];
    rise: greatest less least height of the strand's force above the sprocket's centre [m];
    slip: greatest less least distance by which the strand is off its even travel of a pitch per tooth [m].
    """

    seating: float
    rise: float
    slip: float


def departure(link: Link, teeth: int, strands: str = "equilibrium") -> Departure:
    """The `Departure` of a strand from a sprocket with so many teeth; for straight ones the rise is `chordal_rise`."""
    refuse_joint(link)
    refuse_count("teeth", teeth, LEAST_TEETH)
    refuse_strands(strands)
    p, bent = link.pitch, strands == "equilibrium"
    A, r, k, phi = link.hole_pitch / p, link.radius / p, link.skew / p, 2 * np.pi / teeth
    count = int(np.ceil(np.log(_STRAIGHT) / np.log(decay(A, r, k)))) if bent and link.effective_radius > 0 else 1
    pin = 0.5 * A + (seat_shift(link, teeth) + 1j * seat_height(link, teeth)) / p
    angle, place, slope = _travel(A, r, k, bent, max(count, 2), pin, phi, _NODES)
    low, high = measure(angle, place.imag.copy(), slope.imag.copy(), slope.imag.copy())[1:]
    behind, ahead = measure(angle, place.real + angle / phi, slope.real + 1 / phi, slope.real + 1 / phi)[1:]
    return Departure(angle[-1], p * (high - low), p * (ahead - behind))


@kernel
def _travel(A, r, k, bent, count, last, phi, nodes):
    """Where a free strand's end lies for directions of the last seated plate over one tooth, and the derivative by them; force along x.

    last: of that plate the right pin, from the sprocket's centre, complex along and across the plate  [pitches]."""
    work, least = np.empty((3, count + 2)), 0.0
    if bent:
        least = _lifting(A, r, k, count, phi, work)
    angle, place, slope = np.linspace(least, least + phi, nodes), np.empty(nodes, np.complex128), np.empty(nodes, np.complex128)
    for i in range(nodes):
        found, pin = reach(A, r, k, bent, count, angle[i], 0.0, work), last * np.exp(1j * angle[i])
        place[i], slope[i] = pin + found.vector, 1j * pin + found.by_start
    return angle, place, slope


@inner
def _lifting(A, r, k, count, phi, work):
    """Direction at which nothing presses the last seated plate any more, by bisection."""
    low, high = 0.0, phi
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if pressing(A, r, k, phi, middle, reach(A, r, k, True, count, middle, 0.0, work).first) > 0:
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)
