"""Why cases are not complete: their messages in groups that differ in numbers only."""

import re
from collections.abc import Iterable
from typing import NamedTuple

UNKNOWN = "no reason given"
# A lone word in quotes is a name, also where it is a number; so is a number behind a letter, or behind a dot that parts the steps of a key.
WORD_OR_NUMBER = re.compile(r"'[^'\s]*'|\"[^\"\s]*\"|(?<![\w])(?<!\w\.)[-+]?(?:[0-9]+(?:\.[0-9]+)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?(?!\w)")


class ReasonGroup(NamedTuple):
    """Cases of one status whose messages are the same but for numbers: how many, the `first` message and its row, and `summary`, the
    message with the range of each number that differs."""

    status: str
    cases: int
    row: int
    first: str
    summary: str

    def text(self, longest: int | None = None) -> str:
        """Text for them: the message, or the summary with the first message in full; each at most so many characters."""
        if self.summary == self.first:
            return _cut(self.first, longest)
        return f"{_cut(self.summary, longest)} (the first: {_cut(self.first, longest)})"


def reason_groups(statuses: Iterable[str], messages: Iterable[str | None]) -> list[ReasonGroup]:
    """The groups of all cases (one status and one message each, in the order of the cases) that are not complete, the largest first.

    Of a group its first message and the ends of its numbers are kept, so that the cases may be any number.
    """
    groups: dict[tuple[str, str], _Group] = {}
    for row, (status, message) in enumerate(zip(statuses, messages, strict=True)):
        if status != "complete":
            text = message or UNKNOWN
            group = groups.setdefault((status, _form(text)), _Group(row, text))
            group.add(text)
    found = [ReasonGroup(status, each.cases, each.row, each.first, each.summary()) for (status, _), each in groups.items()]
    return sorted(found, key=lambda group: -group.cases)


class _Group:
    """Messages of one form: the first, and between which ends each of their numbers lies."""

    def __init__(self, row: int, first: str) -> None:
        self.cases, self.row, self.first = 0, row, first
        self._ends = [(number, number) for number in _numbers(first)]

    def add(self, message: str) -> None:
        self.cases += 1
        if message != self.first:
            pairs = zip(self._ends, _numbers(message), strict=True)
            self._ends = [(min(low, number, key=float), max(high, number, key=float)) for (low, high), number in pairs]

    def summary(self) -> str:
        """The first message, "2 ... 7" in place of each number that differs."""
        numbers = zip(self._ends, _numbers(self.first), strict=True)
        inside = iter([first if float(low) == float(high) else f"{low} … {high}" for (low, high), first in numbers])
        return WORD_OR_NUMBER.sub(lambda match: match[0] if _is_name(match[0]) else next(inside), self.first)


def _form(message: str) -> str:
    """A message with # in place of its numbers."""
    return WORD_OR_NUMBER.sub(lambda match: match[0] if _is_name(match[0]) else "#", message)


def _is_name(text: str) -> bool:
    return text[0] in "'\""


def _numbers(message: str) -> list[str]:
    return [text for text in WORD_OR_NUMBER.findall(message) if not _is_name(text)]


def _cut(text: str, longest: int | None) -> str:
    return text if longest is None or len(text) <= longest else f"{text[:longest].rstrip()} ..."
