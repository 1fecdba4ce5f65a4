"""What comes out: values, tables, checks and findings that remember what they came from.

A result is a value: frozen, picklable, SI throughout, every number with a unit and a meaning.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Generic, NamedTuple, Protocol, TypeAlias, TypeVar

import numpy as np

from drivewright.errors import UnknownName

SpecT = TypeVar("SpecT", bound="SpecLike")


class SpecLike(Protocol):
    """What a run wants of a spec; `spec.MechanismSpec` has it."""

    mechanism: str
    title: str

    def digest(self) -> str:
        """SHA-256 of the effective spec."""
        ...


class Value(NamedTuple):
    """One number [SI unit] and what it means; where it is uncertain with its 95 % interval.

    `interval` says how that was made: "ensemble" or "windows" of a chaotic run, "visits", "sample", "fit", "periodic" (rounding).  A bound
    that is None is not known; a value without interval is exact to its printed digits.  What has not `settled`, a statistic that still
    drifted when its run ended, is no property of the design yet: it is in the result, but never among the headline values.
    `error` is the standard error, for those who average over many values; result.json does not have it.
    """

    value: float
    unit: str
    meaning: str
    low: float | None = None
    high: float | None = None
    interval: str = ""
    settled: bool = True
    error: float | None = None

    @classmethod
    def of(cls, estimate: Any, unit: str, meaning: str) -> "Value":
        """The value of a `numerics.ensemble.Estimate`: whatever has value, low, high, interval and settled."""
        return cls(estimate.value, unit, meaning, estimate.low, estimate.high, estimate.interval, estimate.settled, estimate.error).plain()

    def plain(self) -> "Value":
        """The same in Python's own floats; a bound that is not finite is None, and without any bound there is no interval."""
        low, high, error = (float(each) if each is not None and math.isfinite(each) else None for each in (self.low, self.high, self.error))
        interval = self.interval if (low, high) != (None, None) else ""
        return self._replace(value=float(self.value), low=low, high=high, interval=interval, error=error)

    def record(self) -> dict:
        """Plain dictionary as in result.json: `low`, `high` and `interval` where it has them, `settled` where it has not."""
        plain = self.plain()
        bounds = {name: end for name, end in (("low", plain.low), ("high", plain.high)) if end is not None}
        how = {"interval": plain.interval} if plain.interval else {}
        unsettled = {} if plain.settled else {"settled": False}
        return {"value": plain.value, "unit": plain.unit, "meaning": plain.meaning, **bounds, **how, **unsettled}


LOW, HIGH, ERROR = ".low", ".high", ".error"  # behind the name of a column: ends of its 95 % intervals; in studies its standard errors


UNDECIDED = "undecided: the limit lies within the interval"


class Array(NamedTuple):
    """A labelled array: `axes` names each axis, `labels` its entries."""

    unit: str
    axes: tuple
    labels: tuple
    values: np.ndarray


class Column(NamedTuple):
    """One column of a table [SI unit]."""

    name: str
    unit: str
    meaning: str
    data: np.ndarray

    def bounds(self, low: np.ndarray, high: np.ndarray) -> tuple:
        """The columns NAME.low and NAME.high with the ends of its 95 % intervals, nan where it has none; they go beside it."""
        return (
            self._replace(name=f"{self.name}{LOW}", meaning=f"{self.meaning}, at least", data=np.asarray(low, float)),
            self._replace(name=f"{self.name}{HIGH}", meaning=f"{self.meaning}, at most", data=np.asarray(high, float)),
        )


