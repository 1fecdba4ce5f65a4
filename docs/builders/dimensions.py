"""Drawings of what the main keys of each kind measure: in the folder of the kind, for the studio, and in docs/img/dimensions."""

import shutil
from collections.abc import Callable
from pathlib import Path

from drivewright import registry
from drivewright.report.dimension_drawings import write_drawings


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write the drawings of every kind, and docs/dimensions.md with all of them."""
    folder = docs / "img" / "dimensions"
    folder.mkdir(parents=True, exist_ok=True)
    lines = ["# What the keys measure", "", "Drawn from the presets of each kind, to scale; a test compares every length with its key."]
    for kind in registry.kinds():
        lines += ["", f"## {kind}"]
        for sheet, path in zip(registry.mechanism(kind).dimensions, write_drawings(kind, progress), strict=True):
            shutil.copyfile(path, folder / path.name)
            lines += ["", f"![{sheet.title}](img/dimensions/{path.name})"]
    (docs / "dimensions.md").write_text("\n".join([*lines, ""]), encoding="utf-8")


if __name__ == "__main__":
    build(Path(__file__).parents[1], print)
