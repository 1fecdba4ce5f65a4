"""The line search of the batch that minimises elastic energies."""

import numpy as np
import pytest

from drivewright.indexing.stiffness.minimise import ConvexEnergy, _length, total_energy

pytestmark = pytest.mark.property


def spring(load):
    """One linear spring of 1 N/m at each of the positions."""
    return ConvexEnergy(np.ones((len(load), 1, 1)), (), np.array(load)[:, None])


def test_a_step_uphill_by_rounding_is_taken_whole_and_divides_by_nothing():
    system = spring([1.0, 1.0])
    y, change = np.array([[1 + 1e-9], [0.5]]), np.array([[1e-12], [0.5]])
    with np.errstate(all="raise"):
        assert _length(system, y, change).tolist() == [1.0, 1.0]


@pytest.mark.parametrize("reach", [0.3, 1.0, 2.5, 40.0])
def test_a_step_too_long_is_cut_where_the_energy_falls_and_half_the_steepness_is_gone(reach):
    system, y = spring([2.0]), np.zeros((1, 1))
    change = np.array([[2.0 * reach]])  # reach 1 ends at rest
    share = _length(system, y, change)
    assert total_energy(system, y + share[:, None] * change) < total_energy(system, y)
    assert abs(1 - share[0] * reach) <= 0.5 or share[0] == 1.0
    assert share[0] <= 1.0
