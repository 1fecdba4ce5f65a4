"""The mechanism at rest: equilibrium, torques that hold it, small oscillations about it."""

import numpy as np

from drivewright.errors import SolverError
from drivewright.labels import in_words
from drivewright.multibody.analyses.simulation_model import SimulationModel
from drivewright.multibody.linearise import linearise, modes
from drivewright.multibody.observe import FIELDS, observe
from drivewright.multibody.statics import balance, equilibrium
from drivewright.multibody.system import joints_with_friction
from drivewright.result import Answer, Array, Value


def rest(model: SimulationModel) -> Answer:
    """Where the mechanism rests with its drives held at their start, what holds them, and its natural frequencies there."""
    assembly = model.assembly
    rubs = len(joints_with_friction(assembly.system)) > 0
    rubbing = ("friction in ideal joints is left out of the equilibrium at rest and of the modes",) if rubs else ()
    try:
        at_rest = equilibrium(assembly)
    except SolverError as error:
        raise SolverError(f"{error}{f' ({rubbing[0]})' if rubbing else ''}") from None
    observed = observe(assembly.system, [0.0], at_rest.state[None])
    values = {
        "rest.stable": Value(float(at_rest.stable), "-", "stability of the equilibrium", convention="1: stable, 0: unstable"),
        "rest.residual": Value(
            float(at_rest.residual), "-", "residual force at equilibrium, relative to the acting forces", label="residual force at rest"
        ),
    }
    for number, name in enumerate(assembly.names):
        if name in model.bodies:
            values[f"rest.{name}.angle"] = Value(
                float(observed.bodies[0, number, FIELDS.index("angle")]), "rad", f"angle of {in_words(name)} at rest"
            )
    for drive, load in zip(assembly.model.drives, balance(assembly) if assembly.model.drives else (), strict=True):
        joint = f"joint {in_words(drive.joint)}"
        meaning = f"torque of the drive at {joint} that holds the mechanism at rest"
        values[f"rest.{drive.joint}.torque"] = Value(float(load), "N m", meaning, label=f"holding torque at {joint}")
    if assembly.freedom == 0:
        findings = ("natural frequencies do not exist: with its drives the mechanism has no degree of freedom", *rubbing)
        return Answer(values, findings=findings)
    small = linearise(assembly, at_rest.state)
    shapes = modes(small)
    for number, (frequency, ratio) in enumerate(zip(shapes.frequencies, shapes.ratios, strict=True), 1):
        values[f"modes.{number}.frequency"] = Value(float(frequency), "Hz", f"natural frequency of mode {number}")
        values[f"modes.{number}.damping_ratio"] = Value(
            float(ratio), "-", f"damping ratio of mode {number}", convention="below 0: the oscillation grows"
        )
    labels = ([f"mode {k}" for k in range(1, len(shapes.frequencies) + 1)], list(small.names))
    size = np.abs(shapes.coordinates) * np.where(np.cos(np.angle(shapes.coordinates)) < 0, -1.0, 1.0)
    return Answer(values, arrays={"mode_shapes": Array("-", ("mode", "coordinate"), labels, size)}, findings=rubbing)
