"""Drawings of what the main keys of each kind measure: docs/img/dimensions/NAME.svg, and the page that shows them."""

from collections.abc import Callable
from pathlib import Path

from drivewright import registry
from drivewright.report.dimension_drawings import dimension_figure
from drivewright.view.style import svg


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write the drawings of every kind, and docs/dimensions.md with all of them."""
    folder = docs / "img" / "dimensions"
    folder.mkdir(parents=True, exist_ok=True)
    lines = ["# What the keys measure", "", "Drawn from the presets of each kind, to scale; a test compares every length with its key."]
    for kind in registry.kinds():
        lines += ["", f"## {kind}"]
        for sheet in registry.mechanism(kind).dimensions:
            progress(f"dimensions: {sheet.name}")
            (folder / f"{sheet.name}.svg").write_text(svg(dimension_figure(kind, sheet)), encoding="utf-8")
            lines += ["", f"![{sheet.title}](img/dimensions/{sheet.name}.svg)"]
    (docs / "dimensions.md").write_text("\n".join([*lines, ""]), encoding="utf-8")


if __name__ == "__main__":
    build(Path(__file__).parents[1], print)
