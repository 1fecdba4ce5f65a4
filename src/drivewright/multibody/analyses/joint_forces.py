"""Forces in all joints, from the equations of every body in absolute coordinates: a second route to the motion."""

import numpy as np

from drivewright.labels import in_words
from drivewright.multibody.analyses.ensemble import statistics
from drivewright.multibody.analyses.simulation_model import ROWS, SimulationModel, cycle_columns, over_last_turn, run_of
from drivewright.multibody.analyses.turns import joint_force_numbers, start_of_window
from drivewright.multibody.observe import Observed, concatenate, observe
from drivewright.multibody.reactions import reactions, unbounded_joints
from drivewright.multibody.simulate import states_outside_folds
from drivewright.result import Answer, Check, Column, Table, Value


def observe_last_turn(model: SimulationModel) -> Observed:
    """`Observed` over the last whole turn, or over the run, thinned to about ROWS; the middles of folds left out."""
    run = run_of(model)
    turns = np.floor(run.end[1] / model.period + 1e-9) if model.period else 0
    start = (turns - 1) * model.turn_length if turns >= 1 else 0.0
    return concatenate([observe(*states) for states in states_outside_folds(run, start * (1 - 1e-12), ROWS)])


def joint_forces(model: SimulationModel) -> Answer:
    """Largest force of every joint in the window, the forces over the last turn, and the residual of the Newton-Euler equations."""
    observed, numbers = observe_last_turn(model), statistics(model, joint_force_numbers)
    t, forces = observed.t, reactions(model.assembly, run_of(model).end[0], observed)
    values, checks, columns = largest_joint_forces(model), [], list(cycle_columns(model, t))
    for name, joint in forces.joints.items():
        if name.endswith(" (link)"):
            continue
        size, joint_name = np.hypot(*joint.force.T), f"joint {in_words(name)}"
        columns.append(Column(f"{name}.force", "N", f"force in {joint_name}", size))
        columns += [
            Column(
                f"{name}.force_{axis}",
                "N",
                f"{axis} component of the force of {joint_name} on its first body",
                joint.force[:, k],
                f"force {axis} of {joint_name}",
            )
            for k, axis in enumerate("xy")
        ]
    for name, tension in forces.tensions.items():
        joint_name = f"joint {in_words(name)}"
        meaning = f"tension of the massless link of {joint_name}; below 0 contact is lost"
        columns.append(Column(f"{name}.tension", "N", meaning, tension, f"link tension, {joint_name}"))
        share, least = numbers.mean(f"{name}.pushed"), Value.of(numbers.of_run(f"{name}.tension"), "N", "")
        meaning = f"share of the time in which the massless link of {joint_name} is in compression"
        values[f"joints.{name}.pushed_share"] = Value.of(share, "-", meaning, f"compression time share, {joint_name}")
        checks.append(
            Check.of(
                least,
                f"contact.{name}",
                -model.limits.link_compression,
                ">=",
                f"minimum tension of the massless link of joint {name!r}; in compression the pin has lost contact: simulate it with "
                'model = "dry"',
                (name,),
                label=f"minimum link tension, {joint_name}",
            )
        )
    words, label = (
        "residual of the Newton-Euler equations of all bodies, relative to the largest force",
        "residual of the equations of motion",
    )
    values["forces.residual"] = Value(float(forces.residual.max()), "-", words, label=label)
    return Answer(
        values,
        (Table("forces", f"Joint forces{over_last_turn(model)}", tuple(columns)),),
        tuple(checks),
        tuple(_fold_findings(model, _unbounded(model))),
    )


def largest_joint_forces(model: SimulationModel) -> dict[str, Value]:
    """Largest force of every joint in the window; pins with play have it from `pins`."""
    numbers, hidden = statistics(model, joint_force_numbers), {*model.pins, *_unbounded(model)}
    names = [key.removesuffix(".force") for key in numbers.members[0].whole if key.endswith(".force")]
    return {
        f"joints.{name}.max_force": Value.of(numbers.of_run(f"{name}.force"), "N", f"peak force in joint {in_words(name)}")
        for name in names
        if name not in hidden and not name.endswith(" (link)")  # the other end of a link without mass: the same force
    }


def _unbounded(model):
    """{joint: time of the singular position towards which its force grows without bound}, in the window."""
    times, start = {}, start_of_window(model, run_of(model).end[1])
    for passed in run_of(model).passages:
        if passed.time >= start:
            observed = observe(passed.system, np.array([passed.time]), passed.state[None])
            times |= dict.fromkeys(unbounded_joints(model.assembly, passed.system, observed), passed.time)
    return times


def _fold_findings(model, unbounded):
    if unbounded:
        names, time = ", ".join(map(repr, unbounded)), max(unbounded.values())
        yield (
            f"the force in joints {names} grows without bound towards the singular position at t = {time:.6g} s, because collinear links "
            "cannot carry a transverse load. It has no peak value; elastic links or joint clearance would bound it"
        )
    elif run_of(model).passages:
        yield "joint forces at a singular position are limits of those beside it; tables and peak values leave them out"
