"""Which plots a linkage's result has: its tables are named after the user's outputs and joints."""

import numpy as np

from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.result import Plot, Result

STILL = 1e-9  # a column that varies less than this part of the largest of its unit does not move
FLAT = 0.02  # a path so much longer than wide is no curve to look at


def plots(result: Result[LinkageSpec]) -> tuple[Plot, ...]:
    """The plots of a result, those of analyses that were left out too."""
    found = [plot for output in result.spec.outputs for plot in _of_output(result, output)]
    found += [plot for joint in result.spec.joints for plot in _of_joint(result, joint)]
    return tuple(_with_folds(result, plot) for plot in (*found, *_of_run(result), *_of_many_runs(result)))


def _with_folds(result, plot):
    """A plot over time or angle shaded where loops fold, if its table tells where and nothing else shades it."""
    table = result.tables.get(plot.table)
    names = {column.name for column in table.columns} if table else set()
    if "fold" not in names or plot.shade or plot.equal:
        return plot
    return plot._replace(shade="fold", title=f"{plot.title}; loops fold where shaded")


def _of_output(result, output):
    """Motion, path and spectrum of an output; without play dashed beside it."""
    name, table = output.name, result.tables.get("motion")
    beside = ", dashed without play" if any(joint.pin not in (None, "ideal") for joint in result.spec.joints) else ""
    if table:
        fields = _moving(table, name, ("angle", "w", "alpha") if output.point is None else ("x", "y", "vx", "vy", "ax", "ay"))
        reference = tuple(f"{name}.ideal_{field}" for field in fields) if beside else ()
        yield Plot(
            f"motion.{name}",
            f"Motion of {_said(name)}{beside}",
            "motion",
            table.columns[0].name,
            tuple(f"{name}.{field}" for field in fields),
            reference=reference,
        )
    if table and output.point and _curved(table, name):
        yield Plot(f"path.{name}", f"Path of {_said(name)}", "motion", f"{name}.x", (f"{name}.y",), equal=True)
    yield Plot(
        f"spectrum.{name}",
        f"Acceleration of {_said(name)} by orders of the drive{beside}",
        f"spectrum.{name}",
        "order",
        ("amplitude",),
        style="stems",
        log=True,
        reference=("ideal_amplitude",) if beside else (),
    )


def _said(name):
    return name.replace("_", " ")


def _moving(table, name, fields):
    """Those fields of an output that vary; all where none does."""
    spans = {field: float(np.ptp(table[f"{name}.{field}"].data)) for field in fields}
    largest = {}
    for field, span in spans.items():
        unit = table[f"{name}.{field}"].unit
        largest[unit] = max(largest.get(unit, 0.0), span)
    return tuple(f for f, span in spans.items() if span > STILL * largest[table[f"{name}.{f}"].unit]) or fields


def _curved(table, name):
    wide, high = sorted(np.ptp(table[f"{name}.{field}"].data) for field in ("x", "y"))
    return wide > FLAT * high


def _of_joint(result, joint):
    """Orbit of the journal, force over the cycle and as a hodograph, of a pin with play."""
    table = result.tables.get(f"pin.{joint.name}")
    if table is None:
        return
    title, x = f"pin {_said(joint.name)}", table.columns[0].name
    yield Plot(
        f"orbit.{joint.name}", f"Orbit of the journal in {title}", table.name, "x", ("y",), equal=True, rings=((joint.clearance, "play"),)
    )
    yield Plot(f"force.{joint.name}", f"Force and sliding in {title}, shaded in contact", table.name, x, ("force", "slip"), shade="contact")
    yield Plot(f"polar.{joint.name}", f"Force on the journal of {title}", table.name, "force_x", ("force_y",), equal=True)


def _of_run(result):
    """Forces in all joints, impacts, drive, energy, Poincare section, Lyapunov exponent."""
    forces = result.tables.get("forces")
    if forces:
        names = [joint.name for joint in result.spec.joints if f"{joint.name}.force" in {c.name for c in forces.columns}]
        yield Plot("forces", "Forces in the joints", "forces", forces.columns[0].name, tuple(f"{name}.force" for name in names))
        tensions = tuple(c.name for c in forces.columns if c.name.endswith(".tension"))
        if tensions:
            yield Plot(
                "tension", "Tension of the massless links", "forces", forces.columns[0].name, tensions, ((0.0, "contact lost below"),)
            )
    impacts, drive, energy = (result.tables.get(name) for name in ("impacts", "drive", "energy"))
    if impacts and len(impacts["time"].data):
        several = len(set(np.asarray(impacts["joint"].data).tolist())) > 1
        yield Plot("impacts", "Impacts", "impacts", "time", ("speed",), style="stems", by="joint" if several else "")
    if drive:
        limits = (("drive_torque", "limit"), ("-drive_torque", "limit"))
        torques = tuple(c.name for c in drive.columns if c.name.startswith("torque_"))
        yield Plot("drive", "Torque of the drive", "drive", drive.columns[0].name, torques, limits)
    if energy:
        columns = tuple(c.name for c in energy.columns[1:] if c.name != "gap" and np.any(c.data))
        if len(columns) > 1:  # energy that nothing works on stays where it is
            yield Plot("energy", "Energy balance", "energy", "time", columns)
    yield Plot("poincare", "Poincare section at crank angle zero", "poincare", "position", ("velocity",), style="points")
    yield Plot("lyapunov", "Largest Lyapunov exponent, converging", "lyapunov", "turn", ("exponent",), ((0.0, "chaos above 0"),))


def _of_many_runs(result):
    """Tolerances, wear, bifurcation diagram, impact load over speed."""
    for name in result.tables:
        if name.startswith("tolerances."):
            yield Plot(
                name,
                f"Deviation of {_said(name[11:])}, dashed by linear theory",
                name,
                "deviation",
                ("share",),
                reference=("linear_share",),
            )
        if name.startswith("wear.") and name.endswith(".cycles"):
            yield Plot(name, f"Wear of pin {_said(name[5:-7])}", name, "cycles", ("max_depth", "volume"))
        elif name.startswith("wear."):
            yield Plot(name, f"Depth of wear of pin {_said(name[5:])}", name, "angle", ("first", "middle", "last"))
    bifurcation = result.tables.get("bifurcation")
    if bifurcation and len(bifurcation["parameter"].data):
        over = bifurcation["parameter"].meaning
        yield Plot("bifurcation", f"Bifurcation over {over}", "bifurcation", "parameter", ("position", "velocity"), style="points")
    table = result.tables.get("load_table")
    if table and len(table["speed"].data):
        by_speed = len(set(table["speed"].data.tolist())) > 1
        x, by = ("speed", "clearance") if by_speed else ("clearance", "speed")
        yield Plot("load_table", f"Impact load over the {x}", "load_table", x, ("coefficient",), by=by)
