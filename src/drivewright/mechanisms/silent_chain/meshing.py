"""Chain, sprocket and cutter by the published method: pitches, deviations, offset, modification."""

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
    """A number by formula, or those of many designs at once, with its unit, meaning, label and convention."""

    number: Numbers
    unit: str
    meaning: str
    label: str
    convention: str = ""

    def value(self) -> Value:
        """The `Value` of one design."""
        return Value(float(self.number), self.unit, self.meaning, label=self.label, convention=self.convention)


def measures(model: ChainModel) -> dict[str, Measure]:
    """{name: Measure} of the chain itself."""
    pitch, (z1, z2), apothem = model.spec.pitch, model.teeth, model.standard_apothem
    assert apothem is not None  # the plates mesh
    return {
        "hole_pitch": Measure(
            model.link.hole_pitch, "m", "distance between the centres of the two pins of a plate", "Hole pitch of a plate"
        ),
        "pin_offset": Measure(
            model.offset,
            "m",
            "distance of the pin centres from the pitch line",
            "Pin offset",
            "positive where the centres lie below the line",
        ),
        "standard_apothem": Measure(
            apothem, "m", "distance from the rotation centre on the pitch line to the flank on the same side", "Standard apothem"
        ),
        "pitch_deviation.reference": Measure(
            published.reference_deviation(pitch, z1, z2),
            "m",
            "delta12: difference between the ideal pitches p/cos(pi/z) of the two sprockets",
            "Reference pitch deviation",
            "driving minus driven sprocket",
        ),
        "k": Measure(published.pitch_constant(z1, z2), "-", "constant k in the formula of the boundary rolling radius", "Pitch constant k"),
        "rolling_radius.boundary": Measure(
            published.boundary_radius(pitch, z1, z2),
            "m",
            "r10: rolling radius at which a chain matched to the driving sprocket has the pitch deviation delta12 on the driven sprocket",
            "Boundary rolling radius",
        ),
        "rolling_radius.monotone_limit": Measure(
            published.monotone_radius(pitch, z1),
            "m",
            "largest rolling radius at which the equivalent pitch of a matched chain grows monotonically until the plates are seated on "
            "the driving sprocket",
            "Rolling radius for monotone pitch growth",
        ),
    }


def seated_measures(model: ChainModel, side: str, number: int) -> dict[str, Measure]:
    """{name: Measure} of the seated chain and the tooth of one sprocket."""
    sprocket, words = model.sides[number], SIDE_WORDS[side]
    tooth, seated, touching = (
        sprocket.tooth,
        f"of the seated chain on the {words}",
        f"at which a seated plate touches the tooth of the {words}",
    )
    return {
        f"seated_pitch.{side}": Measure(sprocket.seated_pitch, "m", f"equivalent pitch {seated}", f"Equivalent pitch, {words}"),
        f"ideal_pitch.{side}": Measure(
            sprocket.ideal_pitch, "m", f"pitch without polygon effect on the {words}, by the published method", f"Ideal pitch, {words}"
        ),
        f"pitch_deviation.{side}": Measure(
            sprocket.deviation, "m", f"deviation of the equivalent pitch {seated}", f"Pitch deviation, {words}", "seated minus ideal pitch"
        ),
        f"seated_apothem.{side}": Measure(sprocket.seated_apothem, "m", f"apothem {seated}", f"Seated apothem, {words}"),
        f"modification.{side}": Measure(
            sprocket.modification,
            "-",
            f"modification (profile shift) coefficient x of the teeth of the {words}",
            f"Profile shift x, {words}",
        ),
        f"positioning_diameter.{side}": Measure(
            sprocket.positioning_diameter,
            "m",
            f"diameter of the circle through the rotation centres {seated}",
            f"Positioning diameter, {words}",
        ),
        f"contact_radius.{side}": Measure(tooth.contact_radius, "m", f"radius {touching}", f"Contact radius, {words}"),
        f"curvature_radius.{side}": Measure(
            tooth.curvature_radius, "m", f"radius of curvature of the flank {touching}", f"Radius of curvature, {words}"
        ),
        f"base_radius.{side}": Measure(tooth.base_radius, "m", f"radius of the base circle of the {words}", f"Base radius, {words}"),
    }


def offset_checks(model: ChainModel) -> Iterator[Check]:
    """The offset against the rolling radius; an array where the spec's numbers are."""
    if model.joint_kind != "revolute":
        message = (
            "ratio of pin offset to rolling radius; above 1 the pitch by the published method grows without bound, choose a smaller offset"
        )
        ratio, label = np.abs(model.offset) / model.link.radius, "Pin offset over rolling radius"
        yield Check("offset", ratio, 1.0, "<=", "-", message, ("chain",), label=label)  # pyright: ignore[reportArgumentType]  arrays, of many designs


def _remarks(model):
    spec, (z1, z2) = model.spec, model.teeth
    yield (
        f"the pin offset of {1e3 * model.offset:.4g} mm affects only the measures of the published method; seats, teeth, centre distance "
        "and forces depend on the rolling radius and the flank"
    )
    if z1 > z2:
        yield (
            f"the driving sprocket has more teeth ({z1}) than the driven sprocket ({z2}): the articulation angle is larger on the driven "
            "sprocket, which governs the growth of the pitch; delta12 and the pitch deviations change sign"
        )
    if z1 == z2:
        yield "the tooth numbers are equal: delta12 is 0, and an offset matched to one sprocket is matched to both"
    base = spec.pitch * np.cos(spec.plate.flank_angle)
    ours = model.cutter.pitch * np.cos(model.cutter.half_angle)
    if abs(ours / base - 1) > 1e-9:
        yield (
            f"the base pitch of the cutter, {1e3 * ours:.6g} mm, differs from that of the chain, {1e3 * base:.6g} mm: the teeth have a "
            "different involute from those of a matching cutter"
        )
    if spec.meshing.apothem_reference == "pin":
        error = model.offset * np.sin(spec.plate.flank_angle)
        yield f'apothem_reference = "pin": each flank of the teeth is cut {1e6 * error:.4g} µm off the flanks of the plates'
