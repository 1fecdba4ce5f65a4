"""Pins on each other under the force of a strand: pressure, shear below the surface, shakedown, bending; and the strand's forces."""

from drivewright.chains.standards import articulation_pressure, tensile_safety
from drivewright.chains.stress import pins, rolling
from drivewright.errors import InputError
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.taut import slack_pull, slack_warnings, taut_checks
from drivewright.result import Answer, Answers, Check, Value


def contact(model: ChainModel, done: Answers) -> Answer:
    """Forces of the strands and what they do to the pins."""
    force, given = model.pin_force, model.spec.plate
    rough = model.plate_refusal and not model.spec.roller and not (given.link_mass and given.link_inertia)
    findings = [f"the mass of a link is estimated from the pitch: {model.plate_refusal}"] if rough else []
    values, checks = {**_strands(model), "pin.force": Value(force, "N", "of the strand, on the pins of a joint")}, []
    strength, strong = _strength(model)
    values |= strength
    checks += strong
    pressure_values, pressure_checks = (_rolling if model.link.radius else _hinge)(model, model.row_force)
    values |= pressure_values
    checks += pressure_checks
    try:
        bent, safe = _bending(model, model.row_force)
    except InputError as reason:
        findings.append(f"bending of the pins is left out: {reason}")
    else:
        values |= bent
        checks.append(safe)
    checks += taut_checks(model, done)
    return Answer(values, (), tuple(checks), tuple(findings), warnings=tuple(slack_warnings(model)))


def _strands(model):
    if not model.spec.drive:
        return {}
    forces = model.strands
    return {
        "chain.speed": Value(forces.speed, "m/s", "mean speed of the chain"),
        "strand.centrifugal_force": Value(forces.centrifugal, "N", "mass per length times speed squared"),
        "strand.tight_force": Value(forces.tight, "N", "that the tight strand pulls with, without the centrifugal force"),
        "strand.slack_force": Value(forces.slack, "N", "that the slack strand pulls with, without the centrifugal force"),
    }


def _strength(model):
    """The breaking load, where it is known, over the forces of the strands, the centrifugal one included."""
    load, drive = model.spec.breaking_load, model.spec.drive
    if load is None:
        return {}, ()
    safety = tensile_safety(load, model.strands.tension if drive else model.pin_force)
    values = {
        "chain.breaking_load": Value(load, "N", "minimum tensile strength of the chain, all rows together"),
        "chain.static_safety": Value(
            safety, "-", "static safety factor: breaking load over the force of the tight strand, the centrifugal one included"
        ),
    }
    if drive and slack_pull(model) >= 0:
        mean = 0.5 * (model.strands.tight + model.strands.slack) + model.strands.centrifugal
        meaning = "mean static safety: breaking load over the mean of tight and slack strand, the centrifugal force included"
        values["chain.mean_static_safety"] = Value(tensile_safety(load, mean), "-", meaning)
    message = "static safety factor: breaking load over the force of the tight strand; makers ask for 6 or more against fatigue"
    return values, (Check("chain.static_safety", safety, model.spec.limits.static_safety, ">=", "-", message, ("chain",)),)


def _rolling(model, force):
    material = model.spec.material
    line = rolling.rolling_contact(force, model.contact_length, model.link.radii, material.youngs_modulus, material.poisson_ratio)
    limits = rolling.pressure_limits(material.yield_strength, material.poisson_ratio)
    safety, least = float(limits.shakedown / line.pressure), model.spec.limits.shakedown_safety
    message = "shakedown limit of the rolling pins over their contact pressure; a larger rolling radius lowers the pressure"
    return {
        "joint.effective_radius": Value(model.link.effective_radius, "m", "effective radius of the rolling surfaces"),
        "pin.contact_pressure": Value(float(line.pressure), "Pa", "greatest pressure of the pins on each other, Hertz"),
        "pin.half_width": Value(float(line.half_width), "m", "half the width of their contact"),
        "pin.max_shear": Value(float(line.shear), "Pa", "greatest shear stress below their surface"),
        "pin.shear_depth": Value(float(line.depth), "m", "where it is, below the surface"),
        "pin.first_yield": Value(limits.first_yield, "Pa", "pressure below which nothing yields, von Mises"),
        "pin.shakedown_limit": Value(limits.shakedown, "Pa", "pressure below which nothing yields again after the first passes"),
    }, (Check("pin.shakedown", safety, least, ">=", "-", message, ("chain",)),)


def _hinge(model, force):
    """Mean pressure of a plate's hole, or of the bush, on the one pin."""
    length = model.contact_length if model.spec.roller else min(model.spec.plate.lacing) * model.sheet
    pressure = articulation_pressure(force, 2 * model.pins.radius, length)
    return {
        "pin.bearing_pressure": Value(pressure, "Pa", "force over diameter and length of the pin in the bush, or in the fewer plates")
    }, ()


def _bending(model, force):
    """The pin as a beam across the pack of plates."""
    sheet, rolls, link = model.sheet, bool(model.link.radius), model.roller_link
    if model.link.skew:
        raise InputError("the sections of the pins of a joint of two radii are not given")
    model.pins.check(model.link)
    if link:
        load = pins.roller_pin_load(sheet, model.contact_length, force, link.bush_gap(model.contact_length))
    else:
        load = pins.laced_pin_load(model.spec.plate.lacing, sheet, force, rolls)
    stress = pins.bent_pin(model.pins.pin(model.link), load, rolls)
    values = {
        "pin.bending_stress": Value(stress.bending, "Pa", "of a pin across the pack of plates"),
        "pin.shear_stress": Value(stress.shear, "Pa", "of a pin across the pack of plates"),
        "pin.von_mises": Value(stress.mises, "Pa", "of bending and shear of a pin"),
    }
    safety, message = model.spec.material.yield_strength / stress.mises, "yield strength over von Mises stress of a pin's bending"
    return values, Check("pin.yield", safety, model.spec.limits.yield_safety, ">=", "-", message, ("chain",))
