"""What an editor sees: the stub of the package has its public names, and a script is typed through."""

import ast
import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import drivewright as dw

pytestmark = pytest.mark.interface

STUB = Path(dw.__file__).with_name("__init__.pyi")
USAGE = Path(__file__).parent / "typed" / "usage.py"
CHECKER = shutil.which("basedpyright", path=Path(sys.executable).parent) or shutil.which("basedpyright")


def test_the_stub_has_exactly_the_public_names():
    names = set()
    for node in ast.parse(STUB.read_text()).body:
        if isinstance(node, ast.ImportFrom):
            names |= {alias.asname for alias in node.names if alias.asname and not alias.asname.endswith("Model")}
        elif isinstance(node, ast.FunctionDef):
            names.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            names.add(node.target.id)
    assert names - {"__all__"} == set(dw.__all__)


@pytest.mark.skipif(not CHECKER, reason="basedpyright is not installed")
def test_a_script_is_typed_through(tmp_path):
    settings = {"include": [str(USAGE)], "extraPaths": [str(STUB.parents[1])], "typeCheckingMode": "standard", "pythonVersion": "3.11"}
    (tmp_path / "pyrightconfig.json").write_text(json.dumps(settings))
    command = [CHECKER, "--outputjson", "--pythonpath", sys.executable, "--project", str(tmp_path)]
    found = json.loads(subprocess.run(command, capture_output=True, text=True, check=False).stdout)
    assert found["summary"]["filesAnalyzed"] == 1
    assert [each["message"] for each in found["generalDiagnostics"] if each["severity"] == "error"] == []


def test_the_package_says_that_it_is_typed():
    assert (STUB.parent / "py.typed").is_file()
