"""What a key of a spec takes: a quantity, a number, a whole number, a flag or a text."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from drivewright.errors import SpecError, UnitError, brief, nearest
from drivewright.spec import Spec, dimension_at, value_at
from drivewright.spec.fields import choices_of, containers_of, field_at, table_at, type_of
from drivewright.units import SI, TEMPERATURE_DIFFERENCE, Dimension


@dataclass(frozen=True)
class KeyKind:
    """What a key takes: `name` quantity, number, integer, flag or text; the Dimension of a quantity, the choices where there are some."""

    name: str
    dimension: Dimension | None = None
    choices: tuple[Any, ...] = ()

    @property
    def unit(self) -> str:
        """SI unit of its column; empty for text."""
        return self.dimension.unit if self.dimension else "-" if self.name in ("number", "integer") else ""

    @property
    def numeric(self) -> bool:
        """Whether it has a distribution and a range."""
        return self.name in ("quantity", "number", "integer")

    @property
    def difference(self) -> "KeyKind":
        """What the difference of two of its values is: of temperatures "5 degC" is 5 K then."""
        is_temperature = self.dimension is not None and self.dimension.name == "temperature"
        return replace(self, dimension=TEMPERATURE_DIFFERENCE) if is_temperature else self

    def reading(self, value: Any) -> str:
        """What a value is read as where its unit is one of another kind, "10 rev/s" for "10 Hz"; "" where it says what it is."""
        return self.dimension.reading(value) if self.dimension and isinstance(value, str) else ""

    def read(self, value: Any, place: str) -> Any:
        """A level in SI; SpecError at `place`."""
        if self.dimension:
            try:
                return self.dimension.parse(value)
            except UnitError as error:
                raise error.located(place) from None
        wanted = {"number": (int, float), "integer": int, "flag": bool, "text": str}[self.name]
        if not isinstance(value, wanted) or (isinstance(value, bool) and self.name != "flag"):
            raise SpecError(f"wants {READABLE[self.name]}, got {brief(value)}", place)
        if self.name == "integer" and abs(value) > 2**53:
            raise SpecError(f"is too large a whole number: {brief(value)}", place)
        if self.choices and value not in self.choices:
            raise SpecError(f"must be one of {', '.join(map(str, self.choices))}, got {brief(value)}{nearest(value, self.choices)}", place)
        return float(value) if self.name == "number" else value

    def given(self, value: Any) -> Any:
        """An entry of its column as a spec takes it; a text stands for itself, also where a number may."""
        if isinstance(value, str):
            return str(value)
        return {"quantity": SI, "number": float, "integer": int, "flag": bool, "text": str}[self.name](value)


READABLE = {"number": "a number", "integer": "a whole number", "flag": "true or false", "text": "a text"}


def key_kind(spec: Spec, key: str, place: str = "study.vary", given: Sequence[Any] = ()) -> KeyKind:
    """The `KeyKind` of a key; SpecError, with the nearest known name, where the spec has no such key.

    Of a key that takes a number or a word, the values `given` for it decide.
    """
    if key.split(".")[0] in FIXED:
        raise SpecError(f"{key} cannot vary: it states {FIXED[key.split('.')[0]]}", place)
    exists, dimension = dimension_at(type(spec), key)
    if not exists or _missing_element(spec, key):
        raise SpecError(f"this spec has no key {key!r}{_missing_element(spec, key) or _nearest_keys(spec, key)}", place)
    field = field_at(type(spec), key.split("."))
    annotation = field.annotation if field else None
    if depth := len(containers_of(annotation)) - _element_steps(spec, key):
        holder = key.rpartition(".")[0]
        if holder and value_at(spec, holder) is None and key.rpartition(".")[2].isdecimal():
            raise SpecError(f"{holder} has no value in this spec; give all of it there, then one of its elements can vary", place)
        raise SpecError(f"{key} holds {'several values' if depth == 1 else 'lists'}, not one; name an element, e.g. {key}.0", place)
    if dimension:
        return KeyKind("quantity", dimension)
    choices, plain = choices_of(annotation), type_of(annotation)
    if choices and (plain is None or (given and all(value in choices for value in given))):
        return KeyKind(KINDS[type(choices[0])], choices=tuple(choices))
    if plain not in KINDS:
        raise SpecError(f"{key} is a table or a file, not one value; name a key in it", place)
    return KeyKind(KINDS[plain])


def _element_steps(spec: Spec, key: str) -> int:
    """How many of the steps of a key stand for elements of the list or dictionary at its end."""
    steps = key.split(".")
    holders = [type(value_at(spec, ".".join(steps[:n]))) if n else None for n in range(len(steps))]
    count = 0
    for holder in reversed(holders):
        if holder is None or not issubclass(holder, (tuple, dict)):
            break
        count += 1
    return count


KINDS = {float: "number", int: "integer", bool: "flag", str: "text"}
# Keys that cannot vary, and what they say.
FIXED = dict.fromkeys(("format", "mechanism", "study", "optimise"), "what the study is of") | {
    "units": "what results are shown in",
    "report": "how the report looks",
}


def _missing_element(spec: Spec, key: str) -> str:
    """What a list or a `Named` table has instead of the element that a key names; empty where nothing is missing."""
    steps = key.split(".")
    for number in range(1, len(steps)):
        holder = value_at(spec, ".".join(steps[:number]))
        if isinstance(holder, (tuple, dict)) and value_at(spec, ".".join(steps[: number + 1])) is None:
            names = list(holder) if isinstance(holder, dict) else [getattr(entry, "name", None) or str(n) for n, entry in enumerate(holder)]
            return f": {'.'.join(steps[:number])} has {', '.join(names) or 'no elements'}{nearest(steps[number], names)}"
    return ""


def _nearest_keys(spec: Spec, key: str) -> str:
    """The known keys of the table in which the last good step ends."""
    steps = key.split(".")
    for number in range(len(steps) - 1, -1, -1):
        table = table_at(type(spec), steps[:number])
        if table is not None:
            known = [".".join([*steps[:number], name]) for name in table.model_fields if number or name not in FIXED]
            return f"{nearest('.'.join(steps[: number + 1]), known)}; known there: {', '.join(known)}"
    return ""
