"""The report as a PDF (extra `pdf`): the same content as the page, typeset by Typst."""

import json
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from drivewright.atomic import replacing
from drivewright.errors import MissingExtra
from drivewright.report.content import Picture, Views, content, pictures, views
from drivewright.result import Result
from drivewright.view.palette import ROLES

TEMPLATE = Path(__file__).parent / "templates" / "report.typ"


def write_pdf(result: Result[Any], path: str | Path, seen: Views | None = None, figures: Sequence[Picture] | None = None) -> Path:
    """Write the report of a result to `path`; MissingExtra without typst.

    `seen` is a `Views` (None: what the result's mechanism shows), `figures` are pictures already drawn (None: draw them).
    """
    typst = _typst()
    seen = views(result) if seen is None else seen
    figures = pictures(result, seen) if figures is None else figures
    with tempfile.TemporaryDirectory() as folder, replacing(path) as target:
        _lay_out(Path(folder), content(result, seen.remarks), figures)
        target.write_bytes(typst.compile(str(Path(folder) / "report.typ"), root=folder, font_paths=[_fonts()]))
    return Path(path)


def _lay_out(root, texts, figures):
    """The template, its data and its figures side by side, as Typst wants them."""
    files = [{"file": f"{n}.svg", "title": picture.title} for n, picture in enumerate(figures)]
    data = {**texts, "figures": files, "colours": {role: light for role, (light, _) in ROLES.items()}}
    (root / "report.typ").write_bytes(TEMPLATE.read_bytes())
    (root / "data.json").write_text(json.dumps(data, allow_nan=False), encoding="utf-8")
    for file, picture in zip(files, figures, strict=True):
        (root / file["file"]).write_text(picture.svg, encoding="utf-8")


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
