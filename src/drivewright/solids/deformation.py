"""The displaced surface of a solid: mirrored copies of half and quarter models, and the table that a plot of style "mesh" draws."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats, Ints
from drivewright.errors import InputError
from drivewright.result import Column, Table
from drivewright.surface_fields import SurfaceBody

SMALLEST = 1e-300  # m: what does not move at all is drawn as it is


class DisplacedSurface(NamedTuple):
    """points (n, 3) [m], triangles (m, 3) of them, displacements (L, n, 3) of the points under L loads."""

    points: Floats
    triangles: Ints
    displacements: Floats


def subdivided_triangle(parts: int) -> tuple[Ints, Ints]:
    """Corners (n, 2) of a triangle divided parts x parts, as whole numbers, and its small triangles (m, 3)."""
    grid = [(i, j) for i in range(parts + 1) for j in range(parts + 1 - i)]
    number = {spot: n for n, spot in enumerate(grid)}
    upright = [[(i, j), (i + 1, j), (i, j + 1)] for i, j in grid if i + j < parts]
    inverted = [[(i + 1, j), (i + 1, j + 1), (i, j + 1)] for i, j in grid if i + j < parts - 1]
    return np.array(grid), np.array([[number[spot] for spot in corners] for corners in upright + inverted])


def with_mirror_images(surface: DisplacedSurface, images: Sequence[tuple[tuple[int, int, int], tuple[int, int, int]]]) -> DisplacedSurface:
    """All images of a surface, each (signs of the coordinates, signs of the displacements); an odd mirror turns the triangles round."""
    points, triangles, displacements = surface
    copies = []
    for number, (place, motion) in enumerate(images):
        corners = triangles if np.prod(place) > 0 else triangles[:, ::-1]
        copies.append((points * place, corners + number * len(points), displacements * motion))
    points, triangles, displacements = zip(*copies, strict=True)
    return DisplacedSurface(np.concatenate(points), np.concatenate(triangles), np.concatenate(displacements, axis=1))


def round_factor(factor: float, steps: Sequence[int] = (5, 2, 1)) -> float:
    """The largest of the steps times a power of ten up to `factor`."""
    power = 10.0 ** np.floor(np.log10(factor))
    return next(step * power for step in steps if step * power <= factor * (1 + 1e-12))


def exaggeration_for(extent: float, displacement: Floats, part: float, steps: Sequence[int] = (5, 2, 1)) -> float:
    """Round factor that draws the largest displacement (n, 3) [m] as about a `part` of an extent [m]."""
    return round_factor(part * extent / max(np.linalg.norm(displacement, axis=1).max(), SMALLEST), steps)


def displaced_table(
    name: str,
    title: str,
    surface: DisplacedSurface,
    displacement: Floats,
    exaggeration: float,
    drawn: Sequence[tuple[int, str]],
    rest: Sequence[tuple[int, str]],
) -> Table:
    """Table for a plot of style "mesh", three rows a triangle: the coordinates `drawn` ((axis, meaning), ...) with a displacement
    (n, 3) [m] drawn `exaggeration` times as large, the size of the displacement, and the coordinates at `rest`."""
    rows, moved = surface.triangles.ravel(), surface.points + exaggeration * displacement
    times = f"{exaggeration:,.0f}".replace(",", " ") if exaggeration >= 1 else f"{exaggeration:.2g}"
    columns = [("xyz"[axis], meaning, moved[:, axis]) for axis, meaning in drawn]
    columns.append(("displacement", f"displacement, drawn {times} times as large", np.linalg.norm(displacement, axis=1)))
    columns += [(f"rest_{'xyz'[axis]}", meaning, surface.points[:, axis]) for axis, meaning in rest]
    return Table(name, title, tuple(Column(key, "m", meaning, data[rows]) for key, meaning, data in columns))


def field_table(
    name: str, title: str, body: SurfaceBody, step: int, field: str, scale: float, drawn: Sequence[tuple[int, str]], parts: int = 1
) -> Table:
    """Table for a plot of style "mesh", three rows a triangle, of a body's scalar field at a load step on its deformed shape.

    drawn: ((axis, meaning), ...) of what is drawn to the right, up, and along the line of sight, from the side on which that picture is
    not mirrored; displacements are drawn `scale` times as large.  parts: each triangle is divided parts x parts, field and shape linear.
    """
    shown = body.field(field)
    if shown is None:
        raise InputError(f"{body.name}: has no field {field!r}; there are {', '.join(each.name for each in body.fields)}")
    points, values, triangles = body.points + scale * body.displacements[step].astype(float), shown.at(step).astype(float), body.triangles
    if body.mirrored:
        triangles = np.concatenate([triangles, triangles[:, ::-1] + len(points)])
        points, values = np.concatenate([points, points * (1, 1, -1)]), np.tile(values, 2)
    grid, local = subdivided_triangle(parts)
    weights = np.column_stack([grid / parts, 1 - grid.sum(axis=1) / parts])[local].reshape(-1, 3)  # of the corners, three rows a part
    place = (weights @ points[triangles]).reshape(-1, 3)
    times = f"displacements drawn {scale:,.0f} times as large".replace(",", " ") if scale >= 1 else f"displacements drawn {scale:.2g} times"
    right, up, along = drawn
    towards = np.cross(np.eye(3)[right[0]], np.eye(3)[up[0]])  # the viewer
    columns = (
        Column("right", "m", f"{right[1]}, {times}", place[:, right[0]]),
        Column("up", "m", f"{up[1]}, {times}", place[:, up[0]]),
        Column("depth", "m", f"{along[1]}, away from the viewer", -place @ towards),
        Column(field, shown.unit, shown.label, (weights @ values[triangles][..., None]).ravel()),
    )
    return Table(name, title, columns, shown.missing)
