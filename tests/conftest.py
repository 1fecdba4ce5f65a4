"""Shared by all tests: numpy errors raised, our own warnings as errors, fixed seeds, and an honest word about what was skipped."""

import importlib
import os
import shutil
from functools import cache

import numpy as np
import pytest

try:
    from hypothesis import settings
except ImportError:  # its tests say so themselves
    pass
else:
    settings.register_profile("house", deadline=None, derandomize=True)  # the same cases every time; a loaded machine is no failure
    settings.load_profile("house")

EXTRAS = {
    "needs_fe": (("ngsolve",), "fe"),
    "needs_pdf": (("typst",), "pdf"),
    "needs_optimise": (("pymoo",), "optimise"),
    "needs_peers": (("exudyn", "pylinkage", "mpmath", "jax", "Pynite"), "peers"),
    "needs_studio": (("nicegui",), "studio"),
    "needs_cluster": (("distributed",), "cluster"),
    "needs_browser": (("playwright",), "dev"),
}
BROWSER = os.environ.get("CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")


def pytest_configure(config):
    config.addinivalue_line("filterwarnings", r"error:::drivewright(\..*)?")


@pytest.fixture(autouse=True)
def _numpy_errors_raise():
    with np.errstate(divide="raise", over="raise", invalid="raise"):
        yield


@pytest.fixture(autouse=True)
def _faults_fail(request, monkeypatch):
    """A fault of ours in an analysis, which a run keeps as a finding, fails the test, unless it is marked `faults`."""
    if request.node.get_closest_marker("faults"):
        return

    def fault(spec, error):
        raise error

    monkeypatch.setattr("drivewright.runner._program_fault", fault)


@cache
def missing(marker):
    """(why, the command that helps) for a marker whose requirement is not met, else None."""
    modules, extra = EXTRAS[marker]
    for module in modules:
        try:
            importlib.import_module(module)
        except ImportError as error:
            return f"{module}: {error}", f"pip install -e '.[{extra}]'   (and `make system` for libraries)"
    if marker == "needs_browser" and not BROWSER:
        return "no Chromium", "make system, or CHROMIUM=/path/to/chromium"
    return None


def pytest_runtest_setup(item):
    """Skips, or under DRIVEWRIGHT_REQUIRE=all fails, a test whose extra or system library is missing."""
    for marker in EXTRAS:
        if item.get_closest_marker(marker) and (found := missing(marker)):
            if os.environ.get("DRIVEWRIGHT_REQUIRE") == "all":
                pytest.fail(f"DRIVEWRIGHT_REQUIRE=all, but {marker}: {found[0]}", pytrace=False)
            pytest.skip(f"{marker}: {found[0]}")


def pytest_terminal_summary(terminalreporter):
    """The last lines: which tests were skipped, why, what helps.  Read off the reports, which also come from parallel workers."""
    reasons = [report.longrepr[2] for report in terminalreporter.stats.get("skipped", ()) if isinstance(report.longrepr, tuple)]
    for marker in EXTRAS:
        if number := sum(f"{marker}: " in reason for reason in reasons):
            why, remedy = missing(marker) or ("?", "run it again")
            terminalreporter.write_line(f"skipped: {number} test(s) marked {marker} ({why}); what helps: {remedy}")


@pytest.fixture(scope="session")
def chromium():
    """Path and flags of the browser."""
    flags = ["--headless=new", "--disable-dev-shm-usage", "--disable-background-networking", "--no-first-run"]
    return BROWSER, flags + (["--no-sandbox"] if os.geteuid() == 0 else [])
