"""How the flexibility follows every dimension, stiffness and modulus - and what is held while one of them changes."""

import numpy as np

from drivewright import shafts
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.matrices import station_pairs
from drivewright.result import Answer, Answers, Column, Table, Value


def sensitivities(model: ShaftModel, done: Answers) -> Answer:
    """A row for every parameter; where bearings are not linear they keep their tangents at the equilibrium."""
    at_rest, found = done["statics"].data.equilibrium, done["flexibility"].data
    pairs, names = list(station_pairs(model.names)), model.names
    rows, values = [], {}
    for parameter, held, relative in shafts.relative_flexibility_slopes(at_rest, found, model.direction):
        rows.append((parameter, held, *(relative[p] for p in pairs)))
        meaning = f"relative change of the flexibility over that of {parameter}; {held}"
        values |= {
            f"sensitivity.{names[i]}.{names[j]}.{parameter}": Value(float(relative[i, j]), "-", meaning)
            for i, j in pairs
            if np.isfinite(relative[i, j])
        }
    parameters, held, *data = zip(*rows, strict=True)
    columns = [Column("parameter", "-", "parameter", np.array(parameters)), Column("held", "-", "what is held", np.array(held))]
    columns += [
        Column(f"{names[i]}.{names[j]}", "-", f"of {names[i]}, {names[j]}", np.array(column))
        for (i, j), column in zip(pairs, data, strict=True)
    ]
    title = "Sensitivities of the flexibility, relative change over relative change"
    return Answer(values, (Table("sensitivities", title, tuple(columns)),))
