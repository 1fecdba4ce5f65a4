"""What a spec can hold, read off its fields: the commented template and the JSON schema."""

import textwrap
from collections.abc import Mapping
from pathlib import Path
from typing import Any, get_args, get_origin

from pydantic.fields import FieldInfo
from pydantic.json_schema import GenerateJsonSchema

from drivewright import registry
from drivewright.errors import UnknownName
from drivewright.registry import Mechanism
from drivewright.spec.fields import AnyUnit, choices_of, dimension_of, field_at, has_names, levels, list_depth, mark_of, table_of, type_of
from drivewright.spec.messages import shown
from drivewright.spec.model import MechanismSpec
from drivewright.spec.reading import read_document
from drivewright.spec.writing import raw, toml_key, toml_value
from drivewright.units import split

WIDTH, WIDEST_KEY = 118, 44  # of a line; of the part before the comment, where comments still stand in one column
ANY_UNIT = "number or quantity"
SOME_NAME = "a"  # of a sample table
KINDS = {bool: "true or false", int: "whole number", float: "number", str: "text", Path: "file"}
SAMPLES = {bool: False, int: 1, float: 1.0, str: "...", Path: "data.csv"}


def template(kind: str, preset: str | None = None) -> str:
    """Commented spec text of a kind: every key with its meaning, unit, default and limits; values from a preset."""
    mechanism, path = registry.mechanism(kind), preset_path(kind, preset)
    given = read_document(path) if path else {"mechanism": kind, **skeleton(mechanism.spec)}
    source = f' (preset "{path.stem}")' if path else ""
    intro = [
        f"# {mechanism.summary[:1].upper()}{mechanism.summary[1:]}{source}.",
        "#",
        '# Every key is here.  "#key = value" is left at its default, or out: take the # away to change it.',
        '# A quantity is text with a unit, e.g. "9.5 mm", "2000 rpm", "3e7 N/m".  [...] says what is allowed,',
        '# and "default" where the value shown is the one taken when the key is left out.',
        "",
    ]
    return "\n".join(intro + _lines(mechanism.spec, given, samples=shared_samples(mechanism, given))) + "\n"


def preset_path(kind: str, preset: str | None = None) -> Path | None:
    """Spec file of a preset by name: "default" or else the first unless named; None where the kind brings none."""
    presets = registry.mechanism(kind).presets()
    name = preset or ("default" if "default" in presets else next(iter(presets), None))
    if name not in presets and (preset or presets):
        raise UnknownName(f"preset of {kind}", name, presets)
    return presets.get(name) if name else None


def schema(kind: str) -> dict[str, Any]:
    """JSON schema of a kind's spec files, for editors and forms."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **registry.mechanism(kind).spec.model_json_schema(schema_generator=_Schema),
        "title": f"Drivewright {kind}",
    }


class _Schema(GenerateJsonSchema):
    """Defaults as they stand in a file: quantities as text, not in SI."""

    def encode_default(self, dft: Any) -> Any:
        return raw(dft)


# -- lines of the template -----------------------------------------------------------------------------------------------------


def _lines(model, given, path="", off=False, samples=None):
    """Lines of one table: its values, then its sub-tables, those that all kinds share last; `off` puts a # before each line."""
    fields = model.model_fields.items()
    lines = _in_columns([_key(name, field, given, off) for name, field in fields if not table_of(field.annotation)])
    for name, field in sorted(fields, key=lambda item: item[0] in MechanismSpec.model_fields):
        if table_of(field.annotation):
            lines += _table(f"{path}{name}", field, given.get(name), off, (samples or {}).get(name))
    return lines


def _table(path, field, given, off, sample):
    """Lines of a sub-table or of a list of them, switched off where it is optional and not given."""
    inner: Any = table_of(field.annotation)
    off = off or (not given and not field.is_required() and not field.default)
    first, *others = _tables(path, field, given or ({} if not off else sample or skeleton(inner)))
    place, heading, table = first
    explained = ["", f"{'#' if off else ''}{heading}  # {field.description or inner.__doc__}", *_lines(inner, table, f"{place}.", off)]
    return explained + [line for other in others for line in _again(inner, *other, off)]


def _tables(path, field, given):
    """(path, heading, keys) of each table that a field holds."""
    if has_names(field.annotation):
        tables = given if given and all(isinstance(table, dict) for table in given.values()) else {SOME_NAME: given}
        return [(f"{path}.{toml_key(name)}", f"[{path}.{toml_key(name)}]", table) for name, table in tables.items()]
    if list_depth(field.annotation):
        return [(path, f"[[{path}]]", table) for table in (given if isinstance(given, list) else [given])]
    return [(path, f"[{path}]", given)]


def _again(inner, place, heading, table, off):
    """A further table of several: the keys given, which the first one has explained; in full where it holds tables itself."""
    if any(name in table and table_of(field.annotation) for name, field in inner.model_fields.items()):
        return ["", heading, *_lines(inner, table, f"{place}.", off)]
    return ["", heading, *(f"{key} = {toml_value(value)}" for key, value in table.items())]


def _key(name, field, given, off):
    """(code, comment) of a key: as given, else at its default and switched off."""
    default = raw(field.default, dimension_of(field)) if not field.is_required() and field.default is not None else None
    value = given.get(name, sample_of(field) if default is None else default)
    switched = "#" if off or name not in given else ""
    return f"{switched}{name} = {toml_value(value)}", f"{field.description or ''}  [{_allowed(field, default, value)}]"


