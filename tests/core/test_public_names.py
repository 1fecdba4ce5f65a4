"""The public names are flat, sorted, and exactly these; importing the package loads nothing heavy."""

import re
import subprocess
import sys
from types import ModuleType

import pytest
from places import ROOT

import drivewright as dw

pytestmark = pytest.mark.interface

NAMES = [
    "Cam",
    "DesignComparison",
    "DrivewrightError",
    "Indexer",
    "InputError",
    "Linkage",
    "MissingExtra",
    "Result",
    "Scene",
    "SeedlingPusher",
    "Shaft",
    "SilentChain",
    "SolverError",
    "SpecError",
    "Study",
    "advise",
    "bearings",
    "build",
    "by_reference",
    "cams",
    "chains",
    "compare",
    "contact",
    "curves",
    "fatigue",
    "gears",
    "implements",
    "indexing",
    "kernel",
    "linspace",
    "load",
    "materials",
    "motion",
    "multibody",
    "open_study",
    "optimise",
    "run",
    "shafts",
    "solids",
    "studies",
    "sweep",
    "units",
    "verify",
]
HEAVY = {"numba", "scipy", "matplotlib", "pyarrow", "pint", "pydantic", "numpy", "typer", "rich"}


def test_public_names_are_exactly_these():
    assert [name for name in dw.__all__ if name != "__version__"] == NAMES == sorted(NAMES)


def test_every_public_name_loads():
    assert all(getattr(dw, name) is not None for name in NAMES)


PACKAGES = [name for name in NAMES if isinstance(getattr(dw, name), ModuleType)]


@pytest.mark.parametrize("package", PACKAGES)
def test_a_package_lists_what_it_exports(package):
    module = getattr(dw, package)
    exported = list(getattr(module, "__all__", ()))
    assert exported and len(exported) == len(set(exported))
    assert [name for name in exported if not hasattr(module, name)] == []


def shown():
    """(file, package, name) of everything that a page or an example takes from a package."""
    pages = [ROOT / "README.md", *ROOT.glob("docs/**/*.md"), *ROOT.glob("examples/**/*.py"), *ROOT.glob("src/**/*.md")]
    for path in pages:
        text = path.read_text(encoding="utf-8")
        for package, name in re.findall(r"\bdw\.(\w+)\.(\w+)", text):
            yield path.name, package, name
        for package, names in re.findall(r"^from drivewright\.(\w+) import (.+)$", text, re.MULTILINE):
            yield from ((path.name, package, name.split(" as ")[0].strip()) for name in names.split(","))


def test_what_the_docs_show_of_a_package_is_exported():
    used = [(page, package, name) for page, package, name in shown() if package in PACKAGES]
    assert used, "the docs show nothing of any package?"
    assert [f"{page}: {package}.{name}" for page, package, name in used if name not in getattr(dw, package).__all__] == []


def test_an_unknown_name_is_an_attribute_error():
    try:
        dw.no_such_name  # noqa: B018
    except AttributeError as error:
        assert "no_such_name" in str(error)
    else:
        raise AssertionError("no error")


def test_a_name_is_still_the_function_after_its_module_was_imported():
    import drivewright.runner
    import drivewright.studies.optimisation  # noqa: F401

    assert callable(dw.run) and callable(dw.optimise) and callable(dw.build)


@pytest.mark.parametrize("package", [dw.chains, dw.studies], ids=lambda package: package.__name__)
def test_names_of_a_package_are_sorted_and_load(package):
    assert list(package.__all__) == sorted(package.__all__)
    assert all(not isinstance(getattr(package, name), ModuleType) for name in package.__all__)


def test_importing_the_package_loads_nothing_heavy():
    code = "import sys, drivewright; print(' '.join(m.split('.')[0] for m in sys.modules))"
    loaded = set(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split())
    assert not loaded & HEAVY
