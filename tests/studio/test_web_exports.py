"""What a module of the page exports is used by another one, or by a test: a reader may trust that the rest is its own."""

import re
from pathlib import Path

import pytest
from in_node import WEB

from drivewright.report import html

pytestmark = pytest.mark.interface

MODULES = {path.stem: path.read_text(encoding="utf-8") for path in (*WEB.glob("*.js"), *Path(html.__file__).parent.glob("*.js"))}
TESTS = "\n".join(path.read_text(encoding="utf-8") for path in Path(__file__).parents[1].rglob("*.py"))
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


def in_tests(module):
    """Names of a module that a test imports with `in_node`."""
    return {name.strip() for names in re.findall(rf'\b{module}="([\w, ]+)"', TESTS) for name in names.split(",")}


def test_every_export_is_used_elsewhere():
    used = {module: ENTRY.get(module, set()) | in_tests(module) for module in MODULES}
    for text in MODULES.values():
        for module, names in imported(text).items():
            used[module] |= names
    assert sum(map(len, map(exported, MODULES.values()))) > 100
    assert {module: left for module, text in MODULES.items() if (left := exported(text) - used[module])} == {}
