"""Measure what the first run of each kind of drive compiles, with an empty cache, and write `_jit/usual_seconds.toml`.

The seconds are those of a machine that adds ten million numbers in Python in `REFERENCE` seconds, so that it matters little where and
beside what this runs.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from collections import defaultdict

from drivewright import registry
from drivewright._jit.compilation import USUAL

REFERENCE = 0.2
MEASURE = """
import json, sys, time
from drivewright import load, registry, run
from drivewright._jit.compilation import BEGUN, DONE, watched_by

began, measured = {}, []

def watcher(kernel, what):
    if what == BEGUN:
        began[kernel] = time.monotonic()
    elif what == DONE:
        measured.append((kernel, time.monotonic() - began[kernel]))

with watched_by(watcher):
    run(load(registry.mechanism(sys.argv[1]).presets()["default"]))
print(json.dumps(measured))
"""


def slowness() -> float:
    """How many times longer than on the reference machine a loop takes here and now."""
    began, total = time.perf_counter(), 0
    for i in range(10_000_000):
        total += i
    return (time.perf_counter() - began) / REFERENCE


def compiled(kind: str) -> dict[str, list[float]]:
    """{kernel: [seconds of each signature]} of a first run of the kind's default preset."""
    before = slowness()
    with tempfile.TemporaryDirectory() as cache:
        done = subprocess.run(
            [sys.executable, "-c", MEASURE, kind], env=os.environ | {"XDG_CACHE_HOME": cache}, capture_output=True, text=True, check=True
        )
    slow = (before + slowness()) / 2
    seconds = defaultdict(list)
    for kernel, duration in json.loads(done.stdout):
        seconds[kernel].append(round(duration / slow, 1))
    return seconds


def table(kind: str) -> str:
    """The table of a kind, in TOML."""
    return "\n".join([f"[{kind}]", *(f'"{kernel}" = {seconds}' for kernel, seconds in compiled(kind).items())])


if __name__ == "__main__":
    words = (
        "# What a first run of the default preset of each kind compiles: seconds of each signature; written by scripts/usual_seconds.py."
    )
    USUAL.write_text("\n\n".join([words, *(table(kind) for kind in registry.kinds())]) + "\n", encoding="utf-8")
