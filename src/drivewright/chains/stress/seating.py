"""Real contact of both own pins in a plate's holes: round rigid pins with clearance, without friction, one load case.

The second tier behind the cosine law of `bearing`.  Pressures are hats p_j over the seat; with the plate's own answer A to them (one
column a hat) the gap left at hat i is, integrated over it,

    g = c + A p + u0 - D d,   g >= 0,  p >= 0,  g p = 0,   D'p = F,

c the radial clearance, u0 what other loads do, d the shift of the pins' centres, D the hats' own resultants.  Small displacements; an
active set finds which hats bear, and ends.  An elastic pin would spread the pressure a little more: what is found here is an upper bound
of the peak pressure.
"""

from typing import NamedTuple

import numpy as np
import scipy

from drivewright._typing import ArrayLike, Floats
from drivewright.chains.plate import Plate
from drivewright.chains.stress import bearing
from drivewright.chains.stress.plate import SIDES
from drivewright.errors import InputError, SolverError
from drivewright.solids.plane import ALONG_EDGE, PlaneBody

REACH = np.radians(120.0)  # hats to either side of the force, as far as the seat goes
LEAST = 5  # loaded hat functions needed to resolve a pressure
TRIES = 100  # of the active set


class Seating(NamedTuple):
    """turns and pressures, of the left and the right pin: (h,) [rad] of hats from the force's direction and (h,) [Pa] there; shift (2, 2)
    [m] of the pins' centres; stress (n, 3) [Pa] along the rim."""

    turns: tuple[Floats, Floats]
    pressures: tuple[Floats, Floats]
    shift: Floats
    stress: Floats


def seated(plate: Plate, body: PlaneBody, pins: Floats, clearance: float, tractions: ArrayLike | None = None) -> Seating:
    """`Seating` of pins with forces (2, 2) [N] (left, right; x, y) and a radial clearance [m] in the holes of a plate with a `plate_body`.

    tractions (n, 2) [Pa]: other loads along the rim, e.g. those of a flank.  SolverError where the pressure is too narrow for the body.
    """
    pins = np.asarray(pins, float)
    if not (clearance >= 0 and np.hypot(*pins.T).min() > 0):
        raise InputError(
            f"stress: seating needs a clearance of 0 or more, got {1e6 * clearance:g} µm, "
            f"and a force on either pin, got {np.hypot(*pins.T)} N"
        )
    seats = [bearing.seat_of(body, plate, side) for side in SIDES]
    turns, hats = zip(*(_hats(body, *each) for each in zip(seats, pins, SIDES, strict=True)), strict=True)
    other = np.zeros((1, len(body.rim.name), 2)) if tractions is None else np.asarray(tractions, float)[None]
    fields = body.solve(np.concatenate([*(_tractions(body, *each) for each in zip(seats, hats, strict=True)), other]))
    opened, areas, shift = _gaps(seats, hats, body.displacement(fields))
    pressure, moved = _bearing_hats(opened[:, :-1], clearance * areas + opened[:, -1], shift, pins.ravel())
    left, right = np.split(pressure, [len(turns[0])])
    pressures = left, right
    _refuse_narrow(pressures, clearance)
    together = np.append(pressure, 1.0) @ fields
    return Seating(turns, pressures, moved.reshape(2, 2), body.stress(together[None])[0])


def _hats(body, seat, force, side):
    """Turns (h,) [rad] of hats from the force's direction and their values (h, n) at the seat's points: half as many as the elements have
    shape functions there, for finer ones would not be answered."""
    turn = np.angle(np.exp(1j * (seat.turn - bearing.turn_of(force, side)[0])))
    low, high = max(turn.min(), -REACH), min(turn.max(), REACH)
    edges = np.count_nonzero((turn >= low) & (turn <= high)) / ALONG_EDGE
    at = np.linspace(low, high, max(int(edges * body.order / 2), LEAST) + 1)
    return at, np.maximum(1 - np.abs(turn - at[:, None]) / (at[1] - at[0]), 0.0)


def _gaps(seats, hats, wall):
    """What opens at all hats (h, l) under the loads l by the wall's displacement (l, n, 2), the hats' areas (h,), and how far (h, 4) they
    close by a shift of the left and the right pin."""
    outwards = [np.sum(wall[:, seat.rows] * seat.outward, axis=2) for seat in seats]
    opened = np.vstack([(one * seat.area) @ moved.T for seat, one, moved in zip(seats, hats, outwards, strict=True)])
    areas = [one @ seat.area for seat, one in zip(seats, hats, strict=True)]
    shift = scipy.linalg.block_diag(*((one * seat.area) @ seat.outward for seat, one in zip(seats, hats, strict=True)))
    return opened, np.concatenate(areas), shift


def _refuse_narrow(pressures, clearance):
    few = min(np.count_nonzero(pressure) for pressure in pressures)
    if few < LEAST:
        raise SolverError(
            f"stress: with a clearance of {1e6 * clearance:g} µm a pin is in contact at {few} nodes only, and a pressure needs {LEAST}; "
            "take a finer mesh of the body (fineness)"
        )


def _tractions(body, seat, hats):
    found = np.zeros((len(hats), len(body.rim.name), 2))
    found[:, seat.rows] = hats[..., None] * seat.outward
    return found


def _bearing_hats(opened, gap, shift, forces):
    """Pressures and shifts of the linear complementarity above: hats that pull let go, hats that overlap bear, until neither is left."""
    scale, size = opened.trace() / len(gap), np.abs(shift).max()  # pressures and shifts to the size of gaps
    stiff, reach, load = opened / scale, shift / size, forces * scale / size
    touching = np.ones(len(gap), bool)
    for _ in range(TRIES):
        held = np.flatnonzero(touching)
        matrix = np.block([[stiff[np.ix_(held, held)], -reach[held]], [-reach[held].T, np.zeros((len(forces),) * 2)]])
        found = np.linalg.solve(matrix, np.concatenate([-gap[held], -load]))
        pressure, moved = np.zeros(len(gap)), found[len(held) :]
        pressure[held] = found[: len(held)]
        left = gap + stiff @ pressure - reach @ moved
        wanted = np.where(touching, pressure > 0, left < 0)
        if np.array_equal(wanted, touching):
            return pressure / scale, moved / size
        touching = wanted
    raise SolverError(f"stress: the set of loaded nodes did not converge after {TRIES} tries; try another clearance or a finer body")
