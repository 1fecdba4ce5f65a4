"""A process that ends, or fails, at its n-th file operation below a folder: every boundary once, each in a fork of one process.

The operations are counted at the door of the C library (`file_faults.c`), so those of SQLite and Arrow are among them.
"""

import ctypes
import errno
import os
import shutil
import subprocess
import sys
import tempfile
import traceback
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

COUNT, KILL, TORN, FULL, ONCE = range(5)
KILLED = -9


@cache
def library() -> Path:
    """The compiled counter; skips where there is no C compiler, or where nothing can be loaded before the C library."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None or sys.platform != "linux":
        pytest.skip("needs Linux and a C compiler")
    target = Path(tempfile.mkdtemp(prefix="file-faults-")) / "file_faults.so"
    source = Path(__file__).with_suffix(".c")
    subprocess.run([compiler, "-O1", "-shared", "-fPIC", "-o", target, source, "-ldl"], check=True)
    return target


def run_scenario(name: str, folder: Path, *arguments: object) -> str:
    """Run a scenario of `fault_scenarios` in a process with the counter; what it printed."""
    script = Path(__file__).with_name("fault_scenarios.py")
    done = subprocess.run(
        [sys.executable, script, name, folder, *map(str, arguments)],
        env=os.environ | {"LD_PRELOAD": str(library())},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
    return done.stdout


# -- in the process with the counter -------------------------------------------------------------------------------------------


class Counter:
    """The counter of this process, for operations below `folder`."""

    def __init__(self, folder: Path) -> None:
        self._library = ctypes.CDLL(None)
        self._library.fault_arm.argtypes = (ctypes.c_char_p, ctypes.c_long, ctypes.c_int, ctypes.c_int)
        self._library.fault_count.restype = ctypes.c_long
        self._folder = os.fsencode(folder)

    def arm(self, mode: int, number: int = 0, error: int = errno.ENOSPC) -> None:
        """Count from now on."""
        self._library.fault_arm(self._folder, number, mode, error)

    def count(self) -> int:
        """Operations since then."""
        self._library.fault_disarm()
        return self._library.fault_count()


def in_fork(action: Callable[[], object]) -> int:
    """The exit code of a fork that does something, negative for a signal; 99 after an exception, which is printed."""
    sys.stdout.flush()
    child = os.fork()
    if not child:
        code = 99
        try:
            code = action() or 0
        except SystemExit as end:
            code = end.code or 0
        except BaseException:
            traceback.print_exc()
        finally:
            sys.stderr.flush()
            os._exit(code)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def operations(counter: Counter, action: Callable[[], object]) -> int:
    """How many file operations an action takes."""
    reader, writer = os.pipe()

    def counted():
        counter.arm(COUNT)
        code = action()
        os.write(writer, str(counter.count()).encode())
        return code

    assert in_fork(counted) == 0
    os.close(writer)
    with os.fdopen(reader) as pipe:
        return int(pipe.read())
