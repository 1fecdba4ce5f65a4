"""Singular positions that the mechanism passes: where they are, what meets there and which branch is taken."""

import numpy as np

from drivewright.multibody.analyses.simulation_model import TURN, SimulationModel, run_of
from drivewright.multibody.observe import FIELDS, observe
from drivewright.multibody.passages import smallest_singular_values
from drivewright.result import Answer, Column, Table, Value

SAMPLES = 200  # states of a run whose smallest singular values give the median
SHOWN = 6  # bodies whose rates are shown


def singular_positions(model: SimulationModel) -> Answer:
    """Number of singular positions passed, each in a table, and what is done there."""
    passages = run_of(model).passages
    if not passages:
        return passage_count(model)
    return Answer(passage_count(model).values, (_table(model, passages),), (), (_finding(model, passages),))


def passage_count(model: SimulationModel) -> Answer:
    """Number of singular positions passed."""
    return Answer({"singular.count": Value(float(len(run_of(model).passages)), "-", "singular positions passed")})


def _table(model, passages):
    typical = _median(run_of(model))
    angle = () if not model.period else (Column("drive_angle", "rad", "drive angle", _drive_angle(model, passages)),)
    rules = ["continuous acceleration" if each.touching else "continuous velocity" for each in passages]
    return Table(
        "singular_positions",
        "Singular positions",
        (
            Column("time", "s", "time", np.array([each.time for each in passages])),
            *angle,
            Column(
                "smallest_singular_value",
                "-",
                "smallest singular value of the loop closure Jacobian, relative to its median in the run",
                np.array([each.smallest / typical for each in passages]),
                "smallest singular value, relative",
            ),
            Column("branches", "-", "maximum number of branches that meet", np.array([each.tangents for each in passages])),
            Column(
                "branch",
                "-",
                "branch taken: angular velocities of the bodies, relative to the largest",
                np.array([_rates(model, each) for each in passages]),
                "branch taken",
            ),
            Column("rule", "-", "rule by which the branch is taken", np.array(rules), "branch selection rule"),
        ),
    )


def _median(run):
    """Median of the smallest singular value over the states of a run."""
    singular_values = []
    for part in run.stretches:
        rows = slice(None, None, max(1, len(part.t) * len(run.stretches) // SAMPLES))
        singular_values.append(smallest_singular_values(part.system, part.t[rows], part.y[rows]))
    return float(np.median(np.concatenate(singular_values)))


def _drive_angle(model, passages):
    angles = np.mod([float(model.crank_angle(each.time)) for each in passages], TURN)
    return np.where(np.minimum(angles, TURN - angles) < 1e-9 * TURN, 0.0, angles)  # a rounding beside a whole turn is one


def _rates(model, passed):
    """Angular velocities of the bodies there, over the largest of them."""
    observed = observe(passed.system, np.array([passed.time]), passed.state[None]).bodies[0, :, FIELDS.index("w")]
    names = [name for name in model.assembly.names if name in model.bodies][:SHOWN]
    rates = [observed[model.assembly.names.index(name)] for name in names]
    largest = max(map(abs, rates), default=0.0) or 1.0
    return ", ".join(f"{name} {round(float(rate / largest), 3) + 0.0:g}" for name, rate in zip(names, rates, strict=True))


def _finding(model, passages):
    first = passages[0]
    where = f", drive at {np.degrees(_drive_angle(model, passages)[0]):.4g}°" if model.period else ""
    many = f"{len(passages)} singular positions" if len(passages) > 1 else "a singular position"
    return (
        f"the mechanism passes {many} (the first at t = {first.time:.6g} s{where}), where loops fold and up to {first.tangents} "
        "branches of the motion meet. The run follows the smooth branch, on which velocities are continuous; in a real mechanism "
        'clearances and loads select the branch. simulate.singular = "stop" ends the run before the first singular position'
    )
