"""From TOML files and "key=value" texts to raw tables, and from raw tables to a spec."""

import re
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, overload

from drivewright import registry
from drivewright.errors import SpecError, UnknownName, brief, nearest
from drivewright.spec.base import Spec, SpecT, validate_tables
from drivewright.spec.document_limits import MAX_CHARACTERS, refuse_oversized
from drivewright.spec.keys import remove_key, set_key
from drivewright.spec.mechanism_spec import MechanismSpec


def load(path: str | Path, changes: Iterable[str] = ()) -> Any:
    """Spec of a TOML file, `changes` being "key=value" texts as on the command line."""
    tables = read_document(path)
    try:
        for change in changes:
            change_key(tables, change)
        return from_document(tables, folder=Path(path).resolve().parent)
    except SpecError as error:
        raise error.located(file=str(path)) from None


@overload
def from_document(tables: Mapping[str, Any], model: None = None, folder: str | Path = ".") -> MechanismSpec: ...
@overload
def from_document(tables: Mapping[str, Any], model: type[SpecT], folder: str | Path = ".") -> SpecT: ...
def from_document(tables: Mapping[str, Any], model: type[Spec] | None = None, folder: str | Path = ".") -> Spec:
    """Spec from raw tables; the kind comes from `mechanism` unless `model` is given.  Paths are relative to `folder`."""
    return validate_tables(model or _model_of(tables), tables, folder)


def read_document(path: str | Path) -> dict[str, Any]:
    """The raw tables of a TOML spec file; SpecError where it is missing or is not TOML."""
    try:
        return parse_document(read_text(path))
    except SpecError as error:
        raise error.located(file=str(path)) from None


def parse_document(text: str) -> dict[str, Any]:
    """The raw tables of a spec's text; SpecError where it is not TOML, or more than a spec may hold."""
    refuse_oversized(text)
    text += "\n"  # so that tomllib knows the line of a mistake at the very end
    try:
        return tomllib.loads(text)
    except ValueError as error:  # TOMLDecodeError, and integers of more than 4300 digits
        raise SpecError(f"is not valid TOML: {_explained(str(error), text)}") from None


def _explained(complaint: str, text: str) -> str:
    """The complaint of tomllib in plain words, with its line and a remedy for the commonest mistake."""
    if complaint.startswith("Exceeds the limit"):
        return "a number has more than 4300 digits"
    complaint = complaint.replace("Cannot overwrite a value", "the key is there twice")
    place = re.search(r"at line (\d+)", complaint)
    line = text.splitlines()[int(place[1]) - 1].strip() if place and int(place[1]) <= len(text.splitlines()) else ""
    bare = re.fullmatch(r"([\w.-]+\s*=)\s*([+-]?[\d.]+(?:[eE][+-]?\d+)?\s*[A-Za-z\u00b0\u00b5].*)", line)
    remedy = f'; a quantity is text in quotes: {bare[1]} "{bare[2]}"' if bare else ""
    return f"{complaint}{f': {line:.80}' if line.isprintable() and line else ''}{remedy}"


def read_text(path: str | Path) -> str:
    """The text of a spec file; SpecError where it cannot be read."""
    path = Path(path)
    try:
        _refuse_named_pipe(path)
        with path.open(encoding="utf-8-sig") as stream:  # Windows editors put a byte-order mark in front
            return stream.read(MAX_CHARACTERS + 1)
    except FileNotFoundError:
        kinds = ", ".join(registry.kinds())
        hint = f"`drivewright examples` lists worked ones to copy, `drivewright new KIND {path.name}` writes a spec (kinds: {kinds})"
        raise SpecError(f"there is no such file; {hint}", file=str(path)) from None
    except IsADirectoryError:
        raise SpecError("is a folder; a spec is a TOML file", file=str(path)) from None
    except UnicodeDecodeError as error:
        byte = f"byte {error.start} is {error.object[error.start]:#04x}"
        raise SpecError(f"is not text in UTF-8 ({byte}); save it as UTF-8", file=str(path)) from None
    except SpecError:
        raise
    except (OSError, ValueError) as error:
        raise SpecError(f"cannot be read: {getattr(error, 'strerror', None) or error}", file=str(path)) from None


def _refuse_named_pipe(path: Path) -> None:
    """It may wait for ever for somebody who writes; the pipe of `<(command)`, which has no place of its own, has somebody."""
    if path.is_fifo() and path.resolve().exists():
        raise SpecError("is a named pipe; a spec is a TOML file", file=str(path))


def _model_of(tables: Mapping[str, Any]) -> type[MechanismSpec]:
    kind = tables.get("mechanism")
    if not isinstance(kind, str):
        complaint = f"is missing{nearest('mechanism', tables)}" if kind is None else f"must be a text, got {brief(kind)}"
        raise SpecError(f"{complaint}; one of {', '.join(registry.kinds())}", key="mechanism")
    try:
        return registry.mechanism(kind).spec
    except UnknownName as error:
        raise SpecError(str(error), key="mechanism") from None


# -- changing keys -------------------------------------------------------------------------------------------------------------


def change_key(tables: dict[str, Any], change: str) -> dict[str, Any]:
    """Apply "dotted.key=value" as from the command line to raw tables.  The value is TOML, or else text; none at all removes the key."""
    key, equals, text = change.partition("=")
    if not equals or not all(step.strip() for step in key.split(".")):
        raise SpecError(f"--set takes key=value with a dotted key, got {brief(change)}")
    key = ".".join(step.strip() for step in key.split("."))
    return set_key(tables, key, read_value(text)) if text.strip() else remove_key(tables, key)


def read_value(text: str) -> Any:
    """A `--set` value: TOML where it parses, text otherwise, and where it is more than a spec may hold."""
    table = f"value = {text}"
    try:
        refuse_oversized(table)
        tables = tomllib.loads(table)
    except ValueError:  # of TOML, or a SpecError
        return text.strip()
    return tables["value"] if list(tables) == ["value"] else text.strip()
