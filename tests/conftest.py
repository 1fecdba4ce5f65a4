"""Shared by all tests: numpy errors raised, our own warnings as errors, fixed seeds, and an honest word about what was skipped.

`make quick` runs with --quick: it leaves out what `durations.json` lists, the tests that take longer than `QUICK` (a file as a whole where
its preparation does), and skips a test at the first kernel that would have to be compiled.  `make durations` writes that file anew.
"""

import contextlib
import gc
import importlib
import json
import os
import shutil
import sys
from functools import cache
from pathlib import Path

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
    "needs_frames": (("pandas", "xarray"), "frames"),
    "needs_cluster": (("distributed",), "cluster"),
    "needs_browser": (("playwright",), "dev"),
    "needs_docs": (("mkdocs", "material", "mkdocstrings", "mathjax"), "docs"),
}
BROWSER = os.environ.get("CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")


QUICK = 0.3  # seconds that a test of a quick run may take
DURATIONS = Path(__file__).parent / "durations.json"  # {test or file: seconds} of all that take longer


def pytest_addoption(parser):
    parser.addoption("--quick", action="store_true", help="leave out what takes long, compile nothing")
    parser.addoption("--record-durations", action="store_true", help=f"write tests/{DURATIONS.name} after the run")


def pytest_collection_modifyitems(config, items):
    if not config.getoption("--quick"):
        return
    long = json.loads(DURATIONS.read_text(encoding="utf-8"))
    is_long = [item.nodeid in long or item.nodeid.partition("::")[0] in long for item in items]
    config.hook.pytest_deselected(items=[item for item, each in zip(items, is_long, strict=True) if each])
    items[:] = [item for item, each in zip(items, is_long, strict=True) if not each]


@pytest.hookimpl(tryfirst=True)
def pytest_collection(session):
    """Without the garbage collector, for all that is made here stays: looking through it again and again took half of the time."""
    if session.config.getoption("dist", "no") == "no":  # else it is the workers that collect
        gc.disable()
        import_share(session.config)


def pytest_collection_finish():
    gc.freeze()
    gc.enable()


def import_share(config):
    """In one of several workers: import every n-th test file ahead.

    pytest writes the asserts of a file anew and keeps the result as bytecode.  In a fresh clone that takes some twenty seconds, and all
    workers would do all files at the same time; so each does its share, and finds the others done when it collects.
    """
    worker = getattr(config, "workerinput", {"workerid": "gw0", "workercount": 1})
    first, step = int(worker["workerid"].removeprefix("gw")), worker["workercount"]
    for file in files_of(config.args)[first::step] if step > 1 else ():
        sys.path.insert(0, str(file.parent))  # as pytest does
        with contextlib.suppress(Exception, pytest.skip.Exception):  # it is met again, and told, where the file is collected
            importlib.import_module(file.stem)


def files_of(arguments):
    paths = [Path(argument.partition("::")[0]) for argument in arguments]
    return sorted(file for path in paths for file in (path.rglob("test_*.py") if path.is_dir() else [path]))


def pytest_configure(config):
    config.addinivalue_line("filterwarnings", r"error:::drivewright(\..*)?")


@pytest.fixture(autouse=True)
def _numpy_errors_raise():
    with np.errstate(divide="raise", over="raise", invalid="raise"):
        yield


@pytest.fixture(autouse=True, scope="session")
def _nothing_compiles(request):
    """In a quick run a test that calls a kernel which is not in the cache is skipped there and then: compiling takes minutes."""
    if not request.config.getoption("--quick"):
        yield
        return
    from drivewright._jit.disk_cache import KernelCache

    load = KernelCache.load_overload

    def load_or_skip(self, signature, target):
        compiled = load(self, signature, target)
        if compiled is None:
            pytest.skip("calls a kernel that is not compiled yet")
        return compiled

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(KernelCache, "load_overload", load_or_skip)
        yield


@pytest.fixture(autouse=True)
def _faults_fail(request, monkeypatch):
    """A fault of ours in an analysis, which a run keeps as a finding, fails the test, unless it is marked `faults`."""
    if request.node.get_closest_marker("faults"):
        return

    def fault(spec, error):
        raise error

    monkeypatch.setattr("drivewright.runner._program_fault", fault)


@pytest.fixture(autouse=True)
def _no_helping_hand(monkeypatch):
    """Tests have all cores at work already: figures are drawn by the process that wants them."""
    monkeypatch.setattr("drivewright.execution.helper.worker_count", lambda workers: 1)


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

    if terminalreporter.config.getoption("--record-durations"):
        reports = [report for group in terminalreporter.stats.values() for report in group if isinstance(report, pytest.TestReport)]
        DURATIONS.write_text(json.dumps(durations_of(reports), indent=0, sort_keys=True) + "\n", encoding="utf-8")


def durations_of(reports):
    """{test: seconds} of the calls that take longer than `QUICK`, {file: seconds} where the preparation of a test does."""
    long = {}
    for report in reports:
        name = report.nodeid if report.when == "call" else report.nodeid.partition("::")[0]
        if report.duration > QUICK:
            long[name] = max(round(report.duration, 1), long.get(name, 0.0))
    return {name: seconds for name, seconds in long.items() if "::" not in name or name.partition("::")[0] not in long}


@pytest.fixture(scope="session")
def chromium():
    """Path and flags of the browser."""
    flags = ["--headless=new", "--disable-dev-shm-usage", "--disable-background-networking", "--no-first-run"]
    return BROWSER, flags + (["--no-sandbox"] if os.geteuid() == 0 else [])
