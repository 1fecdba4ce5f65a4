"""What the user says of a Geneva wheel."""

from typing import Literal

from drivewright.spec import Field, Integer, MechanismSpec
from drivewright.units import Length, Speed


class GenevaSpec(MechanismSpec):
    """An external Geneva wheel: a pin on a crank enters radial slots and steps the wheel."""

    mechanism: Literal["geneva"] = Field("geneva", description="kind of drive")
    slots: Integer = Field(ge=3, le=60, description="number of slots, one a station", examples=[6])
    crank_radius: Length = Field(gt=0, description="radius of the pin's circle", examples=["40 mm"])
    speed: Speed = Field(gt=0, description="speed of the crank", examples=["60 rpm"])
    least_dwell: Integer = Field(90, ge=0, description="dwell that the process needs, in degrees of the crank")
