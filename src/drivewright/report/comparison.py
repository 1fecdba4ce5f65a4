"""Several results of one kind side by side: their values, and how far they are apart."""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from drivewright.errors import InputError
from drivewright.labels import label_of
from drivewright.result import Result, Value
from drivewright.spec.differences import DifferingKey, differing_keys
from drivewright.units import System
from drivewright.view import draw_panels
from drivewright.view.overlays import overlay
from drivewright.view.text import SOLID, display_unit, number, numbers, uncertain, with_unit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_DESIGNS = 12  # of more, no table can be read and no curves can be told apart; a sweep has no such limit
ROUNDING = 1e-12  # of the larger number: a smaller difference is rounding
DIGITS = 4  # of a difference without an interval


class Difference(NamedTuple):
    """How far a number is from that of the first design [SI]; `relative` to its magnitude, None where that is 0.

    `certain` is False where the 95 % intervals of the two overlap; `low` and `high` are the ends of the difference, None without intervals.
    """

    absolute: float
    relative: float | None
    certain: bool = True
    low: float | None = None
    high: float | None = None


@dataclass(frozen=True)
class DesignComparison:
    """Results of one kind with a label each.  The first one is what the others are compared with."""

    results: tuple[Result[Any], ...]
    labels: tuple[str, ...]

    @property
    def mechanism(self) -> str:
        """The kind of drive."""
        return self.results[0].mechanism

    @property
    def values(self) -> dict[str, tuple[float | None, ...]]:
        """{name: the value of each design [SI]}, None where a design does not have it."""
        return {name: tuple(_number(result, name) for result in self.results) for name in self._names()}

    @property
    def units(self) -> dict[str, str]:
        """{name: SI unit}."""
        return {name: self.known(name).unit for name in self._names()}

    @property
    def system(self) -> System:
        """The system of units that all are shown in: that of the first spec."""
        return self.results[0].units

    def known(self, name: str) -> Value:
        """The value of that name of the first design that has it, for its unit, its label and its meaning."""
        return next(result.values[name] for result in self.results if name in result.values)

    def differences(self, name: str) -> tuple[Difference | None, ...]:
        """How far the value of each design is from that of the first one, None where one of the two does not have it."""
        first = self.results[0].values.get(name)
        return tuple(difference(first, result.values.get(name)) for result in self.results)

    @property
    def checks(self) -> dict[str, tuple[bool | None, ...]]:
        """{name: whether the check of each design passes}, None where a design does not make it."""
        made = [{check.name: bool(check.ok) for check in result.checks} for result in self.results]
        return {name: tuple(each.get(name) for each in made) for name in dict.fromkeys(name for each in made for name in each)}

    @property
    def differing_keys(self) -> tuple[DifferingKey, ...]:
        """The keys in which the specs differ."""
        return differing_keys([result.spec for result in self.results])

    @property
    def identical(self) -> tuple[tuple[str, ...], ...]:
        """The labels of designs whose specs differ in no key, two or more together."""
        groups: dict[int, list[int]] = {}
        for place, result in enumerate(self.results):
            first = next((each for each in groups if not differing_keys([self.results[each].spec, result.spec])), place)
            groups.setdefault(first, []).append(place)
        return tuple(tuple(self.labels[each] for each in group) for group in groups.values() if len(group) > 1)

    def record(self) -> dict[str, Any]:
        """Plain dictionary as in compare.json; None for what a design does not have.

        `values` {name: SI number of each design}, `units` {name: SI unit}, `checks` {name: whether that of each design passes} and
        `differing` {key of the specs: text of its value in each design}.
        """
        return {
            "mechanism": self.mechanism,
            "labels": list(self.labels),
            "values": {name: list(row) for name, row in self.values.items()},
            "units": self.units,
            "checks": {name: list(row) for name, row in self.checks.items()},
            "differing": {key: [None if value is None else entry_text(value) for value in row] for key, row in self.differing_keys},
        }

    def plot(self, name: str) -> "Figure":
        """A matplotlib Figure of a table or of one of the mechanism's plots: a panel for each quantity, in it a curve for each design."""
        return draw_panels(overlay(self.results, self.labels, name).panels)

    def _names(self) -> list[str]:
        names = dict.fromkeys(name for result in self.results for name in result.values)
        return [name for name in names if any(_number(result, name) is not None for result in self.results)]

    def __repr__(self) -> str:
        """One line; the numbers are in `values`."""
        return f"<DesignComparison {self.mechanism!r}: {', '.join(map(repr, self.labels))}>"

    def _repr_html_(self) -> str:
        """The values side by side for notebooks."""
        head = "".join(f"<th>{escape(label)}</th>" for label in self.labels)
        rows = "".join(
            f"<tr><td>{escape(label_of(self.known(name).meaning, self.known(name).label))}</td>"
            + "".join(f"<td>{escape(value_text(result.values.get(name), self.system))}</td>" for result in self.results)
            + f"<td>{escape(name)}</td></tr>"
            for name in self._names()
        )
        return f"<table><tr><th></th>{head}<th></th></tr>{rows}</table>"


