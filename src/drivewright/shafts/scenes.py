"""A shaft on screen, seen from the side: the load grows and fades, the shaft bends, much exaggerated.

The picture looks along the plane of the unit loads: z to the right, against the load up.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.bearings import BallBearing, RollerBearing
from drivewright.bearings.drawing import bearing_section
from drivewright.scene import Body, Frame, Label, Scene, Shape
from drivewright.shafts import drawing
from drivewright.shafts.beam import Beam, elastic_line
from drivewright.shafts.loaded import ShaftLoads, forces_along
from drivewright.shafts.model import Shaft, Support
from drivewright.solids.deformation import round_factor

FRAMES, SLICES, ARROWS = 61, 90, 5  # of the cycle, of the shaft, of a line load
DRAWN_PART = 0.06  # the largest deflection is drawn as about this part of the shaft's length
STRAIGHT = 1e-9  # of the direction of the unit loads along x: straight down
NO_FORCE = 1e-9  # [N, N/m] along the unit loads: no arrow


class BentShape(NamedTuple):
    """The unknowns (size,) [m, rad] of a beam, its load per length in either plane as in `LoadedShaft`, and what the label calls them."""

    beam: Beam
    unknowns: Floats
    spread: Sequence[Floats | None]
    label: str

    def against(self, direction: Floats, z: Floats) -> tuple[Floats, Floats]:
        """(deflection [m], slope [rad]) against a unit vector (x, y), at places z (m,) [m]."""
        lines = [elastic_line(self.beam, plane, self.unknowns, z, self.spread[plane]) for plane in (0, 1)]
        up, slope = (-np.stack(each, axis=1) @ direction for each in zip(*(each[:2] for each in lines), strict=True))
        return up, slope


class DrawnGear(NamedTuple):
    """A gear at a place [m] of the shaft, with its pitch diameter and, where known, its width [m]."""

    name: str
    position: float
    pitch_diameter: float
    width: float | None = None


def load_phases() -> Floats:
    """Phases (frames,) [rad] of the load that grows and fades."""
    return np.linspace(0.0, 2 * np.pi, FRAMES)


def shaft_scene(
    shaft: Shaft,
    shape: BentShape | None,
    direction: Floats,
    loads: ShaftLoads,
    gears: Sequence[DrawnGear] = (),
    rolling: Mapping[str, BallBearing | RollerBearing] | None = None,
    stations: Mapping[str, float] | None = None,
) -> Scene:
    """The shaft that bends as `shape` (None: it stays straight), its supports, gears and loads along `direction` (x, y) of the unit loads.

    rolling: the rolling bearings among its supports, by name; stations: places [m] on it, by name.
    """
    phase = load_phases()
    part, still = 0.5 * (1 - np.cos(phase)), np.zeros((FRAMES, 3))
    z = drawing.slice_places(shaft, SLICES)
    middles = 0.5 * (z[1:] + z[:-1])
    up, turn = (0 * middles, 0 * middles) if shape is None else shape.against(direction, middles)
    factor = exaggeration(np.abs(up).max(), shaft.length)

    def bent(name: str, label: str, shapes: Iterable[Shape], poses: Floats, colour: str) -> Body:
        """A body that leaves the straight axis by the drawn deflection."""
        return Body(name, label, tuple(shapes), poses, colour, poses * (1.0, 0.0, 0.0) if factor else None, magnified=float(factor or 1))

    def riding(name: str, label: str, shapes: Iterable[Shape], position: float, colour: str) -> Body:
        """A body that goes with the shaft at a place."""
        return bent(name, label, shapes, _poses(position, factor * part * np.interp(position, middles, up), 0.0), colour)

    bodies = [Body("rest", "shaft at rest", tuple(drawing.silhouette(shaft)), still, "ground")]
    for support in shaft.supports:
        raised = _poses(0.0, factor * -float(np.dot(direction, support.offset[:2])) + 0 * part, 0.0)
        symbol = _support_symbol(shaft, support, (rolling or {}).get(support.name))
        bodies.append(bent(f"bearing.{support.name}", "bearing", symbol, raised, "green"))
    for gear in gears:
        symbol = drawing.gear_symbol(shaft, gear.position, gear.pitch_diameter, gear.width)
        bodies.append(riding(f"gear.{gear.name}", "gear", symbol, gear.position, "violet"))
    label = f"shaft, {shape.label} × {factor:g}" if shape is not None and factor else "shaft"
    for n, (middle, shapes, u, t) in enumerate(zip(middles, drawing.slices(shaft, z), up, turn, strict=True)):
        bodies.append(bent(f"shaft.{n}", label, shapes, _poses(middle, factor * part * u, np.arctan(factor * part * t)), "blue"))
    for n, (place, force) in enumerate(forces_along(loads, direction, ARROWS)):
        if abs(force) > NO_FORCE:
            bodies.append(riding(f"load.{n}", "load", drawing.load_arrow(shaft, place, force), place, "orange"))
    slices = {name: f"shaft.{np.abs(middles - place).argmin()}" for name, place in (stations or {}).items()}
    arrows = tuple(_arrows(bodies, loads, direction))
    labels = (*_names(shaft, bodies, gears, stations or {}, slices, arrows), *_forces(arrows, len(loads.points)))
    frame = Frame("side", "seen from the side, exaggerated", still, axes=("z", _up(direction)))
    return Scene(phase, "load grows and fades", "rad", 2.0, tuple(bodies), (frame,), labels=labels)


class _Arrow(NamedTuple):
    """An arrow of a load: its number, its place along the shaft [m], its force [N] or [N/m], and its tail in the frame of its body."""

    number: int
    place: float
    force: float
    tail: tuple[float, float]


def _arrows(bodies: Sequence[Body], loads: ShaftLoads, direction: Floats) -> Iterator[_Arrow]:
    found = {body.name: body for body in bodies}
    for n, (place, force) in enumerate(forces_along(loads, direction, ARROWS)):
        if body := found.get(f"load.{n}"):
            x, y = max((point for shape in body.shapes for point in shape.outline.points()), key=lambda point: abs(point[1]))
            yield _Arrow(n, place, force, (float(x), float(y)))


def _names(
    shaft: Shaft,
    bodies: Sequence[Body],
    gears: Iterable[DrawnGear],
    stations: Mapping[str, float],
    slices: Mapping[str, str],
    arrows: Sequence[_Arrow],
) -> Iterator[Label]:
    """Supports below, gears and stations above, unless the arrow of a load comes from there."""
    found = {body.name: body for body in bodies}
    for support in shaft.supports:
        foot = min(float(shape.outline.points()[:, 1].min()) for shape in found[f"bearing.{support.name}"].shapes)
        yield Label(support.name, (support.position, foot), f"bearing.{support.name}", above=False)
    for gear in gears:
        yield _name(gear.name, f"gear.{gear.name}", gear.position, gear.pitch_diameter / 2, shaft, arrows)
    for name, place in stations.items():
        yield _name(name, slices[name], place, _radius(shaft, place), shaft, arrows)


def _name(text: str, body: str, place: float, height: float, shaft: Shaft, arrows: Iterable[_Arrow]) -> Label:
    """The name of what is so high [m] there: below, where an arrow ends upon it from above and no support is there, else above."""
    near = _radius(shaft, place)
    pressed = any(abs(arrow.place - place) < near and arrow.tail[1] > height for arrow in arrows)
    below = pressed and all(abs(support.position - place) >= near for support in shaft.supports)
    return Label(text, (0.0, -height if below else height), body, above=not below)


def _radius(shaft: Shaft, place: float) -> float:
    """Radius [m] of the shaft at a place, its right end included."""
    return drawing.radius_at(shaft, min(place, shaft.length * (1 - 1e-12)))


def _forces(arrows: Iterable[_Arrow], points: int) -> Iterator[Label]:
    """The force of every arrow; of a line load, which come behind the `points`, at its two ends."""
    for arrow in arrows:
        along = arrow.number - points
        if along < 0 or along % ARROWS in (0, ARROWS - 1):
            yield Label("", arrow.tail, f"load.{arrow.number}", arrow.tail[1] > 0, abs(arrow.force), "N" if along < 0 else "N/m")


def _up(direction: Floats) -> str:
    """What points up in a picture that looks along the plane of the unit loads, these downwards."""
    return "y" if abs(direction[0]) < STRAIGHT and direction[1] < 0 else "against the unit loads"


def _support_symbol(shaft: Shaft, support: Support, rolling: BallBearing | RollerBearing | None) -> Iterator[Shape]:
    if rolling is None:
        return drawing.spring_symbol(shaft, support.position)
    return bearing_section(rolling, support.position, 2 * drawing.radius_at(shaft, support.position), support.mirrored)


def _poses(x: float, y: Floats, angle: float | Floats) -> Floats:
    return np.stack(np.broadcast_arrays(np.full(FRAMES, float(x)), y, angle), axis=1)


def exaggeration(largest: float, length: float) -> float:
    """1, 2 or 5 times a power of ten that draws the largest deflection at about DRAWN_PART of the length; 0 without deflection."""
    return round_factor(DRAWN_PART * length / largest) if largest > 1e-15 * length else 0.0
