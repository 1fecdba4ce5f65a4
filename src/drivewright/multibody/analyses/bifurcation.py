"""Bifurcation diagram: the points of a Poincare section over a parameter."""

from collections.abc import Callable

import numpy as np

from drivewright import cases
from drivewright._typing import Floats
from drivewright.labels import in_words
from drivewright.numerics.ode.together import together
from drivewright.result import Answer, Column, Table


def bifurcation(
    name: str, over: str, unit: str, units: tuple[str, str], values: Floats, visits: Callable[[float], tuple[Floats, Floats]]
) -> Answer:
    """Positions and velocities that the motion `name` visits at each of the values (n,) of the parameter `over`.

    visits(value): (positions (m,), velocities (m,)) of the section, in `units`; a value at which it raises is left out with the reason.
    """
    with together(len(values), cases.worker_count(None)) as workers:
        rows = cases.run(visits, values.tolist(), workers=workers)
    visited = [(row.case, *row.value) for row in rows.rows if row.ok]
    failed = tuple(f"bifurcation: {over} = {row.case:.6g} is left out: {row.reason}" for row in rows.failed)
    words = f"of {in_words(name)} at crank angle zero"
    columns = [np.concatenate([np.empty(0), *parts]) for parts in zip(*((np.full(len(p), v), p, r) for v, p, r in visited), strict=True)]
    columns = columns or [np.empty(0)] * 3
    table = Table(
        "bifurcation",
        f"Bifurcation diagram of {in_words(name)}",
        (
            Column("parameter", unit, parameter_label(over), columns[0]),
            Column("position", units[0], f"position {words}", columns[1], "position at crank angle zero"),
            Column("velocity", units[1], f"velocity {words}", columns[2], "velocity at crank angle zero"),
        ),
    )
    return Answer(tables=(table,), findings=failed, outcome="partial" if rows.interrupted else "complete")


def parameter_label(key: str) -> str:
    """The label of a dotted key: "joints.wrist.clearance" -> "clearance of joint wrist"."""
    table, *names = key.split(".")
    owner = " ".join(["body" if table == "bodies" else table.removesuffix("s"), *names[:-1]])
    return in_words(f"{names[-1]} of {owner}" if names else key)