def compare(results: Sequence[Result[Any]], labels: Sequence[str] = ()) -> DesignComparison:
    """Results of one kind side by side, each under its label; unless labels are given, under its title, numbered where titles are equal.

    InputError for fewer than two results or more than `MOST_DESIGNS`, for results of several kinds, and for labels that are not one each.
    """
    results = tuple(results)
    check_count(len(results))
    check_kinds([result.mechanism for result in results])
    labels = tuple(labels) or distinct([result.title or result.mechanism for result in results])
    check_labels(labels, len(results))
    return DesignComparison(results, tuple(labels))


def check_count(count: int) -> None:
    """InputError for a number of designs that cannot be compared on a page."""
    if count < 2:
        raise InputError(f"a comparison needs at least two designs, got {count}")
    if count > MOST_DESIGNS:
        raise InputError(f"a comparison shows at most {MOST_DESIGNS} designs, got {count}; `drivewright sweep` computes any number")


def check_kinds(kinds: Sequence[str]) -> None:
    """InputError unless all are one kind of drive."""
    if len(set(kinds)) > 1:
        raise InputError(
            f"designs of one kind can be compared, and these are {', '.join(dict.fromkeys(kinds))}; compare those of each kind apart"
        )


def check_labels(labels: Sequence[str], count: int) -> None:
    """InputError unless there is one label for each design, each another."""
    if len(labels) != count:
        raise InputError(f"{len(labels)} labels for {count} designs; give one for each, or none")
    if not all(label.strip() for label in labels):
        raise InputError("a label is empty; give each design a name, or no labels at all")
    twice = [label for label, times in Counter(labels).items() if times > 1]
    if twice:
        raise InputError(f"the label {twice[0]!r} stands for two designs; give each its own")


def distinct(names: Sequence[str]) -> tuple[str, ...]:
    """The names, numbered from the second one on where they are equal: 'Cam', 'Cam (2)'."""
    found: list[str] = []
    for name in names:
        tries = (name if n == 1 else f"{name} ({n})" for n in range(1, len(names) + 1))
        found.append(next(each for each in tries if each not in found))
    return tuple(found)


def _number(result: Result[Any], name: str) -> float | None:
    value = result.values[name].value if name in result.values else math.nan
    return float(value) if math.isfinite(value) else None


# -- differences ---------------------------------------------------------------------------------------------------------------


def difference(first: Value | None, other: Value | None) -> Difference | None:
    """How far `other` is from `first`; None where one of them does not exist, or where they are in different units."""
    if first is None or other is None or first.unit != other.unit or not (math.isfinite(first.value) and math.isfinite(other.value)):
        return None
    apart = other.value - first.value
    if abs(apart) <= ROUNDING * max(abs(first.value), abs(other.value)):
        return Difference(0.0, 0.0)
    relative = apart / abs(first.value) if first.value else None
    ends = [_ends(value) for value in (first, other)]
    if all(low == high for low, high in ends):
        return Difference(apart, relative)
    (low, high), (below, above) = ends
    return Difference(apart, relative, not (below <= high and low <= above), below - high, above - low)


def _ends(value: Value) -> tuple[float, float]:
    """(low, high) of a value, the value itself where it has no such bound."""
    low, high = (value.value if end is None or not math.isfinite(end) else float(end) for end in (value.low, value.high))
    return low, high


def value_text(value: Value | None, system: System = "mm") -> str:
    """A value as people read it, with its interval; a dash where there is none."""
    if value is None or not math.isfinite(value.value):
        return "–"
    return uncertain(value.value, value.unit, value.low, value.high, system=system)


def identical_text(labels: Sequence[str]) -> str:
    """One sentence about designs that are the same."""
    return f"{', '.join(labels[:-1])} and {labels[-1]} are identical: their specs differ in no key"


def entry_text(value: object) -> str:
    """An entry of a spec as people read it, a dash where there is none; a data file by its name."""
    if value is None:
        return "–"
    if isinstance(value, str):
        return Path(value).name if Path(value).is_absolute() else value
    return str(value).lower() if isinstance(value, bool) else str(value)


def difference_text(apart: Difference | None, unit: str, system: System = "mm") -> str:
    """'+1.2 mm (+3.4 %)', '0' where there is no difference, '' where none can be told."""
    if apart is None:
        return ""
    if apart.absolute == 0:
        return "0"
    factor, text = display_unit(unit, system)
    low, high = (None if end is None else end * factor for end in (apart.low, apart.high))
    told = with_unit(_signed(numbers(apart.absolute * factor, low, high, DIGITS)[0]), text)
    return f"{told} ({percent_text(apart.relative)})" if apart.relative is not None else told


def percent_text(relative: float) -> str:
    """'+3.4 %' of a relative difference."""
    return f"{_signed(number(100 * relative, 3))}{SOLID}%"


def _signed(text: str) -> str:
    return text if text.startswith("−") or text == "0" else f"+{text}"
