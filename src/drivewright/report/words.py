"""English texts of a report in another language.

They stand in `zh.toml`, here for what all reports say and in the folder of each mechanism for its own.  A * on both sides stands for a
part that varies: the parts come in the same order, and one that is a known text is translated too.  What is not known stays English.
"""

import re
import tomllib
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from drivewright import registry
from drivewright.labels import key_in_words

# A text with its unit, its factor or its value behind it: "lift [mm]", "deflection × 20", "cam angle 90°".
PARTED = re.compile(r"(?s)(.+?)(\s\[[^\]]*\]|\s[×x]\s?[\d.]+|\s[−-]?\d[\d.]*\s?(?:°|[a-zA-Zµ/·²³]{1,8})?)")
SENTENCES = re.compile(r"(?<=[a-z)])(: |; |\. )(?=[A-Za-z'])")  # where a text of several sentences is parted
WIDE = {": ": "：", "; ": "；", ". ": "。"}  # marks between sentences, behind a Chinese one
TEXTS = ("title", "label", "meaning", "convention", "message", "undecided", "hint", "text", "axes")  # keys of content that hold words
TYPED = "--only "  # what stands behind it is typed as it is
LISTS = ("findings", "warnings")  # keys that hold lists of sentences


class _Pattern(NamedTuple):
    """An English text with * in it, as it is recognised."""

    english: str
    shape: re.Pattern[str]


class Words:
    """Translates English texts; the books are {english: translation}, those in front go first."""

    def __init__(self, *books: Mapping[str, str]) -> None:
        self._books = books
        self._patterns = [[made for english in book if (made := _pattern(english))] for book in books]
        for patterns in self._patterns:
            patterns.sort(key=lambda each: -len(each.english.replace("*", "")))
        self._known: dict[str, str | None] = {}

    def __call__(self, text: str, *values: object) -> str:
        """The text in the language, each * of it filled with a value."""
        return _filled(self._translated(text), list(map(str, values)))

    def exact(self, text: str) -> str:
        """The text where it is known as a whole: what a user wrote stays as it is."""
        return self._exact(text) or text

    def _translated(self, text: str) -> str:
        """The text, or its parts, as far as they are known."""
        if not self._books or not text:
            return text
        parted = PARTED.fullmatch(text)
        if parted and (parted[2].endswith("]") or self._known_exactly(parted[1])):  # before a pattern takes the unit for one of its parts
            return self._known_exactly(text) or self._translated(parted[1]) + parted[2]
        if found := self._find(text):
            return found
        if parted:
            return self._translated(parted[1]) + parted[2]
        return self._sentences(text)

    def _sentences(self, text: str) -> str:
        """The text, each sentence of it in the language that is known."""
        pieces = SENTENCES.split(text)
        told = [self._find(piece) or piece for piece in pieces]
        return "".join(WIDE.get(piece, piece) if _is_wide(told[n - 1]) else piece for n, piece in enumerate(told))

    def _find(self, text: str) -> str | None:
        """The translation, None where there is none."""
        if text not in self._known:
            self._known[text] = self._known_exactly(text) or self._fitting(text)
        return self._known[text]

    def _known_exactly(self, text: str) -> str | None:
        return self._exact(text) or self._exact(_other_case(text))

    def _exact(self, text: str) -> str | None:
        return next((book[text] for book in self._books if text in book), None)

    def _fitting(self, text: str) -> str | None:
        for book, patterns in zip(self._books, self._patterns, strict=True):
            for english, shape in patterns:
                if parts := shape.fullmatch(text) or shape.fullmatch(_other_case(text)):
                    literals = english.split("*")
                    told = [
                        part if literal.endswith(TYPED) else self._find(part) or self._sentences(part)
                        for literal, part in zip(literals, parts.groups(), strict=False)
                    ]
                    return _filled(book[english], told)
        return None


def _is_wide(text: str) -> bool:
    """Whether a text ends with a Chinese character."""
    return "\u3000" < text[-1:] < "\uff00"


def _other_case(text: str) -> str:
    """First letter small instead of large, or the other way round: headings begin with a capital."""
    first = text[:1]
    return (first.upper() if first == first.lower() else first.lower()) + text[1:]


def _pattern(english: str) -> _Pattern | None:
    """How to recognise a text with * in it; None for a plain text, and for a * alone, which says nothing.

    A word between two parts ("* of *") would be found in nearly every sentence: there the parts are numbers.
    """
    literal = english.replace("*", "")
    if literal == english or not literal.strip():
        return None
    part = r"([\d.,\s]+?)" if re.fullmatch(r"(?is)\*.*[a-z].*\*", english) else "(.+?)"
    return _Pattern(english, re.compile(part.join(map(re.escape, english.split("*")))))


def _filled(text: str, values: list[str]) -> str:
    """Each * of a text replaced by the next value, as long as there are some."""
    rest = iter(values)
    return re.sub(r"\*", lambda star: next(rest, star[0]), text) if values else text


@cache
def words_of(language: str, kind: str = "") -> Words:
    """The words of a language for reports, and of a kind of drive; English ones stay as they are."""
    if language == "en":
        return Words()
    own = _own(language)
    tables = registry.mechanism(kind).translations(language) if kind and registry.is_known(kind) else {}
    keys = {key_in_words(key): label for key, label in tables.get("fields", {}).items() if "*" not in key}
    return Words(*(book for book in (tables.get("texts", {}), own, keys) if book))


@cache
def _own(language: str) -> dict[str, str]:
    return tomllib.loads(Path(__file__).with_name(f"{language}.toml").read_text(encoding="utf-8"))["texts"]


def translated(content: Any, words: Callable[[str], str]) -> Any:
    """The content of a report, or packed plots and scenes, with the words in it in another language; names, numbers and texts of the user
    stay."""
    if isinstance(content, dict):
        return {key: _entry(key, value, words) for key, value in content.items()}
    return [translated(each, words) for each in content] if isinstance(content, list) else content


def _entry(key: str, value: Any, words: Callable[[str], str]) -> Any:
    if key in TEXTS and isinstance(value, str):
        return words(value)
    if key in LISTS:
        return [words(sentence) for sentence in value]
    if key in ("marks", "limits"):
        return [[place, words(text)] for place, text in value]
    return translated(value, words)
