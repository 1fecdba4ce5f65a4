"""The loop of a chain around two sprockets at one angle of the driver, compiled: equations, Newton steps, and whether the seats hold.

The driver's centre is the origin, the driven sprocket's lies at (Sd, 0); a plate seated on tooth j of sprocket s has the polar angle
psi_s + j phi_s, its direction is a quarter turn less.  Plates are numbered clockwise: off the driver at its tooth `seats[0]`, along the
upper strand, onto the driven sprocket at `seats[1]` and off it at `seats[2]`, along the lower strand, onto the driver at `seats[3]`.
Unknowns x = (psi_2, Sd, directions of the force in the upper and the lower strand); lengths in pitches.
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference, inner, kernel
from drivewright._typing import Floats, Ints
from drivewright.chains.closure.strand import pressing, reach
from drivewright.numerics.small import lu_factor, lu_solve

UNKNOWNS, ENDS = 4, 4
_STEPS = 40
_STILL = 1e-12
_LONGEST = 0.3  # a longer Newton step is shortened to this
_QUARTER = 0.5 * np.pi


class Layout(NamedTuple):
    """Joint A, r, skew k [pitches]; whether strands bend; tooth angles [rad] of both sprockets; heights and shifts of the plates seated on
    them [pitches]; number of plates.

    `lead`: the plate on tooth 0 of the driven sprocket is this many plates ahead of that on tooth 0 of the driver.
    """

    A: float
    r: float
    k: float
    bent: bool
    phi_1: float
    phi_2: float
    height_1: float
    height_2: float
    shift_1: float
    shift_2: float
    links: int
    lead: int


@by_reference
class Work(NamedTuple):
    """What a solution leaves: the misses of both strands, dx/dpsi_1 and the two margins of each end of a strand; the rest is scratch."""

    miss: Floats
    slope: Floats
    margins: Floats
    step: Floats
    jacobian: Floats
    pivots: Ints
    strand: Floats


class Side(NamedTuple):
    """By how much a strand misses its end, and the derivatives by the angles of both its sprockets and by its direction."""

    miss: complex
    by_start: complex
    by_end: complex
    by_direction: complex


@kernel
def workspace(links: int) -> Work:
    """An empty `Work` for a chain of so many plates."""
    jacobian, pivots = np.empty((UNKNOWNS, UNKNOWNS)), np.empty(UNKNOWNS, np.int64)
    return Work(np.empty(UNKNOWNS), np.empty(UNKNOWNS), np.empty(2 * ENDS), np.empty(UNKNOWNS), jacobian, pivots, np.empty((3, links + 2)))


@inner
def free_plates(layout: Layout, seats: Ints) -> tuple[int, int]:
    """Numbers of free plates in the upper and the lower strand, by the teeth `seats` (ENDS,) where it leaves and meets the sprockets."""
    return layout.lead - seats[1] + seats[0] - 1, layout.links - layout.lead - seats[3] + seats[2] - 1


@inner
def solve(layout: Layout, seats: Ints, psi: float, x: Floats, work: Work) -> bool:
    """Brings x to the solution for these seats and fills `work`; False where Newton's method does not settle.

    seats (ENDS,): numbers of teeth; psi [rad] of the driver; x (UNKNOWNS,): psi_2 [rad], distance [pitches], both strands' angles [rad].
    """
    for _ in range(_STEPS):
        _equations(layout, seats, psi, x, work)
        if not lu_factor(work.jacobian, work.pivots):
            return False
        lu_solve(work.jacobian, work.pivots, work.step)
        length = 0.0
        for k in range(UNKNOWNS):
            length = max(length, abs(work.step[k]) / max(1.0, abs(x[k])))
        if not length < np.inf:
            return False
        for k in range(UNKNOWNS):
            x[k] += work.step[k] * min(1.0, _LONGEST / max(length, _LONGEST))
        if length < _STILL:
            lu_solve(work.jacobian, work.pivots, work.slope)
            return True
    return False


@inner
def _equations(layout, seats, psi, x, work):
    """Fills misses, margins and Jacobian, and the right sides of the systems for the Newton step and for the slope."""
    upper, lower = free_plates(layout, seats)
    off_1, on_2 = psi + seats[0] * layout.phi_1, x[0] + seats[1] * layout.phi_2
    off_2, on_1 = x[0] + seats[2] * layout.phi_2, psi + seats[3] * layout.phi_1 - 2 * np.pi
    half = 0.5 * layout.A
    leave_1, leave_2 = layout.height_1 - 1j * (half + layout.shift_1), layout.height_2 - 1j * (half + layout.shift_2)
    meet_1, meet_2 = layout.height_1 + 1j * (half - layout.shift_1), layout.height_2 + 1j * (half - layout.shift_2)
    over = _side(layout, upper, leave_1, off_1, meet_2, on_2, x[2], work.strand)
    _margins(layout, layout.phi_1, layout.phi_2, 0, off_1 - x[2], on_2 - x[2], upper, work)
    under = _side(layout, lower, leave_2, off_2, meet_1, on_1, x[3], work.strand)
    _margins(layout, layout.phi_2, layout.phi_1, 2, off_2 - x[3], on_1 - x[3], lower, work)
    _fill(work, 0, over.miss - x[1], over.by_end, -1.0, over.by_start)
    _fill(work, 2, under.miss + x[1], under.by_start, 1.0, under.by_end)
    for k in range(2):
        work.jacobian[k, 3], work.jacobian[2 + k, 2] = 0.0, 0.0
    work.jacobian[0, 2], work.jacobian[1, 2] = over.by_direction.real, over.by_direction.imag
    work.jacobian[2, 3], work.jacobian[3, 3] = under.by_direction.real, under.by_direction.imag


@inner
def _fill(work, row, miss, by_driven, by_distance, by_driver):
    """Two rows of the system: all but the derivatives by the strands' directions."""
    work.miss[row], work.miss[row + 1] = miss.real, miss.imag
    work.step[row], work.step[row + 1] = -miss.real, -miss.imag
    work.slope[row], work.slope[row + 1] = -by_driver.real, -by_driver.imag
    work.jacobian[row, 0], work.jacobian[row + 1, 0] = by_driven.real, by_driven.imag
    work.jacobian[row, 1], work.jacobian[row + 1, 1] = by_distance, 0.0


