"""Validation errors of pydantic as `SpecError`: the dotted key, the value, what would be right."""

from collections.abc import Sequence
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from drivewright.errors import MissingFile, SpecError, brief, nearest
from drivewright.spec.fields import choices_of, containers_of, dimension_of, field_at, table_at
from drivewright.spec.serialisation import toml_key, toml_value

COMPARISON_WORDS = {
    "greater_than": ("gt", "greater than"),
    "greater_than_equal": ("ge", "at least"),
    "less_than": ("lt", "less than"),
    "less_than_equal": ("le", "at most"),
}
EXPECTED_TYPES = {
    "string_type": "a text in quotes",
    "float_type": "a number",
    "int_type": "a whole number",
    "bool_type": "true or false",
    "tuple_type": "a list [...]",
    "finite_number": "a finite number",
    "model_type": "a table",
    "model_attributes_type": "a table",
    "dict_type": "a table",
    "string_unicode": "a text of valid characters",
}
MAX_COMPLAINTS = 6  # complaints in one message


def spec_error_of(error: ValidationError, model: type[Any]) -> SpecError:
    """One SpecError naming the first wrong key; the others follow in the message."""
    # Unknown keys first: a misspelt one explains a missing one.
    details = sorted(_own_faults(error.errors(include_url=False)), key=lambda item: item["type"] != "extra_forbidden")
    items = [_complaint(item, model) for item in details[:MAX_COMPLAINTS]]
    short = [(key, message.partition("; known here")[0]) for key, message in items[1:]]
    rest = "".join(f"\n  {key}: {message}" if key else f"\n  {message}" for key, message in short)
    more = f"\n  ... and {len(details) - MAX_COMPLAINTS} more" if len(details) > MAX_COMPLAINTS else ""
    missing = any(isinstance(item.get("ctx", {}).get("error"), MissingFile) for item in details)
    return (MissingFile if missing else SpecError)(items[0][1] + rest + more, key=items[0][0] or None)


def _own_faults(items: Sequence[ErrorDetails]) -> list[ErrorDetails]:
    """The errors without those of lists that are too short only because their entries are wrong: pydantic counts the good ones."""
    places = [item["loc"] for item in items]

    def has_wrong_entry(own):
        return any(len(place) > len(own) and place[: len(own)] == own for place in places)

    return [item for item in items if item["type"] != "too_short" or not has_wrong_entry(item["loc"])]


def number_text(value: Any, field: Any) -> str:
    """A number of a field as people read it, with its unit."""
    dimension = dimension_of(field)
    return dimension.text(float(value)) if dimension else f"{value:g}" if isinstance(value, float) else brief(value)


def _complaint(item: ErrorDetails, model: type[Any]) -> tuple[str, str]:
    """(dotted key, message) of one pydantic error."""
    place = _key_path(item, model)
    field, kind = field_at(model, place), item["type"]
    key, own = [toml_key(step[:60]) for step in place], item.get("ctx", {}).get("error")
    if isinstance(own, SpecError) and own.key:  # a rule between several keys, which knows whose fault it is
        return ".".join([*key, own.key]), own.message
    return ".".join(key), SPECIAL.get(kind, _wrong_type)(item, field, model, place)


def _key_path(item: ErrorDetails, model: type[Any]) -> list[str]:
    """The path of keys and indices, as text, without the names pydantic puts in for the members of a union."""
    place, open_levels = [], []
    for number, step in enumerate(item["loc"]):
        unknown = item["type"] == "extra_forbidden" and number == len(item["loc"]) - 1
        if isinstance(step, int):
            place.append(str(step))
            del open_levels[:1]
        elif open_levels[:1] == [dict]:
            place.append(step)
            del open_levels[:1]
        elif unknown:
            place.append(step)
            open_levels = []
        elif not open_levels and (table := table_at(model, place)) is not None and step in table.model_fields:
            place.append(step)
            open_levels = list(containers_of(table.model_fields[step].annotation))
    return place


def _unknown_key(item, field, model, place):
    table = table_at(model, place[:-1])
    known = list(table.model_fields) if table else []
    return f"unknown key{nearest(place[-1], known)}; known here: {', '.join(known)}"


def _missing_key(item, field, model, place):
    if field is None:
        return "is missing"
    example = f"; e.g. {toml_value(field.examples[0])}" if field.examples else ""
    return f"is missing{f' ({field.description})' if field.description else ''}{example}"


def _out_of_range(item, field, model, place):
    name, words = COMPARISON_WORDS[item["type"]]
    given = brief(item["input"]) if isinstance(item["input"], str) else number_text(item["input"], field)
    return f"must be {words} {number_text(item['ctx'][name], field)}, got {given}"


def _not_a_choice(item, field, model, place):
    choices = choices_of(field.annotation) if field else ()
    if not choices:
        return _wrong_type(item, field, model, place)
    return f"must be one of {', '.join(map(toml_value, choices))}, got {brief(item['input'])}{nearest(item['input'], map(str, choices))}"


def _wrong_length(item, field, model, place):
    limit = item["ctx"].get("min_length", item["ctx"].get("max_length"))
    what = "characters" if item["type"].startswith("string") else "entries"
    given = item["ctx"].get("actual_length", len(item["input"]))
    return f"must have {'at least' if item['type'].endswith('short') else 'at most'} {limit} {what}, got {given}"


def _own_message(item, field, model, place):
    return str(item["ctx"]["error"])


def _wrong_type(item, field, model, place):
    expected = EXPECTED_TYPES.get(item["type"])
    message = f"must be {expected}" if expected else f"{item['msg'][:1].lower()}{item['msg'][1:]}"
    return f"{message}, got {'a table' if isinstance(item['input'], dict) else brief(item['input'])}"


SPECIAL = {
    "extra_forbidden": _unknown_key,
    "missing": _missing_key,
    "literal_error": _not_a_choice,
    "value_error": _own_message,
    "too_short": _wrong_length,
    "too_long": _wrong_length,
    "string_too_short": _wrong_length,
    "string_too_long": _wrong_length,
    **dict.fromkeys(COMPARISON_WORDS, _out_of_range),
}
