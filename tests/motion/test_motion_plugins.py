"""A motion law from another package."""

from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from drivewright import motion, plugins
from drivewright.errors import InputError

pytestmark = pytest.mark.interface


def _half_sine(sharpness):
    """A plug-in's law: a sine of acceleration, then one of another width."""
    first = sharpness / (1 + sharpness)
    return motion.integrate([motion.wave(first, 0, np.pi), motion.wave(1 - first, np.pi, 2 * np.pi, level=sharpness)])


@pytest.fixture
def plugged(monkeypatch):
    installed = plugins.installed
    point = SimpleNamespace(load=lambda: _half_sine)
    monkeypatch.setattr(
        plugins, "installed", lambda group: {"half-sine": point} if group == "drivewright.motion_laws" else installed(group)
    )


def test_a_law_of_another_package_is_listed_built_and_used_like_ours(plugged):
    assert "half-sine" in motion.names()
    law = motion.law("half-sine", sharpness=2)
    assert law.name == "half-sine" and law.continuity == 2 and not law.symmetric
    assert_allclose(law.breaks, (0, 2 / 3, 1))
    assert_allclose((law(0.0)[:3], law(1.0)[:3]), ((0, 0, 0), (1, 0, 0)), atol=1e-14)
    assert motion.Programme([motion.Segment(2.0, law, 0.1), motion.Segment(2 * np.pi - 2, law, -0.1)]).continuity == 2
    with pytest.raises(InputError, match="its parameters: sharpness"):
        motion.law("half-sine")


def test_without_the_plug_in_there_is_no_such_law():
    assert "half-sine" not in motion.names()
