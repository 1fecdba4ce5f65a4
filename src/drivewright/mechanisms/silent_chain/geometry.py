"""Plates and sprockets as bodies: measures, walls, teeth, and interference of plates outside their seats."""

from collections.abc import Iterator
from contextlib import suppress

import numpy as np

from drivewright.chains.interference import TOLERANCE, min_drive_gaps, seating_speeds
from drivewright.chains.plate import mass_per_pitch
from drivewright.errors import InputError
from drivewright.mechanisms.silent_chain.build import SIDES, ChainModel
from drivewright.mechanisms.silent_chain.meshing import SIDE_WORDS
from drivewright.result import Answer, Answers, Check, Value

KEYS = {  # that decide on a body
    "plate": "Change joint.rolling_radius, plate.apothem (or standard_apothem), plate.back, plate.toe or plate.crotch.",
    "sprockets": "Change teeth, plate.apothem, cutter.tip_depth, cutter.root_depth, cutter.tip_rounding or cutter.chamfer.",
    "meeting": "",
}
PARTS = {"plate": "plate", "sprockets": "sprockets", "meeting": "plates and teeth"}  # in words


def geometry(model: ChainModel, done: Answers) -> Answer:
    """Measures of plate and teeth, walls, least gaps of the plates; a body that cannot be is a failed check."""
    values, checks = {}, []
    findings = (f"the walls and gaps of the plates are left out: {model.plate_refusal}",) if model.link.skew else ()
    for part, measured in (("plate", _plate), ("sprockets", _sprockets), ("meeting", _meeting)):
        try:
            part_values, part_checks = measured(model)
        except InputError as impossible:
            message, label = f"{impossible} {KEYS[part]}".strip(), f"Valid geometry, {PARTS[part]}"
            checks.append(Check(f"geometry.{part}", 0.0, 1.0, ">=", "-", message, ("chain",), geometry=True, label=label))
            break
        values |= part_values
        checks += part_checks
    return Answer(values, (), tuple(checks), findings)


def _plate(model):
    if model.spec.roller or model.link.skew:
        return {}, ()
    plate, limits, density = model.plate, model.spec.limits, model.spec.material.density
    back, forward = plate.pins.limits(model.link)
    values = {
        "plate.area": Value(plate.moments.area, "m^2", "area of a plate without its holes", label="Plate area"),
        "plate.mass_per_pitch": Value(
            mass_per_pitch(plate, model.spec.plate.lacing, density, model.row_width),
            "kg",
            "mean mass of the plates and pins of one pitch, from their outlines",
            label="Chain mass per pitch",
        ),
        **{
            f"plate.wall.{name.replace(' ', '_')}": Value(
                width, "m", f"minimum wall thickness of the plate, {name}", label=f"Minimum wall, {name}"
            )
            for name, width in plate.walls().items()
        },
    }
    checks = [
        Check(
            f"wall.{name.rpartition('.')[2]}",
            value.value,
            limits.wall,
            ">=",
            "m",
            f"{value.meaning}; a smaller rolling radius or a larger plate makes it thicker",
            ("chain",),
            True,
            label=value.label,
        )
        for name, value in values.items()
        if name.startswith("plate.wall.")
    ]
    if np.isfinite(forward):
        values["plate.turn.forward"] = Value(
            forward, "rad", "largest articulation angle of a joint in the sense of the wrap", label="Articulation angle, forward"
        )
        values["plate.turn.backward"] = Value(
            -back, "rad", "largest articulation angle of a joint against the sense of the wrap", label="Articulation angle, backward"
        )
        message = (
            "largest articulation angle of a joint; at least the angle between two plates on the smaller sprocket: take a smaller rolling "
            "radius, or more teeth"
        )
        required, label = 2 * np.pi / min(model.teeth), "Articulation angle of a joint"
        checks.append(Check("joint.turn", forward, required, ">=", "rad", message, ("chain",), True, label=label))
    return values, checks


def _sprockets(model):
    values, checks = {}, []
    for side, sprocket in zip(SIDES, model.sprockets, strict=True):
        words = SIDE_WORDS[side]
        values |= _radii(side, sprocket, words)
        message, label = (
            f"tip thickness of the teeth of the {words}; a lower tip or a smaller chamfer increases it",
            f"Tip thickness, {words}",
        )
        least = model.spec.limits.tip_thickness
        checks.append(Check(f"tip_thickness.{side}", sprocket.tip_thickness, least, ">=", "m", message, (side,), True, label=label))
        if not (model.spec.roller or model.link.skew):
            values |= _flank_values(model, side, sprocket, words)
            checks += _flank_checks(model, side, sprocket, words)
    return values, [*checks, *bores(model)]


def bores(model: ChainModel) -> Iterator[Check]:
    """The holes against the roots of the teeth."""
    for side, sprocket in zip(SIDES, model.sprockets, strict=True):
        words = SIDE_WORDS[side]
        message, label = f"bore radius of the {words}; at most the root radius of its teeth, choose a smaller cutter.bore", f"Bore, {words}"
        yield Check(f"bore.{side}", 0.5 * model.bore, sprocket.root_radius, "<=", "m", message, (side,), True, label=label)


