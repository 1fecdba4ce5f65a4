"""The public names are flat, sorted, and exactly these; importing the package loads nothing heavy."""

import subprocess
import sys
from types import ModuleType

import pytest

import drivewright as dw

NAMES = [
    "Cam",
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
    "bearings",
    "build",
    "cams",
    "chains",
    "contact",
    "curves",
    "fatigue",
    "gears",
    "indexing",
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


@pytest.mark.parametrize("package", [dw.studies], ids=lambda package: package.__name__)
def test_names_of_a_package_are_sorted_and_load(package):
    assert list(package.__all__) == sorted(package.__all__)
    assert all(not isinstance(getattr(package, name), ModuleType) for name in package.__all__)


def test_importing_the_package_loads_nothing_heavy():
    code = "import sys, drivewright; print(' '.join(m.split('.')[0] for m in sys.modules))"
    loaded = set(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split())
    assert not loaded & HEAVY
