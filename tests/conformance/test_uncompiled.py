"""The kernels without their compiler: short runs of every kind give the same numbers in plain Python."""

import json
import os
import subprocess
import sys

import pytest

pytestmark = [pytest.mark.property, pytest.mark.slow]

RUN = """
import json, sys
import numpy as np
import drivewright as dw
from drivewright.spec import load, preset_path
kind, preset, analyses, changes = json.loads(sys.argv[1])
result = dw.run(load(preset_path(kind, preset), changes), analyses)
columns = {f"{table.name}: {column.name}": column.data for table in result.tables.values() for column in table.columns}
sizes = {name: float(np.sqrt(np.nanmean(np.square(data)))) for name, data in columns.items() if data.dtype.kind == "f" and data.size}
print(json.dumps({"values": {name: value.value for name, value in result.values.items()} | sizes, "outcome": result.outcome}))
"""
STILL = ["simulate.discard=0", "simulate.ensemble=1"]
CASES = {
    "cam": ("cam", "default", ["motion", "geometry", "forces"], []),
    "pusher": ("seedling-pusher", "default", ["train", "planting"], []),
    "shaft": ("shaft", "spindle", ["statics", "flexibility"], []),
    "indexer": ("indexer", "default", ["motion", "profile", "contacts"], []),
    "linkage": ("linkage", "default", ["motion", "forces", "energy"], ["simulate.turns=0.2", *STILL]),
    "linkage with play": ("linkage", "slider_crank", ["motion", "pins"], ["simulate.turns=0.01", *STILL]),
    "stiff linkage": ("linkage", "slider_crank", ["motion"], ["simulate.turns=0.005", 'simulate.method="radau"', *STILL]),
    "chain": ("silent-chain", "default", ["meshing", "layout", "geometry"], []),
    "running chain": (
        "silent-chain",
        "default",
        ["dynamics"],
        ['dynamics.duration="0.002 s"', 'dynamics.settling="0 s"', "dynamics.ensemble=1"],
    ),
}


def values(case, compiled):
    """{name: value} of a short run in a Python of its own, with the root mean square of every column."""
    environment = os.environ | ({} if compiled else {"NUMBA_DISABLE_JIT": "1"})
    run = subprocess.run([sys.executable, "-c", RUN, json.dumps(case)], capture_output=True, text=True, env=environment, check=False)
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)


@pytest.mark.parametrize("name", CASES)
def test_plain_python_gives_the_same_numbers(name):
    with_compiler, without = (values(CASES[name], compiled) for compiled in (True, False))
    assert without["outcome"] == with_compiler["outcome"] and without["values"].keys() == with_compiler["values"].keys()
    assert without["values"] == pytest.approx(with_compiler["values"], rel=1e-6, abs=1e-12) and with_compiler["values"]
