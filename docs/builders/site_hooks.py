"""What mkdocs does to pages besides its plugins: folders in the navigation, and links from names of code to the reference."""

import posixpath
import re
import sys
from functools import cache
from importlib import import_module
from pathlib import Path
from types import FunctionType
from typing import Any

NAME = re.compile(r"(?<![\[`\w])`(drivewright(?:\.\w+)+)(\(\))?`(?![`\]])")
FENCED = re.compile(r"(^```.*?^```)", flags=re.DOTALL | re.MULTILINE)
PYTHON_PAGES = "reference/python/"
DESCRIBED = (FunctionType, property, classmethod, staticmethod)


def on_config(config: Any) -> Any:
    """An entry of the navigation that ends in "/" stands for the pages of that folder: index.md first, then in order of their names."""
    folder = Path(config.docs_dir)
    sys.path.append(str(folder))  # for the other builders
    config.nav = [_with_folders(entry, folder) for entry in config.nav]
    return config


def _with_folders(entry: Any, folder: Path) -> Any:
    if isinstance(entry, dict):
        return {title: _with_folders(inside, folder) for title, inside in entry.items()}
    if isinstance(entry, list):
        return [_with_folders(each, folder) for each in entry]
    if not entry.endswith("/"):
        return entry
    pages = sorted((folder / entry).glob("*.md"), key=lambda page: (page.name != "index.md", page.name))
    return [str(page.relative_to(folder)) for page in pages]


def on_page_markdown(markdown: str, page: Any, config: Any, files: Any) -> str:
    """A name of code in backticks leads to its place in the reference."""
    if page.file.src_uri.startswith(PYTHON_PAGES):
        return markdown
    folder = posixpath.dirname(page.file.src_uri)
    parts = FENCED.split(markdown)
    return "".join(part if part.startswith("```") else NAME.sub(lambda found: _linked(found, folder), part) for part in parts)


def _linked(found: re.Match[str], folder: str) -> str:
    """A name as a link, where the reference has it: to the heading of its module, or to its own entry."""
    target, modules = _defined_name(found[1]), documented_modules()
    if target in modules:
        return f"[{found[0]}]({posixpath.relpath(modules[target], folder or '.')}#{target})"
    return f"[{found[0]}][{target}]" if target in documented_names() else found[0]


@cache
def _defined_name(name: str) -> str:
    """The name under which the reference has an object: of its module, not of the package that passes it on."""
    module, rest = _module_of(name)
    value: Any = module
    for step in rest:
        value = getattr(value, step, None)
        if value is None:
            return name
    home, qualified = getattr(value, "__module__", None), getattr(value, "__qualname__", None)
    return f"{home}.{qualified}" if home and qualified and rest else name


def _module_of(name: str) -> tuple[Any, list[str]]:
    """(the deepest module of a dotted name, the steps below it)."""
    steps = name.split(".")
    for end in range(len(steps), 0, -1):
        try:
            return import_module(".".join(steps[:end])), steps[end:]
        except ModuleNotFoundError:
            continue
    return None, steps


@cache
def documented_modules() -> dict[str, str]:
    """{module of the Python reference: its page}."""
    from builders.reference_python import modules_of_pages

    return {module: f"{PYTHON_PAGES}{page}.md" for module, page in modules_of_pages()}


@cache
def documented_names() -> frozenset[str]:
    """Names of what the modules of the Python reference define and document."""
    names = set()
    for module in documented_modules():
        for name, value in vars(import_module(module)).items():
            if not name.startswith("_") and getattr(value, "__module__", None) == module and getattr(value, "__doc__", None):
                names |= {f"{module}.{name}", *(f"{module}.{name}.{member}" for member in _members(value))}
    return frozenset(names)


def _members(value: object) -> list[str]:
    """Public methods and properties of a class that say what they do."""
    members = vars(value).items() if isinstance(value, type) else ()
    return [name for name, member in members if not name.startswith("_") and isinstance(member, DESCRIBED) and member.__doc__]
