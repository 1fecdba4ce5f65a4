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
    findings = (
        [f"the mass of a link is estimated from the pitch, because the plate cannot be drawn: {model.plate_refusal}"] if rough else []
    )
    values, checks = (
        {**_strands(model), "pin.force": Value(force, "N", "force of the strand on the pins of a joint", label="Pin force of a joint")},
        [],
    )
    strength, strong = _strength(model)
    values |= strength
    checks += strong
    pressure_values, pressure_checks = (_rolling if model.link.radius else _hinge)(model, model.row_force)
    values |= pressure_values
    checks += pressure_checks
    try:
        bent, safe = _bending(model, model.row_force)
    except InputError as reason:
        findings.append(f"the bending of the pins is left out: {reason}")
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
        "chain.speed": Value(forces.speed, "m/s", "mean speed of the chain", label="Chain speed"),
        "strand.centrifugal_force": Value(
            forces.centrifugal, "N", "centrifugal tension of the chain: mass per length times speed squared", label="Centrifugal tension"
        ),
        "strand.tight_force": Value(
            forces.tight, "N", "tension of the tight strand, without the centrifugal tension", label="Tight strand tension"
        ),
        "strand.slack_force": Value(
            forces.slack, "N", "tension of the slack strand, without the centrifugal tension", label="Slack strand tension"
        ),
    }


def _strength(model):
    """The breaking load, where it is known, over the tensions of the strands, the centrifugal one included."""
    load, drive = model.spec.breaking_load, model.spec.drive
    if load is None:
        return {}, ()
    safety = tensile_safety(load, model.strands.tension if drive else model.pin_force)
    values = {
        "chain.breaking_load": Value(load, "N", "minimum tensile strength of the chain, all rows together", label="Breaking load"),
        "chain.static_safety": Value(
            safety, "-", "static safety factor: breaking load over the tension of the tight strand, centrifugal tension included"
        ),
    }
    if drive and slack_pull(model) >= 0:
        mean = 0.5 * (model.strands.tight + model.strands.slack) + model.strands.centrifugal
        meaning = "breaking load over the mean tension of tight and slack strand, centrifugal tension included"
        label = "Static safety factor, mean tension"
        values["chain.mean_static_safety"] = Value(tensile_safety(load, mean), "-", meaning, label=label)
    message = (
        "breaking load over the tension of the tight strand; makers require 6 or more against fatigue: take a larger chain or more rows"
    )
    required, label = model.spec.limits.static_safety, "Static safety factor"
    return values, (Check("chain.static_safety", safety, required, ">=", "-", message, ("chain",), label=label),)


def _rolling(model, force):
    material = model.spec.material
    line = rolling.rolling_contact(force, model.contact_length, model.link.radii, material.youngs_modulus, material.poisson_ratio)
    limits = rolling.pressure_limits(material.yield_strength, material.poisson_ratio)
    safety, least = float(limits.shakedown / line.pressure), model.spec.limits.shakedown_safety
    message = "shakedown limit of the pins over their Hertz pressure; a larger rolling radius lowers the pressure"
    return {
        "joint.effective_radius": Value(
            model.link.effective_radius, "m", "effective radius of the two rolling surfaces", label="Effective rolling radius"
        ),
        "pin.contact_pressure": Value(
            float(line.pressure),
            "Pa",
            "maximum Hertz pressure between the pins of a joint",
            label="Maximum Hertz pressure between the pins",
        ),
        "pin.half_width": Value(
            float(line.half_width), "m", "half the width of the line contact of the pins", label="Half-width of the pin contact"
        ),
        "pin.max_shear": Value(
            float(line.shear), "Pa", "maximum shear stress below the surface of the pins", label="Maximum subsurface shear stress"
        ),
        "pin.shear_depth": Value(
            float(line.depth), "m", "depth of the maximum shear stress below the surface", label="Depth of maximum shear stress"
        ),
        "pin.first_yield": Value(
            limits.first_yield, "Pa", "Hertz pressure at which the pins first yield, by von Mises", label="Pressure at first yield"
        ),
        "pin.shakedown_limit": Value(
            limits.shakedown,
            "Pa",
            "largest Hertz pressure at which yielding ceases after the first load passes (elastic shakedown)",
            label="Shakedown limit",
        ),
    }, (Check("pin.shakedown", safety, least, ">=", "-", message, ("chain",), label="Shakedown safety of the pins"),)


def _hinge(model, force):
    """Mean pressure of a plate's hole, or of the bush, on the one pin."""
    length = model.contact_length if model.spec.roller else min(model.spec.plate.lacing) * model.sheet
    pressure = articulation_pressure(force, 2 * model.pins.radius, length)
    return {
        "pin.bearing_pressure": Value(
            pressure,
            "Pa",
            "bearing pressure of a joint: force over diameter and length of the pin in its bush, or in the plates of the narrower link",
            label="Bearing pressure of the joint",
        )
    }, ()


def _bending(model, force):
    """The pin as a beam across the pack of plates."""
    sheet, rolls, link = model.sheet, bool(model.link.radius), model.roller_link
    if model.link.skew:
        raise InputError("the cross-sections of the pins are not defined for a joint of two radii")
    model.pins.check(model.link)
    if link:
        load = pins.roller_pin_load(sheet, model.contact_length, force, link.bush_gap(model.contact_length))
    else:
        load = pins.laced_pin_load(model.spec.plate.lacing, sheet, force, rolls)
    stress = pins.bent_pin(model.pins.pin(model.link), load, rolls)
    values = {
        "pin.bending_stress": Value(
            stress.bending, "Pa", "bending stress of a pin across the plate pack", label="Bending stress of the pin"
        ),
        "pin.shear_stress": Value(stress.shear, "Pa", "shear stress of a pin across the plate pack", label="Shear stress of the pin"),
        "pin.von_mises": Value(stress.mises, "Pa", "von Mises stress of a pin by bending and shear", label="Von Mises stress of the pin"),
    }
    safety = model.spec.material.yield_strength / stress.mises
    message = "yield strength over the von Mises stress of a pin by bending and shear; thicker pins or a narrower plate pack increase it"
    required, label = model.spec.limits.yield_safety, "Yield safety of the pin"
    return values, Check("pin.yield", safety, required, ">=", "-", message, ("chain",), label=label)
