"""An entry of a catalogue of rolling bearings: inner geometry, envelope, and the source of each number."""

from typing import Literal, cast

from pydantic import model_validator

from drivewright.bearings.ball import BallBearing
from drivewright.bearings.roller import RollerBearing
from drivewright.errors import SpecError, UnknownName
from drivewright.spec import Spec, Text
from drivewright.spec.fields import Field
from drivewright.units import Length

ENVELOPE = ("bore", "outer_diameter", "width")


class Source(Spec):
    """Where some numbers of an entry come from."""

    keys: tuple[Text, ...] = Field(min_length=1, description="the keys it speaks of", examples=[["bore", "width"]])
    flag: Literal["read", "measured", "recalled", "back_fitted", "estimated", "assumed"] = Field(description="how far to trust them")
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
            raise SpecError("needs one table `ball` or `roller`, " + ("has none" if self.ball is None else "has both"), key="ball")
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
                raise SpecError(f"{complaint} {', '.join(sorted(keys))}; each number needs one source", key="sources")
        return self
