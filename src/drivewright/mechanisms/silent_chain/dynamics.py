"""The running chain: centre distance, forces, orders and balances, over revolutions of the chain after it has settled, in an ensemble."""

from collections.abc import Mapping

import numpy as np

from drivewright.chains.explicit.ensemble import amplitude_of, centre_distance, ensemble, greatest_of, mean_of, range_of
from drivewright.chains.explicit.simulate import Settings, simulate, tooth_time
from drivewright.chains.explicit.stability import largest_step, refuse_step
from drivewright.chains.implicit import simulate as implicit
from drivewright.chains.model import ChainDrive
from drivewright.errors import InputError, SolverError, SpecError
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.moving import moving
from drivewright.mechanisms.silent_chain.spec import SilentChainSpec
from drivewright.numerics.ensemble import of_members
from drivewright.result import Answer, Answers, Check, Column, Table, Value

IMPLICIT_STEP = 1e-5  # [s]
STEP, SAFE = 1e-6, 0.5  # [s], and part of the largest stable step, that an explicit run takes unless told otherwise
OFF = 0.25  # of the pitch: a mean centre distance so far from the rigid one is that of a chain off its teeth
REVOLUTIONS = 2  # of the chain, that are evaluated unless told otherwise
MOST_STEPS = 2e10  # of a link, in all runs: about ten minutes
MOST_LISTED = 3  # statistics that have not settled, by name
SLIPPING = 0.3  # coefficient of friction that lubricated pins do not reach
HINT = (
    "where a shorter step does not help: a slack strand (check strand.taut), a speed, wear or teeth that throw the chain off, or a "
    "tensioner that hits it; see also the analysis 'quasi_static'"
)
ORDERS = 8  # of the mesh frequency, up to which the spectrum is told
WATCHED = 0


def no_dynamics(spec: SilentChainSpec) -> str | None:
    """Why there are none."""
    return None if spec.drive else "speed and preload are not given: write [drive]"


def dynamics(model: ChainModel, done: Answers) -> Answer:
    """The runs, their statistics, spectrum and balances; of a run that failed the balance and the signals alone."""
    runs = _runs(model, moving(model))
    if not all(np.all(np.isfinite(run.rows)) for run in runs.members):
        raise SolverError(f"{runs.advice}; {HINT}")
    drift = Value(runs.energy_drift, "1/s", "energy that computing added or lost in a second, over the energy stored")
    checks = (
        Check("energy_drift", drift.value, model.spec.dynamics.largest_drift, "<=", "1/s", drift.meaning, ("chain",)),
        *_seated(model, runs),
    )
    tables = (_signals(runs.first), _spectrum(runs))
    reason = runs.advice or next((check.message for check in checks if not check.ok), "")
    if reason:
        findings = (f"the run has failed, its statistics are left out: {reason}; {HINT}",)
        return Answer({"dynamics.energy_drift": drift}, tables, checks, findings, outcome="partial")
    values = {**_distances(runs), **_more(model, runs)}
    checks = (*checks, settled(values))
    values["dynamics.energy_drift"] = drift
    return Answer(values, tables, checks, tuple(_remarks(runs, values)), data=runs.first)


def _distances(runs):
    """Mean, fluctuation and mesh order in a revolution of the chain, range of the whole run."""
    found = {
        "mean": (runs.estimate(mean_of(centre_distance), range_of(centre_distance)), "mean of the centre distance"),
        "fluctuation": (runs.estimate(range_of(centre_distance)), "peak-to-peak of the centre distance in a revolution of the chain"),
        "range": (runs.extreme(range_of(centre_distance)), "peak-to-peak of the centre distance in the whole run"),
        "mesh_order_amplitude": (runs.estimate(amplitude_of(centre_distance)), "amplitude of the centre distance at the mesh frequency"),
    }
    return {f"dynamics.centre_distance.{name}": Value.of(estimate, "m", meaning) for name, (estimate, meaning) in found.items()}


def _seated(model, runs):
    """Whether the chain is still on its teeth."""
    first = runs.first
    touching = Value.of(runs.estimate(mean_of(lambda run: run.column("contacts"))), "-", "flanks that touch, on average")
    yield Check.of(
        touching,
        "running.contacts",
        float(len(first.model.sprockets)),
        ">=",
        "flanks that touch, on average, against one on every sprocket: with fewer the chain has left its teeth",
        ("chain",),
    )
    if first.model.sprockets[first.slide].slide and len(first.model.sprockets) == 2:
        off = abs(runs.estimate(mean_of(centre_distance)).value - model.closure.mean)
        yield Check(
            "running.centre_distance",
            off,
            OFF * model.spec.pitch,
            "<=",
            "m",
            "mean centre distance of the run off the rigid one: so far off, the chain has left its teeth",
            ("chain",),
        )


def settled(values: Mapping[str, Value]) -> Check:
    """Whether mean and fluctuation of the centre distance have stopped drifting: the check `settled` counts those that have not."""
    names = [f"dynamics.centre_distance.{name}" for name in ("mean", "fluctuation")]
    drifting = [name for name in names if not values[name].settled]
    return Check(
        "settled",
        float(len(drifting)),
        0.0,
        "<=",
        "-",
        "statistics of the centre distance that still drifted, or hold less than two revolutions of the chain; "
        "give dynamics.settling and dynamics.duration more",
        ("chain",),
    )


