"""The running chain: centre distance, forces, orders and balances, over whole teeth after it has settled."""

import numpy as np

from drivewright.chains.dynamics.simulate import Settings, simulate, tooth_time
from drivewright.chains.dynamics.stability import largest_step, refuse_step
from drivewright.chains.implicit import simulate as implicit
from drivewright.errors import InputError, SpecError
from drivewright.mechanisms.silent_chain.moving import moving
from drivewright.result import Answer, Check, Column, Table, Value

IMPLICIT_STEP = 1e-5  # [s]
STEP, SAFE = 1e-6, 0.5  # [s], and part of the largest stable step, that an explicit run takes unless told otherwise
ORDERS = 8  # of the mesh frequency, up to which the spectrum is told
WATCHED = 0


def no_dynamics(spec):
    """Why there are none."""
    return None if spec.drive else "speed and preload are not given: write [drive]"


def dynamics(model, done):
    """The run, its statistics, spectrum and balances."""
    system = moving(model)
    motion = _run(model, system)
    sd = motion.centre_distance
    values = {
        "dynamics.centre_distance.mean": Value(motion.mean(sd), "m", "mean of the centre distance over whole teeth"),
        "dynamics.centre_distance.fluctuation": Value(motion.fluctuation(sd), "m", "greatest less least centre distance"),
        "dynamics.centre_distance.mesh_order_amplitude": Value(motion.mesh_order_amplitude, "m", "amplitude of the centre distance at the "
                                                                                                 "mesh frequency"),
        "dynamics.energy_drift": Value(motion.energy_drift, "-", "of the energy balance, over the largest kinetic energy"),
        **_more(model, motion),
    }
    drift = Check("energy_drift", values["dynamics.energy_drift"].value, model.spec.dynamics.largest_drift, "<=", "-",
                  "energy that the run lost or gained by computing, over the largest kinetic energy", ("chain",))
    findings = (f"the run has failed: {motion.advice}",) if motion.advice else ()
    return Answer(values, (_signals(motion), _spectrum(motion)), (drift,), findings, outcome=motion.outcome, data=motion)


def _run(model, system):
    """The run, by the integrator asked for."""
    said = model.spec.dynamics
    duration = said.settling + (said.duration or model.spec.links * tooth_time(system))
    if duration - said.settling < 2 * tooth_time(system):
        raise SpecError(f"{1e3 * (duration - said.settling):.4g} ms hold no two teeth of {1e3 * tooth_time(system):.4g} ms; give more",
                        "dynamics.duration")
    common = {"settle": said.settling, "tolerance": said.largest_drift, "plate": WATCHED}
    if said.integrator == "implicit":
        return implicit.simulate(system, duration, implicit.Settings(said.step or IMPLICIT_STEP, **common))
    return simulate(system, duration, Settings(explicit_step(model, system), **common))


def explicit_step(model, system):
    """Step of an explicit run [s]: as said, else a microsecond, or less where that is not safe."""
    said = model.spec.dynamics.step
    try:
        refuse_step(system, said or 0.1 * largest_step(system))
    except InputError as reason:
        raise SpecError(str(reason), "dynamics.step") from None
    return said or min(STEP, SAFE * largest_step(system))


def _more(model, motion):
    steady, driven = motion.steady, 1
    error, tension = motion.transmission_error(driven), motion.tension[:, 0]
    return {
        "dynamics.transmission_error": Value(motion.fluctuation(error), "rad", "driven angle off the ratio of teeth, greatest less least"),
        "dynamics.mesh_frequency": Value(1 / tooth_time(motion.model), "Hz", "teeth that mesh in a second"),
        "dynamics.tension.mean": Value(motion.mean(tension), "N", "tension in a joint as it goes round, mean"),
        "dynamics.tension.maximum": Value(np.max(tension[steady]), "N", "tension in a joint as it goes round, greatest"),
        "dynamics.flank_force.maximum": Value(np.max([motion.column(name)[steady] for name in ("left flank", "right flank")]), "N",
                                              "on a flank of a plate as it goes round, greatest"),
        "dynamics.friction_utilisation": Value(np.max(motion.column("utilisation")[steady]), "-",
                                               "friction that pins need to roll, over the force that presses them"),
    }


def _signals(motion):
    steady = motion.steady
    time, names = motion.t[steady], ("left x", "left y", "right x", "right y", "left flank", "right flank")
    forces = [Column(f"plate.{name.replace(' ', '_')}", "N", f"on a plate as it goes round: {name}", motion.column(name)[steady])
              for name in names]
    return Table("running", "The running chain", (
        Column("time", "s", "time", time), Column("centre_distance", "m", "centre distance", motion.centre_distance[steady]),
        Column("transmission_error", "rad", "driven angle off the ratio of teeth", motion.transmission_error(1)[steady]),
        Column("tension", "N", "tension in a joint as it goes round", motion.tension[steady, 0]),
        Column("contacts", "-", "flanks that touch", motion.column("contacts")[steady]), *forces,
        Column("energy_gap", "J", "energy less all work since the start", motion.energy_gap[steady])))


def _spectrum(motion):
    orders, amplitude = motion.spectrum(motion.centre_distance)
    low = orders <= ORDERS
    return Table("spectrum", "Spectrum of the centre distance", (
        Column("order", "-", "multiple of the mesh frequency", orders[low]),
        Column("frequency", "Hz", "frequency", orders[low] / tooth_time(motion.model)),
        Column("centre_distance", "m", "amplitude of the centre distance", amplitude[low])))
