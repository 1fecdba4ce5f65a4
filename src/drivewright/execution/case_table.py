"""The table of cases: its first columns, a column per varied key, and a column per value with its unit, label and meaning."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from drivewright._typing import Floats
from drivewright.execution.keys import KeyKind
from drivewright.execution.outputs import OutputInfo
from drivewright.labels import label_of

if TYPE_CHECKING:
    import pyarrow as pa

CASE, STATUS, MESSAGE = "case", "status", "message"
VALUE_PREFIX = "value."  # in front of a value that has the name of a key that varies
Columns: TypeAlias = Mapping[str, NDArray[Any]]  # {key: values (n,) in SI}, texts as objects


def case_fields() -> list[pa.Field]:
    """The pyarrow fields that every table of cases begins with."""
    import pyarrow as pa

    rows = (
        (CASE, pa.int64(), "-", "number of the case"),
        (STATUS, pa.string(), "", "complete, partial or failed"),
        (MESSAGE, pa.string(), "", "why it is not complete, or what was left out"),
    )
    return [
        pa.field(name, kind, metadata=OutputInfo(unit, meaning, label=name.capitalize()).metadata()) for name, kind, unit, meaning in rows
    ]


def key_info(key: str, unit: str, meaning: str) -> OutputInfo:
    """What is known of the column of a key, labelled by the key in words: "Limits · static safety"."""
    return OutputInfo(unit, meaning, label=label_of(key.replace("_", " ").replace(".", " · ")))


def case_table(
    first: int,
    columns: Columns,
    kinds: Mapping[str, KeyKind],
    values: Mapping[str, Floats],
    about: Mapping[str, OutputInfo],
    statuses: Sequence[str],
    messages: Sequence[str],
) -> pa.Table:
    """The table of the cases from number `first` on; `values` {name: (n,)}, `about` {name: OutputInfo}; what does not exist is null."""
    import pyarrow as pa

    fields = case_fields()
    arrays = [pa.array(np.arange(first, first + len(statuses))), pa.array(statuses, pa.string()), pa.array(messages, pa.string())]
    for key, kind in kinds.items():
        arrays.append(pa.array(columns[key]))
        unit = "" if columns[key].dtype == object else kind.unit
        fields.append(pa.field(key, arrays[-1].type, metadata=key_info(key, unit, "varied").metadata()))
    taken = {CASE, STATUS, MESSAGE, *kinds}
    for name, column in values.items():
        owner = about[name].bounds
        prefix = VALUE_PREFIX if (owner or name) in taken or name in taken else ""
        bounds = {"bounds": f"{prefix}{owner}"} if owner else {}
        fields.append(pa.field(f"{prefix}{name}", pa.float64(), metadata={**about[name].metadata(), **bounds}))
        arrays.append(pa.array(column, pa.float64(), mask=~np.isfinite(column)))
    return pa.Table.from_arrays(arrays, schema=pa.schema(fields))
