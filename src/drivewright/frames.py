"""Frames of pandas and datasets of xarray, in SI, with unit and label of every column; both libraries are the extra 'frames'.

In a dataset unit and label have the names `units` and `long_name`, by which the CF conventions and the plots of xarray know them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drivewright.errors import MissingExtra
from drivewright.labels import label_of

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa
    import xarray as xr


class Variable(NamedTuple):
    """An array of a dataset: a name for each of its axes, numbers in SI or texts, unit and label."""

    axes: tuple[str, ...]
    values: NDArray[Any]
    unit: str = ""
    label: str = ""
    meaning: str = ""

    def attributes(self) -> dict[str, str]:
        """`units`, `long_name` and `description`, those that are there; a pure number has the unit "1"."""
        named = {"units": "1" if self.unit == "-" else self.unit, "long_name": self.label, "description": self.meaning}
        return {name: text for name, text in named.items() if text}


def frame(table: pa.Table, index: str = "", **about: Any) -> pd.DataFrame:
    """A table as pandas.DataFrame; `attrs` has the units and labels of its columns by name, and what else is known `about` it.

    What does not exist is nan.  `index` names the column that numbers the rows.
    """
    require("pandas", "to_pandas()")
    made = table.to_pandas()
    fields = {field.name: field.metadata or {} for field in table.schema}
    texts = {what: {name: each.get(what.encode(), b"").decode() for name, each in fields.items()} for what in ("unit", "label", "meaning")}
    labels = {name: label_of(texts["meaning"][name], text) for name, text in texts["label"].items()}
    made = made.set_index(index) if index else made
    made.attrs.update(about, units=texts["unit"], labels=labels)
    return made


def dataset(variables: Mapping[str, Variable], coordinates: Mapping[str, Variable], **about: Any) -> xr.Dataset:
    """An xarray.Dataset of arrays over named axes; a coordinate that has the name of its axis indexes it."""
    xarray = require("xarray", "to_xarray()")
    data, places = (
        {name: (each.axes, each.values, each.attributes()) for name, each in group.items()} for group in (variables, coordinates)
    )
    return xarray.Dataset(data, places, about)


def distinct_axes(axes: Sequence[str]) -> tuple[str, ...]:
    """Axes of one array, numbered from the second one of a name on: ("station", "station") -> ("station", "station_2")."""
    return tuple(axis if (count := list(axes[:n]).count(axis)) == 0 else f"{axis}_{count + 1}" for n, axis in enumerate(axes))


def labelled(arrays: Mapping[str, tuple[Sequence[str], Sequence[Sequence[Any]], NDArray[Any], str]]) -> xr.Dataset:
    """A dataset of arrays {name: (axes, labels of each axis, values, unit)}.

    Axes of one name and equal labels are one; where the labels differ, the axis is called NAME.AXIS after the array that has others.
    """
    places: dict[str, Variable] = {}
    variables: dict[str, Variable] = {}
    for name, (axes, labels, values, unit) in arrays.items():
        chosen = []
        for axis, entries in zip(distinct_axes(axes), labels, strict=True):
            own = np.array(list(entries))
            known = places.get(axis)
            axis = axis if known is None or np.array_equal(known.values, own) else f"{name}.{axis}"
            places[axis] = Variable((axis,), own)
            chosen.append(axis)
        variables[name] = Variable(tuple(chosen), np.asarray(values), unit, label_of(name.replace("_", " ").replace(".", " · ")))
    return dataset(variables, places)


def require(library: str, purpose: str) -> Any:
    """A library of the extra, imported; MissingExtra where it is not installed."""
    from importlib import import_module

    try:
        return import_module(library)
    except ImportError as error:
        raise MissingExtra(purpose, "frames", error) from None
