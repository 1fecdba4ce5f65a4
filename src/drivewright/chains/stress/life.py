"""Life of a chain's plate around its rim: the stress history of every point, then strain-life fatigue on its critical plane.

Where the elastic stress exceeds the material's cyclic yield stress, Neuber's rule gives the local stress and strain.
"""

from typing import NamedTuple

import numpy as np

from drivewright import fatigue
from drivewright._typing import Floats, Ints
from drivewright.chains.stress.plate import Basis, Loads, amounts
from drivewright.errors import InputError
from drivewright.fatigue.material import StrainLife
from drivewright.result import Column, Table
from drivewright.solids.plane import plane_von_mises
from drivewright.steps import note_step


class PlateLife(NamedTuple):
    """rows (m,) of the rim that were looked at, life (m,) in repeats of the history (inf without damage), damage (m,) a repeat, and the
    greatest von Mises stress (m,) [Pa] of the elastic history."""

    rows: Ints
    life: Floats
    damage: Floats
    stress: Floats


def plate_life(basis: Basis, loads: Loads, material: StrainLife, plane: str = "max-shear", least: float = 0.0) -> PlateLife:
    """`PlateLife` under a history of loads that repeats, with a `fatigue.StrainLife`.

    Flanks that touch the sprocket are left out, as from the search for the worst stress; so are points whose greatest stress stays below
    `least` times that of the worst point, with which a long history is faster.
    """
    if not 0 <= least < 1:
        raise InputError(f"plate life: `least` = {least:g}; it is a share of the maximum stress, from 0 to below 1")
    share, rows = amounts(basis, loads), np.flatnonzero(basis.bare)
    size = _greatest(share, basis.stress[:, rows])
    kept = size >= least * size.max()
    rows, size = rows[kept], size[kept]
    found = life_of_history(fatigue.superpose(share, basis.stress[:, rows]), size, material, plane)
    return PlateLife(rows, found.life, found.damage, size)


def life_of_history(stress: Floats, size: Floats, material: StrainLife, plane: str) -> "fatigue.LifeMap":
    """`fatigue.LifeMap` of elastic stress (nodes, n, 3, 3) [Pa] that repeats; size (nodes,): the greatest von Mises stress of each node.

    Where that exceeds the cyclic yield stress, Neuber's rule gives the local stress and strain, in place.
    """
    strain = fatigue.elastic_strain(stress, material)
    for node in np.flatnonzero(size > material.cyclic_yield):
        stress[node], strain[node] = fatigue.neuber_history(stress[node], material)
    return fatigue.life_map(strain, stress, material, plane, progress=lambda done, total, _: note_step("life of its places", done, total))


def life_table(basis: Basis, found: PlateLife) -> Table:
    """Table "plate_life" for a plot of points: x, y [m], life in repeats, damage a repeat, greatest von Mises stress [Pa]."""
    x, y = basis.body.rim.points[found.rows].T
    return Table(
        "plate_life",
        "Life along the rim of a plate",
        (
            Column("x", "m", "position along the plate", x),
            Column("y", "m", "position across the plate", y),
            Column("life", "-", "life in repeats of the history", found.life),
            Column("damage", "-", "damage per repeat", found.damage),
            Column("mises", "Pa", "maximum von Mises stress", found.stress),
        ),
    )


def _greatest(share, unit_stress):
    """Greatest von Mises stress (m,) over the instants, one at a time to spare the memory."""
    size = np.zeros(unit_stress.shape[1])
    for one in share:
        np.maximum(size, plane_von_mises(np.tensordot(one, unit_stress, axes=1)), out=size)
    return size


def life_map(basis: Basis, lives: PlateLife, side: float) -> Table:
    """Table "life_map" for a plot of style "mesh": squares with a side [m] around the rim, two triangles each, with their
    life; lives without damage are left out."""
    kept = np.isfinite(lives.life)
    centre, half = basis.body.rim.points[lives.rows[kept]], 0.5 * side
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, -1), (1, 1), (-1, 1)]) * half
    x, y = (centre[:, None, :] + corners).reshape(-1, 2).T
    return Table(
        "life_map",
        "Life around a plate",
        (
            Column("x", "m", "position along the plate", x),
            Column("y", "m", "position across the plate", y),
            Column("depth", "m", "depth in the picture", 0 * x),
            Column("life", "-", "life in revolutions of the chain", np.repeat(lives.life[kept], 6)),
        ),
    )
