"""What the user says: frozen, unit-checked tables, read from and written to TOML.

A mechanism's spec is a tree of `Spec` classes under one `MechanismSpec`.  The tree is its own documentation: the commented
template, the JSON schema and every error message are read off the fields.
"""

import hashlib
import json
import tomllib
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, Strict, ValidationError, ValidationInfo
from pydantic.fields import FieldInfo

from drivewright import registry
from drivewright.errors import InputError, SpecError, UnknownName, nearest
from drivewright.units import Dimension

Number = Annotated[float, Strict()]
Integer = Annotated[int, Strict()]
Flag = Annotated[bool, Strict()]
Text = Annotated[str, Strict(), Field(max_length=400)]


def _existing_file(value: Any, info: ValidationInfo):
    """A path relative to the spec's folder, made absolute; it must be there."""
    if not isinstance(value, (str, Path)) or not str(value).strip() or "\0" in str(value):
        raise ValueError(f"wants the path of a file, got {value!r}")
    folder = Path((info.context or {}).get("folder", "."))
    path = (folder / value).resolve()
    if not path.is_file():
        raise ValueError(f"there is no file {str(path)!r}; a path is relative to the spec")
    return path


DataFile = Annotated[Path, BeforeValidator(_existing_file)]


class _Door(type(BaseModel)):
    """Turns the complaint about a table built in Python into ours.  (A nested table read from a file does not pass here.)"""

    def __call__(cls, **data):
        try:
            return super().__call__(**data)
        except ValidationError as error:
            raise _translated(error, cls) from None


class Spec(BaseModel, metaclass=_Door):
    """One table of a spec: frozen, no unknown keys, units at the door."""

    model_config = ConfigDict(frozen=True, extra="forbid", validate_default=True, allow_inf_nan=False)

    def replace(self, **changes):
        """A copy with top-level keys changed; validated like the original."""
        return from_document({**document(self), **changes}, type(self))


class Unknown(Spec):
    """An unknown of the optimiser: a key of this spec and its bounds."""

    key: Text = Field(description="dotted key of this spec that may change", examples=["follower.prime_radius"])
    lower: Text | Number = Field(description="lower bound, in the key's own unit", examples=["30 mm"])
    upper: Text | Number = Field(description="upper bound, in the key's own unit", examples=["60 mm"])


class Setting(Spec):
    """A key that has another value during the search and in its outcome."""

    key: Text = Field(description="dotted key of this spec", examples=["follower.offset"])
    value: Text | Number | Flag = Field(description="its value during the search", examples=["0 mm"])


class Objective(Spec):
    """A value of the result to be made small or large."""

    value: Text = Field(description="name of a value of the result", examples=["max_pressure_angle"])
    goal: Literal["minimise", "maximise"] = Field("minimise", description="direction")


class Requirement(Spec):
    """A value of the result that must stay within limits."""

    value: Text = Field(description="name of a value of the result", examples=["min_convex_radius"])
    at_least: Text | Number | None = Field(None, description="lower limit, in the value's own unit")
    at_most: Text | Number | None = Field(None, description="upper limit, in the value's own unit")


class Optimise(Spec):
    """What may change, what is required, what is wanted."""

    method: Literal["auto", "differential-evolution", "nsga2"] = Field(
        "auto", description="auto takes differential evolution for one objective and NSGA-II for several")
    seed: Integer = Field(1, ge=0, le=2**31 - 1, description="seed of the random numbers; same seed, same answer")
    population: Integer = Field(60, ge=8, le=10_000, description="designs per generation")
    generations: Integer = Field(400, ge=1, le=100_000, description="generations at most")
    settings: tuple[Setting, ...] = Field((), description="keys set differently for the search")
    unknowns: tuple[Unknown, ...] = Field(min_length=1, description="what may change")
    objectives: tuple[Objective, ...] = Field(min_length=1, description="what is wanted")
    requirements: tuple[Requirement, ...] = Field((), description="what is required")


class MechanismSpec(Spec):
    """The whole spec of one drive."""

    format: Literal[1] = Field(1, description="version of the file format")
    mechanism: Text = Field(description="kind of drive")
    title: Text = Field("", description="a name for people")
    optimise: Optimise | None = Field(None, description="unknowns, requirements and objectives for `drivewright optimise`")

    def to_toml(self):
        """The effective spec as TOML text with units; reads back to an equal spec."""
        import tomlkit

        return tomlkit.dumps(document(self))

    def digest(self):
        """SHA-256 of the canonical effective spec in SI; data files by content, titles left out."""
        canonical = json.dumps(_canonical(self, skip=("title",)), sort_keys=True, separators=(",", ":"))
        return hashlib.sha256(canonical.encode()).hexdigest()

    def data_files(self):
        """Absolute paths of all data files the spec names."""
        return sorted(set(_files(self)))


