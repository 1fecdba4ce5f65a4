"""Cases from a file: CSV with `key [unit]` in the first line, or Parquet with the unit in the metadata of each column (SI without)."""

import io
import re
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drivewright.errors import SpecError, UnitError, brief
from drivewright.execution.keys import READABLE, key_kind
from drivewright.spec import MechanismSpec
from drivewright.spec.csv_text import csv_rows, plain_text, read_data_file
from drivewright.studies.variables import Variable, column
from drivewright.units import SCALES


def read_points(spec: MechanismSpec, file: str | Path) -> dict[Variable, NDArray[Any]]:
    """{Variable: column in SI} of a file of points; SpecError naming file, column and line."""
    columns = _from_parquet(file) if Path(file).suffix.lower() in (".parquet", ".pq") else _from_csv(file)
    for number, (key, *_) in enumerate(columns):
        if key in [earlier for earlier, *_ in columns[:number]]:
            raise SpecError(f"column '{key}' occurs twice; give it once", file=str(file))
    if not columns or not len(columns[0][2]):
        raise SpecError("has no cases; give a line of keys and a line for each case", file=str(file))
    return dict(_read(spec, *column, file) for column in columns)


def _read(spec, key, unit, cells, file):
    """(Variable, values) of one column."""
    try:
        kind = key_kind(spec, key, f"column '{key}'")
        unit, reading = _unit(kind, unit, key)
    except SpecError as error:
        raise error.located(file=str(file)) from None
    values = [_cell(kind, cell, f"case {number}, column '{key}'", file) for number, cell in enumerate(cells)]
    if kind.dimension and unit is not None:
        values = _in_si(kind.dimension, values, unit, isinstance(cells[0], str), key, file)
    return Variable(key, kind, readings=reading), column(values, kind)


def _unit(kind, unit, key):
    """(unit of a column's numbers, None for SI, remarks on what it is read as where it is one of another kind)."""
    if kind.name == "quantity" and unit is not None:
        if not unit:
            raise SpecError(f"wants its unit in brackets: '{key} [{kind.dimension.display_unit}]'", f"column '{key}'")
        taken = kind.reading(f"1 {unit}").partition(" ")[2] or unit
        try:
            kind.dimension.factor(taken)
        except UnitError as error:
            raise error.located(f"column '{key}'") from None
        return taken, () if taken == unit else (f"{key}: [{unit}] in the file of points is read as [{taken}]",)
    if unit not in (None, "", "-"):
        raise SpecError(f"takes {READABLE[kind.name]}, so it has no unit; got [{unit}]", f"column '{key}'")
    return None, ()


def _in_si(dimension, values, unit, is_text, key, file):
    """Numbers of a column in SI, words as they are.  Those of a text are rounded once, as the same text elsewhere."""
    factor, zero = dimension.factor(unit), SCALES[unit] if dimension.name == "temperature" else 0
    if not is_text:
        return [value if isinstance(value, str) else value * factor + float(zero) for value in values]
    if factor == 1 and not zero:
        return values
    return [
        value if isinstance(value, str) else _parsed(dimension, f"{value!r} {unit}", f"case {number}, column '{key}'", file)
        for number, value in enumerate(values)
    ]


def _parsed(dimension, text, place, file):
    """SI number of a text."""
    try:
        return dimension.parse(text)
    except UnitError as error:
        raise error.located(place, str(file)) from None


def _is_word(kind, cell):
    """Whether a quantity takes this word in place of a number: "rigid"."""
    try:
        parsed = kind.dimension.parse(str(cell).strip())
    except UnitError:
        return False
    return isinstance(parsed, str) or not np.isfinite(parsed)


def _cell(kind, cell, place, file):
    """A value of a column, still in the column's unit."""
    if kind.name == "quantity" and isinstance(cell, str) and _is_word(kind, cell):
        return cell.strip()
    try:
        if kind.name in ("quantity", "number"):
            value = float(cell)
            if np.isfinite(value):
                return value
        elif kind.name == "integer" and float(cell) == int(float(cell)) and abs(float(cell)) <= 2**53:
            return int(float(cell))
        elif kind.name == "flag" and str(cell).lower() in ("true", "false"):
            return str(cell).lower() == "true"
        elif kind.name == "text" and cell is not None and (not kind.choices or str(cell) in kind.choices):
            return str(cell)
    except (ValueError, TypeError, OverflowError):
        pass
    wanted = "a number" if kind.name == "quantity" else " or ".join(map(str, kind.choices)) if kind.choices else READABLE[kind.name]
    raise SpecError(f"wants {wanted}, got {brief(cell)}", place, str(file))


def _from_csv(file):
    """[(key, unit, cells)] of a CSV file."""
    rows = [row for _, row in csv_rows(io.StringIO(read_data_file(file), newline=""), file)]
    for number, row in enumerate(rows[1:]):
        if len(row) != len(rows[0]):
            hint = "; the columns are separated by commas, and a decimal point is a point" if ";" in "".join(rows[0]) else ""
            raise SpecError(f"case {number} has {len(row)} entries, the first line has {len(rows[0])}{hint}", file=str(file))
    return [(*_heading(cell, file), [plain_text(row[n]) for row in rows[1:]]) for n, cell in enumerate(rows[0] if rows else [])]


def _heading(cell, file):
    """(key, unit) of the first cell of a column."""
    match = re.fullmatch(r"\s*(.*?)\s*(?:\[(.*)\])?\s*", cell)
    if match is None:
        raise SpecError(f"has a line break in the heading {brief(cell)}; give 'key [unit]'", file=str(file))
    return match[1], match[2] or ""


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
    unit = (field.metadata or {}).get(b"unit")
    return unit.decode() if unit else None
