"""Symmetric matrices between the stations of a shaft, as values, arrays and rows."""

from collections.abc import Sequence

from drivewright._typing import Floats
from drivewright.result import Array, Value
from drivewright.shafts.tables import station_pairs


def pair_values(key: str, names: Sequence[str], matrix: Floats, unit: str, meaning: str) -> dict[str, Value]:
    """`key.A.B` for every pair of stations; the meaning says {a!r} and {b!r} where it names them."""
    return {
        f"{key}.{names[i]}.{names[j]}": Value(float(matrix[i, j]), unit, meaning.format(a=names[i], b=names[j]))
        for i, j in station_pairs(names)
    }


def station_array(names: tuple[str, ...], matrix: Floats, unit: str) -> Array:
    """The matrix (stations, stations) as an array of the result."""
    return Array(unit, ("station", "station"), (names, names), matrix)
