"""Build a wheel for Linux x86-64 that brings its kernels along, compiled for `disk_cache.BASELINE`.

All examples are run with an empty cache, for that processor; what they compiled is packed into the wheel.  It is found again where Python
and numba are those of this machine, and is compiled anew where they are not.
"""

import os
import platform
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from drivewright._jit.disk_cache import BASELINE, SHIPPED

HERE = Path(__file__).parents[1]


def compile_kernels(cache: Path) -> Path:
    """Run the examples with an empty cache; the folder with their kernels."""
    environment = os.environ | {"XDG_CACHE_HOME": str(cache), "NUMBA_CPU_NAME": BASELINE, "NUMBA_CPU_FEATURES": ""}
    for arguments in (["examples", "--run", "all", "--out", str(cache / "out")], ["doctor", "--warm"]):
        subprocess.run([sys.executable, "-m", "drivewright", *arguments], env=environment, check=True)
    return cache / "drivewright" / "kernels"


def build(out: Path) -> None:
    """Compile, pack, and leave the sources as they were."""
    if (sys.platform, platform.machine()) != ("linux", "x86_64"):
        sys.exit("kernels are packed on Linux x86-64; elsewhere: pip wheel --no-deps .")
    with tempfile.TemporaryDirectory() as cache:
        shutil.copytree(compile_kernels(Path(cache)), SHIPPED, ignore=shutil.ignore_patterns("last-used"))
    try:
        subprocess.run([sys.executable, "-m", "pip", "wheel", "--no-deps", "--wheel-dir", str(out), str(HERE)], check=True)
    finally:
        shutil.rmtree(SHIPPED)


if __name__ == "__main__":
    build(HERE / "dist")
