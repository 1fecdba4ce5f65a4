"""What the forms of a search and of a study propose, and the tables that they write."""

from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from fnmatch import fnmatchcase
from typing import Any

from drivewright import registry
from drivewright.errors import InputError, SpecError, brief
from drivewright.execution.keys import FIXED, key_kind
from drivewright.spec import MechanismSpec, read_value
from drivewright.studio.design import Design, Tables
from drivewright.studio.field_info import display_text, field_info_at, has_no_unit, parse_text
from drivewright.studio.form import form
from drivewright.studio.input_parsing import form_key, spec_class, value_in
from drivewright.studio.jobs.design_keys import is_locked, label

# What each form writes; everything else in its table stays: the seed, settings, a file of points.
TABLES = {
    "optimise": ("unknowns", "objectives", "requirements", "method", "population", "generations"),
    "study": ("vary", "method", "samples", "values"),
}
LISTS = ("unknowns", "objectives", "requirements", "vary", "values")
ENTRIES = {  # keys that an entry of a list may have
    "unknowns": ("key", "lower", "upper"),
    "objectives": ("value", "goal"),
    "requirements": ("value", "at_least", "at_most"),
    "vary": ("key", "values", "lower", "upper", "steps", "distribution", "tolerance", "as_written"),
}
IN_UNITS = ("lower", "upper", "tolerance", "values")  # of an entry with a key: in the unit of that key
WHOLE = ("population", "generations", "samples", "steps")
MOST, LONGEST = 1000, 500  # entries of a list, characters of a text in one
VARIED = {"quantity", "number", "integer", "choice", "flag"}  # kinds of fields that may vary


# -- what is proposed ----------------------------------------------------------------------------------------------------------


def propose(send: object, design: Design, locks: Sequence[str]) -> dict[str, Any]:
    """{"keys": [{"key", "label", "kind", "text", "lower", "upper", "unit", "choices", "usual", "locked"}], "optimise", "study": tables}.

    Every number, choice and flag of the design that may vary.  lower and upper are the ends of its slider; `usual` are the dimensions
    that its kind calls adjustable, which come first.
    """
    spec = design.spec_on_screen()
    keys = [_proposed(design, field, spec, locks) for field in _fields(design) if _may_vary(spec, field)]
    return {"keys": sorted(keys, key=lambda each: not each["usual"]), **{name: _table(design, name) for name in TABLES}}


def _fields(design: Design) -> Iterator[dict[str, Any]]:
    for group in form(design)["groups"]:
        if not group["path"] or group["path"][0] not in FIXED:
            for field in group["fields"]:
                yield from field.get("parts") or [field]


def _may_vary(spec: MechanismSpec, field: Mapping[str, Any]) -> bool:
    if field["kind"] not in VARIED or field["value"] is None:
        return False
    if field["kind"] not in ("choice", "flag") and not isinstance(field["value"], (int, float)):  # "rigid" instead of a number
        return False
    try:
        key_kind(spec, field["key"])
    except SpecError:  # a file, a list that is one value, or what a study cannot vary
        return False
    return True


def _proposed(design: Design, field: Mapping[str, Any], spec: MechanismSpec, locks: Sequence[str]) -> dict[str, Any]:
    lower, upper = _ends(field)
    adjustable = registry.mechanism(spec.mechanism).adjustable
    return {
        "key": field["key"],
        "label": label(design.tables, field["key"]),
        "kind": field["kind"],
        "text": field["text"],
        "lower": lower,
        "upper": upper,
        "unit": field["unit"],
        "choices": ["true", "false"] if field["kind"] == "flag" else [str(choice) for choice in field["choices"]],
        "usual": any(fnmatchcase(field["key"], pattern) for pattern in adjustable),
        "locked": is_locked(design.tables, field["key"], locks),
    }


def _ends(field: Mapping[str, Any]) -> tuple[str, str]:
    """The ends of the slider of a field as text; half and twice the value where it has none."""
    value = field["value"]
    if field["kind"] in ("choice", "flag") or not isinstance(value, (int, float)):
        return "", ""
    low, high = field["slider"] or sorted((value / 2, value * 2))
    return tuple(f"{end:.10g} {field['unit']}".strip() for end in (low, high))  # type: ignore[return-value]


