"""Headings of columns as people and instruments write them: which quantity, in which unit.

"angle [deg]", "Angle (°)", "cam angle / deg", "lift, mm", "lift_mm" and "lift in mm" say the same; a unit may also stand in a row of its
own below the headings.
"""

import re
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from drivewright.errors import SpecError, UnitError, brief, nearest
from drivewright.units import BY_NAME, unit_factor

PURE = "a pure number"
TEXT = "a text"
OF_CRANK = "degrees of the crank, of which a four-stroke cam turns half; write 'deg' with the angle of the part that the heading names"
TWO_MEANINGS = {
    "grad": "degrees or gons; write 'deg'",
    "gradian": "degrees or gons; write 'deg'",
    "Mm": "megametres; write 'mm'",
    **dict.fromkeys(("°kw", "grad kw", "deg kw", "°ca", "deg ca"), OF_CRANK),
}
WIDE_BRACKETS = str.maketrans("（）［］", "()[]")  # of Chinese fonts
OPEN_BRACKET = re.compile(r"[\[(][^\])]*$")
BRACKETS = r"[\[({<]\s*([^\[\](){}<>]*(?:\([^()]*\))?)\s*[\])}>]"


BEHIND = (
    r"(.*?)\s+in\s+(\S+)",
    r"([^/]*?)\s*/\s*(\S+)",
    r"(.*?)\s*[,:]\s*(\S+)",
    r"(.*)[_\s]+(\S+)",
)  # how a unit without brackets follows


class Wanted(NamedTuple):
    """A column that a reader looks for: its name, what it may be ({dimension: unit for the message}), other names of it.

    mistaken: names of another quantity that people give in its place, found where no better column is there: the reader refuses them.
    """

    name: str
    units: Mapping[str, str]
    also: tuple[str, ...] = ()
    mistaken: tuple[str, ...] = ()

    @property
    def heading(self) -> str:
        """How it is written: "lift [mm]"."""
        unit = next(iter(self.units.values()))
        return f"{self.name} [{unit}]" if unit else self.name

    def is_mistaken(self, heading: str) -> bool:
        """Whether a heading is one of the names of another quantity."""
        return bool({_plain(name) for name in self.mistaken} & {each.name for each in readings(heading)})


class Heading(NamedTuple):
    """A heading taken apart: normal form of its name, and its unit where it says one."""

    name: str
    unit: str | None


def readings(cell: str) -> Iterator[Heading]:
    """The ways to take a heading apart, the likeliest first."""
    text = " ".join(cell.replace("\ufeff", "").translate(WIDE_BRACKETS).strip().strip("\"'").split())
    if match := re.fullmatch(rf"(.*?)\s*{BRACKETS}\s*", text):
        yield Heading(_plain(match[1]), match[2].strip())
        return
    yield Heading(_plain(text), None)
    for pattern in BEHIND:
        if match := re.fullmatch(pattern, text):
            yield Heading(_plain(match[1]), match[2])


def _plain(name):
    """A name without capitals, accents and signs between its words."""
    letters = (each for each in unicodedata.normalize("NFKD", name.lower()) if not unicodedata.combining(each))
    return " ".join(re.sub(r"[_\-.:]+", " ", "".join(letters)).split())


class CsvColumn(NamedTuple):
    """Where a wanted column stands, its heading as written, and what it holds with its factor to SI; nan while no unit is given."""

    place: int
    heading: str
    dimension: str
    factor: float


def find_columns(
    header: Sequence[str], wanted: Sequence[Wanted], units: Sequence[str] = (), file: str = "", line: int = 1
) -> dict[str, CsvColumn]:
    """{name: column} of the wanted columns that a header has, the units from the row below where the headings say none.

    SpecError where two columns may be the same, or a unit is missing or belongs to another quantity.
    """
    found = {}
    for each in wanted:
        places = _places(header, each)
        if len(places) > 1:
            raise SpecError(_twice(each, [header[place] for place in places], line), file=file)
        if places:
            found[each.name] = _column(header, each, places[0], units, file)
    return found


def _twice(each, headings, line):
    if len({heading.strip().lower().split("[")[0].split("(")[0].strip() for heading in headings}) == 1:
        return f"line {line}: column '{each.name}' is there twice; keep one of them"
    named = " and ".join(repr(heading.strip()) for heading in headings)
    return f"line {line}: the columns {named} may both be the {each.name}; rename the right one to '{each.heading}'"


