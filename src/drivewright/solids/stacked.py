"""The union of prisms along z as one closed triangle surface, without a CAD kernel: cells of the plane, filled between levels."""

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.scene import Prism
from drivewright.solids import outlines

if TYPE_CHECKING:
    import shapely


def stacked_triangles(prisms: Sequence[Prism], name: str, tolerance: float) -> tuple[Floats, Ints]:
    """Surface of the union of prisms, outward counter-clockwise: points (n, 3) [m] and corners (m, 3); outlines within `tolerance` [m].

    The outlines of all prisms cut the plane into cells, and between two neighbouring heights a cell is filled or empty.  Every corner
    of a cell is one of its neighbours too, so that the surface is closed.
    """
    regions = [_region(prism, name, tolerance) for prism in prisms]
    cells, plan = _cells(regions)
    levels = np.unique([end for prism in prisms for end in (prism.z, prism.z + prism.thickness)])
    filled = _filled(regions, prisms, cells, levels)
    number = {point: n for n, point in enumerate(plan)}
    faces = [*_caps(cells, filled, number), *_walls(cells, filled, number)]  # (corners as (point of the plan, level))
    places = np.array(faces).reshape(-1, 2)
    used, corners = np.unique(places, axis=0, return_inverse=True)
    points = np.column_stack([np.array(plan)[used[:, 0]], levels[used[:, 1]]])
    return points, np.ravel(corners).reshape(-1, 3)


def _region(prism: Prism, name: str, tolerance: float) -> "shapely.Polygon":
    """The region of a prism with no more points than `tolerance` needs: knots of splines are dense."""
    import shapely

    region = outlines.prism_region(prism, name, tolerance)
    coarse = shapely.simplify(region, tolerance)
    return shapely.orient_polygons(coarse if isinstance(coarse, shapely.Polygon) and not coarse.is_empty else region)


def _cells(regions):
    """(cells of the plane that the outlines cut it into, all their corners)."""
    import shapely

    lines = shapely.unary_union([region.boundary for region in regions])
    cells = [shapely.orient_polygons(cell) for cell in shapely.get_parts(shapely.polygonize(shapely.get_parts(lines)))]
    return cells, sorted({point for cell in cells for ring in (cell.exterior, *cell.interiors) for point in ring.coords})


def _filled(regions, prisms, cells, levels) -> Bools:
    """Whether each cell is filled between each level and the next (cells, levels - 1)."""
    filled = np.zeros((len(cells), len(levels) - 1), bool)
    middles = 0.5 * (levels[1:] + levels[:-1])
    for region, prism in zip(regions, prisms, strict=True):
        inside = [region.contains(cell.representative_point()) for cell in cells]
        between = (middles > prism.z) & (middles < prism.z + prism.thickness)
        filled |= np.outer(inside, between)
    return filled


def _caps(cells, filled, number):
    """Horizontal triangles at the levels where a cell begins or ends."""
    import shapely

    for cell, column in zip(cells, filled, strict=True):
        steps = np.diff(np.concatenate([[0], column.astype(int), [0]]))
        if not steps.any():
            continue
        flat = [
            [number[point] for point in triangle.exterior.coords[:3]]
            for triangle in shapely.get_parts(shapely.orient_polygons(shapely.constrained_delaunay_triangles(cell)))
        ]
        for level in np.flatnonzero(steps):
            for a, b, c in flat:
                up = steps[level] < 0
                yield [(a, level), (b, level), (c, level)] if up else [(a, level), (c, level), (b, level)]


def _walls(cells, filled, number):
    """Two triangles for each side of a filled cell that has nothing on its other side; a cell lies to the left of its sides."""
    sides = {}
    for n, cell in enumerate(cells):
        for ring in (cell.exterior, *cell.interiors):
            for start, end in pairwise(number[point] for point in ring.coords):
                sides[start, end] = n
    for (a, b), n in sides.items():
        other = sides.get((b, a))
        bare = filled[n] & ~filled[other] if other is not None else filled[n]
        for level in np.flatnonzero(bare):
            yield [(a, level), (b, level), (b, level + 1)]
            yield [(a, level), (b, level + 1), (a, level + 1)]
