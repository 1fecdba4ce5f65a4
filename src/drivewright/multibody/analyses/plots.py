"""Which plots the tables of a simulated mechanism give: motion, path and spectrum of outputs, pins, forces, impacts, drive, studies."""

from collections.abc import Iterator, Mapping

import numpy as np

from drivewright.labels import in_words
from drivewright.result import Plot, Table

STILL = 1e-9  # a column that varies less than this part of the largest of its unit does not move
FLAT = 0.02  # a path so much longer than wide is no curve to look at


def simulation_plots(
    tables: Mapping[str, Table], outputs: Mapping[str, bool], clearances: Mapping[str, float | None], has_play: bool
) -> tuple[Plot, ...]:
    """All plots of a result, those of analyses that were left out too.

    outputs: {name: whether it is the motion of a point, not the angle of a body}; clearances [m] of all joints by name, None without;
    has_play: beside an output is its motion without play.
    """
    plots = [plot for name, of_point in outputs.items() for plot in _output_plots(tables, name, of_point, has_play)]
    plots += [plot for name, clearance in clearances.items() for plot in _pin_plots(tables, name, clearance)]
    plots += [*_run_plots(tables, list(clearances)), *_friction_plots(tables), *_study_plots(tables)]
    return tuple(_with_folds(tables, plot) for plot in plots)


def _with_folds(tables: Mapping[str, Table], plot: Plot) -> Plot:
    """A plot over time or angle shaded where loops fold, if its table tells where and nothing else shades it."""
    table = tables.get(plot.table)
    names = {column.name for column in table.columns} if table else set()
    if "fold" not in names or plot.shade or plot.equal:
        return plot
    return plot._replace(shade="fold", meaning=f"{plot.meaning} Shaded: near a singular position.".strip())


def _output_plots(tables: Mapping[str, Table], name: str, of_point: bool, has_play: bool) -> Iterator[Plot]:
    """Motion, path and spectrum of an output; without play dashed beside it."""
    table, beside = tables.get("motion"), "Dashed: with ideal joints." if has_play else ""
    if table:
        fields = _moving(table, name, ("x", "y", "vx", "vy", "ax", "ay") if of_point else ("angle", "w", "alpha"))
        reference = tuple(f"{name}.ideal_{field}" for field in fields) if beside else ()
        yield Plot(
            f"motion.{name}",
            f"Motion of {in_words(name)}",
            "motion",
            table.columns[0].name,
            tuple(f"{name}.{field}" for field in fields),
            reference=reference,
            meaning=beside,
        )
    if table and of_point and _is_curved(table, name):
        yield Plot(f"path.{name}", f"Path of {in_words(name)}", "motion", f"{name}.x", (f"{name}.y",), equal=True)
    yield Plot(
        f"spectrum.{name}",
        f"Acceleration spectrum, {in_words(name)}",
        f"spectrum.{name}",
        "order",
        ("amplitude",),
        style="stems",
        log=True,
        reference=("ideal_amplitude",) if beside else (),
        meaning=beside,
    )


def _moving(table: Table, name: str, fields: tuple[str, ...]) -> tuple[str, ...]:
    """Those fields of an output that vary; all where none does."""
    spans = {field: float(np.ptp(table[f"{name}.{field}"].data)) for field in fields}
    largest: dict[str, float] = {}
    for field, span in spans.items():
        unit = table[f"{name}.{field}"].unit
        largest[unit] = max(largest.get(unit, 0.0), span)
    return tuple(f for f, span in spans.items() if span > STILL * largest[table[f"{name}.{f}"].unit]) or fields


def _is_curved(table: Table, name: str) -> bool:
    wide, high = sorted(np.ptp(table[f"{name}.{field}"].data) for field in ("x", "y"))
    return wide > FLAT * high


def _pin_plots(tables: Mapping[str, Table], joint: str, clearance: float | None) -> Iterator[Plot]:
    """Orbit of the journal, force over the cycle and as a hodograph, of a pin with play."""
    table = tables.get(f"pin.{joint}")
    if table is None or clearance is None:
        return
    title, x, columns = f"joint {in_words(joint)}", table.columns[0].name, ("force", "slip")
    yield Plot(f"orbit.{joint}", f"Journal orbit in {title}", table.name, "x", ("y",), equal=True, rings=((clearance, "clearance"),))
    yield Plot(
        f"force.{joint}", f"Force and sliding speed, {title}", table.name, x, columns, shade="contact", meaning="Shaded: in contact."
    )
    path = "Path of the tip of the force vector."
    yield Plot(f"polar.{joint}", f"Force on the journal of {title}", table.name, "force_x", ("force_y",), equal=True, meaning=path)


