"""`drivewright.solids` is public and loads no finite elements: what needs them says so when it is used, not when it is imported."""

import subprocess
import sys

import pytest

from drivewright import solids

pytestmark = pytest.mark.interface

WITHOUT_FE = """
import sys

class Refusal:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in ("ngsolve", "netgen"):
            raise ModuleNotFoundError(f"No module named {name!r}")

sys.meta_path.insert(0, Refusal())
from drivewright import solids
from drivewright.errors import MissingExtra
from drivewright.scene import circle

assert all(getattr(solids, name) for name in solids.__all__)
assert not {"ngsolve", "netgen"} & set(sys.modules)
try:
    solids.plane_mesh(circle((0.0, 0.0), 0.01), size=1e-3)
except MissingExtra as error:
    print(error)
"""


def test_public_names_are_flat_sorted_and_load():
    assert solids.__all__ == sorted(set(solids.__all__))
    assert all(getattr(solids, name) is not None for name in solids.__all__)
    with pytest.raises(AttributeError, match="no_such_name"):
        solids.no_such_name  # noqa: B018


def test_without_the_extra_only_the_use_fails():
    answer = subprocess.run([sys.executable, "-c", WITHOUT_FE], capture_output=True, text=True, check=True).stdout
    assert "needs the extra 'fe'" in answer
