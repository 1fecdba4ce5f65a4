"""The gallery of the worked examples: a page of its own, or one of the documentation."""

import base64
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from drivewright.atomic import write_text
from drivewright.report.content import program
from drivewright.report.html import environment, page, template_text
from drivewright.report.worked_examples import Card, cards, examples, question_words


def write_gallery(path: str | Path) -> Path:
    """Write the gallery to `path` as one file that needs no other."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_text(path, page("gallery.html.j2", {**_filled(cards(), _embedded), "version": program()}))
    return path


def gallery_markdown(link: Callable[[Path], str]) -> str:
    """The same as a page of the documentation; `link` gives the address of a picture there."""
    values = _filled(cards(), link)
    return environment().get_template("gallery.md.j2").render(**values).lstrip() + "\n"


def _filled(shown: Iterable[Card], address: Callable[[Path], str]) -> dict[str, Any]:
    """What the templates take."""
    shown, known = list(shown), examples()
    asked = {tag for card in shown for tag in card.questions}
    return {
        "cards": [_card(card, known[card.name], address) for card in shown],
        "kinds": sorted({card.kind for card in shown}),
        "questions": {tag: words for tag, words in question_words().items() if tag in asked},
        "gallery_style": template_text("gallery.css"),
        "gallery_script": template_text("gallery.js"),
    }


def _card(card: Card, path: Path, address: Callable[[Path], str]) -> dict[str, Any]:
    pictures = {"still": address(card.still), "moving": address(card.moving) if card.moving else ""}
    return {**card._asdict(), **pictures, "command": card.command, "spec": path.read_text(encoding="utf-8")}


def _embedded(picture: Path) -> str:
    return f"data:image/webp;base64,{base64.b64encode(picture.read_bytes()).decode()}"
