"""What a built site may not have: anything that a page loads from elsewhere, or that it loads and that is not there.

    python docs/check_site.py site

Links that a reader follows may lead anywhere; scripts, styles, fonts, images and frames have to be files of the site.
"""

import re
import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

SOURCES = {
    "script": "src",
    "img": "src",
    "iframe": "src",
    "source": "src",
    "video": "src",
    "audio": "src",
    "embed": "src",
    "object": "data",
}
LOADING_LINKS = {"stylesheet", "icon", "preload", "prefetch", "preconnect", "dns-prefetch", "modulepreload", "manifest", "apple-touch-icon"}
ELSEWHERE = re.compile(r"\s*(?:https?:)?//", flags=re.IGNORECASE)
IN_STYLE = re.compile(r"(?:url\(\s*['\"]?|@import\s+['\"])\s*((?:https?:)?//[^'\")\s]+)", flags=re.IGNORECASE)


class Loads(HTMLParser):
    """Collects what a page loads from elsewhere."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []
        self.local: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """A tag: does it load something, and from where?"""
        given = dict(attrs)
        target = given.get(SOURCES.get(tag, ""))
        if tag == "link" and LOADING_LINKS & set((given.get("rel") or "").lower().split()):
            target = given.get("href")
        if target and ELSEWHERE.match(target):
            self.found.append(target)
        elif target and not target.startswith(("data:", "#", "/")):  # "/": of the page for lost addresses, which is served from anywhere
            self.local.append(target)
        self.found += IN_STYLE.findall(given.get("style") or "")


def loads(folder: Path) -> Iterator[tuple[Path, str]]:
    """(file, address) of everything that pages and styles below a folder load from elsewhere, or in vain."""
    for page in sorted(folder.rglob("*.html")):
        parser = Loads()
        parser.feed(page.read_text(encoding="utf-8"))
        yield from ((page, target) for target in parser.found)
        yield from ((page, target) for target in parser.local if not _is_there(page, target))
    for style in sorted(folder.rglob("*.css")):
        yield from ((style, target) for target in IN_STYLE.findall(style.read_text(encoding="utf-8")))


def _is_there(page: Path, target: str) -> bool:
    return (page.parent / unquote(urlsplit(target).path)).exists()


def main() -> None:
    """Exit 1 with a line for each address."""
    folder = Path(sys.argv[1])
    if not (folder / "index.html").is_file():
        sys.exit(f"{folder} holds no site: run mkdocs build first")
    found = [f"{file.relative_to(folder)} loads {target}, from elsewhere or not there" for file, target in loads(folder)]
    if found:
        sys.exit("\n".join(found))
    print(f"{folder}: nothing is loaded from elsewhere, nothing is missing")


if __name__ == "__main__":
    main()