@inner
def _side(layout, count, arm_start, start, arm_end, end, direction, scratch):
    """The `Side` of a strand from the seated plate at the polar angle `start` of one sprocket to that at `end` of the other one.

    The last pin seated is at arm_start u(start), the first one seated again at arm_end u(end), from the sprockets' centres.
    """
    found = reach(layout.A, layout.r, layout.k, layout.bent, count, start - _QUARTER - direction, end - _QUARTER - direction, scratch)
    turn = np.exp(1j * direction)
    here, there = arm_start * np.exp(1j * start), arm_end * np.exp(1j * end)
    by_start, by_end = turn * found.by_start, turn * found.by_end
    by_direction = 1j * turn * found.vector - by_start - by_end  # turned as a whole, the seated plates left behind
    return Side(here + turn * found.vector - there, 1j * here + by_start, by_end - 1j * there, by_direction)


@inner
def _margins(layout, phi_start, phi_end, end, start_angle, end_angle, count, work):
    """Writes the margins of both ends of the strand just solved: by its first free plate, then by its last."""
    first, last = 0.0, 0.0
    if layout.bent:
        first, last = work.strand[0, 1], work.strand[0, count]
    _margin(layout, layout.k, phi_start, start_angle - _QUARTER, first, 2 * end, work.margins)
    _margin(layout, -layout.k, phi_end, _QUARTER - end_angle, -last, 2 * end + 2, work.margins)


@inner
def _margin(layout, k, phi, seated, first, place, margins):
    """The gap of the first free plate to the next seat [rad], and what presses the last seated one onto its own, see `pressing`.

    `seated` and `first`: their directions against the force, turned back from it; k: the skew as seen from this end.  A strand that is
    straight by decree drops a plate when it points along the strand, as with r = 0.
    """
    margins[place] = phi - (seated - first)
    bent = layout.bent
    margins[place + 1] = pressing(layout.A, layout.r if bent else 0.0, k if bent else 0.0, phi, seated, first)
