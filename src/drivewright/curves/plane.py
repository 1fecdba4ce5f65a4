"""Differential geometry of plane curves z(t) = x + i y, given as complex jets of a parameter.

Left of the direction of travel is positive: the normal is i times the tangent, curvature is positive where the curve turns left.
A quantity built from the first derivative has one derivative less than the curve; the missing one is nan, never a guess.
"""

import numpy as np

from drivewright._typing import Floats, Numbers
from drivewright.errors import InputError
from drivewright.numerics.jets import Jet, exp


def derivative(jet: Jet) -> Jet:
    """Jet of f' from the jet of f; its third derivative is unknown and nan."""
    return Jet(jet.d1, jet.d2, jet.d3, np.full_like(jet.d3, np.nan))


def tangent(jet: Jet) -> Jet:
    """Unit tangent z'/|z'| as a jet (third derivative nan)."""
    _refuse_standstill(jet, "tangent")
    velocity = derivative(jet)
    return velocity * velocity.abs2() ** -0.5


def normal(jet: Jet) -> Jet:
    """Unit normal i z'/|z'| as a jet (third derivative nan); it points to the left of travel."""
    return 1j * tangent(jet)


def curvature(jet: Jet) -> Floats:
    """kappa = Im(conj(z') z'') / |z'|^3  [1/m], positive where the curve turns left."""
    _refuse_standstill(jet, "curvature")
    return np.imag(np.conj(jet.d1) * jet.d2) / np.abs(jet.d1) ** 3


def curvature_rate(jet: Jet) -> Floats:
    """d kappa/ds = (Im(conj(z') z''') |z'|^2 - 3 Im(conj(z') z'') Re(conj(z') z'')) / |z'|^6  [1/m^2]."""
    _refuse_standstill(jet, "curvature_rate")
    along, second, third = np.abs(jet.d1) ** 2, np.conj(jet.d1) * jet.d2, np.conj(jet.d1) * jet.d3
    return (np.imag(third) * along - 3 * np.imag(second) * np.real(second)) / along**3


def offset(jet: Jet, distance: Numbers) -> Jet:
    """Parallel curve at `distance` [m] to the left (right if negative): z + distance i z'/|z'|, third derivative nan.

    It has a cusp where distance * curvature = 1 and runs backwards where the product is larger.
    """
    return jet + Jet(*(distance * part for part in normal(jet)))


def envelope_of_circle(centre: Jet, radius: float, side: Numbers) -> Jet:
    """Envelope of a circle of `radius` whose centre runs along the jet `centre`: its left (side=+1) or right (side=-1) branch."""
    return offset(centre, side * radius)


def envelope_of_line(direction: Jet, support: Jet) -> Jet:
    """Contact point of the moving line Re(conj(n) z) = p, n = e^{i beta}: q = (p + i p'/beta') n, third derivative nan.

    direction is the jet of beta(t) [rad], support that of p(t) [m].  q' = i n (beta' p + (p'/beta')'), along the line.
    Raises InputError where beta' is 0: there the line only translates and touches its envelope nowhere.
    """
    slope = np.broadcast_to(direction.d1, np.shape(direction.d0))
    if np.any(slope == 0):
        raise InputError(
            f"envelope_of_line: the line does not turn at {np.sum(slope == 0)} of {slope.size} points (beta' = 0), so it has no "
            "contact point there. Leave out the points where the line only translates."
        )
    return (support + 1j * (derivative(support) / derivative(direction))) * exp(1j * direction)


def _refuse_standstill(jet, what):
    still = np.broadcast_to(jet.d1, np.broadcast(*jet).shape) == 0
    if np.any(still):
        place = np.broadcast_to(jet.d0, still.shape)[still][0]
        raise InputError(
            f"{what}: the curve does not move (z' = 0) at {np.sum(still)} of {still.size} points, first at "
            f"({place.real:.6g}, {place.imag:.6g}) m. A cusp or a rest has no tangent; leave those points out."
        )
