"""What the user says of a Scotch yoke."""

from typing import Literal

from drivewright.spec import Field, MechanismSpec
from drivewright.units import Angle, Length, Speed


class YokeSpec(MechanismSpec):
    """A Scotch yoke: the pin of a crank runs in a straight slot of a slide."""

    mechanism: Literal["scotch-yoke"] = Field("scotch-yoke", description="kind of drive")
    crank_radius: Length = Field(gt=0, description="radius of the pin's circle", examples=["40 mm"])
    slot_tilt: Angle = Field("0 deg", gt=-1.2, lt=1.2, description="tilt of the slot from the normal of the slide")
    speed: Speed = Field(gt=0, description="speed of the crank", examples=["60 rpm"])
    least_stroke: Length = Field("50 mm", ge=0, description="stroke that the process needs")
