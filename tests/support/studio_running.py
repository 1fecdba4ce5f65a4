"""A running studio, and what its tests do with a page of it."""

import socket
import subprocess
import sys
import time
import urllib.request
from contextlib import contextmanager

from browsing import until
from places import ROOT

from drivewright.studio.opening import packed

EXAMPLES = ROOT / "examples"


def free_port():
    """A port that nobody listens at."""
    with socket.socket() as asking:
        asking.bind(("127.0.0.1", 0))
        return asking.getsockname()[1]


@contextmanager
def running(port, spec=None):
    """The address of `drivewright studio SPEC --port PORT --no-browser`, served within 10 s."""
    command = [sys.executable, "-m", "drivewright", "studio", *([str(spec)] if spec else []), "--port", str(port), "--no-browser"]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    address = f"http://127.0.0.1:{port}"
    try:
        _healthy(address, process)
        yield address, process
    finally:
        process.terminate()
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()


def _healthy(address, process):
    deadline = time.monotonic() + 60  # ten seconds are promised of a quiet machine; this one runs other tests beside
    while True:
        try:
            with urllib.request.urlopen(f"{address}/healthz", timeout=2) as answer:
                assert answer.read() == b'{"status":"ok"}'
                assert process.poll() is None, "another studio answers at this port"
                return
        except OSError:
            assert process.poll() is None, process.stderr.read()
            assert time.monotonic() < deadline
            time.sleep(0.1)


def shared(address, name):
    """Address that opens an example."""
    return f"{address}/#{packed((EXAMPLES / f'{name}.toml').read_text(encoding='utf-8'))}"


def drawn(page, seconds=90):
    """Wait for a drawing: of the newest design."""
    newest = "String(window.drivewright?.state.design?.gen ?? 'none yet')"
    until(page, f"document.querySelector('[data-gen]')?.dataset.gen === {newest}", seconds)


def analysed(page, seconds=400):
    """Wait until all default analyses of the newest design are shown."""
    until(
        page,
        """(() => { const {design, result, work} = window.drivewright?.state || {};
        return design && result && result.full && result.gen === design.gen && work.state === 'idle'; })()""",
        seconds,
    )


def field(page, key):
    """The label that holds a field's box."""
    return page.get_by_test_id(f"field-{key}")


def enter(page, key, text):
    """Type a value and commit it."""
    box = field(page, key).locator("input, select").first
    box.fill(text)
    box.press("Enter")
