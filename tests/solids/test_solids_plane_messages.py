"""What flat bodies refuse."""

import numpy as np
import pytest

from drivewright.errors import InputError, SolverError
from drivewright.scene import circle, polygon
from drivewright.solids.plane import PlaneBody
from drivewright.solids.plane_meshing import plane_mesh

pytestmark = [pytest.mark.error, pytest.mark.needs_fe]
SQUARE = polygon([(0, 0), (4e-3, 0), (4e-3, 4e-3), (0, 4e-3)])
STEEL = {"thickness": 2e-3, "modulus": 206e9, "poisson": 0.3}


def test_boundaries_that_are_not_there():
    with pytest.raises(InputError, match=r"no boundary of the plate matches 'hole3:\*'; there are outline:0, outline:1"):
        plane_mesh(SQUARE, size=1e-3, fine={"hole3:*": 1e-4})
    body = PlaneBody(plane_mesh(SQUARE, size=2e-3), **STEEL)
    with pytest.raises(InputError, match="no boundary of the plate matches 'rim'; there are outline:0"):
        body.on("rim")
    assert np.count_nonzero(body.on("outline:2")) > 0


def test_sizes_and_holes():
    with pytest.raises(InputError, match="'outline:1' should have the size -0.001 m; it must be above 0"):
        plane_mesh(SQUARE, size=1e-3, fine={"outline:1": -1e-3})
    with pytest.raises(InputError, match="hole 0 lies outside"):
        plane_mesh(SQUARE, (circle((9e-3, 0.0), 1e-3),), size=1e-3)
    with pytest.raises(SolverError, match="holes that cross the outline"):
        plane_mesh(SQUARE, (circle((4e-3, 2e-3), 1e-3),), size=1e-3)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"thickness": 0.0}, "thickness 0 m"),
        ({"modulus": -1.0}, "modulus -1 Pa"),
        ({"poisson": 0.7}, "ratio 0.7"),
        ({"order": 1}, "order 1; choose"),
    ],
)
def test_materials(change, text):
    mesh = plane_mesh(SQUARE, size=2e-3)
    with pytest.raises(InputError, match=text):
        PlaneBody(mesh, **{**STEEL, **change})
