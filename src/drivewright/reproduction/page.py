"""A paper's page, its PDF and its rows.json, written from computed parts."""

import json
import re
import tempfile
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

from drivewright import atomic
from drivewright.digits import EXACT
from drivewright.errors import MissingExtra
from drivewright.report.content import Picture, program
from drivewright.report.folder import refuse_other
from drivewright.report.html import embedded, page
from drivewright.report.pdf import compile_template
from drivewright.reproduction.document import AS_PRINTED, CORRECTED, DEFINITION, UNDECIDED, Equation, Figure, Grid, Paper, Section
from drivewright.reproduction.formulas import formula_picture
from drivewright.reproduction.parts import Computed, Progress, compute_parts
from drivewright.validation.source import AGREES, CALIBRATED, EXPLAINED, NOT_COMPARED, OPEN, PRINT_ONLY, VERDICTS, Row, best_verdicts
from drivewright.view.text import SUPERSCRIPT, quantity, sentence, uncertain

Content: TypeAlias = dict[str, Any]
STATES = {AGREES: "good", EXPLAINED: "warn", OPEN: "bad", NOT_COMPARED: "none"}
EQUATION_STATES = {AS_PRINTED: "good", CORRECTED: "bad", UNDECIDED: "warn", DEFINITION: "none"}
MEANINGS = {
    AGREES: "our number rounds to the printed one, or meets what is claimed",
    EXPLAINED: "our number under another reading, named in the remark, gives the printed one",
    OPEN: "no reading that we know gives the printed number",
    NOT_COMPARED: "calibrated on the print, made of printed numbers alone, or without a counterpart",
}
BASIS_WORDS = {CALIBRATED: "calibrated", PRINT_ONLY: "print only"}
MOST_DIGITS = 9
NEAR = 1e-3  # of our number: beyond it more digits of ours than usual say nothing
ROUNDING = 1e-6  # of our number: less says nothing beside the digits of a print
PAGE, ROWS_FILE, PDF = "index.html", "rows.json", "paper.pdf"


def reproduce(
    paper: Paper, out: str | Path, solids: bool = True, progress: Progress = lambda done, total, what: None
) -> tuple[Path, Computed]:
    """Write index.html, rows.json, figures/*.svg and, where Typst is installed, paper.pdf of a paper into `out`.

    What takes long is kept in `out`/parts and `out`/studies: the same call again goes on where it stopped.  InputError for a folder that
    is not empty and holds something else.  Returns (path of the page, what was computed).
    """
    out = Path(out).resolve()
    refuse_foreign(out)
    (out / "parts").mkdir(parents=True, exist_ok=True)
    computed = compute_parts(paper, out, solids, progress)
    write_pages(paper, computed, out)
    return out / PAGE, computed


def write_pages(paper: Paper, computed: Computed, out: Path) -> None:
    """Every file of a page, the page itself last."""
    texts = content(paper, computed)
    for picture in computed.pictures.values():
        atomic.write_text(out / "figures" / f"{picture.name}.svg", picture.svg)
    records = [row.record(paper.name) for row in computed.rows]
    atomic.write_text(out / ROWS_FILE, json.dumps(records, indent=1, ensure_ascii=False, allow_nan=False) + "\n")
    try:
        write_pdf(texts, out / PDF)
    except MissingExtra as missing:
        texts["remarks"] = [*texts["remarks"], f"No PDF: {missing}"]
    atomic.write_text(out / PAGE, page("paper.html.j2", embedded_content(texts)))


def refuse_foreign(out: Path) -> None:
    """InputError where `out` is a file or a folder that holds something else than a page of a paper."""
    refuse_other(out, "reproduced paper", lambda folder: (folder / "parts").is_dir(), "folder of its parts")


# -- what the page says --------------------------------------------------------------------------------------------------------


def counts(rows: Iterable[Row]) -> dict[str, int]:
    """How many printed numbers and claims have each verdict, the best of their readings, in the order of the verdicts."""
    found = Counter(best_verdicts(rows).values())
    return {verdict: found[verdict] for verdict in VERDICTS}


