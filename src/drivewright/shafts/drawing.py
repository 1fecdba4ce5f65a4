"""A shaft seen from the side: its outline, slices of it that bend, supports, gears and loads on it; and the turned part."""

from collections.abc import Iterator
from typing import Literal

import numpy as np

from drivewright._typing import Floats
from drivewright.scene import Drawing, Outline, Part, Point, Shape, Turned, Turning, polygon, rectangle
from drivewright.shafts.model import Shaft

ARROW = 0.09  # length of an arrow over the shaft's
OVERHANG = 0.03  # of the axis beyond the ends of the turned part, over the shaft's length


def radius_at(shaft: Shaft, z: float, side: Literal["left", "right"] = "right") -> float:
    """Outer radius [m] at a place z [m], of the section right (or left) of a step."""
    ends = shaft.ends
    at = int(np.clip(np.searchsorted(ends, z, side=side) - 1, 0, len(shaft.sections) - 1))
    length, start, end, _ = shaft.sections[at]
    return float(0.5 * (start + (end - start) * (z - ends[at]) / length))


def diameters_at(shaft: Shaft, z: float) -> tuple[float, ...]:
    """The outer diameter [m] at a place z [m], at a step those of both sides."""
    inside = min(max(z, 0.0), shaft.length)
    return tuple(sorted({2 * radius_at(shaft, inside, side) for side in ("left", "right")}))


def silhouette(shaft: Shaft) -> Iterator[Shape]:
    """The outline of the shaft at rest, thin, and its axis."""
    upper = [
        (z, r)
        for a, b in zip(shaft.ends[:-1], shaft.ends[1:], strict=True)
        for z, r in ((a, radius_at(shaft, a)), (b, radius_at(shaft, b, "left")))
    ]
    yield Shape("axis", polygon([(0.0, 0.0), (shaft.length, 0.0)], closed=False))
    yield Shape("base", _mirrored(upper))


def _mirrored(upper: list[Point]) -> Outline:
    """The closed outline of a line above the axis and its image below."""
    return polygon([(z, -r) for z, r in upper] + [(z, r) for z, r in reversed(upper)])


def slice_places(shaft: Shaft, count: int) -> Floats:
    """Places [m] at which a drawing cuts the shaft into about `count` slices, steps among them."""
    return np.unique(np.concatenate([np.linspace(0.0, shaft.length, count + 1), shaft.ends]))


def slices(shaft: Shaft, z: Floats) -> Iterator[list[Shape]]:
    """Shapes of every slice between places z, about its middle: upper and lower edge, and faces at steps and at the ends."""
    for a, b in zip(z[:-1], z[1:], strict=True):
        half, left, right = 0.5 * (b - a), radius_at(shaft, a), radius_at(shaft, b, "left")
        before = radius_at(shaft, a, "left") if a > 0 else 0.0
        edges = [((-half, left), (half, right))]
        edges += [((-half, before), (-half, left))] if abs(before - left) > 1e-9 else []
        edges += [((half, 0.0), (half, right))] if b == z[-1] else []
        yield [Shape("body", polygon([(x, side * y) for x, y in edge], closed=False)) for edge in edges for side in (1, -1)]


def spring_symbol(shaft: Shaft, position: float) -> Iterator[Shape]:
    """A support as a triangle and a line below the shaft at a place [m]."""
    outer = radius_at(shaft, position)
    size = max(0.8 * outer, 0.02 * shaft.length)
    yield Shape("body", polygon([(position, -outer), (position - 0.6 * size, -outer - size), (position + 0.6 * size, -outer - size)]))
    yield Shape("body", polygon([(position - size, -outer - 1.15 * size), (position + size, -outer - 1.15 * size)], closed=False))


def gear_symbol(shaft: Shaft, position: float, pitch_diameter: float, width: float | None = None) -> Iterator[Shape]:
    """A gear [m] as a ring about the shaft, about its place on the axis; its width unless given in proportion to its diameter."""
    inner, outer = radius_at(shaft, position), pitch_diameter / 2
    for side in (1, -1):
        yield Shape("body", rectangle((0.0, side * 0.5 * (inner + outer)), width or 0.3 * pitch_diameter, max(outer - inner, 1e-6)))


def load_arrow(shaft: Shaft, position: float, force: float) -> Iterator[Shape]:
    """An arrow onto the shaft at a place [m], about that place on the axis; a force above 0 points down."""
    length = ARROW * shaft.length
    side = np.sign(force)  # the tail lies where the load comes from
    tip = side * radius_at(shaft, min(position, shaft.length * (1 - 1e-12)))
    head, half = 0.35 * length, 0.12 * length
    yield Shape("body", polygon([(0.0, tip), (-half, tip + side * head), (half, tip + side * head)]))
    yield Shape("body", Outline(polygon([(0.0, tip + side * head), (0.0, tip + side * length)], closed=False).pieces, False))


# -- the turned part -----------------------------------------------------------------------------------------------------------


def turned_drawing(shaft: Shaft) -> Drawing:
    """The shaft as a turned part along its axis: profile, axis, bores."""
    upper = [
        (z, radius)
        for section, a, b in zip(shaft.sections, shaft.ends[:-1], shaft.ends[1:], strict=True)
        for z, radius in ((a, section.start / 2), (b, section.end / 2))
    ]
    upper = [point for n, point in enumerate(upper) if n == 0 or np.hypot(*np.subtract(point, upper[n - 1])) > 1e-9]
    over = OVERHANG * shaft.length
    shapes = [Shape("profile", _mirrored(upper)), Shape("axis", polygon([(-over, 0.0), (shaft.length + over, 0.0)], closed=False))]
    shapes += [Shape("hole", rectangle((0.5 * (start + end), 0.0), end - start, bore)) for start, end, bore in _bores(shaft)]
    return Drawing("shaft", "Shaft, turned part along its axis", tuple(shapes), milled=False)


def _bores(shaft: Shaft) -> list[tuple[float, float, float]]:
    """(start, end, diameter) of every hole, neighbouring sections of one bore as one."""
    bores: list[tuple[float, float, float]] = []
    for section, start, end in zip(shaft.sections, shaft.ends[:-1], shaft.ends[1:], strict=True):
        if bores and bores[-1][2] == section.bore:
            bores[-1] = (bores[-1][0], end, section.bore)
        elif section.bore:
            bores.append((start, end, section.bore))
    return bores


def turned_part(shaft: Shaft, angles: Floats | None = None) -> Part:
    """The shaft as a solid of revolution about x; it turns by `angles` (frames,) [rad]."""
    rings = tuple((float(s.length), float(s.start), float(s.end), float(s.bore)) for s in shaft.sections)
    turning = None if angles is None else Turning((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), angles)
    return Part("shaft", (Turned((0.0, 0.0), 0.0, rings),), turning=turning)
