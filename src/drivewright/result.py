"""Results: values, tables, checks and findings, with the spec and versions that they came from.

A result is a value: frozen, picklable, SI throughout, every number with a unit and a meaning.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, Protocol, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from drivewright import digits, plugins
from drivewright._typing import ArrayLike, Floats
from drivewright.advice import Advice
from drivewright.errors import UnknownName
from drivewright.labels import label_of
from drivewright.stops import Stop
from drivewright.surface_fields import SurfaceFields
from drivewright.units import System

if TYPE_CHECKING:
    import pandas
    import pyarrow
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SpecT = TypeVar("SpecT", bound="SpecLike")


class SpecLike(Protocol):
    """What a run wants of a spec; `spec.MechanismSpec` has it."""

    @property
    def mechanism(self) -> str:
        """The kind of drive."""
        ...

    @property
    def title(self) -> str:
        """The title shown in reports."""
        ...

    @property
    def optimise(self) -> Any:
        """The search that the spec describes, or None."""
        ...

    def digest(self) -> str:
        """SHA-256 of the effective spec."""
        ...


class UncertainNumber(Protocol):
    """What `Value.of` makes a value from, e.g. `numerics.ensemble.Estimate`."""

    @property
    def value(self) -> float:
        """The number itself [SI]."""
        ...

    @property
    def low(self) -> float | None:
        """Lower end of its 95 % interval."""
        ...

    @property
    def high(self) -> float | None:
        """Upper end of it."""
        ...

    @property
    def interval(self) -> str:
        """How the interval was made."""
        ...

    @property
    def settled(self) -> bool:
        """Whether a statistic has stopped to drift."""
        ...

    @property
    def error(self) -> float | None:
        """The standard error."""
        ...


BOUNDED = (
    "given",
    "mesh",
    "outlines",
    "periodic",
)  # intervals of what the spec gives, or that bound an error of computing; all others: 95 %


class Value(NamedTuple):
    """One number [SI unit] and what it means; where it is uncertain with its 95 % interval.

    `label` is the short name for people, from the meaning where it is not given; `meaning` is the sentence; `convention` settles sign,
    zero or sense, where that is not plain: "positive where it opposes the rise".

    `interval` says how that was made: "ensemble" or "windows" of a chaotic run, "visits", "sample", "fit", "periodic" (rounding),
    "outlines" (by how finely they are divided), "mesh" (of finite elements, from a finer one), "given" (of a range that the spec
    gives).  A bound that is None is not known; a value
    without interval is exact to its printed digits.  What has not `settled`, a statistic that still drifted when its run ended, is no
    property of the design yet: it is in the result, but never among the headline values.
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
    label: str = ""
    convention: str = ""

    @property
    def made(self) -> str:
        """How its interval was made: "95 %, ensemble", "bound, mesh"; "" where it has none."""
        if not self.interval:
            return ""
        return f"{'bound' if self.interval in BOUNDED else '95 %'}, {self.interval}"

    @classmethod
    def of(cls, estimate: UncertainNumber, unit: str, meaning: str, label: str = "", convention: str = "") -> "Value":
        """The value of an estimate with its interval."""
        low, high, error = estimate.low, estimate.high, estimate.error
        return cls(estimate.value, unit, meaning, low, high, estimate.interval, estimate.settled, error, label, convention).plain()

    def plain(self) -> "Value":
        """The same in Python's own floats; a bound that is not finite is None, and without any bound there is no interval."""
        low, high, error = (float(each) if each is not None and math.isfinite(each) else None for each in (self.low, self.high, self.error))
        interval = self.interval if (low, high) != (None, None) else ""
        label = label_of(self.meaning, self.label)
        return self._replace(value=float(self.value), low=low, high=high, interval=interval, error=error, label=label)

    def record(self) -> dict[str, Any]:
        """Plain dictionary as in result.json: `low`, `high` and `interval` where it has them, `settled` where it has not."""
        plain = self.plain()
        bounds = {name: end for name, end in (("low", plain.low), ("high", plain.high)) if end is not None}
        how = {"interval": plain.interval} if plain.interval else {}
        unsettled = {} if plain.settled else {"settled": False}
        about = {"label": plain.label, "meaning": plain.meaning} | ({"convention": plain.convention} if plain.convention else {})
        return {"value": plain.value, "unit": plain.unit, **about, **bounds, **how, **unsettled}


