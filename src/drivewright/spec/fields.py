"""Types of the keys of a spec, and how to look a key up in a tree of tables."""

import re
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, NoReturn, TypeAlias, TypeVar, get_args, get_origin

from pydantic import AfterValidator, BaseModel, BeforeValidator, PlainValidator, Strict, ValidationInfo, WithJsonSchema
from pydantic.fields import FieldInfo

from drivewright.errors import MissingFile, UnitError, brief
from drivewright.units import Dimension, any_quantity, refuse_absurd

if TYPE_CHECKING:

    def Field(default: Any = ..., **about: Any) -> Any:
        """pydantic's `Field`, for which a default is a value as in a file: "9.5 mm" where the attribute is a float."""

else:
    from pydantic import Field

MAX_COUNT = 10**15  # that a whole number of a spec may say


def _refuse_uncountable(value: int) -> int:
    if abs(value) > MAX_COUNT:
        raise ValueError(f"{brief(value)} has no meaning: nothing here is counted beyond {MAX_COUNT:g}")
    return value


Number: TypeAlias = Annotated[float, Strict(), AfterValidator(lambda value: refuse_absurd(value, value, smallest=0.0))]
Integer: TypeAlias = Annotated[int, Strict(), AfterValidator(_refuse_uncountable)]
Flag: TypeAlias = Annotated[bool, Strict()]
Text: TypeAlias = Annotated[str, Strict(), Field(max_length=400)]
# of a bought part: 61904 without quotes is a number in TOML
Designation: TypeAlias = Annotated[Text, BeforeValidator(lambda value: str(value) if type(value) is int else value)]


def _one_word(value: str) -> str:
    if not re.fullmatch(r"\w[\w-]{0,59}", value):
        raise ValueError(f"{brief(value)} is no name here: letters, digits, _ and - only, at most 60 (a dot parts the steps of a key)")
    return value


Name: TypeAlias = Annotated[Text, AfterValidator(_one_word)]


class Frozen(dict):
    """A dictionary that does not change and can be hashed."""

    def __hash__(self) -> int:  # pyright: ignore[reportIncompatibleVariableOverride]  # dict says: not hashable
        return hash(frozenset(self.items()))

    def _refuse(self, *args: Any, **kwargs: Any) -> NoReturn:
        raise TypeError("a spec is frozen: `replace` gives a changed copy")

    if not TYPE_CHECKING:
        __setitem__ = __delitem__ = __ior__ = clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        return Frozen, (dict(self),)


# A table whose keys the user chooses: Named[Body] is read from [bodies.crank], [bodies.rocker] ...
Entry = TypeVar("Entry")
MarkT = TypeVar("MarkT")
Named: TypeAlias = Annotated[dict[Name, Entry], AfterValidator(Frozen)]


def _existing_file(value: Any, info: ValidationInfo) -> Path:
    """A path relative to the spec's folder, made absolute; it must be there."""
    if not isinstance(value, (str, Path)) or not str(value).strip() or "\0" in str(value):
        raise ValueError(f"wants the path of a file, got {brief(value)}")
    folder = Path((info.context or {}).get("folder", "."))
    try:
        path = (folder / value).resolve()
        exists = path.is_file()
    except (OSError, RuntimeError) as error:  # a name that is too long, a loop of links
        raise ValueError(f"{brief(str(value))} cannot be a file: {getattr(error, 'strerror', None) or error}") from None
    if not exists:
        raise MissingFile(f"there is no file {str(path)!r}; a path is relative to the spec")
    return path


DataFile: TypeAlias = Annotated[Path, BeforeValidator(_existing_file)]


class AnyUnit:
    """Marks a key whose unit depends on what another key names: a number, or a quantity of any kind."""


def _number_or_quantity(value: Any) -> Any:
    if isinstance(value, str):
        try:
            any_quantity(value)
        except UnitError as error:
            raise ValueError(error.message) from None
    elif isinstance(value, bool) or not _is_finite(value):
        raise ValueError(f'wants a finite number, or a quantity such as "9.5 mm", got {brief(value)}')
    return value


def _plain_value(value: Any) -> Any:
    if not isinstance(value, str) and not _is_finite(value):
        raise ValueError(f"wants a finite number, a quantity, a text or true/false, got {brief(value)}")
    return value


def _is_finite(value: object) -> bool:
    return isinstance(value, (int, float)) and abs(value) <= sys.float_info.max


Bound: TypeAlias = Annotated[Any, PlainValidator(_number_or_quantity), WithJsonSchema({"type": ["string", "number"]}), AnyUnit()]
PlainValue: TypeAlias = Annotated[Any, PlainValidator(_plain_value), WithJsonSchema({"type": ["string", "number", "boolean"]}), AnyUnit()]


