"""The mechanism at rest: equilibrium, torques that hold it, small oscillations about it."""

import numpy as np

from drivewright.mechanisms.linkage.build import TURN
from drivewright.multibody.linearise import linearise, modes
from drivewright.multibody.observe import FIELDS, observe
from drivewright.multibody.statics import balance, equilibrium
from drivewright.result import Answer, Array, Value


def rest(model, done):
    """Where the mechanism rests with its drives held at their start, what holds them, and its natural frequencies there."""
    assembly = model.assembly
    found = equilibrium(assembly)
    seen = observe(assembly.system, [0.0], found.state[None])
    values = {
        "rest.stable": Value(float(found.stable), "-", "1 where the equilibrium is stable"),
        "rest.residual": Value(float(found.residual), "-", "force left over, as a part of the forces at work"),
    }
    for number, name in enumerate(assembly.names):
        if name in model.spec.bodies:
            values[f"rest.{name}.angle"] = Value(float(seen.bodies[0, number, FIELDS.index("angle")]), "rad", f"angle of {name!r} at rest")
    for drive, load in zip(assembly.model.drives, balance(assembly) if assembly.model.drives else (), strict=True):
        values[f"rest.{drive.joint}.torque"] = Value(float(load), "N m", f"torque of the drive at joint {drive.joint!r} that holds it")
    if assembly.freedom == 0:
        return Answer(values, findings=("natural frequencies do not exist: the drives leave the mechanism no freedom",))
    small = linearise(assembly, found.state)
    shapes = modes(small)
    for number, (frequency, ratio) in enumerate(zip(shapes.frequencies, shapes.ratios, strict=True), 1):
        values[f"modes.{number}.frequency"] = Value(float(frequency), "Hz", f"natural frequency of mode {number}")
        values[f"modes.{number}.damping_ratio"] = Value(float(ratio), "-", "damping over critical damping; below 0 it grows")
    labels = ([f"mode {k}" for k in range(1, len(shapes.frequencies) + 1)], list(small.names))
    size = np.abs(shapes.coordinates) * np.where(np.cos(np.angle(shapes.coordinates)) < 0, -1.0, 1.0)
    return Answer(values, arrays={"mode_shapes": Array("-", ("mode", "coordinate"), labels, size)})


# ------------------------------------------------------------------------------------------------------------------------ oil


def no_oil(spec):
    return None if any(joint.pin == "lubricated" for joint in spec.joints) else "no joint is lubricated"


def oil(model, done):
    """How far the closed form of each film is from Reynolds' equation for the bearing's real length."""
    from drivewright.contact import closed_form_map, film_deviation, film_map, long_bearing, short_bearing

    values, findings = {}, []
    eccentricities, directions = np.array([0.2, 0.5, 0.8]), np.linspace(0.0, 0.5 * TURN, 7)[:-1]
    for joint in model.spec.joints:
        if joint.pin == "lubricated":
            slenderness = joint.length / (2 * joint.bearing_radius)
            form = long_bearing if joint.film == "long" else short_bearing
            solved = film_map(slenderness, eccentricities, directions)
            off = film_deviation(closed_form_map(form, slenderness, eccentricities, directions), solved)
            values[f"joints.{joint.name}.film_error"] = Value(
                float(np.median(off)), "-", f"median deviation of the closed form, {joint.film} bearing, from Reynolds' equation"
            )
            findings.append(
                f'joint {joint.name!r}: film = "{joint.film}" is off by {np.median(off):.0%} in the median, {off.max():.0%} '
                f"at worst, from Reynolds' equation for length/diameter = {slenderness:.3g}"
            )
    return Answer(values, findings=tuple(findings))
