"""A paper as a document: its sections in order, each with what it claims, its equations, printed numbers and figures.

Plain data: the text of each paper is a file in `texts`, and its figures are functions that draw when they are called.
"""

import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from drivewright.report.content import Picture
from drivewright.validation.source import Row, Source

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawn

TEXTS = Path(__file__).parent / "texts"
AS_PRINTED, CORRECTED, UNDECIDED, DEFINITION = "agrees", "corrected", "undecided", "definition"
EQUATION_VERDICTS = (AS_PRINTED, CORRECTED, UNDECIDED, DEFINITION)

Draw: TypeAlias = "Callable[[Path], Drawn | Picture]"  # called with a folder for what takes long, which goes on where it stopped


def still(function: "Callable[..., Drawn | Picture]", *given: str) -> Draw:
    """A figure's function that does not need the folder, called with what is given."""
    return lambda folder: function(*given)


class Equation(NamedTuple):
    """An equation of the paper: its number, its lines as printed (mathtext), and whether it holds.

    verdict: "agrees" (as printed), "corrected" (`right` holds the lines that are true), "undecided" (the print can be read in several
    ways) or "definition" (nothing to be true or false).  `remark` says why.
    """

    number: str
    printed: tuple[str, ...]
    verdict: str
    remark: str = ""
    right: tuple[str, ...] = ()


class Figure(NamedTuple):
    """A figure of the paper made anew from our data: its number in the paper, a title, what it shows.

    `caption` also says what of the printed or stated values is marked in it.  `solids`: it needs solid models.
    """

    number: str
    title: str
    draw: Draw
    caption: str
    solids: bool = False


class Grid(NamedTuple):
    """A printed table cell by cell: rows and columns by name, and the name of the row (of numbers) that each cell shows, "" for none."""

    title: str
    corner: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, tuple[str, ...]], ...]


class Listing(NamedTuple):
    """A table of ours where the paper has a figure: `make(folder)` gives (heads, rows) of texts, the first column names the row."""

    name: str
    title: str
    make: Callable[[Path], tuple[tuple[str, ...], list[list[str]]]]
    caption: str


class Section(NamedTuple):
    """A section of the paper.  `claims` are what it says, in our words; `places` are the places of the numbers that belong here.

    `missing` names what the section prints or draws that is not made anew here, and why.
    """

    title: str
    claims: tuple[str, ...] = ()
    places: tuple[str, ...] = ()
    equations: tuple[Equation, ...] = ()
    figures: tuple[Figure, ...] = ()
    grids: tuple[Grid, ...] = ()
    missing: tuple[str, ...] = ()
    listings: tuple[Listing, ...] = ()


class Input(NamedTuple):
    """An input of the paper's computation: as printed, or assumed where the paper leaves it out, with the reason for the choice."""

    name: str
    value: str
    printed: bool
    remark: str = ""


class LongRows(NamedTuple):
    """Rows that take minutes: `compute(folder)` gives them, and goes on in the folder where it stopped.  `solids`: needs solid models."""

    name: str
    compute: Callable[[Path], Iterable[Row]]
    solids: bool = False


class PaperStudy(NamedTuple):
    """A study that rows and figures are made of: `run(folder, progress)` computes it in `folder`/`name`, and goes on where it stopped."""

    name: str
    run: Callable[[Path, Callable[[int, int, str], object]], object]
    solids: bool = False


@dataclass(frozen=True)
class Paper:
    """A paper: its source with the printed numbers, its title, what it is about, its inputs and its sections in the paper's order."""

    source: Source
    title: str
    summary: str
    inputs: tuple[Input, ...]
    sections: tuple[Section, ...]
    long_rows: tuple[LongRows, ...] = ()
    studies: tuple[PaperStudy, ...] = ()

    @property
    def name(self) -> str:
        """The name, that of the source in `validate`."""
        return self.source.name

    @property
    def figures(self) -> tuple[Figure, ...]:
        """Every figure, in the paper's order."""
        return tuple(figure for section in self.sections for figure in section.figures)

    @property
    def listings(self) -> tuple[Listing, ...]:
        """Every table of ours, in the paper's order."""
        return tuple(listing for section in self.sections for listing in section.listings)


def read_paper(
    source: Source,
    draw: Mapping[str, Draw],
    long_rows: tuple[LongRows, ...] = (),
    studies: tuple[PaperStudy, ...] = (),
    grids: Mapping[str, tuple[Grid, ...]] = {},
    listings: Mapping[str, tuple[Listing, ...]] = {},
) -> Paper:
    """The paper of a source: its text from `texts`, `draw` the function of each figure by its number, `grids` and `listings` by the title
    of a section.

    ValueError where the text and the functions do not name the same figures or sections.
    """
    text = tomllib.loads((TEXTS / f"{source.name.replace('-', '_')}.toml").read_text(encoding="utf-8"))
    inputs = tuple(Input(**each) for each in text["inputs"])
    sections = tuple(_section(each, draw, grids.get(each["title"], ()), listings.get(each["title"], ())) for each in text["sections"])
    paper = Paper(source, text["title"], text["summary"], inputs, sections, long_rows, studies)
    wrong = {*draw} ^ {figure.number for figure in paper.figures} | {*grids, *listings} - {section.title for section in sections}
    if wrong:
        raise ValueError(f"{source.name}: text and figures disagree about {sorted(wrong)}")
    return paper


def _section(text: Mapping[str, Any], draw: Mapping[str, Draw], grids: tuple[Grid, ...], listings: tuple[Listing, ...]) -> Section:
    equations = tuple(
        Equation(each["number"], tuple(each["printed"]), each["verdict"], each.get("remark", ""), tuple(each.get("right", ())))
        for each in text.get("equations", ())
    )
    figures = tuple(
        Figure(each["number"], each["title"], draw[each["number"]], each["caption"], each.get("solids", False))
        for each in text.get("figures", ())
    )
    claims, places, missing = (tuple(text.get(key, ())) for key in ("claims", "places", "missing"))
    return Section(text["title"], claims, places, equations, figures, grids, missing, listings)