# -- reading ---------------------------------------------------------------------------------------------------------------


def read_document(path):
    """The raw tables of a TOML spec file; SpecError where it is missing or is not TOML."""
    path = Path(path)
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise SpecError(f"there is no such file; `drivewright new KIND {path.name}` writes one", file=str(path)) from None
    except (OSError, UnicodeDecodeError) as error:
        raise SpecError(f"cannot be read: {error}", file=str(path)) from None
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise SpecError(f"is not valid TOML: {error}", file=str(path)) from None


def load(path, changes=()):
    """Spec of a TOML file, `changes` being "key=value" texts as on the command line."""
    data = read_document(path)
    try:
        for change in changes:
            change_key(data, change)
        return from_document(data, folder=Path(path).resolve().parent)
    except SpecError as error:
        raise error.located(file=str(path)) from None


def from_document(data, model=None, folder="."):
    """Spec from raw tables; the kind comes from `mechanism` unless `model` is given.  Paths are relative to `folder`."""
    model = model or _model_of(data)
    try:
        return model.model_validate(data, context={"folder": str(folder)})
    except ValidationError as error:
        raise _translated(error, model) from None


def _model_of(data):
    kind = data.get("mechanism")
    if not isinstance(kind, str):
        raise SpecError(f"is missing or no text; one of {', '.join(registry.kinds())}", key="mechanism")
    try:
        return registry.mechanism(kind).spec
    except UnknownName as error:
        raise SpecError(str(error), key="mechanism") from None


def change_key(data, change):
    """Apply "dotted.key=value" as from the command line to raw tables.  The value is TOML, or else text."""
    key, equals, text = change.partition("=")
    if not equals or not key.strip():
        raise SpecError(f"--set wants key=value, got {change!r}")
    return set_key(data, key.strip(), read_value(text))


def set_key(data, key, value):
    """Set a dotted key of raw tables; list elements go by their `name` or number."""
    *path, last = key.split(".")
    place = data
    for number, step in enumerate(path):
        place = _enter(place, step, ".".join(path[: number + 1]))
    if isinstance(place, list):
        place[_index(place, last, key)] = value
    elif isinstance(place, dict):
        place[last] = value
    else:
        raise SpecError("is no table", key=".".join(path))
    return data


def read_value(text):
    """A `--set` value: TOML where it parses, text otherwise."""
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except (tomllib.TOMLDecodeError, RecursionError):
        return text.strip()


def _enter(place, step, key):
    if isinstance(place, list):
        return place[_index(place, step, key)]
    if not isinstance(place, dict):
        raise SpecError("is no table", key=key)
    return place.setdefault(step, {})


def _index(elements, step, key):
    names = {e["name"]: i for i, e in enumerate(elements) if isinstance(e, dict) and isinstance(e.get("name"), str)}
    if step in names:
        return names[step]
    if step.isdigit() and int(step) < len(elements):
        return int(step)
    raise SpecError(f"the list has no element {step!r}; it has {len(elements)}{': ' + ', '.join(names) if names else ''}", key=key)


# -- complaining -----------------------------------------------------------------------------------------------------------

COMPARISONS = {"greater_than": ("gt", "greater than"), "greater_than_equal": ("ge", "at least"), "less_than": ("lt", "less than"),
               "less_than_equal": ("le", "at most")}


def _translated(error, model):
    """One SpecError naming the first wrong key; the others follow in the message."""
    items = [_complaint(item, model) for item in error.errors(include_url=False)]
    first = items[0]
    rest = "".join(f"\n  {key}: {message}" for key, message in items[1:6])
    more = f"\n  ... and {len(items) - 6} more" if len(items) > 6 else ""
    return SpecError(first[1] + rest + more, key=first[0])


