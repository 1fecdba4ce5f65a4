"""What a y axis is called that several lines share: by the words that their labels have in common, or by what is measured."""

import re
from collections.abc import Sequence

from drivewright.labels import LEADING, label_of
from drivewright.view.text import dimension, sentence

OTHER_NAMES = {"N m": "moment", "Pa": "stress", "rad": "slope"}  # what the unit measures too, where the labels say so
SPEAKS_FOR_NOTHING = ("length", "value")  # a deflection is a length, and everything else may be a pure number
LONGEST = 40  # letters of a name that is put together
DANGLING = (*LEADING, "along", "across", "as", "is", "the", "a", "an")  # words that no phrase ends with


def axis_name(labels: Sequence[str], unit: str, title: str, alone: bool = True) -> str:
    """The name of the axis over which lines of these labels are drawn, all in the SI unit `unit`, in a plot of that title.

    The phrase that all labels begin with, as far as it is whole: 'Deflection, along x', 'Deflection, along y' -> 'Deflection'.  Else what
    the labels have in common where that names what the unit measures, the title where it does and the plot has no other panel (`alone`),
    and what the unit measures; for lengths and pure numbers rather the words in common, or the title.
    """
    start, end = common_ends(labels)
    end = [] if _differ_in_place(labels, start, end) else end
    measured = _measured(unit, [*labels, title])
    start = _up_to_mark(start)
    phrase, heading = _joined(start, end), label_of(title)
    if _is_closed(start) or (phrase and heading.lower().startswith(phrase.lower())):
        return phrase
    if measured and measured.split()[-1] in phrase.lower():
        return phrase
    if measured and alone and measured.split()[-1] in heading.lower() and not _leans(heading.split()):
        return heading
    return sentence(measured) if measured else _in_words(labels, start, end) or heading


def _differ_in_place(labels, start, end):
    """Whether the labels differ in a preposition alone, so that what they end with says nothing: 'along the loads', 'across the loads'."""
    between = [label.split()[len(start) : len(label.split()) - len(end)] for label in labels]
    return bool(start and end) and all(len(words) == 1 and words[0].lower() in DANGLING for words in between)


def common_ends(labels: Sequence[str]) -> tuple[list[str], list[str]]:
    """(words that all labels begin with, words that all of them end with); the latter from a word on that leans on another."""
    rows = [label.split() for label in labels]
    start, rest = _alike(rows)
    end, _ = _alike([row[::-1] for row in rest])
    return start, end[::-1]


def common_phrase(labels: Sequence[str]) -> str:
    """The label that all have, else the words that all begin with up to a mark, or end with; "" where they have nothing in common.

    'Mode 1, 38.8 Hz', 'Mode 1, 39.8 Hz' -> 'Mode 1';  'A: cam disc', 'B: cam disc' -> 'Cam disc'.
    """
    if len(set(labels)) == 1:
        return sentence(labels[0])
    start, end = common_ends(labels)
    start = _up_to_mark(start)
    return _joined(start, ()) if start and (_is_closed(start) or not end) else sentence(" ".join(end))


def _up_to_mark(start):
    """The words up to the last mark among them, all of them where there is none."""
    marks = [n for n, word in enumerate(start) if word[-1] in ",;:·"]
    return start[: marks[-1] + 1] if marks else start


def _alike(rows):
    """(leading words that all rows have, what is left of each row)."""
    count = 0
    while all(len(row) > count for row in rows) and len({row[count] for row in rows}) == 1:
        count += 1
    return rows[0][:count], [row[count:] for row in rows]


def _measured(unit, texts):
    """What the unit measures, in the word that the texts have for it; "" where that says nothing."""
    name, other = dimension(unit), OTHER_NAMES.get(unit)
    if other and any(re.search(rf"\b{other}", text, re.IGNORECASE) for text in texts):
        return other
    return "" if name in SPEAKS_FOR_NOTHING else name


def _joined(start, end):
    """The common words as one phrase, "" where they are none."""
    if start and end and not _is_closed(start):
        return sentence(" ".join([*start, *end]))
    kept = [word.rstrip(",;:·") for word in start]
    while kept and kept[-1].lower() in (*DANGLING, ""):
        kept.pop()
    if not kept:
        return sentence(" ".join(end)) if end and not _leans(end) else ""
    return sentence(" ".join([*kept, *(end if _leans(end) else ())]))


def _leans(words):
    return bool(words) and words[0].lower() in LEADING


def _is_closed(start):
    """Whether the words in front are a phrase that stands alone: what follows in the labels is set off by a mark."""
    return bool(start) and start[-1][-1] in ",;:·" and not _leans(start)


def _in_words(labels, start, end):
    """A name made of the labels themselves, "" where they do not give one: 'X and Y of the foot', 'Pins', 'Pitch'."""
    middles = [label.split()[len(start) : len(label.split()) - len(end)] for label in labels]
    if _leans(end) and not start and all(len(middle) == 1 for middle in middles):
        *others, last = (word.upper() if len(word) == 1 else word for (word,) in middles)
        named = f"{', '.join(others)} and {last} {' '.join(end)}"
        return sentence(named) if len(named) <= LONGEST else ""
    if start and not any(middle and middle[0].rstrip(",;:").isdigit() for middle in middles):
        return _joined(start, ())
    shared = [word for word in labels[0].split() if len(word) > 3 and word.isalpha() and all(word in label.split() for label in labels)]
    return sentence(shared[0]) if len(shared) == 1 and not end else ""
