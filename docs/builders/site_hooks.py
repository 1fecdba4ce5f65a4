"""What mkdocs does to pages besides its plugins: folders in the navigation, and links from names of code to the reference."""

import re
import sys
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

NAME = re.compile(r"(?<![\[`\w])`(drivewright(?:\.\w+)+)(\(\))?`(?![`\]])")
FENCED = re.compile(r"(^```.*?^```)", flags=re.DOTALL | re.MULTILINE)
PYTHON_PAGES = "reference/python/"


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
    known = documented_names()
    return "".join(
        part if part.startswith("```") else NAME.sub(lambda found: _linked(found, known), part) for part in FENCED.split(markdown)
    )


def _linked(found: re.Match[str], known: frozenset[str]) -> str:
    name = found[1]
    target = _defined_name(name)
    return f"[{found[0]}][{target}]" if target in known else found[0]


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
def documented_names() -> frozenset[str]:
    """Names of the modules of the Python reference, and of what they define and document."""
    from builders.reference_python import documented_modules

    names = set()
    for module in documented_modules():
        names.add(module)
        for name, value in vars(import_module(module)).items():
            if not name.startswith("_") and getattr(value, "__module__", None) == module and getattr(value, "__doc__", None):
                names.add(f"{module}.{name}")
    return frozenset(names)
