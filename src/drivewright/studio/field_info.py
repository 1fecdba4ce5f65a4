"""What a key of a spec is, read off its class: a `FieldInfo`; and the way between a raw value and the text that a box shows."""

from collections.abc import Sequence
from copy import deepcopy
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path, PureWindowsPath
from typing import Any, TypeAlias, get_args, get_origin

from pydantic.fields import FieldInfo as PydanticField

from drivewright.errors import UnitError
from drivewright.spec import MechanismSpec, Spec, document, from_document, read_value
from drivewright.spec.fields import AnyUnit, choices_of, containers_of, dimension_of, marker_of, table_of, type_of
from drivewright.spec.serialisation import to_plain, toml_value
from drivewright.studio.sliders import Limits
from drivewright.units import Dimension, split

Raw: TypeAlias = Any  # a value as TOML has it
KINDS = {bool: "flag", int: "integer", float: "number", str: "text", Path: "file"}
AXES = ("x", "y", "z")
VECTORS = ("mm", "m/s", "m/s^2", "N")  # units of quantities that have a direction
ABSENT = object()  # where a key is not said


@dataclass(frozen=True, eq=False)
class FieldInfo:
    """What does not change about a field: all that its spec class states.  `items`: of each entry of a list or of a `Named`."""

    name: str
    hint: str
    kind: str
    required: bool
    dimension: Dimension | None
    choices: tuple[Any, ...]
    limits: Limits
    default: Raw  # raw, None where there is none
    example: Raw  # raw, None where there is none
    table: type[Spec] | None
    levels: tuple[Any, ...]
    items: "tuple[FieldInfo, ...]" = ()  # of a list or a `Named`: a FieldInfo for each entry where their number is fixed, else one for all
    fixed: bool = False
    parts: tuple[str, ...] = ()  # what the entries of a pair or a point are called
    suggestions: tuple[str, ...] = ()  # of a text: what it may be, among other things
    listed: str = ""  # name of the list of parts (`part_lists`) that a text is chosen from
    overrides: tuple[str, ...] = ()  # keys beside it that stand in place of what that part has of its own
    default_changes: tuple[tuple[str, Any], ...] = ()  # of a table: (key, raw value) where its default says something else than its class

    @property
    def sample(self) -> Any:
        """A raw value that an entry of a list could have."""
        usual = {"quantity": f"1 {self.dimension.display_unit}" if self.dimension else "", "number": 1.0, "integer": 1, "flag": False}
        return usual.get(self.kind, "...") if self.example is None else self.example

    @property
    def initial_value(self) -> Any:
        """What a file has to say before a part of this default can be changed; None where there is no default."""
        if self.kind == "list" and not self.table:
            return deepcopy(self.default or self.example or [item.sample for item in self.items if self.fixed])
        if self.table and isinstance(self.default, dict):
            return dict(self.default_changes)
        return deepcopy(self.default)


# -- field infos ---------------------------------------------------------------------------------------------------------------------


@cache
def field_infos(model: type[Spec]) -> dict[str, FieldInfo]:
    """The FieldInfo of each key of a table class, values first, then sub-tables, those that all kinds share last."""
    infos = {name: field_info_of(name, field) for name, field in model.model_fields.items()}
    shared = MechanismSpec.model_fields
    order = sorted(infos.values(), key=lambda info: (bool(info.table) or info.kind == "names", bool(info.table) and info.name in shared))
    return {info.name: info for info in order}


def field_info_of(name: str, field: PydanticField) -> FieldInfo:
    """The FieldInfo of a pydantic field."""
    dimension, required = dimension_of(field), field.is_required()
    example = field.examples[0] if field.examples else None
    default = None if required or field.default in ((), {}) else to_plain(field.default, dimension)
    own = _own(field.default) if isinstance(field.default, Spec) else ()
    return _field_info(
        name,
        field.annotation,
        dimension or marker_of(field, AnyUnit),
        _limits(field.metadata),
        hint=field.description or "",
        required=required,
        default=default,
        example=example,
        own=own,
        about=field,
    )


