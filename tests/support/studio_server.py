"""The studio's server as a process."""

import os
import re
import subprocess
import time
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from urllib.parse import urlsplit

from places import EXAMPLES

SPEC = EXAMPLES / "four_bar.toml"


@contextmanager
def started(*launches):
    """The servers of [(folder, command, options)], all at once, as soon as they have said their addresses; `said()` is all they say."""
    servers = [_launched(*launch) for launch in launches]
    try:
        for server in servers:
            server.address = urlsplit(waited(lambda server=server: re.search(r"http://\S+", server.said()), server.process)[0])
            server.port = server.address.port
        yield servers
    finally:
        for server in servers:
            server.process.terminate()
        for server in servers:
            try:
                server.process.wait(10)
            except subprocess.TimeoutExpired:
                server.process.kill()
                server.process.wait()


def _launched(folder, command, *options):
    text = folder / "stderr.txt"
    environment = {**os.environ, "TMPDIR": str(folder), "PYTHONIOENCODING": "utf-8"}
    with text.open("wb") as stderr:
        process = subprocess.Popen([*command, "studio", str(SPEC), "--port", "0", "--no-browser", *options], stderr=stderr, env=environment)
    return SimpleNamespace(folder=folder, process=process, said=lambda: text.read_text(encoding="utf-8"))


def waited(condition, process, seconds=60):
    deadline = time.monotonic() + seconds
    while not (found := condition()):
        assert process.poll() is None and time.monotonic() < deadline
        time.sleep(0.02)
    return found


def below(pid):
    """Ids of all processes that a process has started, and theirs."""
    parents = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:  # gone meanwhile
            continue
        if fields[0] != "Z":
            parents[int(stat.parent.name)] = int(fields[1])
    found, fresh = set(), {pid}
    while fresh:
        fresh = {child for child, parent in parents.items() if parent in fresh} - found
        found |= fresh
    return found
