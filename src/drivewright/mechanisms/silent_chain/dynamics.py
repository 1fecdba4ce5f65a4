"""The running chain: centre distance, forces, orders and balances, over whole teeth after it has settled."""

import numpy as np

from drivewright.chains.dynamics.simulate import Settings, simulate, tooth_time
from drivewright.chains.dynamics.stability import largest_step, refuse_step
from drivewright.chains.implicit import simulate as implicit
from drivewright.errors import InputError, SolverError, SpecError
from drivewright.mechanisms.silent_chain.moving import moving
from drivewright.result import Answer, Check, Column, Table, Value

IMPLICIT_STEP = 1e-5  # [s]
STEP, SAFE = 1e-6, 0.5  # [s], and part of the largest stable step, that an explicit run takes unless told otherwise
OFF = 0.25  # of the pitch: a mean centre distance so far from the rigid one is that of a chain off its teeth
UNSETTLED = 0.25  # of the fluctuation, between the means of two halves of a run
SLIPPING = 0.3  # coefficient of friction that lubricated pins do not reach
HINT = ("where a shorter step does not help: a slack strand (check strand.taut), a speed, wear or teeth that throw the chain off, or a "
        "tensioner that hits it; see also the analysis 'quasi_static'")
ORDERS = 8  # of the mesh frequency, up to which the spectrum is told
WATCHED = 0


def no_dynamics(spec):
    """Why there are none."""
    return None if spec.drive else "speed and preload are not given: write [drive]"


def dynamics(model, done):
    """The run, its statistics, spectrum and balances; of a run that failed the balance and the signals alone."""
    motion = _run(model, moving(model))
    if not np.all(np.isfinite(motion.rows)):
        raise SolverError(f"{motion.advice}; {HINT}")
    drift = Value(motion.energy_drift, "-", "of the energy balance, over the largest kinetic energy")
    checks = (
        Check(
            "energy_drift",
            motion.energy_drift,
            model.spec.dynamics.largest_drift,
            "<=",
            "-",
            "energy that the run lost or gained by computing, over the largest kinetic energy",
            ("chain",),
        ),
        *_seated(model, motion),
    )
    tables = (_signals(motion), _spectrum(motion))
    reason = motion.advice or next((check.message for check in checks if not check.ok), "")
    if reason:
        findings = (f"the run has failed, its statistics are left out: {reason}; {HINT}",)
        return Answer({"dynamics.energy_drift": drift}, tables, checks, findings, outcome="partial")
    values = {**_distances(motion), "dynamics.energy_drift": drift, **_more(model, motion)}
    return Answer(values, tables, checks, tuple(_remarks(model, motion, values)), data=motion)


def _distances(motion):
    sd = motion.centre_distance
    return {
        "dynamics.centre_distance.mean": Value(motion.mean(sd), "m", "mean of the centre distance over whole teeth"),
        "dynamics.centre_distance.fluctuation": Value(motion.fluctuation(sd), "m", "greatest less least centre distance"),
        "dynamics.centre_distance.mesh_order_amplitude": Value(motion.mesh_order_amplitude, "m",
                                                               "amplitude of the centre distance at the mesh frequency"),
    }


def _seated(model, motion):
    """Whether the chain is still on its teeth."""
    touching = motion.mean(motion.column("contacts"))
    yield Check("running.contacts", touching, float(len(motion.model.sprockets)), ">=", "-",
                "flanks that touch, on average, against one on every sprocket: with fewer the chain has left its teeth", ("chain",))
    if motion.model.sprockets[motion.slide].slide and len(motion.model.sprockets) == 2:
        off = abs(motion.mean(motion.centre_distance) - model.closure.mean)
        yield Check("running.centre_distance", off, OFF * model.spec.pitch, "<=", "m",
                    "mean centre distance of the run off the rigid one: so far off, the chain has left its teeth", ("chain",))


def _remarks(model, motion, values):
    """What keeps the numbers from being the whole truth."""
    steady, sd = motion.steady, motion.centre_distance
    half = (steady.start + steady.stop) // 2
    first, last = np.mean(sd[steady.start:half]), np.mean(sd[half:steady.stop])
    spread = values["dynamics.centre_distance.fluctuation"].value
    if abs(last - first) > UNSETTLED * spread:
        yield (
            f"the run has not settled: the mean centre distance of its second half is {1e6 * (last - first):.3g} um off that of the "
            f"first, at a fluctuation of {1e6 * spread:.3g} um; strands swing for long, give dynamics.settling and dynamics.duration more"
        )
    used = values.get("dynamics.friction_utilisation")
    if used and used.value > SLIPPING:
        yield (
            f"at moments the pins would need a coefficient of friction of {used.value:.2g} to roll "
            "(dynamics.friction_utilisation): real ones slip then, the model lets them roll"
        )


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
    """Transmission error, tensions, flank forces; of rolling pins the friction they need."""
    found = _forces(motion)
    if model.link.radius:
        found["dynamics.friction_utilisation"] = Value(
            np.max(motion.column("utilisation")[motion.steady]),
            "-",
            "greatest coefficient of friction that pins need to roll, in joints with a twentieth of the greatest force or more",
        )
    return found


def _forces(motion):
    steady, driven = motion.steady, 1
    error, tension = motion.transmission_error(driven), motion.tension[:, 0]
    return {
        "dynamics.transmission_error": Value(motion.fluctuation(error), "rad", "driven angle off the ratio of teeth, greatest less least"),
        "dynamics.mesh_frequency": Value(1 / tooth_time(motion.model), "Hz", "teeth that mesh in a second"),
        "dynamics.tension.mean": Value(motion.mean(tension), "N", "tension in a joint as it goes round, mean"),
        "dynamics.tension.maximum": Value(np.max(tension[steady]), "N", "tension in a joint as it goes round, greatest"),
        "dynamics.flank_force.maximum": Value(np.max([motion.column(name)[steady] for name in ("left flank", "right flank")]), "N",
                                              "on a flank of a plate as it goes round, greatest"),
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