LOW, HIGH, ERROR = ".low", ".high", ".error"  # behind the name of a column: ends of its 95 % intervals; in studies its standard errors


UNDECIDED = "undecided: the limit lies within the interval"


class Array(NamedTuple):
    """A labelled array: `axes` names each axis, `labels` its entries."""

    unit: str
    axes: tuple[str, ...]
    labels: tuple[Sequence[Any], ...]
    values: Floats


class Column(NamedTuple):
    """One column of a table [SI unit]."""

    name: str
    unit: str
    meaning: str
    data: NDArray[Any]  # (rows,) numbers or texts
    label: str = ""

    def about(self) -> dict[str, str]:
        """Unit, label and meaning, as in the metadata of a Parquet file."""
        return {"unit": self.unit, "label": label_of(self.meaning, self.label), "meaning": self.meaning}

    def bounds(self, low: ArrayLike, high: ArrayLike) -> "tuple[Column, Column]":
        """The columns NAME.low and NAME.high with the ends of its 95 % intervals, nan where it has none; they go beside it."""
        label = label_of(self.meaning, self.label)
        return (
            Column(f"{self.name}{LOW}", self.unit, f"{self.meaning}, at least", np.asarray(low, float), f"{label}, low"),
            Column(f"{self.name}{HIGH}", self.unit, f"{self.meaning}, at most", np.asarray(high, float), f"{label}, high"),
        )


@dataclass(frozen=True)
class Table:
    """Columns of equal length, the first the independent variable; NAME.low and NAME.high are the ends of the 95 % intervals of NAME.

    `missing` says why numbers are missing, where that is as it should be.
    """

    name: str
    title: str
    columns: tuple[Column, ...]
    missing: str = ""

    def __getitem__(self, name: str) -> Column:
        for column in self.columns:
            if column.name == name:
                return column
        raise UnknownName(f"column of table {self.name!r}", name, [c.name for c in self.columns])

    def bounds_of(self, name: str) -> tuple[Column, Column] | None:
        """(low, high): the columns with the ends of the intervals of a column, None where it has none."""
        known = {column.name: column for column in self.columns}
        low, high = known.get(f"{name}{LOW}"), known.get(f"{name}{HIGH}")
        return (low, high) if name in known and low is not None and high is not None else None

    def bounded(self, name: str) -> str:
        """The name of the column whose interval ends are in the column `name`; "" where that is a column of its own."""
        owner = next((name.removesuffix(end) for end in (LOW, HIGH) if name.endswith(end)), "")
        return owner if owner and self.bounds_of(owner) else ""

    def arrow(self) -> "pyarrow.Table":
        """The same as a pyarrow.Table; `unit`, `label` and `meaning` in the metadata of each field, and whose interval it `bounds`."""
        import pyarrow as pa

        about = [{**column.about(), **({"bounds": owner} if (owner := self.bounded(column.name)) else {})} for column in self.columns]
        arrays = [_arrow_array(column.data) for column in self.columns]
        fields = [pa.field(c.name, array.type, metadata=each) for c, array, each in zip(self.columns, arrays, about, strict=True)]
        return pa.Table.from_arrays(arrays, schema=pa.schema(fields, metadata={"title": self.title}))


