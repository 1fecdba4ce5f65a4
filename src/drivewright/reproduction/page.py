"""A paper's page, its PDF and its rows.json, written from computed parts."""

import json
import re
import tempfile
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

from drivewright import atomic
from drivewright.digits import EXACT
from drivewright.errors import InputError, MissingExtra
from drivewright.report.content import Picture, program
from drivewright.report.folder import refuse_other
from drivewright.report.html import embedded, page
from drivewright.report.pdf import compile_template
from drivewright.reproduction.document import AS_PRINTED, CORRECTED, DEFINITION, UNDECIDED, Equation, Figure, Grid, Paper, Section
from drivewright.reproduction.formulas import formula_picture
from drivewright.reproduction.parts import Computed, Progress, compute_parts
from drivewright.validation.source import (
    AGREES,
    CALIBRATED,
    EVALUATED,
    EXPLAINED,
    IMPLIED,
    NOT_COMPARED,
    NUMBER,
    OPEN,
    PRINT_ONLY,
    VERDICTS,
    Row,
    counts,
)
from drivewright.view.text import SUPERSCRIPT, number, numbers, sentence, shown_scale, with_unit

Content: TypeAlias = dict[str, Any]
STATES = {AGREES: "good", EXPLAINED: "warn", OPEN: "bad", NOT_COMPARED: "none"}
EQUATION_STATES = {AS_PRINTED: "good", CORRECTED: "bad", UNDECIDED: "warn", DEFINITION: "none"}
MEANINGS = {
    AGREES: "our number rounds to the printed one, or meets what is claimed",
    EXPLAINED: "our number under another reading, named in the remark, gives the printed one",
    OPEN: "no reading that we know gives the printed number",
    NOT_COMPARED: "calibrated on the print, made of printed numbers alone, or without a counterpart",
}
BASIS_WORDS = {CALIBRATED: "not compared: calibrated", PRINT_ONLY: "not compared: print only"}
GREEK = {"alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "theta": "θ", "phi": "φ", "psi": "ψ", "mu": "μ", "omega": "ω"}
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
    refuse_foreign(out, paper.name)
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


def refuse_foreign(out: Path, name: str) -> None:
    """InputError where `out` is a file or a folder that holds something else than the page of this paper."""
    refuse_other(out, "reproduced paper", lambda folder: (folder / "parts").is_dir(), "folder of its parts")
    rows = json.loads((out / ROWS_FILE).read_text(encoding="utf-8")) if (out / ROWS_FILE).is_file() else []
    if others := {row["source"] for row in rows} - {name}:
        raise InputError(f"{out}: holds the page of {', '.join(sorted(others))}; give {name} another --out. Nothing was written")


# -- what the page says --------------------------------------------------------------------------------------------------------


def content(paper: Paper, computed: Computed) -> Content:
    """The page as plain text in plain dictionaries; pictures are `Picture`s."""
    remarks = Footnotes()
    sections = [_section(section, computed, remarks) for section in paper.sections]
    return {
        "name": paper.name,
        "mechanism": "Reproduction",
        "title": paper.title,
        "citation": paper.source.citation,
        "summary": paper.summary,
        "version": program(),
        "verdict": verdict(computed.rows),
        "counts": [
            {"verdict": in_number(name, count), "count": count, "state": STATES[name], "meaning": MEANINGS[name]}
            for name, count in counts(computed.rows).items()
        ],
        "inputs": [each._asdict() for each in paper.inputs],
        "sections": sections,
        "remarks": missing_parts(paper, computed),
        "readings": readings(computed.rows),
        "footnotes": list(remarks),
        "errata": [pretty(text) for text in paper.source.errata],
        "equations": in_words(_equations(paper)),
        "command": f"drivewright reproduce {paper.name}{' --no-solids' if computed.left_out else ''} --out DIR",
    }


def verdict(rows: Sequence[Row]) -> dict[str, str]:
    """{'state', 'text'}: how many of the printed numbers agree."""
    found = counts(rows)
    compared = sum(found.values()) - found[NOT_COMPARED]
    state = "good" if found[AGREES] == compared else "warn"
    return {"state": state, "text": f"{found[AGREES]} of {compared} compared numbers and claims agree"}


def missing_parts(paper: Paper, computed: Computed) -> list[str]:
    """What is not on the page, a line for each reason: figures and tables by their names, numbers and studies as such."""
    named = {figure.number for figure in paper.figures} | {listing.name for listing in paper.listings}
    lines: dict[str, list[str]] = {}
    for name, reason in computed.missing.items():
        lines.setdefault(reason, []).append(name if name in named else "numbers that need solid models")
    return [f"{sentence(reason)}: {', '.join(dict.fromkeys(names))}." for reason, names in lines.items()]


def readings(rows: Sequence[Row]) -> str:
    """What is counted, and the formulas that are counted apart."""
    printed, formulas, expected = counts(rows), counts(rows, EVALUATED), counts(rows, IMPLIED)
    total, compared = sum(printed.values()), sum(printed.values()) - printed[NOT_COMPARED]
    text = f"The paper prints {total} numbers and claims, of which {compared} can be compared; where one can be read in several ways, the "
    text += "reading that agrees best counts."
    if any(formulas.values()):
        text += f" Counted apart are formulas that are evaluated for its inputs: {in_words(formulas)}."
    if any(expected.values()):
        text += f" So is what its text implies and does not say: {in_words(expected)}."
    return f"{text} The tables below have {len(rows)} rows."


def in_number(verdict: str, count: int) -> str:
    """The verdict of so many: '1 agrees', '2 agree', '2 differ, open', '2 definitions'."""
    return verdict if count == 1 else re.sub(r"definition$", "definitions", re.sub(r"^(agree|differ)s", r"\1", verdict))


def in_words(found: Mapping[str, int]) -> str:
    """'2 agree; 8 differ, open' of the numbers of verdicts."""
    return "; ".join(f"{count} {in_number(verdict, count)}" for verdict, count in found.items() if count)


def _equations(paper: Paper) -> dict[str, int]:
    """{verdict: how many equations have it}, in the order of the verdicts."""
    found = Counter(equation.verdict for section in paper.sections for equation in section.equations)
    return {verdict: found[verdict] for verdict in EQUATION_STATES if found[verdict]}


class Footnotes(list[str]):
    """The remarks in the order in which the page first points to them."""

    def mark(self, remark: str) -> str:
        """The number of a remark, "" for none."""
        if not remark:
            return ""
        if remark not in self:
            self.append(remark)
        return str(self.index(remark) + 1)


def _section(section: Section, computed: Computed, remarks: Footnotes) -> Content:
    rows = {row.name: row for row in computed.rows if row.where in section.places}
    in_grids = {name for grid in section.grids for _, names in grid.rows for name in names}
    return {
        "title": section.title,
        "id": "".join(letter if letter.isalnum() else "-" for letter in section.title.lower()),
        "claims": list(section.claims),
        "equations": [_equation(equation) for equation in section.equations],
        "grids": [_grid(grid, rows, remarks) for grid in section.grids],
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


def row_content(row: Row, remarks: Footnotes) -> Content:
    """A row as the tables show it."""
    ours, interval = ours_texts(row)
    return {
        "quantity": sentence(pretty(row.name)),
        "where": row.where,
        "printed": pretty(row.printed.text),
        "ours": ours,
        "interval": interval,
        "deviation": deviation_text(row),
        "verdict": BASIS_WORDS.get(row.basis, row.verdict),
        "state": STATES[row.verdict],
        "remark": remarks.mark(pretty(row.commentary)),
    }


def ours_texts(row: Row) -> tuple[str, str]:
    """(our number in the unit people read, its 95 % interval or ""); of a number near the print as many digits as that has."""
    if row.ours is None:
        return "–", ""
    factor, unit = shown_scale(row.unit, row.printed.unit)[:2]
    low, high = (None if end is None else end * factor for end in (row.low, row.high))
    middle, *ends = numbers(row.ours * factor, low, high, _digits(row))
    return with_unit(middle, unit), f"{ends[0]} to {ends[1]}" if ends[0] else ""


def _digits(row: Row) -> int:
    """How many digits of our number say something beside the print."""
    printed = re.match(NUMBER, row.printed.text)
    near = row.deviation is not None and row.ours is not None and abs(row.deviation) < NEAR * abs(row.ours)
    if printed is None or not near or row.low is not None:
        return EXACT
    digits = re.sub(r"e.*|\D", "", printed[0]).lstrip("0")
    return min(max(len(digits), EXACT), MOST_DIGITS)


def deviation_text(row: Row) -> str:
    """The deviation to three digits in the unit people read, with a sign; nothing where nothing is compared."""
    if not row.deviation_text() or row.deviation is None or row.ours is None:
        return ""
    if row.verdict == AGREES and abs(row.deviation) <= ROUNDING * abs(row.ours):
        return "0"
    factor, unit = shown_scale(row.unit, row.printed.unit)[:2]
    text = with_unit(number(row.deviation * factor, 3), unit)
    return text if text.startswith("−") else f"+{text}"


def pretty(text: str) -> str:
    """A text with the signs of print: 'um/kN' -> 'µm/kN', '-40' -> '−40', '4.560e11 min' -> '4.560×10¹¹ min', 'alpha0' -> 'α0'."""
    text = re.sub(r"(?<=\d)e([+-]?\d+)\b", lambda found: f"×10{found[1].translate(SUPERSCRIPT)}", text)
    text = re.sub(r"(?<![\w.)])-(?=\d)", "−", re.sub(r"\bu(?=(m|rad)\b)", "µ", text))
    text = re.sub(rf"\b({'|'.join(GREEK)})_?(?=\d|p2|\b)", lambda found: GREEK[found[1]], text)
    text = re.sub(r"\^(\d)", lambda found: found[1].translate(SUPERSCRIPT), text)
    return re.sub(r"(?<=\d) deg\b", "°", text).replace(">= ", "≥ ").replace(" << ", " ≪ ")


def _grid(grid: Grid, rows: dict[str, Row], remarks: Footnotes) -> Content:
    """Printed above ours in each cell."""
    cells = [[_cell(rows.get(name)) for name in names] for _, names in grid.rows]
    shown = [rows[name] for _, names in grid.rows for name in names if name in rows]
    return {
        "title": grid.title,
        "remarks": list(dict.fromkeys(remarks.mark(pretty(row.commentary)) for row in shown if row.commentary)),
        "corner": grid.corner,
        "columns": list(grid.columns),
        "side": [name for name, _ in grid.rows],
        "cells": cells,
    }


def _cell(row: Row | None) -> Content:
    if row is None:
        return {"printed": "", "ours": "", "state": "none", "verdict": ""}
    ours, interval = ours_texts(row)
    return {
        "printed": row.printed.text,
        "ours": f"{ours} ({interval})" if interval else ours,
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
                "counts": [
                    {"verdict": in_number(verdict, found[verdict]), "count": found[verdict], "state": STATES[verdict]}
                    for verdict in VERDICTS
                ],
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
