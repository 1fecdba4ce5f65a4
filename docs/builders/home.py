"""The home page: README.md with its links seen from the folder `docs`."""

import re
from collections.abc import Callable
from pathlib import Path

LINK = re.compile(r"(!?)\[([^\[\]]*)\]\((?!https?:|#|mailto:)([^)\s]+)\)")
SOURCE = re.compile(r"\b(src|href)=\"(?!https?:|#|mailto:)([^\"]+)\"")
ROOM = "docs/"
WIDE = "---\nhide: [navigation, toc]\n---\n"  # the pictures take the whole width


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write docs/index.md."""
    text = (docs.parent / "README.md").read_text(encoding="utf-8")
    (docs / "index.md").write_text(WIDE + seen_from_docs(text), encoding="utf-8")


def seen_from_docs(text: str) -> str:
    """A page of the checkout as one of the site: links into `docs` lose that folder, of others the text stays; pictures must be in it."""
    return SOURCE.sub(_source, LINK.sub(_link, text))


def _link(link: re.Match[str]) -> str:
    picture, text, target = link.groups()
    if target.startswith(ROOM):
        return f"{picture}[{text}]({target.removeprefix(ROOM)})"
    if picture:
        raise ValueError(f"README.md shows {target}: a picture of the home page has to be in {ROOM}")
    return text


def _source(attribute: re.Match[str]) -> str:
    name, target = attribute.groups()
    if name == "src" and not target.startswith(ROOM):
        raise ValueError(f"README.md shows {target}: a picture of the home page has to be in {ROOM}")
    return f'{name}="{target.removeprefix(ROOM)}"'
