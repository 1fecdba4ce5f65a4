"""A quantity that is a length, or an angle: the lift of a follower that slides or swings."""

from typing import Annotated, Any

from drivewright.errors import UnitError
from drivewright.units import BY_NAME, Dimension


class AngleGiven(float):
    """An angle [rad] that was given where a length would have been right as well."""


class _LengthOrAngle(Dimension):
    """A length [m], or an angle (then an `AngleGiven`)."""

    plain = True

    def parse(self, value: Any) -> float:
        """As `Dimension.parse`, of either kind; the error speaks of the length."""
        if isinstance(value, AngleGiven):
            return value
        try:
            return BY_NAME["length"].parse(value)
        except UnitError as complaint:
            try:
                return AngleGiven(BY_NAME["angle"].parse(value))
            except UnitError:
                raise complaint from None

    def text(self, value: float) -> str:
        return BY_NAME["angle" if isinstance(value, AngleGiven) else "length"].text(float(value))


LengthOrAngle = Annotated[float, _LengthOrAngle("length, or an angle for an oscillating follower", "m", "mm")]
