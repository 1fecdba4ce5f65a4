"""Closed triangle surfaces of parts: a single prism, bar or turned body directly, others with the CAD kernel (extra `fe`)."""

from typing import TYPE_CHECKING

import numpy as np

from drivewright._typing import Floats, Ints
from drivewright.scene import Bar, Part, Prism, Turned, circle, place
from drivewright.solids import cad, outlines, turning
from drivewright.solids.stacked import stacked_triangles

if TYPE_CHECKING:
    import shapely


def surface_triangles(part: Part, tolerance: float = 1e-5) -> tuple[Floats, Ints]:
    """Surface of a part, outward counter-clockwise: points (n, 3) [m] and corners (m, 3); chords within about `tolerance` [m] of it."""
    if len(part.solids) != 1 or type(part.solids[0]) not in MAKERS:
        return cad.cad_triangles(part, tolerance)
    (solid,) = part.solids
    points, corners = MAKERS[type(solid)](solid, f"part {part.name!r}", tolerance)
    return np.column_stack([place(points[:, :2], part.pose), points[:, 2]]), corners


def viewed_triangles(part: Part, tolerance: float) -> tuple[Floats, Ints]:
    """The same for a picture: prisms are fused without the CAD kernel, with no more points than `tolerance` [m] needs.

    Bars and turned bodies stay closed surfaces of their own, which may end inside of others: nobody sees it, also in a section.
    """
    prisms = [solid for solid in part.solids if isinstance(solid, Prism)]
    others = [solid for solid in part.solids if not isinstance(solid, Prism)]
    if not part.solids or any(type(solid) not in MAKERS for solid in others):
        return surface_triangles(part, tolerance)
    name = f"part {part.name!r}"
    made = [stacked_triangles(prisms, name, tolerance)] if prisms else []
    made += [MAKERS[type(solid)](solid, name, tolerance) for solid in others]
    starts = np.cumsum([0, *(len(points) for points, _ in made[:-1])])
    points = np.concatenate([points for points, _ in made])
    corners = np.concatenate([corners + start for (_, corners), start in zip(made, starts, strict=True)])
    return np.column_stack([place(points[:, :2], part.pose), points[:, 2]]), corners


def _prism(prism: Prism, name: str, tolerance: float) -> tuple[Floats, Ints]:
    return _extruded(outlines.prism_region(prism, name, tolerance), prism.z, prism.z + prism.thickness)


def _bar(bar: Bar, name: str, tolerance: float) -> tuple[Floats, Ints]:
    """A disc pushed along the bar: its axes u, v, w become the bar's left, up and forward."""
    from shapely import Polygon

    along = np.subtract(bar.end, bar.start)
    length = np.hypot(*along)
    forward = along / length
    disc = Polygon(circle((0.0, 0.0), bar.diameter / 2).points(tolerance))
    points, corners = _extruded(disc, 0.0, length)
    flat = np.asarray(bar.start) + points[:, :1] * [-forward[1], forward[0]] + points[:, 2:] * forward
    return np.column_stack([flat, bar.z + points[:, 1]]), corners


def _extruded(region: "shapely.Polygon", low: float, high: float) -> tuple[Floats, Ints]:
    """Triangles of a polygon with holes between two heights; caps and walls share the corners of the polygon."""
    import shapely

    region = shapely.orient_polygons(region)
    caps = shapely.get_coordinates(shapely.constrained_delaunay_triangles(region)).reshape(-1, 4, 2)[:, :3]
    plan, index = np.unique(caps.reshape(-1, 2), axis=0, return_inverse=True)
    top, count = index.reshape(-1, 3), len(plan)
    (ax, ay), (bx, by) = (np.moveaxis(plan[top[:, k]] - plan[top[:, 0]], 1, 0) for k in (1, 2))
    top = np.where((ax * by - ay * bx > 0)[:, None], top, top[:, ::-1])
    numbers = {tuple(point): i for i, point in enumerate(plan.tolist())}
    rings = [[numbers[tuple(point)] for point in ring.coords] for ring in (region.exterior, *region.interiors)]
    a, b = np.array([edge for ring in rings for edge in zip(ring[:-1], ring[1:], strict=True)]).T
    walls = np.concatenate([np.stack([a, b, b + count], axis=1), np.stack([a, b + count, a + count], axis=1)])
    points = np.concatenate([np.column_stack([plan, np.full(count, z)]) for z in (low, high)])
    return points, np.concatenate([top[:, ::-1], top + count, walls])


MAKERS = {Prism: _prism, Bar: _bar, Turned: turning.turned_triangles}
