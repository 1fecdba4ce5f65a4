"""Plates and sprockets as bodies: measures, walls, teeth, and whether plates meet anything but their seats."""

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
    "plate": "Keys: joint.rolling_radius, plate.apothem (or standard_apothem), back, toe, crotch.",
    "sprockets": "Keys: teeth, plate.apothem, cutter.tip_depth, root_depth, tip_rounding, chamfer.",
    "meeting": "",
}


def geometry(model: ChainModel, done: Answers) -> Answer:
    """Measures of plate and teeth, walls, least gaps of the plates; a body that cannot be is a failed check."""
    values, checks = {}, []
    findings = (f"walls and gaps of the plates are left out: {model.plate_refusal}",) if model.link.skew else ()
    for part, measured in (("plate", _plate), ("sprockets", _sprockets), ("meeting", _meeting)):
        try:
            part_values, part_checks = measured(model)
        except InputError as impossible:
            checks.append(Check(f"geometry.{part}", 0.0, 1.0, ">=", "-", f"{impossible} {KEYS[part]}", ("chain",), geometry=True))
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
        "plate.area": Value(plate.moments.area, "m^2", "of a plate, holes taken out"),
        "plate.mass_per_pitch": Value(
            mass_per_pitch(plate, model.spec.plate.lacing, density, model.row_width),
            "kg",
            "plates and pins of a pitch, from their outlines",
        ),
        **{
            f"plate.wall.{name.replace(' ', '_')}": Value(width, "m", f"least wall of the plate, {name}")
            for name, width in plate.walls().items()
        },
    }
    checks = [
        Check(f"wall.{name.rpartition('.')[2]}", values[name].value, limits.wall, ">=", "m", values[name].meaning, ("chain",), True)
        for name in values
        if name.startswith("plate.wall.")
    ]
    if np.isfinite(forward):
        values["plate.turn.forward"] = Value(forward, "rad", "angle that a joint can turn around a sprocket")
        values["plate.turn.backward"] = Value(-back, "rad", "angle that a joint can bend back")
        message = "angle that a joint can turn against that of the smaller sprocket"
        checks.append(Check("joint.turn", forward, 2 * np.pi / min(model.teeth), ">=", "rad", message, ("chain",), True))
    return values, checks


def _sprockets(model):
    values, checks = {}, []
    for side, sprocket in zip(SIDES, model.sprockets, strict=True):
        words = f"of the teeth of the {SIDE_WORDS[side]}"
        values |= _radii(side, sprocket, words)
        message = f"width at the tip {words}"
        checks.append(
            Check(f"tip_thickness.{side}", sprocket.tip_thickness, model.spec.limits.tip_thickness, ">=", "m", message, (side,), True)
        )
        if not (model.spec.roller or model.link.skew):
            values |= _flank_values(model, side, sprocket, words)
            checks += _flank_checks(model, side, sprocket, words)
    return values, [*checks, *bores(model)]


def bores(model: ChainModel) -> Iterator[Check]:
    """The holes against the roots of the teeth."""
    for side, sprocket in zip(SIDES, model.sprockets, strict=True):
        message = f"radius of the hole of the {SIDE_WORDS[side]} against the roots of its teeth"
        yield Check(f"bore.{side}", 0.5 * model.bore, sprocket.root_radius, "<=", "m", message, (side,), True)


def _radii(side, sprocket, words):
    return {
        f"tip_radius.{side}": Value(sprocket.tip_radius, "m", f"tips {words}"),
        f"root_radius.{side}": Value(sprocket.root_radius, "m", f"roots {words}"),
        f"tip_thickness.{side}": Value(sprocket.tip_thickness, "m", f"width at the tip {words}"),
    }


def _flank_values(model, side, sprocket, words):
    """Involute, measuring pins and seating speeds of the teeth that plates sit on."""
    values = {
        f"form_radius.{side}": Value(sprocket.form_radius, "m", f"where the involute begins, {words}"),
        f"tooth_thickness.{side}": Value(sprocket.thickness(sprocket.tooth.contact_radius), "m", f"along the circle of contact, {words}"),
    }
    pin = model.spec.cutter.measuring_pin or sprocket.best_pin
    with suppress(InputError):  # a pin that touches no flank measures nothing
        over = sprocket.over_pins(pin)
        values[f"measuring_pin.{side}"] = Value(pin, "m", f"diameter of the measuring pins, {SIDE_WORDS[side]}")
        values[f"over_pins.{side}"] = Value(over, "m", f"distance over two measuring pins, {SIDE_WORDS[side]}")
    approach, sliding = seating_speeds(model.plate, sprocket.tooth, "right")
    values[f"seating.approach.{side}"] = Value(approach, "m/rad", f"of a flank to its tooth per angle of the joint, {SIDE_WORDS[side]}")
    values[f"seating.sliding.{side}"] = Value(sliding, "m/rad", f"of a flank along its tooth per angle of the joint, {SIDE_WORDS[side]}")
    return values


def _flank_checks(model, side, sprocket, words):
    """Seated plates touch on the flanks of teeth and plate, and the hob leaves these whole."""
    (above_form, below_tip), on_flank = sprocket.contact_margins, model.plate.flank_margin(sprocket.tooth)
    margins = (
        ("contact.above_form", above_form, f"contact of a seated plate above the form radius {words}"),
        ("contact.below_tip", below_tip, f"contact of a seated plate below the tips {words}"),
        ("contact.on_flank", on_flank, f"contact of a plate seated on the {SIDE_WORDS[side]} within its flank"),
    )
    for name, margin, message in margins:
        yield Check(f"{name}.{side}", margin, 0.0, ">=", "m", message, (side,), True)
    message = f"whether the hob's tip undercuts the flanks {words}: 1 where it does, else 0"
    label = f"Undercut of the {SIDE_WORDS[side]}"
    yield Check(f"undercut.{side}", float(sprocket.undercut), 0.0, "<=", "-", message, (side,), True, label=label)


def _meeting(model):
    """Least gap of all plates near each sprocket over a tooth of the driver."""
    if model.spec.roller or model.spec.sprockets or model.link.skew:
        return {}, ()
    gaps, within = min_drive_gaps(model.closure, model.plate, model.sprockets), TOLERANCE * model.spec.pitch
    values, checks = {}, []
    for side, least in zip(SIDES, gaps, strict=True):
        meaning = f"of a plate, seated or coming in, to the teeth of the {SIDE_WORDS[side]}"
        label = f"Least gap to the {SIDE_WORDS[side]}"
        gap = Value(least, "m", meaning, least - within, least + within, "outlines", label=label)
        values[f"least_gap.{side}"] = gap
        message = f"of a plate, seated or coming in, with the teeth of the {SIDE_WORDS[side]}"
        overlap = gap._replace(value=-least, low=-least - within, high=-least + within)
        label = f"Overlap with the {SIDE_WORDS[side]}"
        check = Check.of(overlap, f"overlap.{side}", model.spec.limits.overlap, "<=", message, (side,), label)
        checks.append(check._replace(geometry=True))
    return values, checks
