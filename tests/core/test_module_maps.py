"""The docstring of a package names all its modules, so that a reader finds the room before opening files."""

import ast
import re

import pytest
from places import SOURCE

pytestmark = pytest.mark.interface

FEW = 4  # a package of fewer modules needs no map
WARM = {"warm"}  # compiles ahead of time, in every package that has kernels


def modules_of(folder):
    """Names of the public modules of a package."""
    names = {path.stem for path in folder.glob("*.py")} - WARM
    return sorted(name for name in names if not name.startswith("_"))


PACKAGES = {
    str(path.parent.relative_to(SOURCE)): path.parent
    for path in sorted(SOURCE.glob("*/**/__init__.py"))
    if len(modules_of(path.parent)) >= FEW and path.parent.parent.name != "mechanisms"
}


@pytest.mark.parametrize("name", PACKAGES)
def test_a_package_says_what_is_in_it(name):
    folder = PACKAGES[name]
    words = set(re.findall(r"\w+", ast.get_docstring(ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))) or ""))
    assert [module for module in modules_of(folder) if module not in words] == []


def test_there_are_packages():
    assert {"chains", "multibody", "shafts", "chains/explicit"} <= PACKAGES.keys()
