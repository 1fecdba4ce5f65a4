"""Fill the pages that are made from the code: home, theory, motion-law peaks, gallery, worked studies, papers, reference."""

import shutil
import tempfile
import time
from pathlib import Path

from drivewright import motion, registry
from drivewright.cli.gallery import examples
from drivewright.spec import read_document

DOCS = Path(__file__).parent
PAGES = (
    "motion",
    "curves",
    "gears",
    "cams",
    "contact",
    "bearings.ball",
    "bearings.roller",
    "bearings.solving",
    "bearings.dynamic_rating",
    "bearings.life",
    "bearings.stiffness_curve",
    "bearings.approximate_stiffness",
    "bearings.catalogue",
    "shafts.model",
    "shafts.equilibrium",
    "shafts.loads",
    "shafts.supports",
    "shafts.influence",
    "shafts.strength",
    "shafts.vibration",
    "shafts.batch",
    "chains.link",
    "chains.meshing",
    "chains.tooth",
    "chains.plate",
    "chains.sprocket",
    "chains.interference",
    "chains.closure.drive",
    "chains.model",
    "chains.explicit.simulate",
    "chains.explicit.motion",
    "chains.implicit.equilibrium",
    "chains.standards",
    "chains.stress.plate",
    "chains.stress.pins",
    "fatigue.material",
    "fatigue.critical",
    "fatigue.rainflow",
    "fatigue.curves",
    "materials",
    "studies.sweeps",
    "studies.variation",
    "studies.study",
    "studies.plan",
    "execution.executors",
    "studies.answers.whole",
    "studies.statistics",
    "studies.sensitivity",
    "studies.pareto",
    "studies.optimisation",
    "units",
    "spec",
    "result",
    "scene",
    "errors",
)


def peaks():
    """Markdown table of the peak factors of every law without parameters."""
    rows = ["| law | Vm | Am | Jm | AVm |", "|---|---|---|---|---|"]
    for name in motion.names():
        try:
            found = motion.law(name).peaks()
        except (TypeError, ValueError):
            continue  # a law that wants parameters
        rows.append(f"| {name} | " + " | ".join(f"{value:.6g}" for value in found) + " |")
    return "\n".join(rows)


def gallery():
    """The worked examples, one line each."""
    lines = ["# Gallery", "", "Run all of them with `drivewright examples --run all`; `out/index.html` shows them moving.", ""]
    for name, path in examples().items():
        data = read_document(path)
        lines.append(f"* **{name}** ({data['mechanism']}): {data.get('title', '')}")
    return "\n".join(lines) + "\n"


def worked_studies():
    """The worked studies: what each says at its head, and the figures of its report.  They are run here: a few minutes."""
    import drivewright as dw
    from drivewright.report.study import write_answers
    from drivewright.studies.answers import analyse_study

    lines = ["# Worked studies", "", "Made by running the files of `examples/studies`; [Studies](studies.md) says how to write one."]
    paths = sorted((DOCS.parent / "examples" / "studies").glob("*.toml"))
    with tempfile.TemporaryDirectory() as scratch:
        for number, path in enumerate(paths, 1):
            began = time.perf_counter()
            print(f"[{number}/{len(paths)}] {path.stem} ...", end=" ", flush=True)
            study = dw.sweep(dw.load(path), out=Path(scratch) / path.stem)
            report = write_answers(study, analyse_study(study), study.folder)
            print(f"{len(study)} cases, {time.perf_counter() - began:.1f} s", flush=True)
            drawn = DOCS / "worked-studies" / path.stem
            shutil.rmtree(drawn, ignore_errors=True)
            shutil.copytree(report.parent / "figures", drawn)
            chosen = sorted(drawn.glob("*.svg"), key=_first)[:FIGURES]
            lines += [
                "",
                f"## {study.spec.title}",
                "",
                *_head(path),
                "",
                f"`{path.name}`: {len(study)} cases. Figures of its report:",
                "",
                *(f"![{svg.stem}](worked-studies/{path.stem}/{svg.name})" for svg in chosen),
            ]
    return "\n".join(lines) + "\n"


FIGURES = 6  # of each study
KINDS = ("pareto", "map", "curve", "histogram", "contributions")  # of figures, as they are shown


def _first(svg):
    """Sorts figures: by what they are, then by name."""
    kind = svg.name.removeprefix("plot-").split(".")[0]
    return (KINDS.index(kind) if kind in KINDS else len(KINDS)), svg.name


def _head(path):
    """The comment at the head of a spec, as it stands there."""
    lines = path.read_text(encoding="utf-8").splitlines()
    end = next(number for number, line in enumerate(lines) if not line.startswith("#"))
    return ["```text", *(line.removeprefix("#").removeprefix(" ") for line in lines[:end]), "```"]


def reproduced_papers():
    """The papers as pages of their own, with a table of what agrees; computed in out/papers: some ten minutes once, a moment again."""
    from drivewright.reproduction import papers
    from drivewright.reproduction.page import reproduce
    from drivewright.validation import VERDICTS, counts

    lines = ["# Papers", "", "Five papers, each as a page in its own order: `drivewright reproduce NAME`.", ""]
    lines += [f"| paper | page | PDF | {' | '.join(VERDICTS)} |", f"|---|---|---|{'---:|' * len(VERDICTS)}"]
    for paper in papers():
        began = time.perf_counter()
        print(f"{paper.name} ...", end=" ", flush=True)
        page, computed = reproduce(paper, DOCS.parent / "out" / "papers" / paper.name)
        print(f"{len(computed.rows)} rows, {time.perf_counter() - began:.1f} s", flush=True)
        target = DOCS / "papers" / paper.name
        shutil.rmtree(target, ignore_errors=True)
        target.mkdir(parents=True)
        for file in ("index.html", "rows.json", "paper.pdf"):
            if (page.parent / file).is_file():
                shutil.copyfile(page.parent / file, target / file)
        found = counts(computed.rows)
        links = f"[page](papers/{paper.name}/index.html) | [PDF](papers/{paper.name}/paper.pdf)"
        lines.append(f"| {paper.title} | {links} | {' | '.join(str(found[verdict]) for verdict in VERDICTS)} |")
    counted = "Counted are printed numbers and claims, each by the best of its readings"
    lines += ["", f"{counted}; what is calibrated or from the print alone is not compared."]
    return "\n".join(lines) + "\n"


def main():
    text = (DOCS.parent / "README.md").read_text(encoding="utf-8").replace("](docs/", "](")
    (DOCS / "index.md").write_text(text, encoding="utf-8")
    for kind in registry.kinds():
        shutil.copyfile(registry.mechanism(kind).folder / "theory.md", DOCS / "theory" / f"{kind}.md")
    text = (DOCS / "theory" / "motion.in.md").read_text(encoding="utf-8").replace("{{ motion_peaks }}", peaks())
    (DOCS / "theory" / "motion.md").write_text(text, encoding="utf-8")
    (DOCS / "gallery.md").write_text(gallery(), encoding="utf-8")
    (DOCS / "worked-studies.md").write_text(worked_studies(), encoding="utf-8")
    (DOCS / "papers.md").write_text(reproduced_papers(), encoding="utf-8")
    (DOCS / "reference.md").write_text(
        "# Reference\n\n" + "\n\n".join(f"::: drivewright.{name}" for name in PAGES) + "\n", encoding="utf-8"
    )


if __name__ == "__main__":
    main()
