"""Fill the pages that are made from the code: home, theory of each mechanism, motion-law peaks, gallery, reference."""

import shutil
from pathlib import Path

from drivewright import motion, registry
from drivewright.cli.gallery import examples
from drivewright.spec import read_document

DOCS = Path(__file__).parent
PAGES = ("motion", "curves", "gears", "cams", "contact", "bearings.ball", "bearings.roller", "bearings.solving", "bearings.quick",
         "bearings.catalogue", "shafts.model", "shafts.equilibrium", "shafts.influence", "shafts.vibration", "shafts.batch", "chains.link",
         "chains.meshing", "chains.tooth", "chains.plate", "chains.sprocket", "chains.closure.drive", "chains.dynamics.model",
         "chains.dynamics.simulate", "chains.implicit.equilibrium", "chains.standards", "fatigue.material", "fatigue.critical",
         "fatigue.rainflow", "fatigue.curves", "materials",
         "units", "spec", "result", "scene", "errors")


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


def main():
    text = (DOCS.parent / "README.md").read_text(encoding="utf-8").replace("](docs/", "](")
    (DOCS / "index.md").write_text(text, encoding="utf-8")
    for kind in registry.kinds():
        shutil.copyfile(registry.mechanism(kind).folder / "theory.md", DOCS / "theory" / f"{kind}.md")
    text = (DOCS / "theory" / "motion.in.md").read_text(encoding="utf-8").replace("{{ motion_peaks }}", peaks())
    (DOCS / "theory" / "motion.md").write_text(text, encoding="utf-8")
    (DOCS / "gallery.md").write_text(gallery(), encoding="utf-8")
    (DOCS / "reference.md").write_text(
        "# Reference\n\n" + "\n\n".join(f"::: drivewright.{name}" for name in PAGES) + "\n", encoding="utf-8"
    )


if __name__ == "__main__":
    main()