def has_column(header: Sequence[str], each: Wanted) -> bool:
    """Whether a header has a wanted column."""
    return bool(_places(header, each))


def _places(header, each):
    """The columns that fit best: by name, by another name, by their last word."""
    ranks = [_rank(cell, each) for cell in header]
    best = min(ranks, default=9)
    return [place for place, rank in enumerate(ranks) if rank == best] if best < 9 else []


def _rank(cell, each):
    """0 where a heading is the name, 1 another name of it, 2 ends in the name, as "cam angle" does, 3 is mistaken for it; 9 where it is
    another column."""
    others = {_plain(name) for name in each.also}
    if each.is_mistaken(cell):
        return 3
    for name, _ in readings(cell):
        for rank, fits in enumerate((name == each.name, name in others, name.split()[-1:] == [each.name])):
            if fits:
                return rank
    return 9


def _column(header, each, place, units, file):
    """The column at a place: with the unit of its heading, or of the row below."""
    cell = header[place]
    kinds = tuple(each.units)
    if kinds in ((PURE,), (TEXT,)):
        return CsvColumn(place, cell.strip(), kinds[0], 1.0)
    own, below = unit_in_brackets(cell), units[place].strip().strip("[](){}<>").strip() if place < len(units) else ""
    behind = [unit for _, unit in readings(cell) if unit and own is None]
    for unit in behind:  # it may be a word of the name
        try:
            return CsvColumn(place, cell.strip(), *_unit(unit, kinds, each, file))
        except UnitError:
            continue
    if not (unit_text := own or below):
        why = ", as its bracket is not closed" if OPEN_BRACKET.search(cell) else ""
        raise UnitError(f"has no unit{why}; write '{each.heading}'", key=f"column '{each.name}'", file=file)
    return CsvColumn(place, cell.strip(), *_unit(unit_text, kinds, each, file))


def unit_in_brackets(cell: str) -> str | None:
    """The unit in brackets of a heading, "" where they are empty; None without brackets."""
    first = next(readings(cell))
    return first.unit


def _unit(unit, kinds, each, file):
    """(dimension, factor) of a unit; UnitError where it fits none of the kinds."""
    if meant := TWO_MEANINGS.get(unit) or TWO_MEANINGS.get(unit.lower() if unit != "mm" else ""):
        raise UnitError(f"the unit {unit!r} may mean {meant}", key=f"column '{each.name}'", file=file)
    *others, last = kinds
    for dimension in others:
        try:
            return dimension, _factor(unit, dimension)
        except UnitError:
            continue
    try:
        return last, _factor(unit, last)
    except UnitError as error:
        every = " or ".join(BY_NAME[kind].described for kind in kinds)
        message = error.message.replace(f"wants {BY_NAME[last].described}", f"wants {every}", 1)
        raise UnitError(message, key=f"column '{each.name}'", file=file) from None


def _factor(unit, dimension):
    """Factor to SI; "DEG" and "MM" are those of small letters."""
    try:
        return unit_factor(unit, dimension)
    except UnitError:
        if unit.isupper() or unit.istitle():
            try:
                return unit_factor(unit.lower(), dimension)
            except UnitError:
                pass
        raise


def no_column(wanted: Sequence[Wanted], header: Sequence[str], line: int, text: str, all_wanted: Sequence[Wanted], separator: str) -> str:
    """What to say where none of some columns is in the header at a line, of which `text` is what the file says."""
    expected = " or ".join(repr(each.heading) for each in wanted)
    names = [heading.name for cell in header for heading in readings(cell)]
    example, first = separator.join(each.heading for each in all_wanted), "the first line" if line == 1 else f"line {line}"
    hint = nearest(wanted[0].name, names)
    unclosed = next((cell.strip() for cell in header if OPEN_BRACKET.search(cell)), None)
    if unclosed:
        hint += f"; the bracket of {brief(unclosed)} is not closed"
    return f"no column {expected} in {first} {brief(text)}{hint}; it should read {example!r}"


def says_units(cells: Sequence[str], places: Sequence[int]) -> bool:
    """Whether a row has units alone at these places: a row below the headings."""
    unit_texts = [cells[place].strip().strip("[](){}<>").strip() for place in places if place < len(cells)]
    return len(unit_texts) == len(places) and all(
        unit and re.search("[A-Za-z°µμ]", unit) and not re.match(r"[+\-.\d]", unit) for unit in unit_texts
    )
