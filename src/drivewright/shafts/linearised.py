"""The shaft about its equilibrium: linear supports with the tangent stiffness that the bearings have there."""

import numpy as np

from drivewright.errors import counted
from drivewright.shafts.assembly import assemble, nodal_forces
from drivewright.shafts.curves import LinearSupport
from drivewright.shafts.equilibrium import ShaftEquilibrium, solve
from drivewright.shafts.model import NOTHING, Shaft

MOST_ELEMENTS = 5000  # of a shaft: its matrices have a tenth of a gigabyte


def tangent_shaft(equilibrium: ShaftEquilibrium) -> Shaft:
    """The shaft on linear supports: those of the equilibrium, each with its tangent stiffness there."""
    shaft, supports = equilibrium.model.beam.shaft, []
    for support, contact in zip(shaft.supports, equilibrium.contact, strict=True):
        if support.law is not None:
            support = support._replace(law=LinearSupport(contact), mirrored=False, coupling=NOTHING)
        supports.append(support._replace(offset=(0.0,) * 5, push=(0.0,) * 5))
    return shaft._replace(supports=tuple(supports))


def refined_equilibrium(equilibrium: ShaftEquilibrium, step: float) -> ShaftEquilibrium:
    """The unloaded `tangent_shaft` at rest on elements of at most `step` [m], as fine as the shapes of the modes need."""
    z = equilibrium.model.beam.z
    counted((z[-1] - z[0]) / step, MOST_ELEMENTS, "elements along the shaft", "make them longer")
    places = np.concatenate([np.linspace(a, b, int(np.ceil((b - a) / step - 1e-9)) + 1) for a, b in zip(z[:-1], z[1:], strict=True)])
    fine = assemble(tangent_shaft(equilibrium), places)
    return solve(fine, 0 * nodal_forces(fine, ()))
