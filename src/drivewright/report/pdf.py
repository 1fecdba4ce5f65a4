"""The report as a PDF (extra `pdf`): the same content as the page, typeset by Typst."""

import json
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from drivewright.atomic import replacing
from drivewright.errors import MissingExtra
from drivewright.report.content import Picture, Views, content, pictures, views
from drivewright.result import Result
from drivewright.view.palette import ROLES

TEMPLATES = Path(__file__).parent / "templates"


def write_pdf(result: Result[Any], path: str | Path, seen: Views | None = None, figures: Sequence[Picture] | None = None) -> Path:
    """Write the report of a result to `path`; MissingExtra without typst.

    `seen` is a `Views` (None: what the result's mechanism shows), `figures` are pictures already drawn (None: draw them).
    """
    _typst()
    seen = views(result) if seen is None else seen
    figures = pictures(result, seen) if figures is None else figures
    with tempfile.TemporaryDirectory() as folder, replacing(path) as target:
        files = [{"file": f"{n}.svg", "title": picture.title} for n, picture in enumerate(figures)]
        for file, picture in zip(files, figures, strict=True):
            (Path(folder) / file["file"]).write_text(picture.svg, encoding="utf-8")
        target.write_bytes(compile_template("report.typ", {**content(result, seen.remarks), "figures": files}, Path(folder)))
    return Path(path)


def compile_template(name: str, data: Mapping[str, Any], folder: Path) -> bytes:
    """The PDF of a template filled with data, in a folder that holds the figures which the data names; MissingExtra without typst."""
    typst = _typst()
    (folder / name).write_bytes((TEMPLATES / name).read_bytes())
    coloured = {**data, "colours": {role: light for role, (light, _) in ROLES.items()}}
    (folder / "data.json").write_text(json.dumps(coloured, allow_nan=False), encoding="utf-8")
    return typst.compile(str(folder / name), root=str(folder), font_paths=[_fonts()])


def _typst():
    try:
        import typst
    except ImportError as error:
        raise MissingExtra("the PDF report", "pdf", error) from None
    return typst


def _fonts():
    """matplotlib's folder of fonts: DejaVu is always there, the same letters as in the figures."""
    import matplotlib

    return str(Path(matplotlib.get_data_path()) / "fonts" / "ttf")
