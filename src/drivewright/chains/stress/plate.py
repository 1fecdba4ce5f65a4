"""Stress of a chain's plate through a history of loads, by superposition.

One factorisation of the free plate answers to the pins' pressures in a fan of directions and to pressures along the flanks; every instant
of a history is a linear combination of these.  What a history leaves unbalanced accelerates the plate, and the inertia forces of that
motion are in the answer (`solids.plane`).  Flanks are loaded by hat-shaped pressures, right in force and moment: the stress of the very
contact is Hertz's (`contact.hertz`) and not in here, so the loaded flanks take no part in the search for the worst place.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Bools, Floats
from drivewright.chains.plate import Plate
from drivewright.chains.stress import bearing
from drivewright.errors import InputError
from drivewright.result import Column, Table
from drivewright.scene import Arc
from drivewright.solids.plane import PlaneBody, StressSurface, field_table, plane_von_mises
from drivewright.solids.plane_meshing import plane_mesh

SIDES = ("left", "right")
HAT = 0.05  # of the pitch: between neighbouring places on a flank


class Loads(NamedTuple):
    """Forces on one plate at n instants; one plate's share of its link's.

    pins (n, 2, 2) [N]: force (x, y) of the left and the right pin, in the pin frame.  flanks (n, 2) [N]: normal force on the left and the
    right outer flank, above 0 pressing.  heights (n, 2) [m]: where, as y of the pin frame; not read where the force is 0.
    """

    pins: ArrayLike
    flanks: ArrayLike
    heights: ArrayLike


class Basis(NamedTuple):
    """A plate's answer to unit forces, L = 2 K pins' directions + 2 M places on the flanks.

    body, its rim and elements; directions: turns of the left and of the right pin's forces [rad]; heights: places [m] on the left and the
    right flank; tractions (L, n, 2) and stress (L, n, 3) [Pa/N] along the rim; surface: stress all over; bare (n,): points of the rim
    that no flank's pressure touches.
    """

    body: PlaneBody
    directions: tuple[Floats, Floats]
    heights: tuple[Floats, Floats]
    tractions: Floats
    stress: Floats
    surface: StressSurface
    bare: Bools


class Peak(NamedTuple):
    """Greatest von Mises stress [Pa] on the rim, its instant, its row of the rim and its place (x, y) [m]."""

    stress: float
    instant: int
    row: int
    place: tuple[float, float]


def plate_body(plate: Plate, modulus: float, poisson: float, *, fineness: float = 1.0, order: int = 4) -> PlaneBody:
    """`PlaneBody` of a `chains.plate.Plate`; a fineness of 2 halves all elements."""
    size, small = 0.08 * plate.link.pitch / fineness, 0.03 * plate.link.pitch / fineness
    fine = {"hole*": small} | {_flank(plate, side): small for side in SIDES}
    for label, pieces in {"outline": plate.pieces, **{f"hole{k}": plate.hole(side) for k, side in enumerate(SIDES)}}.items():
        fine |= {
            f"{label}:{k}": min(small, piece.radius * abs(piece.sweep) / 2 / fineness)
            for k, piece in enumerate(pieces.values())
            if isinstance(piece, Arc)
        }
    mesh = plane_mesh(plate.outline, plate.holes, size=size, fine=fine, name="chain plate")
    return PlaneBody(mesh, thickness=plate.thickness, modulus=modulus, poisson=poisson, order=order)


def plate_basis(plate: Plate, body: PlaneBody) -> Basis:
    """The `Basis` of a plate with a body made by `plate_body`."""
    seats = [bearing.seat_of(body, plate, side) for side in SIDES]
    left, right = seats
    turns = bearing.directions(left), bearing.directions(right)
    heights = _places(plate, "left"), _places(plate, "right")
    tractions = np.concatenate(
        [
            *(_pin_tractions(body, *each) for each in zip(seats, turns, SIDES, strict=True)),
            *(_flank_tractions(body, plate, *each) for each in zip(heights, SIDES, strict=True)),
        ]
    )
    fields = body.solve(tractions)
    bare = ~np.any([body.on(_flank(plate, side)) for side in SIDES], axis=0)
    return Basis(body, turns, heights, tractions, body.stress(fields), body.surface(fields), bare)


def amounts(basis: Basis, loads: Loads) -> Floats:
    """Linear combinations (n, L) [N] of the basis that make up the loads."""
    pins, flanks, places = (np.asarray(part, float) for part in loads)
    if not (pins.ndim == 3 and pins.shape[1:] == (2, 2) and flanks.shape == places.shape == pins.shape[:2]):
        raise InputError(
            f"stress: pins {pins.shape}, flanks {flanks.shape} and heights {places.shape}; n instants "
            "take the shapes (n, 2, 2), (n, 2) and (n, 2)"
        )
    if not (np.isfinite(pins).all() and np.isfinite(flanks).all() and (flanks >= 0).all()):
        raise InputError(
            f"stress: forces must be finite, and those on the flanks not below 0 (above 0 they press); "
            f"the smallest is {np.min(flanks):.4g} N"
        )
    on_pins = [
        bearing.shares(turn, ready, size)
        for (turn, size), ready in zip((bearing.turn_of(pins[:, k], side) for k, side in enumerate(SIDES)), basis.directions, strict=True)
    ]
    return np.hstack([*on_pins, *(_hat_shares(flanks[:, k], places[:, k], basis.heights[k], side) for k, side in enumerate(SIDES))])


def stress_history(basis: Basis, loads: Loads, rows: Sequence[int] | slice = slice(None)) -> Floats:
    """Stress (n, points, 3) [Pa] at points of the rim (all, or some `rows`) through the history."""
    return np.tensordot(amounts(basis, loads), basis.stress[:, rows], axes=1)


def unbalanced(basis: Basis, loads: Loads) -> tuple[Floats, Floats]:
    """Forces (n, 2) [N] and moments about the pin frame's origin (n,) [N m] that accelerate the plate."""
    forces, moments = basis.body.resultant(basis.tractions)
    share = amounts(basis, loads)
    return share @ forces, share @ moments


