"""Oil film of a line contact that is elastic and under pressure that thickens the oil: the formulas of Dowson and Higginson.

With the viscosity eta0 [Pa s] at the inlet, the pressure-viscosity coefficient alpha [1/Pa], the mean speed u [m/s] at which both surfaces
carry oil into the contact, the effective radius R [m], the load per width w [N/m] and E' = 2 E* [Pa]:

    U = eta0 u/(E' R),    G = alpha E',    W = w/(E' R)
    h_min = 2.65 R U^0.70 G^0.54 W^-0.13      Dowson & Higginson (1966), recalled
    h_cen = 3.06 R U^0.69 G^0.56 W^-0.10      Dowson & Toyoda (1979), recalled

Steady, isothermal, smooth, fully flooded.  The tests solve Reynolds' equation in the inlet (Ertel, Grubin) beside them.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats, Numbers


class LineFilm(NamedTuple):
    """Thickness [m] of the film in the middle of the contact, and the least one, near its outlet."""

    central: Floats
    minimum: Floats


def line_film(speed: Numbers, load: Numbers, radius: Numbers, modulus: Numbers, viscosity: float, pressure_viscosity: float) -> LineFilm:
    """The `LineFilm` at an entrainment speed u [m/s] of either sign, load per width [N/m], effective radius [m], E* [Pa].

    0 where no oil is carried in, inf where nothing presses.
    """
    u, w = np.abs(np.asarray(speed, dtype=float)), np.maximum(np.asarray(load, dtype=float), 0.0)
    stiff = 2 * np.asarray(modulus, dtype=float) * radius
    with np.errstate(divide="ignore", invalid="ignore"):
        speed_group, load_group, material = viscosity * u / stiff, w / stiff, 2 * pressure_viscosity * np.asarray(modulus, dtype=float)
        central = 3.06 * radius * speed_group**0.69 * material**0.56 * load_group**-0.10
        minimum = 2.65 * radius * speed_group**0.70 * material**0.54 * load_group**-0.13
    moved = u > 0
    return LineFilm(np.where(moved, central, 0.0), np.where(moved, minimum, 0.0))


def film_ratio(thickness: Numbers, roughness: Numbers) -> Floats:
    """Lambda = h_min/sigma: least film over the composite rms roughness sigma = sqrt(Rq1^2 + Rq2^2) [m]."""
    return np.asarray(thickness) / roughness
