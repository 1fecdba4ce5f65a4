"""Drawings of what the main keys of each kind measure: in the folder of the kind, for the studio, and in docs/img/dimensions."""

import shutil
from collections.abc import Callable
from pathlib import Path

from drivewright import registry
from drivewright.report.dimension_drawings import write_drawings


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write the drawings of every kind."""
    folder = docs / "img" / "dimensions"
    folder.mkdir(parents=True, exist_ok=True)
    for kind in registry.kinds():
        for path in write_drawings(kind, progress):
            shutil.copyfile(path, folder / path.name)


if __name__ == "__main__":
    build(Path(__file__).parents[1], print)