def worst(basis: Basis, loads: Loads) -> Peak:
    """The `Peak` over all instants and all points of the rim but those on the flanks that touch the sprocket."""
    share, top = amounts(basis, loads), Peak(-1.0, 0, 0, (np.nan, np.nan))
    for instant, one in enumerate(share):  # one at a time: a long history would fill the memory
        size = np.where(basis.bare, plane_von_mises(np.tensordot(one, basis.stress, axes=1)), 0.0)
        row = int(size.argmax())
        if size[row] > top.stress:
            x, y = map(float, basis.body.rim.points[row])
            top = Peak(float(size[row]), instant, row, (x, y))
    return top


def stress_picture(basis: Basis, loads: Loads, instant: int) -> Table:
    """Table "plate_stress" for a plot of style "mesh": x, y, depth, von Mises stress [Pa] at one instant."""
    one = Loads(*(np.asarray(part, float)[instant : instant + 1] for part in loads))
    size = plane_von_mises(np.tensordot(amounts(basis, one)[0], basis.surface.stress, axes=1))
    return field_table("plate_stress", "Von Mises stress of a plate", basis.surface, (Column("mises", "Pa", "von Mises stress", size),))


def _flank(plate, side):
    """Name of the mesh's boundary that is the outer flank."""
    return f"outline:{list(plate.pieces).index(f'flank {side}')}"


def _places(plate, side):
    """Heights (m,) [m] at which a flank is loaded, the lowest and the highest one hat's half width from its ends; ascending."""
    low, high = sorted(point[1] for point in plate.flank(side))
    count = max(int((high - low) / (HAT * plate.link.pitch)), 4)
    return np.linspace(low, high, count + 1)[1:-1]


def _pin_tractions(body, seat, turns, side):
    """Tractions (k, n, 2) [Pa/N] of unit forces in each of the directions (k,)."""
    found = np.zeros((len(turns), len(body.rim.name), 2))
    sign = 1.0 if side == "right" else -1.0
    for one, turn in zip(found, turns, strict=True):
        pressure = bearing.cosine_pressure(seat, (sign * np.cos(turn), sign * np.sin(turn)))
        one[seat.rows] = pressure[:, None] * seat.outward
    return found


def _flank_tractions(body, plate, heights, side):
    """Tractions (m, n, 2) [Pa/N] of unit forces into the flank, with hat-shaped pressures about the heights (m,)."""
    rows = np.flatnonzero(body.on(_flank(plate, side)))
    hats = np.maximum(1 - np.abs(body.rim.points[rows, 1] - heights[:, None]) / (heights[1] - heights[0]), 0.0)
    hats /= (hats * body.rim.lengths[rows]).sum(axis=1, keepdims=True) * body.thickness
    found = np.zeros((len(heights), len(body.rim.name), 2))
    found[:, rows] = -hats[..., None] * body.rim.normals[rows]
    return found


def _hat_shares(force, height, places, side):
    """Amounts (n, m) of the hats about the places: linear between neighbours, which keeps force and moment."""
    pressed = force > 0
    lost = np.flatnonzero(pressed & ~((height >= places[0]) & (height <= places[-1])))
    if len(lost):
        raise InputError(
            f"stress: the {side} flank is pressed at a height of {1e3 * height[lost[0]]:.4g} mm (instant {lost[0]}, "
            f"{len(lost)} in all), and can be between {1e3 * places[0]:.4g} and {1e3 * places[-1]:.4g} mm; "
            "move contact or ends of the flank"
        )
    at = np.where(pressed, (height - places[0]) / (places[1] - places[0]), 0.0)
    return np.where(pressed, force, 0.0)[:, None] * np.maximum(1 - np.abs(at[:, None] - np.arange(len(places))), 0.0)