def _allowed(field, default, value):
    """Limits, kind of quantity and default in words."""
    words = [_limits(field)]
    if not field.is_required() and (default is None or default != value):
        words.append("no default" if default is None else f"default {toml_value(default)}")
    elif default is not None and len(choices_of(field.annotation)) != 1:
        words.append("default")
    return "; ".join(words)


def _limits(field):
    """What is allowed: "0 < angle <= 180 deg", '"a" or "b"', "length"."""
    choices, dimension = choices_of(field.annotation), dimension_of(field)
    if choices:
        return " or ".join(map(toml_value, choices))
    what = dimension.name if dimension else ANY_UNIT if mark_of(field, AnyUnit) else KINDS.get(type_of(field.annotation), "value")
    low, high = _limit(field, gt="<", ge="<="), _limit(field, lt="<", le="<=")
    if low and high and low[1] == high[1]:
        bounded = low[1]
    elif low and not high:
        bounded = f"{what} {low[0].replace('<', '>')} {low[1]}"
    else:
        bounded = (f"{low[1]} {low[0]} " if low else "") + what + (f" {high[0]} {high[1]}" if high else "")
    length, depth = _length(field.annotation), list_depth(field.annotation)
    listed = f"list of {length} x {bounded}" if length and depth == 1 else "list of " * depth + bounded
    return f"table of {listed}" if has_names(field.annotation) else listed


def _limit(field, **signs):
    """(sign, limit with unit) of the first of some constraints that a field has, else None."""
    found = ((sign, getattr(mark, side, None)) for mark in field.metadata for side, sign in signs.items())
    return next(((sign, shown(limit, field) if limit else "0") for sign, limit in found if limit is not None), None)


def _in_columns(rows):
    """Lines of code and comment, comments in one column, wrapped where the line ends."""
    column = 2 + max((len(code) for code, _ in rows if len(code) <= WIDEST_KEY), default=WIDEST_KEY)
    lines = []
    for code, comment in rows:
        words, bracket, allowed = comment.partition("  [")
        glued = allowed.replace(" ", "\0") if len(allowed) < (WIDTH - column) / 2 else allowed  # kept on one line where that is no waste
        wrapped = textwrap.wrap(words + bracket + glued, WIDTH - column - 4, break_long_words=False)
        wrapped = ([""] if len(code) > column - 2 else []) + wrapped  # beside code that is too long stands nothing
        first, *rest = (line.replace("\0", " ") for line in wrapped)
        lines.append(f"{code.ljust(column - 2)}  # {first}" if first else code)
        lines += [f"{' ' * column}#   {more}" for more in rest]
    return lines


# -- samples -------------------------------------------------------------------------------------------------------------------


def skeleton(model: type[Any]) -> dict[str, Any]:
    """Sample values for the required keys of a table."""
    tables = {}
    for name, field in model.model_fields.items():
        if field.is_required():
            inner = table_of(field.annotation)
            table = skeleton(inner) if inner else None
            several = {SOME_NAME: table} if has_names(field.annotation) else [table] if list_depth(field.annotation) else table
            tables[name] = sample_of(field) if inner is None else several
    return tables


def sample_of(field: FieldInfo) -> Any:
    """A value that a key could have."""
    if field.examples:
        return field.examples[0]
    dimension = dimension_of(field)
    one = f"1 {dimension.shown}" if dimension else 1.0 if mark_of(field, AnyUnit) else None
    return _nested_sample(field.annotation, one)


def _nested_sample(annotation, one):
    """A sample of a type, `one` standing for each quantity in its lists."""
    inner = [arg for arg in get_args(annotation) if arg not in (Ellipsis, type(None))]
    if get_origin(annotation) is dict:
        return {SOME_NAME: _nested_sample(inner[1], one)}
    if get_origin(annotation) in (tuple, list):
        return [_nested_sample(arg, one) for arg in inner]
    if levels(annotation):
        return _nested_sample(inner[0], one)
    return one if one is not None else next(iter(choices_of(annotation)), SAMPLES.get(type_of(annotation), "..."))


def _length(annotation):
    """Entries of a list of fixed length; 0 for any other."""
    inner = get_args(annotation)
    if get_origin(annotation) is tuple:
        return 0 if Ellipsis in inner else len(inner)
    return max(map(_length, inner), default=0)


def shared_samples(mechanism: Mechanism[Any, Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """[optimise] and [study] tables that fit the kind: its first quantity as what changes, a headline value as the objective."""
    keys = [(f"{table}.{key}", value) for table, keys in given.items() if isinstance(keys, dict) for key, value in keys.items()]
    quantities = [
        (key, value)
        for key, value in keys
        if isinstance(value, str) and (field := field_at(mechanism.spec, key.split("."))) and dimension_of(field)
    ]
    if not quantities or not mechanism.headline:
        return {}
    key, value = quantities[0]
    number, unit = split(value)
    lower, upper = (f"{float(number) * share:.4g} {unit}" for share in (0.9, 1.1))
    required = {"value": mechanism.headline[-1], "at_least": 1.0, "at_most": 2.0}
    search = {
        "settings": [{"key": key, "value": value}],
        "unknowns": [{"key": key, "lower": lower, "upper": upper}],
        "objectives": [{"value": mechanism.headline[0]}],
        "requirements": [required],
    }
    return {"optimise": search, "study": {"vary": [{"key": key, "lower": lower, "upper": upper, "steps": 5}]}}
