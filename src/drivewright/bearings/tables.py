"""Rolling bearings as tables of a result: the load on every element, and stiffness over load."""

import numpy as np

from drivewright._typing import Floats
from drivewright.bearings.solving import BearingEquilibrium
from drivewright.bearings.stiffness_curve import LoadCurve
from drivewright.result import Column, Table


def element_table(state: BearingEquilibrium, name: str, title: str) -> Table:
    """A row for every rolling element by its place, the first again at the end."""
    n = len(state.element_loads)
    angle = 2 * np.pi * np.arange(n + 1) / n + state.bearing.first_element
    columns = (
        Column("angle", "rad", "place of the element, from x towards y", angle),
        Column("load", "N", "load", _closed(state.element_loads)),
        Column("contact_angle", "rad", "contact angle", _closed(state.contact_angles)),
        Column("inner_pressure", "Pa", "peak pressure at the inner race", _closed(state.pressures[:, 0])),
        Column("outer_pressure", "Pa", "peak pressure at the outer race", _closed(state.pressures[:, 1])),
    )
    return Table(name, title, columns)


def _closed(data: Floats) -> Floats:
    """Once round: the first element again at the end."""
    return np.concatenate([data, data[:1]])


def load_curve_table(curve: LoadCurve, name: str, title: str) -> Table:
    """A row for every load of a `LoadCurve`."""
    columns = (
        Column("load", "N", "radial force, axial force in proportion", curve.load),
        Column("displacement", "m", "radial displacement", curve.displacement),
        Column("tangent", "N/m", "tangent stiffness", curve.tangent),
        Column("secant", "N/m", "secant stiffness", curve.secant),
    )
    return Table(name, title, columns)
