"""Numbers in cells: points or commas as the decimal sign of a whole file, and how many digits were printed."""

import math
import re
from collections.abc import Sequence
from typing import NamedTuple

from drivewright.errors import SpecError, brief

NUMBER = re.compile(r"[+-]?(?:[0-9]+[.]?[0-9]*|[.][0-9]+)(?:[eEdD][+-]?[0-9]{1,4})?")
PLAIN = re.compile(r"\s*[+-]?[0-9]{1,40}(?:[.][0-9]*)?(?:[eE][+-]?[0-9]{1,2})?\s*")  # how almost all of them look
THOUSANDS = re.compile(r"[+-]?[1-9][0-9]{0,2}(?:,[0-9]{3})+")
BLANKS = str.maketrans({"\u2212": "-", "\u00a0": "", "\u202f": "", "\u2009": ""})


class Cell(NamedTuple):
    """A cell, with the number of the line and the name of the column for messages."""

    text: str
    line: int
    name: str


def decimal_sign(cells: Sequence[Cell], file: str) -> str:
    """The decimal sign, "." or ",", of the numbers of a file; SpecError where they differ, or "1,234" may be a thousand."""
    commas = [cell for cell in cells if "," in cell.text]
    points = [cell for cell in cells if "." in cell.text]
    both = next((cell for cell in commas if "." in cell.text), None)
    if both:
        text = both.text.strip()
        raise SpecError(
            f"line {both.line}: the {both.name} {text!r} has a point and a comma; leave the sign of the thousands out", file=file
        )
    if commas and points:
        first, second = commas[0], points[0]
        raise SpecError(
            f"line {first.line} has {first.text.strip()!r}, line {second.line} has {second.text.strip()!r}; use one decimal sign through "
            "the file",
            file=file,
        )
    if commas and all(THOUSANDS.fullmatch(_clean(cell.text)) for cell in commas):
        text = commas[0].text.strip()
        meant = f"{text.replace(',', '.', 1)} or {text.replace(',', '')}"
        raise SpecError(
            f"line {commas[0].line}: the {commas[0].name} {text!r} may be {meant}, for every comma in the file has three digits behind "
            "it; write it with a point, or without the sign of the thousands",
            file=file,
        )
    return "," if commas else "."


def number(cell: Cell, sign: str, file: str) -> float:
    """The number in a cell; SpecError names the line and what stands there."""
    text = _clean(cell.text)
    plain = text.replace(",", ".") if sign == "," and text.count(",") == 1 else text
    value = float(re.sub("[dD]", "e", plain)) if NUMBER.fullmatch(plain) else math.nan
    if not math.isfinite(value):
        raise SpecError(f"line {cell.line}: the {cell.name} is {_shown(cell.text)}{_hint(text)}", file=file)
    return value


def _clean(text):
    return text.strip().translate(BLANKS)


def _shown(text):
    if not text.strip():
        return "missing; give a number, or leave the whole row out"
    finite = "" if text.strip().lower().lstrip("+-") not in NOT_FINITE else "finite "
    return f"{brief(text.strip())}, not a {finite}number"


NOT_FINITE = ("nan", "inf", "infinity")


def _hint(text):
    if re.match(r"[+-]?[0-9.,]+\s*[A-Za-z°µμ%]", text) and not re.fullmatch(NUMBER, text):
        return "; units stand in the heading alone"
    return "; thousands have no sign" if text.count(",") > 1 or re.fullmatch(r"[+-]?[0-9]+( [0-9]{3})+.*", text) else ""


def last_digit(texts: Sequence[str]) -> float:
    """The step of the last digit that numbers were printed to: 0.001 of "1.250" and "3,1", their finest."""
    return min(map(_step, texts), default=math.nan)


def _step(text):
    if text.isdecimal():
        return 1.0
    digits, _, power = re.sub("[dD]", "e", _clean(text).lower()).partition("e")
    _, _, behind = digits.replace(",", ".").partition(".")
    return 10.0 ** ((int(power) if power else 0) - len(behind))