def _own(table: Spec) -> tuple[tuple[str, Any], ...]:
    """What a table says that its class does not say by itself."""
    kind, own = type(table), document(table)
    usual = document(from_document({name: own[name] for name, field in kind.model_fields.items() if field.is_required()}, kind))
    return tuple((name, value) for name, value in own.items() if usual.get(name) != value)


def _field_info(name, annotation, mark, limits, hint="", required=True, default=None, example=None, own=(), about=None):
    dimension = None if isinstance(mark, AnyUnit) else mark
    kind = _kind(annotation, mark)
    parts = () if table_of(annotation) else _parts(annotation)
    items = tuple(
        _field_info(
            str(n),
            part,
            dimension_of(_Bare(part)) or marker_of(_Bare(part), AnyUnit) or mark,
            _limits(_marks(part)),
            default=default[n] if isinstance(default, list) and n < len(default) else None,
            example=example[n] if isinstance(example, list) and n < len(example) else None,
        )
        for n, part in enumerate(parts)
    )
    fixed = kind == "list" and Ellipsis not in get_args(_bare(annotation))
    return FieldInfo(
        name,
        hint,
        kind,
        required,
        dimension,
        choices_of(annotation),
        limits,
        default,
        example,
        table_of(annotation),
        containers_of(annotation),
        items,
        fixed,
        _part_names(about, items) if fixed else (),
        _suggestions(about) if kind == "text" else (),
        *_of_a_part(about),
        own,
    )


def _part_names(field: PydanticField | None, items: tuple[FieldInfo, ...]) -> tuple[str, ...]:
    """What the parts of a pair are called: as its field says (`json_schema_extra={"parts": [...]}`), else x, y, z where it is a vector."""
    extra = field.json_schema_extra if field is not None else None
    if isinstance(extra, dict) and isinstance(named := extra.get("parts"), list):
        return tuple(map(str, named))
    vector = 1 < len(items) <= len(AXES) and all(item.dimension and item.dimension.display_unit in VECTORS for item in items)
    return AXES[: len(items)] if vector else tuple(str(n + 1) for n in range(len(items)))


def _suggestions(field: PydanticField | None) -> tuple[str, ...]:
    """Several examples of a text are what one may choose from; a single one shows how it looks."""
    examples = (field.examples if field is not None else None) or ()
    return tuple(map(str, examples)) if len(examples) > 1 else ()


def _of_a_part(field: PydanticField | None) -> tuple[str, tuple[str, ...]]:
    """(list that a bought part comes from, keys that override it): `json_schema_extra={"x-list": ..., "x-overrides": [...]}`."""
    extra = field.json_schema_extra if field is not None else None
    if not isinstance(extra, dict):
        return "", ()
    named, overrides = extra.get("x-list", ""), extra.get("x-overrides", [])
    return str(named), tuple(map(str, overrides)) if isinstance(overrides, list) else ()


def field_info_at(model: type[Spec], steps: Sequence[str]) -> FieldInfo | None:
    """The FieldInfo at a path of keys below a table class, elements of lists by name or number; None where no value can stand."""
    step, *rest = steps
    info = field_infos(model).get(step)
    while info and rest:
        step, *rest = rest
        if info.table:
            rest = rest if info.levels else [step, *rest]
            return field_info_at(info.table, rest) if rest else None
        number = int(step) if step.isdecimal() and info.fixed else 0
        info = info.items[number] if number < len(info.items) else None
    return info


@dataclass(frozen=True)
class _Bare:
    """An annotation that stands alone, looking like a field."""

    annotation: object
    metadata: tuple[object, ...] = ()


def _kind(annotation: Any, mark: Any) -> str:
    """What sort of box a field has."""
    nested, choices, plain = containers_of(annotation), choices_of(annotation), type_of(annotation)
    if nested:
        return "names" if nested[0] is dict else "list"
    if isinstance(mark, AnyUnit) or (choices and plain is not None):
        return "any"
    return "quantity" if mark else "choice" if choices else KINDS.get(plain, "any")


def _bare(annotation):
    """An annotation without `Annotated` and `| None` around it."""
    if hasattr(annotation, "__metadata__"):
        return _bare(annotation.__origin__)
    if get_origin(annotation) in (tuple, list, dict):
        return annotation
    inner = [part for part in get_args(annotation) if part is not type(None)]
    return _bare(inner[0]) if len(inner) == 1 and not isinstance(annotation, type) and containers_of(annotation) else annotation


