"""A gallery page over several run folders: verdict, headline numbers and a thumbnail of each, linked to its report."""

import json
import os
from collections.abc import Iterable
from pathlib import Path
from urllib.parse import quote

from drivewright import registry
from drivewright.atomic import write_text
from drivewright.labels import label_of
from drivewright.report.content import program, verdict
from drivewright.report.html import page
from drivewright.result import Value
from drivewright.view.text import interval_hint, number, uncertain

MOST = 4  # headline numbers on a card


def write_index(folders: Iterable[str | Path], path: str | Path) -> Path:
    """Write the gallery of some run folders to `path`; links are relative, so that the whole tree can be moved."""
    path = Path(path)
    cards = [_card(Path(folder), path.parent) for folder in folders]
    failed = sum(card["verdict"]["state"] == "bad" for card in cards)
    write_text(path, page("index.html.j2", {"cards": cards, "failed": failed, "version": program()}))
    return path


def _card(folder, base):
    record = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    return {
        "title": record["title"],
        "mechanism": record["mechanism"],
        "report": _link(folder / "report.html", base),
        "picture": _thumbnail(folder, base),
        "values": _headline(record),
        "verdict": verdict(
            [check["ok"] for check in record["checks"]],
            record["outcome"],
            sum(check.get("undecided", False) for check in record["checks"]),
            len(record.get("warnings", ())),
        ),
        "seconds": number(record["provenance"].get("seconds", 0.0), 2),
    }


def _link(target: Path, base: Path) -> str:
    return quote(os.path.relpath(target, base).replace(os.sep, "/"))


def _thumbnail(folder, base):
    """The scene's thumbnail, else the first drawing or plot; None for a run without figures."""
    figures = sorted((folder / "figures").glob("*.svg"), key=lambda f: (f.name != "thumbnail.svg", f.name))
    return _link(figures[0], base) if figures else None


def _headline(record):
    kind, values = record["mechanism"], {name: Value(**each) for name, each in record["values"].items()}
    names = registry.headlines(registry.mechanism(kind), values) if registry.is_known(kind) else list(values)
    return [
        {"label": label_of(v.meaning or n, v.label), "shown": uncertain(v.value, v.unit, v.low, v.high), "hint": interval_hint(v)}
        for n, v in ((name, values[name]) for name in names[:MOST])
    ]
