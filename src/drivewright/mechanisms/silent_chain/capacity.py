"""Life and capacity: elongation of the chain by wear of its joints, and its rated power against the power transmitted."""

import numpy as np

from drivewright.chains import wear as joint
from drivewright.chains.standards import ansi_power, strand_factor
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.sizing import size_of
from drivewright.mechanisms.silent_chain.taut import slack_warnings, taut_checks
from drivewright.result import Answer, Answers, Check, Column, Table, Value

GIVEN = "given"  # interval of what follows from a range that the spec gives
HOUR = 3600.0  # [s]
SAMPLES = 41  # of the table of elongation
BEYOND = 1.25  # times the life by the middle coefficient


def wear(model: ChainModel, done: Answers) -> Answer:
    """Elongation by wear of the joints over time, and the time until it reaches its limit."""
    found = model.joint_wear
    assert found is not None and model.spec.wear is not None
    pitch = model.spec.pitch
    limit = joint.elongation_limit(model.spec.wear.elongation_limit, (*model.teeth, *(each.teeth for each in model.spec.sprockets)))
    lives = found.turn_time * np.asarray(joint.revolutions_to(limit, pitch, found.depths))
    life = _interval(lives[0], lives[1:], "s", "wear life: time until wear elongates the chain to its elongation limit")
    values = {
        "wear.sliding": Value(
            found.sliding,
            "m",
            "sliding distance of the pin in its bush per chain revolution",
            label="Sliding in a joint per chain revolution",
        ),
        "wear.depth": _interval(found.depths[0], found.depths[1:], "m", "joint wear per chain revolution: increase in length of a joint"),
        "wear.elongation_limit": Value(limit, "-", "elongation limit: elongation at which the chain is replaced"),
        "wear.life": life,
    }
    if model.spec.wear.running_time:
        grown = found.elongation(model.spec.wear.running_time, pitch)
        values["wear.elongation"] = _interval(grown[0], grown[1:], "-", "elongation by wear, after the running time")
    return Answer(
        values,
        (_wear_table(found, pitch, limit, float(lives[0])),),
        (*_wear_checks(model, life, values), *taut_checks(model, done)),
        tuple(_wear_remarks(model)),
        warnings=tuple(slack_warnings(model)),
    )


def _wear_checks(model, life, values):
    required = model.spec.limits.wear_life
    if required is not None:
        message = "time until wear elongates the chain to its elongation limit; less tension, larger joints or better lubrication extend it"
        yield Check.of(life, "wear.life", required, ">=", message, ("chain",), "Wear life")
    if "wear.elongation" in values:
        message = "elongation by wear after the running time; if it exceeds the elongation limit, replace the chain earlier"
        yield Check.of(
            values["wear.elongation"],
            "wear.elongation",
            values["wear.elongation_limit"].value,
            "<=",
            message,
            ("chain",),
            "Elongation by wear",
        )


def _wear_remarks(model):
    if model.spec.roller:
        yield (
            "wear lengthens only the pitches with outer plates, by twice the mean; the closure and the running chain use the mean for "
            "all pitches"
        )
    if model.spec.closure.elongation:
        yield "the elongation by wear is added to closure.elongation, which is taken as present from the start"


def _wear_table(found, pitch, limit, life):
    time = np.linspace(0.0, BEYOND * life, SAMPLES)
    middle, *bounds = np.outer(found.depths, time / found.turn_time) / pitch
    grown = Column("elongation", "-", "elongation of the chain by wear", middle)
    hours = Column("hours", "-", "running time in hours", time / HOUR)
    columns = [Column("time", "s", "running time", time), hours, grown, *(grown.bounds(*bounds) if bounds else ())]
    columns.append(Column("limit", "-", "elongation limit", np.full(SAMPLES, limit)))
    return Table("wear", "Elongation by wear over running time", tuple(columns))


def _interval(value, bounds, unit, meaning):
    """A value with the interval of the range of the coefficient, where one is given."""
    return (
        Value(float(value), unit, meaning, float(min(bounds)), float(max(bounds)), GIVEN)
        if len(bounds)
        else Value(float(value), unit, meaning)
    )


def rating(model: ChainModel, done: Answers) -> Answer:
    """Rated power of the chain against the power that it transmits."""
    given, drive, size = model.spec.rating, model.drive, size_of(model.spec)
    small = int(np.argmin(model.teeth))
    speed = drive.speed * model.teeth[0] / model.teeth[small]
    power = drive.load_torque * drive.speed * model.teeth[0] / model.teeth[1]
    factor = given.strand_factor or strand_factor(model.rows)
    values = {
        "rating.power": Value(power, "W", "transmitted power: load torque times speed of the driven sprocket"),
        "rating.design_power": Value(given.service_factor * power, "W", "design power: transmitted power times service factor"),
    }
    single = given.rated_power
    if single is None:
        assert size is not None  # else there is no rating
        limits = ansi_power(size.ansi, size.pitch, model.teeth[small], speed, size.bush_chain)
        values["rating.plate_fatigue"] = Value(
            float(factor * limits.plate_fatigue),
            "W",
            "power rating by fatigue of the link plates",
            label="Power rating, link plate fatigue",
        )
        values["rating.roller_impact"] = Value(
            float(factor * limits.roller_impact), "W", "power rating by impact of rollers and bushes", label="Power rating, roller impact"
        )
        single = float(limits.rated)
    rated = factor * single
    values["rating.rated_power"] = Value(rated, "W", "rated power of the chain, all rows together", label="Rated power")
    message = "rated power of the chain, at least the design power; a larger chain, more teeth or more rows increase it"
    check = Check("rating.power", rated, values["rating.design_power"].value, ">=", "W", message, ("chain",), label="Rated power")
    return Answer(values, (), (check,), tuple(_rating_remarks(given)))


def _rating_remarks(given):
    if given.rated_power is None:
        yield (
            "rating: by the formulas of ASME B29.1, for 15,000 h, uniform load and the lubrication of the standard; the limit by galling "
            "of the pins is not included"
        )
