"""Many shafts at once for the optimiser: flexibilities of round, linear shafts in the compiled batch."""

import re
from typing import NamedTuple

import numpy as np

from drivewright.errors import UnknownName
from drivewright.mechanisms.shaft.build import build
from drivewright.shafts.batch import flexibilities

KEYS = re.compile(r"(segments|bearings|stations)\.([\w-]+)\.(length|diameter|end_diameter|bore|radial_stiffness|position)")
VALUES = re.compile(r"flexibility\.([\w-]+)\.([\w-]+)")
TABLE = {"length": "lengths", "diameter": "diameters", "end_diameter": "ends", "bore": "bores", "radial_stiffness": "stiffness"}


class _Tables(NamedTuple):
    """Arguments of `flexibilities`, a row for each design."""

    lengths: np.ndarray
    diameters: np.ndarray
    ends: np.ndarray
    bores: np.ndarray
    supports: np.ndarray
    stiffness: np.ndarray
    stations: np.ndarray


def batch(spec, keys, names):
    """designs (n, d) -> {name: (n,)}; None where a key, a value or a support is beyond the batch, which then runs one by one."""
    if not all(map(KEYS.fullmatch, keys)) or not all(map(VALUES.fullmatch, names)):
        return None
    model = build(spec)
    housed = any(np.isfinite(bearing.housing_stiffness) for bearing in spec.bearings)
    if housed or not all(_is_plain(support) for support in model.shaft.supports):
        return None
    pairs = {name: tuple(_number(spec, "stations", each) for each in VALUES.fullmatch(name).groups()) for name in names}
    places = [_place(spec, *KEYS.fullmatch(key).groups()) for key in keys]
    straight = [n for n, segment in enumerate(spec.segments) if segment.end_diameter is None and ("ends", n) not in places]

    def evaluate(x):
        """{name: (n,)} of designs (n, d), NaN for an impossible one."""
        tables = _tables(model.shaft, spec, len(x))
        for column, (table, number) in zip(np.asarray(x, float).T, places, strict=True):
            getattr(tables, table)[:, number] = column
        tables.ends[:, straight] = tables.diameters[:, straight]
        delta = flexibilities(
            tables.lengths,
            tables.diameters,
            tables.supports,
            tables.stiffness,
            tables.stations,
            model.shaft.modulus,
            model.shaft.poisson,
            model.shaft.shear,
            bores=tables.bores,
            end_diameters=tables.ends,
        )
        return {name: delta[:, i, j] for name, (i, j) in pairs.items()}

    return evaluate


def _is_plain(support):
    return support.law is None and not support.width and not any(support.stiffness[3:]) and support.stiffness[0] > 0


def _tables(shaft, spec, count):
    rows = (
        [s.length for s in shaft.sections],
        [s.start for s in shaft.sections],
        [s.end for s in shaft.sections],
        [s.bore for s in shaft.sections],
        [s.position for s in shaft.supports],
        [s.stiffness[0] for s in shaft.supports],
        [s.position for s in shaft.stations],
    )
    return _Tables(*(np.tile(np.array(row, float), (count, 1)) for row in rows))


def _place(spec, table, entry, key):
    """(table of the batch, column) of a key."""
    number = _number(spec, table, entry)
    if key == "position":
        return ("supports" if table == "bearings" else "stations"), number
    return TABLE[key], number


def _number(spec, table, entry):
    """Number of an entry of a list by its name or number; UnknownName otherwise."""
    names = [getattr(each, "name", str(number)) for number, each in enumerate(getattr(spec, table))]
    if entry.isdigit() and int(entry) < len(names):
        return int(entry)
    if entry not in names:
        raise UnknownName(f"entry of {table}", entry, names)
    return names.index(entry)
