"""What a module of the page exports is used by another one, or by a test: a reader may trust that the rest is its own."""

import re
from pathlib import Path

import pytest
from in_node import WEB

from drivewright.report import html

pytestmark = pytest.mark.interface

MODULES = {path.stem: path.read_text(encoding="utf-8") for path in (*WEB.glob("*.js"), *Path(html.__file__).parent.glob("*.js"))}
ENTRY = {"main": {"start"}}  # the page itself imports it when it is there


def exported(text):
    """Names that a module exports where it defines them."""
    return set(re.findall(r"^export (?:async )?(?:function\*?|const|let|class) (\w+)", text, re.MULTILINE))


def imported(text):
    """{module: names} that a module imports, or hands on."""
    found = {}
    for names, module in re.findall(r"^(?:import|export) \{([^}]+)\} from \"\./(\w+)\.js\";", text, re.MULTILINE):
        found.setdefault(module, set()).update(name.split(" as ")[0].strip() for name in names.split(","))
    return found


def in_tests():
    """{module: names} that a test imports with `in_node`."""
    found = {}
    for path in Path(__file__).parent.glob("test_web_*.py"):
        for module, names in re.findall(r"\b(\w+)=\"([\w, ]+)\"", path.read_text(encoding="utf-8")):
            found.setdefault(module, set()).update(name.strip() for name in names.split(","))
    return found


def test_every_export_is_used_elsewhere():
    told = in_tests()
    used = {module: ENTRY.get(module, set()) | told.get(module, set()) for module in MODULES}
    for text in MODULES.values():
        for module, names in imported(text).items():
            used[module] |= names
    assert sum(map(len, map(exported, MODULES.values()))) > 100
    assert {module: left for module, text in MODULES.items() if (left := exported(text) - used[module])} == {}
