"""Tables of the spec for wear and power rating of a chain."""

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
        None,
        description="volume worn off pin and bush together, per force and sliding distance; or give coefficient_range",
        examples=["1e-7 mm^3/(N m)"],
    )
    coefficient_range: tuple[Coefficient, Coefficient] | None = Field(
        None,
        description="minimum and maximum of the coefficient: elongation and life become intervals; their geometric mean is used if the "
        "coefficient is not given",
        examples=[["5e-8 mm^3/(N m)", "2e-7 mm^3/(N m)"]],
        json_schema_extra={"parts": ["minimum", "maximum"]},
    )
    running_time: Time = Field(
        "0 s", ge=0, description="operating time of the chain; its elongation enters the closure and the running chain"
    )
    elongation_limit: Number = Field(
        0.03,
        gt=0,
        le=0.05,
        description="elongation at which the chain is replaced; 2 over the number of teeth of the largest sprocket if that is smaller",
    )

    @property
    def coefficients(self) -> Floats:
        """The coefficient, and where its range is given both ends  [m^3/(N m)]."""
        ends = np.array(self.coefficient_range or (), float)
        middle = np.exp(np.mean(np.log(ends))) if self.coefficient is None else self.coefficient
        return np.array([middle, *ends])


class Rating(Spec):
    """Power that the chain may transmit."""

    service_factor: Number = Field(
        1.0, ge=0.5, le=10, description="design power over transmitted power, for shock loads and operating hours"
    )
    rated_power: Power | None = Field(
        None,
        gt=0,
        description="rated power of one row by the maker, at this speed and number of teeth; default for ANSI chains by number: formulas "
        "of ASME B29.1",
        examples=["5.5 kW"],
    )
    strand_factor: Number | None = Field(
        None,
        ge=1,
        le=20,
        description="rated power of all rows over that of one row; default 1.7 for two rows, 2.5 for three",
        examples=[1.7],
    )
