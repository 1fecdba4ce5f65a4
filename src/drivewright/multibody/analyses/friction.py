"""Friction of ideal joints over the run: losses, sticking, grip of wheels, efficiency, and whether the mechanism holds itself."""

from collections.abc import Iterator

import numpy as np

from drivewright._typing import Floats
from drivewright.labels import in_words
from drivewright.multibody.analyses.actuation import actuations, observe_run
from drivewright.multibody.analyses.ensemble import statistics
from drivewright.multibody.analyses.simulation_model import SimulationModel, cycle_columns, last_turn, over_last_turn, run_of
from drivewright.multibody.analyses.turns import RunNumbers, mean_per_turn, start_of_window, turn_ends
from drivewright.multibody.forces.joint_friction import KINDS
from drivewright.multibody.forces.resting_friction import holding_shares, with_loads
from drivewright.multibody.observe import POWER_FIELDS
from drivewright.multibody.observed import FRICTION_FIELDS
from drivewright.multibody.simulate import Run
from drivewright.multibody.system import joints_with_friction
from drivewright.numerics.signals import time_mean
from drivewright.result import Answer, Check, Column, Table, Value

MORE, GROWS = 2.0, 1e-3  # factor on the loads, and growth of the shares by it, that tell self-locking from a load that is too small
LITTLE = 1e-6  # of what joints can hold: there is no load
AT_REST = 1e-3  # rate over the largest one of the run below which a joint is at rest
TURNING = (KINDS["pin"], KINDS["wheel"])


def rubbing_joints(model: SimulationModel) -> list[tuple[str, bool]]:
    """(name, whether it turns) of the ideal joints with friction, in the order of the records."""
    table, joints = joints_with_friction(model.assembly.system), model.assembly.expanded.joints
    return [(joints[one.joint].name, int(one.kind) in TURNING) for one in table]


def friction_numbers(model: SimulationModel, run: Run) -> RunNumbers:
    """Means over the window of the losses and of what sticks, and the largest friction of every joint, in SI."""
    start = start_of_window(model, run.end[1])
    observed = observe_run(model, run, start)
    ends, numbers = turn_ends(model, start, observed.t[-1]), RunNumbers()
    rates = {f"{name}.{key}": values for k, (name, _) in enumerate(rubbing_joints(model)) for key, values in _of_joint(observed, k).items()}
    driving = sum((one.power for one in actuations(model, observed)), np.zeros(len(observed.t)))
    losses = -observed.powers[:, POWER_FIELDS.index("friction")]
    rates |= {"driving": driving, "losses": losses, "holds": ((driving > 0) & (driving < losses)).astype(float)}
    for name, values in rates.items():
        t, values = staircase(observed.t, values) if name.endswith(".stuck") else (observed.t, values)
        numbers.whole[name] = time_mean(t, values)
        numbers.turns.update({name: mean_per_turn(t, values, ends)} if len(ends) > 1 else {})
    numbers.whole["loads"] = -_load_power(observed, driving, model)
    for k, (name, _) in enumerate(rubbing_joints(model)):
        numbers.whole[f"{name}.most"] = float(np.max(np.abs(observed.friction(k, "force"))))
    return numbers


def staircase(t: Floats, x: Floats) -> tuple[Floats, Floats]:
    """(times, values), the corners of x (m,) kept from each time to the next: what changes in events alone is no polygon between them."""
    return np.repeat(t, 2)[1:-1], np.repeat(x, 2)[:-2]


def _of_joint(observed, k):
    power = -observed.friction(k, "force") * observed.friction(k, "rate")
    return {"power": power, "stuck": (observed.friction(k, "sliding") == 0.0).astype(float)}


def _load_power(observed, driving, model):
    """Mean power that the loads give: what is applied, but for the motors."""
    applied = observed.powers[:, POWER_FIELDS.index("applied")]
    motors = driving - observed.powers[:, POWER_FIELDS.index("drives")]
    return time_mean(observed.t, applied - motors) if len(observed.t) > 1 else 0.0


def friction(model: SimulationModel) -> Answer:
    """Losses by joint, efficiency, sticking, grip of wheels; friction over the last turn as a table."""
    numbers, values = statistics(model, friction_numbers), {}
    for name, turns in rubbing_joints(model):
        unit, word = ("N m", "torque") if turns else ("N", "force")
        joint = f"joint {in_words(name)}"
        power = Value.of(numbers.mean(f"{name}.power"), "W", f"mean power lost to friction in {joint}", f"mean friction power, {joint}")
        peak = numbers.of_run(f"{name}.most", f"{name}.power")
        most = Value.of(peak, unit, f"peak magnitude of the friction {word} in {joint}", f"peak friction in {joint}")
        values |= {f"joints.{name}.friction_power": power, f"joints.{name}.max_friction": most}
        if model.assembly.freedom:
            share = numbers.mean(f"{name}.stuck")
            values[f"joints.{name}.stick_share"] = Value.of(
                share, "-", f"share of the time in which {joint} sticks", f"sticking time share, {joint}"
            )
    meaning = "mean power lost to friction in ideal joints"
    values["friction.power"] = Value.of(numbers.mean("losses"), "W", meaning, "mean friction power, ideal joints")
    values |= _efficiency(model)
    findings = (*_no_efficiency(model, values), *_standstill(model))
    return Answer(values, (_table(model),), tuple(_grip_checks(model)), findings)


