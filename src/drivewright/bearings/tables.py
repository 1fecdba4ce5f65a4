"""Rolling bearings as tables of a result, and their plots: the load on every element, and stiffness over load."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from drivewright._typing import Floats
from drivewright.bearings.life import life_duration
from drivewright.bearings.lives import rating_lives
from drivewright.bearings.lubricant import Lubrication
from drivewright.bearings.solving import BearingEquilibrium
from drivewright.bearings.stiffness_curve import LoadCurve, load_curve
from drivewright.bearings.values import DutyCase
from drivewright.errors import InputError, SolverError
from drivewright.result import Column, Plot, Table


def element_table(state: BearingEquilibrium, name: str) -> Table:
    """`elements.NAME` of the bearing of this name: a row for every rolling element by its place, the first again at the end."""
    n = len(state.element_loads)
    angle = 2 * np.pi * np.arange(n + 1) / n + state.bearing.first_element
    columns = (
        Column("angle", "rad", "angular position of the element, from x towards y", angle),
        Column("load", "N", "load of the element", _closed(state.element_loads)),
        Column("contact_angle", "rad", "contact angle", _closed(state.contact_angles)),
        Column("inner_pressure", "Pa", "maximum pressure at the inner race", _closed(state.pressures[:, 0])),
        Column("outer_pressure", "Pa", "maximum pressure at the outer race", _closed(state.pressures[:, 1])),
    )
    return Table(f"elements.{name}", f"Rolling elements of bearing {name}", columns)


def _closed(data: Floats) -> Floats:
    """Once round: the first element again at the end."""
    return np.concatenate([data, data[:1]])


def load_curve_table(curve: LoadCurve, name: str) -> Table:
    """`curve.NAME` of the bearing of this name: a row for every load of its `LoadCurve`."""
    columns = (
        Column("load", "N", "radial force, axial force in proportion", curve.load),
        Column("displacement", "m", "radial displacement", curve.displacement),
        Column("tangent", "N/m", "tangent stiffness", curve.tangent),
        Column("secant", "N/m", "secant stiffness", curve.secant),
    )
    return Table(f"curve.{name}", f"Stiffness of bearing {name} over load", columns)


def load_curve_tables(state: BearingEquilibrium, name: str, factors: Floats) -> Iterator[Table]:
    """The `load_curve_table` under multiples (n,) of the load of a bearing, its direction kept; none where no radial force acts or one of
    the loads cannot be borne."""
    if not np.hypot(*state.force[:2]) > 0:
        return
    try:
        curve = load_curve(state.bearing, state.force, factors)
    except (InputError, SolverError):
        return
    yield load_curve_table(curve, name)


def duty_table(cases: Sequence[DutyCase], name: str, names: Sequence[str], lubrication: Lubrication | None = None) -> Table:
    """`duty.NAME` of the bearing of this name: a row for every case of its duty cycle; nan where unknown."""
    lives = [rating_lives(case.state, case.speed, lubrication) for case in cases]
    loads = [np.nan if each.equivalent is None else each.equivalent.load for each in lives]
    times = [_case_times(case, each) for case, each in zip(cases, lives, strict=True)]
    shares = np.array([case.share for case in cases])
    columns = (
        Column("case", "-", "case of the duty cycle", np.array(names)),
        Column("share", "-", "share of the time", shares),
        Column("speed", "rad/s", "speed of the shaft", np.array([case.speed for case in cases])),
        Column("equivalent_load", "N", "equivalent load P", np.array(loads)),
        *(
            Column(f"{kind}_damage", "-", f"damage share by {kind} life", _damage_shares(shares, np.array(column)))
            for kind, column in zip(("basic", "reference", "modified"), zip(*times, strict=True), strict=True)
        ),
    )
    return Table(f"duty.{name}", f"Duty cycle of bearing {name}", columns)


def _case_times(case, lives):
    """Basic, reference and modified life [s] if the case went on for ever: infinite at rest, nan where unknown."""
    if not case.speed:
        return (np.inf,) * 3
    return [np.nan if life is None else life_duration(life, case.speed) for life in (lives.basic, lives.reference, lives.modified)]


def _damage_shares(shares, times):
    """q/L of each case over the sum of all, Miner; 0 where nothing does damage."""
    rates = shares / times
    return rates / total if (total := rates.sum()) else rates


def bearing_plots(tables: Mapping[str, Table]) -> Iterator[Plot]:
    """The plots of every `element_table` and `load_curve_table` among the tables of a result, by their names."""
    for name, table in tables.items():
        kind, _, bearing = name.partition(".")
        if kind == "elements":
            meaning = "Load of each rolling element at its angular position, from x towards y."
            yield Plot(name, f"Load distribution of bearing {bearing}", name, "angle", ("load",), style="polar", meaning=meaning)
            angled = ("contact_angle",) if any(table["contact_angle"].data) else ()
            columns = (*angled, "inner_pressure", "outer_pressure")
            yield Plot(f"contact.{bearing}", f"Contacts in bearing {bearing}", name, "angle", columns)
        if kind == "curve":
            yield Plot(name, f"Stiffness of bearing {bearing} over load", name, "load", ("displacement", "tangent", "secant"))
