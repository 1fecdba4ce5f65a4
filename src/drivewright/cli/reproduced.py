"""Reproduced papers: listed, and written with progress."""

from collections.abc import Sequence
from pathlib import Path

import typer

from drivewright.cli import show
from drivewright.reproduction import Paper, papers
from drivewright.reproduction.page import in_words, reproduce, write_overview
from drivewright.reproduction.parts import Computed
from drivewright.validation.source import EVALUATED, IMPLIED, PRINTED, counts

INCOMPLETE = 4  # exit code where a part could not be computed


def listing() -> None:
    """Print name and title of each paper."""
    rows = [(paper.name, paper.title, f"{len(paper.figures)} figures") for paper in papers()]
    show.table("papers (drivewright reproduce NAME, or --all)", (("name", "left"), ("title", "left"), ("", "right")), rows)


def write_papers(chosen: Sequence[Paper], out: Path | None, several: bool, solids: bool) -> None:
    """Write the page of each paper, and with several an overview; exit 4 where a part is missing that was wanted."""
    base = out or (Path("out") / "papers" if several else Path("out") / chosen[0].name)
    missing, found = [], {}
    for paper in chosen:
        folder = base / paper.name if several else base
        with show.progress(paper.name) as step:
            page, computed = reproduce(paper, folder, solids, step)
        if computed.renewed:
            show.note(f"note: {computed.renewed} parts of {paper.name} were made by another version of the program and computed again")
        show.note(f"wrote {page}")
        found[paper.name] = computed
        print(summary(paper, computed))
        missing += [f"{paper.name}, {name}: {reason}" for name, reason in computed.missing.items() if name not in computed.left_out]
    if several:
        show.note(f"wrote {write_overview(chosen, found, base)}")
    for line in missing:
        show.note(f"note: {line}")
    if missing:
        raise typer.Exit(INCOMPLETE)


def summary(paper: Paper, computed: Computed) -> str:
    """'shaft-paper: 16 printed numbers and claims (6 agree; ...), 31 formulas evaluated (...)'."""
    names = {PRINTED: "printed numbers and claims", EVALUATED: "formulas evaluated", IMPLIED: "implied"}
    found = {name: counts(computed.rows, origin) for origin, name in names.items()}
    texts = [f"{sum(each.values())} {what} ({in_words(each)})" for what, each in found.items() if any(each.values())]
    return f"{paper.name}: {', '.join(texts)}"
