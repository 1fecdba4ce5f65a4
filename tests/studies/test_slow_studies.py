"""Long checks, apart from the daily ones: other seeds of the search, and every preset on its independent route."""

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright import registry

pytestmark = pytest.mark.property

PUSHER = EXAMPLES / "seedling_pusher.toml"
PRESETS = [(kind, name) for kind in registry.kinds() for name in registry.mechanism(kind).presets() if kind in ("cam", "seedling-pusher")]


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2, 3, 4, 5])
def test_other_seeds_find_a_design_as_good(seed):
    found = dw.optimise(dw.load(PUSHER, [f"optimise.seed={seed}"]))
    assert found.feasible and np.degrees(found.best["cam.max_pressure_angle"]) < 20.15


@pytest.mark.slow
@pytest.mark.needs_peers
@pytest.mark.parametrize(("kind", "preset"), PRESETS)
def test_every_preset_agrees_with_its_independent_route(kind, preset):
    rows = dw.verify(dw.load(registry.mechanism(kind).presets()[preset]))
    assert rows and [row.name for row in rows if not row.ok] == []
