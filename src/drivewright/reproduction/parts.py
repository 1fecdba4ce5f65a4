"""What a paper's page is made of, computed part by part and kept: rows of numbers and figures, each in a file of its own.

A part that is there, made by the same sources of this package, is not computed again; so a page that was stopped goes on where it was,
and a finished one is written again in a moment.
"""

import json
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

from drivewright import atomic
from drivewright._jit.disk_cache import PACKAGE, hash_of
from drivewright.errors import DrivewrightError
from drivewright.execution.executors import side_by_side
from drivewright.report.content import Picture
from drivewright.reproduction.document import Paper
from drivewright.validation.source import Explanation, Printed, Row
from drivewright.view import svg

Progress: TypeAlias = Callable[[int, int, str], object]  # (done, total, what is computed)
ROWS, FIGURE, STUDY, LISTING = "rows", "figure", "study", "table"
QUICK = "source"  # name of the part with the rows that `validate` shows


class Part(NamedTuple):
    """One part: what it is (rows, figure, table or study), its name, and whether it needs solid models."""

    kind: str
    name: str
    solids: bool = False

    @property
    def file(self) -> str:
        """Name of its file."""
        return f"{self.kind}-{re.sub(r'[^a-z0-9]+', '-', self.name.lower()).strip('-')}.json"


@dataclass(frozen=True)
class Computed:
    """The parts of a paper: all rows, the figures by their numbers, and why some are not there."""

    rows: tuple[Row, ...]
    pictures: dict[str, Picture]
    missing: dict[str, str]  # name of a part -> reason
    left_out: frozenset[str] = frozenset()  # of those, what was not wanted
    renewed: int = 0  # parts that were there, but made by other sources of this package
    listings: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)  # name of a table -> {"heads", "rows"}


def parts_of(paper: Paper) -> tuple[Part, ...]:
    """Every part of a paper; studies first, for rows and figures are made of them."""
    return (
        *(Part(STUDY, study.name, study.solids) for study in paper.studies),
        Part(ROWS, QUICK),
        *(Part(ROWS, each.name, each.solids) for each in paper.long_rows),
        *(Part(FIGURE, figure.number, figure.solids) for figure in paper.figures),
        *(Part(LISTING, listing.name) for listing in paper.listings),
    )


def compute_parts(paper: Paper, folder: Path, solids: bool, progress: Progress) -> Computed:
    """Compute the parts of a paper that are not in `folder` yet, studies on all cores, then the others side by side."""
    kept, digest, wanted = folder / "parts", sources_digest(), [part for part in parts_of(paper) if solids or not part.solids]
    missing = {part.name: "left out by --no-solids" for part in parts_of(paper) if part not in wanted}
    todo = [part for part in wanted if read_part(kept / part.file) is None]
    done, stale = len(wanted) - len(todo), sum((kept / part.file).exists() for part in todo)
    for part in [part for part in todo if part.kind == STUDY]:
        progress(done, len(wanted), part.name)
        study = next(each for each in paper.studies if each.name == part.name)
        study.run(folder, _tell(progress, done, len(wanted), part.name))
        write_part(kept / part.file, {}, digest)
        done += 1
    others = [part for part in todo if part.kind != STUDY]
    for reason, part in _side_by_side(paper, others, folder, lambda finished, what: progress(done + finished, len(wanted), what)):
        if reason:
            missing[part.name] = reason
    left_out = frozenset(part.name for part in parts_of(paper) if part not in wanted)
    return replace(_collected(paper, kept, missing), left_out=left_out, renewed=stale)


def _tell(progress: Progress, done: int, total: int, name: str) -> Progress:
    return lambda cases, of, what: progress(done, total, f"{name}: {cases} of {of} cases")


def _side_by_side(paper: Paper, parts: list[Part], folder: Path, tell: Callable[[int, str], object]) -> Iterator[tuple[str, Part]]:
    """(why it is missing, part) of each part, computed in processes of their own."""
    running: list[str] = []

    def begun(index):
        running.append(parts[index].name)
        tell(count, ", ".join(running))

    count = 0
    calls = [(paper.name, part, str(folder), sources_digest()) for part in parts]
    for count, (index, reason) in enumerate(side_by_side(compute_part, calls, begun=begun) if calls else (), 1):
        running.remove(parts[index].name)
        tell(count, ", ".join(running))
        yield reason, parts[index]


def compute_part(paper_name: str, part: Part, folder: str, digest: str) -> str:
    """Compute rows or a figure and keep them; returns why that was not possible, "" where it was."""
    from drivewright.reproduction import papers

    paper, place = papers(paper_name)[0], Path(folder)
    try:
        record = MAKERS[part.kind](paper, part, place)
    except DrivewrightError as error:  # such as an extra that is not installed; the rest of the page does not need it
        return str(error)
    write_part(place / "parts" / part.file, record, digest)
    return ""


def _rows(paper: Paper, part: Part, folder: Path) -> dict[str, Any]:
    if part.name == QUICK:
        rows = paper.source.rows()
    else:
        rows = tuple(next(each for each in paper.long_rows if each.name == part.name).compute(folder))
    return {"rows": [asdict(row) for row in rows]}


def _figure(paper: Paper, part: Part, folder: Path) -> dict[str, Any]:
    figure = next(each for each in paper.figures if each.number == part.name)
    drawn = figure.draw(folder)
    return {"svg": drawn.svg if isinstance(drawn, Picture) else svg(drawn)}


def _listing(paper: Paper, part: Part, folder: Path) -> dict[str, Any]:
    heads, rows = next(each for each in paper.listings if each.name == part.name).make(folder)
    return {"heads": list(heads), "rows": rows}


MAKERS = {ROWS: _rows, FIGURE: _figure, LISTING: _listing}


def write_part(path: Path, record: dict[str, Any], digest: str) -> None:
    """A part as JSON with the digest of the sources that made it."""
    atomic.write_text(path, json.dumps({"sources": digest, **record}, ensure_ascii=False))


def read_part(path: Path) -> dict[str, Any] | None:
    """A part that the same sources made, else None."""
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return record if isinstance(record, dict) and record.get("sources") == sources_digest() else None


def sources_digest() -> str:
    """Digest of the sources of this package: other sources, other numbers."""
    return hash_of(PACKAGE).hex()[:20]


def _collected(paper: Paper, kept: Path, missing: dict[str, str]) -> Computed:
    """Everything that is there, in the paper's order."""
    rows, pictures, listings = [], {}, {}
    for part in parts_of(paper):
        record = None if part.name in missing else read_part(kept / part.file)
        if record is None or part.kind == STUDY:
            continue
        if part.kind == ROWS:
            rows += [row_of(each) for each in record["rows"]]
        elif part.kind == LISTING:
            listings[part.name] = {"heads": record["heads"], "rows": record["rows"]}
        else:
            title = next(figure.title for figure in paper.figures if figure.number == part.name)
            pictures[part.name] = Picture(part.file.removesuffix(".json"), title, record["svg"])
    return Computed(tuple(rows), pictures, missing, listings=listings)


def row_of(record: dict[str, Any]) -> Row:
    """The row that `dataclasses.asdict` and JSON have taken apart."""
    explanation = record["explanation"]
    return Row(**record | {"printed": Printed(*record["printed"]), "explanation": explanation and Explanation(*explanation)})
