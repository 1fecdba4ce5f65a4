"""Displacement and stiffness of one rolling bearing over its load."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.bearings.solving import RollingBearing, contact_of, solve


class LoadCurve(NamedTuple):
    """Arrays (n,): radial force [N], displacement along it [m], tangent and secant stiffness [N/m]; secant nan without displacement."""

    load: Floats
    displacement: Floats
    tangent: Floats
    secant: Floats


def load_curve(bearing: RollingBearing, force: Sequence[float] | Floats, factors: Sequence[float] | Floats) -> LoadCurve:
    """The `LoadCurve` of a bearing under multiples of a force (Fx, Fy, Fz) [N] with a radial part; its rings stay parallel.

    A bearing that resists no axial displacement, one of cylindrical rollers, is held along the axis.  Errors as those of `solve`.
    """
    radial = float(np.hypot(force[0], force[1]))
    way = np.array([force[0], force[1]]) / radial
    constraints = ("tilt_x", "tilt_y") + (() if contact_of(bearing) == "point" or bearing.contact_angle else ("z",))
    load = np.array([*force[:2], 0.0 if "z" in constraints else force[2], 0.0, 0.0])
    rows = []
    for factor in factors:
        equilibrium = solve(bearing, force=factor * load, held=constraints)
        displacement, size = float(way @ equilibrium.displacement[:2]), factor * radial
        rows.append(
            (size, displacement, float(way @ equilibrium.stiffness[:2, :2] @ way), size / displacement if displacement > 0 else np.nan)
        )
    return LoadCurve(*np.array(rows).T)
