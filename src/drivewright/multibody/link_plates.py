"""Link plates: bodies as flat plates with holes for pins, drawn and stacked one above the other."""

import itertools
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import InputError
from drivewright.labels import in_words
from drivewright.multibody.bodies import GROUND, Marker
from drivewright.multibody.drawing import positions_of, rounded
from drivewright.scene import Drawing, Outline, Part, Point, Prism, Shape, circle, polygon

SHARE, LARGEST = 0.1, 5e-3  # radius of a pin without a bearing over the shortest distance of two pins on a body, and its limit [m]
EDGE = 2.0  # edge of a plate around its points over the radius of its largest hole
SAME = 1e-6  # pins closer than this are one [m]


class LinkPlate(NamedTuple):
    """A plate that reaches an `edge` [m] around the points (n, 2) of a body, with `holes` {centre: radius} [m]; all in the body's frame."""

    name: str
    points: Floats
    holes: Mapping[Point, float]
    edge: float
    thickness: float  # [m]

    @property
    def outline(self) -> Outline:
        """Of the plate without its holes."""
        return rounded(self.points, self.edge)


class PlatePin(NamedTuple):
    """A joint's pin of a radius [m] at the place of a marker, through the plates of `bodies`."""

    name: str
    marker: Marker
    radius: float
    bodies: tuple[str, str]


def usual_pin_radius(pins: Iterable[Sequence[Point]]) -> float:
    """Radius [m] of a pin without a bearing: a tenth of the shortest distance between two pins (x, y) on a body, at most 5 mm."""
    gaps = [math.dist(a, b) for points in pins for a, b in itertools.combinations(points, 2) if math.dist(a, b) > SAME]
    return min([LARGEST, *(SHARE * gap for gap in gaps)])


def link_plate(name: str, points: Floats, holes: Mapping[Point, float], pin_radius: float, thickness: float) -> LinkPlate:
    """The `LinkPlate` whose edge is twice its largest hole, or the usual pin; InputError where two holes meet."""
    for (a, r), (b, s) in itertools.combinations(holes.items(), 2):
        if math.dist(a, b) <= r + s:
            raise InputError(
                f"link plate {name!r}: two holes overlap: radii of {1e3 * r:.4g} and {1e3 * s:.4g} mm at a distance of "
                f"{1e3 * math.dist(a, b):.4g} mm. Give its joints a smaller bearing_radius"
            )
    return LinkPlate(name, points, holes, EDGE * max([*holes.values(), pin_radius]), thickness)


def plate_drawing(plate: LinkPlate) -> Drawing:
    """Outline, holes and their centre lines."""
    shapes = [Shape("profile", plate.outline), *(Shape("hole", circle(center, r)) for center, r in plate.holes.items())]
    for x, y in plate.holes:
        lines = ((x - plate.edge, y), (x + plate.edge, y)), ((x, y - plate.edge), (x, y + plate.edge))
        shapes += [Shape("axis", polygon(ends, closed=False)) for ends in lines]
    return Drawing(plate.name, f"Link plate of {in_words(plate.name)} (proposal)", tuple(shapes), plate.thickness)


def stacked_parts(
    plates: Iterable[LinkPlate], pins: Iterable[PlatePin], poses: Mapping[str, Floats], pin_radius: float, colours: Sequence[str]
) -> tuple[Part, ...]:
    """The plates one above the other with a little air between them, at the poses {body: (3,)}, and their pins.

    A pin that reaches into the ground stands out by a usual pin's diameter below the lowest plate.
    """
    parts: list[Part] = []
    levels: dict[str, tuple[float, float]] = {}
    bottom = 0.0
    for n, plate in enumerate(plates):
        bores = tuple(circle(center, radius) for center, radius in plate.holes.items())
        prism = Prism(plate.outline, bores, bottom, plate.thickness)
        parts.append(Part(plate.name, (prism,), tuple(poses[plate.name]), colours[n % len(colours)]))
        levels[plate.name] = (bottom, bottom + plate.thickness)
        bottom = bottom + plate.thickness + 0.1 * pin_radius
    return (*parts, *_pin_parts(pins, poses, levels | {GROUND: (-2 * pin_radius, -2 * pin_radius)}))


def _pin_parts(pins: Iterable[PlatePin], poses: Mapping[str, Floats], levels: Mapping[str, tuple[float, float]]) -> Iterator[Part]:
    """A round pin through all plates that share it."""
    spots: dict[Point, list[PlatePin]] = {}
    for pin in pins:
        x, y = positions_of(pin.marker[1:], np.array([poses[pin.marker.body]]))[0]
        near = next((key for key in spots if math.dist(key, (x, y)) < SAME), (x, y))
        spots.setdefault(near, []).append(pin)
    for spot, group in spots.items():
        ends = [end for pin in group for body in pin.bodies if body in levels for end in levels[body]]
        if ends:
            outline = circle(spot, min(pin.radius for pin in group))
            yield Part(
                f"pin {group[0].name}",
                (Prism(outline, (), min(ends), max(ends) - min(ends)),),
                (0.0, 0.0, 0.0),
                "ground",
                group[0].marker.body,
            )