def _complaint(item, model):
    """(dotted key, message) of one pydantic error."""
    place = [part for part in item["loc"] if not (isinstance(part, str) and ("[" in part or part in ("str", "float", "int")))]
    key, kind, given = ".".join(map(str, place)), item["type"], item["input"]
    if kind == "extra_forbidden":
        known = list(_fields(model, place[:-1]))
        return key, f"unknown key{nearest(place[-1], known)}; known here: {', '.join(known)}"
    if kind == "missing":
        return key, f"is missing{_example(_field(model, place))}"
    if kind in COMPARISONS:
        name, words = COMPARISONS[kind]
        field = _field(model, place)
        return key, f"must be {words} {_shown(item['ctx'][name], field)}, got {given if isinstance(given, str) else _shown(given, field)}"
    if kind == "literal_error":
        choices = _literals(_field(model, place).annotation)
        return key, f"must be one of {', '.join(map(repr, choices))}, got {given!r}{nearest(given, [str(c) for c in choices])}"
    if kind == "value_error":
        return key, str(item["ctx"]["error"])
    if kind in ("model_type", "dict_type"):
        return key, f"must be a table, got {given!r:.80}"
    if kind in ("too_short", "too_long"):
        wanted = item["ctx"].get("min_length", item["ctx"].get("max_length"))
        return key, f"must have {'at least' if kind == 'too_short' else 'at most'} {wanted} entries, got {item['ctx']['actual_length']}"
    return key, f"{item['msg'][0].lower()}{item['msg'][1:]}, got {given!r:.80}"


def _field(model, place):
    """The FieldInfo at a path of keys and indices, or None."""
    *path, last = place
    return _fields(model, path).get(last)


def _fields(model, path):
    """Fields of the table at a path below `model`."""
    for step in path:
        if isinstance(step, int):
            continue
        field = model.model_fields.get(step) if model else None
        model = table_of(field.annotation) if field else None
    return model.model_fields if model else {}


def table_of(annotation):
    """The Spec class inside an annotation such as `Spec | None` or `tuple[Spec, ...]`, else None."""
    if isinstance(annotation, type) and issubclass(annotation, Spec):
        return annotation
    return next((found for arg in get_args(annotation) if (found := table_of(arg))), None)


def is_list(annotation):
    """Whether the annotation holds a sequence."""
    origin = get_origin(annotation)
    if origin in (Union, UnionType, Annotated):
        return any(is_list(arg) for arg in get_args(annotation))
    return origin in (tuple, list)


def _literals(annotation):
    if get_origin(annotation) is Literal:
        return get_args(annotation)
    return tuple(choice for arg in get_args(annotation) for choice in _literals(arg))


def dimension_of(field):
    """The Dimension of a quantity field (also of its list), else None."""
    found = [m for m in getattr(field, "metadata", ()) if isinstance(m, Dimension)]
    return found[0] if found else _dimension_inside(getattr(field, "annotation", field))


def _dimension_inside(annotation):
    if get_origin(annotation) is Annotated:
        return next((m for m in annotation.__metadata__ if isinstance(m, Dimension)), None)
    return next((d for arg in get_args(annotation) if (d := _dimension_inside(arg))), None)


def dimension_at(model, key):
    """(exists, Dimension or None) of a dotted key below a Spec class; numbers step into lists."""
    place = [int(step) if step.isdigit() else step for step in key.split(".")]
    field = _field(model, place)
    return field is not None, dimension_of(field) if field else None


def _example(field):
    if field is None:
        return ""
    example = f'; e.g. {_toml(field.examples[0])}' if field.examples else ""
    return f" ({field.description}){example}" if field.description else example


def _shown(limit, field):
    dimension = dimension_of(field)
    return dimension.text(float(limit)) if dimension else f"{limit:g}"


# -- writing ---------------------------------------------------------------------------------------------------------------


def document(spec):
    """Raw tables of a spec, quantities as text with unit; what is None is left out."""
    tables, values = {}, {}
    for name, field in type(spec).model_fields.items():
        value = getattr(spec, name)
        if value is not None and value != ():
            target = tables if isinstance(value, Spec) or (isinstance(value, tuple) and isinstance(value[0], Spec)) else values
            target[name] = _written(value, dimension_of(field))
    return values | tables


def _written(value, dimension):
    if isinstance(value, Spec):
        return document(value)
    if isinstance(value, (tuple, list)):
        return [_written(v, dimension) for v in value]
    if dimension and isinstance(value, float):
        return dimension.text(value)
    return str(value) if isinstance(value, Path) else value


