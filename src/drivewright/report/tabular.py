"""Tables as CSV in the units people read, with the unit of every column in its header: `angle [deg],lift [mm]`."""

import csv
import io

import numpy as np

from drivewright.report.atomic import write_text
from drivewright.units import display


def write_csv(table, path, digits=12):
    """CSV file of a `result.Table`: header `name [unit]` (a pure number: `name`), numbers to `digits` figures, missing ones empty."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([heading(column) for column in table.columns])
    writer.writerows(zip(*(_cells(column, digits) for column in table.columns), strict=True))
    write_text(path, text.getvalue())


def heading(column):
    """`name [unit]` with the unit that is shown."""
    unit = display(column.unit)[1]
    return column.name if unit in ("", "-") else f"{column.name} [{unit}]"


def _cells(column, digits):
    data = np.asarray(column.data)
    if data.dtype.kind not in "iuf":
        return [str(value) for value in data.tolist()]
    factor = display(column.unit)[0]
    if data.dtype.kind in "iu" and factor == 1:
        return [str(value) for value in data.tolist()]
    shown = factor * data
    return [f"{value + 0.0:.{digits}g}" if np.isfinite(value) else "" for value in shown.tolist()]
