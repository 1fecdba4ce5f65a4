"""The shaft on screen and for manufacture: the load grows and fades, the shaft bends, much exaggerated; its drawing and its solid.

The picture looks along the plane of the unit loads: z to the right, against the load up.
"""

from collections.abc import Iterable, Iterator

import numpy as np

from drivewright import shafts
from drivewright._typing import Floats
from drivewright.bearings.drawing import bearing_section
from drivewright.errors import SolverError
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.influence import flexibility
from drivewright.result import Answer
from drivewright.scene import Body, Drawing, Frame, Part, Scene, Shape
from drivewright.shafts import drawing
from drivewright.shafts.beam import elastic_line
from drivewright.solids.deformation import round_factor

FRAMES, SLICES, ARROWS = 61, 90, 5  # of the cycle, of the shaft, of a line load
SHOWN = 0.06  # the largest deflection is drawn as about this part of the shaft's length


def scene(model: ShaftModel) -> Scene:
    """The shaft under its loads; without loads under a force at the last station."""
    shaft, phase = model.shaft, np.linspace(0.0, 2 * np.pi, FRAMES)
    part, still = 0.5 * (1 - np.cos(phase)), np.zeros((FRAMES, 3))
    z = drawing.slice_places(shaft, SLICES)
    middles = 0.5 * (z[1:] + z[:-1])
    up, turn, words = _deflection(model, middles)
    factor = exaggeration(np.abs(up).max(), shaft.length)

    def bent(name: str, label: str, shapes: Iterable[Shape], poses: Floats, colour: str) -> Body:
        """A body that leaves the straight axis by the drawn deflection."""
        return Body(name, label, tuple(shapes), poses, colour, poses * (1.0, 0.0, 0.0) if factor else None, magnified=float(factor or 1))

    def riding(name: str, label: str, shapes: Iterable[Shape], position: float, colour: str) -> Body:
        """A body that goes with the shaft at a place."""
        return bent(name, label, shapes, _poses(position, factor * part * np.interp(position, middles, up), 0.0), colour)

    bodies = [Body("rest", "shaft at rest", tuple(drawing.silhouette(shaft)), still, "ground")]
    for support, bearing in zip(shaft.supports, model.spec.bearings, strict=True):
        raised = -float(np.dot(model.direction, bearing.seat_offset))
        poses = _poses(0.0, factor * raised + 0 * part, 0.0)
        bodies.append(bent(f"bearing.{support.name}", "bearing", _support_shapes(model, support), poses, "green"))
    for gear in model.spec.gears:
        shapes = drawing.gear_symbol(shaft, gear.position, gear.pitch_diameter)
        bodies.append(riding(f"gear.{gear.name}", "gear", shapes, gear.position, "violet"))
    label = f"shaft, {words} × {factor:g}" if factor else "shaft"
    for n, (middle, shapes, u, t) in enumerate(zip(middles, drawing.slices(shaft, z), up, turn, strict=True)):
        bodies.append(bent(f"shaft.{n}", label, shapes, _poses(middle, factor * part * u, np.arctan(factor * part * t)), "blue"))
    for n, (place, force) in enumerate(shafts.forces_along(model.loads, model.direction, ARROWS)):
        if abs(force) > 1e-9:
            bodies.append(riding(f"load.{n}", "load", drawing.load_arrow(shaft, place, force), place, "orange"))
    return Scene(phase, "load grows and fades", "rad", 2.0, tuple(bodies), (Frame("side", "seen from the side, exaggerated", still),))


def _support_shapes(model: ShaftModel, support: shafts.Support) -> Iterator[Shape]:
    rolling = model.rolling.get(support.name)
    if rolling is None:
        return drawing.spring_symbol(model.shaft, support.position)
    return bearing_section(rolling, support.position, 2 * drawing.radius_at(model.shaft, support.position), support.mirrored)


def _poses(x: float, y: Floats, angle: float | Floats) -> Floats:
    return np.stack(np.broadcast_arrays(np.full(FRAMES, float(x)), y, angle), axis=1)


def _deflection(model: ShaftModel, z: Floats) -> tuple[Floats, Floats, str]:
    """(deflection against the unit loads, its slope, words) at places z."""
    try:
        loaded = shafts.apply_loads(model.shaft, model.loads)
    except SolverError:  # the run says so; the picture shows the shaft as it is
        return 0 * z, 0 * z, "not found"
    beam, unknowns, spread, words = loaded.equilibrium.model.beam, loaded.equilibrium.unknowns, loaded.spread, "deflection"
    if model.names and not model.loaded:
        found = flexibility(model, {"statics": Answer(data=loaded)}).data
        if found is None:
            return 0 * z, 0 * z, "unloaded"
        unknowns, spread, words = found.unknowns[:, -1], (None, None), f"force at {model.names[-1]}, deflection"
    lines = [elastic_line(beam, plane, unknowns, z, spread[plane]) for plane in (0, 1)]
    up, slope = (-np.stack(each, axis=1) @ model.direction for each in zip(*(each[:2] for each in lines), strict=True))
    return up, slope, words


def exaggeration(largest: float, length: float) -> float:
    """1, 2 or 5 times a power of ten that draws the largest deflection at about SHOWN of the length; 0 without deflection."""
    return round_factor(SHOWN * length / largest) if largest > 1e-15 * length else 0.0


def drawings(model: ShaftModel) -> tuple[Drawing, ...]:
    """The turned part along its axis."""
    return (drawing.turned_drawing(model.shaft),)


def parts(model: ShaftModel) -> tuple[Part, ...]:
    """The shaft as a solid of revolution about x."""
    return (drawing.turned_part(model.shaft),)
