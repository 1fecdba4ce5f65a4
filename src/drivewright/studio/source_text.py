"""The text of a spec as its author wrote it, with the differences of the tables entered: comments, order and spacing stay.

The text is taken apart by tomlkit and changed only where the tables differ.  What comes out is parsed again; where it does not say exactly
what the tables say, the plain text of the tables takes its place, so that no value is ever lost for a comment.
"""

from collections.abc import Mapping, Sequence
from difflib import SequenceMatcher
from typing import Any

import tomlkit
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT, Array, Comment, InlineTable, Table

from drivewright.errors import SpecError
from drivewright.spec.parsing import parse_document
from drivewright.spec.serialisation import toml_text

ODD = (TOMLKitError, KeyError, IndexError, TypeError, ValueError, AttributeError, RecursionError)


def source_text(source: str, tables: Mapping[str, Any]) -> str:
    """`source` with the values of `tables`; without a source, or where tomlkit cannot do it, the plain text of the tables."""
    if not source:
        return toml_text(tables)
    try:
        before = parse_document(source)
        if before == tables and toml_text(before) == toml_text(tables):  # 1 equals true
            return source
        document = tomlkit.parse(source)
        _enter(document, before, tables)
        text = document.as_string()
        return text if parse_document(text) == tables else toml_text(tables)
    except (SpecError, *ODD):
        return toml_text(tables)


def _enter(place: Any, before: Mapping[str, Any], after: Mapping[str, Any]) -> None:
    """The differences of two tables, entered into a table of tomlkit in place."""
    for key in [key for key in before if key not in after]:
        _remove_comment_above(place, key)
        place.remove(key)
    for key, value in after.items():
        if key not in before:
            _add(place, key, value)
        elif (before[key] != value or type(before[key]) is not type(value)) and not _entered(place[key], before[key], value):
            place[key] = value


def _entered(place: Any, before: Any, after: Any) -> bool:
    """Whether a table or list could be changed in place, element by element."""
    if isinstance(before, dict) and isinstance(after, dict):
        _enter(place, before, after)
        return True
    if isinstance(before, list) and isinstance(after, list) and before and after:
        same_sort = all(isinstance(each, dict) for each in after) if isinstance(place, AoT) else isinstance(place, Array)
        if same_sort:
            _enter_list(place, before, after)
        return same_sort
    return False


def _enter_list(place: Any, before: Sequence[Any], after: Sequence[Any]) -> None:
    """The differences of two lists; an element with a name is followed by it, another one by its value or its number."""
    moved = SequenceMatcher(None, _labels(before), _labels(after), autojunk=False).get_opcodes()
    for what, start, end, to, to_end in reversed(moved):  # from the end, so that the numbers before stay
        both = min(end - start, to_end - to) if what in ("replace", "equal") else 0
        for number in range(end - 1, start + both - 1, -1):
            del place[number]
        for number in range(to + both, to_end):
            place.insert(start + number - to, _element(place, after[number]))
        for number in range(both):
            old, new = before[start + number], after[to + number]
            if old != new and not _entered(place[start + number], old, new):
                place[start + number] = new


def _labels(elements: Sequence[Any]) -> list[str]:
    names = [each.get("name") if isinstance(each, dict) else None for each in elements]
    return [f"name {name}" if isinstance(name, str) else repr(each) for name, each in zip(names, elements, strict=True)]


def _element(place: Any, value: Any) -> Any:
    return _table(value) if isinstance(place, AoT) else value


def _table(value: Mapping[str, Any]) -> Table:
    table = tomlkit.table()
    for key, inner in value.items():
        table.add(key, tomlkit.item(_plain(inner)))
    table.add(tomlkit.nl())
    return table


def _plain(value: Any) -> Any:
    """Small tables inside of a new table stand on one line, as authors write the points of a body."""
    if isinstance(value, dict) and value and not any(isinstance(inner, dict) for inner in value.values()):
        inline = tomlkit.inline_table()
        inline.update(value)
        return inline
    return value


def _add(place: Any, key: str, value: Any) -> None:
    if isinstance(place, InlineTable) or not isinstance(value, dict):
        place[key] = value
    else:
        place[key] = _table(value)


def _remove_comment_above(place: Any, key: str) -> None:
    """The comment lines directly above a key that goes, where they are its own: after a blank line or another key."""
    body = getattr(getattr(place, "value", place), "body", None) or getattr(place, "body", None)
    if not isinstance(body, list):
        return
    at = next((n for n, (own, _) in enumerate(body) if own is not None and own.key == key), None)
    while at and isinstance(body[at - 1][1], Comment):
        body[at - 1] = (None, tomlkit.ws(""))
        at -= 1
