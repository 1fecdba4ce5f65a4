"""The list of the worked examples as a page."""

from collections.abc import Callable
from pathlib import Path

from drivewright.cli.gallery import examples
from drivewright.spec import read_document


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write docs/gallery.md, a line for each example."""
    lines = ["# Gallery", "", "Run all of them with `drivewright examples --run all`; `out/index.html` shows them moving.", ""]
    for name, path in examples().items():
        data = read_document(path)
        lines.append(f"* **{name}** ({data['mechanism']}): {data.get('title', '')}")
    (docs / "gallery.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
