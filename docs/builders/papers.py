"""The reproduced papers as pages of their own, with a table of what agrees.

A page that `drivewright reproduce --all` has put into out/papers is taken from there.  Else it is computed here, without finite elements;
where it rests on studies of minutes it has no page.  With `full` every page is computed whole.
"""

import json
import shutil
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

from drivewright.reproduction import Paper, papers
from drivewright.reproduction.page import reproduce
from drivewright.reproduction.parts import Part, parts_of, read_part, row_of
from drivewright.validation import VERDICTS, counts
from drivewright.validation.source import Row

FILES = ("index.html", "rows.json", "paper.pdf")
WHOLE, EARLIER, NO_SOLIDS, ABSENT = "whole", "earlier", "no solids", "absent"
REMARKS = {
    EARLIER: "computed by an earlier state of the program",
    NO_SOLIDS: "without its finite-element parts",
    ABSENT: "not computed, for it takes minutes",
}


class Found(NamedTuple):
    """What there is of a paper: its rows, the folder of its page if it has one, and how complete it is."""

    rows: Sequence[Row]
    page: Path | None
    state: str


def build(docs: Path, progress: Callable[[str], None], full: bool = False) -> None:
    """Write docs/papers.md and a folder docs/papers/NAME for each paper."""
    shutil.rmtree(docs / "papers", ignore_errors=True)
    found = {}
    for paper in papers():
        found[paper] = _find(paper, docs.parent / "out", progress, full)
        if page := found[paper].page:
            _copy_page(page, docs / "papers" / paper.name)
    lines = ["# Papers", "", "Published papers, each as a page in its own order: `drivewright reproduce NAME` writes it.", ""]
    lines += [f"| name | paper | {' | '.join(VERDICTS)} |", f"|---|---|{'---:|' * len(VERDICTS)}"]
    lines += [_row(paper, each, docs) for paper, each in found.items()]
    lines += ["", "Counted are printed numbers and claims, each by the best of its readings;"]
    lines += ["what is calibrated or from the print alone is not compared."]
    lines += _remarks({paper.name: each.state for paper, each in found.items()})
    (docs / "papers.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def _find(paper: Paper, out: Path, progress: Callable[[str], None], full: bool) -> Found:
    """The page of a paper: kept, or computed now."""

    def tell(done: int, total: int, what: str) -> None:
        progress(f"{paper.name}: {done} of {total} parts, {what}")

    kept, parts = out / "papers" / paper.name, parts_of(paper)
    if full or all(read_part(_file(kept, part)) is not None for part in parts):
        page, computed = reproduce(paper, kept, True, tell)
        return Found(computed.rows, page.parent, WHOLE)
    if (kept / FILES[0]).is_file() and all(_file(kept, part).is_file() for part in parts):
        return Found(list(_kept_rows(kept, parts)), kept, EARLIER)
    if paper.studies:
        return Found((), None, ABSENT)
    page, computed = reproduce(paper, out / "docs" / "papers" / paper.name, False, tell)
    return Found(computed.rows, page.parent, NO_SOLIDS if any(part.solids for part in parts) else WHOLE)


def _file(folder: Path, part: Part) -> Path:
    return folder / "parts" / part.file


def _kept_rows(folder: Path, parts: Iterable[Part]) -> Iterable[Row]:
    """The rows of a page that other sources made."""
    for part in parts:
        record = json.loads(_file(folder, part).read_text(encoding="utf-8"))
        yield from map(row_of, record.get("rows", ()) if part.kind == "rows" else ())


def _copy_page(source: Path, target: Path) -> None:
    target.mkdir(parents=True)
    for file in FILES:
        if (source / file).is_file():
            shutil.copyfile(source / file, target / file)


def _row(paper: Paper, found: Found, docs: Path) -> str:
    """A line of the table: title, links, how many numbers have each verdict."""
    number = counts(found.rows) if found.page else dict.fromkeys(VERDICTS, "-")
    files = {"page": FILES[0], "PDF": FILES[2]} if found.page else {}
    links = [f"[{name}](papers/{paper.name}/{file})" for name, file in files.items() if (docs / "papers" / paper.name / file).is_file()]
    title = ": ".join(filter(None, [paper.title, ", ".join(links)]))
    return f"| `{paper.name}` | {title} | {' | '.join(str(number[verdict]) for verdict in VERDICTS)} |"


def _remarks(states: dict[str, str]) -> list[str]:
    """What is not whole, and why."""
    lines = []
    for state, remark in REMARKS.items():
        if names := [f"`{name}`" for name, each in states.items() if each == state]:
            lines += [f"- {', '.join(names)}: {remark}."]
    return ["", "Of this edition of the site:", "", *lines, ""] if lines else []
