"""How the flexibility follows every dimension, stiffness and modulus - and what is held while one of them changes."""

from drivewright import shafts
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.result import Answer, Answers
from drivewright.shafts.tables import sensitivity_table
from drivewright.shafts.values import sensitivity_values


def sensitivities(model: ShaftModel, done: Answers) -> Answer:
    """A row for every parameter; where bearings are not linear they keep their tangents at the equilibrium."""
    at_rest, flexibility = done["statics"].data.equilibrium, done["flexibility"].data
    slopes = list(shafts.relative_flexibility_slopes(at_rest, flexibility, model.direction))
    return Answer(sensitivity_values(slopes, model.names), (sensitivity_table(slopes, model.names),))