def _table(design: Design, name: str) -> Tables | None:
    """A table as it is written, keys as the form names them; None where there is none."""
    table = deepcopy(design.tables.get(name))
    if not isinstance(table, dict):
        return None
    for entry in [*table.get("unknowns", []), *table.get("vary", [])]:
        entry["key"] = form_key(design.tables, entry["key"])
    return table


# -- what is written -----------------------------------------------------------------------------------------------------------


def search_table(design: Design, name: str, content: Mapping[str, Any]) -> Tables:
    """The raw table "optimise" or "study" that a page's form says, with what that form does not show as it was.

    InputError for what no form sends; whether keys, values and bounds are fit for each other is for the spec to say.
    """
    if other := sorted(set(content) - set(TABLES[name])):
        raise InputError(f"a form of {name} has no {brief(other[0])}")
    written = design.tables.get(name)
    table: Tables = deepcopy(written) if isinstance(written, dict) else {}
    for part, given in content.items():
        table[part] = _part(design, table, name, part, given)
    return {part: value for part, value in table.items() if value not in (None, [], "")}


def varied_keys(tables: Tables, name: str) -> list[str]:
    """The keys, lists by number, that the table "optimise" or "study" of raw tables varies."""
    entries = tables[name].get({"optimise": "unknowns", "study": "vary"}[name], [])
    return [form_key(tables, str(entry["key"])) for entry in entries if isinstance(entry, dict) and "key" in entry]


def _part(design: Design, table: Tables, name: str, part: str, given: Any) -> Any:
    if part in WHOLE:
        return None if given is None else _whole(given, f"{name}.{part}")
    if part not in LISTS:
        return str(given)
    if not isinstance(given, list) or len(given) > MOST:
        raise InputError(f"{name}.{part} must be a list of at most {MOST} entries")
    if part == "values":
        return [str(each) for each in given]
    return [_entry(design, table, f"{name}.{part}.{number}", part, each) for number, each in enumerate(given)]


def _entry(design: Design, table: Tables, place: str, part: str, given: Any) -> Tables:
    if not isinstance(given, dict) or (set(given) - set(ENTRIES[part])):
        raise InputError(f"{place} has a form that no page sends")
    if any(len(value) > LONGEST for value in given.values() if isinstance(value, str)):
        raise InputError(f"{place} has a text of more than {LONGEST} characters")
    if given.get("as_written"):
        return _as_written(design, table, str(given.get("key", "")), place)
    entry = {name: value for name, value in given.items() if value not in (None, "", [])}
    for name, value in entry.items():
        entry[name] = _value(design, str(given.get("key", "")), name, value, f"{place}.{name}")
    return entry


def _as_written(design: Design, table: Tables, key: str, place: str) -> Tables:
    """The entry of a key that the table has."""
    for entry in table.get("vary", []):
        if form_key(design.tables, str(entry.get("key"))) == key:
            return dict(entry)
    raise InputError(f"{place}: {brief(key)} is not in the table of this design")


def _value(design: Design, key: str, name: str, value: Any, place: str) -> Any:
    if name == "steps":
        return _whole(value, place)
    if name in IN_UNITS:
        return [_in_unit(design, key, str(each)) for each in value] if isinstance(value, list) else _in_unit(design, key, str(value))
    text = str(value)
    return read_value(text) if name.startswith("at_") and has_no_unit(text) else text


def _in_unit(design: Design, key: str, text: str) -> Any:
    """A value of a key as it was typed: a bare number has the unit that the key has now."""
    info = field_info_at(spec_class(design), key.split(".")) if key else None
    if info is None or text.strip().endswith("%"):
        return text
    return parse_text(info, text, display_text(info, value_in(design.tables, key)))


def _whole(value: Any, place: str) -> int:
    """A whole number that a page sends, also as text."""
    try:
        return int(str(value))
    except ValueError:
        raise SpecError(f"wants a whole number, got {brief(value)}", place) from None
