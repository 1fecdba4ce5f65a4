"""The response of an elastic support: energy, force and stiffness at a displacement.

A rolling bearing, a linear spring and a table are the same kind of thing: a NamedTuple of parameters with one formula under
@implements(response, ...).  Under a shaft, in a multibody system or alone, only this interface is used.
"""

from typing import Any

import numpy as np

from drivewright._jit import generic, kernel
from drivewright._typing import ArrayLike, Floats

FREEDOMS = ("x", "y", "z", "tilt_x", "tilt_y")


@generic
def response(law: Any, displacement: Floats, force: Floats, stiffness: Floats) -> float:
    """Energy [J] at `displacement` (5,); writes `force` (5,) = dV/du and `stiffness` (5, 5) = d2V/du2, both whole.

    displacement: of the inner ring against the outer, x, y, z [m] and rotations about x, y [rad], right-handed, z the axis;
    force: what the shaft must do to the inner ring to hold it there [N, N m].
    """
    raise NotImplementedError


def evaluate_response(law: object, displacement: ArrayLike) -> tuple[float, Floats, Floats]:
    """(energy [J], force (5,), stiffness (5, 5)) of a law at a displacement (5,)."""
    force, stiffness = np.zeros(5), np.zeros((5, 5))
    energy = _evaluate_response(law, np.asarray(displacement, dtype=float), force, stiffness)
    return energy, force, stiffness


@kernel
def _evaluate_response(law: Any, displacement: Floats, force: Floats, stiffness: Floats) -> float:
    """`response` from Python: energy [J] at a displacement (5,) [m, rad]; writes force (5,) [N, N m] and stiffness (5, 5)."""
    return response(law, displacement, force, stiffness)
