"""The run folder: written beside its place, then moved in whole, so that there is always a complete one or none."""

import json
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np

from drivewright.errors import InputError
from drivewright.execution.helper import Map
from drivewright.report.content import Picture, Views, pictures, thumbnail, views
from drivewright.report.form import ReportForm
from drivewright.report.html import write_report
from drivewright.report.letterhead import read_letterhead
from drivewright.report.moving import Place, recover, replacing_folder
from drivewright.report.names import file_name
from drivewright.result import Result, Table
from drivewright.surface_fields import SurfaceFields

OURS = {"result.json", "report.html", "spec.toml", "figures", "tables", "fields", "data"}  # what a run writes, and the next one replaces


def write_run_folder(
    result: Result[Any],
    out: str | Path,
    figures: bool = True,
    seen: Views | None = None,
    compute: Map = map,
    form: ReportForm = ReportForm(),
) -> Path:
    """Write the run folder of a result to `out` and return its path.

    result.json, report.html, figures/*.svg, tables/*.parquet, fields/*.npz, spec.toml.  `seen` is a `Views`; None takes what the result's
    mechanism shows.  What an earlier run wrote is replaced, everything else in the folder stays; InputError for a folder that is
    not empty and no run folder.  `compute` may draw the figures side by side; `form` is that of the report.
    """
    read_letterhead(result.spec)  # what is wrong with it is said before anything is drawn
    out = recover_run_folder(out)
    refuse_foreign(out)
    with replacing_folder(Place(out, OURS, refuse_foreign)) as fresh:
        _fill(fresh, result, views(result) if seen is None else seen, figures, compute, form)
    return out


def recover_run_folder(out: str | Path) -> Path:
    """The absolute path of a run folder, after whatever runs that died have left beside it was brought back, or removed."""
    out = Path(out).resolve()
    recover(Place(out, OURS, refuse_foreign))
    return out


def is_run_folder(path: str | Path) -> bool:
    """Whether `path` holds the result.json of a run."""
    try:
        return "drivewright" in json.loads((Path(path) / "result.json").read_text(encoding="utf-8"))
    except (OSError, ValueError, TypeError):
        return False


def refuse_foreign(out: Path) -> None:
    """InputError where writing to `out` would take the place of something that is no run folder."""
    if not (out.is_dir() and [path.name for path in out.iterdir()] == ["cad"]):
        refuse_other(out, "run folder", is_run_folder, "result.json of a run")


def refuse_other(out: Path, thing: str, is_one: Callable[[Path], bool], mark: str) -> None:
    """InputError where `out` is a file, or a folder that is not empty and no such thing; `mark` names what would prove it."""
    if out.exists() and not out.is_dir():
        raise InputError(f"{out}: is a file, a {thing} cannot take its place; choose another --out")
    inside = sorted(path.name for path in out.iterdir()) if out.is_dir() else []
    if inside and not is_one(out):
        raise InputError(
            f"{out}: is not empty and is no {thing} (it holds {', '.join(inside[:3])} ... but no {mark}); nothing was written. "
            "Choose another --out, or empty it first"
        )


def record_text(result: Result[Any]) -> str:
    """The text of result.json."""
    return json.dumps(result.record(), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _fill(folder: Path, result: Result[Any], seen: Views, figures: bool, compute: Map, form: ReportForm) -> None:
    """Everything of one run, the result first: it is what makes a folder a run folder."""
    (folder / "result.json").write_text(record_text(result), encoding="utf-8")
    result.spec.write(folder / "spec.toml")
    drawn = pictures(result, seen, compute, form.language) if figures else ()
    named = [picture._replace(name=file_name(picture.name)) for picture in drawn]
    write_report(result, seen, folder, named, form)
    _write_tables(folder, result.tables.values())
    _write_fields(folder, result.fields.values())
    _write_figures(folder, [*named, thumbnail(seen.scene)] if figures and seen.scene else named)


def _write_figures(folder: Path, named: Iterable[Picture]) -> None:
    for picture in named:
        (folder / "figures").mkdir(exist_ok=True)
        (folder / "figures" / f"{picture.name}.svg").write_text(picture.svg, encoding="utf-8")


def _write_fields(folder: Path, fields: Iterable[SurfaceFields]) -> None:
    """Fields on the deformed solids, for `numpy.load`: names as in `SurfaceFields.arrays`."""
    for each in fields:
        (folder / "fields").mkdir(exist_ok=True)
        np.savez_compressed(folder / "fields" / f"{file_name(each.name)}.npz", allow_pickle=False, **each.arrays())


def _write_tables(folder: Path, tables: Iterable[Table]) -> None:
    from pyarrow import parquet

    for table in tables:
        (folder / "tables").mkdir(exist_ok=True)
        parquet.write_table(table.arrow(), folder / "tables" / f"{file_name(table.name)}.parquet")
