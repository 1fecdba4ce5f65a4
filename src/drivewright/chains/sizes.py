"""Roller chains by their number, as people write it: "08B", "08B-2", "16 B - 1", "ANSI 60", "#40-3", "RS80".

European numbers (B) and American ones (A, C) of the ISO 606 family, these also by their ANSI number.  The table `chain_sizes.toml` says
where its numbers come from, and the page docs/chain_sizes.md compares them with others.
"""

import difflib
import re
import tomllib
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

from drivewright.errors import InputError

PER_METRE_MM, NEWTON = 1e3, 1e3  # divided by, 12.7 mm are 0.0127 m to the last digit
ALIKE, MOST_ALIKE = 0.55, 4
PREFIX = r"(?:(?:ISO|DIN|ANSI|ASA|BS|RS|RC|NO\.?|#)[ -]*)*"
NUMBER = re.compile(rf"{PREFIX}(?P<number>\d{{1,3}})[ -]?(?P<series>[ABC]?)(?:[ ]?-[ ]?(?P<rows>\d+))?")
REFUSED = (
    (
        r"\d+[ -]?H.*|.*-[ ]?H",
        "a heavy-series chain, whose plates are those of the next larger size. Give plate.thickness, plate.link_mass and breaking_load of "
        "the maker in addition to the number without H",
    ),
    (
        r"(?:C|CA)?20[4-9]\d.*|C?21[026]\d.*|C?2[012]\d[AB].*",
        "a double-pitch chain, which meshes with every other tooth of its sprockets. Give pitch, roller, joint and plate",
    ),
    (r"SC.*", "an inverted-tooth chain, whose joint and plates are not standardised. Give pitch, joint and plate"),
)


class ChainSize(NamedTuple):
    """A roller chain by number: number and, where it has one, ANSI number; rows side by side; pitch, roller_diameter (of a bush chain
    that of the bush), inner_width between the inner plates, pin_diameter, plate_height, inner_plate and outer_plate (thickness),
    row_pitch from row to row (0: one row only) [m]; tensile_strength, the minimum one of the whole chain [N]; mass per length of the
    whole chain [kg/m]; whether its bushes mesh without rollers."""

    number: str
    ansi: str
    rows: int
    pitch: float
    roller_diameter: float
    inner_width: float
    pin_diameter: float
    plate_height: float
    inner_plate: float
    outer_plate: float
    row_pitch: float
    tensile_strength: float
    mass_per_length: float
    bush_chain: bool

    @property
    def name(self) -> str:
        """ "08B-2"; with the ANSI number where there is one: "08A-1 (ANSI 40)"."""
        return f"{self.number}-{self.rows}" + (f" (ANSI {self.ansi})" if self.ansi else "")

    @property
    def bush_length(self) -> float:
        """Length of a bush of one row, flush with the inner plates, b1 + 2 t  [m]; an estimate, no table prints it."""
        return self.inner_width + 2 * self.inner_plate


class UnknownChain(InputError):
    """A number that no chain of the table has."""

    def __init__(self, text: str, similar: list[str]) -> None:
        first, *others = [*similar, ""]
        also = f" or {', '.join(others[:-1])}" if len(others) > 1 else ""
        hint = f" (did you mean {first}{also}?)" if first else ""
        super().__init__(f"no roller chain has the number {text[:80]!r}{hint}; known: {', '.join(chain_numbers())}")


def chain_size(text: str) -> ChainSize:
    """The `ChainSize` of a number; one row unless it says so with -2 or -3.

    UnknownChain with the nearest numbers where there is none, InputError where the chain is known and not in the table.
    """
    plain = " ".join(text.upper().split())
    found = NUMBER.fullmatch(plain)
    size = _sizes().get(_key(found["number"], found["series"])) if found else None
    if found is None or size is None:
        _refuse_known(text, plain)
        raise UnknownChain(text, similar_numbers(text))
    rows = int(found["rows"] or 1)
    if rows not in size:
        made = "one row" if len(size) == 1 else f"1 to {len(size)} rows"
        raise InputError(f"roller chain {text!r}: {size[1].number} is available with {made}, not with {rows}; take -{max(size)}")
    return size[rows]


def chain_numbers() -> tuple[str, ...]:
    """All numbers, each once: "08B", and "08A = 40" where there are two."""
    return tuple(f"{each.number} = {each.ansi}" if each.ansi else each.number for each in _rows_of_one())


def similar_numbers(text: str) -> list[str]:
    """Up to four numbers like a text, the likest first: of the same figures, then the nearest of its series, then by the letters."""
    figures, series = "".join(re.findall(r"\d", text))[:3].lstrip("0"), re.sub("[^ABC]", "", text.upper())[:1]
    names = list(dict.fromkeys(name for each in _rows_of_one() for name in (each.number, each.ansi) if name))
    same = [name for name in names if figures and name.strip("0ABC") == figures.strip("0")]
    of_series = [name for name in names if name[-1:] == series or (not series and name.isdecimal())]
    near = sorted(of_series, key=lambda name: abs(int(name.rstrip("ABC")) - int(figures)))[:2] if figures else []
    close = difflib.get_close_matches(re.sub(r"[ #-]", "", text.upper())[:20], names, n=MOST_ALIKE, cutoff=ALIKE)
    return list(dict.fromkeys([*same, *near, *close]))[:MOST_ALIKE]


def _key(number: str, series: str) -> str:
    """Numbers with a letter have two figures, 08B; ANSI numbers none in front."""
    return f"{int(number):02d}{series}" if series else number.lstrip("0") if number != "085" else number


def _refuse_known(text: str, plain: str) -> None:
    for form, what in REFUSED:
        if re.fullmatch(PREFIX + f"(?:{form})", plain):
            raise InputError(f"chain {text[:80]!r} is not in the table of sizes: it is {what}.")


def _rows_of_one() -> Iterator[ChainSize]:
    """Every chain with one row, each once."""
    yield from dict.fromkeys(rows[1] for rows in _sizes().values())


@cache
def _sizes() -> dict[str, dict[int, ChainSize]]:
    """{number: {rows: ChainSize}}, by ISO and by ANSI numbers."""
    table = tomllib.loads(Path(__file__).with_name("chain_sizes.toml").read_text(encoding="utf-8"))
    sizes = {}
    for row in (*table["european"], *table["american"]):
        by_rows = {size.rows: size for size in _of_row(row, table["bush_chains"])}
        sizes |= {name: by_rows for name in row[:2] if name}
    return sizes


def _of_row(row, bush_chains):
    """One `ChainSize` for each number of rows that a line of the table has."""
    number, ansi, *lengths, strengths, masses = row
    pitch, roller, inner_width, pin, height, inner, outer, row_pitch = (length / PER_METRE_MM for length in lengths)
    for rows, (strength, mass) in enumerate(zip(strengths, masses, strict=True), 1):
        force, bush = strength * NEWTON, number in bush_chains
        yield ChainSize(number, ansi, rows, pitch, roller, inner_width, pin, height, inner, outer, row_pitch, force, mass, bush)
