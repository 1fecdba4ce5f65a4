"""Labels: the short noun phrase by which a person knows a quantity, apart from the sentence that says what it means.

A label stands alone ("Pressure angle, maximum"), without sign conventions and fine print, which belong to the meaning.  Where none is
given, it is the first phrase of the meaning.  `faults` is the house's rule for labels, which its tests read.
"""

import re
from collections import Counter
from collections.abc import Iterable
from functools import lru_cache

LONGEST = 40  # characters
LEADING = (
    "of",
    "in",
    "on",
    "at",
    "by",
    "for",
    "from",
    "to",
    "with",
    "without",
    "its",
    "the same",
    "what",
    "which",
    "that",
    "where",
    "who",
    "and",
    "or",
)
USUAL = (  # (SI unit, words of a label, the unit in which it is read)
    ("-", re.compile(r"\b(share|fraction|efficiency|elongation|fluctuation|without holding contact)\b", re.IGNORECASE), "%"),
    ("rad", re.compile(r"^(?!.*\bangle\b).*\b(play|backlash|transmission error|misalignment|slope)\b", re.IGNORECASE), "arcmin"),
)
PLAIN_UNITS = re.compile(r"\b(um|m\^2|mm\^2|m\^3|mm\^3|deg|arcmin|N m|s\^2)\b")  # as typed, not as set: µm, m², °


@lru_cache(maxsize=4096)  # each case of a study asks for the same ones
def label_of(meaning: str, label: str = "") -> str:
    """The label given, else the first phrase of the meaning, with a capital: "greatest lift, above the base" -> "Greatest lift"."""
    text = label or re.split(r"[,;:(]| - ", meaning, maxsplit=1)[0].strip()
    return text[:1].upper() + text[1:]


def in_words(name: str) -> str:
    """A name as it is read: "coupler_point.x" -> "coupler point x"."""
    return name.replace("_", " ").replace(".", " ")


def key_in_words(key: str) -> str:
    """A key of a spec within a sentence: "cams.roller_radius" -> "roller radius", "bearings.A.position" -> "position of bearings.A"."""
    place, _, last = key.rpartition(".")
    if last.isdecimal():
        return key
    return f"{in_words(last)} of {place}" if "." in place else in_words(last)


def label_of_key(key: str, title: str | None = None) -> str:
    """The label of a key of a spec: its title, else the key in words: "base_radius" -> "Base radius"."""
    return label_of(key.replace("_", " "), title or "")


def usual_unit(label: str, unit: str) -> str:
    """The unit in which people read a quantity of this label, where it is not that of its dimension: "%" of a share, "arcmin" of a play."""
    return next((wanted for si_unit, words, wanted in USUAL if unit == si_unit and words.search(label)), "")


def faults(label: str) -> tuple[str, ...]:
    """What is wrong with a label: empty, too long, no noun phrase that stands alone, units as typed."""
    first = label.lower()
    conditions = {
        "is empty": not label.strip(),
        f"has {len(label)} characters, more than {LONGEST}": len(label) > LONGEST,
        "begins with a word that leans on another": any(first.startswith(f"{word} ") for word in LEADING),
        "leans on another label": "of the same" in first or "the others" in first,
        "has a unit as typed": bool(PLAIN_UNITS.search(label)),
    }
    return tuple(fault for fault, is_so in conditions.items() if is_so)


def duplicates(labels: Iterable[str]) -> tuple[str, ...]:
    """The labels that stand more than once."""
    return tuple(label for label, count in Counter(labels).items() if count > 1)
