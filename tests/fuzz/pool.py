"""A few worker processes that take cases one after another, and are replaced when they die."""

import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterable, Iterator
from pathlib import Path
from queue import Queue
from typing import Any

ROOT = Path(__file__).parents[2]


def answers(numbers: Iterable[int], workers: int = 1) -> Iterator[dict[str, Any]]:
    """{number, code, out, err, wrong, seconds} of every case, as they come; a case that ends its process says how."""
    waiting: Queue[int | None] = Queue()
    done: Queue[dict[str, Any] | None] = Queue()
    for number in numbers:
        waiting.put(number)
    for _ in range(workers):
        waiting.put(None)
        threading.Thread(target=_serve, args=(waiting, done), daemon=True).start()
    for _ in range(workers):
        while (answer := done.get()) is not None:
            yield answer


def _serve(waiting, done):
    worker = None
    while (number := waiting.get()) is not None:
        worker = worker if worker and worker.poll() is None else _started()
        done.put(_asked(worker, number))
    if worker:
        worker.stdin.close()
        worker.wait()
    done.put(None)


def _started():
    package = __package__ or "fuzz"
    folder = ROOT if package.startswith("tests") else ROOT / "tests"
    return subprocess.Popen(
        [sys.executable, "-m", f"{package}.worker"],
        cwd=folder,
        env=os.environ | {"MPLBACKEND": "Agg", "OPENBLAS_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1", "PYTHONWARNINGS": "ignore"},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        encoding="utf-8",
    )


def _asked(worker, number):
    worker.stdin.write(f"{number}\n")
    worker.stdin.flush()
    line = worker.stdout.readline()
    if line:
        return json.loads(line)
    code = worker.wait()
    how = signal.Signals(-code).name if code < 0 else f"exit code {code}"
    return {"number": number, "code": None, "out": "", "err": "", "wrong": [f"ended its process: {how}"], "seconds": None}
