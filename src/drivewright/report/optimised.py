"""The folder of an optimisation: best.toml, the best design's run folder, every evaluation."""

import shutil
from pathlib import Path

from drivewright.report.folder import refuse_foreign, write_run_folder

MARK = "history.parquet"


def write_optimised(found, folder):
    """Write best.toml, best/ (run folder), history.parquet and, for several objectives, front.parquet; returns the folder."""
    folder = Path(folder).resolve()
    if not (folder / MARK).is_file():
        refuse_foreign(folder)
    fresh = folder.with_name(f"{folder.name}.tmp")
    shutil.rmtree(fresh, ignore_errors=True)
    try:
        fresh.mkdir(parents=True)
        found.best.spec.write(fresh / "best.toml")
        write_run_folder(found.best, fresh / "best")
        _write_columns(fresh / MARK, found.history, found.problem)
        _write_columns(fresh / "front.parquet", _front(found), found.problem)
        shutil.rmtree(folder, ignore_errors=True)
        fresh.rename(folder)
    finally:
        shutil.rmtree(fresh, ignore_errors=True)
    return folder


def _front(found):
    unknowns = dict(zip(found.problem.keys, found.front.T, strict=True))
    return unknowns | dict(found.front_values)


def _write_columns(path, columns, problem):
    """Parquet with the SI unit of each column in its metadata."""
    import pyarrow as pa
    from pyarrow import parquet

    units = problem.column_units()
    fields = [pa.field(name, pa.array(data).type, metadata={"unit": units.get(name, "-")}) for name, data in columns.items()]
    parquet.write_table(pa.Table.from_arrays([pa.array(data) for data in columns.values()], schema=pa.schema(fields)), path)
