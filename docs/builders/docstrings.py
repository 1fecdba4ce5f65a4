"""Docstrings as the reference shows them: a list of modules, in two columns in the source, becomes a list of Markdown."""

import re
from typing import Any

from griffe import Extension, Module

NAME = r"`?[a-z_]\w*(?:\.\w+)*`?"
ENTRY = re.compile(rf"^({NAME}(?:, {NAME})*) {{2,}}(\S.*)$")


def listed(text: str) -> str:
    """A docstring with lines "name   what it is" as items "- `name`: what it is"; lines that are set in continue an item."""
    lines: list[str] = []
    in_list = False
    for line in text.splitlines():
        if entry := ENTRY.match(line):
            names = ", ".join(f"`{name.strip('`')}`" for name in entry[1].split(", "))
            lines += [*([] if in_list else [""]), f"- {names}: {entry[2]}"]
            in_list = True
        elif in_list and line.startswith("  "):
            lines[-1] += f" {line.strip()}"
        else:
            in_list = False
            lines.append(line)
    return "\n".join(lines)


class ModuleLists(Extension):
    """Turns the lists in the docstrings of modules."""

    def on_module(self, *, mod: Module, **kwargs: Any) -> None:
        """After a module was read."""
        if mod.docstring:
            mod.docstring.value = listed(mod.docstring.value)