@dataclass(frozen=True)
class Table:
    """Columns of equal length, the first the independent variable; NAME.low and NAME.high are the ends of the 95 % intervals of NAME."""

    name: str
    title: str
    columns: tuple

    def __getitem__(self, name):
        for column in self.columns:
            if column.name == name:
                return column
        raise UnknownName(f"column of table {self.name!r}", name, [c.name for c in self.columns])

    def bounds_of(self, name):
        """(low, high): the columns with the ends of the intervals of a column, None where it has none."""
        known = {column.name: column for column in self.columns}
        ends = known.get(f"{name}{LOW}"), known.get(f"{name}{HIGH}")
        return ends if name in known and None not in ends else None

    def bounded(self, name):
        """The name of the column whose interval ends are in the column `name`; "" where that is a column of its own."""
        owner = next((name.removesuffix(end) for end in (LOW, HIGH) if name.endswith(end)), "")
        return owner if owner and self.bounds_of(owner) else ""

    def arrow(self):
        """The same as a pyarrow.Table; `unit` and `meaning` in the metadata of each field, and whose interval it `bounds`."""
        import pyarrow as pa

        about = [{"unit": c.unit, "meaning": c.meaning, **({"bounds": of} if (of := self.bounded(c.name)) else {})} for c in self.columns]
        fields = [pa.field(c.name, pa.array(c.data).type, metadata=each) for c, each in zip(self.columns, about, strict=True)]
        return pa.Table.from_arrays([pa.array(c.data) for c in self.columns], schema=pa.schema(fields, metadata={"title": self.title}))


class Check(NamedTuple):
    """A design requirement: `value sense limit`, e.g. 0.86 >= 1.0, with the parts it concerns.

    `low` and `high` are the ends of the value's 95 % interval, where it has one: `Check.of(value, name, ...)` takes them over.
    """

    name: str
    value: float
    limit: float
    sense: str  # "<=" or ">="
    unit: str
    message: str
    parts: tuple = ()
    geometry: bool = False  # a part with this check failed should not be manufactured
    low: float | None = None
    high: float | None = None

    @classmethod
    def of(cls, value: Value, name: str, limit: float, sense: str, message: str, parts: tuple = ()) -> "Check":
        """The check of a `Value`, with its unit and its interval."""
        plain = value.plain()
        return cls(name, plain.value, limit, sense, plain.unit, message, parts, low=plain.low, high=plain.high)

    @property
    def undecided(self):
        """Whether the limit lies within the interval of the value; `ok` is decided by the value all the same."""
        return self.bounds is not None and self.bounds[0] < float(self.limit) < self.bounds[1]

    @property
    def bounds(self):
        """(low, high) of the value, None where it has no interval."""
        ends = [float(end) for end in (self.low, self.high) if end is not None and math.isfinite(end)]
        return tuple(ends) if len(ends) == 2 else None

    @property
    def margin(self):
        """Distance to the limit, positive on the good side."""
        return self.limit - self.value if self.sense == "<=" else self.value - self.limit

    @property
    def margin_bounds(self):
        """(low, high) of the margin, None where the value has no interval."""
        ends = self.bounds and [self._replace(value=end).margin for end in self.bounds]
        return tuple(sorted(ends)) if ends else None

    @property
    def ok(self):
        """Whether the limit is kept; rounding in the ninth digit does not decide."""
        return bool(self.margin >= -1e-9 * max(abs(self.limit), abs(self.value)))  # numpy's own bool is none for JSON

    def record(self):
        """Plain dictionary as in result.json."""
        numbers = {"value": float(self.value), "limit": float(self.limit), "sense": self.sense, "margin": float(self.margin)}
        bounds = {"low": self.bounds[0], "high": self.bounds[1], "undecided": self.undecided} if self.bounds else {}
        said = {"unit": self.unit, "ok": self.ok, "message": self.message, "parts": list(self.parts)}
        return {"name": self.name, **numbers, **bounds, **said}


class Plot(NamedTuple):
    """How to look at a table: y columns over an x column; `equal` for geometry.

    Columns with intervals (NAME.low and NAME.high in the table) are drawn with a band, or with error bars.

    `limits` are (value, label) lines; a value that is text names a check whose limit is drawn, with "-" in front its negative.
    `reference` names the columns that the y columns are compared with, in the same order; they are dashed.
    Style "mesh" (with `equal`) draws a surface seen from the side, three rows of the table a triangle, corners counter-clockwise as seen
    from outside: x to the right; y names the columns (up, away from the viewer, what the colour shows); reference names
    (right, up) of the same surface before, whose silhouette is dashed.
    Style "map" colours cells: a row of the table is a cell, y names the columns (second axis, what the colour shows), both axes are
    numbers or texts; `limits` are contours of the colour.
    Style "histogram" counts the samples in its one y column (x is not looked at); `limits` stand upright.
    Style "ranked" draws lying bars, one for each row: x holds their labels, y the columns (several: side by side), the largest
    magnitude of the first on top; reference names its (lower, upper) ends of error bars.
    Style "points" with `by` marks each group with its own shape; groups of text come in the order in which the table has them.
    """

    name: str
    title: str
    table: str
    x: str
    y: tuple
    limits: tuple = ()
    equal: bool = False
    style: str = "line"  # line, points, stems, bars (stacked), polar, mesh, map, histogram or ranked
    log: bool = False  # y axis, or the colour of a map, in powers of ten
    reference: tuple = ()
    by: str = ""  # a column: one line, or one kind of points, for each of its values
    shade: str = ""  # a column: the ground is shaded where it is above 0
    rings: tuple = ()  # (radius, label) of circles about the origin, in the unit of x


