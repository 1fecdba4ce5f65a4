"""Chain, sprocket and cutter as published: pitches, deviations, offset, modification."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from drivewright._typing import Numbers
from drivewright.chains import meshing as published
from drivewright.chains.published_design import equivalent_pitch_table
from drivewright.mechanisms.silent_chain.build import SIDES, ChainModel
from drivewright.result import Answer, Answers, Check, Value

SIDE_WORDS = {"drive": "driving sprocket", "driven": "driven sprocket"}


def meshing(model: ChainModel, done: Answers) -> Answer:
    """All measures of the published method, and its curve of the equivalent pitch."""
    numbers = measures(model)
    for number, side in enumerate(SIDES):
        numbers |= seated_measures(model, side, number)
    values = {name: measure.value() for name, measure in numbers.items()}
    curve = equivalent_pitch_table(model.spec.pitch, model.link.radius, float(model.offset), min(model.teeth))
    return Answer(values, (curve,), tuple(offset_checks(model)), tuple(_remarks(model)))


class Measure(NamedTuple):
    """A number by formula, or those of many designs at once, with its unit and meaning."""

    number: Numbers
    unit: str
    meaning: str

    def value(self) -> Value:
        """The `Value` of one design."""
        return Value(float(self.number), self.unit, self.meaning)


def measures(model: ChainModel) -> dict[str, Measure]:
    """{name: Measure} of the chain itself."""
    pitch, (z1, z2), apothem = model.spec.pitch, model.teeth, model.standard_apothem
    assert apothem is not None  # the plates mesh
    return {
        "hole_pitch": Measure(model.link.hole_pitch, "m", "distance of the centres of a plate's own pins"),
        "pin_offset": Measure(model.offset, "m", "centres of the pins below the pitch line"),
        "standard_apothem": Measure(apothem, "m", "rotation centre on the pitch line to the flank on the same side"),
        "pitch_deviation.reference": Measure(
            published.reference_deviation(pitch, z1, z2), "m", "delta12: difference of the two ideal pitches p/cos(pi/z), drive less driven"
        ),
        "k": Measure(published.pitch_constant(z1, z2), "-", "constant k of the boundary radius"),
        "rolling_radius.boundary": Measure(
            published.boundary_radius(pitch, z1, z2),
            "m",
            "r10: radius at which a chain matched to the drive deviates by delta12 on the other sprocket",
        ),
        "rolling_radius.monotone_limit": Measure(
            published.monotone_radius(pitch, z1),
            "m",
            "radius below which the equivalent pitch of a matched chain grows up to the drive's seat",
        ),
    }


def seated_measures(model: ChainModel, side: str, number: int) -> dict[str, Measure]:
    """{name: Measure} of the seated chain and the tooth of one sprocket."""
    sprocket, words = model.sides[number], SIDE_WORDS[side]
    seated = f"of the seated chain on the {words}"
    return {
        f"seated_pitch.{side}": Measure(sprocket.seated_pitch, "m", f"equivalent pitch {seated}"),
        f"ideal_pitch.{side}": Measure(sprocket.ideal_pitch, "m", f"pitch without polygonal action in the published measure, {words}"),
        f"pitch_deviation.{side}": Measure(sprocket.deviation, "m", f"seated less ideal pitch, {words}"),
        f"seated_apothem.{side}": Measure(sprocket.seated_apothem, "m", f"apothem {seated}"),
        f"modification.{side}": Measure(sprocket.modification, "-", f"modification coefficient x of the {words}"),
        f"positioning_diameter.{side}": Measure(sprocket.positioning_diameter, "m", f"circle through the rotation centres {seated}"),
        f"contact_radius.{side}": Measure(sprocket.tooth.contact_radius, "m", f"where a seated plate touches the tooth, {words}"),
        f"curvature_radius.{side}": Measure(sprocket.tooth.curvature_radius, "m", f"of the tooth where a seated plate touches it, {words}"),
        f"base_radius.{side}": Measure(sprocket.tooth.base_radius, "m", f"base circle of the {words}"),
    }


def offset_checks(model: ChainModel) -> Iterator[Check]:
    """The offset against the rolling radius; an array where the spec's numbers are."""
    if model.joint_kind != "revolute":
        message = "offset over rolling radius: beyond 1 the published growth of the pitch has no end"
        ratio = np.abs(model.offset) / model.link.radius
        yield Check("offset", ratio, 1.0, "<=", "-", message, ("chain",))  # pyright: ignore[reportArgumentType]  arrays, of many designs


def _remarks(model):
    spec, (z1, z2) = model.spec, model.teeth
    yield (
        f"the offset of {1e3 * model.offset:.4g} mm enters the published measures alone: seats, teeth, centre distance and forces "
        "do not depend on it, only on rolling radius and flank"
    )
    if z1 > z2:
        yield (
            f"the driving sprocket has more teeth ({z1}) than the driven one ({z2}): the driven sprocket turns the plates furthest and "
            "governs the growth of the pitch; delta12 and the deviations change their signs"
        )
    if z1 == z2:
        yield "equal tooth numbers: delta12 is 0, and an offset matched to one sprocket is matched to both"
    base = spec.pitch * np.cos(spec.plate.flank_angle)
    ours = model.cutter.pitch * np.cos(model.cutter.half_angle)
    if abs(ours / base - 1) > 1e-9:
        yield (
            f"the cutter's base pitch of {1e3 * ours:.6g} mm is not the chain's, {1e3 * base:.6g} mm: the tooth is another involute than "
            "that of a matching cutter"
        )
    if spec.meshing.apothem_reference == "pin":
        error = model.offset * np.sin(spec.plate.flank_angle)
        yield f'apothem_reference = "pin": the teeth are cut {1e6 * error:.4g} um per flank off the plates\' real flanks'
