"""Many shafts at once for the optimiser: flexibilities of round, linear shafts in the compiled batch."""

import re
from collections.abc import Callable, Sequence

import numpy as np

from drivewright import shafts
from drivewright._typing import Floats
from drivewright.errors import UnknownName
from drivewright.mechanisms.shaft.build import build
from drivewright.mechanisms.shaft.spec import ShaftSpec

KEYS = re.compile(r"(segments|bearings|stations)\.([\w-]+)\.(length|diameter|end_diameter|bore|radial_stiffness|position)")
VALUES = re.compile(r"flexibility\.([\w-]+)\.([\w-]+)")
TABLE = {"length": "lengths", "diameter": "diameters", "end_diameter": "end_diameters", "bore": "bores"}  # of the batch, by the key


def batch(spec: ShaftSpec, keys: Sequence[str], names: Sequence[str]) -> Callable[[Floats], dict[str, Floats]] | None:
    """designs (n, d) -> {name: (n,)}; None where a key, a value or a support is beyond the batch, which then runs one by one."""
    parsed_keys, parsed_names = [KEYS.fullmatch(key) for key in keys], [VALUES.fullmatch(name) for name in names]
    shaft = build(spec).shaft if all(parsed_keys) and all(parsed_names) else None
    housed = any(np.isfinite(bearing.housing_stiffness) for bearing in spec.bearings)
    if shaft is None or housed or not shafts.is_batchable(shaft):
        return None
    pairs = {m.string: tuple(_number(spec, "stations", each) for each in m.groups()) for m in parsed_names if m}
    places = [_place(spec, *m.groups()) for m in parsed_keys if m]
    cylinders = [n for n, segment in enumerate(spec.segments) if segment.end_diameter is None and ("end_diameters", n) not in places]
    return shafts.flexibility_function(shaft, places, pairs, cylinders)


def _place(spec: ShaftSpec, table: str, entry: str, key: str) -> tuple[str, int]:
    """(table of the batch, column) of a key."""
    number = _number(spec, table, entry)
    if key == "position":
        return ("supports" if table == "bearings" else "stations"), number
    return TABLE.get(key, key), number


def _number(spec: ShaftSpec, table: str, entry: str) -> int:
    """Number of an entry of a list by its name or number; UnknownName otherwise."""
    names = [getattr(each, "name", str(number)) for number, each in enumerate(getattr(spec, table))]
    if entry.isdigit() and int(entry) < len(names):
        return int(entry)
    if entry not in names:
        raise UnknownName(f"entry of {table}", entry, names)
    return names.index(entry)
