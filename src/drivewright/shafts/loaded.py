"""A shaft under all its loads: points, lines, weight - at rest, and what it carries along its length."""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.shafts import beam as beams
from drivewright.shafts.assembly import assemble, nodal_forces
from drivewright.shafts.beam import FREEDOMS
from drivewright.shafts.equilibrium import ShaftEquilibrium, solve
from drivewright.shafts.model import LineLoad, Shaft, ShaftLoad
from drivewright.shafts.sections import area, second_moment


class ShaftLoads(NamedTuple):
    """Point loads, line loads, and the acceleration of free fall (x, y, z) [m/s^2] that acts on the shaft and its stations."""

    points: tuple[ShaftLoad, ...] = ()
    lines: tuple[LineLoad, ...] = ()
    gravity: tuple[float, ...] = (0.0, 0.0, 0.0)

    @property
    def places(self) -> list[float]:
        """Places [m] that need a node."""
        return [load.position for load in self.points] + [end for load in self.lines for end in (load.start, load.end)]


def forces_along(loads: ShaftLoads, direction: Floats, count: int) -> Iterator[tuple[float, float]]:
    """(place [m], force along a unit vector (x, y)): of points [N], and of every line load at `count` places [N/m]."""
    for load in loads.points:
        yield load.position, float(np.dot(direction, load.force[:2]))
    for load in loads.lines:
        for share in np.linspace(0.0, 1.0, count):
            force = (1 - share) * np.asarray(load.first) + share * np.asarray(load.last)
            yield load.start + share * (load.end - load.start), float(np.dot(direction, force))


def scaled_loads(loads: ShaftLoads, factor: float) -> ShaftLoads:
    """The loads with all forces and moments times a factor; the weight stays."""

    def scaled(vector: tuple[float, ...]) -> tuple[float, ...]:
        return tuple(factor * each for each in vector)

    points = tuple(load._replace(force=scaled(load.force), moment=scaled(load.moment)) for load in loads.points)
    lines = tuple(load._replace(first=scaled(load.first), last=scaled(load.last)) for load in loads.lines)
    return loads._replace(points=points, lines=lines)


class LoadedShaft(NamedTuple):
    """A `ShaftEquilibrium`, and what loads it: per length in both planes, coefficients (2, n-1, 3) over the pieces; at points (6n,);
    and all as forces (size,) on the unknowns."""

    equilibrium: ShaftEquilibrium
    spread: Floats
    points: Floats
    force: Floats


class Diagram(NamedTuple):
    """Along z (m,), vectors (m, 2) in x and y: deflection [m], slope [rad], shear force [N], bending moment [N m]; and what follows.

    axial [N], torque [N m]; bending [Pa], torsion [Pa] and von Mises stress [Pa] at the surface, nominal: without notches.
    """

    z: Floats
    deflection: Floats
    slope: Floats
    shear: Floats
    moment: Floats
    axial: Floats
    torque: Floats
    bending: Floats
    torsion: Floats
    von_mises: Floats


def apply_loads(shaft: Shaft, loads: ShaftLoads, places: Iterable[float] = ()) -> LoadedShaft:
    """The `LoadedShaft`, with nodes also at `places`."""
    model = assemble(shaft, [*loads.places, *places])
    spread, force = _spread(model, loads), nodal_forces(model, [*loads.points, *_weights(shaft, loads)])
    points = force[: model.beam.size].copy()
    for plane in (0, 1):
        force[: model.beam.size] += beams.nodal_loads(model.beam, plane, spread[plane])
    force[: model.beam.size] += _axial_weight(model.beam, loads.gravity[2])
    return LoadedShaft(solve(model, force), spread, points, force)


def _weights(shaft, loads):
    return [ShaftLoad(s.position, tuple(s.mass * g for g in loads.gravity)) for s in shaft.masses if s.mass and any(loads.gravity)]


def _spread(model, loads):
    """(2, n-1, 3): load per length in x and y."""
    weight = beams.mass_per_length(model.beam)
    total = np.stack([weight * loads.gravity[plane] for plane in (0, 1)])
    for each in loads.lines:
        for plane in (0, 1):
            total[plane] += beams.linear_load(model.beam, each.start, each.end, each.first[plane], each.last[plane])
    return total


def _axial_weight(beam, gravity):
    """Half the weight of every piece on each of its ends, along the axis."""
    total = np.zeros(beam.size)
    mass, moment = beams.load_resultants(beams.mass_per_length(beam), beam.pieces[:, 0], np.zeros(len(beam.pieces)))
    second = moment / beam.pieces[:, 0]
    total[2 : beam.size : FREEDOMS][:-1] += gravity * (mass - second)
    total[2 : beam.size : FREEDOMS][1:] += gravity * second
    return total


def diagram(loaded: LoadedShaft, count: int = 201) -> Diagram:
    """The `Diagram` at about `count` places, twice at every node: just left and just right of it, for forces jump there."""
    beam, v = loaded.equilibrium.model.beam, loaded.equilibrium.unknowns
    z = _places(beam, count)
    lines = [beams.elastic_line(beam, plane, v, z, loaded.spread[plane]) for plane in (0, 1)]
    deflection, slope, shear, moment = (np.stack(each, axis=1) for each in zip(*lines, strict=True))
    element = np.clip(np.searchsorted(beam.z, z, side="right") - 1, 0, len(beam.pieces) - 1)
    axial, torque = beams.tension_and_torque(beam, v)[element].T
    return Diagram(z, deflection, slope, shear, moment, axial, torque, *_stresses(beam, element, z, moment, axial, torque))


def largest_displacement(loaded: LoadedShaft, along: Diagram) -> float:
    """The largest displacement [m] of the shaft, across its axis (in its `Diagram`) or along it."""
    return float(max(np.hypot(*along.deflection.T).max(), np.abs(loaded.equilibrium.axial_displacements).max()))


def _places(beam, count):
    """Even places and both sides of every node, rising."""
    tiny = 1e-9 * beam.shaft.length
    even = np.linspace(0.0, beam.shaft.length, count)
    even = even[np.abs(even[:, None] - beam.z).min(axis=1) > 10 * tiny]
    return np.sort(np.concatenate([even, beam.z[1:] - tiny, beam.z[:-1]]))


def _stresses(beam, element, z, moment, axial, torque):
    """(bending and tension, torsion, von Mises) [Pa] at the surface."""
    length, start, end, bore = beam.pieces[element].T
    diameter = start + (end - start) * (z - beam.z[element]) / length
    second = second_moment(diameter, bore)
    bending = np.hypot(*moment.T) * diameter / 2 / second + np.abs(axial) / area(diameter, bore)
    torsion = np.abs(torque) * diameter / 4 / second
    return bending, torsion, np.sqrt(bending**2 + 3 * torsion**2)
