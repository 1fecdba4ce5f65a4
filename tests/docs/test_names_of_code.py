"""Names of code in the documentation are names of the program: each one in backticks that begins with the package's name imports."""

import importlib
import re

import pytest
from markdown_links import written_pages

pytestmark = pytest.mark.interface

NAME = re.compile(r"`(drivewright(?:\.\w+)+)(?:\(\))?`")
GROUPS = {"drivewright.commands", "drivewright.impact_laws", "drivewright.joints", "drivewright.motion_laws", "drivewright.views"}
GROUPS |= {"drivewright.contact_laws", "drivewright.mechanisms", "drivewright.validation"}  # entry points
MENTIONED = sorted({(name, path) for path in written_pages().values() for name in NAME.findall(path.read_text(encoding="utf-8"))} - GROUPS)
NAMES = sorted({name for name, _ in MENTIONED} - GROUPS)


def imports(name: str) -> bool:
    """Whether a dotted name is a module, or something in one."""
    steps = name.split(".")
    for end in range(len(steps), 0, -1):
        try:
            value = importlib.import_module(".".join(steps[:end]))
        except ModuleNotFoundError as error:
            if not (error.name or "").startswith("drivewright"):
                pytest.skip(f"{error.name} is not installed")
            continue
        return _has(value, steps[end:])
    return False


def _has(value: object, steps: list[str]) -> bool:
    for step in steps:
        fields = getattr(value, "__annotations__", {}) | getattr(value, "model_fields", {}) if isinstance(value, type) else {}
        if not hasattr(value, step) and step not in fields:
            return False
        value = getattr(value, step, None)
    return True


@pytest.mark.parametrize("name", NAMES)
def test_names_import(name):
    assert imports(name), f"{name} is named in {sorted(str(path) for each, path in MENTIONED if each == name)}"


def test_a_name_that_is_none_is_found():
    assert imports("drivewright.cams") and imports("drivewright.result.Value.label")
    assert not imports("drivewright.cams.no_such_name") and not imports("drivewright.no_such_module")
