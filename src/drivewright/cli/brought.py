"""Commands that mechanisms bring: listed without importing them, made from the keys of their spec when they are called."""

import inspect
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from typer.core import TyperGroup

from drivewright import registry
from drivewright.cli import show
from drivewright.errors import SpecError

COMMON = ("format", "mechanism", "optimise")  # keys of every spec that are no options
ENDINGS = (  # options of every command that writes a run folder: name, annotation, default
    ("out", Annotated[Path | None, typer.Option("--out", help="folder to write; default out/<stem of the file>")], None),
    ("figures", Annotated[bool, typer.Option("--figures/--no-figures", help="draw the figures")], True),
    ("as_json", Annotated[bool, typer.Option("--json", help="print the result as JSON to stdout")], False),
    ("strict", Annotated[bool, typer.Option("--strict", help="exit 3 when a check fails")], False),
)


class Commands(TyperGroup):
    """The commands of the house, then those that mechanisms bring.

    Their names are read off the installed packages; a mechanism is imported only when its command is called.
    """

    def list_commands(self, ctx):
        own = super().list_commands(ctx)
        return [*own, *(name for name in registry.commands() if name not in own)]

    def get_command(self, ctx, cmd_name):
        """The house's own command, or for the list of commands a line that says who brings it."""
        found = super().get_command(ctx, cmd_name)
        return found or (_placeholder(cmd_name) if cmd_name in registry.commands() else None)

    def resolve_command(self, ctx, args):
        """What was called: a brought command is made now."""
        name, found, rest = super().resolve_command(ctx, args)
        return name, (made(name) if getattr(found, "brought", False) else found), rest


def _placeholder(name):
    found = _typer_command(name, lambda: None, f"Brought by {registry.commands()[name]}; see drivewright {name} --help.")
    found.brought = True
    return found


def made(name):
    """The command-line command of a registered `Command`: its argument, an option for each further key, and the usual endings."""
    command = registry.command(name)
    fields = {key: field for key, field in command.evaluation.spec.model_fields.items() if key not in COMMON}

    def call(out, figures, as_json, strict, **texts):
        _run(command, {key: text for key, text in texts.items() if text is not None}, out, figures, as_json, strict)

    first = inspect.Parameter(
        command.argument,
        inspect.Parameter.KEYWORD_ONLY,
        annotation=Annotated[str, typer.Argument(metavar=command.argument.upper(), help=fields[command.argument].description)],
    )
    options = [
        inspect.Parameter(key, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=_option(key, field))
        for key, field in fields.items()
        if key != command.argument
    ]
    endings = [inspect.Parameter(key, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=kind) for key, kind, default in ENDINGS]
    call.__signature__ = inspect.Signature([first, *options, *endings])
    call.__annotations__ = {parameter.name: parameter.annotation for parameter in call.__signature__.parameters.values()}
    return _typer_command(name, call, command.summary)


def _option(key, field):
    """A key of a spec as an option that takes text; the example says how it is written."""
    default = "" if field.is_required() or field.default in (None, "") else f"; default {field.default}"
    example = f", e.g. {field.examples[0]}" if field.examples else ""
    return Annotated[str | None, typer.Option(_flag(key), help=f"{field.description}{example}{default}", show_default=False)]


def _flag(key):
    return f"--{key.replace('_', '-')}"


def _typer_command(name, function, summary):
    own = typer.Typer(add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)
    own.command(name, help=summary)(function)
    return typer.main.get_command(own)


def _run(command, texts, out, figures, as_json, strict):
    """Spec from texts, evaluation, run folder, result on stdout."""
    from drivewright import runner
    from drivewright.report.content import Views
    from drivewright.report.folder import write_run_folder
    from drivewright.spec import from_document

    model, path = command.evaluation.spec, Path(texts[command.argument])
    tables = {"mechanism": command.name} | {key: _value(model, key, text) for key, text in texts.items()}
    with show.progress(path.name) as step, show.located(path), _options_named(command, texts):
        result = runner.run(from_document(tables, model), progress=step)
        plots = command.evaluation.plots
        shown = Views(plots=tuple(plots(result) if callable(plots) else plots))
        folder = write_run_folder(result, Path("out") / path.stem if out is None else out, figures, shown)
    show.note(f"wrote {folder}/")
    if not as_json:
        show.result(result)
    show.leave([result], as_json, strict)


@contextmanager
def _options_named(command, texts):
    """A complaint about a key of the spec names the option that the user wrote."""
    try:
        yield
    except SpecError as error:
        first = (error.key or "").split(".")[0]
        if first not in texts or error.file is not None:
            raise
        raise error.located(key="" if first == command.argument else _flag(first)) from None


def _value(model, key, text):
    """Numbers and switches are read as TOML; names, paths and quantities stand as they are."""
    from drivewright.spec import read_value
    from drivewright.spec.fields import dimension_of, type_of

    field = model.model_fields[key]
    return read_value(text) if dimension_of(field) is None and type_of(field.annotation) in (int, float, bool) else text
