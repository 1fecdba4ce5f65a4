"""The commented template of a spec: every key with its meaning, unit, default and limits, read off the fields."""

import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args, get_origin

from drivewright import registry
from drivewright.errors import UnknownName
from drivewright.spec.error_messages import number_text
from drivewright.spec.fields import AnyUnit, choices_of, dimension_of, has_user_keys, list_depth, marker_of, table_of, type_of
from drivewright.spec.mechanism_spec import MechanismSpec
from drivewright.spec.parsing import read_document
from drivewright.spec.sample_values import SAMPLE_NAME, required_keys_sample, sample_value, shared_table_samples
from drivewright.spec.serialisation import to_plain, toml_key, toml_value

if TYPE_CHECKING:
    from pydantic.fields import FieldInfo

WIDTH, MAX_CODE_WIDTH = 118, 44  # of a line; of the part before the comment, where comments still stand in one column
DRAWN = "# What the main keys measure is drawn in the studio, behind the ruler: drivewright studio FILE."
ANY_UNIT = "number or quantity"
KINDS = {bool: "true or false", int: "whole number", float: "number", str: "text", Path: "file"}


def template(kind: str, preset: str | None = None) -> str:
    """Commented spec text of a kind: every key with its meaning, unit, default and limits; values from a preset."""
    mechanism, path = registry.mechanism(kind), preset_path(kind, preset)
    given = read_document(path) if path else {"mechanism": kind, **required_keys_sample(mechanism.spec)}
    source = f' (preset "{path.stem}")' if path else ""
    intro = [
        f"# {mechanism.summary[:1].upper()}{mechanism.summary[1:]}{source}.",
        "#",
        '# Every key is here.  "#key = value" is left at its default, or out: take the # away to change it.',
        '# A quantity is text with a unit, e.g. "9.5 mm", "2000 rpm", "3e7 N/m".  [...] says what is allowed,',
        '# and "default" where the value shown is the one taken when the key is left out.',
        *([DRAWN] if mechanism.dimensions else []),
        "",
    ]
    return "\n".join(intro + _lines(mechanism.spec, given, samples=shared_table_samples(mechanism, given))) + "\n"


def preset_path(kind: str, preset: str | None = None) -> Path | None:
    """Spec file of a preset by name: "default" or else the first unless named; None where the kind brings none."""
    presets = registry.mechanism(kind).presets()
    name = preset or ("default" if "default" in presets else next(iter(presets), None))
    if name not in presets and (preset or presets):
        raise UnknownName(f"preset of {kind}", name, presets)
    return presets.get(name) if name else None


# -- lines of the template -----------------------------------------------------------------------------------------------------


def _lines(model, given, path="", off=False, samples=None):
    """Lines of one table: its values, then its sub-tables, those that all kinds share last; `off` puts a # before each line."""
    fields = model.model_fields.items()
    lines = _in_two_columns([_key_line(name, field, given, off) for name, field in fields if not table_of(field.annotation)])
    for name, field in sorted(fields, key=lambda item: item[0] in MechanismSpec.model_fields):
        if table_of(field.annotation):
            lines += _table(f"{path}{name}", field, given.get(name), off, (samples or {}).get(name))
    return lines


def _table(path, field, given, off, sample):
    """Lines of a sub-table or of a list of them, switched off where it is optional and not given."""
    inner: Any = table_of(field.annotation)
    off = off or (not given and not field.is_required() and not field.default)
    first, *others = _tables(path, field, given or ({} if not off else sample or required_keys_sample(inner)))
    place, heading, table = first
    explained = ["", f"{'#' if off else ''}{heading}  # {field.description or inner.__doc__}", *_lines(inner, table, f"{place}.", off)]
    return explained + [line for other in others for line in _further_table(inner, *other, off)]


def _tables(path, field, given):
    """(path, heading, keys) of each table that a field holds."""
    if has_user_keys(field.annotation):
        tables = given if given and all(isinstance(table, dict) for table in given.values()) else {SAMPLE_NAME: given}
        return [(f"{path}.{toml_key(name)}", f"[{path}.{toml_key(name)}]", table) for name, table in tables.items()]
    if list_depth(field.annotation):
        return [(path, f"[[{path}]]", table) for table in (given if isinstance(given, list) else [given])]
    return [(path, f"[{path}]", given)]


def _further_table(inner, place, heading, table, off):
    """A further table of several: the keys given, which the first one has explained; in full where it holds tables itself."""
    if any(name in table and table_of(field.annotation) for name, field in inner.model_fields.items()):
        return ["", heading, *_lines(inner, table, f"{place}.", off)]
    return ["", heading, *(f"{key} = {toml_value(value)}" for key, value in table.items())]


def _key_line(name, field, given, off):
    """(code, comment) of a key: as given, else at its default and switched off."""
    default = to_plain(field.default, dimension_of(field)) if not field.is_required() and field.default is not None else None
    value = given.get(name, sample_value(field) if default is None else default)
    switched = "#" if off or name not in given else ""
    return f"{switched}{name} = {toml_value(value)}", f"{field.description or ''}  [{_allowed_values(field, default, value)}]"


def _allowed_values(field, default, value):
    """Limits, kind of quantity and default in words."""
    words = [limits_text(field)]
    if not field.is_required() and (default is None or default != value):
        words.append("no default" if default is None else f"default {toml_value(default)}")
    elif default is not None and len(choices_of(field.annotation)) != 1:
        words.append("default")
    return "; ".join(words)


def limits_text(field: "FieldInfo") -> str:
    """What is allowed: "0 < angle <= 180 deg", '"a" or "b"', "length"."""
    choices, dimension = choices_of(field.annotation), dimension_of(field)
    if choices:
        return " or ".join(map(toml_value, choices))
    what = dimension.name if dimension else ANY_UNIT if marker_of(field, AnyUnit) else KINDS.get(type_of(field.annotation), "value")
    low, high = _bound_text(field, gt="<", ge="<="), _bound_text(field, lt="<", le="<=")
    if low and high and low[1] == high[1]:
        bounded = low[1]
    elif low and not high:
        bounded = f"{what} {low[0].replace('<', '>')} {low[1]}"
    else:
        bounded = (f"{low[1]} {low[0]} " if low else "") + what + (f" {high[0]} {high[1]}" if high else "")
    length, depth = _fixed_length(field.annotation), list_depth(field.annotation)
    listed = f"list of {length} x {bounded}" if length and depth == 1 else "list of " * depth + bounded
    return f"table of {listed}" if has_user_keys(field.annotation) else listed


def _bound_text(field, **signs):
    """(sign, limit with unit) of the first of some constraints that a field has, else None."""
    bounds = ((sign, getattr(mark, side, None)) for mark in field.metadata for side, sign in signs.items())
    return next(((sign, number_text(limit, field) if limit else "0") for sign, limit in bounds if limit is not None), None)


def _in_two_columns(rows):
    """Lines of code and comment, comments in one column, wrapped where the line ends."""
    column = 2 + max((len(code) for code, _ in rows if len(code) <= MAX_CODE_WIDTH), default=MAX_CODE_WIDTH)
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


def _fixed_length(annotation):
    """Entries of a list of fixed length; 0 for any other."""
    inner = get_args(annotation)
    if get_origin(annotation) is tuple:
        return 0 if Ellipsis in inner else len(inner)
    return max(map(_fixed_length, inner), default=0)
