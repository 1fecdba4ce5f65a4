"""What the user says of wear and power rating of a chain."""

from typing import Annotated

import numpy as np

from drivewright._typing import Floats
from drivewright.spec import Number, Spec
from drivewright.spec.fields import Field
from drivewright.units import Power, Time, WearCoefficient

Coefficient = Annotated[WearCoefficient, Field(gt=0)]


class Wear(Spec):
    """Wear of pins and bushes by Archard's law, of which nothing is assumed."""

    coefficient: Coefficient | None = Field(
        None, description="volume worn off pin and bush together, per force and sliding; or give its range", examples=["1e-7 mm^3/(N m)"]
    )
    coefficient_range: tuple[Coefficient, Coefficient] | None = Field(
        None,
        description="least and greatest that it may be: elongation and life become intervals; the geometric mean stands for the "
        "coefficient where that is not given",
        examples=[["5e-8 mm^3/(N m)", "2e-7 mm^3/(N m)"]],
    )
    running_time: Time = Field("0 s", ge=0, description="that the chain has run: its elongation goes into closure and running chain")
    elongation_limit: Number = Field(
        0.03, gt=0, le=0.05, description="elongation that ends its life; 2 over the teeth of the largest sprocket where that is less"
    )

    @property
    def coefficients(self) -> Floats:
        """The coefficient, and where its range is given both ends  [m^3/(N m)]."""
        ends = np.array(self.coefficient_range or (), float)
        middle = np.exp(np.mean(np.log(ends))) if self.coefficient is None else self.coefficient
        return np.array([middle, *ends])


class Rating(Spec):
    """Power that the chain may transmit."""

    service_factor: Number = Field(1.0, ge=0.5, le=10, description="power to be rated over power transmitted, for shock and hours")
    rated_power: Power | None = Field(
        None,
        gt=0,
        description="of one row by the maker, at this speed and these teeth; of American chains by number from the formulas unless given",
        examples=["5.5 kW"],
    )
    strand_factor: Number | None = Field(
        None,
        ge=1,
        le=20,
        description="rated power of all rows over that of one; 1.7 of two rows, 2.5 of three unless given",
        examples=[1.7],
    )
