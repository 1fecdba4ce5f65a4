"""The normals on screen, found from the drawn cam, belong to the contacts that the exact profile has."""

from pathlib import Path

import numpy as np
import pytest

import drivewright as dw
from drivewright.indexing.drawing import normal_poses
from drivewright.indexing.plane import PROFILE_TOLERANCE, find_contacts

pytestmark = pytest.mark.property

PRESETS = Path(dw.__file__).parent / "mechanisms/indexer/presets"


@pytest.mark.parametrize("name", ["default", "cycloid", "parallel"])
def test_normals_are_those_of_the_exact_contacts(name):
    drive = dw.build(dw.load(PRESETS / f"{name}.toml")).drive.levels[0]
    angle = np.linspace(0.03, 2 * np.pi - 0.05, 361)
    places, turns = normal_poses(drive, angle)
    differing, compared = 0, 0
    for row in range(4, 361, 9):
        found = find_contacts(drive, angle[row], reach=2 * PROFILE_TOLERANCE)
        own = {int(pin): normal for pin, normal in zip(found.pin[found.intended], found.normal[found.intended], strict=True)}
        centres = drive.pin_centres(angle[row]).d0
        touching = {pin for pin in range(drive.pins) if abs(places[row, pin] - centres[pin]) < 1e-12}
        differing += len(touching ^ set(own))
        for pin in touching & set(own):
            assert abs(np.imag(np.conj(own[pin]) * np.exp(1j * turns[row, pin]))) < 1e-8
            compared += 1
    assert compared > 40 and differing <= 2  # a pin that just leaves the cam may count either way