# -- reading annotations -------------------------------------------------------------------------------------------------------


def containers_of(annotation: Any) -> tuple[Any, ...]:
    """The containers that an annotation nests, outermost first: () for `Spec | None`, (tuple,) for `tuple[Spec, ...]`, (dict, tuple) for
    `Named[tuple[Length, Length]]`."""
    origin = get_origin(annotation)
    deepest = max(map(containers_of, _inside(annotation)), key=len, default=())
    return (origin, *deepest) if origin in (tuple, list, dict) else deepest


def list_depth(annotation: Any) -> int:
    """How many lists an annotation nests."""
    return sum(kind is not dict for kind in containers_of(annotation))


def has_user_keys(annotation: Any) -> bool:
    """Whether the user chooses the keys: a `Named[...]`."""
    return containers_of(annotation)[:1] == (dict,)


def _inside(annotation: Any) -> tuple[Any, ...]:
    """The parts of an annotation that say what its values are."""
    origin, parts = get_origin(annotation), get_args(annotation)
    return () if origin is Literal else parts[:1] if origin is Annotated else parts[1:] if origin is dict else parts


def table_of(annotation: Any) -> type[Any] | None:
    """The table class inside an annotation such as `Spec | None` or `tuple[Spec, ...]`, else None."""
    if isinstance(annotation, type) and not get_args(annotation) and issubclass(annotation, BaseModel):
        return annotation
    return next((table for part in _inside(annotation) if (table := table_of(part))), None)


def type_of(annotation: Any) -> type | None:
    """The plain class of a value, lists and None left aside: int for `tuple[Integer, ...] | None`."""
    if isinstance(annotation, type) and annotation is not type(None) and not get_args(annotation):
        return annotation
    return next((kind for part in _inside(annotation) if (kind := type_of(part))), None)


def choices_of(annotation: Any) -> tuple[Any, ...]:
    """The values of the Literals inside an annotation."""
    if get_origin(annotation) is Literal:
        return get_args(annotation)
    return tuple(choice for part in _inside(annotation) for choice in choices_of(part))


def marker_of(field: Any, kind: type[MarkT]) -> MarkT | None:
    """The first annotation of a class on a field, or inside its type (of its list, of its optional value), else None."""
    own = (mark for mark in getattr(field, "metadata", ()) if isinstance(mark, kind))
    return next(own, None) or _marker_inside(getattr(field, "annotation", None), kind)


def _marker_inside(annotation: Any, kind: type[MarkT]) -> MarkT | None:
    if own := next((mark for mark in getattr(annotation, "__metadata__", ()) if isinstance(mark, kind)), None):
        return own
    return next((mark for part in _inside(annotation) if (mark := _marker_inside(part, kind))), None)


def dimension_of(field: Any) -> Dimension | None:
    """The Dimension of a quantity field (also of its list), else None."""
    return marker_of(field, Dimension)


# -- looking keys up -----------------------------------------------------------------------------------------------------------


def field_at(model: type[Any] | None, steps: Iterable[str]) -> FieldInfo | None:
    """The field at a path of keys; below a list or a `Named` comes one step (name or number) a level.  None where there is none."""
    field = None
    steps = list(steps)
    while steps:
        field = model.model_fields.get(steps.pop(0)) if model else None
        if field is None:
            return None
        model = table_of(field.annotation)
        del steps[: len(containers_of(field.annotation))]
    return field


def table_at(model: type[Any], steps: Sequence[str]) -> type[Any] | None:
    """The table class at a path of keys, else None."""
    field = field_at(model, steps) if steps else None
    return model if not steps else table_of(field.annotation) if field else None


def dimension_at(model: type[Any], key: str) -> tuple[bool, Dimension | None]:
    """(exists, Dimension or None) of a dotted key below a table class; a list's elements go by name or number."""
    field = field_at(model, key.split("."))
    return field is not None, dimension_of(field) if field else None


def value_at(spec: Any, key: str) -> Any:
    """The value at a dotted key of a spec, a list's elements by name or number; None where there is none."""
    value = spec
    for step in key.split("."):
        if isinstance(value, BaseModel):
            value = getattr(value, step, None)
        elif isinstance(value, dict):
            value = value.get(step)
        elif isinstance(value, tuple):
            named = (entry for entry in value if getattr(entry, "name", None) == step)
            value = next(named, value[int(step)] if step.isdecimal() and int(step) < len(value) else None)
        else:
            return None
    return value
