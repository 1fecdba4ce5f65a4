"""The reference of the command line, read off its parser: every command with its arguments, options, defaults and exit codes."""

import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Any

import typer

from builders.markdown import cell, code, sentence, table, write_page
from drivewright import registry
from drivewright.cli.app import app
from drivewright.cli.plugin_commands import build_command

EXIT_CODES = (  # as `drivewright.cli.main` gives them
    (0, "done"),
    (1, "a comparison failed: `verify` beyond its limits, `validate` with a changed verdict, `doctor` with a failed self-test"),
    (2, "bad input, or an extra that is not installed"),
    (3, "`--strict` was given and a design check failed"),
    (4, "a partial result was written, no case of a study has an answer, or no feasible design was found"),
    (130, "interrupted by Ctrl-C; after another signal that ends a process 128 and its number"),
)
VALUES = {"path": "path", "int": "integer", "float": "number"}  # classes of what options take; all others are texts
INTRODUCTION = """# Command line

Read off the parser of the program: `drivewright COMMAND --help` prints the same. Results go to stdout, everything else to stderr.
Commands that a plug-in brings are listed by `drivewright --help` as well."""


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write docs/reference/commands.md."""
    root: Any = typer.main.get_command(app)
    lines = [*INTRODUCTION.splitlines(), "", "## Exit codes"]
    lines += table(("code", "meaning"), ((str(number), meaning) for number, meaning in EXIT_CODES))
    lines += ["## Options of the program itself", *_options(root)]
    for name in root.list_commands(typer.Context(root)):
        progress(name)
        command = build_command(name) if name in registry.commands() else root.get_command(typer.Context(root), name)
        lines += ["", f"## drivewright {name}", "", sentence(inspect.cleandoc(command.help or "")), "", *_usage(name, command)]
        lines += _arguments(command)
        lines += _options(command)
    write_page(docs / "reference" / "commands.md", lines)


def _usage(name: str, command: Any) -> list[str]:
    """The line of the command, as a block."""
    arguments = [each for each in command.params if each.param_type_name == "argument"]
    words = [f"{_name(each)}{' ...' if each.nargs == -1 else ''}" for each in arguments]
    words = [word if each.required else f"[{word}]" for word, each in zip(words, arguments, strict=True)]
    return ["```text", " ".join(["drivewright", name, *words, "[OPTIONS]"]), "```"]


def _name(argument: Any) -> str:
    return argument.metavar or argument.name.upper()


def _arguments(command: Any) -> list[str]:
    """Table of what stands without a name."""
    found = [each for each in command.params if each.param_type_name == "argument"]
    rows = ((code(_name(each)), cell(_help(each)), "yes" if each.required else "no") for each in found)
    return table(("argument", "meaning", "required"), rows)


def _options(command: Any) -> list[str]:
    """Table of the options, without --help."""
    found = [each for each in command.params if each.param_type_name == "option" and "--help" not in each.opts]
    rows = ((", ".join(map(code, _spellings(each))), cell(_help(each)), code(_kind(each)), code(_default(each))) for each in found)
    return table(("option", "meaning", "value", "default"), rows)


def _spellings(option: Any) -> list[str]:
    return [*option.opts, *option.secondary_opts]


def _help(parameter: Any) -> str:
    return sentence(getattr(parameter, "help", None) or "").removesuffix(".")


def _kind(option: Any) -> str:
    """What an option takes: "" for a switch."""
    if option.is_flag:
        return ""
    described = getattr(option, "type_descriptor", None)  # of newer versions of the library
    name = VALUES.get(str(getattr(described.annotation, "__name__", "text")).lower(), "text") if described else option.type.name
    return f"{name}{', repeatable' if option.multiple else ''}"


def _default(option: Any) -> str:
    """The default as it would be typed; "" where there is none."""
    default = option.default
    if option.is_flag:
        return (option.opts if default else option.secondary_opts or ["off"])[0]
    return "" if default is None or callable(default) or str(default) in ("", "()", "[]") else str(default)
