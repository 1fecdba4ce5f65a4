"""The drive by formula: length of the chain, pitch circles, wraps, unevenness, strands as moving strings."""

from collections.abc import Iterator

from drivewright.chains import standards
from drivewright.errors import InputError
from drivewright.mechanisms.silent_chain.build import SIDES, ChainModel
from drivewright.mechanisms.silent_chain.meshing import SIDE_WORDS, Measure
from drivewright.mechanisms.silent_chain.taut import slack_warnings, taut_checks
from drivewright.mechanisms.silent_chain.tensioned import path_checks, path_findings, path_values
from drivewright.result import Answer, Answers, Check, Value

MODES = 2  # of a strand


def layout(model: ChainModel, done: Answers) -> Answer:
    """Formulas of the field, for two sprockets; with further ones, guides or a fixed centre distance those of the path in balance."""
    values = {name: measure.value() for k, side in enumerate(SIDES) for name, measure in side_measures(model, side, k)}
    findings, checks, warnings = [], list(teeth_checks(model)), []
    try:
        if model.plain or not model.spec.drive:
            values |= {} if model.spec.sprockets else _pair(model)
        else:
            values |= path_values(model) | meshing_values(model)
            checks += path_checks(model)
            findings += path_findings(model)
        checks += taut_checks(model, done)
        warnings += slack_warnings(model)
    except InputError as reason:
        way = " by pitch circles" if model.plain else ""
        warnings.append(f"the layout{way} is left out: {reason}")
    return Answer(values, (), tuple(checks), (*findings, *_remarks(model.spec)), warnings=tuple(warnings))


def teeth_checks(model: ChainModel) -> Iterator[Check]:
    """Teeth of each sprocket against their least number; values are arrays where the spec's numbers are."""
    for side, teeth in zip(SIDES, model.teeth, strict=True):
        words = SIDE_WORDS[side]
        message, label = f"number of teeth of the {words}; fewer teeth increase the polygon effect", f"Number of teeth, {words}"
        yield Check(f"teeth.{side}", 1.0 * teeth, float(model.spec.limits.teeth), ">=", "-", message, (side,), label=label)


def _remarks(spec):
    a, b = spec.plate.lacing
    if spec.links % 2 and (spec.roller or a != b):
        kinds = "inner and outer plates" if spec.roller else f"plates {a} and {b} side by side"
        yield (
            f"an odd number of links ({spec.links}) does not close with {kinds} in turn: the chain needs an offset link, with which the "
            "centre distance fluctuates differently"
        )


def side_measures(model: ChainModel, side: str, number: int) -> Iterator[tuple[str, Measure]]:
    """(name, `Measure`) of the closed forms of one sprocket."""
    teeth, pitch, words = model.teeth[number], model.spec.pitch, SIDE_WORDS[side]
    diameter = standards.pitch_diameter(pitch, teeth)
    yield (
        f"layout.pitch_diameter.{side}",
        Measure(diameter, "m", f"diameter of the pitch circle of the {words}", f"Pitch diameter, {words}"),
    )
    meaning = f"peak-to-peak speed of a hinged chain on the {words} over its mean speed, by the polygon effect"
    unevenness = Measure(standards.speed_fluctuation(teeth), "-", meaning, f"Speed fluctuation, {words}")
    yield f"layout.speed_fluctuation.{side}", unevenness
    if model.spec.roller:
        over = standards.over_pins(pitch, teeth, model.roller_diameter)
        meaning = f"measurement over two pins of the rollers' diameter in the tooth gaps of the {words}"
        yield f"over_pins.{side}", Measure(over, "m", meaning, f"Measurement over pins, {words}")


def _pair(model):
    spec, (z1, z2), pitch = model.spec, model.teeth, model.spec.pitch
    distance = float(standards.centre_distance(pitch, z1, z2, spec.links))
    values = {
        "layout.chain_length": Value(spec.links * pitch, "m", "pitch times number of links", label="Chain length"),
        "layout.centre_distance": Value(
            distance, "m", "centre distance at which the chain fits around the two pitch circles", label="Centre distance by pitch circles"
        ),
        "layout.strand_length": Value(
            float(standards.strand_length(pitch, z1, z2, distance)), "m", "length of a free strand", label="Strand length"
        ),
    }
    if spec.drive:
        force, density, speed = model.strands.tension, model.link_mass.mass / pitch, model.strands.speed
        for mode in range(1, MODES + 1):
            frequency = standards.strand_frequency(force, density, values["layout.strand_length"].value, speed, mode)
            values[f"layout.strand_frequency.{mode}"] = Value(
                float(frequency),
                "Hz",
                f"natural frequency of mode {mode} of the transverse vibration of a strand, as a moving string",
                label=f"Strand frequency, mode {mode}",
            )
        values |= meshing_values(model)
    return values


def meshing_values(model: ChainModel) -> dict[str, Value]:
    """Mesh frequency and impact velocity at the driving sprocket."""
    frequency = standards.mesh_frequency(model.teeth[0], model.drive.speed)
    velocity = standards.meeting_velocity(model.spec.pitch, model.drive.speed)
    return {
        "layout.mesh_frequency": Value(float(frequency), "Hz", "number of teeth that mesh per second", label="Mesh frequency"),
        "layout.meeting_velocity": Value(
            float(velocity),
            "m/s",
            "velocity at which a link of a hinged chain meets the driving sprocket",
            label="Impact velocity of a hinged link",
        ),
    }
