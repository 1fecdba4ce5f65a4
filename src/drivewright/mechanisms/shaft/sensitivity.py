"""How the flexibility follows every dimension, stiffness and modulus - and what is held while one of them changes."""

import numpy as np

from drivewright import shafts
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.result import Answer, Answers, Value
from drivewright.shafts.tables import sensitivity_table, station_pairs


def sensitivities(model: ShaftModel, done: Answers) -> Answer:
    """A row for every parameter; where bearings are not linear they keep their tangents at the equilibrium."""
    at_rest, found, names = done["statics"].data.equilibrium, done["flexibility"].data, model.names
    slopes = list(shafts.relative_flexibility_slopes(at_rest, found, model.direction))
    values = {
        f"sensitivity.{names[i]}.{names[j]}.{parameter}": Value(
            float(slope[i, j]), "-", f"relative change of the flexibility over that of {parameter}; {held}"
        )
        for parameter, held, slope in slopes
        for i, j in station_pairs(names)
        if np.isfinite(slope[i, j])
    }
    return Answer(values, (sensitivity_table(slopes, names),))
