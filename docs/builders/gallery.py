"""The gallery: pictures of worked examples and presets where a spec has changed, and the page that shows them."""

import shutil
from collections.abc import Callable
from pathlib import Path

from drivewright import registry
from drivewright.report.gallery import gallery_markdown
from drivewright.report.thumbnails import remake, remake_presets

PICTURES = "gallery"  # beside the page


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write docs/gallery.md and docs/gallery/*.webp."""
    remake(progress=progress)
    for kind in registry.kinds():
        remake_presets(kind, progress)
    shutil.rmtree(docs / PICTURES, ignore_errors=True)
    (docs / PICTURES).mkdir()

    def link(picture: Path) -> str:
        """The address of a picture from the page."""
        shutil.copyfile(picture, docs / PICTURES / picture.name)
        return f"{PICTURES}/{picture.name}"

    (docs / "gallery.md").write_text(gallery_markdown(link), encoding="utf-8")
    progress("gallery: page written")


if __name__ == "__main__":
    build(Path(__file__).parents[1], print)
