"""Cases from a file: CSV with `key [unit]` in the first line, or Parquet with the unit in the metadata of each column (SI without)."""

import csv
import re
from pathlib import Path

import numpy as np

from drivewright.errors import SpecError, UnitError, brief
from drivewright.studies.variables import READABLE, Variable, kind_of


def read_points(spec, file):
    """{Variable: column in SI} of a file of points; SpecError naming file, column and line."""
    columns = _from_parquet(file) if Path(file).suffix.lower() in (".parquet", ".pq") else _from_csv(file)
    if not columns or not len(columns[0][2]):
        raise SpecError("has no cases; give a line of keys and a line for each case", file=str(file))
    return dict(_read(spec, *column, file) for column in columns)


def _read(spec, key, unit, cells, file):
    """(Variable, values) of one column."""
    try:
        kind = kind_of(spec, key, f"column '{key}'")
        factor = _factor(kind, unit, key)
    except SpecError as error:
        raise error.located(file=str(file)) from None
    values = [_cell(kind, cell, f"case {number}, column '{key}'", file) for number, cell in enumerate(cells)]
    column = np.array(values, dtype={"integer": np.int64, "flag": bool, "text": object}.get(kind.name, float))
    return Variable(key, kind), column * factor if kind.name == "quantity" else column


def _factor(kind, unit, key):
    """Factor to SI of a column's unit; None is SI."""
    if unit is None:
        return 1.0
    if kind.name == "quantity":
        if not unit:
            raise SpecError(f"wants its unit in brackets: '{key} [{kind.dimension.shown}]'", f"column '{key}'")
        try:
            return kind.dimension.factor(unit)
        except UnitError as error:
            raise error.located(f"column '{key}'") from None
    if unit not in ("", "-"):
        raise SpecError(f"takes {READABLE[kind.name]}, so it has no unit; got [{unit}]", f"column '{key}'")
    return 1.0


def _cell(kind, cell, place, file):
    """A value of a column, still in the column's unit."""
    try:
        if kind.name in ("quantity", "number"):
            value = float(cell)
            if np.isfinite(value):
                return value
        elif kind.name == "integer" and float(cell) == int(float(cell)):
            return int(float(cell))
        elif kind.name == "flag" and str(cell).lower() in ("true", "false"):
            return str(cell).lower() == "true"
        elif kind.name == "text":
            return str(cell)
    except (ValueError, TypeError, OverflowError):
        pass
    raise SpecError(f"wants {'a number' if kind.name == 'quantity' else READABLE[kind.name]}, got {brief(cell)}", place, str(file))


def _from_csv(file):
    """[(key, unit, cells)] of a CSV file."""
    try:
        rows = [row for row in csv.reader(Path(file).read_text(encoding="utf-8-sig").splitlines()) if row]
    except (OSError, UnicodeDecodeError) as error:
        raise SpecError(f"cannot be read: {getattr(error, 'strerror', None) or error}", file=str(file)) from None
    for number, row in enumerate(rows[1:]):
        if len(row) != len(rows[0]):
            raise SpecError(f"case {number} has {len(row)} entries, the first line has {len(rows[0])}", file=str(file))
    headings = [re.fullmatch(r"\s*(.*?)\s*(?:\[(.*)\])?\s*", cell) for cell in rows[0]] if rows else []
    return [(match[1], match[2] or "", [row[n] for row in rows[1:]]) for n, match in enumerate(headings)]


def _from_parquet(file):
    """[(key, unit, cells)] of a Parquet file; the unit stands in the metadata of the field, as in the tables of a run; SI without."""
    import pyarrow as pa
    from pyarrow import parquet

    try:
        table = parquet.read_table(file)
    except (OSError, pa.ArrowException) as error:
        raise SpecError(f"is no Parquet file that can be read: {str(error).splitlines()[0]}", file=str(file)) from None
    return [(field.name, _unit_of(field), table[field.name].to_pylist()) for field in table.schema]


def _unit_of(field):
    found = (field.metadata or {}).get(b"unit")
    return found.decode() if found else None
