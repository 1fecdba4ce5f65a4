"""Tables of the spec for the strength of a shaft: notches and operating conditions."""

from typing import Literal

from drivewright import shafts
from drivewright.spec import Integer, Name, Number, Spec
from drivewright.spec.fields import Field
from drivewright.units import Length

NotchKind = Literal["round-groove", "retaining-ring", "cross-hole", "keyway", "press-fit", "spline"]
WANTED: dict[str, tuple[str, ...]] = {  # keys that a kind needs, and no other has
    "round-groove": ("depth", "radius"),
    "retaining-ring": ("depth", "width", "radius"),
    "cross-hole": ("diameter",),
}


class NotchTable(Spec):
    """A notch of the shaft in addition to its steps: groove, hole, keyway, press fit or spline."""

    name: Name = Field(description="name", examples=["ring"])
    kind: NotchKind = Field(title="Kind of notch", description="kind of notch", examples=["keyway"])
    position: Length = Field(
        description="distance from the left end of the shaft; for a notch with a length, to its left end", examples=["100 mm"]
    )
    length: Length = Field("0 mm", ge=0, description="length of a keyway, press fit or spline, checked where the stress is maximum")
    depth: Length | None = Field(None, gt=0, description="depth of a groove", examples=["1.5 mm"])
    width: Length | None = Field(None, gt=0, description="width of a retaining-ring groove", examples=["1.6 mm"])
    radius: Length | None = Field(
        None, gt=0, description="radius at the bottom of a round groove, or at the corners of a retaining-ring groove", examples=["0.2 mm"]
    )
    diameter: Length | None = Field(None, gt=0, description="diameter of a cross hole", examples=["5 mm"])
    keys: Integer = Field(1, ge=1, le=2, title="Number of keyways", description="number of keyways around the shaft")
    form: Literal["straight", "serrated", "involute"] = Field("involute", title="Spline form", description="form of the flanks of a spline")

    def notch(self) -> shafts.Notch:
        """The notch in plain data."""
        at = (self.name, self.position)
        if self.kind == "round-groove":
            return shafts.RoundGroove(*at, self.depth or 0.0, self.radius or 0.0)
        if self.kind == "retaining-ring":
            return shafts.RectangularGroove(*at, self.depth or 0.0, self.width or 0.0, self.radius or 0.0)
        if self.kind == "cross-hole":
            return shafts.CrossHole(*at, self.diameter or 0.0)
        if self.kind == "keyway":
            return shafts.Keyway(*at, self.length, self.keys)
        if self.kind == "press-fit":
            return shafts.PressFit(*at, self.length)
        return shafts.Spline(*at, self.length, self.form)


class StrengthTable(Spec):
    """Operating conditions for the fatigue strength."""

    torsion: Literal["constant", "pulsating", "alternating"] = Field(
        "constant", description="time course of the torque; pulsating: between 0 and its value, as for a drive that starts and stops"
    )
    surface: Literal["ground", "machined", "hot-rolled", "forged"] = Field("machined", description="surface finish of the shaft")
    reliability: Number = Field(0.99, ge=0.5, lt=1, description="reliability of the endurance limit")
