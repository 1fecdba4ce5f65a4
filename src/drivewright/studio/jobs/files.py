"""Files that a person takes home: manufacturing files, the report, the spec.  They are made in memory, and name no place on this disk."""

import io
import zipfile
from collections.abc import Mapping
from copy import deepcopy
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeAlias

from drivewright import runner
from drivewright.report.content import pictures, program, views
from drivewright.report.export import export as write_export
from drivewright.report.folder import file_name, write_run_folder
from drivewright.report.form import report_form
from drivewright.report.html import write_report
from drivewright.spec import set_key, value_at
from drivewright.spec.keys import leaves
from drivewright.spec.serialisation import data_file_places, toml_text
from drivewright.studies.advising import advise
from drivewright.studio.design import Design
from drivewright.studio.jobs.progress import Progress

Files: TypeAlias = dict[str, list[dict[str, Any]]]  # {"files": [{"name", "data"}]}
LONGEST = 80  # characters of a file's name
BEGINNING = (1980, 1, 1, 0, 0, 0)  # of time in an archive: the same files, the same bytes


def export(design: Design, progress: Progress, format: str, anyway: bool = False) -> Files:
    """{"files": [{"name", "data"}]}: the design in a format of `drivewright export`, several files in one archive.

    GeometryCheckFailed where a geometry check fails, unless `anyway`; MissingExtra where the format needs what is not installed.
    """
    with TemporaryDirectory() as folder:
        written = write_export(design.spec(), (format,), Path(folder), anyway, progress, advise=advise)
        return _files(_stem(design), format, {path.name: path.read_bytes() for path in written})


def report(design: Design, progress: Progress, whole: bool = False, solids: bool = False, language: str = "en") -> Files:
    """The report page of a run as one file, or the `whole` run folder as an archive; `solids` shows the parts in motion on the page."""
    form = report_form(language=language)
    spec, behind = design.spec(), 2 if solids else 1  # steps behind the analyses: the solids, the figures
    model = runner.build(spec)
    result = advise(runner.run(spec, model=model, progress=lambda done, total, text: progress(done, total + behind, text)))
    done = len(result.provenance["analyses"])
    progress(done, done + behind, "solids" if solids else "drawing")
    seen, stem = views(result, model, solids), _stem(design)
    progress(done + behind - 1, done + behind, "drawing")
    with TemporaryDirectory() as folder:
        if not whole:
            drawn = pictures(result, seen, language=form.language)
            named = [picture._replace(name=file_name(picture.name)) for picture in drawn]
            return _one(f"{stem}.html", write_report(result, seen, folder, named, form).read_bytes())
        out = write_run_folder(result, Path(folder) / stem, seen=seen, form=form)
        return _one(
            f"{stem}.zip", archive({path.relative_to(folder).as_posix(): path.read_bytes() for path in out.rglob("*") if path.is_file()})
        )


def save(design: Design, progress: Progress) -> Files:
    """The spec as the user has it, with the comments of its author; where it names data files an archive with copies of them beside it."""
    spec, stem = design.spec(), _stem(design)
    places = data_file_places(spec.data_files())
    tables = deepcopy(design.tables)
    for key, _ in leaves(design.tables):
        if (path := value_at(spec, key)) in places:
            set_key(tables, key, places[path])
    head = f"# Written by the studio of Drivewright {program()}.  Run it with: drivewright run {stem}.toml\n"
    text = (design.text(tables) if design.source else head + toml_text(tables)).encode()
    copies = {place: path.read_bytes() for path, place in places.items()}
    return _one(f"{stem}.zip", archive({f"{stem}.toml": text, **copies})) if copies else _one(f"{stem}.toml", text)


def archive(files: Mapping[str, bytes]) -> bytes:
    """The bytes of a ZIP archive of {path: bytes}; the same files, the same bytes."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as packed:
        for name in sorted(files):
            entry = zipfile.ZipInfo(name, BEGINNING)
            entry.compress_type, entry.external_attr, entry.create_system = zipfile.ZIP_DEFLATED, 0o644 << 16, 3
            packed.writestr(entry, files[name])
    return stream.getvalue()


def _stem(design: Design) -> str:
    """The title as the name of a file, else the kind."""
    title = design.tables.get("title")
    return file_name(title[:LONGEST] if isinstance(title, str) and title.strip() else design.kind)


def _files(stem: str, format: str, written: Mapping[str, bytes]) -> Files:
    """One file under the name of the design, several in an archive."""
    if len(written) == 1:
        ((name, data),) = written.items()
        return _one(f"{stem}{Path(name).suffix}", data)
    return _one(f"{stem}-{format}.zip", archive(written))


def _one(name: str, data: bytes) -> Files:
    return {"files": [{"name": name, "data": data}]}
