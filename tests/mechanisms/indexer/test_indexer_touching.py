"""Corners that turn right and feet on the seam of a closed profile."""

import numpy as np
import pytest

from drivewright import curves
from drivewright.curves import touching
from drivewright.numerics.jets import exp, variable

pytestmark = pytest.mark.analytical


def polygon(corners):
    return tuple(
        curves.Span(curves.Piece(0.0, 1.0, lambda t, a=a, b=b: a + (b - a) * variable(t), "", "line"), 0.0, 1.0)
        for a, b in zip(corners, np.roll(corners, -1), strict=True)
    )


@pytest.mark.parametrize("order", [1, -1])
def test_a_corner_has_no_curvature_whichever_way_it_turns(order):
    corners = 0.02 * np.array([1 - 1j, 1 + 1j, -1 + 1j, -1 - 1j])[::order]
    found = touching.touches(touching.nodes_of(polygon(corners)), [0.023 + 0.024j, -0.024 + 0.0225j], 0.004, 1.5e-3)
    np.testing.assert_allclose(found.point, [0.02 + 0.02j, -0.02 + 0.02j], atol=1e-12)
    assert np.all(np.isinf(found.curvature))


@pytest.mark.parametrize("start", [0.0, 0.4, 1.9, 4.0])
def test_a_foot_on_the_seam_is_told_once(start):
    """Where the last chord meets the first, rounding finds the foot on either; centres a few digits to both sides, and to none."""
    z = curves.Piece(start, start + 2 * np.pi, lambda t: 0.003 + 0.03 * exp(1j * variable(t)), "", "arc")
    nodes = touching.nodes_of((curves.Span(z, start, start + 2 * np.pi),))
    for ahead in np.linspace(-4e-15, 4e-15, 81):
        found = touching.touches(nodes, [0.003 + 0.041 * np.exp(1j * (start + ahead))], 0.01, 2e-3)
        assert len(found.gap) == 1 and found.gap[0] == pytest.approx(1e-3, abs=1e-9)
