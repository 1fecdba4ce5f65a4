"""Whether forces and moments balance, summed from the loads as they were given: independent of the elements and unknowns of the solver."""

from collections.abc import Sequence

import numpy as np

from drivewright._typing import Floats
from drivewright.shafts.influence import Flexibility
from drivewright.shafts.loaded import LoadedShaft, ShaftLoads
from drivewright.shafts.model import Shaft
from drivewright.shafts.sections import NODES, WEIGHTS, area


def imbalance(loaded: LoadedShaft, loads: ShaftLoads) -> float:
    """What is left of forces and moments on the shaft, over the sum of their magnitudes (moments: with the length as the arm) [-].

    Loads, weight and reactions about the left end: sum F = 0, sum (z x F + M) = 0 about x and y.  0 where nothing acts.
    """
    shaft = loaded.equilibrium.model.beam.shaft
    rows = [_row(load.position, load.force, load.moment) for load in loads.points]
    rows += [row for load in loads.lines for row in _line(load)]
    rows += list(_weight(shaft, loads.gravity))
    for support, reaction in zip(shaft.supports, loaded.equilibrium.reactions, strict=True):
        rows.append(_row(support.position, reaction[:3], (*reaction[3:], 0.0)))
    return residual(np.array(rows), shaft.length)


def residual(rows: Floats, length: float) -> float:
    """The same of rows (n, 5): force (x, y, z) and moment about x and y at the left end."""
    total = np.abs(rows[:, :3]).sum() + np.abs(rows[:, 3:]).sum() / length
    if not total > 0:
        return 0.0
    return float(np.abs(rows.sum(axis=0) / (1.0, 1.0, 1.0, length, length)).max() / total)


def unit_imbalance(flexibility: Flexibility, shaft: Shaft, positions: Sequence[float], direction: Sequence[float] | Floats) -> float:
    """The largest `imbalance` of the unit loads of a `Flexibility`."""
    worst = 0.0
    for column, position in enumerate(positions):
        rows = [_row(position, (*direction, 0.0), (0.0, 0.0, 0.0))]
        rows += [
            _row(support.position, -force[:3, column], -force[3:, column])
            for support, force in zip(shaft.supports, flexibility.support_forces, strict=True)
        ]
        worst = max(worst, residual(np.array(rows), shaft.length))
    return worst


def _row(z, force, moment):
    """Force and moment about the left end: r x F = (-z F_y, z F_x)."""
    return *force, moment[0] - z * force[1], moment[1] + z * force[0]


def _line(load):
    """A load that runs linearly from one end to the other, as two triangles with their centroids."""
    length = load.end - load.start
    for near, far, ends in ((load.start, load.end, load.first), (load.end, load.start, load.last)):
        force = (0.5 * length * ends[0], 0.5 * length * ends[1], 0.0)
        yield _row((2 * near + far) / 3, force, (0.0, 0.0))


def _weight(shaft, gravity):
    """Weight of the sections by quadrature, and of the stations' masses."""
    if not any(gravity):
        return
    for section, start in zip(shaft.sections, shaft.ends, strict=False):
        diameter = section.start + (section.end - section.start) * NODES
        for part, weight, place in zip(np.asarray(area(diameter, section.bore)), WEIGHTS, NODES, strict=True):
            mass = shaft.density * part * weight * section.length
            yield _row(start + place * section.length, mass * np.asarray(gravity), (0.0, 0.0))
    for station in shaft.masses:
        yield _row(station.position, station.mass * np.asarray(gravity), (0.0, 0.0))
