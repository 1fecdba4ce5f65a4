"""Every change of a document, made in a worker process: what a page sends is read, parsed and checked there, never in the server's loop.

All functions are calls of a worker, `name(send, ...)`.  What is wrong with a message comes back as InputError or SpecError.
"""

import json
import math
import pickle
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any, NamedTuple

from drivewright.errors import DrivewrightError, InputError, brief
from drivewright.report.worked_examples import examples
from drivewright.spec import load
from drivewright.studio import translations
from drivewright.studio.design import Design
from drivewright.studio.document import Document
from drivewright.studio.form import Form, changed_fields, form
from drivewright.studio.opening import packed, preset, unpacked

MOST_PARTS, DEEPEST = 5_000, 12  # values in a message of a page, and how deep they may lie
LARGEST_INTEGER = 2**53
TALLEST = 3_000  # fields of a form: 1.4 MB, which the loop hands on in 30 ms
ODD = (TypeError, ValueError, AttributeError, ArithmeticError, LookupError, RecursionError)


class Edited(NamedTuple):
    """A document after a change, and its form: `fields` are those that differ, None where the whole `form` is another.

    `kept` is for the next change: what the sliders of the form had, which the server need not unpack.
    """

    document: Document
    kept: bytes
    form: Form | None
    fields: dict[str, Any] | None


def read_message(send: object, text: str) -> dict[str, Any]:
    """The message {what, ...} that a text in JSON is; InputError in one line where it is none."""
    try:
        message = json.loads(text)
    except (ValueError, RecursionError):
        raise InputError("the page sent something that is not JSON") from None
    if not isinstance(message, dict):
        raise InputError("the page sent JSON that is no message")
    return checked_message(message)


def checked_message(message: object) -> dict[str, Any]:
    """The message, where it is a dictionary of plain values that are not too many; InputError otherwise."""
    waiting: list[tuple[Any, int]] = [(message, 0)]
    parts = 0
    while waiting:
        value, depth = waiting.pop()
        _check_value(value)
        inside = [*value.keys(), *value.values()] if isinstance(value, dict) else value if isinstance(value, list) else ()
        parts += len(inside)
        if parts > MOST_PARTS or inside and depth == DEEPEST:
            raise InputError(f"the page sent more than {MOST_PARTS} values at once, or deeper than {DEEPEST} levels")
        waiting += [(part, depth + 1) for part in inside]
    return {str(name): value for name, value in message.items()} if isinstance(message, dict) else {}


def _check_value(value):
    """InputError for what is no value of a message: text that cannot be written, numbers that no computation could take."""
    if isinstance(value, str) and not value.isascii():
        try:
            value.encode()
        except UnicodeEncodeError:
            raise InputError("the page sent text that is not Unicode (half of a surrogate pair)") from None
    if isinstance(value, float) and not math.isfinite(value) or isinstance(value, int) and abs(value) > LARGEST_INTEGER:
        raise InputError("the page sent a number that is too large")


@contextmanager
def in_words() -> Iterator[None]:
    """What is wrong with a message, in one line."""
    try:
        yield
    except DrivewrightError:
        raise
    except ODD as error:
        raise InputError(f"the page sent an unexpected request: {brief(str(error))}") from None


def edit(send: object, document: Document, kept: bytes, change: str, arguments: Mapping[str, Any]) -> Edited:
    """The document after a change, a method of it by its name; "" changes nothing."""
    if change:
        with in_words():
            getattr(document, change)(**arguments)
    return _edited(document, kept, text=not under_way(change, arguments))


def under_way(change: str, arguments: Mapping[str, Any]) -> bool:
    """Whether a change is a step of a gesture that goes on, such as a drag: nobody reads the text of the spec meanwhile."""
    return change in ("set", "drag") and bool(arguments.get("gesture"))


def begin(send: object, place: Design, name: str = "", text: str = "", shared: str = "") -> Edited:
    """A document of a design; or of a text, or of the end of an address, in its place."""
    with in_words():
        if text or shared:
            place = place.with_text(unpacked(shared) if shared else text)
        place.spec()
        return _edited(Document(place, name), b"")


def begin_preset(send: object, kind: str, name: str | None) -> Edited:
    """A document of a preset."""
    return _edited(Document(preset_design(send, kind, name)), b"")


def preset_design(send: object, kind: str, name: str | None) -> Design:
    """The design of a preset."""
    with in_words():
        return preset(kind, name)


def example_files(send: object, name: str) -> list[dict[str, str]]:
    """A worked example and its data files as a page would send them: [{name, text}]; InputError where no example has that name."""
    path = examples().get(name)
    if path is None:
        raise InputError(f"there is no example {brief(name)}")
    return [{"name": file.name, "text": file.read_text(encoding="utf-8")} for file in (path, *load(path).data_files())]


def fragment(send: object, design: Design) -> str:
    """The design as the end of an address."""
    if design.spec().data_files():
        raise InputError("a design with data files does not fit into an address; save it and send the file")
    return packed(design.text())


def _edited(document, kept, text=True):
    if text:
        document.design.text()  # made here, where it does not hold up the loop
    design, (kind, before) = document.design, _form_before(kept)
    before = before if kind == design.kind else None
    made = form(design, translations.fields(design.kind) | translations.tables(design.kind), before)
    if sum(len(group["fields"]) for group in made["groups"]) > TALLEST:
        raise InputError(f"a form of more than {TALLEST:,} fields is too much for a page; run this design on the command line")
    fields = changed_fields(before, made) if before else None
    return Edited(document, _kept(design.kind, made), made if fields is None else None, fields)


_newest: dict[bytes, tuple[str, Form | None]] = {}  # the form that this process has made last, which the next change mostly begins with


def _kept(kind, made):
    """What the server keeps of a form for the next change."""
    kept = pickle.dumps((kind, made))
    _newest.clear()
    _newest[kept] = kind, made
    return kept


def _form_before(kept):
    """(kind, form) of what the server has kept; ("", None) where it has nothing."""
    return _newest.get(kept) or (pickle.loads(kept) if kept else ("", None))