def _canonical(value, skip=()):
    if isinstance(value, Spec):
        return {name: _canonical(getattr(value, name)) for name in type(value).model_fields if name not in skip}
    if isinstance(value, (tuple, list)):
        return [_canonical(v) for v in value]
    if isinstance(value, Path):
        return hashlib.sha256(value.read_bytes()).hexdigest()
    return value.hex() if isinstance(value, float) else value


def _files(value):
    if isinstance(value, Spec):
        return [path for name in type(value).model_fields for path in _files(getattr(value, name))]
    if isinstance(value, (tuple, list)):
        return [path for v in value for path in _files(v)]
    return [value] if isinstance(value, Path) else []


def template(kind, preset=None):
    """Commented spec text of a kind: every key with its meaning, unit, default and limits; values from a preset."""
    mechanism = registry.mechanism(kind)
    presets = mechanism.presets()
    name = preset or ("default" if "default" in presets else next(iter(presets)))
    if name not in presets:
        raise UnknownName(f"preset of {kind}", name, presets)
    given = read_document(presets[name])
    lines = [f"# Drivewright spec: {mechanism.summary}", "# A line that starts with '# ' before a key shows a key left at its default.", ""]
    return "\n".join(lines + _template_lines(mechanism.spec, given, "")) + "\n"


def _template_lines(model, given, path):
    """Lines of one table: its values first, then its sub-tables."""
    values = {n: f for n, f in model.model_fields.items() if not table_of(f.annotation)}
    lines = [_key_line(name, field, given) for name, field in values.items()]
    for name, field in model.model_fields.items():
        if (inner := table_of(field.annotation)) is not None:
            lines += _table_lines(name, field, inner, given.get(name), f"{path}{name}")
    return lines


def _table_lines(name, field, inner, given, path):
    """Lines of a sub-table, commented out where it is optional and not given."""
    heading = ["", f"# {field.description}"] if field.description else [""]
    if is_list(field.annotation):
        if given:
            return heading + [line for g in given for line in ["", f"[[{path}]]", *_template_lines(inner, g, f"{path}.")]][1:]
        return heading + _commented([f"[[{path}]]", *_template_lines(inner, _examples(inner), f"{path}.")])
    if given is None and not field.is_required() and field.default is None:
        return heading + _commented([f"[{path}]", *_template_lines(inner, _examples(inner), f"{path}.")])
    return [*heading, f"[{path}]", *_template_lines(inner, given or {}, f"{path}.")]


def _commented(lines):
    return [line if not line or line.startswith("# ") else f"# {line}" for line in lines]


def _examples(model):
    return {n: f.examples[0] for n, f in model.model_fields.items() if f.is_required() and f.examples}


def _key_line(name, field, given):
    value = given.get(name, None if field.is_required() else field.default)
    dimension = dimension_of(field)
    written = _toml(_written(value, dimension)) if value is not None else _toml(field.examples[0] if field.examples else "")
    active = "" if name in given or field.is_required() else "# "
    return f"{active}{name} = {written}".ljust(44) + f"  # {_meaning(field, dimension)}"


def _meaning(field, dimension):
    """Description, kind of quantity, limits and default of a field, in words."""
    choices = _literals(field.annotation)
    words = [field.description or "", dimension.name if dimension else "", _limits(field, dimension)]
    if len(choices) > 1:
        words.append("one of " + " | ".join(f'"{c}"' for c in choices))
    if not field.is_required():
        words.append("no default" if field.default is None else f"default {_toml(_written(field.default, dimension))}")
    return "; ".join(word for word in words if word)


def _limits(field, dimension):
    signs = {"gt": ">", "ge": ">=", "lt": "<", "le": "<="}
    found = [(sign, getattr(m, a)) for m in field.metadata for a, sign in signs.items() if getattr(m, a, None) is not None]
    return ", ".join(f"{sign} {'0' if not limit else _shown(limit, field)}" for sign, limit in found)


def _toml(value):
    """A value as TOML text on one line."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {_toml(v)}" for k, v in value.items()) + " }"
    return repr(value)


def schema(kind):
    """JSON schema of a kind's spec files, for editors and forms."""
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": f"Drivewright {kind}",
            **registry.mechanism(kind).spec.model_json_schema()}


__all__ = ["DataFile", "Flag", "Integer", "InputError", "MechanismSpec", "Number", "Optimise", "Spec", "Text", "dimension_at", "document",
           "from_document", "load", "read_document", "read_value", "schema", "set_key", "template", "Field", "FieldInfo", "NoneType"]