def _efficiency(model):
    """Power that loads take over that of drives and motors; whether friction alone holds the mechanism against its load."""
    numbers = statistics(model, friction_numbers)
    given, taken = numbers.members[0].whole["driving"], numbers.members[0].whole["loads"]
    values = {}
    if given > 0.0 and taken > 0.0:
        words = "mean power taken by the loads over that given by drives and motors"
        values["efficiency"] = Value(taken / given, "-", words, label="mechanical efficiency")
    if given != 0.0:
        words = "share of the time in which friction keeps the load from driving the mechanism"
        values["friction.self_locking_share"] = Value.of(numbers.mean("holds"), "-", words, "self-locking time share")
    return values


def _no_efficiency(model, values) -> Iterator[str]:
    if "efficiency" not in values and statistics(model, friction_numbers).members[0].whole["driving"] > 0.0:
        yield (
            "there is no efficiency: no force or torque of the spec takes power from the mechanism, and all that drives give goes into "
            "friction and damping"
        )


def _table(model):
    turn, columns = last_turn(model), []
    for k, (name, turns) in enumerate(rubbing_joints(model)):
        rate, force = (turn.frictions[:, k, FRICTION_FIELDS.index(field)] for field in ("rate", "force"))
        words = ("torque", "N m", "rad/s", "angular velocity") if turns else ("force", "N", "m/s", "sliding velocity")
        joint = f"joint {in_words(name)}"
        columns += [
            Column(f"{name}.friction", words[1], f"friction {words[0]} in {joint}", force),
            Column(f"{name}.rate", words[2], f"{words[3]} of {joint}", rate),
            Column(f"{name}.loss", "W", f"friction loss in {joint}", -force * rate),
        ]
    return Table("friction", f"Joint friction{over_last_turn(model)}", (*cycle_columns(model, turn.t), *columns))


def _grip_checks(model) -> Iterator[Check]:
    """A wheel must be pressed on its track, and not slip."""
    run = run_of(model)
    observed = observe_run(model, run, start_of_window(model, run.end[1]))
    for k, (name, _) in enumerate(rubbing_joints(model)):
        if name not in model.grips:
            continue
        normal, tangential = observed.friction(k, "normal"), observed.friction(k, "tangential")
        words = f"minimum normal force between wheel and track of joint {name!r}; below 0 the wheel lifts off: press it on"
        label = f"minimum normal force, joint {in_words(name)}"
        yield Check(f"contact.{name}", float(np.min(normal)), 0.0, ">=", "N", words, (name,), label=label)
        if model.grips[name] > 0.0:
            share = np.divide(np.abs(tangential), normal, out=np.full(len(normal), np.inf), where=normal > 0.0)
            words = (
                f"maximum ratio of tangential to normal force of the wheel of joint {name!r}; above the coefficient of friction the wheel "
                "slips: raise its normal force"
            )
            label = f"traction ratio, joint {in_words(name)}"
            yield Check(f"grip.{name}", float(np.max(share)), model.grips[name], "<=", "-", words, (name,), label=label)


def _standstill(model) -> Iterator[str]:
    """A finding where friction holds the mechanism at the end of the run: since when, and how near the joints are to sliding."""
    run = run_of(model)
    if model.assembly.freedom == 0 or run.advice:
        return
    observed = observe_run(model, run)
    rates = np.abs(observed.frictions[:, :, FRICTION_FIELDS.index("rate")])
    moving = np.any(rates > AT_REST * np.max(rates, axis=0, initial=0.0), axis=1)
    if moving[-1] or not np.any(moving):
        if np.any(moving):
            return
        since = float(observed.t[0])
    else:
        since = float(observed.t[np.flatnonzero(moving)[-1]])
    shares = observed.frictions[-1, :, FRICTION_FIELDS.index("share")]
    held = ", ".join(f"{name!r} {100 * share:.3g} %" for (name, _), share in zip(rubbing_joints(model), shares, strict=True))
    yield (
        f"friction holds the mechanism at rest from t = {since:.4g} s to the end of the run. Utilisation of the static friction by joint: "
        f"{held}. {_what_moves_it(run)}"
    )


def _what_moves_it(run):
    """Whether larger loads would move what friction holds: not where they press the joints as much as they push."""
    system, t, y = run.end
    now, then = holding_shares(system, t, y), holding_shares(with_loads(system, MORE), t, y)
    if np.max(now) < LITTLE:
        return "No load acts on it"
    if np.any(then > now * (1 + GROWS)):
        return "If the mechanism is meant to move, raise the motor torque or the load, or lower the friction"
    return (
        "The mechanism is self-locking: a larger load raises the joint forces in proportion and does not move it either. Lower the "
        "coefficient of friction, lengthen a guide (bearing_length), apply the load closer to the joint, or make a slope steeper"
    )
