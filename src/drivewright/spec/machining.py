"""How flat parts are milled and measured: shared by every kind whose drawings go to a workshop."""

from drivewright.spec.fields import Field
from drivewright.spec.mechanism_spec import Spec
from drivewright.units import Length, Speed, Velocity


class Machining(Spec):
    """End mill, feeds and tolerances of the exported files."""

    cutter_diameter: Length = Field("10 mm", gt=0, description="diameter of the end mill")
    feed: Velocity = Field("300 mm/min", gt=0, description="feed along the path")
    plunge: Velocity = Field("100 mm/min", gt=0, description="feed into the material")
    spindle_speed: Speed = Field("4000 rpm", gt=0, description="spindle speed")
    step_down: Length = Field("2 mm", gt=0, description="depth of one pass")
    chord_tolerance: Length = Field("0.002 mm", gt=0, description="largest distance between chords and curve")
    profile_tolerance: Length = Field("0.02 mm", gt=0, description="tolerance of the profile in the inspection table")
