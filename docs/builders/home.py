"""The home page: README.md with its links seen from the folder `docs`."""

import re
from collections.abc import Callable
from pathlib import Path

OUTSIDE = re.compile(r"\]\((?!https?:|#|mailto:)([^)\s]+)\)")


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write docs/index.md."""
    text = (docs.parent / "README.md").read_text(encoding="utf-8")
    (docs / "index.md").write_text(OUTSIDE.sub(_seen_from_docs, text), encoding="utf-8")


def _seen_from_docs(link: re.Match[str]) -> str:
    """A link of README.md: one into `docs` loses that folder; the site has no page for any other file, so only its text stays."""
    target = link.group(1)
    if not target.startswith("docs/"):
        raise ValueError(
            f"README.md links to {target}, which is outside of docs/ and so not on the site; name the file in backticks instead"
        )
    return f"]({target.removeprefix('docs/')})"