def content(paper: Paper, computed: Computed) -> Content:
    """The page as plain text in plain dictionaries; pictures are `Picture`s."""
    remarks = list(dict.fromkeys(row.commentary for row in computed.rows if row.commentary))
    return {
        "name": paper.name,
        "mechanism": "Reproduction",
        "title": paper.title,
        "citation": paper.source.citation,
        "summary": paper.summary,
        "version": program(),
        "verdict": verdict(computed.rows),
        "counts": [
            {"verdict": name, "count": count, "state": STATES[name], "meaning": MEANINGS[name]}
            for name, count in counts(computed.rows).items()
        ],
        "inputs": [each._asdict() for each in paper.inputs],
        "sections": [_section(section, computed, remarks) for section in paper.sections],
        "remarks": [f"{name}: {reason}" for name, reason in computed.missing.items()],
        "readings": f"{len(computed.rows)} rows for {len(best_verdicts(computed.rows))} printed numbers and claims, printed equations "
        "evaluated for the inputs among them; of several readings of one number the best counts.",
        "footnotes": remarks,
        "errata": list(paper.source.errata),
        "equations": [f"{count} {name}" for name, count in Counter(e.verdict for s in paper.sections for e in s.equations).items()],
        "command": f"drivewright reproduce {paper.name}{' --no-solids' if computed.left_out else ''} --out DIR",
    }


def verdict(rows: Sequence[Row]) -> dict[str, str]:
    """{'state', 'text'}: how many of the printed numbers agree."""
    found = counts(rows)
    compared = sum(found.values()) - found[NOT_COMPARED]
    state = "good" if found[AGREES] == compared else "warn"
    return {"state": state, "text": f"{found[AGREES]} of {compared} compared numbers and claims agree"}


def _section(section: Section, computed: Computed, remarks: list[str]) -> Content:
    rows = {row.name: row for row in computed.rows if row.where in section.places}
    in_grids = {name for grid in section.grids for _, names in grid.rows for name in names}
    return {
        "title": section.title,
        "id": "".join(letter if letter.isalnum() else "-" for letter in section.title.lower()),
        "claims": list(section.claims),
        "equations": [_equation(equation) for equation in section.equations],
        "grids": [_grid(grid, rows) for grid in section.grids],
        "rows": [row_content(row, remarks) for row in rows.values() if row.name not in in_grids],
        "figures": [_figure(figure, computed) for figure in section.figures],
        "missing": list(section.missing),
        "listings": [
            {"title": listing.title, "caption": listing.caption, **computed.listings[listing.name]}
            for listing in section.listings
            if listing.name in computed.listings
        ],
    }


def _equation(equation: Equation) -> Content:
    return {
        "number": equation.number,
        "picture": Picture(f"equation-{equation.number}", f"Equation {equation.number}", formula_picture(equation.printed)),
        "right": Picture(f"right-{equation.number}", "Corrected", formula_picture(equation.right)) if equation.right else None,
        "verdict": equation.verdict,
        "state": EQUATION_STATES[equation.verdict],
        "remark": equation.remark,
    }


def row_content(row: Row, remarks: list[str]) -> Content:
    """A row as the tables show it."""
    return {
        "quantity": sentence(row.name),
        "where": row.where,
        "printed": pretty(row.printed.text),
        "ours": ours_text(row).partition(" (")[0] if row.low is not None else ours_text(row),
        "interval": interval_text(row),
        "deviation": deviation_text(row),
        "verdict": BASIS_WORDS.get(row.basis, row.verdict),
        "state": STATES[row.verdict],
        "remark": str(remarks.index(row.commentary) + 1) if row.commentary else "",
    }


def ours_text(row: Row) -> str:
    """Our number in the unit people read; of one near the print as many digits as that has."""
    if row.ours is None:
        return "–"
    text = row.printed.text.split(" ")[0].split("e")[0]
    near = row.deviation is not None and abs(row.deviation) < NEAR * abs(row.ours)
    digits = max(len(text.lstrip("+-0.").replace(".", "")), EXACT) if near and row.low is None else EXACT
    return uncertain(row.ours, row.unit, row.low, row.high, min(digits, MOST_DIGITS))


def interval_text(row: Row) -> str:
    """The 95 % interval, "" where there is none or it says nothing."""
    found = re.search(r"\((.*)\)(.*)", ours_text(row))
    return f"{found[1]}{found[2]}" if found and row.low is not None else ""


def deviation_text(row: Row) -> str:
    """The deviation to three digits in the unit people read, with a sign; nothing where nothing is compared."""
    if not row.deviation_text() or row.deviation is None or row.ours is None:
        return ""
    if abs(row.deviation) <= ROUNDING * abs(row.ours):
        return "0"
    text = quantity(row.deviation, row.unit, 3)
    return text if text.startswith("−") else f"+{text}"


