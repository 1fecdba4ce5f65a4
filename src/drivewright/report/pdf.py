"""The report as a PDF (extra `pdf`): the same content as the page, typeset by Typst."""

import json
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from drivewright.atomic import replacing
from drivewright.errors import MissingExtra
from drivewright.report.content import Picture, Views, content, pictures, views
from drivewright.report.form import ReportForm
from drivewright.report.letterhead import read_letterhead
from drivewright.report.numbering import in_order, numbered_figures, seen_in, with_figures
from drivewright.report.paper_figures import size_of
from drivewright.report.words import words_of
from drivewright.result import Result
from drivewright.view.palette import ROLES

TEMPLATES = Path(__file__).parent / "templates"
FULL_WIDTH, HALF_WIDTH, THIRD_WIDTH = 493.0, 240.0, 157.0  # points: of the text, of one of two columns, of one of three
NARROW_UP_TO = 330.0  # points: plots that are still read when they are as wide as one of two columns
NARROW_TO_SCALE = 430.0  # points: the same of scenes and drawings, which have few words
LARGEST_SCALE, SCALE_OF_WIDE = 0.9, 0.62  # of a picture on paper; of scenes and drawings that are wider than half the text
TALLEST, TALLEST_OF_WIDE = 340.0, 270.0  # points: of a picture, of a wide scene or drawing
TALLEST_SHORT, TALLEST_ABOVE_MANY = 230.0, 170.0  # points: of a picture on a single page, beside few checks, above many
MANY_CHECKS = 18
FRAME = (
    "To pass",
    "Design checks",
    "Check",
    "Value",
    "Limit",
    "Margin",
    "Findings",
    "Warning:",
    "Figures",
    "Figure *:",
    "See figure *",
    "Values",
    "Quantity",
    "SI",
    "* to *",
    "Tables",
    "* rows",
    "Column",
    "Meaning",
    "Least",
    "Greatest",
    "Unit",
    "Spec",
    "Too large to print; it is in result.json.",
    "Too wide to print; it is in result.json.",
    "Sources and what to cite",
    "Provenance",
    "How it was computed",
    "Author: *",
    "page * of *",
)


def write_pdf(
    result: Result[Any],
    path: str | Path,
    seen: Views | None = None,
    figures: Sequence[Picture] | None = None,
    form: ReportForm = ReportForm(),
) -> Path:
    """Write the report of a result to `path`; MissingExtra without typst.

    `seen` is a `Views` (None: what the result's mechanism shows), `figures` are pictures already drawn (None: draw them for paper).
    """
    _typst()
    letterhead = read_letterhead(result.spec)
    chosen = seen_in(form, result, views(result) if seen is None else seen)
    drawn = pictures(result, chosen, language=form.language, paper=True) if figures is None else figures
    numbered = in_order(drawn, numbered_figures(result, chosen))
    with tempfile.TemporaryDirectory() as folder, replacing(path) as target:
        for number, picture in numbered:
            (Path(folder) / f"{number}.svg").write_text(picture.svg, encoding="utf-8")
        logo = f"logo{letterhead.suffix}" if letterhead.logo else ""
        if logo:
            (Path(folder) / logo).write_bytes(letterhead.logo)
        words = words_of(form.language)
        texts = with_figures(content(result, chosen.remarks, form=form), result, chosen)
        data = {
            **texts,
            "letterhead": {**texts["letterhead"], "logo": logo},
            "rows": single_page_rows(numbered, len(result.checks)) if form.detail == "short" else figure_rows(numbered),
            "many_checks": len(result.checks) > MANY_CHECKS,
            "words": {english: words(english) for english in FRAME},
        }
        target.write_bytes(compile_template("report.typ", data, Path(folder)))
    return Path(path)


def figure_rows(numbered: Sequence[tuple[int, Picture]]) -> list[list[dict[str, Any]]]:
    """Figures in rows of one or two: {"number", "file", "title", "width" [pt]}; two that are narrow and follow one another share a row."""
    rows: list[list[dict[str, Any]]] = []
    room = False  # for a further one in the last row
    for number, picture in numbered:
        size, is_plot = size_of(picture.svg), picture.name.startswith("plot-")
        narrow = size.width <= (NARROW_UP_TO if is_plot else NARROW_TO_SCALE)
        most = HALF_WIDTH if narrow else FULL_WIDTH if is_plot else SCALE_OF_WIDE * size.width
        entry = _entry(number, picture, min(most, FULL_WIDTH), TALLEST if narrow or is_plot else TALLEST_OF_WIDE)
        if narrow and room:
            rows[-1].append(entry)
            room = False
        else:
            rows.append([entry])
            room = narrow
    return rows


def single_page_rows(numbered: Sequence[tuple[int, Picture]], checks: int) -> list[list[dict[str, Any]]]:
    """The figures of a report on one page in a row, small enough to leave room for its checks."""
    width, tallest = (HALF_WIDTH, TALLEST_SHORT) if checks <= MANY_CHECKS else (THIRD_WIDTH, TALLEST_ABOVE_MANY)
    return [[_entry(number, picture, width, tallest) for number, picture in numbered]]


def _entry(number: int, picture: Picture, widest: float, tallest: float) -> dict[str, Any]:
    """What the template wants to know of a figure."""
    size = size_of(picture.svg)
    width = min(widest, LARGEST_SCALE * size.width, tallest * size.width / size.height)
    return {"number": number, "file": f"{number}.svg", "title": picture.title, "meaning": picture.meaning, "width": width}


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
