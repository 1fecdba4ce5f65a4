"""A key that follows another one: "-2 * gears.pinion.torque", "0.5 * segments.0.length + 3 mm"; parsed by our own code, in one form."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drivewright.errors import SpecError, brief
from drivewright.execution.keys import READABLE, KeyKind, key_kind
from drivewright.spec import MechanismSpec, read_value

NUMBER = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
KEY = r"[^\W\d][\w-]*(?:\.[\w-]+)*"
FORM = re.compile(
    rf"\s*=?\s*(?P<sign>[+-])?\s*(?:(?P<factor>{NUMBER})\s*\*\s*)?(?P<source>{KEY})(?:\s+(?P<side>[+-])\s*(?P<offset>[0-9.].*?))?\s*"
)
HOW = 'NUMBER * KEY + QUANTITY, such as "-2 * gears.pinion.torque" or "0.5 * segments.0.length + 3 mm"'
WHOLE = 1e-9  # of a whole number: rounding
LARGEST = 1e40  # of a factor


class Relation(NamedTuple):
    """`factor` times the value at the key `source`, and an `offset` with its unit as text, empty for none."""

    factor: float
    source: str
    offset: str = ""


def relation(text: str) -> Relation | None:
    """The `Relation` that a text says; None where it has another form."""
    match = FORM.fullmatch(text)
    if match is None:
        return None
    factor = float(match["factor"] or 1.0) * (-1 if match["sign"] == "-" else 1)
    return Relation(factor, match["source"], f"{match['side'].replace('+', '')}{match['offset']}" if match["offset"] else "")


@dataclass(frozen=True)
class Link:
    """A key of a kind that has `factor` times the value of another one plus `offset` [SI]; `text` says how, empty for the same value."""

    key: str
    kind: KeyKind
    factor: float = 1.0
    offset: float = 0.0
    text: str = ""

    @property
    def offset_text(self) -> str:
        """The offset as it is given, empty for none."""
        found = relation(self.text)
        return found.offset if found else ""

    def __str__(self) -> str:
        return f"{self.key} = {self.text}" if self.text else self.key

    def at(self, column: NDArray[Any]) -> NDArray[Any]:
        """Its values where the other key has those of a column (n,)."""
        if not self.text:
            return column
        values = self.factor * column + self.offset
        return np.round(values).astype(np.int64) if self.kind.name == "integer" else values

    def check(self, column: NDArray[Any], place: str) -> None:
        """SpecError where the other key has a value that no number of this one follows from."""
        if self.text and column.dtype.kind not in "iuf":
            word = next((each for each in column.tolist() if isinstance(each, str)), column[0])
            raise SpecError(f"{self.key} = {self.text}: takes numbers, but {brief(word)} is among the values there; take it out", place)
        values = self.factor * column + self.offset if self.text and self.kind.name == "integer" else np.zeros(0)
        off = np.abs(values - np.round(values)) > WHOLE * np.maximum(np.abs(values), 1)
        if np.any(off):
            raise SpecError(f"{self.key} takes whole numbers, but {self.text} gives {values[off][0]:g}; choose other levels", place)


def equal_link(spec: MechanismSpec, text: str, key: str, kind: KeyKind, place: str, values: Sequence[Any] = ()) -> Link:
    """The `Link` of an entry of `also` beside a key: a key that has the same value, or with a minus the negative one.

    Of a key that takes a number or a word, the `values` given decide.
    """
    negative = text.startswith("-")
    other = text.removeprefix("-").strip()
    found = key_kind(spec, other, place, values)
    if found != kind:
        raise SpecError(f"{other} cannot have the same value as {key}: they take different kinds of values", place)
    if negative and not kind.numeric:
        raise SpecError(f"{other} takes {READABLE[kind.name]}, which has no negative; leave out the minus", place)
    return Link(other, kind, -1.0, 0.0, f"-{key}") if negative else Link(other, kind)


def formula_link(spec: MechanismSpec, key: str, text: str, place: str) -> tuple[str, Link]:
    """(key that it follows, `Link`) of a key and the text of its relation."""
    found = relation(text)
    if found is None:
        raise SpecError(f"must be {HOW}; got {brief(text)}{_minus_hint(text)}", f"{place}.link")
    kind, source = key_kind(spec, key, f"{place}.key"), _source_kind(spec, found.source, f"{place}.link")
    _refuse_other_kind(key, kind, found.source, source, f"{place}.link")
    if not 0 < abs(found.factor) < LARGEST:
        raise SpecError(
            f"the factor must be a number other than 0, got {found.factor:g}; give {key} its value in the spec instead", f"{place}.link"
        )
    offset = _offset(kind, found.offset, f"{place}.link")
    return found.source, Link(key, kind, found.factor, offset, " ".join(text.split()))


def _source_kind(spec: MechanismSpec, key: str, place: str) -> KeyKind:
    """What the key takes that another one follows."""
    try:
        return key_kind(spec, key, place)
    except SpecError as error:
        raise SpecError(f"{error.message}{_minus_hint(key)}", place) from None


def _minus_hint(text: str) -> str:
    """What helps where a minus was read as a letter of a key."""
    return "; a minus behind a key needs a blank on its left" if re.search(r"\w-\s*[0-9]", text) else ""


def _refuse_other_kind(key: str, kind: KeyKind, source: str, other: KeyKind, place: str) -> None:
    """SpecError where no number times the one is the other."""
    for each, found in ((key, kind), (source, other)):
        if not found.numeric:
            raise SpecError(f"{each} takes {READABLE[found.name]}; a relation is between numbers", place)
    if kind.unit != other.unit:
        raise SpecError(f"{key} takes {_described(kind)} and {source} {_described(other)}; a relation is between keys of one kind", place)
    if kind.name == "integer" and other.name != "integer":
        raise SpecError(
            f"{key} takes whole numbers and {source} does not, so it cannot follow it; list the pairs in a file of points", place
        )


def _described(kind: KeyKind) -> str:
    return kind.dimension.described if kind.dimension else READABLE[kind.name]


def _offset(kind: KeyKind, text: str, place: str) -> float:
    """The offset of a relation [SI]."""
    if not text:
        return 0.0
    number = kind.difference.read(read_value(text), place)
    if isinstance(number, str) or not np.isfinite(number):
        raise SpecError(f"wants a number with a unit behind the key, got {brief(text)}", place)
    return float(number)
