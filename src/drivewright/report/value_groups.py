"""The values of a report in groups under headings: one for each analysis that computed some of them.

Where it is not known which analysis that was (a result of another kind of drive, of a study), the first part of the names stands for it.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from drivewright import registry
from drivewright.labels import in_words
from drivewright.result import Result
from drivewright.view.text import sentence

OTHERS = "Further values"  # heading of those that share neither an analysis nor a part of their names with others


def grouped_values(result: Result[Any], rows: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Groups {"title", "values"} of the rows of values, in the order of their first rows; each row is in one of them, by its "name"."""
    meanings = _meanings(result.mechanism)
    groups: dict[str, list[Mapping[str, Any]]] = {}
    for row in rows:
        analysis = result.value_sources.get(row["name"], "")
        groups.setdefault(meanings.get(analysis) or in_words(analysis or row["name"].partition(".")[0]), []).append(row)
    alone = set() if result.value_sources else {title for title, own in groups.items() if len(own) == 1}
    named = [{"title": sentence(title), "values": own} for title, own in groups.items() if title not in alone]
    others = [row for title in groups if title in alone for row in groups[title]]
    return [*named, {"title": OTHERS, "values": others}] if others else named


def _meanings(kind: str) -> dict[str, str]:
    """What each analysis of a kind of drive answers, by its name."""
    return {each.name: each.meaning for each in registry.mechanism(kind).analyses} if registry.is_known(kind) else {}