def _parts(annotation):
    """The annotations of what a list or a `Named` holds."""
    annotation = _bare(annotation)
    parts = get_args(annotation) if get_origin(annotation) in (tuple, list, dict) else ()
    return parts[1:] if get_origin(annotation) is dict else tuple(part for part in parts if part is not Ellipsis)


def _marks(annotation):
    """What an annotation is annotated with."""
    marks = getattr(annotation, "__metadata__", ())
    return [mark for given in marks for mark in (given.metadata if isinstance(given, PydanticField) else [given])]


def _limits(marks):
    """Limits, in SI."""
    limits = {side: limit for mark in marks for side in ("gt", "ge", "lt", "le") if (limit := getattr(mark, side, None)) is not None}
    return Limits(limits.get("gt", limits.get("ge")), limits.get("lt", limits.get("le")), "gt" in limits, "lt" in limits)


# -- text ----------------------------------------------------------------------------------------------------------------------


def parse_text(info: FieldInfo, text: str, shown: str = "") -> Any:
    """The raw value of a typed text, `shown` being the text in the box before: its unit goes with a bare number."""
    if info.kind in ("text", "file"):
        return text
    text = text.strip()
    if info.kind == "choice":
        return next((choice for choice in info.choices if str(choice) == text), text)
    if info.kind == "list":
        return _read_list(info, text, shown)
    if info.kind in ("quantity", "any") and has_no_unit(text):
        unit = _unit(shown) or (_unit(plain_text(info.default)) or info.dimension.display_unit if info.dimension else "")
        return f"{text} {unit}" if unit else read_value(text)
    return text if info.kind == "quantity" else read_value(text)


def _read_list(info: FieldInfo, text: str, shown: str) -> Any:
    """A list as TOML, or its entries with commas between them."""
    value = read_value(text) if text.startswith("[") else text
    texts = value if isinstance(value, list) else text.split(",")
    before = shown.split(",") or [""]
    if len(info.levels) > 1 or not info.items:
        return read_value(text)
    return [
        parse_text(info.items[min(n, len(info.items) - 1)], part.strip(), before[min(n, len(before) - 1)])
        if isinstance(part, str)
        else part
        for n, part in enumerate(texts)
    ]


def display_text(info: FieldInfo, value: Any, shown: str = "") -> str:
    """The text that a box shows for a raw value; `parse_text` gives the value back."""
    if value is None or value is ABSENT or value == "":
        return ""
    if info.kind == "file":  # a folder of the user's disk is nothing for the page
        return PureWindowsPath(value).name if Path(value).is_absolute() or PureWindowsPath(value).is_absolute() else value
    if info.kind == "list" and isinstance(value, list) and all(not isinstance(entry, (list, dict)) for entry in value):
        return _list_text(info, tuple((type(entry), entry) for entry in value), shown)
    return _read_back(info, plain_text(value), value, shown)


# Most lists of a form are those of the form before.  The types tell 1, 1.0 and true apart.
@lru_cache(maxsize=4096)
def _list_text(info, entries, shown):
    value = [entry for _, entry in entries]
    texts = (display_text(info.items[min(n, len(info.items) - 1)], entry) for n, entry in enumerate(value)) if info.items else ()
    return _read_back(info, ", ".join(texts), value, shown)


def _read_back(info, text, value, shown):
    """The text where it gives the value back, else the value as TOML."""
    return text if text and _same(parse_text(info, text, shown or text), value) else toml_value(value)


def plain_text(value: Any) -> str:
    """A raw value as people write it in a box."""
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return str(int(value))
    return "" if value is None else value if isinstance(value, str) else toml_value(value)


def has_no_unit(text: str) -> bool:
    """Whether a text is a number without a unit."""
    try:
        return not split(text)[1]
    except UnitError:
        return False


def _unit(text: str) -> str:
    try:
        return split(text)[1]
    except UnitError:
        return ""


def _same(one: Any, other: Any) -> bool:
    return one == other and type(one) is type(other)