def _remarks(runs, values):
    """What keeps the numbers from being the whole truth."""
    drifting = [name for name, value in values.items() if not value.settled]
    if drifting and runs.first.revolutions < 2:
        yield (
            "dynamics.duration holds less than two revolutions of the chain: they cannot tell whether the run has settled; below one, "
            "statistics are those of the whole run and depend on its length"
        )
    elif drifting:
        more = f" and {len(drifting) - MOST_LISTED} more" if len(drifting) > MOST_LISTED else ""
        yield f"not settled: {', '.join(drifting[:MOST_LISTED])}{more}; give dynamics.settling and dynamics.duration more"
    used = values.get("dynamics.friction_utilisation")
    if used and used.value > SLIPPING:
        yield (
            f"at moments the pins would need a coefficient of friction of {used.value:.2g} to roll "
            "(dynamics.friction_utilisation): real ones slip then, the model lets them roll"
        )


def _runs(model, system):
    """The ensemble of runs, by the integrator asked for."""
    given = model.spec.dynamics
    duration = given.settling + (given.duration or REVOLUTIONS * model.spec.links * tooth_time(system))
    if duration - given.settling < 2 * tooth_time(system):
        raise SpecError(
            f"{1e3 * (duration - given.settling):.4g} ms hold no two teeth of {1e3 * tooth_time(system):.4g} ms; give more",
            "dynamics.duration",
        )
    common = {"settle": given.settling, "tolerance": given.largest_drift, "plate": WATCHED}
    if given.integrator == "implicit":
        settings, solve = implicit.Settings(given.step or IMPLICIT_STEP, **common), implicit.simulate
    else:
        settings, solve = Settings(explicit_step(model, system), **common), simulate
        _refuse_endless(model, duration, settings.step)
    return ensemble(system, duration, settings, given.ensemble, solve=solve)


def _refuse_endless(model, duration, step):
    """SpecError for an explicit run of more steps than anybody waits for."""
    given = model.spec.dynamics
    work = duration / step * model.spec.links * given.ensemble
    if work > MOST_STEPS:
        raise SpecError(
            f"{given.ensemble} runs of {duration:.3g} s in steps of {step:.3g} s take {work:.2g} steps of a link, more than "
            f"{MOST_STEPS:.2g}; shorten the run, lower stiffness or damping, or solve implicitly",
            "dynamics.duration",
        )


def explicit_step(model: ChainModel, system: ChainDrive) -> float:
    """Step of an explicit run [s]: as said, else a microsecond, or less where that is not safe."""
    given = model.spec.dynamics.step
    try:
        refuse_step(system, given or 0.1 * largest_step(system))
    except InputError as reason:
        raise SpecError(str(reason), "dynamics.step") from None
    return given or min(STEP, SAFE * largest_step(system))


def _more(model, runs):
    """Transmission error, tensions, flank forces; of rolling pins the friction they need."""
    found = _forces(runs)
    if model.link.radius:
        found["dynamics.friction_utilisation"] = Value.of(
            runs.estimate(greatest_of(lambda run: run.column("utilisation"))),
            "-",
            "coefficient of friction that pins need to roll, in joints with a twentieth of the greatest force or more, greatest in a "
            "revolution",
        )
    return found


def _forces(runs):
    """Of the driven sprocket, a joint and a plate: means over revolutions of the chain."""

    def flanks(run):
        return np.maximum(run.column("left flank"), run.column("right flank"))

    def tension(run):
        return run.tension[:, 0]

    found = {
        "transmission_error": (
            range_of(lambda run: run.transmission_error(1)),
            "rad",
            "driven angle off the ratio of teeth, peak-to-peak in a revolution of the chain",
        ),
        "tension.mean": (mean_of(tension), "N", "tension in a joint as it goes round, mean"),
        "tension.maximum": (greatest_of(tension), "N", "tension in a joint as it goes round, greatest in a revolution"),
        "flank_force.maximum": (greatest_of(flanks), "N", "on a flank of a plate as it goes round, greatest in a revolution"),
    }
    values = {f"dynamics.{name}": Value.of(runs.estimate(statistic), unit, meaning) for name, (statistic, unit, meaning) in found.items()}
    return values | {"dynamics.mesh_frequency": Value(1 / tooth_time(runs.first.model), "Hz", "teeth that mesh in a second")}


def _signals(motion):
    steady = motion.steady
    time, names = motion.t[steady], ("left x", "left y", "right x", "right y", "left flank", "right flank")
    forces = [
        Column(f"plate.{name.replace(' ', '_')}", "N", f"on a plate as it goes round: {name}", motion.column(name)[steady])
        for name in names
    ]
    return Table(
        "running",
        "The running chain",
        (
            Column("time", "s", "time", time),
            Column("centre_distance", "m", "centre distance", motion.centre_distance[steady]),
            Column("transmission_error", "rad", "driven angle off the ratio of teeth", motion.transmission_error(1)[steady]),
            Column("tension", "N", "tension in a joint as it goes round", motion.tension[steady, 0]),
            Column("contacts", "-", "flanks that touch", motion.column("contacts")[steady]),
            *forces,
            Column("energy_gap", "J", "energy less all work since the start", motion.energy_gap[steady]),
        ),
    )


def _spectrum(runs):
    """Amplitudes in a revolution of the chain, means over all revolutions."""
    orders, found = runs.mesh_orders
    near = orders <= ORDERS
    mean, reach = of_members(found[:, near])
    amplitude = Column("centre_distance", "m", "amplitude of the centre distance", mean)
    return Table(
        "spectrum",
        "Spectrum of the centre distance",
        (
            Column("order", "-", "multiple of the mesh frequency", orders[near]),
            Column("frequency", "Hz", "frequency", orders[near] / tooth_time(runs.first.model)),
            amplitude,
            *(amplitude.bounds(mean - reach, mean + reach) if len(found) > 1 else ()),
        ),
    )
