"""Rolling bearings by name: inner geometry, envelope, and where each number comes from.

The catalogue that comes along is small and says so of every number; catalogues of bearings belong to their makers.  A file of your
own in the same form is read with `catalogue=path`; its bearings come first, and those that come along stay known.  Metric bearings of
the usual series are known by their designation beside (`designation`), with an estimated inner geometry.
"""

from functools import cache
from pathlib import Path

from drivewright.bearings.ball import BallBearing
from drivewright.bearings.catalogue_entry import Entry
from drivewright.bearings.designated_entry import as_designated, designated_entry
from drivewright.bearings.designation import UnknownDesignation, parse_designation, similar_designations
from drivewright.bearings.roller import RollerBearing
from drivewright.errors import InputError, SpecError
from drivewright.spec import Named, Spec, from_document, read_document
from drivewright.spec.fields import Field
from drivewright.units import SI

OWN = Path(__file__).with_name("catalogue.toml")


class Catalogue(Spec):
    """A file of bearings."""

    bearings: Named[Entry] = Field(description="bearings by name")


def bearing(name: str, catalogue: str | Path | None = None) -> BallBearing | RollerBearing:
    """The `BallBearing` or `RollerBearing` of this name; `catalogue` is the path of a file of your own."""
    return entry(name, catalogue).bearing


def entry(name: str, catalogue: str | Path | None = None) -> Entry:
    """The `Entry` of this name: of the file, of the catalogue that comes along, else by the designation, e.g. "6306-2RS1/C3".

    By designation the dimensions are read and the inner geometry and ratings estimated (`estimated_keys`).  Raises UnknownName with
    the nearest names where there is none, InputError where the bearing is known and cannot be modelled.
    """
    known = _known(catalogue)
    if name in known:
        return known[name]
    designation = parse_designation(name)
    if designation is None:
        raise UnknownDesignation(name, known, similar_designations(name, known))
    return as_designated(known[designation.name], designation) if designation.name in known else designated_entry(designation)


def replace_catalogue_values(
    bearing: BallBearing | RollerBearing,
    radial_clearance: float | None = None,
    dynamic_rating: float | None = None,
    static_rating: float | None = None,
) -> BallBearing | RollerBearing:
    """The bearing with the values that are given in place of its own: clearance across the diameter [m], ratings C and C0 [N]."""
    given = {"radial_clearance": radial_clearance, "dynamic_rating": dynamic_rating, "static_rating": static_rating}
    changes = {key: SI(value) for key, value in given.items() if value is not None}
    return bearing.replace(**changes) if changes else bearing


def names(catalogue: str | Path | None = None) -> list[str]:
    """Names of the bearings of the file and of the catalogue that comes along; `designations` are known beside."""
    return sorted(_known(catalogue))


def load_catalogue(path: str | Path) -> Catalogue:
    """The `Catalogue` of a TOML file; raises InputError naming file and key."""
    if not Path(path).is_file():
        raise InputError(f"catalogue: there is no file {str(path)!r}; a catalogue is a TOML file with tables [bearings.NAME].")
    try:
        return from_document(read_document(path), model=Catalogue)
    except SpecError as error:
        raise error.located(file=str(path)) from None


def _known(catalogue):
    return {**_own(), **(load_catalogue(catalogue).bearings if catalogue else {})}


@cache
def _own():
    return load_catalogue(OWN).bearings
