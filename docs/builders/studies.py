"""The worked studies: what each says at its head, and the figures of its report."""

import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

import drivewright as dw
from drivewright.report.study import write_answers
from drivewright.studies.answers import analyse_study

FIGURES = 6  # of each study
KINDS = ("pareto", "map", "curve", "histogram", "contributions")  # of figures, in the order in which they are shown


def build(docs: Path, progress: Callable[[str], None], full: bool = False) -> None:
    """Write docs/worked-studies.md and its figures."""
    lines = ["# Worked studies", "", "Made by running the files of `examples/studies`; [Studies](studies.md) says how to write one."]
    paths = sorted((docs.parent / "examples" / "studies").glob("*.toml"))
    with tempfile.TemporaryDirectory() as scratch:
        for number, path in enumerate(paths, 1):
            progress(f"{number} of {len(paths)}: {path.stem}")
            lines += _section(docs, path, Path(scratch))
    (docs / "worked-studies.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def _section(docs: Path, path: Path, scratch: Path) -> list[str]:
    """Lines of one study, which is run here."""
    study = dw.sweep(dw.load(path), out=scratch / path.stem)
    report = write_answers(study, analyse_study(study), study.folder)
    drawn = docs / "worked-studies" / path.stem
    shutil.rmtree(drawn, ignore_errors=True)
    shutil.copytree(report.parent / "figures", drawn)
    chosen = sorted(drawn.glob("*.svg"), key=_place)[:FIGURES]
    return [
        "",
        f"## {study.spec.title}",
        "",
        *_head(path),
        "",
        f"`{path.name}`: {len(study)} cases. Figures of its report:",
        "",
        *(f"![{svg.stem}](worked-studies/{path.stem}/{svg.name})" for svg in chosen),
    ]


def _place(svg: Path) -> tuple[int, str]:
    """Where a figure comes: by what it is, then by its name."""
    kind = svg.name.removeprefix("plot-").split(".")[0]
    return (KINDS.index(kind) if kind in KINDS else len(KINDS)), svg.name


def _head(path: Path) -> list[str]:
    """The comment at the head of a spec, as it stands there."""
    lines = path.read_text(encoding="utf-8").splitlines()
    end = next(number for number, line in enumerate(lines) if not line.startswith("#"))
    return ["```text", *(line.removeprefix("#").removeprefix(" ") for line in lines[:end]), "```"]
