"""Unit forces at stations beyond the flexibility itself: on bearings that do not yield, and the stress that they make."""

from collections.abc import Sequence

import numpy as np

from drivewright._typing import Floats
from drivewright.shafts.assembly import assemble, nodal_forces
from drivewright.shafts.beam import elastic_line
from drivewright.shafts.equilibrium import ShaftEquilibrium, solve
from drivewright.shafts.influence import Flexibility, flexibility
from drivewright.shafts.model import Shaft, Support
from drivewright.shafts.sections import second_moment

SAMPLES = 181  # along the shaft, besides the nodes


def flexibility_on_rigid_bearings(shaft: Shaft, positions: Sequence[float], direction: Floats) -> tuple[ShaftEquilibrium, Flexibility]:
    """(equilibrium, `Flexibility`) of the same shaft on bearings that do not yield across it, for the comparison.

    Springs against tilting stay as they are; a rolling bearing tilts freely, unless it alone holds the shaft.
    """
    alone = sum(_is_radial(support) for support in shaft.supports) == 1
    supports = tuple(Support(s.name, s.position, _rigid(s, alone), width=s.width) for s in shaft.supports)
    system = assemble(shaft._replace(supports=supports))
    at_rest = solve(system, nodal_forces(system, ()))
    return at_rest, flexibility(at_rest, positions, direction)


def _is_radial(support: Support) -> bool:
    return support.law is not None or support.stiffness[0] > 0


def _rigid(support: Support, alone: bool) -> tuple[float, ...]:
    across = np.inf if _is_radial(support) else 0.0
    tilt = (np.inf, np.inf) if alone and support.law is not None else (0.0, 0.0)
    return (across, across, 0.0, *(support.stiffness[3:] if any(support.stiffness[3:]) else tilt))


def unit_deflection(equilibrium: ShaftEquilibrium, unknowns: Floats, z: Floats, direction: Floats) -> Floats:
    """Deflection (m,) [m/N] along `direction` (x, y) at places z (m,) [m] under a unit force with the unknowns (size,)."""
    return np.sum(
        [way * elastic_line(equilibrium.model.beam, plane, unknowns, z).deflection for plane, way in enumerate(direction)], axis=0
    )


def peak_unit_stress(equilibrium: ShaftEquilibrium, unknowns: Floats, direction: Floats) -> float:
    """Largest bending stress [Pa/N] along the shaft, nominal, under a unit force along `direction` with the unknowns (size,)."""
    beam = equilibrium.model.beam
    length_of_shaft = beam.shaft.length
    tiny = 1e-9 * length_of_shaft
    z = np.sort(np.concatenate([np.linspace(0, length_of_shaft, SAMPLES), beam.z[:-1], beam.z[1:] - tiny]))
    moment = sum(way * elastic_line(beam, plane, unknowns, z).moment for plane, way in enumerate(direction))
    element = np.clip(np.searchsorted(beam.z, z, side="right") - 1, 0, len(beam.pieces) - 1)
    length, start, end, bore = beam.pieces[element].T
    diameter = start + (end - start) * (z - beam.z[element]) / length
    return float(np.max(np.abs(moment) * diameter / 2 / second_moment(diameter, bore)))
