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
from drivewright.mechanisms.silent_chain.tensioned import SLACK, wrap_check
from drivewright.result import Answer, Answers, Check, Value

RIGID_ERROR = "transmission error over one tooth, peak-to-peak: angle of the driven sprocket minus that by the tooth ratio, rigid chain"
FREE = 1e-3  # of the taut centre distance: a fixed one that is longer would stretch the chain


def closure(model: ChainModel, done: Answers) -> Answer:
    """The closed loop over one tooth of the driving sprocket."""
    if not model.closes:
        return path_closure(model)
    motion = model.closure
    values = {
        "centre_distance.mean": Value(
            motion.mean,
            "m",
            "mean centre distance over one tooth of the driving sprocket, with rigid plates and both strands taut",
            label="Centre distance, mean over one tooth",
        ),
        "centre_distance.fluctuation": Value(
            motion.fluctuation,
            "m",
            "peak-to-peak centre distance over one tooth of the driving sprocket, with rigid plates",
            label="Centre distance, peak-to-peak, one tooth",
        ),
        "transmission_error": Value(motion.transmission_ripple, "rad", RIGID_ERROR, label="Transmission error, peak-to-peak"),
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
        return Answer(findings=(f"analysis 'closure' (rigid chain over one tooth) is left out: {reason}",), outcome="left out")
    turned = turning(drive, -np.linspace(0.0, 2 * np.pi / model.teeth[0], POSITIONS + 1), balance)
    moved, error = turned.q[:, number], turned.psi[:, drive.measured] - turned.angle * model.teeth[0] / model.teeth[1]
    name, words, labels = _what_yields(model, drive, number)
    mean = float(0.5 * np.mean(moved[1:] + moved[:-1])) + (drive.sprockets[number].centre[0] if number == drive.measured else 0.0)
    values = {
        f"{name}.mean": Value(mean, "m", f"mean {words} over one tooth of the driving sprocket, rigid chain", label=labels[0]),
        f"{name}.fluctuation": Value(
            float(np.ptp(moved)), "m", f"peak-to-peak {words} over one tooth of the driving sprocket, rigid chain", label=labels[1]
        ),
        "transmission_error": Value(float(np.ptp(error)), "rad", RIGID_ERROR, label="Transmission error, peak-to-peak"),
    }
    return Answer(values, (rigid_table(turned.angle[0] - turned.angle, moved, error - np.mean(error[1:]), words),), data=turned)


def _what_yields(model, drive, number):
    """(name, words, labels of its mean and its peak-to-peak) of what gives way."""
    if number == drive.measured:
        return "centre_distance", "centre distance", ("Centre distance, mean over one tooth", "Centre distance, peak-to-peak, one tooth")
    name = bodies(drive)[number].name
    labels = (f"Rigid travel of {name}, mean", f"Rigid travel of {name}, peak-to-peak")
    return f"tensioner.{name}.travel", f"travel of tensioner {name}", labels


def _sides(model):
    values = {}
    for number, side in enumerate(SIDES):
        leaving = departure(model.worn, model.teeth[number], model.spec.closure.strands)
        words = SIDE_WORDS[side]
        values[f"chordal_rise.{side}"] = Value(
            leaving.rise,
            "m",
            f"peak-to-peak height of the line of action of the strand tension above the centre of the {words}, over one tooth",
            label=f"Chordal rise, {words}",
        )
        meaning = f"angle between the last seated plate and the strand's normal when the next plate is seated on the {words}"
        values[f"seating_angle.{side}"] = Value(leaving.seating, "rad", meaning, label=f"Seating angle, {words}")
        meaning = f"peak-to-peak deviation of the strand from a uniform travel of one pitch per tooth of the {words}"
        values[f"strand_slip.{side}"] = Value(leaving.slip, "m", meaning, label=f"Strand travel error, {words}")
        meaning = f"wrap angle of the chain on the {words}, mean over one tooth"
        values[f"wrap.{side}"] = Value(model.closure.mean_wrap(number), "rad", meaning, label=f"Wrap angle, {words}")
        if model.link.radius:
            worn, teeth = model.worn, model.teeth[number]
            change = contact_pitch(worn, teeth) - worn.pitch
            meaning = f"distance between the two rolling contacts of a plate seated on the {words}, minus that of a straight chain"
            values[f"pitch_change.{side}"] = Value(change, "m", meaning, label=f"Pitch change, {words}")
            meaning = f"length that each surface of a joint rolls when its plates are seated on the {words}"
            values[f"rolled_length.{side}"] = Value(rolled_length(worn, teeth), "m", meaning, label=f"Rolled length, {words}")
    return values


def _wraps(model, values):
    """Wrap angles of both sprockets."""
    for side in SIDES:
        yield wrap_check(model, side, values[f"wrap.{side}"].value)


def _clearance(model):
    """Sprockets as large as their seated pin lines against the centre distance."""
    clearance = model.closure.mean - sum(seat_height(model.worn, z) for z in model.teeth)
    message = "centre distance minus the radii of both seated pin lines; if negative, the sprockets overlap: give the chain more links"
    return Check("sprockets.apart", clearance, 0.0, ">=", "m", message, SIDES, geometry=True, label="Clearance between the sprockets")


def _fixed(model):
    """A fixed centre distance against the taut one."""
    given, taut = model.spec.driven.centre_distance, model.closure.mean
    if given is not None and not model.spec.guides:
        sags = "fixed centre distance, at least about that of the taut chain; below it the chain sags and jumps teeth: increase it"
        overstretches = "fixed centre distance, at most about that of the taut chain; above it the chain is overstretched: reduce it"
        labels = "Fixed centre distance, sag", "Fixed centre distance, overstretch"
        yield Check("centre_distance.slack", given, taut * (1 - SLACK), ">=", "m", sags, ("chain",), label=labels[0])
        yield Check("centre_distance.taut", given, taut * (1 + FREE), "<=", "m", overstretches, ("chain",), label=labels[1])


def _remarks(model):
    if model.spec.guides:
        yield "the closure of the rigid chain ignores guides: its strands are free between the sprockets"
    if model.elongation:
        yield (
            f"the chain is elongated by {100 * model.elongation:.3g} %: the closure places it, rigid, on the polygon of its own pitch; "
            "the analysis 'quasi_static' computes where it then touches the teeth"
        )
