"""Rolling bearings by name: inner geometry, envelope, and where each number comes from.

The catalogue that comes along is small and says so of every number; catalogues of bearings belong to their makers.  A file of your
own in the same form is read with `catalogue=path`; its bearings come first, and those that come along stay known.
"""

from functools import cache
from pathlib import Path
from typing import Annotated, Literal, cast

from pydantic import BeforeValidator, model_validator

from drivewright.bearings.ball import BallBearing
from drivewright.bearings.roller import RollerBearing
from drivewright.errors import InputError, SpecError, UnknownName
from drivewright.spec import Named, Spec, Text, from_document, read_document
from drivewright.spec.fields import Field
from drivewright.units import SI, Length

# the name of a bearing in a spec: 61904 without quotes is a number in TOML
Designation = Annotated[Text, BeforeValidator(lambda value: str(value) if type(value) is int else value)]
OWN = Path(__file__).with_name("catalogue.toml")
ENVELOPE = ("bore", "outer_diameter", "width")


class Source(Spec):
    """Where some numbers of an entry come from."""

    keys: tuple[Text, ...] = Field(min_length=1, description="the keys it speaks of", examples=[["bore", "width"]])
    flag: Literal["read", "measured", "recalled", "back_fitted", "assumed"] = Field(description="how far to trust them")
    text: Text = Field(min_length=1, description="the work or the reasoning", examples=["maker's catalogue 2020, page 12"])


class Entry(Spec):
    """One bearing of a catalogue."""

    description: Text = Field("", description="what it is")
    bore: Length | None = Field(None, gt=0, description="bore of the inner ring")
    outer_diameter: Length | None = Field(None, gt=0, description="outside of the outer ring")
    width: Length | None = Field(None, gt=0, description="width of the rings")
    ball: BallBearing | None = Field(None, description="inner geometry of a ball bearing")
    roller: RollerBearing | None = Field(None, description="inner geometry of a roller bearing")
    sources: tuple[Source, ...] = Field((), description="where the numbers come from: none at all, or one for each number")

    @property
    def bearing(self) -> BallBearing | RollerBearing:
        """The `BallBearing` or `RollerBearing`."""
        return self.ball or cast(RollerBearing, self.roller)  # the validators leave one of the two

    def source(self, key: str) -> Source:
        """The `Source` of one number, e.g. source("balls"); raises UnknownName where the entry does not give it."""
        known = {each: source for source in self.sources for each in source.keys}
        if key not in known:
            raise UnknownName("number with a source", key, known)
        return known[key]

    @model_validator(mode="after")
    def _is_one_bearing(self):
        if (self.ball is None) == (self.roller is None):
            raise SpecError("wants one table `ball` or `roller`, " + ("has none" if self.ball is None else "has both"), key="ball")
        return self

    @model_validator(mode="after")
    def _fits_its_envelope(self):
        inside, outside = self.bore or 0.0, self.outer_diameter or float("inf")
        if not inside < self.bearing.pitch_diameter < outside:
            raise SpecError(
                f"must lie between bore and outer diameter, got {1e3 * self.bearing.pitch_diameter:g} mm against "
                f"{1e3 * inside:g} and {1e3 * outside:g} mm",
                key=f"{'ball' if self.ball else 'roller'}.pitch_diameter",
            )
        return self

    @model_validator(mode="after")
    def _each_number_has_a_source(self):
        if not self.sources:
            return self
        given = {key for key in ENVELOPE if getattr(self, key) is not None} | self.bearing.model_fields_set
        named = [key for source in self.sources for key in source.keys]
        for complaint, keys in (
            ("no source names", given - set(named)),
            ("a source names, but the entry lacks,", set(named) - given),
            ("two sources name", {key for key in named if named.count(key) > 1}),
        ):
            if keys:
                raise SpecError(f"{complaint} {', '.join(sorted(keys))}; each number wants one source", key="sources")
        return self


class Catalogue(Spec):
    """A file of bearings."""

    bearings: Named[Entry] = Field(description="bearings by name")


def bearing(name: str, catalogue: str | Path | None = None) -> BallBearing | RollerBearing:
    """The `BallBearing` or `RollerBearing` of this name; `catalogue` is the path of a file of your own."""
    return entry(name, catalogue).bearing


def entry(name: str, catalogue: str | Path | None = None) -> Entry:
    """The `Entry` of this name; raises UnknownName, with the nearest name, where there is none."""
    known = _known(catalogue)
    if name not in known:
        raise UnknownName("bearing", name, known)
    return known[name]


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
    """Names of all bearings: of the file, and of the catalogue that comes along."""
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
