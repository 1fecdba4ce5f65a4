"""The reproduced papers as pages of their own, with a table of what agrees; what is in out/papers is not computed again."""

import shutil
from collections.abc import Callable
from pathlib import Path

from drivewright.reproduction import Paper, papers
from drivewright.reproduction.page import reproduce
from drivewright.reproduction.parts import Computed, parts_of, read_part
from drivewright.validation import VERDICTS, counts

FILES = ("index.html", "rows.json", "paper.pdf")


def build(docs: Path, progress: Callable[[str], None], full: bool = False) -> None:
    """Write docs/papers.md and a folder docs/papers/NAME for each paper."""
    lines = ["# Papers", "", "Five papers, each as a page in its own order: `drivewright reproduce NAME`.", ""]
    lines += [f"| paper | page | PDF | {' | '.join(VERDICTS)} |", f"|---|---|---|{'---:|' * len(VERDICTS)}"]
    left_out = []
    for paper in papers():
        folder = docs.parent / "out" / "papers" / paper.name
        solids = full or _solids_are_kept(paper, folder)
        left_out += [] if solids else [paper.title]

        def tell(done: int, total: int, what: str, name: str = paper.name) -> None:
            progress(f"{name}: {done} of {total} parts, {what}")

        page, computed = reproduce(paper, folder, solids, tell)
        _copy_page(page.parent, docs / "papers" / paper.name)
        lines.append(_row(paper, computed))
    lines += ["", "Counted are printed numbers and claims, each by the best of its readings;"]
    lines += ["what is calibrated or from the print alone is not compared."]
    if left_out:
        lines += ["", f"Left out here, for they take minutes: the finite-element parts of {', '.join(left_out)}."]
        lines += ["`drivewright reproduce NAME` computes them."]
    (docs / "papers.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def _solids_are_kept(paper: Paper, folder: Path) -> bool:
    """Whether every finite-element part was computed before, by these sources."""
    return all(read_part(folder / "parts" / part.file) is not None for part in parts_of(paper) if part.solids)


def _copy_page(source: Path, target: Path) -> None:
    shutil.rmtree(target, ignore_errors=True)
    target.mkdir(parents=True)
    for file in FILES:
        if (source / file).is_file():
            shutil.copyfile(source / file, target / file)


def _row(paper: Paper, computed: Computed) -> str:
    """A line of the table: title, links, how many numbers have each verdict."""
    found = counts(computed.rows)
    links = f"[page](papers/{paper.name}/index.html) | [PDF](papers/{paper.name}/paper.pdf)"
    return f"| {paper.title} | {links} | {' | '.join(str(found[verdict]) for verdict in VERDICTS)} |"