@dataclass(frozen=True)
class Answer:
    """What one analysis found.  `data` carries objects for the analyses that need this one; it is not written to disk.
    `stopped` are the `Stop`s of the runs that it looked at, `failure` says why it failed, as in its last finding; the runner fills them in.
    """

    values: Mapping[str, Value] = field(default_factory=dict)
    tables: tuple = ()
    checks: tuple = ()
    findings: tuple = ()
    arrays: Mapping[str, Array] = field(default_factory=dict)
    outcome: str = "complete"
    data: Any = None
    stopped: tuple = ()
    failure: str = ""


Answers: TypeAlias = Mapping[str, Answer]  # of the analyses that ran before, by name


@dataclass(frozen=True)
class Result(Generic[SpecT]):
    """The answers of one run, with the spec they came from."""

    spec: SpecT
    mechanism: str
    title: str
    digest: str
    values: Mapping[str, Value]
    tables: Mapping[str, Table]
    checks: tuple
    findings: tuple
    provenance: Mapping
    arrays: Mapping[str, Array] = field(default_factory=dict)
    outcome: str = "complete"

    def __getitem__(self, name):
        """A value by its dotted name, as an SI float."""
        if name not in self.values:
            raise UnknownName("value", name, self.values)
        return self.values[name].value

    def check(self, name):
        """A design check by name."""
        for check in self.checks:
            if check.name == name:
                return check
        raise UnknownName("check", name, [c.name for c in self.checks])

    def table(self, name):
        """A table as pyarrow.Table with units in the column metadata."""
        if name not in self.tables:
            raise UnknownName("table", name, self.tables)
        return self.tables[name].arrow()

    def plot(self, name):
        """A matplotlib Figure of a table or of one of the mechanism's plots."""
        from drivewright import registry  # the one import upwards: a view is asked for by name

        return registry.load("drivewright.views", "matplotlib", "view")(self, name)

    def __repr__(self):
        """One line; the numbers are in `values`, `tables`, `checks`."""
        failed = [check.name for check in self.checks if not check.ok]
        verdict = f"{len(failed)} of {len(self.checks)} checks fail: {', '.join(failed)}" if failed else "all checks pass"
        return f"<Result {self.mechanism!r} {self.title!r}: {len(self.values)} values, {len(self.tables)} tables, {verdict}>"

    @property
    def ok(self):
        """Whether every design check passed."""
        return all(check.ok for check in self.checks)

    def record(self):
        """The content of result.json; non-finite values are left out (a finding says why)."""
        from drivewright import __version__

        values = {k: v.record() for k, v in self.values.items() if math.isfinite(v.value)}
        arrays = {
            k: {"unit": a.unit, "axes": list(a.axes), "labels": [list(x) for x in a.labels], "values": _listed(a.values)}
            for k, a in self.arrays.items()
        }
        checks = [check.record() for check in self.checks if math.isfinite(check.value) and math.isfinite(check.limit)]
        return {
            "format": 1,
            "drivewright": __version__,
            "mechanism": self.mechanism,
            "title": self.title,
            "digest": self.digest,
            "values": values,
            "arrays": arrays,
            "checks": checks,
            "findings": list(self.findings),
            "outcome": self.outcome,
            "provenance": dict(self.provenance),
        }


def _listed(values):
    """Nested lists of an array; an entry that does not exist is null."""
    values = np.asarray(values)
    return np.where(np.isfinite(values), values, None).tolist() if values.dtype.kind == "f" else values.tolist()
