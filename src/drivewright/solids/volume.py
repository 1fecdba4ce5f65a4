"""Volume of a part from its horizontal sections, without a CAD kernel."""

from typing import TYPE_CHECKING

import numpy as np

from drivewright.errors import InputError
from drivewright.scene import Bar, Grooved, Part, Prism, Turned
from drivewright.solids import outlines, turning

if TYPE_CHECKING:
    from shapely import Polygon
    from shapely.geometry.base import BaseGeometry

SAMPLES = 129  # places along a cone at which its horizontal section is taken


def part_volume(part: Part) -> float:
    """Volume [m^3] of a part: the area of its horizontal sections, integrated over the height.

    Independent of the CAD kernel, whose `.mass` is off by up to 1 % for solids with spline edges.  Prisms are right to 1e-6; where a
    round bar or a turned body leaves a prism, to about 1e-4.  A turned body alone has its closed form.  A grooved one is refused.
    """
    if any(isinstance(item, Grooved) for item in part.solids):
        raise InputError(f"part {part.name!r}: the volume of a grooved body needs the CAD kernel; take that of its triangles.")
    if len(part.solids) == 1 and isinstance(part.solids[0], Turned):
        return turning.ring_volume(turning.checked_rings(part.solids[0].rings, f"part {part.name!r}"))
    prisms = [(item, outlines.prism_region(item, f"part {part.name!r}", 1e-8)) for item in part.solids if isinstance(item, Prism)]
    rounds = [item for item in part.solids if isinstance(item, (Bar, Turned))]
    levels = {level for item, _ in prisms for level in (item.z, item.z + item.thickness)}
    levels = np.array(sorted(levels | {item.z + side * radius for item in rounds for radius in _radii(item) for side in (-1, 1)}))
    return float(sum(_slab(prisms, rounds, low, high) for low, high in zip(levels, levels[1:], strict=False)))


def _radii(item: Bar | Turned) -> set[float]:
    """Radii at which the horizontal section of a round solid changes its kind."""
    return {item.diameter / 2} if isinstance(item, Bar) else {d / 2 for ring in item.rings for d in tuple(ring)[1:]}


def _slab(prisms: "list[tuple[Prism, Polygon]]", rounds: list[Bar | Turned], low: float, high: float) -> float:
    """Volume between two heights with nothing ending in between; z = middle + half sin(a) tames the square roots of a bar's width."""
    from shapely import union_all

    middle, half = (low + high) / 2, (high - low) / 2
    here = [region for item, region in prisms if item.z < middle < item.z + item.thickness]
    rounds = [item for item in rounds if abs(middle - item.z) < max(_radii(item))]
    if not rounds:
        return (high - low) * union_all(here).area
    node, weight = np.polynomial.legendre.leggauss(24)
    sections = [union_all(here + [_section(item, middle + half * np.sin(a)) for item in rounds]).area for a in node * np.pi / 2]
    return half * np.pi / 2 * np.dot(weight * np.cos(node * np.pi / 2), sections)


def _section(item: Bar | Turned, height: float) -> "BaseGeometry":
    """Section of a round solid at a height, empty beside it."""
    return _strip(item, height) if isinstance(item, Bar) else _turned_section(item, height - item.z)


def _strip(bar: Bar, height: float) -> "BaseGeometry":
    """Section of a round bar at a height: a rectangle, empty beside the bar."""
    from shapely import LineString, Polygon

    inside = bar.diameter**2 / 4 - (height - bar.z) ** 2
    return LineString([bar.start, bar.end]).buffer(np.sqrt(inside), cap_style="flat") if inside > 0 else Polygon()


def _turned_section(turned: Turned, height: float) -> "BaseGeometry":
    """Section of a turned body at a height above its axis: for each ring all within sqrt(R^2 - h^2) of the axis, less its bore's."""
    from shapely import union_all
    from shapely.affinity import translate

    ends = np.concatenate([[0.0], np.cumsum([ring[0] for ring in turned.rings])])
    sections = [_ring_section(ring, at, abs(height)) for ring, at in zip(turned.rings, ends[:-1], strict=True)]
    return translate(union_all(sections), *turned.start)


def _ring_section(ring: tuple[float, float, float, float], at: float, height: float) -> "BaseGeometry":
    from shapely import Polygon, box

    length, start, end, bore = ring
    if max(start, end) <= 2 * height:
        return Polygon()
    u = (1 - np.cos(np.linspace(0, np.pi, 2 if start == end else SAMPLES))) / 2
    if min(start, end) < 2 * height:  # only where the cone is still wide enough
        limit = (2 * height - start) / (end - start)
        u = limit + u * (1 - limit) if end > start else u * limit
    wide = np.sqrt(np.maximum((start + u * (end - start)) ** 2 / 4 - height**2, 0.0))
    whole = Polygon(np.concatenate([np.column_stack([at + u * length, -wide]), np.column_stack([at + u * length, wide])[::-1]]))
    free = np.sqrt(max(bore**2 / 4 - height**2, 0.0))
    return whole.difference(box(at, -free, at + length, free)) if free > 0 else whole
