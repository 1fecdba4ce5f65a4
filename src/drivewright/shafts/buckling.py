"""Buckling of a shaft under its axial forces."""

import numpy as np
import scipy

from drivewright.errors import SolverError
from drivewright.shafts import beam as beams
from drivewright.shafts.assembly import regularisation
from drivewright.shafts.influence import REGULARISATION_FACTOR
from drivewright.shafts.loaded import LoadedShaft, ShaftLoads, apply_loads
from drivewright.shafts.model import Shaft
from drivewright.shafts.vibration import WEIGHT, condense_supports, element_shapes

PLACES = 21  # along the shaft: enough for the shape in which it buckles


def buckling_factor(loaded: LoadedShaft) -> float | None:
    """The least factor on the axial forces at which the shaft buckles; None where none of them presses it.

    det(K + f K_N) = 0 with K the stiffness at rest and K_N = int N t_i t_j dx, N the axial force (tension positive), t the slope of
    the section; pi^2 EI/L^2 for a slender shaft on two supports.
    """
    equilibrium = loaded.equilibrium
    model, beam = equilibrium.model, equilibrium.model.beam
    tension = beams.tension_and_torque(beam, equilibrium.unknowns)[:, 0]
    if not np.any(tension < 0):
        return None
    held, stiff = condense_supports(
        equilibrium.hessian + REGULARISATION_FACTOR * regularisation(model), model.constraints, model.compliance
    )
    basis = model.basis @ held
    geometric = basis[: beam.size].T @ _geometric(beam, tension) @ basis[: beam.size]
    try:
        factors = scipy.linalg.eigh(-geometric, stiff, eigvals_only=True)
    except np.linalg.LinAlgError:
        raise SolverError(
            "shaft: the shaft is so soft compared with its bearings that its buckling load is lost in rounding; check the units of "
            "diameters, bores and Young's modulus"
        ) from None
    return float(1 / factors[-1]) if factors[-1] > 0 else None


def buckling_factor_under(shaft: Shaft, loads: ShaftLoads) -> float | None:
    """`buckling_factor` of a shaft under loads, on nodes at PLACES even places besides its own."""
    return buckling_factor(apply_loads(shaft, loads, np.linspace(0.0, shaft.length, PLACES)))


def _geometric(beam, tension):
    """K_N (6n, 6n) on the displacements of the nodes."""
    _, slope = element_shapes(beam)
    each = np.einsum("n,np,npi,npj->nij", tension, WEIGHT * beam.pieces[:, :1], slope, slope)
    whole = np.zeros((beam.size, beam.size))
    for element, part in enumerate(each):
        for plane in (0, 1):
            at, sign = beams.element_freedoms(element, plane)
            whole[np.ix_(at, at)] += sign[:, None] * part * sign
    return whole
