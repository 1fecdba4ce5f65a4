"""How a pin presses on its seat in a plate: the cosine law, in any direction.

The pressure max(c.q, 0) over the seat, q pointing out of the pin, has the resultant that c is chosen for.  Where no end of the seat cuts
it off this is the cosine law, 4 F/(pi d t) at its peak.  It turns with the force, so a plate's answer is not linear in the force's
components: a force between two directions is put together from the pressures of both, which is exact in force and moment, and exact in
pressure but within one step of the ends of the half seat that bears.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats, Ints
from drivewright.chains.plate import Plate
from drivewright.errors import InputError, SolverError
from drivewright.scene import Arc
from drivewright.solids.plane import PlaneBody

STEP = np.radians(10.0)  # between neighbouring directions
SMALL = 0.05  # of the greatest force: what a strand that is nearly slack leaves to a pin
MARGIN = np.radians(30.0)  # of a direction from the end of an open seat


class Seat(NamedTuple):
    """Points of a plate's rim on which the pin of one side bears: `rows` (n,) of the rim, unit vectors q (n, 2) out of the pin, areas
    (n,) [m^2] of the bearing surface, `turn` (n,) [rad] of q from the plate's end outwards, counter-clockwise, and the radius [m]."""

    rows: Ints
    outward: Floats
    area: Floats
    turn: Floats
    radius: float


def seat_of(body: PlaneBody, plate: Plate, side: str) -> Seat:
    """The `Seat` at the "left" or "right" end: all arcs of the hole that lie on the seat's circle."""
    circle, number = plate.seat(side), ("left", "right").index(side)
    same = [
        f"hole{number}:{place}"
        for place, piece in enumerate(plate.hole(side).values())
        if isinstance(piece, Arc) and np.allclose([*piece.center, piece.radius], [*circle.center, circle.radius], rtol=0, atol=1e-9)
    ]
    rows = np.flatnonzero(np.any([body.on(name) for name in same], axis=0))
    outward = body.rim.points[rows] - circle.center
    outward /= np.hypot(*outward.T)[:, None]
    turn = np.angle((outward[:, 0] + 1j * outward[:, 1]) * _end(side))
    return Seat(rows, outward, body.thickness * body.rim.lengths[rows], turn, circle.radius)


def directions(seat: Seat) -> Floats:
    """Turns (k,) [rad] from the outward direction for which a force on the seat is prepared, not more than 10 deg apart."""
    low, high = seat.turn.min() + MARGIN, seat.turn.max() - MARGIN
    if np.diff(np.sort(seat.turn)).max() < MARGIN and high - low > 2 * np.pi - 3 * MARGIN:  # all around
        low, high = -np.pi, np.pi
    if not low < 0 < high:
        raise InputError(
            f"stress: a seat from {np.degrees(seat.turn.min()):.4g} to {np.degrees(seat.turn.max()):.4g}° about the outer "
            f"direction; a pin's pressure needs {np.degrees(MARGIN):g}° on either side of its force"
        )
    return np.linspace(low, high, int(np.ceil((high - low) / STEP)) + 1)


def cosine_pressure(seat: Seat, force: ArrayLike) -> Floats:
    """Pressure (n,) [Pa] at the seat's points, max(c.q, 0), whose resultant is the force (2,) [N]; Newton's method for c."""
    force = np.asarray(force, float)
    half = seat.area.sum() / np.sum(np.abs(np.diff(np.sort(seat.turn)))) * np.pi / 2  # r t pi/2: int of cos^2 over half a circle
    c = force / half
    for _ in range(60):
        pressing = seat.outward @ c > 0
        product = (seat.area * pressing)[:, None] * seat.outward
        miss = product.T @ (seat.outward @ c) - force
        if np.abs(miss).max() < 1e-12 * np.abs(force).max():
            return np.maximum(seat.outward @ c, 0.0)
        c = c - np.linalg.solve(product.T @ seat.outward, miss)
    raise SolverError(
        f"stress: no pressure on the seat gives a force along {np.degrees(np.arctan2(*force[::-1])):.4g}°; give forces "
        "that point out of the plate's end"
    )


def shares(turns: Floats, seat_directions: Floats, size: Floats) -> Floats:
    """Amounts (n, k) of the pressures of prepared directions (k,) that give forces (n,) of a size [N] and turn [rad].

    f sin(t1 - t)/sin(t1 - t0) and f sin(t - t0)/sin(t1 - t0) of the neighbours t0, t1.  Raises InputError for a force that points
    elsewhere and is not small, below `SMALL` of the greatest; a small one acts at the end of the seat.
    """
    turns, size = np.asarray(turns, float), np.asarray(size, float)
    outside = (turns < seat_directions[0]) | (turns > seat_directions[-1])
    lost = np.flatnonzero(outside & (size > SMALL * size.max(initial=0.0)))
    if len(lost):
        worst = lost[size[lost].argmax()]
        raise InputError(
            f"stress: at {len(lost)} of {len(size)} instants a pin's force points away from its seat, worst at instant "
            f"{worst}: {size[worst]:.4g} N at {np.degrees(turns[worst]):.4g}° from the outward direction; "
            f"the seat takes {np.degrees(seat_directions[0]):.4g} to {np.degrees(seat_directions[-1]):.4g}°; "
            "the chain may be slack there"
        )
    turns = np.clip(turns, seat_directions[0], seat_directions[-1])
    left = np.clip(np.searchsorted(seat_directions, turns, side="right") - 1, 0, len(seat_directions) - 2)
    low, high = seat_directions[left], seat_directions[left + 1]
    amounts, rows = np.zeros((len(turns), len(seat_directions))), np.arange(len(turns))
    amounts[rows, left] = size * np.sin(high - turns) / np.sin(high - low)
    amounts[rows, left + 1] = size * np.sin(turns - low) / np.sin(high - low)
    return amounts


def turn_of(forces: Floats, side: str) -> tuple[Floats, Floats]:
    """Turns (n,) [rad] of forces (n, 2) from the outward direction of a side, and their sizes (n,) [N]."""
    forces = np.asarray(forces, float)
    along = forces[..., 0] + 1j * forces[..., 1]
    return np.angle(along * _end(side)), np.abs(along)


def _end(side):
    return 1.0 if side == "right" else -1.0
