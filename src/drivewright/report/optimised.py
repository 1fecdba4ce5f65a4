"""The outcome of an optimisation beside its evaluations: best.toml, the best design's run folder, every evaluation in one table."""

from dataclasses import replace
from pathlib import Path

from drivewright import atomic
from drivewright.execution.case_table import key_info
from drivewright.report.content import views
from drivewright.report.folder import refuse_foreign, write_run_folder
from drivewright.report.records import OptimisedRecord

MARK = "history.parquet"


def write_optimised(search: OptimisedRecord, folder: str | Path) -> Path:
    """Write history.parquet, front.parquet, best/ (run folder) and best.toml, each whole or not at all; returns the folder."""
    folder = Path(folder).resolve()
    if folder != search.folder and not (folder / MARK).is_file():
        refuse_foreign(folder)
    folder.mkdir(parents=True, exist_ok=True)
    _write_table(folder / MARK, search.table)
    _write_table(folder / "front.parquet", _front(search))
    best, seen = _with_search(search)
    write_run_folder(best, folder / "best", seen=seen)
    search.best.spec.write(folder / "best.toml")
    return folder


def _with_search(search):
    """(Result, Views) of the best design, with the search that led to it."""
    table, plot = search.search()
    seen = views(search.best)
    return replace(search.best, tables={**search.best.tables, table.name: table}), seen._replace(plots=(*seen.plots, plot))


def _front(search):
    """The front as a table: unknowns and values, with their units."""
    import pyarrow as pa

    unknowns = dict(zip(search.problem.keys, search.front.T, strict=True))
    infos = {key: key_info(key, kind.unit, "unknown") for key, kind in zip(search.problem.keys, search.problem.kinds, strict=True)}
    columns = {name: (data, search.problem.about[name]) for name, data in search.front_values.items()}
    columns = {key: (data, infos[key]) for key, data in unknowns.items()} | columns
    fields = [pa.field(name, pa.float64(), metadata=about.metadata()) for name, (_, about) in columns.items()]
    return pa.Table.from_arrays([pa.array(data, pa.float64()) for data, _ in columns.values()], schema=pa.schema(fields))


def _write_table(path, table):
    from pyarrow import parquet

    with atomic.replacing(path) as temporary:
        parquet.write_table(table, temporary)
