"""Many shafts at once: flexibility at the stations, and reactions, of a million stepped shafts in one call."""

from collections.abc import Callable, Mapping, Sequence
from typing import Literal, NamedTuple, TypeAlias, overload

import numpy as np

from drivewright import cases
from drivewright._jit import warmer
from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError
from drivewright.shafts.batch_kernels import DesignColumn, DesignColumns, fill_flexibilities, workspace
from drivewright.shafts.model import COWPER, Shaft

CHUNK = 1_000_000  # sections and pairs of points per chunk: a few hundredths of a second
Progress: TypeAlias = Callable[[int, int, str], object]  # (done, total, what comes next)
PER_DESIGN = ("youngs_modulus", "poisson", "shear")


@overload
def flexibilities(
    lengths: ArrayLike,
    diameters: ArrayLike,
    supports: ArrayLike,
    radial_stiffness: ArrayLike,
    stations: ArrayLike,
    youngs_modulus: ArrayLike,
    poisson: ArrayLike,
    shear: ArrayLike = ...,
    *,
    bores: ArrayLike = ...,
    end_diameters: ArrayLike | None = ...,
    reactions: Literal[False] = ...,
    workers: int | None = ...,
    progress: Progress | None = ...,
) -> Floats: ...
@overload
def flexibilities(
    lengths: ArrayLike,
    diameters: ArrayLike,
    supports: ArrayLike,
    radial_stiffness: ArrayLike,
    stations: ArrayLike,
    youngs_modulus: ArrayLike,
    poisson: ArrayLike,
    shear: ArrayLike = ...,
    *,
    bores: ArrayLike = ...,
    end_diameters: ArrayLike | None = ...,
    reactions: Literal[True],
    workers: int | None = ...,
    progress: Progress | None = ...,
) -> tuple[Floats, Floats]: ...
def flexibilities(
    lengths: ArrayLike,
    diameters: ArrayLike,
    supports: ArrayLike,
    radial_stiffness: ArrayLike,
    stations: ArrayLike,
    youngs_modulus: ArrayLike,
    poisson: ArrayLike,
    shear: ArrayLike = COWPER,
    *,
    bores: ArrayLike = 0.0,
    end_diameters: ArrayLike | None = None,
    reactions: bool = False,
    workers: int | None = None,
    progress: Progress | None = None,
) -> Floats | tuple[Floats, Floats]:
    """(N, M, M) flexibility [m/N] of N shafts at M stations each; with `reactions` also (N, B, M): what each support carries of a
    unit force at each station [N/N].

    lengths, diameters, bores (N, S): sections from left to right [m]; end_diameters (N, S) makes cones; supports, radial_stiffness (N, B):
    places [m] and N/m, inf is rigid, 0 is absent; stations (N, M): places [m].  youngs_modulus [Pa], poisson, shear (N,): as in
    `shafts.model`, shear > 0 is kappa, COWPER or EULER_BERNOULLI.  What all designs share needs no axis of designs, or one of 1, and
    a single number serves all sections; nothing is copied for it.
    An impossible design is a row of nan, and no error: a size that is not positive, a bore as wide as the shaft, a place off it, fewer than
    two places that carry, two rigid supports at one.  The number of `workers` (None: one per core) changes no digit.
    """
    designs, (count, sections, bearings, measured) = _designs(
        lengths,
        diameters,
        diameters if end_diameters is None else end_diameters,
        bores,
        supports,
        radial_stiffness,
        stations,
        youngs_modulus,
        poisson,
        shear,
    )
    delta = np.empty((count, measured, measured))
    carried = np.empty((count if reactions else 0, bearings, measured))
    points = bearings + measured
    per_chunk = max(1, CHUNK // (points * points + sections))

    def chunk(begin):
        fill_flexibilities(designs, sections, begin, min(begin + per_chunk, count), workspace(bearings, measured), delta, carried)

    if workers is None and count <= per_chunk:
        workers = 1  # starting a thread costs more than a few designs
    if cases.run(chunk, range(0, count, per_chunk), workers, progress).interrupted:
        raise KeyboardInterrupt
    return (delta, carried) if reactions else delta


# -- of one shaft --------------------------------------------------------------------------------------------------------------


class DesignTables(NamedTuple):
    """Arguments of `flexibilities` by their names, a row for each design; writable."""

    lengths: Floats
    diameters: Floats
    end_diameters: Floats
    bores: Floats
    supports: Floats
    radial_stiffness: Floats
    stations: Floats


def is_batchable(shaft: Shaft) -> bool:
    """Whether `flexibilities` covers a shaft: all supports are radial springs at points, the same all round."""
    return all(s.law is None and not s.width and not any(s.stiffness[3:]) and s.stiffness[0] == s.stiffness[1] > 0 for s in shaft.supports)


def design_tables(shaft: Shaft, count: int) -> DesignTables:
    """`DesignTables` of `count` designs that are all this shaft."""
    rows = (
        [s.length for s in shaft.sections],
        [s.start for s in shaft.sections],
        [s.end for s in shaft.sections],
        [s.bore for s in shaft.sections],
        [s.position for s in shaft.supports],
        [s.stiffness[0] for s in shaft.supports],
        [s.position for s in shaft.stations],
    )
    return DesignTables(*(np.tile(np.array(row, float), (count, 1)) for row in rows))


def flexibility_function(
    shaft: Shaft, columns: Sequence[tuple[str, int]], pairs: Mapping[str, tuple[int, int]], cylinders: Sequence[int] = ()
) -> Callable[[Floats], dict[str, Floats]]:
    """A function of designs (n, d) that gives flexibilities {name: (n,)} [m/N], NaN for an impossible design; all else as in `shaft`.

    columns: (field of `DesignTables`, entry) that each of the d columns of a design replaces, in SI; pairs: the stations (i, j) of
    each name; cylinders: numbers of the sections whose right end has the diameter of the left one in every design.
    """
    cylinders = list(cylinders)

    def evaluate(x: Floats) -> dict[str, Floats]:
        tables = design_tables(shaft, len(x))
        for column, (table, number) in zip(np.asarray(x, float).T, columns, strict=True):
            getattr(tables, table)[:, number] = column
        tables.end_diameters[:, cylinders] = tables.diameters[:, cylinders]
        delta = flexibilities(**tables._asdict(), youngs_modulus=shaft.modulus, poisson=shaft.poisson, shear=shaft.shear)
        return {name: delta[:, i, j] for name, (i, j) in pairs.items()}

    return evaluate


# -- arguments -----------------------------------------------------------------------------------------------------------------


def _designs(*arguments):
    """(DesignColumns, (N, S, B, M))."""
    tables = [_table(name, value, name in PER_DESIGN) for name, value in zip(DesignColumns._fields, arguments, strict=True)]
    named = dict(zip(DesignColumns._fields, tables, strict=True))
    widths = {name: named[name].shape[1] for name in ("lengths", "supports", "stations")}
    wanted = dict.fromkeys(("diameters", "end_diameters", "bores"), "lengths") | {"radial_stiffness": "supports"}
    rows = {len(table) for table in tables} - {1} or {1}
    for name, table in named.items():
        width = widths.get(wanted.get(name, name), 1)
        if table.shape[1] not in (1, width):
            raise InputError(
                f"flexibilities: {name} has {table.shape[1]} entries a design where {wanted[name]} has {width}; "
                "give one for each, or a single number."
            )
    if len(rows) > 1:
        lengths = ", ".join(f"{name} {len(table)}" for name, table in named.items() if len(table) > 1)
        raise InputError(
            f"flexibilities: the arguments disagree in the number of designs ({lengths}); each must have that many rows, or one."
        )
    columns = [
        DesignColumn(table.reshape(-1), *(step if size > 1 else 0 for step, size in zip((table.shape[1], 1), table.shape, strict=True)))
        for table in tables
    ]
    return DesignColumns(*columns), (rows.pop(), *widths.values())


def _table(name, value, one_a_design):
    """The argument as (designs or 1, width or 1), contiguous; copied only where it is not already."""
    try:
        table = np.asarray(value, dtype=float)
    except (TypeError, ValueError) as error:
        raise InputError(f"flexibilities: {name} must be numbers, one row per design; {error}.") from None
    table = table.reshape(-1, 1) if one_a_design and table.ndim < 2 else np.atleast_2d(table)
    if table.ndim != 2 or not table.shape[1] or (one_a_design and table.shape[1] > 1):
        raise InputError(
            f"flexibilities: {name} must have the shape {'(designs,)' if one_a_design else '(designs, entries)'}; got {np.shape(value)}."
        )
    for axis in (0, 1):
        if table.size and table.strides[axis] == 0 and table.shape[axis] > 1:
            table = table.take([0], axis)  # broadcast already: one row or entry is all there is
    return np.require(table, float, ["C", "W"])


@warmer
def warm_batch() -> None:
    """A uniform and a stepped shaft."""
    for diameters in ((0.02,), (0.02, 0.03)):
        flexibilities((0.1, 0.1), diameters, (0.02, 0.18), 1e8, (0.0, 0.1), 206e9, 0.3)
