"""The worked studies: what each says at its head, and the figures of its report.

Those that take a minute or more keep their figures in docs/img/studies, from all their cases; `--full` computes them again.
"""

import hashlib
import json
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

import drivewright as dw
from drivewright.report.study import write_answers
from drivewright.studies.answers import analyse_study

SLOW = ("clearance_bifurcation", "knife_kd_calibrated", "knife_kd_map")
FIGURES = 6  # of each study
KINDS = ("pareto", "map", "curve", "histogram", "contributions")  # of figures, in the order in which they are shown
RECORD = "made.json"  # beside the figures that are kept: of which spec they are, and how many cases it has


def build(docs: Path, progress: Callable[[str], None], full: bool = False) -> None:
    """Write docs/worked-studies.md and its figures."""
    lines = ["# Worked studies", "", "Made by running the files of `examples/studies`; [Studies](studies.md) says how to write one."]
    shutil.rmtree(docs / "worked-studies", ignore_errors=True)
    paths = sorted((docs.parent / "examples" / "studies").glob("*.toml"))
    for number, path in enumerate(paths, 1):
        progress(f"{number} of {len(paths)}: {path.stem}")
        folder = docs / ("img/studies" if path.stem in SLOW else "worked-studies") / path.stem
        if full or path.stem not in SLOW:
            _draw(path, folder)
        _refuse_other_spec(path, folder)
        lines += _section(docs, path, folder)
    (docs / "worked-studies.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def _draw(path: Path, folder: Path) -> None:
    """Run a study and keep the first figures of its report."""
    with tempfile.TemporaryDirectory() as scratch:
        study = dw.sweep(dw.load(path), out=Path(scratch) / path.stem)
        report = write_answers(study, analyse_study(study), study.folder or Path(scratch))
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for svg in sorted((report.parent / "figures").glob("*.svg"), key=_place)[:FIGURES]:
            shutil.copyfile(svg, folder / svg.name)
        record = {"spec": _digest(path), "cases": len(study)}
        (folder / RECORD).write_text(json.dumps(record) + "\n", encoding="utf-8")


def _refuse_other_spec(path: Path, folder: Path) -> None:
    """SystemExit where kept figures are not there, or were made of another spec."""
    record = folder / RECORD
    if not record.is_file() or json.loads(record.read_text(encoding="utf-8"))["spec"] != _digest(path):
        raise SystemExit(f"{path.name} has changed since its figures in {folder} were made: run docs/generate.py studies --full")


def _digest(path: Path) -> str:
    """Of the spec, text and numbers in SI; titles and formatting aside."""
    spec = dw.load(path)
    study = repr(spec.study.model_copy(update={"points": None})) if spec.study else ""
    return hashlib.sha256((spec.digest() + study).encode()).hexdigest()[:20]


def _section(docs: Path, path: Path, folder: Path) -> list[str]:
    """Lines of one study."""
    cases = json.loads((folder / RECORD).read_text(encoding="utf-8"))["cases"]
    place = folder.relative_to(docs).as_posix()
    return [
        "",
        f"## {dw.load(path).title}",
        "",
        *_head(path),
        "",
        f"`{path.name}`: {cases} cases. Figures of its report:",
        "",
        *(f"![{svg.stem}]({place}/{svg.name})" for svg in sorted(folder.glob("*.svg"), key=_place)),
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
