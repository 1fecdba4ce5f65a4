"""The conformance suite: requirements on every kind of drive, built in or from other packages.

In a package that brings a drive::

    import pytest
    from drivewright.testing import cases

    @pytest.mark.parametrize("case", cases("pendulum"), ids=str)
    def test_conformance(case):
        if (reason := case.check()):
            pytest.skip(reason)

A case is one subject of one preset.  `check` raises AssertionError where a promise is broken, and gives the reason where the kind makes
none.  Subjects that hold for any drive need no claim: a spec written in other units is the same spec; the record of a run is strict JSON
whose numbers have units, labels and meanings, and its spec gives the same numbers again.  The others are stated by the kind as `claims`.
"""

import json
import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from drivewright import registry, runner
from drivewright.claims import SUBJECTS, Balance, Claims, Derivative, Limit, Mirror, Scaling
from drivewright.errors import UnitError
from drivewright.labels import duplicates, faults, label_of, label_of_key
from drivewright.result import Plot, Result
from drivewright.spec import MechanismSpec, document, from_document, load, set_key
from drivewright.spec.fields import table_of
from drivewright.units import DIMENSIONS, Dimension, any_quantity, decimal_text, exact_factor, split

DIGITS = 40  # of a converted number: far more than a float has
OTHER_UNITS = {  # what people elsewhere write, by the unit that we read
    "mm": "in",
    "deg": "rad",
    "rpm": "rad/s",
    "N": "lbf",
    "kg": "lb",
    "MPa": "psi",
    "s": "min",
    "N/mm": "lbf/in",
    "m/s": "in/s",
    "N m": "lbf in",
}


@dataclass(frozen=True)
class Case:
    """One subject of the suite for one preset of a kind."""

    kind: str
    preset: str
    subject: str

    def __str__(self) -> str:
        return f"{self.kind}-{self.preset}-{self.subject}"

    def check(self) -> str:
        """AssertionError where the promise is broken; the reason, where the kind does not make it for this preset; else ""."""
        spec = _spec(self.kind, self.preset)
        if self.subject in _OF_ANY_DRIVE:
            _OF_ANY_DRIVE[self.subject](spec)
            return ""
        stated = registry.mechanism(self.kind).claims
        claims = stated(spec) if stated else Claims()
        for claim in getattr(claims, self.subject):
            _OF_A_CLAIM[type(claim)](spec, claim)
        return (
            ""
            if getattr(claims, self.subject)
            else claims.reasons.get(self.subject, f"{self.kind} claims nothing on {self.subject} of this preset")
        )


def cases(kind: str | None = None) -> list[Case]:
    """Every case of a kind, or of all kinds that are installed."""
    kinds = registry.kinds() if kind is None else [kind]
    subjects = (*_OF_ANY_DRIVE, *SUBJECTS)
    return [Case(each, preset, subject) for each in kinds for preset in registry.mechanism(each).presets() for subject in subjects]


@lru_cache(maxsize=64)
def _spec(kind: str, preset: str) -> MechanismSpec:
    """The preset, without what it would study or optimise."""
    return load(registry.mechanism(kind).presets()[preset])


@lru_cache(maxsize=16)
def _run(text: str, folder: str, only: tuple[str, ...]) -> Result[Any]:
    """A run of a spec given as canonical TOML text: several cases ask for the same one."""
    import tomllib

    return runner.run(from_document(tomllib.loads(text), folder=folder), only)


_whole_run = lru_cache(maxsize=64)(_run.__wrapped__)  # of presets: many cases ask for them, and the labels after all of those


def _result(spec: MechanismSpec, only: Iterable[str] = ()) -> Result[Any]:
    runs = _run if only else _whole_run
    return runs(spec.to_toml(), str(Path.cwd()), tuple(only))


def _changed(spec: MechanismSpec, changes: Mapping[str, Any]) -> MechanismSpec:
    """The spec with dotted keys changed; quantities in SI."""
    tables = document(spec)
    for key, value in changes.items():
        set_key(tables, key, value)
    return from_document(tables, type(spec))


# -- any drive -----------------------------------------------------------------------------------------------------------------


def _other_units(spec: MechanismSpec) -> None:
    """Written in inches, radians, pounds and minutes, it is the same spec to the last bit: same digest, so same numbers."""
    tables = _converted(document(spec))
    assert tables != document(spec), "no quantity of the preset has another unit: nothing is tested"
    other = from_document(tables, type(spec))
    assert other.digest() == spec.digest(), f"other units change the spec: {_difference(document(spec), document(other))}"


