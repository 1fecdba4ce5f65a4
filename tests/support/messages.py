"""Messages to people, read off the sources of the package: errors, findings, help of options, lines on the terminal.

A message is read as its literal text; what is filled in at run time stands as `HOLE`.  Texts that a message takes from a variable are read
where they are written, if that is one of the places below.
"""

import ast
from pathlib import Path
from typing import NamedTuple

from places import SOURCE

HOLE = "\N{HORIZONTAL ELLIPSIS}"
ERRORS = {
    "InputError",
    "SpecError",
    "UnitError",
    "MissingFile",
    "UnknownName",
    "GeometryCheckFailed",
    "DoesNotAssemble",
    "MissingExtra",
    "SolverError",
    "CoarseContact",
    "UnknownChain",
    "UnknownDesignation",
    "ValueError",
}
NOUNS = {"UnknownName", "UnknownChain", "UnknownDesignation", "MissingExtra"}  # take a noun phrase, and make the sentence of it
# Only the author of a package or a caller with a wrong argument meets these, with a traceback; they may speak of Python.
OF_PROGRAMMERS = {"TypeError", "AttributeError", "NotImplementedError", "AssertionError", "OSError"}
PRINTED = {"note", "note_step", "echo", "secho", "print", "say", "warn"}  # functions that show their first argument
HELPED = {"help", "metavar", "short_help", "epilog"}  # keywords of commands and options


class Message(NamedTuple):
    """One text to people: where it is written, what it is (error, help, printed, finding, or part of one), and its words."""

    file: str
    line: int
    kind: str
    text: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line} ({self.kind}): {self.text}"


def texts(node: ast.AST) -> list[str]:
    """The texts that an expression can give: both sides of a condition, sums joined, holes for what is filled in."""
    if isinstance(node, ast.Constant):
        return [node.value] if isinstance(node.value, str) else []
    if isinstance(node, ast.JoinedStr):
        return ["".join(part.value if isinstance(part, ast.Constant) else HOLE for part in node.values)]
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return [left + right for left in texts(node.left) or [HOLE] for right in texts(node.right) or [HOLE]]
    if isinstance(node, ast.IfExp):
        return texts(node.body) + texts(node.orelse)
    return []


def inner_texts(node: ast.AST) -> list[str]:
    """Texts within the holes of a message: the words of a condition, of a joined list."""
    return [
        part.value
        for hole in ast.walk(node)
        if isinstance(hole, ast.FormattedValue)
        for choice in ast.walk(hole.value)
        if isinstance(choice, ast.IfExp)
        for part in (choice.body, choice.orelse)
        if isinstance(part, ast.Constant) and isinstance(part.value, str) and " " in part.value.strip()
    ]


def name_of(call: ast.Call) -> str:
    """The last name of what is called."""
    return call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")


def messages_of(path: Path) -> list[Message]:
    """All messages of one file."""
    return _messages(ast.parse(path.read_text(encoding="utf-8")), path.relative_to(SOURCE).as_posix())


def messages_in(source: str) -> list[Message]:
    """All messages of a piece of source."""
    return _messages(ast.parse(source), "source")


def _messages(tree: ast.AST, file: str) -> list[Message]:
    found = [
        Message(file, node.lineno, kind, text)
        for node in ast.walk(tree)
        for stated, expression in _stated(node)
        for kind, text in [(stated, each) for each in texts(expression)] + [("part", each) for each in inner_texts(expression)]
        if text.strip(HOLE + " ")
    ]
    return sorted(set(found))


def _stated(node: ast.AST) -> list[tuple[str, ast.AST]]:
    """(kind, expression) of the messages that a node states."""
    if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)) and "finding" in node.name:
        returned = [each.value for each in ast.walk(node) if isinstance(each, (ast.Yield, ast.Return)) and each.value is not None]
        return [("finding", text) for each in returned for text in (each.elts if isinstance(each, (ast.List, ast.Tuple)) else [each])]
    if not isinstance(node, ast.Call):
        return []
    name, stated = name_of(node), [("help", each.value) for each in node.keywords if each.arg in HELPED]
    if name in ERRORS and node.args:
        stated.append(("part" if name in NOUNS else "error", node.args[0]))
    elif name in PRINTED and node.args:
        stated.append(("printed", node.args[0]))
    elif name == "append" and node.args and "findings" in ast.unparse(node.func):
        stated.append(("finding", node.args[0]))
    return stated


def all_messages() -> list[Message]:
    """The messages of the whole package."""
    return [message for path in sorted(SOURCE.rglob("*.py")) for message in messages_of(path)]