def pretty(printed: str) -> str:
    """A printed number with the signs of print: 'um/kN' -> 'µm/kN', '-40' -> '−40', '4.560e11 min' -> '4.560×10¹¹ min'."""
    text = re.sub(r"(?<=\d)e([+-]?\d+)", lambda found: f"×10{found[1].translate(SUPERSCRIPT)}", printed)
    text = re.sub(r"^-(?=\d)", "−", re.sub(r"\bum\b", "µm", text))
    return re.sub(r"(?<=\d) deg\b", "°", text).replace("^2", "²").replace("^4", "⁴")


def _grid(grid: Grid, rows: dict[str, Row]) -> Content:
    """Printed above ours in each cell."""
    cells = [[_cell(rows.get(name)) for name in names] for _, names in grid.rows]
    return {
        "title": grid.title,
        "corner": grid.corner,
        "columns": list(grid.columns),
        "side": [name for name, _ in grid.rows],
        "cells": cells,
    }


def _cell(row: Row | None) -> Content:
    if row is None:
        return {"printed": "", "ours": "", "state": "none", "verdict": ""}
    return {
        "printed": row.printed.text,
        "ours": ours_text(row),
        "state": STATES[row.verdict],
        "verdict": BASIS_WORDS.get(row.basis, row.verdict),
    }


def _figure(figure: Figure, computed: Computed) -> Content:
    return {
        "number": figure.number,
        "title": figure.title,
        "caption": figure.caption,
        "picture": computed.pictures.get(figure.number),
        "missing": computed.missing.get(figure.number, ""),
    }


def embedded_content(texts: Content) -> Content:
    """The same with every picture as an image that the page carries."""
    return {key: _embedded(value) for key, value in texts.items()}


def _embedded(value: Any) -> Any:
    if isinstance(value, Picture):
        return embedded(value)
    if isinstance(value, dict):
        return {key: _embedded(each) for key, each in value.items()}
    return [_embedded(each) for each in value] if isinstance(value, list) else value


# -- on paper ------------------------------------------------------------------------------------------------------------------


def write_pdf(texts: Content, path: Path) -> Path:
    """The page typeset by Typst; MissingExtra without it."""
    with tempfile.TemporaryDirectory() as name, atomic.replacing(path) as target:
        folder, pictures = Path(name), list[Picture]()
        data = _filed(texts, pictures)
        for number, picture in enumerate(pictures):
            (folder / f"{number}.svg").write_text(picture.svg, encoding="utf-8")
        target.write_bytes(compile_template("paper.typ", data, folder))
    return path


def _filed(value: Any, pictures: list[Picture]) -> Any:
    """The same with every picture as {'file', 'title'}; the pictures are collected in their order."""
    if isinstance(value, Picture):
        pictures.append(value)
        return {"file": f"{len(pictures) - 1}.svg", "title": value.title}
    if isinstance(value, dict):
        return {key: _filed(each, pictures) for key, each in value.items()}
    return [_filed(each, pictures) for each in value] if isinstance(value, list) else value


# -- all papers ----------------------------------------------------------------------------------------------------------------


def write_overview(papers: Sequence[Paper], computed: Mapping[str, Computed], folder: Path) -> Path:
    """index.html over the pages of several papers in folders of their own names, and rows.json with the rows of all."""
    cards, records = [], []
    for paper in papers:
        records += json.loads((folder / paper.name / ROWS_FILE).read_text(encoding="utf-8"))
        found = counts(computed[paper.name].rows)
        cards.append(
            {
                "name": paper.name,
                "title": paper.title,
                "summary": paper.summary,
                "link": f"{paper.name}/{PAGE}",
                "counts": [{"verdict": verdict, "count": found[verdict], "state": STATES[verdict]} for verdict in VERDICTS],
            }
        )
    atomic.write_text(folder / ROWS_FILE, json.dumps(records, indent=1, ensure_ascii=False, allow_nan=False) + "\n")
    total = sum(found["count"] for card in cards for found in card["counts"])
    texts = {
        "title": "The five papers, figure by figure",
        "mechanism": "Reproduction",
        "version": program(),
        "verdict": {"state": "warn", "text": f"{total} printed numbers"},
        "cards": cards,
    }
    atomic.write_text(folder / PAGE, page("papers.html.j2", texts))
    return folder / PAGE
