"""Why cases are not complete: their messages in groups that differ in numbers only."""

import re
from collections.abc import Iterable, Sequence
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
        """What is said of them: the message, or the summary with the first message in full; each at most so many characters."""
        if self.summary == self.first:
            return _cut(self.first, longest)
        return f"{_cut(self.summary, longest)} (the first: {_cut(self.first, longest)})"


def reason_groups(statuses: Iterable[str], messages: Iterable[str | None]) -> list[ReasonGroup]:
    """The groups of all cases (one status and one message each, in the order of the cases) that are not complete, the largest first."""
    groups: dict[tuple[str, str], list[tuple[int, str]]] = {}
    for row, (status, message) in enumerate(zip(statuses, messages, strict=True)):
        if status != "complete":
            groups.setdefault((status, _form(message or UNKNOWN)), []).append((row, message or UNKNOWN))
    found = [
        ReasonGroup(status, len(members), members[0][0], members[0][1], _summary([text for _, text in members]))
        for (status, _), members in groups.items()
    ]
    return sorted(found, key=lambda group: -group.cases)


def _form(message: str) -> str:
    """A message with # in place of its numbers."""
    return WORD_OR_NUMBER.sub(lambda match: match[0] if _is_name(match[0]) else "#", message)


def _is_name(text: str) -> bool:
    return text[0] in "'\""


def _numbers(message: str) -> list[str]:
    return [text for text in WORD_OR_NUMBER.findall(message) if not _is_name(text)]


def _summary(messages: Sequence[str]) -> str:
    """A message of several with the same form, "2 ... 7" in place of each number that differs."""
    columns = zip(*(_numbers(message) for message in dict.fromkeys(messages)), strict=True)
    ranges = [_range(column) for column in columns]
    inside = iter(ranges)
    return WORD_OR_NUMBER.sub(lambda match: match[0] if _is_name(match[0]) else next(inside), messages[0])


def _range(numbers: Sequence[str]) -> str:
    low, high = min(numbers, key=float), max(numbers, key=float)
    return numbers[0] if float(low) == float(high) else f"{low} … {high}"


def _cut(text: str, longest: int | None) -> str:
    return text if longest is None or len(text) <= longest else f"{text[:longest].rstrip()} ..."