def _converted(value: Any) -> Any:
    """Raw tables with every quantity in another unit, to so many digits that the float is the same."""
    if isinstance(value, dict):
        return {key: _converted(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [_converted(inner) for inner in value]
    return _in_other_unit(value) if isinstance(value, str) else value


def _in_other_unit(text: str) -> str:
    try:
        number, unit = split(text)
        _, dimensionality = any_quantity(text)
    except UnitError:
        return text  # a name, a title
    other = OTHER_UNITS.get(unit)
    dimension = next((each for each in DIMENSIONS if other and _fits(each, unit) and _fits(each, other)), None)
    if dimension is None or other is None:
        return text
    return f"{decimal_text(number * exact_factor(unit) / exact_factor(other), DIGITS)} {other}"


def _fits(dimension: Dimension, unit: str) -> bool:
    try:
        dimension.factor(unit)
    except UnitError:
        return False
    return True


def _difference(one: Any, other: Any, path: str = "") -> str:
    """Where two raw documents differ first."""
    if isinstance(one, dict) and isinstance(other, dict):
        differences = (_difference(one.get(key), other.get(key), f"{path}.{key}") for key in {*one, *other})
        return next((text for text in differences if text), "")
    if isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        differences = (_difference(a, b, f"{path}.{number}") for number, (a, b) in enumerate(zip(one, other, strict=True)))
        return next((text for text in differences if text), "")
    return "" if one == other else f"{path[1:]}: {one!r} and {other!r}"


def _record(spec: MechanismSpec) -> None:
    """Strict JSON; every number with unit, label and meaning; every column too; the written spec gives the same spec again."""
    result = _result(spec)
    record = json.loads(json.dumps(result.record(), allow_nan=False))
    for name, value in record["values"].items():
        assert re.fullmatch(r"[a-z0-9_]+(\.[A-Za-z0-9_ ()-]+)*", name), f"value {name!r} is no dotted lower-case name"
        assert value["unit"] and value["label"] and value["meaning"], f"value {name!r} lacks unit, label or meaning"
    for table in result.tables.values():
        assert table.title, f"table {table.name!r} has no title"
        for column in table.columns:
            assert column.unit and column.meaning, f"column {column.name!r} of table {table.name!r} lacks unit or meaning"
            assert len(column.data) == len(table.columns[0].data), f"column {column.name!r} of table {table.name!r} has another length"
    again = from_document(document(spec), type(spec))
    assert again.digest() == spec.digest(), f"the written spec reads back as another: {_difference(document(spec), document(again))}"


_OF_ANY_DRIVE: dict[str, Callable[[Any], None]] = {"units": _other_units, "record": _record}


# -- labels --------------------------------------------------------------------------------------------------------------------


def label_faults(kind: str, preset: str) -> tuple[str, ...]:
    """What is wrong with the labels of a preset's spec and result, one line each: "value 'Of a pin': leans on another ..."."""
    spec = _spec(kind, preset)
    result = _result(spec)
    groups = {
        "value": [label_of(value.meaning, value.label) for value in result.values.values()],
        "check": [check.display_label for check in result.checks],
        "plot": [plot.title for plot in _plots(kind, result)],
        "table": [table.title for table in result.tables.values()],
    }
    faults = [line for what, labels in groups.items() for line in _faulty(what, labels)]
    for table in result.tables.values():
        faults += _faulty(f"column of {table.title!r}", [label_of(column.meaning, column.label) for column in table.columns])
    for place, fields in _tables_of(type(spec)):
        faults += _faulty(f"field of {place}", [label_of_key(name, field.title) for name, field in fields.items()])
    return tuple(dict.fromkeys(faults))


def _faulty(what: str, labels: list[str]) -> Iterator[str]:
    for label in labels:
        yield from (f"{what} {label!r}: {fault}" for fault in faults(label))
    yield from (f"{what} {label!r}: stands more than once" for label in duplicates(labels))


def _plots(kind: str, result: Result[Any]) -> Iterable[Plot]:
    plots = registry.mechanism(kind).plots
    return plots(result) if callable(plots) else plots


def _tables_of(model: type[Any]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """(name of a table class, its fields), the spec's own and those inside."""
    seen, waiting = set(), [model]
    while waiting:
        table = waiting.pop()
        if table not in seen:
            seen.add(table)
            yield table.__name__, table.model_fields
            waiting += [inner for field in table.model_fields.values() if (inner := table_of(field.annotation))]


# -- claims --------------------------------------------------------------------------------------------------------------------


def _derivative(spec: MechanismSpec, claim: Derivative) -> None:
    """Between neighbouring samples the mean rate lies between the rates at the ends, to the tolerance."""
    result = _result(spec)
    assert claim.table in result.tables, f"no table {claim.table!r}"
    table = result.tables[claim.table]
    over, position, rate = (np.asarray(table[name].data, float) for name in (claim.over, claim.position, claim.rate))
    step = np.diff(over)
    use = step > 1e-6 * np.ptp(over)  # a jump has two samples at one place
    mean = np.diff(position)[use] / step[use]
    ends = np.stack([rate[:-1], rate[1:]])[:, use] / claim.per
    size = np.max(np.abs(ends))
    beyond = np.maximum(mean - ends.max(axis=0), ends.min(axis=0) - mean)
    if size == 0.0 and np.ptp(position) == 0.0:
        return
    worst = int(np.argmax(beyond))
    assert beyond[worst] <= claim.tolerance * size, (
        f"{claim.rate} is not the derivative of {claim.position} by {claim.over}: near {over[:-1][use][worst]:.6g} the mean rate is "
        f"{mean[worst]:.6g}, those at the ends {ends[0, worst]:.6g} and {ends[1, worst]:.6g}"
    )


def _balance(spec: MechanismSpec, claim: Balance) -> None:
    result = _result(spec, claim.analyses)
    value = result[claim.name] if claim.name in result.values else result.check(claim.name).value
    assert abs(value) <= claim.limit, f"{claim.name} = {value:.3g}, more than {claim.limit:.3g}"


def _scaling(spec: MechanismSpec, claim: Scaling) -> None:
    """The values of the doubled key over those of the spec."""
    single = _result(spec, claim.analyses)
    double = _result(_changed(spec, {claim.key: _scaled(spec, claim.key, 2)}), claim.analyses)
    for name, one in _matching(single, claim.exponents):
        wanted = one * 2.0 ** next(power for pattern, power in claim.exponents.items() if fnmatchcase(name, pattern))
        assert math.isclose(double[name], wanted, rel_tol=claim.tolerance), (
            f"{name} at twice {claim.key}: {double[name]:.9g}, not {wanted:.9g}"
        )


def _matching(result: Result[Any], patterns: Iterable[str]) -> Iterator[tuple[str, float]]:
    """(name, value) of the values that a pattern names; every pattern names one at least."""
    for pattern in patterns:
        names = [name for name in result.values if fnmatchcase(name, pattern)]
        assert names, f"no value is called {pattern!r}"
        yield from ((name, result[name]) for name in names)


def _mirror(spec: MechanismSpec, claim: Mirror) -> None:
    image = from_document(claim.image(document(spec)), type(spec))
    one, other = _result(spec, claim.analyses), _result(image, claim.analyses)
    assert set(one.values) == set(other.values), f"the mirror image has other values: {set(one.values) ^ set(other.values)}"
    for name, value in one.values.items():
        if any(fnmatchcase(name, pattern) for pattern in claim.left_out):
            continue
        sign = -1.0 if any(fnmatchcase(name, pattern) for pattern in claim.odd) else 1.0
        scale = max(abs(each.value) for each in one.values.values() if each.unit == value.unit)
        assert abs(other[name] - sign * value.value) <= claim.tolerance * max(scale, abs(value.value)), (
            f"{name} of the mirror image is {other[name]:.9g}, not {sign * value.value:.9g}"
        )


def _limit(spec: MechanismSpec, claim: Limit) -> None:
    """The difference from the limit, at the factors: it falls by their ratio to the power of the order."""
    gaps = []
    goal = _result(_changed(spec, claim.towards), claim.analyses)[claim.value] if isinstance(claim.towards, Mapping) else claim.towards
    for factor in claim.factors:
        result = _result(_changed(spec, {key: _scaled(spec, key, factor) for key in claim.keys}), claim.analyses)
        gaps.append(abs(result[claim.value] - goal))
    assert gaps[0] > 0.0, f"{claim.value} is at its limit already: nothing is tested"
    for (near, far), (first, second) in zip(_pairs(claim.factors), _pairs(gaps), strict=True):
        slope = math.log(first / second) / math.log(far / near)
        assert abs(slope - claim.order) <= 0.1, f"{claim.value} tends to {goal:.9g} with order {slope:.3f}, not {claim.order:g}"


def _scaled(spec: MechanismSpec, key: str, factor: float) -> str:
    """The text of a quantity times a factor."""
    text: Any = document(spec)
    for step in key.split("."):
        text = text[int(step)] if isinstance(text, list) and step.isdecimal() else _named(text, step)
    number, unit = split(text)
    return f"{float(number) * factor!r} {unit}"


def _named(table: Any, step: str) -> Any:
    """The entry of a table, or of a list whose tables have names."""
    return next(entry for entry in table if entry.get("name") == step) if isinstance(table, list) else table[step]


def _pairs(sequence: Iterable[float]) -> list[tuple[float, float]]:
    items = list(sequence)
    return list(zip(items[:-1], items[1:], strict=True))


_OF_A_CLAIM: dict[type, Callable[[Any, Any], None]] = {
    Derivative: _derivative,
    Balance: _balance,
    Scaling: _scaling,
    Mirror: _mirror,
    Limit: _limit,
}