def _arrow_array(data):
    """pyarrow.array(data), numbers and texts from their bytes: pyarrow's own way imports pandas where that is installed (0.15 s)."""
    import pyarrow as pa

    data = np.asarray(data)
    if data.dtype.kind in "iuf":
        return pa.Array.from_buffers(pa.from_numpy_dtype(data.dtype), len(data), [None, pa.py_buffer(np.ascontiguousarray(data))])
    if all(isinstance(each, str) for each in data):
        texts = [each.encode() for each in data]
        ends = np.cumsum([0, *map(len, texts)], dtype=np.int32)
        return pa.Array.from_buffers(pa.string(), len(texts), [None, pa.py_buffer(ends), pa.py_buffer(b"".join(texts))])
    return pa.array(data)


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
    parts: tuple[str, ...] = ()
    geometry: bool = False  # a part with this check failed should not be manufactured
    low: float | None = None
    high: float | None = None
    label: str = ""

    @classmethod
    def of(cls, value: Value, name: str, limit: float, sense: str, message: str, parts: tuple[str, ...] = (), label: str = "") -> "Check":
        """The check of a `Value`, with its unit and its interval."""
        plain = value.plain()
        return cls(name, plain.value, limit, sense, plain.unit, message, parts, low=plain.low, high=plain.high, label=label)

    @property
    def display_label(self) -> str:
        """The label, from the message where none is given."""
        return label_of(self.message, self.label)

    @property
    def undecided(self) -> bool:
        """Whether the limit lies within the interval of the value; `ok` is decided by the value all the same."""
        return self.bounds is not None and self.bounds[0] < float(self.limit) < self.bounds[1]

    @property
    def bounds(self) -> tuple[float, float] | None:
        """(low, high) of the value, None where it has no interval."""
        ends = [float(end) for end in (self.low, self.high) if end is not None and math.isfinite(end)]
        return (ends[0], ends[1]) if len(ends) == 2 else None

    @property
    def margin(self) -> float:
        """Distance to the limit, positive on the good side."""
        return self.limit - self.value if self.sense == "<=" else self.value - self.limit

    @property
    def counted_margin(self) -> Any:
        """The margin, 0 where rounding alone makes it negative: at least 0 exactly where the check is ok.  Of many designs an array."""
        rounding = 1e-9 * np.maximum(np.abs(self.limit), np.abs(self.value))
        return np.where((self.margin < 0) & (self.margin >= -rounding), 0.0, self.margin)[()]

    @property
    def margin_bounds(self) -> tuple[float, float] | None:
        """(low, high) of the margin, None where the value has no interval."""
        if self.bounds is None:
            return None
        ends = [self._replace(value=end).margin for end in self.bounds]
        return min(ends), max(ends)

    @property
    def ok(self) -> bool:
        """Whether the limit is kept; rounding in the ninth digit does not decide."""
        return bool(self.margin >= -1e-9 * max(abs(self.limit), abs(self.value)))  # numpy's own bool is none for JSON

    def record(self) -> dict[str, Any]:
        """Plain dictionary as in result.json; a number that does not exist for the design is null, and the check is not ok."""
        numbers = {"value": _finite(self.value), "limit": _finite(self.limit), "sense": self.sense, "margin": _finite(self.margin)}
        bounds = {"low": self.bounds[0], "high": self.bounds[1], "undecided": self.undecided} if self.bounds else {}
        about = {"unit": self.unit, "ok": self.ok, "message": self.message, "parts": list(self.parts)}
        return {"name": self.name, "label": self.display_label, **numbers, **bounds, **about}


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
    y: tuple[str, ...]
    limits: tuple[tuple[float | str, str], ...] = ()
    equal: bool = False
    style: str = "line"  # line, points, stems, bars (stacked), polar, mesh, map, histogram or ranked
    log: bool = False  # y axis, or the colour of a map, in powers of ten
    reference: tuple[str, ...] = ()
    by: str = ""  # a column: one line, or one kind of points, for each of its values
    shade: str = ""  # a column: the ground is shaded where it is above 0
    rings: tuple[tuple[float, str], ...] = ()  # (radius, label) of circles about the origin, in the unit of x
    meaning: str = ""  # a sentence on what it shows, where the title is not enough; the title is its label
    places: tuple[tuple[float, str], ...] = ()  # (x, name) of what stands along the x axis, bearings of a shaft for instance
    unit: str = ""  # of the y axis, where another one than usual is meant: "arcmin"
    whole: bool = False  # everything is shown, however far beyond the limits


AnalysisData: TypeAlias = Any  # whatever an analysis hands to those that need it; they know what it is