def _run_plots(tables: Mapping[str, Table], joints: list[str]) -> Iterator[Plot]:
    """Forces in all joints, impacts, drive, energy, Poincare section, Lyapunov exponent."""
    forces = tables.get("forces")
    if forces:
        names = [joint for joint in joints if f"{joint}.force" in {c.name for c in forces.columns}]
        yield Plot("forces", "Joint forces", "forces", forces.columns[0].name, tuple(f"{name}.force" for name in names))
        tensions = tuple(c.name for c in forces.columns if c.name.endswith(".tension"))
        if tensions:
            yield Plot(
                "tension", "Tension of the massless links", "forces", forces.columns[0].name, tensions, ((0.0, "contact lost below"),)
            )
    impacts, drive, energy = (tables.get(name) for name in ("impacts", "drive", "energy"))
    if impacts and len(impacts["time"].data):
        several = len(set(np.asarray(impacts["joint"].data).tolist())) > 1
        yield Plot("impacts", "Impacts", "impacts", "time", ("speed",), style="stems", by="joint" if several else "")
    if drive:
        limits = (("drive_torque", "limit"), ("-drive_torque", "limit"))
        torques, forces = (tuple(c.name for c in drive.columns if c.name.startswith(kind)) for kind in ("torque_", "force_"))
        if torques:
            yield Plot("drive", "Drive torque", "drive", drive.columns[0].name, torques, limits)
        if forces:
            yield Plot("drive.force", "Drive force", "drive", drive.columns[0].name, forces)
    if energy:
        columns = tuple(c.name for c in energy.columns[1:] if c.name != "gap" and np.any(c.data))
        if len(columns) > 1:  # energy that nothing works on stays where it is
            yield Plot("energy", "Energy balance", "energy", "time", columns)
    yield Plot("poincare", "Poincaré section at crank angle zero", "poincare", "position", ("velocity",), style="points")
    yield Plot("lyapunov", "Convergence of the Lyapunov exponent", "lyapunov", "turn", ("exponent",), ((0.0, "chaos above 0"),))


def _friction_plots(tables: Mapping[str, Table]) -> Iterator[Plot]:
    """Friction in ideal joints, and what it takes, over the cycle."""
    table = tables.get("friction")
    if table is None:
        return
    x, names = table.columns[0].name, [column.name for column in table.columns]
    for unit, word in (("N m", "torque in pins and wheels"), ("N", "force in slides and slots")):
        rubbing = tuple(name for name in names if name.endswith(".friction") and table[name].unit == unit)
        if rubbing:
            yield Plot(f"friction.{'torque' if unit == 'N m' else 'force'}", f"Friction {word}", "friction", x, rubbing)
    yield Plot("friction.loss", "Friction power loss", "friction", x, tuple(name for name in names if name.endswith(".loss")))


def _study_plots(tables: Mapping[str, Table]) -> Iterator[Plot]:
    """Tolerances, wear, bifurcation diagram, impact load over speed."""
    for name in tables:
        if name.startswith("tolerances."):
            yield Plot(
                name,
                f"Deviation of {in_words(name[11:])}",
                name,
                "deviation",
                ("share",),
                reference=("linear_share",),
                meaning="Dashed: linear theory.",
            )
        if name.startswith("wear.") and name.endswith(".cycles"):
            yield Plot(name, f"Wear history of joint {in_words(name[5:-7])}", name, "cycles", ("max_depth", "volume"))
        elif name.startswith("wear."):
            yield Plot(name, f"Wear profile of joint {in_words(name[5:])}", name, "angle", ("first", "middle", "last"))
    bifurcation = tables.get("bifurcation")
    if bifurcation and len(bifurcation["parameter"].data):
        yield Plot("bifurcation", "Bifurcation diagram", "bifurcation", "parameter", ("position", "velocity"), style="points")
    table = tables.get("load_table")
    if table and len(table["speed"].data):
        by_speed = len(set(table["speed"].data.tolist())) > 1
        x, by = ("speed", "clearance") if by_speed else ("clearance", "speed")
        yield Plot("load_table", f"Impact load over {x}", "load_table", x, ("coefficient",), by=by)
