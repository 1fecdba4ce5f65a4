"""Drawings of what the main keys of each kind measure, in the folder of the kind (which keeps them), copied to docs/img; and their page."""

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

from builders.markdown import write_page
from drivewright import registry
from drivewright.report.dimension_drawings import write_drawings

FOLDER = "img/dimensions"
PAGE = "dimensions.md"


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write the drawings of every kind, and docs/dimensions.md with all of them."""
    (docs / FOLDER).mkdir(parents=True, exist_ok=True)
    for kind in registry.kinds():
        for path in write_drawings(kind, progress):
            shutil.copyfile(path, docs / FOLDER / path.name)
    write_page(docs / PAGE, page())


def page() -> Iterator[str]:
    """Lines of the page: a section for each kind, with its drawings."""
    yield from ("# What the keys measure", "", "Drawn from the presets of each kind, to scale; a test compares every length with its key.")
    for kind in registry.kinds():
        if sheets := registry.mechanism(kind).dimensions:
            yield from ("", f"## {kind.replace('-', ' ').capitalize()}", "", f"All keys: [spec of `{kind}`](reference/spec-{kind}.md).")
        for sheet in sheets:
            yield from ("", f"![{sheet.title}]({FOLDER}/{sheet.name}.svg)")