def _radii(side, sprocket, words):
    return {
        f"tip_radius.{side}": Value(sprocket.tip_radius, "m", f"tip radius of the {words}", label=f"Tip radius, {words}"),
        f"root_radius.{side}": Value(sprocket.root_radius, "m", f"root radius of the {words}", label=f"Root radius, {words}"),
        f"tip_thickness.{side}": Value(
            sprocket.tip_thickness, "m", f"thickness of the teeth of the {words} at their tips", label=f"Tip thickness, {words}"
        ),
    }


def _flank_values(model, side, sprocket, words):
    """Involute, measuring pins and seating speeds of the teeth that plates sit on."""
    values = {
        f"form_radius.{side}": Value(
            sprocket.form_radius, "m", f"radius at which the involute of the {words} begins", label=f"Form radius, {words}"
        ),
        f"tooth_thickness.{side}": Value(
            sprocket.thickness(sprocket.tooth.contact_radius),
            "m",
            f"thickness of the teeth of the {words} along the circle on which seated plates touch them",
            label=f"Tooth thickness, {words}",
        ),
    }
    pin = model.spec.cutter.measuring_pin or sprocket.best_pin
    with suppress(InputError):  # a pin that touches no flank measures nothing
        over = sprocket.over_pins(pin)
        values[f"measuring_pin.{side}"] = Value(
            pin, "m", f"diameter of the measuring pins for the {words}", label=f"Measuring pin diameter, {words}"
        )
        values[f"over_pins.{side}"] = Value(
            over, "m", f"measurement over two pins in opposite tooth gaps of the {words}", label=f"Measurement over pins, {words}"
        )
    approach, sliding = seating_speeds(model.plate, sprocket.tooth, "right")
    meaning = f"approach of a plate's flank to its tooth on the {words} per articulation angle, when the plate is seated"
    values[f"seating.approach.{side}"] = Value(approach, "m/rad", meaning, label=f"Approach at seating, {words}")
    meaning = f"sliding of a plate's flank along its tooth on the {words} per articulation angle, when the plate is seated"
    values[f"seating.sliding.{side}"] = Value(sliding, "m/rad", meaning, label=f"Sliding at seating, {words}")
    return values


def _flank_checks(model, side, sprocket, words):
    """Seated plates touch on the flanks of teeth and plate, and the hob leaves these whole."""
    (above_form, below_tip), on_flank = sprocket.contact_margins, model.plate.flank_margin(sprocket.tooth)
    margins = (
        (
            "contact.above_form",
            above_form,
            f"distance of a seated plate's contact point outside the form circle of the {words}; a deeper root lowers the form circle",
            f"Contact above form, {words}",
        ),
        (
            "contact.below_tip",
            below_tip,
            f"distance of a seated plate's contact point inside the tip of the teeth of the {words}; a higher tip increases it",
            f"Contact below tip, {words}",
        ),
        (
            "contact.on_flank",
            on_flank,
            f"distance of the contact point from the ends of the flank of a plate seated on the {words}; move plate.toe or plate.crotch",
            f"Contact on plate flank, {words}",
        ),
    )
    for name, margin, message, label in margins:
        yield Check(f"{name}.{side}", margin, 0.0, ">=", "m", message, (side,), True, label=label)
    message = f"1 where the tip of the hob undercuts the flanks of the teeth of the {words}, else 0; more teeth or a higher root avoid it"
    label = f"Undercut of the {words}"
    yield Check(f"undercut.{side}", float(sprocket.undercut), 0.0, "<=", "-", message, (side,), True, label=label)


def _meeting(model):
    """Least gap of all plates near each sprocket over a tooth of the driver."""
    if model.spec.roller or model.spec.sprockets or model.link.skew:
        return {}, ()
    gaps, within = min_drive_gaps(model.closure, model.plate, model.sprockets), TOLERANCE * model.spec.pitch
    values, checks = {}, []
    for side, least in zip(SIDES, gaps, strict=True):
        words = SIDE_WORDS[side]
        meaning = f"minimum gap between a plate, seated or engaging, and the teeth of the {words}"
        label = f"Minimum gap, {words}"
        gap = Value(least, "m", meaning, least - within, least + within, "outlines", label=label)
        values[f"least_gap.{side}"] = gap
        message = (
            f"overlap of a plate, seated or engaging, with the teeth of the {words}; a larger chamfer, a lower tip or shorter toes "
            "reduce it"
        )
        overlap = gap._replace(value=-least, low=-least - within, high=-least + within)
        label = f"Overlap with the {words}"
        check = Check.of(overlap, f"overlap.{side}", model.spec.limits.overlap, "<=", message, (side,), label)
        checks.append(check._replace(geometry=True))
    return values, checks
