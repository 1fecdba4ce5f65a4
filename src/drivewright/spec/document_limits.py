"""How much the text of a spec may hold, checked in one pass before it is parsed.

The parser of TOML takes a time that grows with the square of the parts of a dotted key, memory for each of them, and its stack for
what is nested.  This pass is linear in the text and knows only what the limits need: strings and comments, whose dots and brackets do
not count, and the brackets, braces, commas, dots and equals signs between them.  A text that is no TOML may be counted otherwise than the
parser would, but not before the place at which the parser stops.
"""

import re
from typing import Literal, TypeAlias

from drivewright.errors import SpecError, brief

MAX_CHARACTERS = 1_000_000  # of a text
MAX_ITEMS = 20_000  # values, entries of lists and tables, and parts of keys, in a text
MAX_TABLES = 2_000  # headers, [like.this] or [[like.this]], in a text
MAX_DEPTH = 120  # parts of a key together with those of its header and with the lists around it
REMEDY = "Put long tables into data files"

Expected: TypeAlias = Literal["key", "header", "value"]

# A string, a comment, an end of line with the blank lines after it, or one sign.  A string that is not closed runs to the end of its line,
# one of several lines to the end of the text: the parser stops there.
TOKEN = re.compile(
    r'"""(?:[^"\\]++|\\.|"{1,2}(?!"))*+(?:"{3,5})?+'
    r"|'''(?:[^']++|'{1,2}(?!'))*+(?:'{3,5})?+"
    r'|"(?:[^"\\\n]++|\\[^\n])*+"?+'
    r"|'[^'\n]*+'?+"
    r"|#[^\n]*+"
    r"|\n[ \t\r\n]*+"
    r"|[][{},=.]",
    re.DOTALL,
)


def refuse_oversized(text: str) -> None:
    """SpecError where a TOML text has more characters, items, headers or levels than a spec may have, with the line and the limit."""
    if len(text) > MAX_CHARACTERS:
        raise SpecError(f"has more than {MAX_CHARACTERS} characters; that is no spec. {REMEDY}")
    text = f"\n{text}"  # every statement follows an end of line
    items = headers = level = header_level = 0
    expected: Expected = "key"
    around: list[tuple[int, Expected]] = []  # of each list and table that is open: level of its entries, and what each begins with
    for token in TOKEN.finditer(text):
        sign = text[token.start()]
        if sign == "\n":
            if not around:
                level, expected = header_level, "key"
        elif sign in "=.":
            if expected != "value":
                level, items = level + 1, items + 1
            if sign == "=":
                expected = "value"
        elif sign == ",":
            items += 1
            if around:
                level, expected = around[-1]
        elif sign == "[" and expected == "key":
            headers, level, expected = headers + 1, 0, "header"
        elif sign in "[{" and expected != "header":
            level, items, expected = level + (sign == "["), items + 1, "value" if sign == "[" else "key"
            around.append((level, expected))
        elif sign in "]}":
            if expected == "header":
                header_level = level + 1
            elif around:
                around.pop()
            expected = "value"
        if items > MAX_ITEMS or level > MAX_DEPTH or headers > MAX_TABLES:
            raise _complaint(text, token.start(), items, level)


def refuse_long_key(key: str) -> None:
    """SpecError where a dotted key, written by itself, has more parts than one of a spec."""
    if key.count(".") >= MAX_DEPTH:
        raise SpecError(f"{brief(key)} has {key.count('.') + 1} parts, nested too deeply; a key has at most {MAX_DEPTH}")


def _complaint(text: str, place: int, items: int, level: int) -> SpecError:
    """The error of what is too much at a place of a text; where it is the depth, with the beginning of the key."""
    line, key = text.count("\n", 0, place), None
    if level > MAX_DEPTH:
        what = f"nested too deeply: a key has more than {MAX_DEPTH} parts, with the tables and lists around it"
        key = re.findall(r"^[\s\[]*([\w.-]{0,40})", text[text.rindex("\n", 0, place) :][:200])[0].rstrip(".")
    elif items > MAX_ITEMS:
        what = f"more than {MAX_ITEMS} values and parts of keys"
    else:
        what = f"more than {MAX_TABLES} headers in brackets"
    return SpecError(f"line {line}: {what}; that is no spec. {REMEDY}", key=key or None)
