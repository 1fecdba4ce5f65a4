"""Grooves milled into turned bodies: a closed skin of spline surfaces through the points of both walls (extra `fe`)."""

from typing import Any

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import InputError
from drivewright.scene import Grooved
from drivewright.solids.engine import EngineObject

ROWS = 15
SEAM = 1e-3  # mm: edges of neighbouring surfaces go through the same points and differ between them by less


def check_grooves(grooved: Grooved, name: str) -> None:
    """InputError naming `name` where the half-section crosses the axis or the walls of a groove are no two grids of finite points."""
    lowest = grooved.section.points()[:, 1].min()
    if lowest < -1e-12:
        raise InputError(f"{name}: its half-section reaches {-1e3 * lowest:.3g} mm below the axis; keep it on one side.")
    for number, walls in enumerate(grooved.grooves):
        size = np.shape(walls)
        if len(size) != 4 or size[0] != 2 or size[3] != 3 or min(size[1:3]) < 4:
            raise InputError(f"{name}: groove {number} is an array {size}; it must have the shape (2, n, m, 3) with n and m at least 4.")
        if not np.isfinite(walls).all():
            raise InputError(f"{name}: groove {number} has points that are not finite.")


def groove_tool(occ: Any, walls: Floats) -> EngineObject:
    """OCC solid of the room between two walls (2, n, m, 3) [mm]."""
    solid = _closed(occ, walls)
    return solid if solid.mass > 0 else _closed(occ, walls[:, ::-1])  # a reversed solid would be infinite: its outside is the groove


def _closed(occ: Any, walls: Floats) -> EngineObject:
    grids = _skin(walls)
    shell = occ.Sew([occ.SplineSurfaceInterpolation(np.ascontiguousarray(grid)) for grid in grids], SEAM)
    if len(shell.shells) != 1 or len(set(map(hash, shell.edges))) != 2 * len(grids):
        raise InputError(f"the skin of a groove does not close within {SEAM:g} mm; give its walls by more points")
    return occ.Solid(shell.shells[0])


def _skin(walls: Floats) -> list[Floats]:
    """Grids of both walls, mouth and floor, and of the two ends; in short lengths, for the kernel is unreliable with long winding ones."""
    rows = walls.shape[1] - 1
    cuts = np.linspace(0, rows, max(1, round(rows / ROWS)) + 1).round().astype(int)
    grids = [grid for a, b in zip(cuts[:-1], cuts[1:], strict=True) for grid in _length(*walls[:, a : b + 1])]
    return [*grids, _between(*walls[:, 0]), _between(*walls[:, -1])]


def _length(left: Floats, right: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    return left, right, _between(left[:, 0], right[:, 0]), _between(left[:, -1], right[:, -1])


def _between(a: Floats, b: Floats) -> Floats:
    """Four rows of points straight from a to b."""
    share = np.linspace(0, 1, 4)[:, None]
    return a[:, None] + (b - a)[:, None] * share
