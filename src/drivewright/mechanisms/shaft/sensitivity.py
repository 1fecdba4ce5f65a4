"""How the flexibility follows every dimension, stiffness and modulus - and what is held while one of them changes."""

import numpy as np

from drivewright.result import Answer, Column, Table, Value
from drivewright.shafts.sensitivity import flexibility_slopes


def sensitivities(model, done):
    """A row for every parameter; where bearings are not linear they keep their tangents at the equilibrium."""
    at_rest, found = done["statics"].data.equilibrium, done["flexibility"].data
    pairs = [(i, j) for i in range(len(model.names)) for j in range(i, len(model.names))]
    rows, values = [], {}
    for name, held, slope in flexibility_slopes(at_rest, found, model.direction):
        with np.errstate(divide="ignore", invalid="ignore"):
            part = np.where(np.abs(found.delta) > 1e-12 * np.abs(found.delta).max(), slope / found.delta, np.nan)
        rows.append((name, held, *(part[p] for p in pairs)))
        values |= {
            f"sensitivity.{model.names[i]}.{model.names[j]}.{name}": Value(
                float(part[i, j]), "-", f"relative change of the flexibility over that of {name}; {held}"
            )
            for i, j in pairs
            if np.isfinite(part[i, j])
        }
    names, held, *columns = zip(*rows, strict=True)
    return Answer(
        values,
        (
            Table(
                "sensitivities",
                "Sensitivities of the flexibility, relative change over relative change",
                (
                    Column("parameter", "-", "parameter", np.array(names)),
                    Column("held", "-", "what is held", np.array(held)),
                    *(
                        Column(f"{model.names[i]}.{model.names[j]}", "-", f"of {model.names[i]}, {model.names[j]}", np.array(column))
                        for (i, j), column in zip(pairs, columns, strict=True)
                    ),
                ),
            ),
        ),
    )
