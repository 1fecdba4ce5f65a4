"""Shared by all tests: numpy errors raised, our own warnings as errors, and an honest word about what was skipped."""

import importlib
import os
import shutil

import numpy as np
import pytest

EXTRAS = {
    "needs_fe": (("ngsolve",), "fe"),
    "needs_pdf": (("typst",), "pdf"),
    "needs_optimise": (("pymoo",), "optimise"),
    "needs_peers": (("exudyn", "pylinkage", "mpmath"), "peers"),
    "needs_browser": (("playwright",), "dev"),
}
BROWSER = os.environ.get("CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")


@pytest.fixture(autouse=True)
def _numpy_errors_raise():
    with np.errstate(divide="raise", over="raise", invalid="raise"):
        yield


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


def pytest_collection_modifyitems(config, items):
    used = {m for item in items for m in EXTRAS if item.get_closest_marker(m)}
    config.left_out = {m: reason for m in sorted(used) if (reason := missing(m))}
    for item in items:
        for marker, (why, _) in config.left_out.items():
            if item.get_closest_marker(marker):
                if os.environ.get("DRIVEWRIGHT_REQUIRE") == "all":
                    pytest.fail(f"DRIVEWRIGHT_REQUIRE=all, but {marker}: {why}", pytrace=False)
                item.add_marker(pytest.mark.skip(reason=f"{marker}: {why}"))


def pytest_terminal_summary(terminalreporter, config):
    for marker, (why, remedy) in getattr(config, "left_out", {}).items():
        terminalreporter.write_line(f"skipped: tests marked {marker} ({why}); what helps: {remedy}")


@pytest.fixture(scope="session")
def chromium():
    """Path and flags of the browser."""
    flags = ["--headless=new", "--disable-dev-shm-usage", "--disable-background-networking", "--no-first-run"]
    return BROWSER, flags + (["--no-sandbox"] if os.geteuid() == 0 else [])