@dataclass(frozen=True)
class Answer:
    """What one analysis found.  `data` carries objects for the analyses that need this one; it is not written to disk.
    `stopped` are the `Stop`s of the runs that it looked at, `failure` says why it failed, as in its last finding; the runner fills them in.
    `warnings` are the sentences that a reader must not miss, though no check fails: numbers that rest on what the real drive will not do.
    """

    values: Mapping[str, Value] = field(default_factory=dict)
    tables: tuple[Table, ...] = ()
    checks: tuple[Check, ...] = ()
    findings: tuple[str, ...] = ()
    arrays: Mapping[str, Array] = field(default_factory=dict)
    outcome: str = "complete"
    data: AnalysisData = None
    stopped: tuple[Stop, ...] = ()
    failure: str = ""
    warnings: tuple[str, ...] = ()
    fields: tuple[SurfaceFields, ...] = ()


def merge_answers(answers: Iterable[Answer]) -> Answer:
    """Values, tables, checks, findings, warnings and fields of several answers, in their order; partial where one is.

    `data` stays with each.
    """
    answers = tuple(answers)
    values = {name: value for answer in answers for name, value in answer.values.items()}
    arrays = {name: array for answer in answers for name, array in answer.arrays.items()}
    return Answer(
        values,
        tuple(table for answer in answers for table in answer.tables),
        tuple(check for answer in answers for check in answer.checks),
        tuple(finding for answer in answers for finding in answer.findings),
        arrays,
        "partial" if any(answer.outcome == "partial" for answer in answers) else "complete",
        warnings=tuple(warning for answer in answers for warning in answer.warnings),
        fields=tuple(each for answer in answers for each in answer.fields),
    )


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
    checks: tuple[Check, ...]
    findings: tuple[str, ...]
    provenance: Mapping[str, Any]
    arrays: Mapping[str, Array] = field(default_factory=dict)
    outcome: str = "complete"
    failures: Mapping[str, str] = field(default_factory=dict)  # {analysis that failed: the finding that says why}
    left_out: Mapping[str, str] = field(default_factory=dict)  # {analysis that was left out: the finding that says why}
    warnings: tuple[str, ...] = ()  # those of the findings that a reader must not miss; the verdict counts them
    fields: Mapping[str, SurfaceFields] = field(default_factory=dict)
    advice: tuple[Advice, ...] = ()  # what to change for the checks that fail, where `studies.advise` was asked
    timings: Mapping[str, float] = field(default_factory=dict)  # {analysis: seconds that it took}
    advice_stopped: bool = False  # the time for advice was over before all failed checks were looked at
    value_sources: Mapping[str, str] = field(default_factory=dict)  # {value: the analysis that computed it}, by which reports group them
    check_sources: Mapping[str, str] = field(default_factory=dict)  # {check: the analysis that made it}

    def __getitem__(self, name: str) -> float:
        """A value by its dotted name, as an SI float."""
        if name not in self.values:
            raise UnknownName("value", name, self.values)
        return self.values[name].value

    def check(self, name: str) -> Check:
        """A design check by name."""
        for check in self.checks:
            if check.name == name:
                return check
        raise UnknownName("check", name, [c.name for c in self.checks])

    def is_noise(self, value: Value | Check) -> bool:
        """Whether a number is rounding beside the largest of its unit in this design: people are shown 0 then."""
        return value.low is None and abs(value.value) <= self._noise_floors.get(value.unit, 0.0)

    @cached_property
    def _noise_floors(self) -> Mapping[str, float]:
        return digits.noise_floors([(each.value, each.unit) for each in (*self.values.values(), *self.checks)])

    def table(self, name: str) -> "pyarrow.Table":
        """A table as pyarrow.Table with units in the column metadata."""
        if name not in self.tables:
            raise UnknownName("table", name, self.tables)
        return self.tables[name].arrow()

    def to_pandas(self, table: str = "") -> "pandas.DataFrame":
        """The values as a frame, a row each: SI value, ends of its 95 % interval, unit, label; indexed by name.

        With the name of a `table` its columns; `attrs` has their units and labels.  MissingExtra without the extra 'frames'.
        """
        from drivewright import frames

        if table:
            return frames.frame(self.table(table), title=self.tables[table].title)
        pandas = frames.require("pandas", "to_pandas()")
        rows = [(each.value, each.low, each.high, each.unit, each.label) for each in map(Value.plain, self.values.values())]
        made = pandas.DataFrame(rows, columns=["value", "low", "high", "unit", "label"], index=pandas.Index(self.values, name="name"))
        made = made.astype({"value": float, "low": float, "high": float})
        made.attrs.update(title=self.title, mechanism=self.mechanism, digest=self.digest)
        return made

    def to_xarray(self, table: str = "") -> "xarray.Dataset":
        """The labelled `arrays` as a dataset; with the name of a `table` its columns over the first one, in SI.

        `units` and `long_name` of everything are in its attributes.  MissingExtra without the extra 'frames'.
        """
        from drivewright import frames

        if table not in self.tables and table:
            raise UnknownName("table", table, self.tables)
        if not table:
            return frames.labelled({name: (each.axes, each.labels, each.values, each.unit) for name, each in self.arrays.items()})
        axis = self.tables[table].columns[0].name
        columns = {
            each.name: frames.Variable((axis,), each.data, each.unit, label_of(each.meaning, each.label), each.meaning)
            for each in self.tables[table].columns
        }
        return frames.dataset(columns, {axis: columns.pop(axis)}, title=self.tables[table].title)

    def plot(self, name: str, ax: "Axes | None" = None) -> "Figure":
        """A matplotlib Figure of a table or of one of the mechanism's plots.

        With `ax` it is drawn into these axes, whose figure is returned; InputError for a plot that needs several axes, or others.
        """
        view = plugins.load("drivewright.views", "matplotlib", "view")
        return view(self, name) if ax is None else view(self, name, ax=ax)

    def __repr__(self) -> str:
        """One line; the numbers are in `values`, `tables`, `checks`."""
        failed = [check.name for check in self.checks if not check.ok]
        verdict = f"{len(failed)} of {len(self.checks)} checks fail: {', '.join(failed)}" if failed else "all checks pass"
        verdict += f", {len(self.warnings)} warning{'' if len(self.warnings) == 1 else 's'}" if self.warnings else ""
        return f"<Result {self.mechanism!r} {self.title!r}: {len(self.values)} values, {len(self.tables)} tables, {verdict}>"

    def _repr_html_(self) -> str:
        """A card for notebooks: verdict, picture, key numbers, checks; values and notes are folded."""
        return plugins.load("drivewright.views", "notebook", "view")(self)

    @property
    def units(self) -> System:
        """The system of units that its spec wants it shown in."""
        return getattr(self.spec, "units", "mm")

    @property
    def ok(self) -> bool:
        """Whether every design check passed."""
        return all(check.ok for check in self.checks)

    def record(self) -> dict[str, Any]:
        """The content of result.json; a value that does not exist is left out, a check of it has null and is not ok; findings say why."""
        from drivewright import __version__

        values = {k: v.record() for k, v in self.values.items() if math.isfinite(v.value)}
        arrays = {
            k: {"unit": a.unit, "axes": list(a.axes), "labels": [list(x) for x in a.labels], "values": _listed(a.values)}
            for k, a in self.arrays.items()
        }
        return {
            "format": 1,
            "drivewright": __version__,
            "mechanism": self.mechanism,
            "title": self.title,
            "digest": self.digest,
            "values": values,
            "arrays": arrays,
            "checks": [check.record() for check in self.checks],
            "advice": [advice.record() for advice in self.advice],
            "findings": list(self.findings),
            "warnings": list(self.warnings),
            "outcome": self.outcome,
            "provenance": dict(self.provenance),
        }


def _finite(number: float) -> float | None:
    """A number for JSON; None where it does not exist."""
    return float(number) if math.isfinite(number) else None


def _listed(values: ArrayLike) -> list[Any]:
    """Nested lists of an array; an entry that does not exist is null."""
    values = np.asarray(values)
    return np.where(np.isfinite(values), values.astype(object), np.array(None)).tolist() if values.dtype.kind == "f" else values.tolist()
