"""What is promised from one processor to the next: eight significant digits of geometry, statics, kinematics and modes."""

import json
import os
import platform
import subprocess
import sys

import pytest
from places import EXAMPLES

import drivewright as dw

try:
    from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__
except ImportError:  # NumPy before 2.0
    from numpy.core._multiarray_umath import __cpu_dispatch__, __cpu_features__

pytestmark = pytest.mark.property

PLAIN = {
    "NUMBA_CPU_NAME": "generic",
    "OPENBLAS_CORETYPE": "Nehalem",
    "NPY_DISABLE_CPU_FEATURES": " ".join(name for name in __cpu_dispatch__ if __cpu_features__.get(name)),
}
DIGITS = 1e-8
NOISE = 1e-12  # of the largest value of a unit: what is 0 but for rounding


@pytest.mark.slow
@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="the settings are those of an x86 processor")
@pytest.mark.parametrize("name", ["oscillating_cam", "spindle", "rubber_roller_61804", "four_bar"])
def test_an_old_processor_gives_eight_digits_of_the_same(name):
    command = [sys.executable, "-m", "drivewright", "run", str(EXAMPLES / f"{name}.toml"), "--no-figures", "--json"]
    answer = subprocess.run(command, env=os.environ | PLAIN, capture_output=True, text=True, timeout=600, check=True)
    there, here = json.loads(answer.stdout)["values"], dw.run(dw.load(EXAMPLES / f"{name}.toml")).values
    assert set(there) == set(here)
    size = {}
    for value in here.values():
        size[value.unit] = max(size.get(value.unit, 0.0), abs(value.value))
    missed = {
        key: (value.value, there[key]["value"])
        for key, value in here.items()
        if not key.endswith("residual") and abs(value.value - there[key]["value"]) > DIGITS * abs(value.value) + NOISE * size[value.unit]
    }
    assert not missed
