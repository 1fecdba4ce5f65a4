"""Round cross-sections, and how a piece of shaft bends and shears: the integrals that every route to its deflection shares.

Kernels of plain numbers; a solid section has the bore 0.
"""

from typing import TypeVar

import numpy as np

from drivewright._jit import kernel, warmer
from drivewright._typing import Floats

NumberT = TypeVar("NumberT", float, Floats)  # one number, or an array of them

# Gauss-Legendre on 0 ... 1: exact to rounding for every taper that turns into a shaft (diameters up to 1 : 4 within one piece).
NODES, WEIGHTS = (0.5 * (part + shift) for part, shift in zip(np.polynomial.legendre.leggauss(24), (1.0, 0.0), strict=True))


@kernel
def area(diameter: NumberT, bore: float | NumberT) -> NumberT:
    """A = pi/4 (D^2 - d^2)  [m^2]."""
    return 0.25 * np.pi * (diameter**2 - bore**2)


@kernel
def second_moment(diameter: NumberT, bore: float | NumberT) -> NumberT:
    """I = pi/64 (D^4 - d^4)  [m^4] about a diameter; twice that about the axis."""
    return np.pi / 64.0 * (diameter**4 - bore**4)


@kernel
def cowper_coefficient(diameter: NumberT, bore: float | NumberT, poisson: float) -> NumberT:
    """Shear coefficient kappa of a round section, m = d/D  (Cowper 1966, recalled; checked against the solid):

    kappa = 6 (1 + nu) (1 + m^2)^2 / [(7 + 6 nu) (1 + m^2)^2 + (20 + 12 nu) m^2].
    """
    m2 = (bore / diameter) ** 2
    whole = (1.0 + m2) ** 2
    return 6.0 * (1.0 + poisson) * whole / ((7.0 + 6.0 * poisson) * whole + (20.0 + 12.0 * poisson) * m2)


@kernel
def cylinder_compliances(diameter: float, bore: float, modulus: float, poisson: float, shear: float) -> tuple[float, float]:
    """(1/EI [1/(N m^2)], 1/(kappa G A) [1/N]) of one section; arguments as for `compliance_integrals`."""
    kappa = shear if shear > 0.0 else cowper_coefficient(diameter, bore, poisson)
    slip = 2.0 * (1.0 + poisson) / (modulus * kappa * area(diameter, bore))
    return 1.0 / (modulus * second_moment(diameter, bore)), 0.0 if shear < 0.0 else slip


@kernel
def compliance_integrals(
    length: float, start: float, end: float, bore: float, modulus: float, poisson: float, shear: float
) -> tuple[float, float, float, float]:
    """(int dx/EI, int x dx/EI, int x^2 dx/EI, int dx/(kappa G A)) over a piece of `length`, x from its start.

    start, end: outer diameters [m], the cone between them straight; bore [m]; modulus E [Pa]; poisson nu.
    shear: a positive number is kappa, 0 means Cowper's, below 0 no shear deformation (Euler-Bernoulli).
    """
    if start == end:
        e, slip = cylinder_compliances(start, bore, modulus, poisson, shear)
        return e * length, 0.5 * e * length**2, e * length**3 / 3.0, slip * length
    g = 0.5 * modulus / (1.0 + poisson)
    zero, first, second, slip = 0.0, 0.0, 0.0, 0.0
    for i in range(len(NODES)):
        diameter = start + (end - start) * NODES[i]
        x, weight = length * NODES[i], length * WEIGHTS[i]
        e = weight / (modulus * second_moment(diameter, bore))
        zero, first, second = zero + e, first + e * x, second + e * x**2
        kappa = shear if shear > 0.0 else cowper_coefficient(diameter, bore, poisson)
        slip += 0.0 if shear < 0.0 else weight / (kappa * g * area(diameter, bore))
    return zero, first, second, slip


@kernel
def compliance_integrals_of(pieces: Floats, modulus: float, poisson: float, shear: float) -> Floats:
    """`compliance_integrals` of many pieces (n, 4) of (length, start, end, bore): (n, 4)."""
    integrals = np.zeros((len(pieces), 4))
    for i in range(len(pieces)):
        length, start, end, bore = pieces[i]
        if length > 0.0:
            integrals[i, 0], integrals[i, 1], integrals[i, 2], integrals[i, 3] = compliance_integrals(
                length, start, end, bore, modulus, poisson, shear
            )
    return integrals


def shear_area(diameter: Floats, bore: Floats, poisson: float, shear: float) -> Floats:
    """kappa A [m^2]; inf without shear deformation.  Arguments as for `compliance_integrals`."""
    if shear < 0:
        return np.full_like(diameter, np.inf)
    return (shear if shear > 0 else cowper_coefficient(diameter, bore, poisson)) * area(diameter, bore)


def log_slopes(diameter: Floats, bore: Floats, poisson: float, shear: float) -> tuple[Floats, Floats, Floats]:
    """(dlnI/dD, dln(kappa A)/dD, dlnA/dD) [1/m], the bore held:  4 D^3/(D^4 - d^4),  2 D/(D^2 - d^2) + dln(kappa)/dD,  2 D/(D^2 - d^2)."""
    by_second_moment, by_area = 4 * diameter**3 / (diameter**4 - bore**4), 2 * diameter / (diameter**2 - bore**2)
    by_shear_area = np.zeros_like(diameter) if shear < 0 else by_area
    return by_second_moment, by_shear_area + (_cowper_slope(diameter, bore, poisson) if shear == 0 else 0.0), by_area


def _cowper_slope(diameter, bore, poisson):
    """dln(kappa)/dD [1/m] of `cowper_coefficient`: with w = (1 + m^2)^2 it is 6 (1 + nu) w/(a w + b m^2), and dm^2/dD = -2 m^2/D."""
    m2 = (bore / diameter) ** 2
    whole, steep, a, b = (1 + m2) ** 2, 2 * (1 + m2), 7 + 6 * poisson, 20 + 12 * poisson
    return -2 * m2 / diameter * (steep / whole - (a * steep + b) / (a * whole + b * m2))


@warmer
def warm_sections() -> None:
    """Compile for `doctor --warm`."""
    compliance_integrals_of(np.array([[1.0, 1.0, 1.0, 0.0]]), 1.0, 0.3, 0.0)
