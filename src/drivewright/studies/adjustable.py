"""The dimensions of a design that may be changed to correct it: the unknowns of its [optimise] table, or what its kind calls adjustable."""

import math
from collections.abc import Iterator, Mapping
from fnmatch import fnmatchcase
from typing import Any, NamedTuple

from drivewright import registry
from drivewright.errors import SpecError
from drivewright.execution.keys import KeyKind, key_kind
from drivewright.spec import MechanismSpec, document, value_at
from drivewright.spec.keys import key_by_name, leaves
from drivewright.studies.nominal import supplied_values

STEP = 0.02  # of a dimension, for its sensitivity: large against rounding, small against what is advised


class Dimension(NamedTuple):
    """A key that may be changed, its value [SI], and the ends between which it may lie."""

    key: str
    kind: KeyKind
    value: float
    low: float
    high: float

    def at(self, move: float) -> float:
        """The value after a move: -1 is its lower end, 1 its upper one; between them by equal factors, of a key at 0 by equal steps."""
        end = self.high if move > 0 else self.low
        share = min(abs(move), 1.0)
        if self.value and end / self.value > 0:
            return self.value * (end / self.value) ** share
        return self.value + (end - self.value) * share

    @property
    def step(self) -> float:
        """A move by about `STEP` of the value, or of the range where it is 0; to the side that has room."""
        width = max(self.high - self.value, self.value - self.low)
        size = STEP * (abs(self.value) / width if self.value else 1.0)
        return min(size, 0.5) if self.high > self.value else -min(size, 0.5)

    def read(self, text: str) -> float:
        """A value [SI] as it is written into a spec."""
        return float(self.kind.read(text if self.kind.dimension else float(text), self.key))


def dimensions(spec: MechanismSpec) -> tuple[Dimension, ...]:
    """The keys of a spec that advice may change: the unknowns of its [optimise] table, else those that its kind calls adjustable."""
    if spec.optimise is not None:
        found = [_unknown(spec, each.key, each.lower, each.upper) for each in spec.optimise.unknowns]
    else:
        supplied = supplied_values(spec)
        found = [_adjustable(spec, key, factor, supplied) for key, factor in _adjustable_keys(spec, supplied)]
    return tuple(each for each in found if each is not None and each.low < each.high)


def _unknown(spec: MechanismSpec, key: str, lower: Any, upper: Any) -> Dimension | None:
    kind, value = key_kind(spec, key), value_at(spec, key)
    if kind.name not in ("quantity", "number") or not isinstance(value, float):
        return None
    low, high = kind.read(lower, "optimise.unknowns"), kind.read(upper, "optimise.unknowns")
    return Dimension(key, kind, value, min(low, value), max(high, value))


def _adjustable(spec: MechanismSpec, key: str, factor: float, supplied: Mapping[str, float]) -> Dimension | None:
    """A dimension that may be so many times larger or smaller; None where the key has no such number."""
    try:
        kind = key_kind(spec, key)
    except SpecError:  # a file, or a list that is one value
        return None
    value = value_at(spec, key)
    value = supplied.get(key) if value is None else value
    if kind.name not in ("quantity", "number") or not isinstance(value, float) or not value or not math.isfinite(value):
        return None
    low, high = sorted((value / factor, value * factor))
    return Dimension(key, kind, value, low, high)


def _adjustable_keys(spec: MechanismSpec, supplied: Mapping[str, float]) -> Iterator[tuple[str, float]]:
    """(key, greatest factor) of what the kind calls adjustable and the spec, or a catalogue, has."""
    adjustable = registry.mechanism(spec.mechanism).adjustable
    given = [key_by_name(spec, key) for key, _ in leaves(document(spec))]
    for key in dict.fromkeys((*given, *supplied)):
        factor = next((each for pattern, each in adjustable.items() if fnmatchcase(key, pattern)), None)
        if factor is not None:
            yield key, factor
