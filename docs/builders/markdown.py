"""Pieces of Markdown that several builders write."""

from collections.abc import Iterable, Sequence
from pathlib import Path


def cell(text: object) -> str:
    """A text as a cell of a table: one line, its bars and angle brackets taken as they are."""
    return " ".join(str(text).split()).replace("|", "\\|").replace("<", "&lt;").replace("*", "\\*")


def code(text: object) -> str:
    """A text in typewriter letters, for a cell of a table; "" of an empty one."""
    return f"`{' '.join(str(text).split())}`".replace("|", "\\|") if str(text) else ""


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    """Lines of a table, with an empty line before and after, without columns that are empty in all rows; no lines where it has no rows."""
    rows = list(rows)
    kept = [column for column in range(len(heads)) if any(row[column] for row in rows)]
    lines = [f"| {' | '.join(row[column] for column in kept)} |" for row in [heads, *rows]]
    return ["", lines[0], f"|{'---|' * len(kept)}", *lines[1:], ""] if rows else []


def sentence(text: str) -> str:
    """A text with a capital and a full stop."""
    text = " ".join(text.split())
    if not text:
        return ""
    start = text[:1].upper() if text.split(maxsplit=1)[0].strip(",;:").isalpha() else text[:1]  # "key=value" stays as it is
    return f"{start}{text[1:]}{'' if text.endswith(('.', '!', '?', ':')) else '.'}"


def write_page(path: Path, lines: Iterable[str]) -> None:
    """A page with one empty line wherever some are."""
    kept: list[str] = []
    for line in lines:
        if line or (kept and kept[-1]):
            kept.append(line)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(kept).rstrip() + "\n", encoding="utf-8")
