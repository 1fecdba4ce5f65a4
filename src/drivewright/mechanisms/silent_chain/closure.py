"""Centre distance, transmission error and rise of the strands over one tooth, without dynamics."""

import numpy as np

from drivewright.chains.closure import POSITIONS, departure
from drivewright.chains.closure.tables import closure_table, rigid_table
from drivewright.chains.explicit.turning import turning, yielding
from drivewright.chains.link import contact_pitch, rolled_length, seat_height
from drivewright.chains.path.route import bodies
from drivewright.errors import InputError
from drivewright.mechanisms.silent_chain.build import SIDES, ChainModel
from drivewright.mechanisms.silent_chain.chain_drive import bare_drive
from drivewright.mechanisms.silent_chain.meshing import SIDE_WORDS
from drivewright.mechanisms.silent_chain.phased_rows import phased_rows
from drivewright.result import Answer, Answers, Check, Value

SLACK = 0.01  # of the taut centre distance that a fixed one may be shorter
FREE = 1e-3  # of the taut centre distance: a fixed one that is longer would stretch the chain


def closure(model: ChainModel, done: Answers) -> Answer:
    """The closed loop over one tooth of the driving sprocket."""
    if not model.closes:
        return path_closure(model)
    motion = model.closure
    values = {
        "centre_distance.mean": Value(motion.mean, "m", "mean over a tooth, rigid plates, both strands taut"),
        "centre_distance.fluctuation": Value(motion.fluctuation, "m", "greatest less least over a tooth"),
        "transmission_error": Value(motion.transmission_ripple, "rad", "driven angle off the ratio of teeth, greatest less least"),
        **_sides(model),
    }
    checks = (*_wraps(model, values), _clearance(model), *_fixed(model))
    together, tables, findings = phased_rows(model)
    return Answer(values | together, (closure_table(motion), *tables), checks, (*_remarks(model), *findings), data=motion)


def path_closure(model: ChainModel) -> Answer:
    """The same of a drive with further sprockets or a tensioner, which is what gives way."""
    drive, balance = bare_drive(model), model.balance
    try:
        number = yielding(drive, balance)
    except InputError as reason:
        return Answer(findings=(f"analysis 'closure' (rigid links over a tooth) is left out: {reason}",), outcome="left out")
    turned = turning(drive, -np.linspace(0.0, 2 * np.pi / model.teeth[0], POSITIONS + 1), balance)
    moved, error = turned.q[:, number], turned.psi[:, drive.measured] - turned.angle * model.teeth[0] / model.teeth[1]
    name, words = _what_yields(model, drive, number)
    mean = float(0.5 * np.mean(moved[1:] + moved[:-1])) + (drive.sprockets[number].centre[0] if number == drive.measured else 0.0)
    values = {
        f"{name}.mean": Value(mean, "m", f"{words} of the rigid chain, mean over a tooth"),
        f"{name}.fluctuation": Value(float(np.ptp(moved)), "m", f"{words} of the rigid chain, greatest less least over a tooth"),
        "transmission_error": Value(float(np.ptp(error)), "rad", "driven angle off the ratio of teeth, greatest less least"),
    }
    return Answer(values, (rigid_table(turned.angle[0] - turned.angle, moved, error - np.mean(error[1:]), words),), data=turned)


def _what_yields(model, drive, number):
    """(name, words) of what gives way."""
    if number == drive.measured:
        return "centre_distance", "centre distance"
    name = bodies(drive)[number].name
    return f"tensioner.{name}.travel", f"travel of tensioner {name}"


def _sides(model):
    values = {}
    for number, side in enumerate(SIDES):
        leaving = departure(model.worn, model.teeth[number], model.spec.closure.strands)
        words = SIDE_WORDS[side]
        values[f"chordal_rise.{side}"] = Value(leaving.rise, "m", f"rise and fall of the strand's force over a tooth of the {words}")
        values[f"seating_angle.{side}"] = Value(leaving.seating, "rad", f"angle in which a plate comes to its seat on the {words}")
        values[f"strand_slip.{side}"] = Value(leaving.slip, "m", f"of the strand off a pitch per tooth of the {words}, greatest less least")
        values[f"wrap.{side}"] = Value(
            model.closure.mean_wrap(number), "rad", f"angle of the {words} that the chain takes in, mean over a tooth"
        )
        if model.link.radius:
            worn, teeth = model.worn, model.teeth[number]
            change, where = contact_pitch(worn, teeth) - worn.pitch, f"on the {words}"
            moved, rolled = "change of the distance of a seated plate's contacts", "length rolled in a joint, on either surface"
            values[f"pitch_change.{side}"] = Value(change, "m", f"{moved}, {where}", label=f"Pitch change {where}")
            values[f"rolled_length.{side}"] = Value(rolled_length(worn, teeth), "m", f"{rolled}, {where}", label=f"Rolled length {where}")
    return values


def _wraps(model, values):
    """Angles of the sprockets that the chain takes in."""
    for side in SIDES:
        message = f"angle of the {SIDE_WORDS[side]} that the chain takes in"
        yield Check(f"wrap.{side}", values[f"wrap.{side}"].value, model.spec.limits.wrap, ">=", "rad", message, (side,))


def _clearance(model):
    """Sprockets as large as their seated pin lines against the centre distance."""
    clearance = model.closure.mean - sum(seat_height(model.worn, z) for z in model.teeth)
    return Check(
        "sprockets.apart", clearance, 0.0, ">=", "m", "centre distance beyond the pin lines of the two sprockets", SIDES, geometry=True
    )


def _fixed(model):
    """A fixed centre distance against the taut one."""
    given, taut = model.spec.driven.centre_distance, model.closure.mean
    if given is not None and not model.spec.guides:
        against = "fixed centre distance against that of the taut chain: a"
        sags, overstretches = f"{against} shorter one lets the chain sag and jump", f"{against} longer one overstretches the chain"
        yield Check("centre_distance.slack", given, taut * (1 - SLACK), ">=", "m", sags, ("chain",))
        yield Check("centre_distance.taut", given, taut * (1 + FREE), "<=", "m", overstretches, ("chain",))


def _remarks(model):
    if model.spec.guides:
        yield "the closure leaves guides out: its strands are free between the sprockets"
    if model.elongation:
        yield (
            f"the chain is {100 * model.elongation:.3g} % longer than its pitch: it rides on the polygon of its own pitch, "
            "rigid; the analysis 'quasi_static' computes where it then touches the teeth"
        )
