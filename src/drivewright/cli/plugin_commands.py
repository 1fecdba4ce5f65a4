"""Commands of mechanisms, from plug-ins too: listed without importing them, built from the keys of their spec when they are called."""

import inspect
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperGroup

from drivewright import registry
from drivewright.cli import show
from drivewright.errors import SpecError
from drivewright.registry import Command

if TYPE_CHECKING:
    from pydantic.fields import FieldInfo

SHARED_KEYS = ("format", "mechanism", "optimise", "report")  # keys of every spec that are no options
PLACEHOLDER = "is_placeholder"  # attribute of a command that is only listed
RUN_FOLDER_OPTIONS = (  # options of every command that writes a run folder: name, annotation, default
    ("out", Annotated[Path | None, typer.Option("--out", help="folder to write; default out/<stem of the file>")], None),
    ("figures", Annotated[bool, typer.Option("--figures/--no-figures", help="draw the figures")], True),
    ("as_json", Annotated[bool, typer.Option("--json", help="print the result as JSON to stdout")], False),
    ("strict", Annotated[bool, typer.Option("--strict", help="exit 3 when a check fails")], False),
)


class CommandGroup(TyperGroup):
    """The program's own commands, then those of the registered mechanisms.

    Their names are read off the installed packages; a mechanism is imported only when its command is called.  The class of a command
    and of its context depends on the version of the library.
    """

    def list_commands(self, ctx: Any) -> list[str]:
        """Names: the program's own commands first."""
        own = super().list_commands(ctx)
        return [*own, *(name for name in registry.commands() if name not in own)]

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """The program's own command, or for the list of commands a placeholder that names the mechanism."""
        own = super().get_command(ctx, cmd_name)
        return own or (_placeholder(cmd_name) if cmd_name in registry.commands() else None)

    def resolve_command(self, ctx: Any, args: list[str]) -> tuple[str | None, Any, list[str]]:
        """(name, command, further arguments) of a call; the command of a mechanism is built now."""
        name, command, rest = super().resolve_command(ctx, args)
        return name, (build_command(name) if name and getattr(command, PLACEHOLDER, False) else command), rest


def _placeholder(name: str) -> Any:
    command = _click_command(name, lambda: None, f"Brought by {registry.commands()[name]}; see drivewright {name} --help.")
    setattr(command, PLACEHOLDER, True)
    return command


def build_command(name: str) -> Any:
    """The command-line command of a registered `Command`: its argument, an option for each further key, and those of a run folder."""
    command = registry.command(name)
    fields = {key: field for key, field in command.evaluation.spec.model_fields.items() if key not in SHARED_KEYS}

    def call(out, figures, as_json, strict, **texts):
        _run_command(command, {key: text for key, text in texts.items() if text is not None}, out, figures, as_json, strict)

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
    folder_options = [
        inspect.Parameter(key, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=kind)
        for key, kind, default in RUN_FOLDER_OPTIONS
    ]
    signature = inspect.Signature([first, *options, *folder_options])
    vars(call)["__signature__"] = signature  # what the library reads: an option per key of the spec
    call.__annotations__ = {parameter.name: parameter.annotation for parameter in signature.parameters.values()}
    return _click_command(name, call, command.summary)


def _option(key: str, field: "FieldInfo") -> Any:
    """A key of a spec as an option that takes text; the example says how it is written."""
    default = "" if field.is_required() or field.default in (None, "") else f"; default {field.default}"
    example = f", e.g. {field.examples[0]}" if field.examples else ""
    return Annotated[str | None, typer.Option(_flag(key), help=f"{field.description}{example}{default}", show_default=False)]


def _flag(key: str) -> str:
    return f"--{key.replace('_', '-')}"


def _click_command(name: str, function: Callable[..., object], summary: str) -> Any:
    own = typer.Typer(add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)
    own.command(name, help=summary)(function)
    return typer.main.get_command(own)


def _run_command(command: Command, texts: Mapping[str, str], out: Path | None, figures: bool, as_json: bool, strict: bool) -> None:
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
        views = Views(plots=tuple(plots(result)) if callable(plots) else plots)
        folder = write_run_folder(result, Path("out") / path.stem if out is None else out, figures, views)
    show.note(f"wrote {folder}/")
    if not as_json:
        show.result(result)
    show.finish_run([result], as_json=as_json, strict=strict)


@contextmanager
def _options_named(command: Command, texts: Mapping[str, str]) -> Iterator[None]:
    """A complaint about a key of the spec names the option that the user wrote."""
    try:
        yield
    except SpecError as error:
        first = (error.key or "").split(".")[0]
        if first not in texts or error.file is not None:
            raise
        raise error.located(key="" if first == command.argument else _flag(first)) from None


def _value(model: type[Any], key: str, text: str) -> Any:
    """Numbers and switches are read as TOML; names, paths and quantities stand as they are."""
    from drivewright.spec import read_value
    from drivewright.spec.fields import dimension_of, type_of

    field = model.model_fields[key]
    return read_value(text) if dimension_of(field) is None and type_of(field.annotation) in (int, float, bool) else text
