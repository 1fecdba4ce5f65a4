"""Play of a wheel that two cams hold, and what a wheel turned by its play is worth."""

import numpy as np
import pytest

import drivewright as dw
from drivewright import registry
from drivewright.indexing.play import BACKWARD, FORWARD, find_play
from drivewright.indexing.stiffness import COMPLIANCE_GROUPS
from drivewright.indexing.stiffness.loading import solve_after_play, solve_loaded
from drivewright.runner import build

pytestmark = pytest.mark.property

PRESETS = registry.mechanism("indexer").presets()


@pytest.mark.parametrize("direction", [FORWARD, BACKWARD])
def test_two_cams_hold_what_each_alone_leaves_loose(direction):
    drive, angles = build(dw.load(PRESETS["parallel"])).drive, np.radians([0.0, 40.0, 95.0, 150.0, 250.0])
    alone = [find_play(level, angles, direction) for level in drive.levels]
    together = find_play(drive, angles, direction)
    np.testing.assert_array_equal(together, np.nanmin(np.nan_to_num(alone, nan=np.inf), axis=0))
    assert np.all(together < 1e-6) and np.nanmax(np.nan_to_num(alone, nan=1.0)) > 1e-3


def test_taken_up_shares_add_up_to_the_compliance_beyond_the_play():
    model = build(dw.load(PRESETS["default"]))
    angles = np.radians([13.5, 18.0, 90.0])
    first, near = solve_loaded(model.loaded_wheel, angles, 1000.0)
    both, _, free = solve_after_play(model.loaded_wheel, angles, 1000.0, first, near)
    assert list(first.outcome) == ["free", "free", "carried"] and set(both.outcome) == {"carried"}
    np.testing.assert_allclose(sum(both.shares[name] for name in COMPLIANCE_GROUPS) * both.secant, 1.0, rtol=1e-9)
    assert np.all(free[:2] > 1e-3) and free[2] == 0
