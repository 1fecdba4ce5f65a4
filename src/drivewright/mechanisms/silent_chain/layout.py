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
            values |= path_values(model)
            checks += path_checks(model)
            findings += path_findings(model)
        checks += taut_checks(model, done)
        warnings += slack_warnings(model)
    except InputError as reason:
        way = "by pitch circles " if model.plain else ""
        warnings.append(f"layout {way}is left out: {reason}")
    return Answer(values, (), tuple(checks), (*findings, *_remarks(model.spec)), warnings=tuple(warnings))


def teeth_checks(model: ChainModel) -> Iterator[Check]:
    """Teeth of each sprocket against their least number; values are arrays where the spec's numbers are."""
    for side, teeth in zip(SIDES, model.teeth, strict=True):
        yield Check(f"teeth.{side}", 1.0 * teeth, float(model.spec.limits.teeth), ">=", "-", f"teeth of the {SIDE_WORDS[side]}", (side,))


def _remarks(spec):
    a, b = spec.plate.lacing
    if spec.links % 2 and (spec.roller or a != b):
        kinds = "inner and outer plates" if spec.roller else f"plates {a} and {b} side by side"
        yield (
            f"an odd number of links ({spec.links}) does not close with {kinds} in turn: it needs an offset link; the centre distance "
            "fluctuates differently too"
        )


def side_measures(model: ChainModel, side: str, number: int) -> Iterator[tuple[str, Measure]]:
    """(name, `Measure`) of the closed forms of one sprocket."""
    teeth, pitch, words = model.teeth[number], model.spec.pitch, SIDE_WORDS[side]
    yield f"layout.pitch_diameter.{side}", Measure(standards.pitch_diameter(pitch, teeth), "m", f"pitch circle of the {words}")
    yield (
        f"layout.speed_fluctuation.{side}",
        Measure(standards.speed_fluctuation(teeth), "-", f"of a hinged chain on the {words}: greatest less least speed, over the mean"),
    )
    if model.spec.roller:
        over = standards.over_pins(pitch, teeth, model.roller_diameter)
        yield f"over_pins.{side}", Measure(over, "m", f"distance over two measuring pins as thick as the rollers, {words}")


def _pair(model):
    spec, (z1, z2), pitch = model.spec, model.teeth, model.spec.pitch
    distance = float(standards.centre_distance(pitch, z1, z2, spec.links))
    values = {
        "layout.chain_length": Value(spec.links * pitch, "m", "pitch times links"),
        "layout.centre_distance": Value(distance, "m", "by pitch circles"),
        "layout.strand_length": Value(float(standards.strand_length(pitch, z1, z2, distance)), "m", "of a free strand"),
    }
    if spec.drive:
        force, density, speed = model.strands.tension, model.link_mass.mass / pitch, model.strands.speed
        for mode in range(1, MODES + 1):
            frequency = standards.strand_frequency(force, density, values["layout.strand_length"].value, speed, mode)
            values[f"layout.strand_frequency.{mode}"] = Value(float(frequency), "Hz", f"mode {mode} of a strand across, as a moving string")
        values["layout.mesh_frequency"] = Value(float(standards.mesh_frequency(z1, spec.drive.speed)), "Hz", "teeth that mesh in a second")
        values["layout.meeting_velocity"] = Value(
            float(standards.meeting_velocity(pitch, spec.drive.speed)), "m/s", "with which a hinged link meets the driving sprocket"
        )
    return values
