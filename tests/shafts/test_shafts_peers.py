"""The batch beside ROSS and PyNite: programmes by others, with elements and solvers of their own."""

import json
import subprocess
import sys

import numpy as np
import pynite_shaft
import pytest
from places import SUPPORT

from drivewright.shafts.batch import flexibilities
from drivewright.shafts.model import COWPER, EULER_BERNOULLI

pytestmark = [pytest.mark.property, pytest.mark.needs_peers]
MODULUS, POISSON = 206e9, 0.3
UNIFORM = {"sections": [[0.34, 0.02, 0.0]], "supports": [0.0565, 0.1365], "stiffness": [3e7, 3e7], "stations": [0.0, 0.245], "mass": 8.0}
STEPPED = {
    "sections": [[0.08, 0.03, 0.0], [0.12, 0.042, 0.015], [0.1, 0.05, 0.015], [0.11, 0.035, 0.0]],
    "supports": [0.05, 0.18, 0.37],
    "stiffness": [5e7, 2e8, 8e6],
    "stations": [0.25, 0.0, 0.41],
    "mass": 20.0,
}
CASES = [shaft | {"timoshenko": shear, "modulus": MODULUS, "poisson": POISSON} for shaft in (UNIFORM, STEPPED) for shear in (False, True)]


def ours(shaft, stations=None, stiffness=None, reactions=False):
    lengths, diameters, bores = np.transpose(shaft["sections"])
    return flexibilities(
        lengths,
        diameters,
        shaft["supports"],
        shaft["stiffness"] if stiffness is None else stiffness,
        shaft["stations"] if stations is None else stations,
        MODULUS,
        POISSON,
        COWPER if shaft["timoshenko"] else EULER_BERNOULLI,
        bores=bores,
        reactions=reactions,
    )


@pytest.fixture(scope="module")
def ross():
    """Its answers to all cases, from one process: the import takes seconds and prints."""
    told = subprocess.run(
        [sys.executable, SUPPORT / "ross_shaft.py"],
        input=json.dumps({"shafts": CASES, "repeat": 1}),
        capture_output=True,
        text=True,
        check=True,
        timeout=120,
    )
    return json.loads(next(line for line in told.stdout.splitlines() if line.startswith("[")))  # libraries print too


def near(a, b, tolerance):
    scale = np.sqrt(np.diag(b))
    assert np.max(np.abs(a - b) / scale[:, None] / scale) < tolerance


@pytest.mark.parametrize("case", range(4))
def test_ross_has_the_same_flexibility(ross, case):
    near(np.array(ross[case]["flexibility"]), ours(CASES[case])[0], 1e-9)


@pytest.mark.parametrize("case", range(4))
def test_ross_static_run_is_that_of_rigid_bearings(ross, case):
    """ROSS' `run_static` puts 1e20 N/m in the place of every bearing: its bearings do not give way, ours do, by what they carry over k."""
    shaft, theirs = CASES[case], ross[case]
    weight = shaft["mass"] * theirs["gravity"]
    everywhere = [*shaft["stations"], *shaft["supports"]]
    (delta, carried), rigid = ours(shaft, everywhere, reactions=True), ours(shaft, stiffness=np.inf)
    count = len(shaft["stations"])
    assert np.allclose(theirs["stations"], -weight * rigid[0, :, 0], rtol=1e-6, atol=1e-12)
    assert np.max(np.abs(theirs["supports"])) < 1e-16
    settled = weight * delta[0, count:, 0]
    assert np.allclose(settled, weight * carried[0, :, 0] / shaft["stiffness"], rtol=1e-12, atol=0)
    assert np.min(np.abs(settled)) > 1e-7
    assert weight * delta[0, 0, 0] > 1.1 * abs(theirs["stations"][0])


@pytest.mark.parametrize("case", [0, 2])
def test_pynite_has_the_same_flexibility(case, capfd):
    found = pynite_shaft.flexibility(CASES[case])
    near(found, ours(CASES[case])[0], 1e-5)
    assert capfd.readouterr().out == ""
