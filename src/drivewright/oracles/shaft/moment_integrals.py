"""The same shaft by integrals that share no formula with the elements: M^2/EI by quadrature, redundant reactions by least squares.

With the deflection w and loads positive one way, EI w'' = sum F_i <x - s_i> - sum R_j <x - x_j>, and shear adds
w' = -sum F_i <x - s_i>^0/(kappa G A): w(x) = C1 x + C2 + sum of influence functions g(x, s).
"""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from drivewright._jit import plain
from drivewright._typing import ArrayLike, Floats
from drivewright.shafts.loaded import LoadedShaft
from drivewright.shafts.model import Shaft
from drivewright.shafts.sections import area, cowper_coefficient, second_moment

PlacedForces: TypeAlias = list[tuple[float, float]]  # (place [m], force [N] or couple [N m])
NODES, WEIGHTS = np.polynomial.legendre.leggauss(32)


def compliance(shaft: Shaft, z: Floats) -> tuple[Floats, Floats]:
    """(1/EI [1/(N m^2)], 1/(kappa G A) [1/N]) at places z (n,) [m], by looking the section up."""
    ends = shaft.ends
    at = np.clip(np.searchsorted(ends, z, side="right") - 1, 0, len(shaft.sections) - 1)
    length, start, end, bore = np.array([section[:4] for section in shaft.sections], float)[at].T
    diameter = start + (end - start) * (z - ends[at]) / length
    g = shaft.modulus / 2 / (1 + shaft.poisson)
    kappa = shaft.shear if shaft.shear > 0 else plain(cowper_coefficient)(diameter, bore, shaft.poisson)
    bend = 1 / (shaft.modulus * plain(second_moment)(diameter, bore))
    return bend, 0 * bend if shaft.shear < 0 else 1 / (kappa * g * plain(area)(diameter, bore))


def influence(shaft: Shaft, x: float, s: float, couple: bool = False) -> float:
    """g(x, s) = int_s^x (x - t)(t - s)/EI dt - int_s^x dt/(kappa G A), 0 for x <= s; 32 Gauss points between two steps.

    Of a couple at s, positive as it lowers the slope right of it: -int_s^x (x - t)/EI dt.
    """
    if x <= s:
        return 0.0
    cuts = np.concatenate([[s], shaft.ends[(shaft.ends > s) & (shaft.ends < x)], [x]])
    total = 0.0
    for a, b in zip(cuts[:-1], cuts[1:], strict=True):
        t = 0.5 * (b - a) * NODES + 0.5 * (b + a)
        bend, slip = compliance(shaft, t)
        part = -(x - t) * bend if couple else (x - t) * (t - s) * bend - slip
        total += 0.5 * (b - a) * float(np.sum(WEIGHTS * part))
    return total


def deflections(shaft: Shaft, springs: ArrayLike, forces: PlacedForces, wanted: Sequence[float]) -> Floats:
    """Deflection (w,) [m] at places `wanted` under `forces` [(place, force)] on `springs` [(place, stiffness)], inf is rigid.

    Unknowns C1, C2 and the reactions: w(x_j) = R_j/k_j, and the forces and moments balance.  Any number of springs from two on.
    """
    places, stiff = np.array(springs, float).T
    n = len(places)
    matrix, right = np.zeros((n + 2, n + 2)), np.zeros(n + 2)
    for row, x in enumerate(places):
        matrix[row, :2] = x, 1.0
        matrix[row, 2:] = [-influence(shaft, x, s) for s in places]
        matrix[row, 2 + row] -= 1 / stiff[row]
        right[row] = -sum(force * influence(shaft, x, s) for s, force in forces)
    matrix[n, 2:], right[n] = 1.0, sum(force for _, force in forces)
    matrix[n + 1, 2:], right[n + 1] = places, sum(s * force for s, force in forces)
    scale = np.abs(matrix).max(axis=0)
    constants = np.linalg.solve(matrix / scale, right) / scale
    return np.array(
        [
            constants[0] * x
            + constants[1]
            + sum(f * influence(shaft, x, s) for s, f in forces)
            - sum(r * influence(shaft, x, s) for s, r in zip(places, constants[2:], strict=True))
            for x in wanted
        ]
    )


def flexibility(shaft: Shaft, springs: ArrayLike, places: Sequence[float]) -> Floats:
    """Flexibility (s, s) [m/N] between places."""
    return np.stack([deflections(shaft, springs, [(place, 1.0)], places) for place in places], axis=1)


def acting(loaded: LoadedShaft, axis: int) -> tuple[PlacedForces, PlacedForces]:
    """([(place, force)], [(place, couple)]) of loads and reactions on the shaft in the plane x (axis 0) or y (1).

    A couple counts as it turns the slope; spread loads and weight come as many forces.
    """
    beam, reactions = loaded.equilibrium.model.beam, loaded.equilibrium.reactions
    across, sign = 4 - axis, 1 - 2 * axis
    nodes = loaded.points.reshape(-1, 6)
    forces = [(z, f) for z, f in zip(beam.z, nodes[:, axis], strict=True) if f]
    couples = [(z, sign * m) for z, m in zip(beam.z, nodes[:, across], strict=True) if m]
    for mount, reaction in zip(loaded.equilibrium.model.mounts, reactions, strict=True):
        forces.append((mount.support.position, reaction[axis]))
        couples.append((mount.support.position, sign * reaction[across]))
    for left, piece, (a, b, c) in zip(beam.z, beam.pieces, loaded.spread[axis], strict=False):
        t = 0.5 * piece[0] * (NODES + 1)
        if a or b or c:
            forces += list(zip(left + t, 0.5 * piece[0] * WEIGHTS * (a + b * t + c * t**2), strict=True))
    return forces, couples


def deflections_through(
    shaft: Shaft,
    first: tuple[float, float],
    last: tuple[float, float],
    forces: PlacedForces,
    couples: PlacedForces,
    wanted: Sequence[float],
) -> list[float]:
    """Deflection at places `wanted` of the free shaft under forces that balance, through two points (place, deflection)."""

    def deflection(x: float) -> float:
        return sum(f * influence(shaft, x, s) for s, f in forces) + sum(m * influence(shaft, x, s, couple=True) for s, m in couples)

    (a, u), (b, v) = first, last
    slope = ((v - deflection(b)) - (u - deflection(a))) / (b - a)
    return [deflection(x) + u - deflection(a) + slope * (x - a) for x in wanted]
